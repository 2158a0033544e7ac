# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""The server: on this computer alone, at an address that is printed."""

from __future__ import annotations

import secrets
import socket
import threading
import time
from types import TracebackType
from typing import Self

import uvicorn

from hri.core.errors import Error, IoError
from hri.serve.app import make_app
from hri.serve.stage import Stage

HOST = "127.0.0.1"
_START_S = 10.0
_END_S = 10.0


class PageServer:
    """Serves the page of a stage.

    Parameters
    ----------
    stage : Stage
        Left open.
    port : int
        0 takes any that is free.

    Raises
    ------
    IoError
        When the port is in use, or may not be used.

    Attributes
    ----------
    address : str
        With the token, which lets in one visitor.
    """

    def __init__(self, stage: Stage, port: int = 0) -> None:
        try:
            self._socket = socket.create_server((HOST, port))
        except (OSError, OverflowError) as error:
            raise IoError(f"port {port} cannot be used ({error}): name another one with --port") from error
        self.port = int(self._socket.getsockname()[1])
        token = secrets.token_urlsafe(18)
        self.address = f"http://{HOST}:{self.port}/?token={token}"
        config = uvicorn.Config(
            make_app(stage, token, self.port),
            log_config=None,
            access_log=False,
            server_header=False,
            lifespan="off",
            ws="websockets-sansio",
            ws_max_size=stage.limits.max_message_bytes,
            ws_ping_interval=5.0,
            ws_ping_timeout=5.0,
            ws_per_message_deflate=False,
            timeout_graceful_shutdown=1,
        )
        self._server = uvicorn.Server(config)
        self._thread: threading.Thread | None = None

    def run(self) -> None:
        """Serve until Ctrl-C or SIGTERM, which are raised again then."""
        self._server.run(sockets=[self._socket])

    def __enter__(self) -> Self:
        """Serve in a thread of its own."""
        self._thread = threading.Thread(target=self.run, daemon=True, name="hri-serve")
        self._thread.start()
        until_s = time.monotonic() + _START_S
        while not self._server.started:
            if time.monotonic() > until_s:
                raise Error("the server does not start")
            time.sleep(0.01)
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        self._server.should_exit = True
        assert self._thread is not None
        self._thread.join(_END_S)
