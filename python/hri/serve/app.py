# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The web application: who is let in, and what is served."""

from __future__ import annotations

import asyncio
import secrets
from collections.abc import Callable
from importlib.resources import files
from pathlib import Path
from tempfile import TemporaryDirectory

from starlette.applications import Starlette
from starlette.middleware import Middleware
from starlette.middleware.trustedhost import TrustedHostMiddleware
from starlette.requests import HTTPConnection, Request
from starlette.responses import JSONResponse, PlainTextResponse, RedirectResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.websockets import WebSocket

from hri.core.files import write_bytes
from hri.core.phrases import phrase
from hri.io import ModelFile, model_as_cpp, model_as_json
from hri.page import COMPONENTS, component
from hri.serve.command_teacher import CommandWordTeacher
from hri.serve.commands import change_commands
from hri.serve.connection import Reception, log
from hri.serve.messages import with_phrases
from hri.serve.samples import samples_zip
from hri.serve.stage import Stage
from hri.serve.teaching import Teaching

_PAGE = (
    "index.html",
    "page.js",
    "link.js",
    "devices.js",
    "place.js",
    "sound.js",
    "teach.js",
    "commands.js",
    "imitation.js",
    "missing.js",
    "language.js",
    "vocabulary.js",
    "voice.js",
    "files.js",
)
HOSTS = ("127.0.0.1", "localhost")
_KINDS = {".html": "text/html", ".css": "text/css", ".js": "text/javascript", ".svg": "image/svg+xml"}
_FORMS: dict[str, tuple[str, Callable[[ModelFile, str], bytes | str]]] = {
    "hri": ("application/octet-stream", lambda file, name: file.to_bytes()),
    "hpp": ("text/x-c++hdr", model_as_cpp),
    "json": ("application/json", lambda file, name: model_as_json(file)),
}
"""Of a recogniser, as the page offers it."""
_MODELS = ("words", "signs")
_MOST_LETTERS = 60
_USED = "This address has been used, or is not the one that hri serve printed. Start hri serve again for a new one."
_HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'self'; connect-src 'self' ws://127.0.0.1:* "
    "ws://localhost:*; img-src 'self' data:; media-src 'self' blob:; frame-ancestors 'none'; form-action 'none'; "
    "base-uri 'none'",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Permissions-Policy": "camera=(self), microphone=(self)",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class Door:
    """Lets in who has the token of the printed address, once, and then who has the cookie that was given for it.

    Parameters
    ----------
    token : str
    port : int
        Of the server: part of the origins that are allowed, and of the cookie's name.
    """

    def __init__(self, token: str, port: int) -> None:
        self._token: str | None = token
        self._key = secrets.token_urlsafe(32)
        self._cookie = f"hri_{port}"
        self._origins = {f"http://{host}:{port}" for host in HOSTS}

    def exchange(self, token: str, response: Response) -> bool:
        """Whether this is the token; it is spent then, and the response sets the cookie."""
        if self._token is None or not secrets.compare_digest(token.encode(), self._token.encode()):
            return False
        self._token = None
        response.set_cookie(self._cookie, self._key, httponly=True, samesite="strict")
        return True

    def knows(self, connection: HTTPConnection) -> bool:
        """Whether the cookie is there."""
        given = connection.cookies.get(self._cookie, "")
        return secrets.compare_digest(given.encode(), self._key.encode())

    def is_own_page(self, connection: HTTPConnection) -> bool:
        """Whether the request comes from the page that this server has served."""
        return connection.headers.get("origin") in self._origins


def page_files() -> dict[str, bytes]:
    """What the page is made of, by name: its own files, and those that pages share."""
    own = {name: files("hri.serve").joinpath("page", name).read_bytes() for name in _PAGE}
    return own | {name: component(name) for name in COMPONENTS}


async def _body_of(request: Request, max_bytes: int) -> bytes | None:
    """What a request brings; None where that is too much."""
    body = bytearray()
    async for part in request.stream():
        if len(body) + len(part) > max_bytes:
            return None
        body += part
    return bytes(body)


