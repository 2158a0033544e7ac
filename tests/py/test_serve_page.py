# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What the page says, shows and takes, in a real browser: its languages, its voice, hands, possibilities, files."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("browsing")

from browsing import MARKS, NARROW, await_motion, expect, serious_faults
from hri.io import model_as_cpp, model_as_json
from hri.serve import PageServer, Stage
from session_people import MOTIONS, signing, speech

pytest_plugins = ("serving", "browsing")
pytestmark = MARKS


def test_the_page_speaks_hindi_and_english_and_remembers_which(visit: Any) -> None:
    page = visit(speech([("tall", 1.6)], 12.0), locale="hi-IN", **NARROW)
    expect(page, "html").to_have_attribute("lang", "hi")
    expect(page, "#state").to_have_text("ख़ाली")
    expect(page, "#start").to_have_text("कैमरा और माइक्रोफ़ोन चालू करें")
    page.click("#start")
    expect(page, "#log").to_contain_text("रोबोट चला: tall")
    expect(page, "#said").to_have_text("tall।")
    page.click("#stop")
    expect(page, "#log").to_contain_text("STOP: बटन दबाया गया।")
    page.fill("#word", "tall")
    page.press("#word", "Enter")
    expect(page, "#word-line").to_have_text("“tall” नाम का शब्द पहले से है")
    shown = page.inner_text("body")
    for text in ("हिन्दी", "English", "STOP", "JSON", "HOAP-2", "tall", "flat", "stop", "hri", "JSGF", "C++"):
        shown = shown.replace(text, "")
    assert [word for word in re.findall("[A-Za-z]{2,}", shown) if "joint" not in word] == []
    assert page.evaluate("document.documentElement.scrollWidth") <= 360
    assert serious_faults(page) == []
    page.select_option("#language", "en")
    expect(page, "html").to_have_attribute("lang", "en")
    expect(page, "#log").to_contain_text("The robot moves: tall")
    expect(page, "#word-line").to_have_text("“tall” is a word already")
    assert page.title() == "hri: command a robot"
    assert not re.search("[\u0900-\u097f]", page.inner_text("body").replace("हिन्दी", ""))
    page.reload()
    expect(page, "#state").to_have_text("stopped")
    assert page.get_attribute("html", "lang") == "en" and page.input_value("#language") == "en"
    assert page.failures == []


VOICES = """
  const said = (line) => {
    const page = document.documentElement.dataset;
    page.said = `${page.said ?? ""}${line};`;
  };
  const voices = ["en-GB", "hi-IN"].map((lang) => ({ lang, name: lang }));
  window.SpeechSynthesisUtterance = class { constructor(text) { this.text = text; } };
  const synthesis = Object.assign(new EventTarget(), {
    getVoices: () => voices,
    speak: (words) => { said(`${words.lang} ${words.text}`); setTimeout(() => words.onend(), 1500); },
    cancel: () => said("cancel"),
  });
  Object.defineProperty(window, "speechSynthesis", { value: synthesis });
"""


def test_the_robot_speaks_in_the_language_of_the_page(visit: Any, stage: Any, robot: Any) -> None:
    page = visit(speech([("tall", 1.6)], 14.0), script=VOICES, locale="hi-IN")
    expect(page, "#voice").to_be_checked()
    page.click("#start")
    expect(page, "#state").to_have_attribute("data-state", "acting")
    expect(page, "html").to_have_attribute("data-said", re.compile("^hi-IN tall।;"))
    page.keyboard.press("Escape")
    expect(page, "#state").to_have_attribute("data-state", "stopped")
    assert robot.stopped
    page.select_option("#language", "en")
    page.click("#resume")
    expect(page, "html").to_have_attribute("data-said", re.compile(r"en-GB Ready\.;"))
    page.uncheck("#voice")
    page.reload()
    expect(page, "#voice").not_to_be_checked()
    assert page.failures == []


