# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Files that are chosen for the page, or dropped on it, in a browser: they are heard and seen as by its devices."""

from __future__ import annotations

import base64
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("browsing")

from browsing import MARKS, NARROW, expect, serious_faults
from conftest import RATE_HZ
from drawn_hands import FPS, stills
from hri.io import write_wav_pcm16
from hri.media import VideoWriter, write_image
from session_people import signing, speech

pytest_plugins = ("serving", "browsing")
pytestmark = MARKS

DROP = """(page, [selector, name, type, data]) => {
  const bytes = Uint8Array.from(atob(data), (letter) => letter.charCodeAt(0));
  const dropped = new DataTransfer();
  dropped.items.add(new File([bytes], name, { type }));
  document.querySelector(selector).dispatchEvent(
    new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer: dropped }));
}"""


def wav(path: Path, samples: np.ndarray, rate_hz: int = RATE_HZ) -> str:
    write_wav_pcm16(str(path), samples, rate_hz)
    return str(path)


def drop(page: Any, selector: str, path: str, kind: str) -> None:
    data = base64.b64encode(Path(path).read_bytes()).decode()
    page.locator("body").evaluate(DROP, [selector, Path(path).name, kind, data])


def test_a_sound_that_is_dropped_is_decided_on_and_stop_in_another_stops(
    visit: Any, robot: Any, tmp_path: Path
) -> None:
    page = visit(**NARROW)
    drop(page, "h1", wav(tmp_path / "tall.wav", np.repeat(speech([("tall", 0.4)], 1.6), 3), 3 * RATE_HZ), "audio/wav")
    expect(page, "#decided").to_have_text("tall")
    expect(page, "#log").to_contain_text("The robot moves: tall")
    expect(page, "#files [role=status]").to_have_text("Played to the end.")
    assert page.evaluate("document.documentElement.scrollWidth") <= 360 and serious_faults(page) == []
    page.set_input_files("#source-file", wav(tmp_path / "stop.wav", speech([("stop", 0.4)], 1.6)))
    expect(page, "#state").to_have_text("stopped")
    assert robot.stopped and page.failures == []


def test_a_picture_and_a_video_are_seen(visit: Any, tmp_path: Path) -> None:
    page = visit()
    write_image(tmp_path / "flat.png", stills("flat", 40)[len(stills("flat", 40)) // 2])
    page.set_input_files("#source-file", str(tmp_path / "flat.png"))
    expect(page, "#files [role=status]").to_have_text("flat.png is played …")
    expect(page, "#stage").to_have_class("stage file")
    expect(page, "#decided").to_have_text("flat")
    expect(page, "#stage").to_have_class("stage")
    with VideoWriter(tmp_path / "tall.webm", FPS) as film:
        for frame in signing([("tall", 0.8)], 4.0):
            film.write(frame)
    page.set_input_files("#source-file", str(tmp_path / "tall.webm"))
    expect(page, "#decided").to_have_text("tall")
    expect(page, "#files [role=status]").to_have_text("Played to the end.")
    assert page.failures == []


RECORD = """async () => {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [64, 64];
  const context = canvas.getContext("2d");
  const recorder = new MediaRecorder(canvas.captureStream(15), { mimeType: "video/webm" });
  const parts = [];
  recorder.ondataavailable = (part) => parts.push(part.data);
  recorder.start(200);
  for (let i = 0; i < 20; i++) {
    context.fillRect(0, 0, 3 * i, 3 * i);
    await new Promise((done) => setTimeout(done, 60));
  }
  const stopped = new Promise((done) => (recorder.onstop = done));
  recorder.stop();
  await stopped;
  const file = new File(parts, "recorded.webm", { type: "video/webm" });
  const clip = document.createElement("video");
  clip.src = URL.createObjectURL(file);
  await new Promise((done) => (clip.onloadedmetadata = done));
  const dropped = new DataTransfer();
  dropped.items.add(file);
  document.body.dispatchEvent(new DragEvent("drop", { bubbles: true, cancelable: true, dataTransfer: dropped }));
  return clip.duration === Infinity;
}"""


def test_a_video_that_a_browser_has_recorded_is_played(visit: Any) -> None:
    page = visit()
    assert page.evaluate(RECORD)
    said = "#files [role=status]"
    expect(page, said).to_have_text("recorded.webm is played …")
    expect(page, said).to_have_text("Played to the end.")
    assert page.failures == []


def test_a_sound_and_a_video_that_come_together_are_one_command(visit: Any, tmp_path: Path) -> None:
    page = visit()
    with VideoWriter(tmp_path / "tall.webm", FPS) as film:
        for frame in signing([("tall", 0.6)], 4.0):
            film.write(frame)
    sound = wav(tmp_path / "tall.wav", speech([("tall", 1.0)], 4.0))
    page.set_input_files("#source-file", [sound, str(tmp_path / "tall.webm")])
    expect(page, "#log").to_contain_text("and sign tall")
    assert page.failures == []


def test_what_cannot_be_played_is_said_in_plain_words(visit: Any, tmp_path: Path) -> None:
    page = visit()
    said = "#files [role=status]"
    (tmp_path / "letter.txt").write_text("Dear robot")
    page.set_input_files("#source-file", str(tmp_path / "letter.txt"))
    expect(page, said).to_have_text("letter.txt is no sound, video or picture.")
    for name in ("noise.wav", "noise.webm", "noise.png"):
        (tmp_path / name).write_bytes(bytes(range(256)) * 20)
        page.set_input_files("#source-file", str(tmp_path / name))
        expect(page, said).to_contain_text(f"This browser cannot play {name}: it may be damaged")
    (tmp_path / "big.wav").write_bytes(bytes(33 << 20))
    page.set_input_files("#source-file", str(tmp_path / "big.wav"))
    expect(page, said).to_have_text("big.wav: a file of more than 32 MB is too large")
    page.set_input_files("#source-file", wav(tmp_path / "long.wav", np.zeros(130 * 8000, np.float32), 8000))
    expect(page, said).to_contain_text("long.wav is longer than 120 seconds")
    page.set_input_files("#source-file", [wav(tmp_path / "a.wav", np.zeros(8000, np.float32))] * 11)
    expect(page, said).to_have_text("Choose 10 files at most.")
    page.set_input_files("#source-file", wav(tmp_path / "quiet.wav", np.zeros(20 * RATE_HZ, np.float32)))
    expect(page, said).to_have_text("quiet.wav is played …")
    page.set_input_files("#source-file", str(tmp_path / "a.wav"))
    expect(page, said).to_contain_text("Wait until the other file has been played")
    page.click("#stop")
    expect(page, said).to_have_text("STOP: nothing more is played.")
    page.select_option("#language", "hi")
    expect(page, said).to_contain_text("अब और कुछ नहीं चलाया जाएगा")
    assert page.failures == []


def test_samples_of_a_gesture_are_not_played(visit: Any, tmp_path: Path) -> None:
    page = visit()
    write_image(tmp_path / "one.png", stills("flat", 41)[0])
    drop(page, "[data-teach=gesture]", str(tmp_path / "one.png"), "image/png")
    expect(page, "#gesture-line").to_have_text("First give the gesture a name.")
    expect(page, "#files [role=status]").to_be_empty()
    assert page.failures == []
