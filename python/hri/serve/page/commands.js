// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The section that shows the grammar of commands of several words, and tries another one.
import { phrase, phraseOf, put } from "./phrases.js";

export class CommandsPanel {
  constructor(section) {
    this.section = section;
    [this.field, this.line, this.button] = ["textarea", "[role=status]", "button"].map((name) => section.querySelector(name));
    this.known = "";
    section.querySelector("form").addEventListener("submit", (submitted) => {
      submitted.preventDefault();
      this.send();
    });
  }

  // The grammar in use; null where commands are single words. What a person has begun to write stays.
  show(grammar) {
    this.section.hidden = grammar === null;
    if (this.field.value !== this.known) return;
    this.field.value = grammar ?? "";
    this.known = this.field.value; // with the field's own ends of lines
  }

  async send() {
    this.button.disabled = true;
    put(this.line, phrase("trying"));
    try {
      const answer = await fetch("grammar", { method: "POST", body: this.field.value });
      put(this.line, phraseOf(await answer.json(), "text"));
      if (answer.ok) this.known = this.field.value;
    } catch {
      put(this.line, phrase("grammar_lost"));
    }
    this.button.disabled = false;
  }
}
