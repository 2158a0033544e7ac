# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The page's camera and microphone in a real browser: each is opened once, and given back when it is unplugged."""

from __future__ import annotations

from typing import Any

import pytest

pytest.importorskip("browsing")

from browsing import MARKS, WAIT_MS, expect
from hri.serve import PageServer, ServeLimits, Stage
from session_people import signing, speech

pytest_plugins = ("serving", "browsing")
pytestmark = MARKS

WATCH = """
  window.made = { streams: [], contexts: [] };
  const media = navigator.mediaDevices, ask = media.getUserMedia.bind(media);
  media.getUserMedia = async (wanted) => {
    const stream = await ask(wanted);
    made.streams.push(stream);
    return stream;
  };
  const Real = window.AudioContext;
  window.AudioContext = class extends Real {
    constructor(options) { super(options); made.contexts.push(this); }
  };
"""
COUNT = """() => [made.streams.filter((s) => s.getAudioTracks().length).length,
  made.streams.filter((s) => s.getVideoTracks().length).length,
  made.contexts.filter((c) => c.state !== "closed").length]"""
UNPLUG = """(kind) => {
  const tracks = made.streams.flatMap((stream) => stream.getTracks()).filter((track) => track.kind === kind);
  tracks.at(-1).dispatchEvent(new Event("ended"));
}"""


def await_opened(page: Any, counts: list[int]) -> None:
    """Until so many microphones and cameras were asked for, and so many contexts are open; the page allows no eval."""
    for _ in range(WAIT_MS // 50):
        if page.evaluate(COUNT) == counts:
            return
        page.wait_for_timeout(50)
    raise AssertionError(page.evaluate(COUNT))


def test_start_opens_only_what_is_not_open(visit: Any) -> None:
    page = visit(script=WATCH)
    page.click("#start")
    expect(page, "#camera-line").to_have_text("Camera: on")
    expect(page, "#start").to_be_disabled()
    await_opened(page, [1, 1, 1])
    page.evaluate(UNPLUG, "video")
    expect(page, "#problems").to_contain_text("The camera was unplugged")
    expect(page, "#camera-line").to_have_text("Camera: off")
    page.click("#start")
    expect(page, "#camera-line").to_have_text("Camera: on")
    expect(page, "#problems").to_be_empty()
    await_opened(page, [1, 2, 1])  # the microphone goes on
    page.evaluate(UNPLUG, "audio")
    expect(page, "#problems").to_contain_text("The microphone was unplugged")
    await_opened(page, [1, 2, 0])
    assert page.evaluate("made.streams[0].getTracks().every((track) => track.readyState === 'ended')")
    page.click("#start")
    await_opened(page, [2, 2, 1])
    expect(page, "#level-label").to_have_text("Microphone: on")
    expect(page, "#start").to_be_disabled()
    assert page.failures == []


REFUSE = """
  const media = navigator.mediaDevices, ask = media.getUserMedia.bind(media);
  media.getUserMedia = async (wanted) => {
    if (wanted.%s && !window.plugged) throw new DOMException("said by the browser", "%s");
    return ask(wanted);
  };
"""


@pytest.mark.parametrize(
    ("error", "said"),
    [
        ("NotFoundError", "No {} was found. Plug one in and press Start again."),
        ("NotReadableError", "Another program uses the {}. Close that program and press Start again."),
    ],
)
@pytest.mark.parametrize(("kind", "device"), [("video", "camera"), ("audio", "microphone")])
def test_a_device_that_is_missing_or_in_use_is_said_and_the_other_goes_on(
    visit: Any, kind: str, device: str, error: str, said: str
) -> None:
    shown = signing([("tall", 1.2)], 4.0)
    page = visit(speech([("tall", 1.6)], 4.0), shown, script=REFUSE % (kind, error))
    page.click("#start")
    expect(page, "#problems").to_have_text(said.format(device))
    expect(page, "#decided").to_have_text("tall")  # by the other device
    expect(page, "#camera-line" if kind == "video" else "#level-label").to_have_text(f"{device.capitalize()}: off")
    expect(page, "#start").to_be_enabled()
    page.evaluate("window.plugged = true")
    page.click("#start")
    expect(page, "#problems").to_be_empty()
    expect(page, f"#bars-{'gesture' if kind == 'video' else 'speech'} li:first-child").to_contain_text("tall")
    assert page.failures == []


def test_start_waits_for_the_welcome(visit: Any, server: PageServer) -> None:
    page = visit(speech([("tall", 1.6)], 12.0))
    expect(page, "#start").to_be_enabled()
    second = page.context.new_page()
    second.goto(f"http://127.0.0.1:{server.port}/")
    expect(second, "#problems").to_contain_text("Another page uses the robot now")
    expect(second, "#start").to_be_disabled()
    assert page.failures == []


def test_stop_is_shown_as_done_only_once_it_has_arrived(visit: Any, robot: Any) -> None:
    page = visit()
    page.route("**/stop", lambda route: None)  # the server hangs
    page.evaluate("WebSocket.prototype.send = () => {}")
    page.click("#stop")
    expect(page, "#state").to_have_text("stopping …")
    expect(page, "#problems").to_contain_text("STOP did not reach hri serve")
    expect(page, "#state").to_have_text("idle")
    assert not robot.stopped
    page.unroute("**/stop")
    page.click("#stop")
    expect(page, "#state").to_have_text("stopped")
    expect(page, "#problems").to_be_empty()
    assert robot.stopped and page.failures == []


def test_a_microphone_of_a_high_rate_is_heard(visit: Any) -> None:
    high = """
      const Real = window.AudioContext;
      window.AudioContext = class extends Real { // a browser that does not convert rates
        constructor(options) {
          super({ sampleRate: options?.sampleRate ?? 96000 });
          this.asked = options !== undefined;
        }
        createMediaStreamSource(stream) {
          if (this.asked) throw new DOMException("", "NotSupportedError");
          return super.createMediaStreamSource(stream);
        }
      };
    """
    page = visit(speech([("tall", 1.6)], 6.0), script=high)
    page.click("#start")
    expect(page, "#decided").to_have_text("tall")
    expect(page, "#problems").to_be_empty()
    assert page.failures == []


HELLO = """
  const send = WebSocket.prototype.send;
  WebSocket.prototype.send = function (data) {
    const hello = typeof data === "string" && data.includes("hello") ? %s : data;
    if (hello) send.call(this, hello);
  };
"""


@pytest.mark.parametrize(
    ("changed", "said"),
    [("data.replace('16000', '96000')", "The microphone's 16000 samples a second"), ("'{}'", "does not understand")],
)
def test_a_page_whose_hello_is_refused_says_why(visit: Any, server: PageServer, changed: str, said: str) -> None:
    second = visit().context.new_page()
    second.add_init_script(HELLO % changed)
    second.goto(f"http://127.0.0.1:{server.port}/")
    expect(second, "#problems").to_contain_text(said)
    expect(second, "#state").to_have_text("not connected")


def test_a_page_whose_hello_came_too_late_tries_again(visit: Any, words: Any) -> None:
    stage = Stage(words, None, limits=ServeLimits(hello_s=1.0))
    try:
        with PageServer(stage) as server:
            page = visit(at=server, script=HELLO % "window.late ? data : ((window.late = true), '')")
            expect(page, "#start").to_be_enabled()
            expect(page, "#problems").to_be_empty()
            assert page.failures == []
    finally:
        stage.close()
