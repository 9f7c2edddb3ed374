"""Channels to hosts that run already: connections to TCP and Unix sockets."""

from __future__ import annotations

import os
import socket
import time
from collections import Counter

import psutil

from ucm_cts.harness.hosting.host_channels import Channel, HostUnavailable, Loaded
from ucm_cts.harness.hosting.locate import Endpoint
from ucm_cts.harness.results.values import Incident

_RETRY_SECONDS = 1.0


class Connector:
    """Connects to a host that runs already; retries for a moment, because a replaced host may still be ending."""

    def __init__(self, endpoint: Endpoint) -> None:
        self.left_behind: Counter[str] = Counter()
        self._endpoint = endpoint

    def open(self, seconds: float) -> Channel:
        deadline = time.monotonic() + _RETRY_SECONDS
        while True:
            try:
                return Connection(self._connect())
            except OSError as error:
                if time.monotonic() > deadline:
                    detail = f"no adapter answers at {self._endpoint.text}: {error.strerror or error}; is the adapter running?"
                    raise HostUnavailable(Incident("unreachable", detail)) from error
            time.sleep(0.05)

    def hint(self, text: str) -> str:
        return ""

    def end_all(self) -> None:
        """Nothing to end: the host runs on."""

    def close(self) -> None:
        """The same."""

    def _connect(self) -> socket.socket:
        if self._endpoint.kind == "unix":
            connection = socket.socket(socket.AF_UNIX)
            try:
                connection.connect(self._endpoint.target)
            except OSError:
                connection.close()
                raise
            return connection
        host, _, port = self._endpoint.target.rpartition(":")
        connection = socket.create_connection((host, int(port)), timeout=_RETRY_SECONDS)
        connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        return connection


class Connection:
    """A host at the other end of a socket: it can be disconnected, not killed."""

    pid: int | None = None
    error: int | None = None
    notices: int | None = None
    loaded = Loaded()

    def __init__(self, connection: socket.socket) -> None:
        connection.setblocking(False)
        self._socket = connection
        self.source = connection.fileno()
        self.target = os.dup(self.source)
        self._open = True

    def processes(self) -> frozenset[psutil.Process]:
        return frozenset()

    def signal(self, number: int) -> None:
        """A remote host gets no signals."""

    def status(self, seconds: float) -> int | None:
        return None

    def end_all(self) -> None:
        """A remote host runs on."""

    def close(self, orderly: bool) -> None:
        if self._open:
            self._open = False
            os.close(self.target)
            self._socket.close()
