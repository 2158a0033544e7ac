// SPDX-FileCopyrightText: The hri contributors
// SPDX-License-Identifier: Apache-2.0
// The browser's camera and microphone, each by itself: one that is missing leaves the other.
import { phrase } from "./phrases.js";

const RATE_HZ = 16000;
const MOST_HZ = 48000; // that the server takes
const FPS = 15;
const WIDTH_PX = 480;
const QUALITY = 0.85;

const CODES = {
  NotAllowedError: "not_allowed",
  NotFoundError: "not_found",
  NotReadableError: "in_use",
  OverconstrainedError: "not_suitable",
};

// What is wrong with the microphone or the camera, as a phrase.
export function whatIsWrong(error, what) {
  return phrase(CODES[error.name] ?? "broken", { device: phrase(what), detail: error.phrase ?? error.message });
}

async function media(constraints) {
  if (!navigator.mediaDevices) throw Object.assign(new Error(), { phrase: phrase("no_devices") });
  return navigator.mediaDevices.getUserMedia(constraints);
}

// The rate at which samples will come, and what gives the microphone back; onSamples gets an ArrayBuffer of 16-bit
// samples, onEnd is called when the microphone is unplugged.
export async function openMicrophone(onSamples, onEnd) {
  // The page's own voice is taken out of the sound where the browser can: else a STOP over it is lost.
  const processing = { echoCancellation: true, noiseSuppression: false, autoGainControl: false, channelCount: 1 };
  const stream = await media({ audio: processing });
  let context = new AudioContext({ sampleRate: RATE_HZ });
  const close = () => giveBack(stream, context);
  try {
    let source;
    try {
      source = context.createMediaStreamSource(stream);
    } catch { // a browser that does not convert rates: the server does
      await context.close();
      context = new AudioContext();
      source = context.createMediaStreamSource(stream);
    }
    await context.audioWorklet.addModule("sound.js");
    const step = Math.ceil(context.sampleRate / MOST_HZ);
    const oneChannel = { numberOfOutputs: 0, channelCount: 1, channelCountMode: "explicit" };
    const sender = new AudioWorkletNode(context, "sender", { ...oneChannel, processorOptions: { step } });
    sender.port.onmessage = (message) => onSamples(message.data);
    source.connect(sender);
    await context.resume();
    stream.getAudioTracks()[0].onended = onEnd;
    return { rate: Math.round(context.sampleRate / step), close, keep: [stream, source, sender] };
  } catch (error) {
    close();
    throw error;
  }
}

function giveBack(stream, context = null) {
  stream.getTracks().forEach((track) => track.stop());
  if (context && context.state !== "closed") context.close();
}

// What is shown, as a JPEG and when it was taken, some times a second until the answer is called; a picture that is still
// being made makes the next one wait. `size` gives width and height, or nothing where there is no picture yet.
export function takePictures(source, size, onPicture) {
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d", { willReadFrequently: true });
  let busy = false;
  let next = 0;
  const timer = setInterval(() => {
    const now = performance.now();
    const [full, high] = size() ?? [0, 0];
    if (busy || now < next || !full) return;
    next = Math.max(next + 1000 / FPS, now - 500 / FPS);
    const scale = Math.min(1, WIDTH_PX / full);
    const [width, height] = [Math.round(scale * full), Math.round(scale * high)];
    if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
    context.drawImage(source, 0, 0, width, height);
    busy = true;
    canvas.toBlob((blob) => { busy = false; if (blob) onPicture(blob, now); }, "image/jpeg", QUALITY);
  }, 10);
  return () => clearInterval(timer);
}

export const sizeOf = (video) => () => (video.readyState < 2 ? null : [video.videoWidth, video.videoHeight]);

// What gives the camera back; onEnd is called when it is unplugged.
export async function openCamera(video, onPicture, onEnd) {
  const stream = await media({ video: { width: { ideal: 640 }, height: { ideal: 480 }, frameRate: { ideal: 30 } } });
  try {
    video.srcObject = stream;
    await video.play();
  } catch (error) {
    giveBack(stream);
    throw error;
  }
  const end = takePictures(video, sizeOf(video), onPicture);
  stream.getVideoTracks()[0].onended = onEnd;
  return { close: () => { end(); giveBack(stream); } };
}
