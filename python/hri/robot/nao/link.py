# SPDX-FileCopyrightText: The hri contributors
# SPDX-License-Identifier: Apache-2.0
"""Calls of NAOqi's services by the library qi (the extra "nao"): bounded in time, with errors of ours."""

from __future__ import annotations

import math
import socket
import threading
import time
from collections.abc import Callable
from typing import Any
from urllib.parse import urlsplit

from hri.core.errors import Error, InvalidArgument, IoError
from hri.core.optional import import_optional

NAOQI_PORT = 9559
_MAX_TIMEOUT_S = 600.0
_SLICE_S = 0.1


def require_nao_url(url: str) -> str:
    """The address with its port, 9559 where it has none.

    Raises
    ------
    InvalidArgument
        Unless it is tcp://HOST or tcp://HOST:PORT.
    """
    try:
        parts = urlsplit(url if isinstance(url, str) else "")
        port = NAOQI_PORT if parts.port is None else parts.port
    except ValueError:
        parts, port = urlsplit(""), 0
    host = parts.hostname or ""
    extra = parts.path.strip("/") or parts.query or parts.fragment or parts.username
    if parts.scheme != "tcp" or not host or any(map(str.isspace, url)) or extra or not 0 < port <= 65535:
        raise InvalidArgument(f"{str(url)[:80]!r} is no address of a NAO: tcp://HOST or tcp://HOST:PORT")
    return f"tcp://[{host}]:{port}" if ":" in host else f"tcp://{host}:{port}"


