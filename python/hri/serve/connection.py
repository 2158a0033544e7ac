# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""One page at a time: what it sends is checked, limited and heeded; what happens is sent to it."""

from __future__ import annotations

import asyncio
import logging
import math
import time
from collections import deque
from contextlib import suppress
from typing import Any

import numpy as np
from starlette.websockets import WebSocket, WebSocketDisconnect

from hri.core.errors import FormatError
from hri.core.phrases import Phrase, phrase, phrase_of
from hri.live.events import STALL, json_line
from hri.serve.limits import RateLimit
from hri.serve.messages import SOUND, read_command, read_media, with_phrases
from hri.serve.stage import Stage
from hri.serve.teaching import Teaching
from hri.session.logic import MOTION_END
from hri.session.voice import VOICE_END

TOO_LARGE = 1009
REFUSED = 1008
NO_PAGE = 4400
LATE = 4408
TAKEN = 4409
BAD_RATE = 4415
_ELSEWHERE = "Another page uses the robot now. Close it first."
_FIGURE_S = 0.12
_REPEAT_S = 2.0
_MOST_WAITING = 512
_MOST_KNOWN = 64
_SAME_AGAIN_S = 60.0

log = logging.getLogger("hri.serve")


class Outbox:
    """Messages on their way to a page; one that is slow misses what passes (levels, places of hands) first."""

    def __init__(self) -> None:
        self._messages: deque[dict[str, Any]] = deque(maxlen=2 * _MOST_WAITING)
        self._ready = asyncio.Event()

    def put(self, message: dict[str, Any]) -> None:
        """Add a message, in the server's thread."""
        if len(self._messages) < _MOST_WAITING or not message.get("passing"):
            self._messages.append(message)
            self._ready.set()

    async def get(self) -> dict[str, Any]:
        """The oldest message; waits for one."""
        while not self._messages:
            self._ready.clear()
            await self._ready.wait()
        return self._messages.popleft()


class Reception:
    """Gives the one place to one page.

    Parameters
    ----------
    stage : Stage
    teaching : Teaching
    """

    def __init__(self, stage: Stage, teaching: Teaching) -> None:
        self.stage = stage
        self.teaching = teaching
        self.current: Connection | None = None
        stage.publish = self.publish
        self._loop: asyncio.AbstractEventLoop | None = None
        self._logged_s: dict[str, float] = {}

    def publish(self, message: dict[str, Any]) -> None:
        """Send a message to the page that is there, if any; by any thread. Trouble is logged, too."""
        if message["type"] == "note":
            log.warning("%s", message["text"])
        elif message["type"] == "event":
            self._log_trouble(message)
        loop = self._loop
        if loop is not None and not loop.is_closed():
            loop.call_soon_threadsafe(self._put, message)

    def _log_trouble(self, event: dict[str, Any]) -> None:
        """A source that stalls, a motion that did not end as it should, what was not said; the same once a minute."""
        text = event["message"] if event["event"] in (STALL, MOTION_END, VOICE_END) else ""
        now_s = time.monotonic()
        if text and now_s - self._logged_s.get(text, -math.inf) >= _SAME_AGAIN_S:
            self._logged_s = {t: at_s for t, at_s in self._logged_s.items() if now_s - at_s < _SAME_AGAIN_S}
            self._logged_s[text] = now_s
            log.warning("%s: %s", event["mode"], text)

    def _put(self, message: dict[str, Any]) -> None:
        if self.current is not None and message["type"] == "error":
            self.current.complain(message["text"])
        elif self.current is not None:
            self.current.outbox.put(message)

    async def meet(self, socket: WebSocket) -> None:
        """A page that was let in: until it goes."""
        self._loop = asyncio.get_running_loop()
        await socket.accept()
        try:
            first = await asyncio.wait_for(socket.receive_text(), self.stage.limits.hello_s)
            hello = read_command(first, self.stage.limits)
            if hello["type"] != "hello":
                raise FormatError("a page begins with hello")
        except TimeoutError:  # the computer may be busy: the page tries again
            log.warning("a connection that sent nothing was closed")
            await _close(socket, LATE, "nothing came in time")
            return
        except (FormatError, KeyError) as error:
            why = phrase_of(error) if isinstance(error, FormatError) else "it sent bytes"
            log.warning("a connection that did not begin as the page does was closed: %s", why)
            of_rate = isinstance(why, Phrase) and why.code == "rate_unusable"
            await _close(socket, BAD_RATE if of_rate else NO_PAGE, "this is no page of hri serve")
            return
        except WebSocketDisconnect:
            return
        page = str(hello.get("page", ""))
        if self.current is not None and (not page or page != self.current.page):
            log.warning("a second page was refused: the camera and the robot serve another one")
            await _close(socket, TAKEN, _ELSEWHERE)
            return
        await self._serve(Connection(socket, self.stage, self.teaching, page, hello))

    async def _serve(self, connection: Connection) -> None:
        before, self.current = self.current, connection
        try:
            if before is not None:  # the same page, which has lost that connection before we did, or is in two windows
                await before.dismiss(TAKEN, _ELSEWHERE)
            else:
                self.stage.arrive()
            await connection.run()
        finally:
            if self.current is connection:
                self.current = None
                self.teaching.forget()
                self.stage.leave()


