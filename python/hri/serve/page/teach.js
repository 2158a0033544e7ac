// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// A section that adds words or gestures: a name, samples by the devices or by files, progress, undo.
import { phrase, phraseOf, put } from "./phrases.js";

export class TeachPanel {
  constructor(section, link) {
    this.mode = section.dataset.teach;
    this.section = section;
    this.link = link;
    this.wanted = 0;
    const part = (name) => section.querySelector(`[data-part=${name}]`);
    [this.line, this.sample, this.undo] = ["line", "sample", "undo"].map(part);
    [this.progress, this.files] = ["progress", "files"].map(part);
    section.querySelector("form").addEventListener("submit", (submitted) => {
      submitted.preventDefault();
      this.say("teach", { label: section.querySelector("input").value });
    });
    this.sample.addEventListener("click", () => this.say("sample"));
    this.undo.addEventListener("click", () => this.say("undo"));
    if (this.files) this.takeFiles();
  }

  say(type, more = {}) {
    this.link.say({ type, mode: this.mode, ...more });
  }

  heed(message) {
    const busy = message.recording || message.progress !== undefined;
    put(this.line, phraseOf(message, "text"));
    this.sample.disabled = !message.label || busy;
    const { label, samples, wanted } = message;
    put(this.sample, label ? phrase("record_label", { label, samples, wanted }) : phrase("record"));
    if (message.added) this.undo.disabled = message.added.length === 0;
    this.progress.hidden = message.progress === undefined;
    this.progress.value = message.progress ?? 0;
    this.wanted = message.label && !busy ? message.wanted - message.samples : 0;
    if (this.files) this.files.disabled = this.wanted === 0;
  }

  takeFiles() {
    this.files.addEventListener("change", async () => {
      await this.send([...this.files.files]);
      this.files.value = "";
    });
    this.section.addEventListener("dragover", (over) => over.preventDefault());
    this.section.addEventListener("drop", (dropped) => {
      dropped.preventDefault();
      this.send([...dropped.dataTransfer.files]);
    });
  }

  // One after the other; the answers come as messages of the line, the others are shown here.
  async send(files) {
    const show = (said) => put(this.line, said);
    if (this.wanted === 0) return show(phrase("name_first"));
    if (files.length > this.wanted) return show(phrase("choose_fewer", { most: this.wanted }));
    for (const file of files) {
      try {
        const answer = await fetch(`sample?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file });
        if (answer.ok) continue;
        return show(phraseOf(await answer.json(), "text"));
      } catch {
        return show(phrase("file_lost", { name: file.name }));
      }
    }
  }
}
