// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The most probable labels as bars in a list: from 0 to the necessity, and on to the possibility.
import { phrase, put } from "./phrases.js";

const TOP = 5;
const percent = (share) => Math.round(100 * share);

export function showBars(list, entries) {
  list.replaceChildren(
    ...entries.slice(0, TOP).map(({ label, probability, possibility, necessity }) => {
      const row = document.createElement("li");
      const [name, number, degrees] = ["span", "span", "small"].map((kind) => document.createElement(kind));
      row.style.setProperty("--possibility", possibility.toFixed(3));
      row.style.setProperty("--necessity", necessity.toFixed(3));
      name.textContent = label;
      number.textContent = `${percent(probability)} %`;
      put(degrees, phrase("degrees", { possibility: percent(possibility), necessity: percent(necessity) }));
      row.append(name, number, degrees);
      return row;
    }),
  );
}
