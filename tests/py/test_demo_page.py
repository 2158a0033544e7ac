# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The page of the demo: made of what the page of `hri serve` is made of, opened as a file, with hostile labels."""

from __future__ import annotations

import importlib
import json
import re
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("cv2")
pytest.importorskip("matplotlib")

import hri
from conftest import RATE_HZ, tone_word
from hri.demo.conversation import conversation, shown
from hri.demo.film import Answer
from hri.demo.page import make_page
from hri.demo.scenes import Scene, Script
from hri.demo.training import Trained
from hri.evaluation import EvaluationItem, EvaluationResult, FoldResult
from hri.fusion import RULES
from hri.media import Audio
from hri.page import COMPONENTS, component, in_one_file
from hri.synthetic.drawing.signer import make_signer
from hri.synthetic.signer import CLIP_FPS, draw_clip

HOSTILE = "</script><img src=x onerror=fail()>&amp;"
CHROMIUM = shutil.which("chromium")
FACTS = {
    "seed": 3,
    "backend": "kinematic",
    "num_words": 4,
    "num_voices": 2,
    "num_signs": 4,
    "num_signers": 2,
    "seconds": 1,
}


STILL = np.zeros((10, 10, 3), np.uint8)
ANSWERS = [Answer(STILL, True, True, 2.0), Answer(STILL), Answer(STILL)]


def decided(mode: str, label: str, confidence: float) -> hri.Decision:
    others = (hri.NBest(label, confidence, -1.0), hri.NBest(HOSTILE, 1 - confidence, -2.0))
    return hri.Decision(mode, label, "recognised", confidence, nbest=others, class_threshold=0.5)


def scene(word: str, sign: str, confidence: float = 0.9) -> Scene:
    speech, gesture = decided("speech", word, confidence), decided("gesture", sign, 0.8)
    by_rule = {rule: hri.fuse(speech, gesture, rule=rule) for rule in RULES}
    frames = draw_clip(make_signer(40, 1), "7", seed=1, size_px=(320, 240), num_frames=5)
    script = Script(f"{HOSTILE} {word}", f"Says “{HOSTILE}”", word, "en", sign)
    return Scene(script, Audio(tone_word(500, 100, 1), RATE_HZ), frames, CLIP_FPS, by_rule[RULES[0]], by_rule)


@pytest.fixture(scope="module")
def scenes() -> list[Scene]:
    return [scene("7", "7"), scene("stop", "5"), scene("stop", "5", 0.3)]


@pytest.fixture(scope="module")
def page(scenes: list[Scene], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The page as a file."""
    folder = tmp_path_factory.mktemp("demo")
    (folder / "film.webm").write_bytes(b"no film")
    item = EvaluationItem(0, "7", decided("speech", "7", 0.9))
    result = EvaluationResult(["7"], [FoldResult(HOSTILE, (item,))], {})
    trained = Trained(hri.WordRecognizer(), hri.GestureRecognizer(), result, result)
    text = make_page(scenes, ANSWERS, trained, folder / "film.webm", FACTS, lambda *_: None)
    (folder / "index.html").write_text(text, encoding="utf-8")
    return folder / "index.html"


def test_the_page_holds_everything_escaped(page: Path) -> None:
    text = page.read_text()
    assert re.findall(r'(?:src|href)="(?!data:)', text) == [] and "<img src=x" not in text
    assert text.count("</script>") == 2 and "&lt;/script&gt;&lt;img src=x" in text
    assert component("page.css").decode() in text
    data = json.loads(text.partition('id="scenes">')[2].partition("</script>")[0])
    assert data[0]["speech"][1]["label"] == HOSTILE
    assert 'from "./' not in text, "a module beside the page, which no browser loads from a file"


def test_components_of_the_demo_are_those_of_the_server() -> None:
    served = pytest.importorskip("hri.serve.app").page_files()
    for name in COMPONENTS:
        assert served[name] == component(name) and len(served[name]) > 100
    (whole,) = re.findall(
        r'"data:text/javascript;base64,([^"]+)"', in_one_file('import { Conversation } from "./conversation.js";')
    )
    import base64

    text = base64.b64decode(whole).decode()
    assert "export class Conversation" in text and 'from "data:text/javascript' in text  # what it imports, too


def test_a_scene_is_reported_as_by_a_session(scenes: list[Scene]) -> None:
    agree, stop, unsure = (
        [(e.event, e.fields.get("text", e.fields.get("label"))) for e in conversation(s, answer)]
        for s, answer in zip(scenes, ANSWERS, strict=True)
    )
    fell = conversation(scenes[0], Answer(STILL, True, False, 0.7, "fell while moving"))[-1]
    assert (fell.fields["completed"], fell.fields["message"]) == (False, "fell while moving")
    assert agree == [("fused", None), ("say", "7."), ("motion_end", "7")]
    assert stop == [("fused", None), ("stop", "stop")]
    assert unsure == [("fused", None), ("say", "Did you mean 5 or stop?")] or unsure[1][1].startswith("Did you mean")
    moves, rests = (shown(*both)["figures"] for both in zip(scenes[:2], ANSWERS[:2], strict=True))
    assert len(rests) == 1 and len(moves) > 10 and moves[0]["strokes"] != moves[len(moves) // 2]["strokes"]


@pytest.fixture
def browser() -> Iterator[Any]:
    pytest.importorskip("playwright")
    api: Any = importlib.import_module("playwright.sync_api")
    with api.sync_playwright() as started:
        opened = started.chromium.launch(executable_path=CHROMIUM, args=["--no-sandbox"])
        yield opened
        opened.close()


@pytest.mark.alone
@pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed: apt-get install chromium")
def test_it_opens_from_a_file_in_light_and_dark(browser: Any, page: Path) -> None:
    view = browser.new_context(viewport={"width": 360, "height": 740}).new_page()
    view.add_init_script("window.fail = () => { throw Error('a label has run') }")
    failures: list[str] = []
    view.on("pageerror", lambda error: failures.append(str(error)))
    view.on("console", lambda said: failures.append(said.text) if said.type == "error" else None)
    view.goto(page.as_uri())
    first = view.locator("[data-scene='0']")
    assert first.locator("[data-part=speech] li").all_inner_texts()[1].startswith(HOSTILE)
    assert (
        first.locator("[data-part=log]")
        .inner_text()
        .splitlines()[0]
        .startswith("You: 7 (word 7 90 % and sign 7 80 %).")
    )
    assert "Robot: 7." in first.locator("[data-part=log]").inner_text()
    assert "STOP stop" in view.locator("[data-scene='1'] [data-part=log]").inner_text()
    assert view.locator("[data-scene='1'] [data-part=play]").is_hidden()
    canvas, drawn = first.locator("canvas"), "canvas => canvas.toDataURL()"
    resting = canvas.evaluate(drawn)
    first.locator("[data-part=play]").focus()
    view.keyboard.press("Enter")
    view.wait_for_timeout(1000)
    assert canvas.evaluate(drawn) != resting
    assert view.evaluate("document.documentElement.scrollWidth") <= 360
    assert failures == []
    axe = pytest.importorskip("axe_playwright_python.sync_playwright").Axe()
    grounds = []
    for scheme in ("light", "dark"):
        view.emulate_media(color_scheme=scheme)
        grounds.append(view.evaluate("getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number)"))
        faults = axe.run(view).response["violations"]
        assert [(f["id"], f["nodes"][0]["html"]) for f in faults if f["impact"] in ("serious", "critical")] == []
    assert min(grounds[0]) > 200 and max(grounds[1]) < 60
