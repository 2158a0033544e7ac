# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The sections that add words and gestures, in a real browser: they show what the server has, at any time."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("browsing")

import hri
from browsing import MARKS, expect, serious_faults
from drawn_hands import stills
from hri.core.errors import InvalidArgument
from hri.media import write_image
from hri.serve import PageServer

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
