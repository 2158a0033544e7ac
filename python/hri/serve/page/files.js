// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// Files in place of the devices: a sound is heard as if the microphone gave it, a video or a picture is seen as if the
// camera did. One of each kind at a time, both at once where both are given.
import { sizeOf, takePictures } from "./devices.js";
import { phrase, put } from "./phrases.js";

const MOST_BYTES = 32 * 2 ** 20;
const MOST_FILES = 10;
const LONGEST_S = 120;
const BLOCK_S = 0.04;
const BEFORE_S = 0.8; // in which a source that has vanished is opened again
const AFTER_S = 1.5; // in which a word or a sign ends
const HELD_S = 2.5; // a picture
const EMPTY = "#808080";

export class FilePlayer {
  constructor(part, link, stage) {
    [this.input, this.line] = [part.querySelector("input"), part.querySelector("[role=status]")];
    this.link = link;
    this.stage = stage;
    this.clip = stage.querySelector("[data-part=clip]");
    this.knows = { speech: false, gesture: false };
    this.busy = this.sounds = this.shows = false;
    this.input.addEventListener("change", async () => {
      await this.play([...this.input.files]);
      this.input.value = "";
    });
    document.addEventListener("dragover", (over) => over.preventDefault());
    document.addEventListener("drop", (dropped) => {
      if (dropped.defaultPrevented) return; // samples of a gesture
      dropped.preventDefault();
      this.play([...dropped.dataTransfer.files]);
    });
  }

  async play(files) {
    const wrong = this.busy ? phrase("file_waits") : files.map((file) => this.fault(file)).find(Boolean);
    const tooMany = files.length > MOST_FILES && phrase("too_many_files", { most: MOST_FILES });
    if (wrong || tooMany || files.length === 0) return wrong || tooMany ? put(this.line, wrong || tooMany) : null;
    this.busy = true;
    this.halted = false;
    const of = (isSound) => files.filter((file) => file.type.startsWith("audio/") === isSound);
    const rows = [of(true), of(false)].filter((row) => row.length);
    this.together = meeting(rows.length);
    const failed = await Promise.all(rows.map((row) => this.inTurn(row)));
    this.busy = false;
    put(this.line, failed.find(Boolean) ?? phrase(this.halted ? "files_halted" : "files_played"));
  }

  // STOP: nothing more is played.
  halt() {
    this.halted = true;
  }

  fault(file) {
    const name = file.name;
    const kind = file.type.split("/")[0];
    if (!this.link.isOpen) return phrase("file_lost", { name });
    if (!["audio", "video", "image"].includes(kind)) return phrase("file_kind", { name });
    if (file.size > MOST_BYTES) return phrase("file_large", { name, most: MOST_BYTES / 2 ** 20 });
    if (kind === "audio" && !this.knows.speech) return phrase("no_words_here", { name });
    if (kind !== "audio" && !this.knows.gesture) return phrase("no_signs_here", { name });
    return null;
  }

  // What went wrong with one of them, or nothing.
  async inTurn(files) {
    for (const file of files) {
      if (this.halted) return null;
      put(this.line, phrase("file_is_played", { name: file.name }));
      try {
        const kind = file.type.split("/")[0];
        const wrong = await { audio: () => this.hear(file), video: () => this.film(file), image: () => this.show(file) }[kind]();
        if (wrong) return wrong;
      } catch {
        return phrase("file_unreadable", { name: file.name });
      } finally {
        this.together.arrive(); // one that failed keeps no other waiting
        if (file.type.startsWith("audio/")) this.sounds = false;
        else this.endPictures();
      }
    }
    return null;
  }

  async hear(file) {
    const rate = this.link.rate;
    const sound = await new OfflineAudioContext(1, 1, rate).decodeAudioData(await file.arrayBuffer());
    if (sound.duration > LONGEST_S) return phrase("file_long", { name: file.name, most: LONGEST_S });
    const samples = new Int16Array(Math.round((BEFORE_S + AFTER_S) * rate) + sound.length);
    const first = Math.round(BEFORE_S * rate);
    const channels = Array.from({ length: sound.numberOfChannels }, (_, i) => sound.getChannelData(i));
    for (let i = 0; i < sound.length; i++) {
      const mean = channels.reduce((sum, channel) => sum + channel[i], 0) / channels.length;
      samples[first + i] = Math.max(-32768, Math.min(32767, Math.round(32768 * mean)));
    }
    await this.together.arrive();
    this.sounds = true;
    const block = Math.round(BLOCK_S * rate);
    const begun = performance.now();
    let sent = 0;
    while (sent < samples.length && !this.halted) {
      const due = Math.min(samples.length, ((performance.now() - begun) / 1000) * rate);
      for (; sent + block <= due || (due === samples.length && sent < due); sent += block) {
        this.link.sound(samples.slice(sent, sent + block).buffer);
      }
      await pause(BLOCK_S / 2);
    }
    return null;
  }

  async film(file) {
    const address = URL.createObjectURL(file);
    try {
      this.clip.src = address;
      await ready(this.clip);
      const { duration } = this.clip; // infinite in what a browser has recorded: such a file ends by the clock
      const tooLong = Number.isFinite(duration) && duration > LONGEST_S;
      if (tooLong) return phrase("file_long", { name: file.name, most: LONGEST_S });
      await this.together.arrive();
      this.beginPictures(this.clip, sizeOf(this.clip));
      await pause(BEFORE_S);
      await this.clip.play();
      const end = performance.now() + 1000 * LONGEST_S;
      while (!this.clip.ended && !this.halted && performance.now() < end) await pause(BLOCK_S);
      await pause(AFTER_S);
    } finally {
      this.clip.pause();
      this.clip.removeAttribute("src");
      URL.revokeObjectURL(address);
    }
    return null;
  }

  // As the camera would see a sign that comes into view and goes.
  async show(file) {
    const picture = await createImageBitmap(file);
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [picture.width, picture.height];
    const context = canvas.getContext("2d");
    const clear = () => {
      context.fillStyle = EMPTY;
      context.fillRect(0, 0, canvas.width, canvas.height);
    };
    clear();
    this.clip.srcObject = canvas.captureStream(15);
    await this.clip.play();
    await this.together.arrive();
    this.beginPictures(canvas, () => [canvas.width, canvas.height]);
    await pause(BEFORE_S);
    context.drawImage(picture, 0, 0);
    for (let s = 0; s < HELD_S && !this.halted; s += BLOCK_S) await pause(BLOCK_S);
    clear();
    await pause(AFTER_S);
    return null;
  }

  beginPictures(source, size) {
    this.shows = true;
    this.stage.classList.add("file");
    this.endTaking = takePictures(source, size, (blob, takenMs) => this.link.picture(blob, takenMs));
  }

  endPictures() {
    this.endTaking?.();
    this.endTaking = null;
    this.shows = false;
    this.stage.classList.remove("file");
    this.clip.srcObject = null;
  }
}

// Lets so many begin at the same time: each has to be read first, which takes its time.
function meeting(number) {
  let here = 0;
  let begin;
  const all = new Promise((done) => (begin = done));
  return {
    arrive() {
      here += 1;
      if (here >= number) begin();
      return all;
    },
  };
}

const pause = (seconds) => new Promise((done) => setTimeout(done, 1000 * seconds));

function ready(video) {
  return new Promise((done, fail) => {
    [video.onloadeddata, video.onerror] = [done, fail];
    video.load();
  });
}
