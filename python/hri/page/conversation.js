// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The conversation: a line for each event that has something to say.
import { inWords, put } from "./phrases.js";
import { describe } from "./words.js";

const MOST_LINES = 200;

export class Conversation {
  constructor(log) {
    this.log = log;
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