def make_app(stage: Stage, token: str, port: int) -> Starlette:
    """The application.

    Parameters
    ----------
    stage : Stage
    token : str
        Of the printed address.
    port : int
        On which it is served.
    """
    door = Door(token, port)
    teaching = Teaching(stage)
    reception = Reception(stage, teaching)
    page = page_files()
    changing = asyncio.Lock()

    def refused(why: str) -> Response:
        log.warning("a visitor was refused: %s", why)
        return PlainTextResponse(_USED, 403, _HEADERS)

    def said(text: str, status: int) -> Response:
        """What the page shows of an answer, in the person's language."""
        return JSONResponse(with_phrases({"text": text}), status, _HEADERS)

    async def index(request: Request) -> Response:
        token = request.query_params.get("token")
        if token is not None and not door.knows(request):
            response = RedirectResponse("/", 303, _HEADERS)
            return response if door.exchange(token, response) else refused("the token is spent or wrong")
        if token is not None:
            return RedirectResponse("/", 303, _HEADERS)
        return serve(request, "index.html")

    async def file(request: Request) -> Response:
        return serve(request, request.path_params["name"])

    def serve(request: Request, name: str) -> Response:
        if not door.knows(request):
            return refused("without the token")
        if name not in page:
            return PlainTextResponse("There is no such page.", 404, _HEADERS)
        kind = _KINDS.get(name[name.rfind(".") :], "application/octet-stream")
        return Response(page[name], media_type=kind, headers=_HEADERS)

    async def stop(request: Request) -> Response:
        """STOP beside the web socket, which may be lost or full."""
        if not door.knows(request) or not door.is_own_page(request):
            return refused("without the token, or from another page")
        stage.stop()
        return Response(status_code=204)

    async def model(request: Request) -> Response:
        if not door.knows(request):
            return refused("without the token")
        name, _, form = request.url.path.strip("/").partition(".")
        recognizer = stage.vocabulary if name == "words" else stage.signs
        if recognizer is None:
            return PlainTextResponse(f"There is no recogniser of {name}.", 404, _HEADERS)
        kind, content = _FORMS[form]
        attached = {"Content-Disposition": f'attachment; filename="{name}.{form}"'}
        made = await asyncio.to_thread(lambda: content(recognizer.to_model_file(), name))  # STOP does not wait for it
        return Response(made, media_type=kind, headers=_HEADERS | attached)

    async def samples(request: Request) -> Response:
        """What words were added by, and what synthetic voices said: a model with added words is trained anew on it."""
        if not door.knows(request):
            return refused("without the token")
        rows = teaching.words.samples() if isinstance(teaching.words, CommandWordTeacher) else []
        if not rows:
            return PlainTextResponse("No word was added to those of commands.", 404, _HEADERS)
        content = await asyncio.to_thread(samples_zip, rows)
        attached = {"Content-Disposition": 'attachment; filename="samples.zip"'}
        return Response(content, media_type="application/zip", headers=_HEADERS | attached)

    async def sample(request: Request) -> Response:
        """A file that shows the gesture that is being added; the query names it."""
        if not door.knows(request) or not door.is_own_page(request):
            return refused("without the token, or from another page")
        if reception.current is None:
            return said(phrase("not_connected_yet"), 409)
        name = Path(request.query_params.get("name", "")).name[-_MOST_LETTERS:] or "file"
        with TemporaryDirectory(prefix="hri-serve-") as folder:
            path = Path(folder) / f"clip{Path(name).suffix if name.isprintable() else ''}"
            body = await _body_of(request, stage.limits.max_clip_bytes)
            if body is None:
                most = stage.limits.max_clip_bytes >> 20
                return said(phrase("file_large", name=name, most=most), 413)
            write_bytes(path, body)
            why = await asyncio.to_thread(teaching.gestures.take_file, path, name)
        return said(why, 422 if why else 200)

    async def grammar(request: Request) -> Response:
        """Other commands of several words."""
        if not door.knows(request) or not door.is_own_page(request):
            return refused("without the token, or from another page")
        body = await _body_of(request, stage.limits.max_grammar_bytes)
        if body is None:
            most = stage.limits.max_grammar_bytes >> 10
            return said(phrase("grammar_large", most=most), 413)
        async with changing:
            why, num_commands = await asyncio.to_thread(change_commands, stage, body)
        if why:
            log.warning("the commands stay as they are: %s", why)
            return said(phrase("commands_stay", why=why), 422)
        return said(phrase("commands_changed", count=num_commands), 200)

    async def talk(socket: WebSocket) -> None:
        if not door.knows(socket) or not door.is_own_page(socket):
            log.warning("a visitor was refused: without the token, or from another page")
            await socket.close()
            return
        await reception.meet(socket)

    routes = [
        Route("/", index),
        Route("/stop", stop, methods=["POST"]),
        Route("/sample", sample, methods=["POST"]),
        Route("/grammar", grammar, methods=["POST"]),
        Route("/samples.zip", samples),
        *(Route(f"/{name}.{form}", model) for name in _MODELS for form in _FORMS),
        WebSocketRoute("/talk", talk),
        Route("/{name}", file),
    ]
    return Starlette(routes=routes, middleware=[Middleware(TrustedHostMiddleware, allowed_hosts=list(HOSTS))])
