// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// A section that adds words or gestures: a name, samples by the devices or by files, progress, undo.
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
    this.line.textContent = message.text;
    this.sample.disabled = !message.label || busy;
    this.sample.textContent = message.label ? `Record “${message.label}” (${message.samples} of ${message.wanted})` : "Record";
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
    const show = (text) => (this.line.textContent = text);
    if (this.wanted === 0) return show("First give the gesture a name.");
    if (files.length > this.wanted) return show(`Choose ${this.wanted} at most: more samples are not needed.`);
    for (const file of files) {
      try {
        const answer = await fetch(`sample?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file });
        if (answer.ok) continue;
        return show(await answer.text());
      } catch {
        return show(`${file.name} did not reach hri serve. Try again.`);
      }
    }
  }
}
