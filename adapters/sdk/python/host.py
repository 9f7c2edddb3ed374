"""Serve a Python adapter: ``python -m ucm_cts.adapters.sdk.python.host ADAPTER``.

ADAPTER is ``package.module:Class``, ``package.module`` with a function ``answer``, or the path of an extension module.
Messages come on standard input and answers go to standard output, unless ``--listen tcp://HOST:PORT`` or
``--listen unix:/PATH`` is given: then each connection gets a host process of its own. (``--control`` is for the harness.)
What a framework prints goes to standard error.
"""

from __future__ import annotations

import argparse
import faulthandler
import json
import os
import select
import signal
import socket
import stat
import sys
import threading
import time
from collections.abc import Callable
from contextlib import suppress
from typing import NoReturn
from urllib.parse import urlsplit

from ucm_cts.adapters.contract.messages import Traced, Welcome, encode, from_host_decoder, refusal
from ucm_cts.adapters.sdk.python.loading import Answer, CannotLoad, load
from ucm_cts.adapters.sdk.python.seal import Seal, replaces
from ucm_cts.adapters.sdk.python.template import Template, adopt_orphans, refuse

ASKED_FOR_MODULES = b'{"type":"modules"}\n'
"""The question which modules a host has loaded, outside the protocol: it answers with their files, a list of JSON. Others refuse it."""

_GRACE = 30.0  # seconds a host may continue after its connection has ended


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m ucm_cts.adapters.sdk.python.host", description="Serve an adapter.")
    parser.add_argument("adapter", help="package.module:Class, package.module, or a path")
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--listen", metavar="ADDRESS", help="tcp://HOST:PORT or unix:/PATH")
    how.add_argument("--control", type=int, help=argparse.SUPPRESS)
    options = parser.parse_args()
    sys.argv[:] = [options.adapter]  # what is loaded need not know who loads it
    control = socket.socket(fileno=options.control) if options.control is not None else None
    sys.breakpointhook = _say_breakpoint
    # found before the adapter is loaded, which could replace them
    become_host, listen, make_template, look = serve, _listen, Template, _seal().broken
    if control:
        adopt_orphans()
    try:
        answer = load(options.adapter)
    except CannotLoad as error:
        if control:
            refuse(control, str(error))
        parser.exit(2, f"{parser.prog}: {error}\n")
    if control:
        make_template(control, lambda source, target: become_host(answer, source, target, look)).serve()
    elif options.listen:
        try:
            listener = _open_listener(options.listen)
        except (OSError, ValueError) as error:
            parser.exit(2, f"{parser.prog}: cannot listen on {options.listen}: {error}\n")
        listen(listener, answer, look)
    else:
        become_host(answer, os.dup(0), os.dup(1), look)


def _seal() -> Seal:
    """What the engine's own seal cannot guard: the engine itself with its seal, and what surrounds it."""
    names = (f"{__package__}.{part}" for part in ("engine", "loading", "seal", "template"))
    return Seal().remember([sys.modules[__name__], *(sys.modules[name] for name in names)])


def serve(answer: Answer, source: int, target: int, look: Callable[[], str | None] = lambda: None) -> NoReturn:
    """Answer the lines that come from descriptor ``source`` to descriptor ``target`` until there are no more.

    Takes the process over: what is printed goes to standard error, ``SIGUSR1`` prints the stacks of all threads there,
    and the process ends without waiting for threads. ``look`` says what has been replaced here; then no run is answered.
    """
    _keep_streams_apart()
    faulthandler.enable(file=2)
    faulthandler.register(signal.SIGUSR1, file=2, all_threads=True)

    def write(message: bytes) -> None:
        rest = memoryview(message)
        while rest:
            rest = rest[os.write(target, rest) :]

    try:
        with os.fdopen(source, "rb", buffering=1 << 16) as lines:
            for line in lines:
                if line == b"\n":
                    continue
                if line == ASKED_FOR_MODULES:
                    write(json.dumps(_files_of_modules()).encode() + b"\n")
                    continue
                reply = answer(line, write)
                replaced = look()
                if replaced is not None and not isinstance(from_host_decoder().decode(reply), Welcome):
                    reply = encode(refusal(line, replaces(replaced)))
                write(reply + b"\n")
                if _is_stuck(reply):
                    break
    except (BrokenPipeError, ConnectionResetError):
        pass  # the harness has closed the connection
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(0)


def _files_of_modules() -> list[str]:
    """The files of all modules that this process has loaded, however it did."""
    files = (getattr(module, "__file__", None) for module in list(sys.modules.values()))
    return sorted({os.path.abspath(file) for file in files if isinstance(file, str)})


def _keep_streams_apart() -> None:
    nothing = os.open(os.devnull, os.O_RDONLY)
    os.dup2(nothing, 0)
    os.close(nothing)
    os.dup2(2, 1)
    with suppress(AttributeError):  # when something else stands in for the streams
        sys.stdout.reconfigure(line_buffering=True)  # type: ignore[union-attr]


def _say_breakpoint(*arguments: object, **named: object) -> None:
    """A host has no terminal for a debugger: say so, and go on."""
    caller = sys._getframe(1)
    place = f"{caller.f_code.co_filename}:{caller.f_lineno}"
    print(f"breakpoint() at {place}: a host has no debugger; use ucm-cts replay --in-process", file=sys.stderr)


def _is_stuck(reply: bytes) -> bool:
    if b'"stuck":[' not in reply:
        return False
    message = from_host_decoder().decode(reply)
    return isinstance(message, Traced) and bool(message.stuck)


def _open_listener(address: str) -> socket.socket:
    scheme, _, path = address.partition(":")
    if scheme == "unix" and path:
        _remove_stale(path)
        listener = socket.socket(socket.AF_UNIX)
        listener.bind(path)
        listener.listen()
        shown = address
    elif scheme == "tcp":
        place = urlsplit(address)
        if not place.hostname or place.port is None:
            raise ValueError("write tcp://HOST:PORT")
        family = socket.AF_INET6 if ":" in place.hostname else socket.AF_INET
        listener = socket.create_server((place.hostname, place.port), family=family)
        shown = f"tcp://{place.netloc.rpartition(':')[0]}:{listener.getsockname()[1]}"
    else:
        raise ValueError("write tcp://HOST:PORT or unix:/PATH")
    print(f"listening on {shown}", flush=True)
    return listener


def _remove_stale(path: str) -> None:
    with suppress(FileNotFoundError):
        if stat.S_ISSOCK(os.stat(path).st_mode):
            with socket.socket(socket.AF_UNIX) as probe:
                try:
                    probe.connect(path)
                except ConnectionRefusedError:
                    os.unlink(path)


def _listen(listener: socket.socket, answer: Answer, look: Callable[[], str | None]) -> NoReturn:
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # ended hosts need no farewell
    while True:
        connection, _ = listener.accept()
        if os.fork() == 0:
            try:
                listener.close()
                signal.signal(signal.SIGCHLD, signal.SIG_DFL)
                if connection.family != socket.AF_UNIX:
                    connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
                descriptor = connection.detach()
                threading.Thread(target=_watch, args=(descriptor,), daemon=True).start()
                serve(answer, descriptor, os.dup(descriptor), look)
            finally:
                os._exit(70)
        connection.close()


def _watch(descriptor: int) -> None:
    """End a host whose framework hangs after the connection has ended."""
    gone = select.poll()
    gone.register(descriptor, getattr(select, "POLLRDHUP", select.POLLHUP))
    gone.poll()
    time.sleep(_GRACE)
    os._exit(0)


if __name__ == "__main__":
    with suppress(KeyboardInterrupt):
        main()
