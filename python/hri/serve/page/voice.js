// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The robot's voice. The server learns when it speaks: the microphone goes on, and of what it hears only STOP counts.
import { inWords, spokenLanguage } from "./phrases.js";

const LONGEST_MS = 15000; // some browsers never report the end

export class RobotVoice {
  // `isHeard` says whether a microphone may hear it; a file does not.
  constructor(box, link, isHeard) {
    this.box = box;
    this.link = link;
    this.isHeard = isHeard;
    this.speaking = null;
    this.offer();
    window.speechSynthesis?.addEventListener?.("voiceschanged", () => this.offer());
    box.addEventListener("change", () => {
      localStorage.voice = box.checked ? "on" : "off";
      if (!box.checked) this.hush();
    });
  }

  // A browser without a voice in the page's language has the switch off.
  offer() {
    this.box.disabled = !this.voice();
    this.box.checked = !this.box.disabled && localStorage.voice !== "off";
  }

  voice() {
    const voices = window.speechSynthesis?.getVoices() ?? [];
    return voices.find((one) => one.lang.toLowerCase().startsWith(spokenLanguage()));
  }

  say(said) {
    const text = inWords(said);
    if (!this.box.checked || !text) return;
    this.hush();
    const words = new SpeechSynthesisUtterance(text);
    [words.voice, words.lang] = [this.voice(), this.voice().lang];
    this.speaking = words;
    words.onend = words.onerror = () => this.ended(words);
    this.timer = setTimeout(() => this.hush(), LONGEST_MS);
    if (this.isHeard()) this.link.say({ type: "voice", text: text.slice(0, 1000) });
    window.speechSynthesis.speak(words);
  }

  ended(words) {
    if (words !== this.speaking) return;
    this.speaking = null;
    clearTimeout(this.timer);
    this.link.say({ type: "voice", text: "" });
  }

  hush() {
    const words = this.speaking;
    clearTimeout(this.timer);
    if (!words) return;
    window.speechSynthesis.cancel();
    this.ended(words);
  }
}
