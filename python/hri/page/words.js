// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// Events of a session in words, for people.
const percent = (share) => `${Math.round(100 * share)} %`;

function understood(event) {
  const modes = [["speech", "word"], ["gesture", "sign"]]
    .filter(([mode]) => event[mode])
    .map(([mode, name]) => `${name} ${event[mode].label} ${percent(event[mode].confidence)}`);
  return `You: ${event.final || event.status} (${modes.join(" and ")}). ${event.rule}.`;
}

function nearness(event) {
  if (event.words.length === 0) return "Nothing was said or shown between its beginning and its end.";
  if (event.nearest.length === 0) return "There are no stored sentences: I say its words.";
  const nearest = `The nearest stored sentence is “${event.nearest.join(" ")}”, at distance ${event.distance.toFixed(2)}`;
  const most = event.max_distance.toFixed(2);
  return event.distance > event.max_distance ? `${nearest}: too far, at most ${most} counts.` : `${nearest} (at most ${most} counts).`;
}

const LINES = {
  fused: understood,
  sentence: (event) => `You: “${event.words.join(" ")}”. ${nearness(event)}`,
  say: (event) => `Robot: ${event.text}`,
  ignored: (event) => `Ignored ${event.label}: ${event.reason}.`,
  stop: (event) => `STOP${event.label && ` ${event.label}`}: ${event.reason}.`,
  rest: (event) => `Rest: ${event.reason}.`,
  resumed: () => "Motions may begin again.",
  motion_start: (event) =>
    `The robot moves: ${event.label}, ${Math.round(event.wait_ms + event.compute_ms)} ms after it was asked for.`,
  halt: (event) => `The robot begins to stop, ${Math.round(event.wait_ms + event.compute_ms)} ms after STOP.`,
  motion_end: (event) => `The robot has ${event.completed ? "finished" : "stopped"}: ${event.label}.`,
  stall: (event) => `${event.mode === "speech" ? "Microphone" : "Camera"}: ${event.message}.`,
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
  return event.event === "fused" ? `${event.final || event.status}: ${event.rule}; ${event.why}` : "";
}