class NaoqiLink:
    """A connection to a NAO; any thread may call.

    Parameters
    ----------
    url : str
        tcp://HOST or tcp://HOST:PORT.
    timeout_s : float
        Within which NAO has to answer; above 0, at most 600.

    Raises
    ------
    InvalidArgument
        For another address or time.
    IoError
        When no NAO answers there.
    ImportError
        Without qi.
    """

    def __init__(self, url: str, timeout_s: float = 2.0) -> None:
        if not 0.0 < timeout_s <= _MAX_TIMEOUT_S:
            raise InvalidArgument(f"timeout_s is {timeout_s}, must be above 0 and at most {_MAX_TIMEOUT_S:g}")
        self.url = require_nao_url(url)
        self.timeout_s = timeout_s
        self._qi = import_optional("qi", "nao", "to talk to NAO")
        # It would write to stdout, among our data; what matters comes as an exception, too.
        self._qi.logging.setLevel(self._qi.logging.SILENT)
        self._lock = threading.Lock()
        self._services: dict[str, Any] = {}
        self._session = self._connected()

    @property
    def connected(self) -> bool:
        """Whether the connection is up, as far as this computer knows: a robot without power does not hang up."""
        return bool(self._session.isConnected())

    def reconnect(self) -> None:
        """Connect anew. Raises IoError when no NAO answers."""
        session = self._connected()
        with self._lock:
            before, self._session, self._services = self._session, session, {}
        before.close(_async=True)

    def start(self, service: str, method: str, *arguments: Any) -> Any:
        """Begin a call and return at once; for `finish`.

        Raises
        ------
        IoError
            When the connection is down.
        Error
            When this NAO has no such service or method.
        """
        if not self.connected:
            raise IoError(f"NAO at {self.url} is no longer connected: is it switched off?")
        proxy = self._service(service)
        try:
            function = getattr(proxy, method)
        except AttributeError:
            raise Error(f"NAO at {self.url} has no {service}.{method}: its NAOqi is another version") from None
        try:
            return function(*arguments, _async=True)
        except RuntimeError as error:
            raise self._failure(f"{service}.{method}", error) from error

    def finish(self, future: Any, what: str, timeout_s: float | None = None) -> Any:
        """What a call returned.

        Parameters
        ----------
        future : future
            Of `start`.
        what : str
            The call, for messages.
        timeout_s : float, optional
            The link's by default.

        Raises
        ------
        IoError
            When the answer does not come in time, or the connection breaks.
        Error
            When NAO refuses.
        """
        within_s = self.timeout_s if timeout_s is None else timeout_s
        ends_s = time.monotonic() + within_s
        while not self.wait(future, min(_SLICE_S, within_s)) and time.monotonic() < ends_s:
            pass  # in slices, between which Ctrl-C is heeded
        if not self.wait(future, 0.0):
            raise IoError(f"NAO at {self.url} does not answer {what} within {within_s:g} s")
        try:
            return future.value(0)
        except RuntimeError as error:
            raise self._failure(what, error) from error

    def wait(self, future: Any, timeout_s: float) -> bool:
        """Whether a call has ended within a time."""
        return bool(future.wait(math.ceil(1000.0 * timeout_s)) != self._qi.FutureState.Running)

    def call(self, service: str, method: str, *arguments: Any) -> Any:
        """`start` and `finish`."""
        return self.finish(self.start(service, method, *arguments), f"{service}.{method}")

    def serve_buffers(self, name: str, method: str, take: Callable[[int, int, bytes], None]) -> None:
        """Offer a service with one method that NAO calls with two counts, a time and a buffer, in threads of qi.

        This computer then listens, at the address by which it reaches NAO.

        Raises
        ------
        IoError, Error
            When this computer cannot listen, or NAO does not answer or takes no service of this name.
        """
        qi = self._qi

        def receive(_: object, first: int, second: int, time: object, buffer: bytes) -> None:
            take(first, second, bytes(buffer))

        bound = qi.bind(qi.Void, [qi.Int32, qi.Int32, qi.Dynamic, qi.Buffer], method)(receive)
        receiver = type("Receiver", (), {method: bound})()
        with self._lock:
            session = self._session
        self.finish(session.listen(f"tcp://{self._own_host()}:0", _async=True), "listening")
        self.finish(session.registerService(name, receiver, _async=True), f"registering {name}")

    def _own_host(self) -> str:
        """The address of this computer on the way to NAO; nothing is sent to find it."""
        parts = urlsplit(self.url)
        try:
            kind, _, _, _, address = socket.getaddrinfo(parts.hostname, parts.port, type=socket.SOCK_DGRAM)[0]
            with socket.socket(kind, socket.SOCK_DGRAM) as probe:
                probe.connect(address)
                host = str(probe.getsockname()[0])
        except OSError as error:
            raise IoError(f"this computer has no way to {self.url}: {error}") from error
        return f"[{host}]" if ":" in host else host

    def close(self) -> None:
        """Hang up; returns at once, also when the robot is gone."""
        with self._lock:
            self._services = {}
            self._session.close(_async=True)

    def _connected(self) -> Any:
        session = self._qi.Session()
        future = session.connect(self.url, _async=True)
        if not self.wait(future, self.timeout_s):
            future.cancel()
            raise IoError(f"no NAO answers at {self.url} within {self.timeout_s:g} s: is it on, and in this network?")
        if future.hasError(0):
            raise IoError(f"no NAO can be reached at {self.url}: {_first_line(future.error(0))}")
        return session

    def _service(self, name: str) -> Any:
        with self._lock:
            session, proxy = self._session, self._services.get(name)
        if proxy is None:
            future = session.service(name, _async=True)
            if not self.wait(future, self.timeout_s):
                raise IoError(f"NAO at {self.url} does not answer within {self.timeout_s:g} s")
            if future.hasError(0):
                if not self.connected:
                    raise self._failure(name, future.error(0))
                raise Error(f"NAO at {self.url} has no service {name}: {_first_line(future.error(0))}")
            proxy = future.value(0)
            with self._lock:
                self._services[name] = proxy
        return proxy

    def _failure(self, what: str, error: object) -> Error:
        if self.connected:
            time.sleep(0.01)  # a broken connection fails its calls before it counts as broken
        if not self.connected:
            return IoError(f"the connection to NAO at {self.url} broke during {what}: {_first_line(error)}")
        return Error(f"NAO at {self.url} refuses {what}: {_first_line(error)}")


def _first_line(error: object) -> str:
    """Of a message, which a service in Python ends with where it was raised."""
    return str(error).strip().partition("\n")[0].removeprefix("RuntimeError: ") or "no reason given"
