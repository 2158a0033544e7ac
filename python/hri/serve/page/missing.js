// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// What the camera's pictures lack for a sign to be seen, in every language there is.
export class MissingPanel {
  constructor(part) {
    this.part = part;
    this.texts = {};
    this.shown = "";
  }

  // What is missing, or "". A screen reader says what changes, so that what is shown already stays as it is.
  show(missing = "") {
    if (missing === this.shown) return;
    this.shown = missing;
    const lines = Object.entries(this.texts[missing] ?? {}).map(([language, text]) => {
      const line = document.createElement("p");
      line.lang = language;
      line.textContent = text;
      return line;
    });
    this.part.replaceChildren(...lines);
  }
}
