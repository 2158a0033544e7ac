// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// One line of the conversation for an event; "" for what needs none.
const percent = (share) => `${Math.round(100 * share)} %`;

function understood(event) {
  const modes = [["speech", "word"], ["gesture", "sign"]]
    .filter(([mode]) => event[mode])
    .map(([mode, name]) => `${name} ${event[mode].label} ${percent(event[mode].confidence)}`);
  return `You: ${event.final || event.status} (${modes.join(" and ")}). ${event.rule}.`;
}

const LINES = {
  fused: understood,
  say: (event) => `Robot: ${event.text}`,
  ignored: (event) => `Ignored ${event.label}: ${event.reason}.`,
  stop: (event) => `STOP${event.label && ` ${event.label}`}: ${event.reason}.`,
  rest: (event) => `Rest: ${event.reason}.`,
  resumed: () => "Motions may begin again.",
  motion_start: (event) =>
    `The robot moves: ${event.label}, ${Math.round(event.wait_ms + event.compute_ms)} ms after it was said or shown.`,
  halt: (event) => `The robot begins to stop, ${Math.round(event.wait_ms + event.compute_ms)} ms after STOP.`,
  motion_end: (event) => `The robot has ${event.completed ? "finished" : "stopped"}: ${event.label}.`,
  stall: (event) => `${event.mode === "speech" ? "Microphone" : "Camera"}: ${event.message}.`,
};

export function describe(event) {
  return LINES[event.event]?.(event) ?? "";
}
