// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The button that makes the robot move its arms as the person before the camera does, and what is said meanwhile.
import { phrase, put } from "./phrases.js";

export class ImitationPanel {
  constructor(part, link) {
    this.part = part;
    [this.button, this.line] = ["button", "[role=status]"].map((name) => part.querySelector(name));
    this.on = this.sees = false;
    this.button.addEventListener("click", () => link.say({ type: this.on ? "rest" : "imitate" }));
  }

  offer(there, on) {
    this.part.hidden = !there;
    this.show(on);
  }

  // Without a camera there is nobody to imitate.
  see(sees) {
    this.sees = sees;
    this.show(this.on);
  }

  show(on) {
    this.on = on;
    this.button.disabled = !this.sees && !on;
    put(this.button, phrase(on ? "stop_imitating" : "imitate_me"));
    put(this.line, on ? phrase("imitates") : "");
    this.part.classList.toggle("on", on);
  }
}
