// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// What the page shows and what its buttons do.
import { showBars } from "./bars.js";
import { CommandsPanel } from "./commands.js";
import { Conversation } from "./conversation.js";
import { openCamera, openMicrophone, whatIsWrong } from "./devices.js";
import { FilePlayer } from "./files.js";
import { ImitationPanel } from "./imitation.js";
import { offerLanguages } from "./language.js";
import { Link } from "./link.js";
import { MissingPanel } from "./missing.js";
import { phrase, phraseOf, put } from "./phrases.js";
import { HandDrawing } from "./place.js";
import { drawRobot } from "./robot.js";
import { TeachPanel } from "./teach.js";
import { showVocabulary } from "./vocabulary.js";
import { RobotVoice } from "./voice.js";
import { decided, reason } from "./words.js";

const SHOWN_MS = 6000;
const MEASURE = "picture-to-bars";
const at = (id) => document.getElementById(id);
const link = new Link(heed, connection);
const player = new FilePlayer(at("files"), link, at("stage"));
const drawing = new HandDrawing(at("place"), () => (player.shows ? player.clip : at("camera")));
const conversation = new Conversation(at("log"));
const commands = new CommandsPanel(at("commands"));
const missing = new MissingPanel(at("missing"));
const imitation = new ImitationPanel(at("imitation"), link);
offerLanguages(at("language"), () => voice.offer());
const voice = new RobotVoice(at("voice"), link, () => !player.sounds);
const panels = new Map([...document.querySelectorAll("[data-teach]")].map((s) => [s.dataset.teach, new TeachPanel(s, link)]));
const knows = { speech: false, gesture: false };
const opened = { microphone: null, camera: null };
let starting = false;
let measured = [];
let known = "disconnected"; // the last state that the server has reported

function showState(name) {
  if (name !== "stopping") known = name;
  if (name === "disconnected") {
    imitation.show(false);
    missing.show();
    drawing.clear();
  }
  put(at("state"), phrase(`state_${name}`));
  at("state").dataset.state = name;
  at("resume").disabled = name !== "stopped";
}

// Problems stay until they are over or, without a key, for some seconds.
function problem(said, key = "") {
  const name = key || JSON.stringify(said);
  [...at("problems").children].filter((line) => line.dataset.key === name).forEach((line) => line.remove());
  if (!said) return;
  const line = document.createElement("p");
  line.dataset.key = name;
  put(line, said);
  at("problems").append(line);
  if (!key) setTimeout(() => line.remove(), SHOWN_MS);
}

function connection(is, why) {
  if (is === "connecting") return;
  showState("disconnected");
  problem(phrase(why, { rate: link.rate }), "line");
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
    put(at("latency"), phrase("latency", { median: median.toFixed(0), count: measured.length }));
  });
}

function heedEvent(event) {
  if (event.event === "state") showState(event.state);
  if (event.event === "level") {
    at("level").value = event.level_db;
    at("level").textContent = `${event.level_db} dB`;
    put(at("level-label"), phrase(event.in_speech ? "microphone_word" : "microphone_on"));
  }
  if (event.event === "hand") {
    drawing.heed(event);
    missing.show(event.missing);
  }
  if (event.mode === "gesture" && ["stall", "ended"].includes(event.event)) {
    missing.show();
    drawing.clear();
  }
  if (event.event === "say") {
    put(at("said"), phraseOf(event, "text"));
    voice.say(phraseOf(event, "aloud"));
  }
  if (event.nbest && event.event !== "fused") {
    showBars(at(`bars-${event.mode}`), event.nbest);
    if (event.sent_ms !== undefined) measure(event.sent_ms);
  }
  if (event.event === "signing" || event.event === "signed") {
    const line = document.createElement("li");
    const words = event.words.join(" ");
    put(line, event.event === "signing" ? phrase("so_far", { words }) : words);
    at("bars-gesture").replaceChildren(line);
  }
  if (event.event === "fused") {
    showBars(at("bars-fused"), event.nbest);
  }
  if (reason(event)) {
    at("decided").textContent = decided(event);
    put(at("rule"), reason(event));
  }
  conversation.take(event);
}

function heedWelcome(message) {
  Object.assign(knows, { speech: message.speech, gesture: message.gesture });
  player.knows = knows;
  offerStart();
  problem("", "line");
  missing.show();
  showState(message.state);
  panels.forEach((panel, mode) => {
    panel.section.hidden = !message.teach.includes(mode);
    panel.reset(message.teaching[mode]);
  });
  commands.show(message.grammar);
  at("word-samples").hidden = !message.has_samples;
  imitation.offer(message.imitate.length > 0, message.imitating);
  conversation.catchUp(message.log);
  showVocabulary(at("vocabulary"), message);
}

function heed(message) {
  if (message.type === "welcome") heedWelcome(message);
  else if (message.type === "event") heedEvent(message);
  else if (message.type === "seen") drawing.see(message);
  else if (message.type === "robot") drawRobot(at("robot"), at("joints"), message);
  else if (message.type === "imitation") imitation.show(message.on);
  else if (message.type === "teach") panels.get(message.mode)?.heed(message);
  else {
    problem(phraseOf(message, "text"));
    conversation.take(message);
  }
}

// What is open stays as it is: opened once more, a microphone would be sent twice.
async function start() {
  starting = true;
  offerStart();
  const failed = [];
  if (knows.speech && !opened.microphone) {
    try {
      const heard = (samples) => !player.sounds && link.sound(samples);
      const microphone = (opened.microphone = await openMicrophone(heard, () => lost("microphone")));
      problem("", "microphone");
      put(at("level-label"), phrase("microphone_on"));
      if (microphone.rate !== link.rate) {
        link.rate = microphone.rate;
        link.open();
      }
    } catch (error) {
      failed.push(["microphone", error]);
    }
  }
  if (knows.gesture && !opened.camera) {
    try {
      const seen = (blob, takenMs) => !player.shows && link.picture(blob, takenMs);
      opened.camera = await openCamera(at("camera"), seen, () => lost("camera"));
      problem("", "camera");
      put(at("camera-line"), phrase("camera_on"));
      imitation.see(true);
    } catch (error) {
      failed.push(["camera", error]);
    }
  }
  failed.forEach(([what, error]) => problem(whatIsWrong(error, what), what));
  starting = false;
  offerStart();
}

// Before the welcome it is not known which devices are wanted.
function offerStart() {
  const wanted = (knows.speech && !opened.microphone) || (knows.gesture && !opened.camera);
  at("start").disabled = starting || !wanted;
}

function lost(what) {
  opened[what]?.close();
  opened[what] = null;
  if (what === "camera") {
    put(at("camera-line"), phrase("camera_off"));
    imitation.see(false);
    missing.show();
  } else {
    put(at("level-label"), phrase("microphone_off"));
  }
  problem(phrase("unplugged", { device: phrase(what) }), what);
  offerStart();
}

async function stop() {
  voice.hush();
  player.halt();
  showState("stopping");
  const heard = await link.stop();
  if (at("state").dataset.state === "stopping") showState(heard ? "stopped" : known); // unless an event was faster
  problem(heard ? "" : phrase("stop_lost"), "stop");
}

at("start").addEventListener("click", start);
at("stop").addEventListener("click", stop);
at("resume").addEventListener("click", () => link.say({ type: "resume" }));
document.addEventListener("keydown", (pressed) => {
  if (pressed.key === "Escape") stop();
});
link.open();
