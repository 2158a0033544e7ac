// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// Events of a session as phrases, for people.
import { phrase, phraseOf } from "./phrases.js";

const labelOf = ({ label, status }) => (status === "recognised" ? label : phrase(`status_${status}`));
const decidedLabel = (event) => event.final || phrase(`status_${event.status}`);
const sinceAsked = (event) => Math.round(event.wait_ms + event.compute_ms);

function understood(event) {
  const modes = [["speech", "said_word"], ["gesture", "shown_sign"]]
    .filter(([mode]) => event[mode])
    .map(([mode, code]) => phrase(code, { label: labelOf(event[mode]), percent: Math.round(100 * event[mode].confidence) }));
  return phrase("you_meant", { label: decidedLabel(event), modes, rule: phraseOf(event, "rule") });
}

function nearness(event) {
  if (event.words.length === 0) return phrase("nothing_between");
  if (event.nearest.length === 0) return phrase("none_stored");
  return phrase(event.distance > event.max_distance ? "nearest_far" : "nearest_near", {
    sentence: event.nearest.join(" "),
    distance: event.distance.toFixed(2),
    most: event.max_distance.toFixed(2),
  });
}

const LINES = {
  fused: understood,
  sentence: (event) => phrase("you_said_sentence", { words: event.words.join(" "), nearness: nearness(event) }),
  say: (event) => phrase("robot_said", { text: phraseOf(event, "text") }),
  ignored: (event) => phrase("was_ignored", { label: event.label, reason: phraseOf(event, "reason") }),
  stop: (event) => phrase(event.label ? "stop_label_line" : "stop_line", { label: event.label, reason: phraseOf(event, "reason") }),
  rest: (event) => phrase("rest_line", { reason: phraseOf(event, "reason") }),
  resumed: () => phrase("resumed_line"),
  motion_start: (event) => phrase("begins_to_move", { label: event.label, ms: sinceAsked(event) }),
  halt: (event) => phrase("begins_to_stop", { ms: sinceAsked(event) }),
  motion_end: (event) => phrase(event.completed ? "has_finished" : "has_stopped", { label: event.label }),
  stall: (event) => phrase(event.mode === "speech" ? "microphone_stall" : "camera_stall", { message: phraseOf(event, "message") }),
};

// One line of the conversation; "" for what needs none.
export function describe(event) {
  return LINES[event.event]?.(event) ?? "";
}

// The sentence that was decided on, and its slots where it is a command of several words; "" for other events.
export function decided(event) {
  if (event.event === "sentence") return event.words.join(" ");
  const slots = Object.entries(event.slots ?? {}).map(([slot, value]) => `${slot}: ${value}`);
  return slots.length ? `${event.final} (${slots.join(", ")})` : event.final || "";
}

// Why: the rule that fired, or the stored sentence that is nearest; "" for other events.
export function reason(event) {
  if (event.event === "sentence") return nearness(event);
  if (event.event !== "fused") return "";
  return phrase("because", { label: decidedLabel(event), rule: phraseOf(event, "rule"), why: phraseOf(event, "why") });
}
