// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// Texts in the language of the person. An element that shows a phrase carries it (data-text, data-values; data-label for
// its name), so that it is said anew when the language changes.
import { PHRASES } from "./table.js";

export const LANGUAGES = Object.keys(PHRASES.this_language);
const PLACE = /\{(\w+)(?:\|(\w+))?\}/g;
let language = LANGUAGES[0];

export const phrase = (code, values = {}) => ({ code, values });

// A text of a message: as a phrase where it came with one, else as it stands.
export const phraseOf = (message, field) => message.phrases?.[field] ?? message[field];

export const spokenLanguage = () => language;

export function inWords(said) {
  if (typeof said === "string") return said;
  return PHRASES[said.code][language].replace(PLACE, (_, name, joint) => valueInWords(said.values[name], joint));
}

function valueInWords(value, joint) {
  if (Array.isArray(value)) return value.map((one) => valueInWords(one)).join(joint ? PHRASES[joint][language] : ", ");
  if (value === null || typeof value !== "object") return String(value);
  return value.code ? inWords(value) : (value[language] ?? value.en ?? Object.values(value)[0] ?? ""); // by language
}

// Show a phrase, or a text that is the same in every language.
export function put(element, said) {
  if (typeof said === "string") {
    delete element.dataset.text;
    element.textContent = said;
  } else {
    element.dataset.text = said.code;
    element.dataset.values = JSON.stringify(said.values);
    element.textContent = inWords(said);
  }
}

export function nameIt(element, said) {
  element.dataset.label = said.code;
  element.dataset.values = JSON.stringify(said.values);
  element.setAttribute("aria-label", inWords(said));
}

// Say everything that is shown in another language.
export function sayIn(chosen) {
  language = chosen;
  document.documentElement.lang = chosen;
  const values = (element) => JSON.parse(element.dataset.values ?? "{}");
  document.querySelectorAll("[data-text]").forEach((e) => (e.textContent = inWords(phrase(e.dataset.text, values(e)))));
  document.querySelectorAll("[data-label]").forEach((e) =>
    e.setAttribute("aria-label", inWords(phrase(e.dataset.label, values(e)))));
}
