// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// What is recognised, and what the robot does for it.
import { phrase, put } from "./phrases.js";

const quoted = (label) => phrase("quoted", { label });

function ofSentences({ begin, end, stored, more }) {
  const parts = [begin.length ? phrase("sentence_between", { begin, end }) : phrase("sentence_signed")];
  const sentences = stored.map(quoted);
  if (sentences.length) parts.push(phrase(more ? "knows_more_sentences" : "knows_sentences", { sentences, more }));
  return parts;
}

function ofRobot({ robot, motions, imitate }) {
  const labels = motions.filter((label) => !imitate.includes(label));
  if (!robot) return phrase("no_robot");
  return phrase(labels.length ? "moves_for" : "moves_for_none", { robot, labels });
}

export function showVocabulary(part, welcome) {
  const { words, signs, grammar, sentences, refused, imitate, made_of: single } = welcome;
  const parts = [];
  if (words.length) parts.push(phrase(grammar === null ? "knows_words" : "knows_commands", { labels: words }));
  if (single.length) parts.push(phrase("knows_parts", { labels: single }));
  if (signs.length) parts.push(phrase("knows_signs", { labels: signs }));
  if (sentences) parts.push(...ofSentences(sentences));
  parts.push(ofRobot(welcome));
  if (imitate.length) parts.push(phrase("imitates_from", { labels: imitate }));
  const labels = Object.entries(refused).map(([label, why]) =>
    phrase("with_reason", { label, why: welcome.phrases?.refused?.[label] ?? why }));
  if (labels.length) parts.push(phrase("moves_not_for", { labels }));
  part.replaceChildren(
    ...parts.map((said) => {
      const line = document.createElement("p");
      put(line, said);
      return line;
    }),
  );
}
