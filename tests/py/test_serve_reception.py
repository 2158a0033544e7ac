# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Who has the one place of the page's server, and that nothing keeps STOP waiting."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import pytest

pytest.importorskip("serving")

from starlette.websockets import WebSocket, WebSocketDisconnect
from websockets.exceptions import ConnectionClosed

import hri
from conftest import WAIT_S, until
from hri.robot import Robot
from hri.serve import PageServer, Stage
from hri.serve.connection import TAKEN, Connection
from page_people import connected, request
from serving import LIMITS, stop_by_request
from session_people import MOTIONS

pytest_plugins = ("serving",)


@pytest.fixture
def stage(words: Any, robot: Robot) -> Iterator[Stage]:
    made = Stage(words, None, robot, motions=MOTIONS, limits=LIMITS)
    yield made
    made.close()


def test_a_page_comes_again_whose_old_connection_has_just_gone(
    server: PageServer, cookie: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    close = WebSocket.close

    async def gone(self: WebSocket, code: int = 1000, reason: str | None = None) -> None:
        if code == TAKEN:
            raise WebSocketDisconnect(1006)  # as Starlette does for a socket that cannot be sent to
        await close(self, code, reason)

    monkeypatch.setattr(WebSocket, "close", gone)
    with connected(server, cookie), connected(server, cookie) as again:
        again.say(type="stop")
        again.await_stopped()


def test_the_place_is_free_when_taking_it_over_has_failed(
    server: PageServer, cookie: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    async def fail(*_: object) -> None:
        raise OSError("no line")

    with connected(server, cookie), monkeypatch.context() as patched:
        patched.setattr(Connection, "dismiss", fail)
        with pytest.raises(ConnectionClosed), connected(server, cookie):
            pass
    with connected(server, cookie, "b") as page:
        page.say(type="stop")
        page.await_stopped()


def test_stop_does_not_wait_for_a_model_that_is_downloaded(
    server: PageServer, cookie: str, robot: Robot, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun, go_on = threading.Event(), threading.Event()
    made = hri.WordRecognizer.to_model_file

    def slowly(self: hri.WordRecognizer) -> Any:
        begun.set()
        go_on.wait(WAIT_S)
        return made(self)

    monkeypatch.setattr(hri.WordRecognizer, "to_model_file", slowly)
    with connected(server, cookie) as page:
        answers: list[int] = []
        download = threading.Thread(target=lambda: answers.append(request(server, "/words.hri", cookie)[0]))
        download.start()
        try:
            assert begun.wait(WAIT_S)
            presser = threading.Thread(target=stop_by_request, args=(server, cookie, page))
            presser.start()
            until(lambda: robot.stopped)
            assert not answers
        finally:
            go_on.set()
        presser.join(WAIT_S)
        download.join(WAIT_S)
        assert answers == [200]
