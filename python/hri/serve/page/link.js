// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The web socket: sound is always sent, pictures only while the line is free; a lost line is opened again.
const SOUND = 1;
const PICTURE = 2;
const MOST_WAITING_BYTES = 200000;
// Final ones, by the code of the close.
const REFUSALS = { 1008: "sent_away", 4400: "hello_refused", 4409: "elsewhere", 4415: "rate_refused" };
const LONGEST_PAUSE_MS = 5000;
const STOP_MS = 1500;

export class Link {
  constructor(onMessage, onState) {
    this.page = sessionStorage.page ??= crypto.randomUUID(); // the same after the page is loaded again
    this.rate = 16000;
    this.onMessage = onMessage;
    this.onState = onState;
    this.pause = 250;
    this.socket = null;
  }

  open() {
    clearTimeout(this.timer);
    this.onState("connecting", "");
    const socket = (this.socket = new WebSocket(`ws://${location.host}/talk`));
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.say({ type: "hello", page: this.page, rate: this.rate });
    socket.onmessage = (message) => {
      this.pause = 250;
      this.onMessage(JSON.parse(message.data));
    };
    socket.onclose = (closed) => {
      if (socket !== this.socket) return;
      if (closed.code in REFUSALS) return this.onState("refused", REFUSALS[closed.code]);
      this.onState("lost", closed.code === 1009 ? "line_lost_large" : "line_lost");
      this.timer = setTimeout(() => this.open(), this.pause);
      this.pause = Math.min(2 * this.pause, LONGEST_PAUSE_MS);
    };
  }

  get isOpen() {
    return this.socket?.readyState === WebSocket.OPEN;
  }

  say(command) {
    if (this.isOpen) this.socket.send(JSON.stringify(command));
  }

  // STOP goes by two ways: the line may be lost, or full. Whether it has arrived; a server that hangs does not answer.
  stop() {
    this.say({ type: "stop" });
    const signal = AbortSignal.timeout?.(STOP_MS);
    return fetch("stop", { method: "POST", signal }).then((answer) => answer.ok, () => false);
  }

  sound(samples) {
    if (this.isOpen) this.socket.send(framed(SOUND, performance.now(), samples));
  }

  async picture(blob, takenMs) {
    const jpeg = await blob.arrayBuffer();
    if (this.isOpen && this.socket.bufferedAmount < MOST_WAITING_BYTES) this.socket.send(framed(PICTURE, takenMs, jpeg));
  }
}

function framed(kind, timeMs, data) {
  const message = new Uint8Array(9 + data.byteLength);
  const view = new DataView(message.buffer);
  view.setUint8(0, kind);
  view.setFloat64(1, timeMs, true);
  message.set(new Uint8Array(data), 9);
  return message;
}
