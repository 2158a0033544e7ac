// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// In the browser's thread of sound: samples as 16-bit numbers, 40 ms at a time; each is the mean of `step` of the
// microphone's, whose rate may be higher than the server takes.
class Sender extends AudioWorkletProcessor {
  constructor({ processorOptions }) {
    super();
    this.step = processorOptions.step;
    this.block = new Int16Array(Math.round(sampleRate / this.step / 25));
    this.filled = this.sum = this.summed = 0;
  }

  process(inputs) {
    const channel = inputs[0][0];
    if (!channel) return true; // the microphone gives nothing for now
    for (const sample of channel) {
      this.sum += sample;
      if (++this.summed < this.step) continue;
      this.block[this.filled++] = Math.max(-32768, Math.min(32767, Math.round((32768 * this.sum) / this.step)));
      this.sum = this.summed = 0;
      if (this.filled === this.block.length) {
        this.port.postMessage(this.block.slice().buffer);
        this.filled = 0;
      }
    }
    return true;
  }
}

registerProcessor("sender", Sender);
