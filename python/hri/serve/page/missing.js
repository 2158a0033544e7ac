// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// What the camera's pictures lack for a sign to be seen.
import { phrase, put } from "./phrases.js";

export class MissingPanel {
  constructor(part) {
    this.part = part;
    this.shown = "";
  }

  // What is missing, or "". A screen reader says what changes, so that what is shown already stays as it is.
  show(missing = "") {
    if (missing === this.shown) return;
    this.shown = missing;
    const line = document.createElement("p");
    if (missing) put(line, phrase(`missing_${missing}`));
    this.part.replaceChildren(...(missing ? [line] : []));
  }
}