def test_stop_that_is_said_while_the_page_speaks_is_heeded_and_another_word_is_not(
    visit: Any, words: Any, robot: Any
) -> None:
    long = VOICES.replace("1500", 'words.text.startsWith("flat") ? 14000 : 100')
    asked = """
      const media = navigator.mediaDevices, ask = media.getUserMedia.bind(media);
      media.getUserMedia = (wanted) => {
        if (wanted.audio) document.documentElement.dataset.echo = wanted.audio.echoCancellation;
        return ask(wanted);
      };
    """
    said = speech([("flat", 1.6), ("tall", 5.2), ("stop", 8.4)], 14.0)
    stage = Stage(words, None, robot, motions=MOTIONS)  # without a camera, which a word may have to wait for
    try:
        with PageServer(stage) as server:
            page = visit(said, at=server, script=long + asked)
            page.click("#start")
            await_motion(page, "flat")
            expect(page, "html").to_have_attribute("data-said", re.compile(r"en-GB flat\.;"))
            expect(page, "html").to_have_attribute("data-echo", "true")
            expect(page, "#log").to_contain_text("Ignored tall: heard while the robot speaks.")
            expect(page, "#log").to_contain_text("STOP stop: stop: recognised in speech.")
            expect(page, "#state").to_have_text("stopped")
            assert robot.stopped and page.failures == []
    finally:
        stage.close()


def test_a_browser_without_a_voice_has_the_switch_off(visit: Any) -> None:
    page = visit(script="Object.defineProperty(window, 'speechSynthesis', { value: undefined });")
    expect(page, "#voice").to_be_disabled()
    expect(page, "#voice").not_to_be_checked()
    assert page.failures == []


def test_bars_show_and_say_possibility_and_necessity(visit: Any) -> None:
    page = visit(speech([("tall", 1.6)], 12.0), **NARROW)
    page.click("#start")
    best, second = (page.locator(f"#bars-speech li:nth-child({number})") for number in (1, 2))
    expect(page, "#bars-speech li:first-child small").to_have_text(re.compile(r"^possibility 100 %, necessity \d+ %$"))
    (shown,) = re.findall(r"necessity (\d+) %", best.inner_text())
    assert abs(100 * float(best.evaluate("row => row.style.getPropertyValue('--necessity')")) - int(shown)) <= 0.5
    assert float(best.evaluate("row => row.style.getPropertyValue('--possibility')")) == 1.0
    assert "necessity 0 %" in second.inner_text()
    assert page.evaluate("document.documentElement.scrollWidth") <= 360 and serious_faults(page) == []
    page.select_option("#language", "hi")
    expect(page, "#bars-speech li:first-child small").to_have_text(re.compile("^संभावना 100 %"))
    assert page.failures == []


def test_the_hand_is_drawn_into_the_picture(visit: Any) -> None:
    page = visit(shown=signing([("tall", 0.8)], 4.0))
    page.click("#start")
    expect(page, "#bars-gesture").to_contain_text("tall")
    drawn = """() => { const canvas = document.getElementById("place");
        const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
        return data.filter((value, i) => i % 4 === 3 && value > 0).length; }"""
    most = 0
    for _ in range(60):
        most = max(most, page.evaluate(drawn))
        page.wait_for_timeout(50)
    assert most > 500, "an area, not only a line"
    assert page.failures == []


def test_stop_that_is_said_stops_the_robot_in_mid_motion(visit: Any, robot: Any) -> None:
    page = visit(speech([("tall", 5.0), ("stop", 8.0)], 14.0))
    page.click("#start")
    await_motion(page, "tall")
    expect(page, "#log").to_contain_text("STOP stop: stop: recognised in speech.")
    expect(page, "#log").to_contain_text("The robot begins to stop")
    expect(page, "#log").to_contain_text("The robot has stopped: tall")
    expect(page, "#state").to_have_text("stopped")
    expect(page, "#resume").to_be_enabled()
    assert robot.stopped and page.failures == []


def test_models_are_downloaded_as_files_json_and_cpp(visit: Any, stage: Stage) -> None:
    page = visit()
    for name, recognizer in (("words", stage.words), ("signs", stage.signs)):
        assert recognizer is not None
        got = {}
        for form in ("hri", "json", "hpp"):
            with page.expect_download() as download:
                page.click(f'a[href="{name}.{form}"]')
            assert download.value.suggested_filename == f"{name}.{form}"
            got[form] = Path(download.value.path()).read_bytes()
        file = recognizer.to_model_file()
        assert got["hri"] == file.to_bytes() and got["json"].decode() == model_as_json(file)
        assert got["hpp"].decode() == model_as_cpp(file, name) and b"#pragma once" in got["hpp"]
    assert page.failures == []
