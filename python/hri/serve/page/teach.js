// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// A section that adds words or gestures: a name, samples by the devices or by files, progress, undo.
import { nameIt, phrase, phraseOf, put } from "./phrases.js";

export class TeachPanel {
  constructor(section, link) {
    this.mode = section.dataset.teach;
    this.section = section;
    this.link = link;
    this.wanted = 0;
    this.label = "";
    const part = (name) => section.querySelector(`[data-part=${name}]`);
    [this.line, this.sample, this.undo] = ["line", "sample", "undo"].map(part);
    [this.progress, this.files] = ["progress", "files"].map(part);
    [this.hint, this.undoes] = [phrase(this.line.dataset.text), phrase(this.undo.dataset.label)];
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
    put(this.line, phraseOf(message, "text"));
    this.show(message, message.recording || message.progress !== undefined);
    this.progress.hidden = message.progress === undefined;
    this.progress.value = message.progress ?? 0;
  }

  // The state of the welcome: the page may be new, or have missed what happened while its line was lost.
  reset(state) {
    const learning = state.busy && !state.recording;
    if (this.label !== state.label && !state.busy) {
      const { label, samples: number, wanted: most } = state;
      put(this.line, label ? phrase("samples_of_label", { label, number, most }) : this.hint);
    }
    this.show(state, state.busy || state.recording);
    this.progress.hidden = !learning;
    if (learning) this.progress.removeAttribute("value");
  }

  show({ label, samples, wanted, added }, busy) {
    [this.label, this.most] = [label, wanted];
    this.full = Boolean(label) && samples === wanted && !busy; // adding has failed
    this.sample.disabled = !label || busy;
    const record = this.full ? phrase("add_again", { label }) : phrase("record_label", { label, samples, wanted });
    put(this.sample, label ? record : phrase("record"));
    this.undo.disabled = !label && added.length === 0;
    nameIt(this.undo, label ? phrase("undo_sample") : this.undoes);
    this.wanted = label && !busy ? wanted - samples : 0;
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
    if (this.full) return show(phrase("samples_complete", { label: this.label, most: this.most }));
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
