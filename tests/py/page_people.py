# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""A page without a browser: what it sends and gets over a real socket of the loopback."""

from __future__ import annotations

import http.client
import json
import struct
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from itertools import count
from typing import Any

import cv2
import numpy as np
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import ClientConnection, connect

from conftest import WAIT_S
from drawn_hands import FPS, Frame
from hri.serve import PageServer

SOUND, PICTURE = 1, 2
_TAKEN = 4409
RATE_HZ = 16000


def request(
    server: PageServer, path: str, cookie: str = "", method: str = "GET", body: bytes | None = None, **headers: str
) -> tuple[int, dict[str, str], bytes]:
    """Status, headers and body of one request."""
    link = http.client.HTTPConnection("127.0.0.1", server.port, timeout=WAIT_S)
    try:
        link.request(method, path, body, {"Cookie": cookie, **{k.replace("_", "-"): v for k, v in headers.items()}})
        answer = link.getresponse()
        return answer.status, {name.lower(): value for name, value in answer.getheaders()}, answer.read()
    finally:
        link.close()


def enter(server: PageServer) -> str:
    """The cookie that the printed address gives; once."""
    status, headers, _ = request(server, server.address.partition(str(server.port))[2])
    assert status == 303 and headers["location"] == "/"
    return headers["set-cookie"].partition(";")[0]


def framed(kind: int, data: bytes, sent_ms: float = 0.0) -> bytes:
    return struct.pack("<Bd", kind, sent_ms) + data


def jpeg(frame: Frame) -> bytes:
    return bytes(cv2.imencode(".jpg", frame)[1])


def sound_messages(samples: np.ndarray) -> Iterator[bytes]:
    """40 ms each."""
    numbers = np.clip(np.round(32768 * samples), -32768, 32767).astype("<i2")
    for begin in range(0, len(numbers), RATE_HZ // 25):
        yield framed(SOUND, numbers[begin : begin + RATE_HZ // 25].tobytes())


def text_of(body: bytes) -> str:
    """Of an answer to a request: what the page shows in English, or the body where that is no JSON."""
    return str(json.loads(body)["text"]) if body.startswith(b"{") else body.decode()


class Page:
    """A connection of a page."""

    def __init__(self, socket: ClientConnection) -> None:
        self.socket = socket
        self.messages: list[dict[str, Any]] = []

    def say(self, **command: Any) -> None:
        self.socket.send(json.dumps(command))

    def await_message(self, fits: Callable[[dict[str, Any]], bool], timeout_s: float = WAIT_S) -> dict[str, Any]:
        """The next message that fits; those before it are kept, too."""
        until_s = time.monotonic() + timeout_s
        while True:
            message = json.loads(self.socket.recv(timeout=max(0.0, until_s - time.monotonic())))
            self.messages.append(message)
            if fits(message):
                return message

    def await_event(self, kind: str, timeout_s: float = WAIT_S, **fields: Any) -> dict[str, Any]:
        return self.await_message(
            lambda m: m.get("event") == kind and all(m.get(name) == value for name, value in fields.items()), timeout_s
        )

    def command(
        self, kind: str, samples: np.ndarray | None = None, frames: list[Frame] | None = None, **fields: Any
    ) -> dict[str, Any]:
        """Say and show until that event comes: on a loaded machine a word may be lost, and is repeated."""
        for _ in range(2):
            self.perform(samples, frames)
            with suppress(TimeoutError):
                return self.await_event(kind, **fields, timeout_s=10.0)
        self.perform(samples, frames)
        return self.await_event(kind, **fields)

    @contextmanager
    def microphone(self) -> Iterator[Microphone]:
        """One that goes on, as a browser's does."""
        made = Microphone(self.socket)
        try:
            yield made
        finally:
            made.close()

    def await_stopped(self) -> None:
        """Until the session has stopped, unless it has since the page came."""
        if not any(m.get("event") == "state" and m["state"] == "stopped" for m in self.messages):
            self.await_event("state", state="stopped")

    def error(self, text: str) -> None:
        self.await_message(lambda m: m["type"] == "error" and text in m["text"])

    def perform(self, samples: np.ndarray | None = None, frames: list[Frame] | None = None) -> None:
        """Say and show as fast as people do."""
        parts: list[tuple[float, bytes]] = []
        if samples is not None:
            parts += [(i / 25, message) for i, message in enumerate(sound_messages(samples))]
        if frames is not None:
            parts += [(i / FPS, framed(PICTURE, jpeg(frame), 1000 * i / FPS)) for i, frame in enumerate(frames)]
        begun_s = time.monotonic()
        for at_s, message in sorted(parts, key=lambda part: part[0]):
            time.sleep(max(0.0, begun_s + at_s - time.monotonic()))
            self.socket.send(message)


class Microphone:
    """Sends what is said, and silence, without a gap: late blocks are sent later, so that times stay true."""

    def __init__(self, socket: ClientConnection) -> None:
        self._socket = socket
        self._said: deque[bytes] = deque()
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def say(self, samples: np.ndarray) -> None:
        """Say something, after what is being said."""
        self._said.extend(sound_messages(samples))

    def close(self) -> None:
        self._over.set()
        self._thread.join()

    def _run(self) -> None:
        silence = next(sound_messages(np.zeros(RATE_HZ // 25, np.float32)))
        begun_s = time.monotonic()
        with suppress(ConnectionClosed):
            for number in count(1):
                if self._over.wait(max(0.0, begun_s + number / 25 - time.monotonic())):
                    return
                self._socket.send(self._said.popleft() if self._said else silence)


@contextmanager
def connected(server: PageServer, cookie: str, page: str = "a", rate: int = RATE_HZ) -> Iterator[Page]:
    """A page that has been welcomed; the place of one that has just gone may be free a little later."""
    until_s = time.monotonic() + WAIT_S
    while True:
        with open_socket(server, cookie) as socket:
            made = Page(socket)
            made.say(type="hello", page=page, rate=rate)
            try:
                made.await_message(lambda m: m["type"] == "welcome")
            except ConnectionClosed:
                if socket.close_code != _TAKEN or time.monotonic() > until_s:
                    raise
                time.sleep(0.05)
                continue
            yield made
            return


def open_socket(server: PageServer, cookie: str, origin: str | None = None) -> ClientConnection:
    own = f"http://127.0.0.1:{server.port}"
    return connect(
        f"ws://127.0.0.1:{server.port}/talk",
        origin=own if origin is None else origin,  # type: ignore[arg-type]
        additional_headers={"Cookie": cookie},
        compression=None,
        max_size=None,
        max_queue=None,
    )
