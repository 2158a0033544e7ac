// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// Where the hand is in the camera's picture.
export function drawPlace(canvas, video, hand) {
  [canvas.width, canvas.height] = [canvas.clientWidth, canvas.clientHeight];
  if (hand.x === null || !video.videoWidth) return;
  const scale = Math.min(canvas.width / video.videoWidth, canvas.height / video.videoHeight);
  const [width, height] = [scale * video.videoWidth, scale * video.videoHeight];
  const context = canvas.getContext("2d");
  context.translate((canvas.width - width) / 2, (canvas.height - height) / 2);
  context.lineWidth = 3;
  context.strokeStyle = hand.in_gesture ? "#39d353" : "#f2cc60";
  context.beginPath();
  context.arc(hand.x * width, hand.y * height, 6 + Math.sqrt((hand.area * width * height) / Math.PI), 0, 2 * Math.PI);
  context.stroke();
}
