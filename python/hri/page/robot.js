// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The robot from the front, on a canvas, and the angles of its joints in a list; see hri.page.figure.
export function drawRobot(canvas, list, robot) {
  const context = canvas.getContext("2d");
  const scale = (0.94 * canvas.height) / robot.height;
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.setTransform(scale, 0, 0, -scale, canvas.width / 2, 0.97 * canvas.height);
  for (const [x1, y1, x2, y2, width, colour, round] of robot.strokes) {
    context.lineCap = round ? "round" : "butt";
    for (const [lineWidth, style] of [[width + 0.006, "#30363d"], [width, colour]]) {
      context.lineWidth = lineWidth;
      context.strokeStyle = style;
      context.beginPath();
      context.moveTo(x1, y1);
      context.lineTo(x2, y2 + (x1 === x2 && y1 === y2 ? 1e-4 : 0)); // a point has no line to draw
      context.stroke();
    }
  }
  const names = Object.keys(robot.joints);
  if (list.children.length !== names.length) list.replaceChildren(...names.map(() => document.createElement("li")));
  names.forEach((name, i) => (list.children[i].textContent = `${name}: ${robot.joints[name].toFixed(1)}°`));
}
