# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What tests of the page in a real browser have in common: a plugin of pytest, beside `serving`.

The browser's camera and microphone play what a test gives it.
"""

from __future__ import annotations

import importlib
import shutil
from collections.abc import Callable, Iterator
from copy import copy
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("serving")
pytest.importorskip("playwright")

import hri
from conftest import RATE_HZ
from drawn_hands import FPS, Frame, stills
from hri.io import write_wav_pcm16
from hri.robot import Robot
from hri.serve import PageServer, Stage
from session_people import MOTIONS

api: Any = importlib.import_module("playwright.sync_api")
CHROMIUM = shutil.which("chromium")
WAIT_MS = 30_000
MARKS = [
    pytest.mark.alone,
    pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed: apt-get install chromium"),
]
NARROW: dict[str, Any] = {"viewport": {"width": 360, "height": 740}, "color_scheme": "dark"}


@pytest.fixture(scope="module")
def signs() -> hri.GestureRecognizer:
    """Trained on pictures as they are, and as they come from the browser."""
    rows = [(stills(sign, seed), sign, f"p{seed % 3}") for seed in range(8) for sign in ("flat", "tall")]
    rows += [([coded(frame) for frame in clip], sign, person) for clip, sign, person in rows]
    x, y, persons = map(list, zip(*rows, strict=True))
    return hri.GestureRecognizer(false_reject_rate=0.0).fit(x, y, groups=persons)


def coded(frame: Frame) -> Frame:
    """As raw video and as JPEG."""
    import cv2

    video = cv2.cvtColor(cv2.cvtColor(frame, cv2.COLOR_BGR2YUV_I420), cv2.COLOR_YUV2BGR_I420)
    picture = cv2.imdecode(cv2.imencode(".jpg", video, [cv2.IMWRITE_JPEG_QUALITY, 85])[1], cv2.IMREAD_COLOR)
    return np.asarray(picture, dtype=np.uint8)


@pytest.fixture(scope="module")
def playwright() -> Iterator[Any]:
    api.expect.set_options(timeout=WAIT_MS)
    with api.sync_playwright() as started:
        yield started


@pytest.fixture
def stage(words: Any, signs: Any, robot: Robot) -> Iterator[Stage]:
    made = Stage(copy(words), signs, robot, motions=MOTIONS)
    yield made
    made.close()


@pytest.fixture
def visit(playwright: Any, server: PageServer, tmp_path: Path) -> Iterator[Callable[..., Any]]:
    """Opens the page in a browser whose microphone and camera play, over and over, what is given."""
    opened = []

    def open_page(
        said: np.ndarray | None = None,
        shown: list[Frame] | None = None,
        fake_permission: bool = True,
        at: PageServer | None = None,
        script: str = "",
        **context: Any,
    ) -> Any:
        arguments = ["--no-sandbox", "--use-fake-device-for-media-stream"]
        if fake_permission:
            arguments.append("--use-fake-ui-for-media-stream")
        samples = np.zeros(RATE_HZ, np.float32) if said is None else said
        write_wav_pcm16(str(tmp_path / "said.wav"), samples, RATE_HZ)
        arguments.append(f"--use-file-for-fake-audio-capture={tmp_path / 'said.wav'}")
        if shown is not None:
            write_y4m(tmp_path / "shown.y4m", shown)
            arguments.append(f"--use-file-for-fake-video-capture={tmp_path / 'shown.y4m'}")
        browser = playwright.chromium.launch(executable_path=CHROMIUM, args=arguments)
        opened.append(browser)
        page = browser.new_context(**context).new_page()
        page.set_default_timeout(WAIT_MS)
        page.failures = []
        page.on("pageerror", lambda error: page.failures.append(str(error)))
        page.add_init_script(script)
        page.goto((at or server).address)
        api.expect(page.locator("#state")).not_to_have_text("not connected")
        return page

    yield open_page
    for browser in opened:
        browser.close()


def write_y4m(path: Path, frames: list[Frame]) -> None:
    """Frames as raw video, which Chromium's camera plays."""
    import cv2

    height, width = frames[0].shape[:2]
    parts = [f"YUV4MPEG2 W{width} H{height} F{FPS:.0f}:1 Ip A1:1 C420jpeg\n".encode()]
    for frame in frames:
        parts += [b"FRAME\n", cv2.cvtColor(frame, cv2.COLOR_BGR2YUV_I420).tobytes()]
    path.write_bytes(b"".join(parts))


def expect(page: Any, selector: str) -> Any:
    return api.expect(page.locator(selector))


def await_motion(page: Any, label: str) -> None:
    """Until the robot moves for a word: where the microphone's loop began with STOP, Resume is pressed."""
    for _ in range(2 * WAIT_MS // 500):
        if f"The robot moves: {label}" in page.inner_text("#log"):
            return
        if page.is_enabled("#resume"):
            page.click("#resume")
        page.wait_for_timeout(500)
    raise AssertionError(page.inner_text("#log"))


def serious_faults(page: Any) -> list[tuple[str, str]]:
    """What axe-core finds that keeps people out."""
    axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
    faults = axe.run(page).response["violations"]
    return [(f["id"], f["nodes"][0]["html"]) for f in faults if f["impact"] in ("serious", "critical")]
