# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""What tests of the page's server have in common: a plugin of pytest for those that define the fixture `stage`.

``pytest.importorskip("serving")`` before other imports skips these tests where the libraries of the page are missing.
"""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any

import pytest

pytest.importorskip("cv2")
pytest.importorskip("starlette")
pytest.importorskip("uvicorn")
pytest.importorskip("websockets")

import hri
from hri.robot import Robot, open_robot
from hri.serve import PageServer, ServeLimits, Stage
from page_people import Page, enter, request
from session_people import train_signs, train_words

LIMITS = ServeLimits(stall_s=2.0, hello_s=60.0)
Serving = Callable[..., tuple[PageServer, str]]


@pytest.fixture(scope="session")
def words() -> hri.WordRecognizer:
    """Of tones; who adds words to them takes a copy."""
    return train_words()


@pytest.fixture(scope="session")
def signs() -> hri.GestureRecognizer:
    return train_signs()


@pytest.fixture
def robot() -> Iterator[Robot]:
    with open_robot("kinematic") as opened:
        yield opened


@pytest.fixture
def server(stage: Stage) -> Iterator[PageServer]:
    with PageServer(stage) as made:
        yield made


@pytest.fixture
def cookie(server: PageServer) -> str:
    return enter(server)


@pytest.fixture
def serving() -> Iterator[Serving]:
    """A server of a stage that is made of what is given, and the cookie of a visitor."""
    with ExitStack() as stack:

        def start(*parts: Any, **options: Any) -> tuple[PageServer, str]:
            stage = Stage(*parts, **options)
            stack.callback(stage.close)
            server = stack.enter_context(PageServer(stage))
            return server, enter(server)

        yield start


@pytest.fixture
def notes(caplog: pytest.LogCaptureFixture) -> pytest.LogCaptureFixture:
    """What stands on the terminal."""
    caplog.set_level(logging.WARNING, "hri.serve")
    logging.getLogger("hri").propagate = True
    return caplog


def answer(page: Page, text: str) -> dict[str, Any]:
    """The next answer about words or gestures that are added which has this text in it."""
    return page.await_message(lambda m: m["type"] == "teach" and text in m["text"])


def own_origin(server: PageServer) -> str:
    """Where requests of the server's own page come from."""
    return f"http://127.0.0.1:{server.port}"


def stop_by_button(server: PageServer, cookie: str, page: Page) -> None:
    page.say(type="stop")


def stop_by_request(server: PageServer, cookie: str, page: Page) -> None:
    assert request(server, "/stop", cookie, "POST", Origin=own_origin(server))[0] == 204
