// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The hand in the camera's picture: its outline and its track, or a circle where only its place is known.
const GESTURE = "#39d353";
const REST = "#f2cc60";

export class HandDrawing {
  // `shown` gives the element that shows the pictures.
  constructor(canvas, shown) {
    this.canvas = canvas;
    this.shown = shown;
    this.clear();
  }

  // What was found in a picture; see hri.serve.seen.
  see(seen) {
    this.seen = seen;
    this.draw();
  }

  // The event of a hand's place.
  heed(hand) {
    this.hand = hand;
    if (this.seen.outline.length === 0) this.draw();
  }

  clear() {
    this.seen = { outline: [], track: [], in_gesture: false };
    this.hand = { x: null };
    this.draw();
  }

  draw() {
    const { canvas, hand } = this;
    const video = this.shown();
    [canvas.width, canvas.height] = [canvas.clientWidth, canvas.clientHeight];
    if (!video.videoWidth) return;
    const { outline, track, in_gesture: inGesture } = this.seen;
    const scale = Math.min(canvas.width / video.videoWidth, canvas.height / video.videoHeight);
    const [width, height] = [scale * video.videoWidth, scale * video.videoHeight];
    const context = canvas.getContext("2d");
    context.translate((canvas.width - width) / 2, (canvas.height - height) / 2);
    const along = (points) => {
      context.beginPath();
      points.forEach(([x, y]) => context.lineTo(x * width, y * height));
    };
    [context.lineWidth, context.lineJoin] = [3, "round"];
    context.strokeStyle = context.fillStyle = inGesture || hand.in_gesture ? GESTURE : REST;
    if (outline.length) {
      along(outline);
      context.closePath();
      context.globalAlpha = 0.3;
      context.fill();
      context.globalAlpha = 1;
      context.stroke();
    } else if (hand.x !== null) {
      context.beginPath();
      context.arc(hand.x * width, hand.y * height, 6 + Math.sqrt((hand.area * width * height) / Math.PI), 0, 2 * Math.PI);
      context.stroke();
    }
    context.strokeStyle = "#ffffff";
    along(track);
    context.stroke();
  }
}
