// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The scenes of the demo, shown by the parts that make the page of hri serve.
import { showBars } from "./bars.js";
import { Conversation } from "./conversation.js";
import { put } from "./phrases.js";
import { drawRobot } from "./robot.js";
import { reason } from "./words.js";

function showScene(section, scene) {
  const part = (name) => section.querySelector(`[data-part=${name}]`);
  const [canvas, joints, play] = ["robot", "joints", "play"].map(part);
  const fused = scene.events.find((event) => event.event === "fused");
  const conversation = new Conversation(part("log"));
  showBars(part("speech"), scene.speech);
  showBars(part("gesture"), scene.gesture);
  showBars(part("fused"), fused.nbest);
  put(part("rule"), reason(fused));
  scene.events.forEach((event) => conversation.heed(event));
  drawRobot(canvas, joints, scene.figures[0]);
  play.hidden = scene.figures.length === 1;
  play.addEventListener("click", () => {
    play.disabled = true;
    const begun = performance.now();
    const draw = () => {
      const number = Math.floor(((performance.now() - begun) / 1000) * scene.figures_per_s);
      drawRobot(canvas, joints, scene.figures[Math.min(number, scene.figures.length - 1)]);
      if (number < scene.figures.length) requestAnimationFrame(draw);
      else play.disabled = false;
    };
    draw();
  });
}

const scenes = JSON.parse(document.getElementById("scenes").textContent);
document.querySelectorAll("[data-scene]").forEach((section) => showScene(section, scenes[section.dataset.scene]));
