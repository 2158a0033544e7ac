// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The switch of language: what was chosen last, else what the browser prefers.
import { inWords, LANGUAGES, phrase, sayIn, spokenLanguage } from "./phrases.js";

function preferred() {
  const known = (name) => LANGUAGES.includes(name);
  const wanted = [localStorage.language, ...navigator.languages.map((name) => name.split("-")[0])];
  return wanted.find(known) ?? LANGUAGES[0];
}

export function offerLanguages(select, onChange) {
  for (const name of LANGUAGES) {
    sayIn(name); // each is named in itself
    const option = document.createElement("option");
    [option.value, option.lang, option.textContent] = [name, name, inWords(phrase("this_language"))];
    select.append(option);
  }
  select.addEventListener("change", () => {
    localStorage.language = select.value;
    sayIn(select.value);
    onChange(select.value);
  });
  sayIn(preferred());
  select.value = spokenLanguage();
}
