// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// What the page shows and what its buttons do.
import { showBars } from "./bars.js";
import { CommandsPanel } from "./commands.js";
import { Conversation } from "./conversation.js";
import { inWords, openCamera, openMicrophone } from "./devices.js";
import { ImitationPanel } from "./imitation.js";
import { Link } from "./link.js";
import { MissingPanel } from "./missing.js";
import { drawPlace } from "./place.js";
import { drawRobot } from "./robot.js";
import { TeachPanel } from "./teach.js";
import { decided, reason } from "./words.js";

const SHOWN_MS = 6000;
const MEASURE = "picture to bars";
const at = (id) => document.getElementById(id);
const link = new Link(heed, connection);
const conversation = new Conversation(at("log"));
const commands = new CommandsPanel(at("commands"));
const missing = new MissingPanel(at("missing"));
const imitation = new ImitationPanel(at("imitation"), link);
const panels = new Map([...document.querySelectorAll("[data-teach]")].map((s) => [s.dataset.teach, new TeachPanel(s, link)]));
const knows = { speech: false, gesture: false };
let state = "";
let measured = [];

function showState(text) {
  if (text === "not connected") {
    imitation.show(false);
    missing.show();
  }
  state = text;
  at("state").textContent = text;
  at("state").dataset.state = text;
  at("resume").disabled = text !== "stopped";
}

// Problems stay until they are over or, without a key, for some seconds.
function problem(text, key = "") {
  const name = key || text;
  [...at("problems").children].filter((line) => line.dataset.key === name).forEach((line) => line.remove());
  if (!text) return;
  const line = document.createElement("p");
  line.dataset.key = name;
  line.textContent = text;
  at("problems").append(line);
  if (!key) setTimeout(() => line.remove(), SHOWN_MS);
}

function connection(is, why) {
  if (is === "lost") {
    showState("not connected");
    problem(`${why} The connection to hri serve is lost; the robot rests. Trying again …`.trim(), "line");
  } else if (is === "refused") {
    showState("not connected");
    problem(`${why} Reload this page to try again.`, "line");
  }
}

// From taking the picture that a decision rests on to the next picture of this page that shows it.
function measure(sentMs) {
  requestAnimationFrame(() => {
    const entry = performance.measure(MEASURE, { start: sentMs, end: performance.now() });
    measured.push(entry.duration);
    if (measured.length > 500) {
      measured = measured.slice(-100);
      performance.clearMeasures(MEASURE);
    }
    const median = [...measured].sort((a, b) => a - b)[measured.length >> 1];
    at("latency").textContent = `From picture to bars: ${median.toFixed(0)} ms (median of ${measured.length})`;
  });
}

function heedEvent(event) {
  if (event.event === "state") showState(event.state);
  if (event.event === "level") {
    at("level").value = event.level_db;
    at("level").textContent = `${event.level_db} dB`;
    at("level-label").textContent = event.in_speech ? "Microphone: a word" : "Microphone: on";
  }
  if (event.event === "hand") {
    drawPlace(at("place"), at("camera"), event);
    missing.show(event.missing);
  }
  if (event.mode === "gesture" && ["stall", "ended"].includes(event.event)) missing.show();
  if (event.event === "say") at("said").textContent = event.text;
  if (event.nbest && event.event !== "fused") {
    showBars(at(`bars-${event.mode}`), event.nbest);
    if (event.sent_ms !== undefined) measure(event.sent_ms);
  }
  if (event.event === "signing" || event.event === "signed") {
    const line = document.createElement("li");
    line.textContent = event.event === "signing" ? `So far: ${event.words.join(" ")} …` : event.words.join(" ");
    at("bars-gesture").replaceChildren(line);
  }
  if (event.event === "fused") {
    showBars(at("bars-fused"), event.nbest);
  }
  if (reason(event)) {
    at("decided").textContent = decided(event);
    at("rule").textContent = reason(event);
  }
  conversation.heed(event);
}