class Connection:
    """A page that is connected.

    Parameters
    ----------
    socket : WebSocket
        Accepted.
    stage : Stage
    teaching : Teaching
    page : str
        The page's own name: it may take its place again.
    hello : dict
        Its first message.
    """

    def __init__(self, socket: WebSocket, stage: Stage, teaching: Teaching, page: str, hello: dict[str, Any]) -> None:
        self.page = page
        self.outbox = Outbox()
        self._socket = socket
        self._stage = stage
        self._teaching = teaching
        limits = stage.limits
        self._pictures = RateLimit(limits.pictures_per_s)
        self._messages = RateLimit(limits.messages_per_s, burst_s=2.0)
        self._rate_hz = int(hello.get("rate", 16000))
        self._sound = RateLimit(2.0 * self._rate_hz, burst_s=2.0)
        self._complained: dict[str, float] = {}
        self._tasks: list[asyncio.Task[None]] = []

    async def run(self) -> None:
        """Until the page goes, or is sent away."""
        self._stage.microphone.start(self._rate_hz)
        self.outbox.put(self._stage.welcome())
        self._tasks = [asyncio.create_task(work()) for work in (self._hear, self._send, self._draw)]
        done, _ = await asyncio.wait(self._tasks, return_when=asyncio.FIRST_COMPLETED)
        await self.end()
        for task in done:
            if not task.cancelled() and isinstance(task.exception(), Exception):
                log.warning("a connection ended: %s", task.exception())

    async def end(self) -> None:
        """Send and heed nothing more."""
        self._stage.page_voice.ends()
        for task in self._tasks:
            task.cancel()
        await asyncio.gather(*self._tasks, return_exceptions=True)

    async def dismiss(self, code: int, reason: str) -> None:
        """End, and say why."""
        await self.end()
        await _close(self._socket, code, reason)

    def complain(self, text: str) -> None:
        """On the page and on the terminal, the same at most every two seconds."""
        now_s = time.monotonic()
        if now_s - self._complained.get(text, -math.inf) < _REPEAT_S:
            return
        if len(self._complained) >= _MOST_KNOWN:
            self._complained.clear()
        self._complained[text] = now_s
        log.warning("%s", text)
        self.outbox.put({"type": "error", "text": text, "passing": True})

    async def _hear(self) -> None:
        while True:
            message = await self._socket.receive()
            if message["type"] == "websocket.disconnect":
                if message.get("code") == TOO_LARGE:
                    log.warning("a message that is too large ended the connection to the page")
                return
            text, data = message.get("text"), message.get("bytes")
            try:
                command = read_command(text, self._stage.limits) if text is not None else None
            except FormatError as error:
                command = None
                self.complain(phrase_of(error))
            if command is not None and command["type"] == "stop":  # before any limit
                self._stage.stop()
                continue
            if not self._messages.take():
                log.warning("a page that sent too many messages was sent away")
                await _close(self._socket, REFUSED, "This page sent too many messages.")
                return
            if command is not None:
                self._obey(command)
            elif data is not None:
                self._take(data)

    def _obey(self, command: dict[str, Any]) -> None:
        if command["type"] == "resume":
            self._stage.resume()
        elif command["type"] == "imitate":
            self._stage.imitate()
        elif command["type"] == "rest":
            self._stage.session.rest()
        elif command["type"] == "voice":
            voice = self._stage.page_voice
            voice.begins(command["text"]) if command["text"] else voice.ends()
        elif command["type"] != "hello":
            self._teaching.obey(command)

    def _take(self, data: bytes) -> None:
        try:
            media = read_media(data, self._stage.limits)
        except FormatError as error:
            self.complain(phrase_of(error))
            return
        if media.kind == SOUND:
            samples = media.samples()
            if self._stage.words is None:
                return
            if self._sound.take(len(samples)):
                self._stage.microphone.put(samples)
                own = self._stage.page_voice.may_be_heard  # which is no sample of a word
                self._teaching.words.hear(np.zeros_like(samples) if own else samples, self._rate_hz)
            else:
                self.complain(phrase("too_much_sound"))
        elif self._stage.signs is not None:
            if not self._pictures.take():
                self.complain(phrase("too_many_pictures", most=f"{self._stage.limits.pictures_per_s:g}"))
            else:
                self._stage.camera.put(media)
                self._teaching.gestures.see(media)

    async def _send(self) -> None:
        while True:
            await self._socket.send_text(json_line(with_phrases(await self.outbox.get())))

    async def _draw(self) -> None:
        """Where the robot is, as often as that changes."""
        before: dict[str, Any] | None = None
        while True:
            now = self._stage.figure()
            if now is None:
                await asyncio.Event().wait()
            if now != before:
                self.outbox.put({"passing": True, **(now or {})})
                before = now
            await asyncio.sleep(_FIGURE_S)


async def _close(socket: WebSocket, code: int, reason: str) -> None:
    """Close a socket, which may be closed already, or have gone this moment."""
    with suppress(RuntimeError, WebSocketDisconnect):
        await socket.close(code, reason)
