// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The conversation: a line for each event that has something to say.
import { inWords, phraseOf, put } from "./phrases.js";
import { describe } from "./words.js";

const MOST_LINES = 200;

export class Conversation {
  constructor(log) {
    this.log = log;
    this.last = 0;
  }

  // What has happened, with running numbers ("log_number"): only what is not there yet is written, as a screen reader
  // says it; all is written anew where something between is missing.
  catchUp(messages) {
    if (messages[0]?.log_number > this.last + 1) this.clear();
    messages.forEach((message) => this.take(message));
  }

  // An event or a note, unless it came already.
  take(message) {
    const number = message.log_number ?? Infinity;
    if (number <= this.last) return;
    if (number < Infinity) this.last = number;
    if (message.type === "event") this.heed(message);
    else this.write(phraseOf(message, "text"), message.type);
  }

  heed(event) {
    this.write(describe(event), event.event);
  }

  write(said, kind = "") {
    if (!said || this.log.lastChild?.textContent === inWords(said)) return; // STOP comes by two ways
    const line = document.createElement("p");
    put(line, said);
    line.className = kind;
    this.log.append(line);
    while (this.log.children.length > MOST_LINES) this.log.firstChild.remove();
    this.log.scrollTop = this.log.scrollHeight;
  }

  clear() {
    this.log.replaceChildren();
  }
}