function heedWelcome(message) {
  Object.assign(knows, { speech: message.speech, gesture: message.gesture });
  problem("", "line");
  missing.texts = message.missing_texts;
  missing.show();
  showState(message.state);
  panels.forEach((panel, mode) => (panel.section.hidden = !message.teach.includes(mode)));
  commands.show(message.grammar);
  at("word-samples").hidden = !message.has_samples;
  imitation.offer(message.imitate.length > 0, message.imitating);
  conversation.clear();
  message.log.forEach((one) => (one.type === "event" ? conversation.heed(one) : conversation.write(one.text, "note")));
  showVocabulary(message);
}

function showVocabulary({ words, signs, grammar, sentences, robot, motions, refused, imitate, made_of: single }) {
  const parts = [];
  if (words.length) parts.push(`${grammar === null ? "Words" : "Commands"}: ${words.join(", ")}.`);
  if (single.length) parts.push(`Commands are made of: ${single.join(", ")}.`);
  if (signs.length) parts.push(`Signs: ${signs.join(", ")}.`);
  if (sentences) {
    parts.push(
      sentences.begin.length
        ? `A sentence goes from ${sentences.begin.join(" or ")} to ${sentences.end.join(" or ")}.`
        : "A signed sentence goes from the first movement of the hands to their rest.",
    );
    const more = sentences.more ? `, and ${sentences.more} more` : "";
    if (sentences.stored.length) parts.push(`Stored sentences: ${sentences.stored.map((one) => `“${one}”`).join(", ")}${more}.`);
  }
  const own = motions.filter((label) => !imitate.includes(label));
  parts.push(robot ? `${robot} moves for: ${own.join(", ") || "none of them"}.` : "There is no robot.");
  if (imitate.length) parts.push(`From ${imitate.join(" or ")} on it moves its arms as you do.`);
  const still = Object.entries(refused).map(([label, why]) => `${label} (${why})`);
  if (still.length) parts.push(`It does not move for: ${still.join(", ")}.`);
  at("vocabulary").replaceChildren(
    ...parts.map((text) => {
      const line = document.createElement("p");
      line.textContent = text;
      return line;
    }),
  );
}

function heed(message) {
  if (message.type === "welcome") heedWelcome(message);
  else if (message.type === "event") heedEvent(message);
  else if (message.type === "robot") drawRobot(at("robot"), at("joints"), message);
  else if (message.type === "imitation") imitation.show(message.on);
  else if (message.type === "teach") panels.get(message.mode)?.heed(message);
  else {
    problem(message.text);
    conversation.write(message.text, message.type);
  }
}

async function start() {
  at("start").disabled = true;
  const failed = [];
  if (knows.speech) {
    try {
      const microphone = await openMicrophone((samples) => link.sound(samples), () => lost("microphone"));
      problem("", "microphone");
      at("level-label").textContent = "Microphone: on";
      if (microphone.rate !== link.rate) {
        link.rate = microphone.rate;
        link.open();
      }
    } catch (error) {
      failed.push(["microphone", error]);
    }
  }
  if (knows.gesture) {
    try {
      await openCamera(at("camera"), (blob, takenMs) => link.picture(blob, takenMs), () => lost("camera"));
      problem("", "camera");
      at("camera-line").textContent = "Camera: on";
      imitation.see(true);
    } catch (error) {
      failed.push(["camera", error]);
    }
  }
  failed.forEach(([what, error]) => problem(inWords(error, what), what));
  at("start").disabled = failed.length === 0;
}

function lost(what) {
  if (what === "camera") {
    imitation.see(false);
    missing.show();
  }
  problem(`The ${what} was unplugged. Plug it in and press Start again.`, what);
  at("start").disabled = false;
}

async function stop() {
  showState("stopped");
  const heard = await link.stop();
  problem(heard ? "" : "STOP did not reach hri serve. Press Ctrl-C in its window.", "stop");
}

at("start").addEventListener("click", start);
at("stop").addEventListener("click", stop);
at("resume").addEventListener("click", () => link.say({ type: "resume" }));
document.addEventListener("keydown", (pressed) => {
  if (pressed.key === "Escape") stop();
});
link.open();
