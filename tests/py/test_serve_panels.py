# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The sections that add words and gestures, in a real browser: they show what the server has, at any time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("browsing")

import hri
from browsing import MARKS, api, expect, serious_faults
from drawn_hands import stills
from hri.core.errors import InvalidArgument
from hri.media import write_image
from hri.serve import PageServer, Stage

pytest_plugins = ("serving", "browsing")
pytestmark = MARKS


def name(page: Any, label: str) -> None:
    page.fill("#gesture", label)
    page.press("#gesture", "Enter")
    expect(page, "#gesture-line").to_contain_text("3 times")


def test_panels_follow_the_server_after_a_fault_a_lost_line_and_a_reload(
    visit: Any, server: PageServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object) -> None:
        raise InvalidArgument("no memory")

    names = [str(tmp_path / f"{number}.png") for number in range(3)]
    for number, path in enumerate(names):
        write_image(path, stills("flat", 30 + number)[0])
    page = visit()
    expect(page, "#gesture-undo").to_be_disabled()
    name(page, "cross")
    expect(page, "#gesture-undo").to_be_enabled()
    assert page.get_attribute("#gesture-undo", "aria-label") == "Undo the last sample"
    with monkeypatch.context() as patched:
        patched.setattr(hri.GestureRecognizer, "add_gesture_features", fail)
        page.set_input_files("#gesture-files", names)
        expect(page, "#gesture-line").to_contain_text("“cross” could not be added: no memory.")
    expect(page, "#gesture-sample").to_have_text("Try to add “cross” once more")
    assert serious_faults(page) == []
    page.click("#gesture-undo")
    expect(page, "#gesture-line").to_have_text("The last sample of “cross” is taken back: 2 of 3.")
    expect(page, "#gesture-sample").to_have_text("Record “cross” (2 of 3)")
    page.set_input_files("#gesture-files", names[2])
    expect(page, "#gesture-line").to_contain_text("“cross” is added")
    page.reload()
    expect(page, "#vocabulary").to_contain_text("cross")
    expect(page, "#gesture-undo").to_be_enabled()
    name(page, "bend")
    for connection in list(server._server.server_state.connections):
        connection.transport.abort()
    expect(page, "#gesture-line").to_have_text("A gesture is added from three samples of it.")
    expect(page, "#gesture-sample").to_be_disabled()
    page.click("#gesture-undo")
    expect(page, "#gesture-line").to_have_text("“cross” is removed.")
    expect(page, "#gesture-undo").to_be_disabled()
    assert page.failures == []


def test_the_conversation_goes_on_with_what_is_missing(visit: Any, server: PageServer, stage: Stage) -> None:
    page = visit()
    page.click("#stop")
    expect(page, "#log").to_contain_text("STOP")
    page.evaluate("document.querySelector('#log p').id = 'first'")
    lines = page.locator("#log p")

    def await_line(text: str) -> list[str]:
        api.expect(lines.last).to_contain_text(text)
        expect(page, "#first").to_be_attached()  # nothing was written anew
        return lines.all_inner_texts()

    before = lines.all_inner_texts()
    stage.renew()  # as by a word that is added
    stage._report("one")
    assert await_line("one")[: len(before)] == before
    for connection in list(server._server.server_state.connections):
        connection.transport.abort()
    expect(page, "#problems").to_contain_text("is lost")
    stage._report("two")  # before the page is back, or just after
    expect(page, "#problems").not_to_contain_text("is lost")
    stage._report("three")
    after = await_line("three")
    assert [after.count(text) for text in ("one", "two", "three")] == [1, 1, 1]
    page.reload()
    api.expect(lines.last).to_contain_text("three")
    assert lines.all_inner_texts()[-3:] == after[-3:]
    for connection in list(server._server.server_state.connections):
        connection.transport.abort()
    for number in range(100):  # more than are kept: all is written anew
        stage._report(f"line {number}")
    api.expect(lines.last).to_contain_text("line 99")
    assert page.failures == []
