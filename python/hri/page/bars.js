// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The most probable labels as bars in a list.
const TOP = 5;

export function showBars(list, entries) {
  list.replaceChildren(
    ...entries.slice(0, TOP).map(({ label, probability }) => {
      const row = document.createElement("li");
      const [name, number] = [document.createElement("span"), document.createElement("span")];
      row.style.setProperty("--p", probability.toFixed(3));
      name.textContent = label;
      number.textContent = `${Math.round(100 * probability)} %`;
      row.append(name, number);
      return row;
    }),
  );
}
