"""Executable adapters that break the protocol when the message speaks of ``trigger``; each says how.

``wrap`` writes an executable file that speaks so.
"""

from __future__ import annotations

import json
import os
import sys
import time
from pathlib import Path
from typing import Any


class Speaker:
    """Answers hello and, with an empty trace, any run."""

    def speak(self) -> None:
        """Answer all lines of standard input."""
        for line in sys.stdin:
            message = json.loads(line)
            if message["type"] == "hello":
                self.greet()
            elif '"trigger"' in line:
                self.misbehave(message["id"])
            else:
                self.say(type="trace", id=message["id"], events=[])

    def greet(self) -> None:
        self.say(type="welcome", protocol=2, product="hostile", version="1")

    def misbehave(self, number: int) -> None:
        raise NotImplementedError

    def say(self, **message: Any) -> None:
        self.write(json.dumps(message).encode() + b"\n")

    def write(self, data: bytes) -> None:
        while data:
            data = data[os.write(1, data) :]


class SaysGarbage(Speaker):
    """Writes a line that is no JSON."""

    def misbehave(self, number: int) -> None:
        self.write(b"DEBUG: container started\n")


class SaysBinary(Speaker):
    """Writes a line that is no text."""

    def misbehave(self, number: int) -> None:
        self.write(b'{"type":"\xff\xfe"}\n')


class MistakesTypes(Speaker):
    """Gives a wrong-typed field."""

    def misbehave(self, number: int) -> None:
        self.say(type="trace", id=number, events=[{"kind": "call", "n": "one", "t": 1, "thread": 0, "step": 0}])


class AddsFields(Speaker):
    """Gives a field that the protocol does not know."""

    def misbehave(self, number: int) -> None:
        self.say(type="trace", id=number, events=[], mood="fine")


class MistakesId(Speaker):
    """Answers with another message's id."""

    def misbehave(self, number: int) -> None:
        self.say(type="trace", id=number + 1, events=[])


class StreamsUnasked(Speaker):
    """Sends events one by one without a request."""

    def misbehave(self, number: int) -> None:
        self.say(type="event", id=number, event={"kind": "call", "n": 1, "t": 1, "thread": 0, "step": 0})


class StreamsForEver(Speaker):
    """Sends events without end."""

    def misbehave(self, number: int) -> None:
        while True:
            self.say(type="event", id=number, event={"kind": "call", "n": 1, "t": 1, "thread": 0, "step": 0})


class StopsInTheMiddle(Speaker):
    """Writes half a line and ends with status 0."""

    def misbehave(self, number: int) -> None:
        self.write(b'{"type":"tra')
        sys.exit(0)


class NeverEndsALine(Speaker):
    """Writes without end and without a newline."""

    def misbehave(self, number: int) -> None:
        while True:
            self.write(b" " * (1 << 16))


class HangsUp(Speaker):
    """Closes its output and goes on running."""

    def misbehave(self, number: int) -> None:
        os.close(1)
        time.sleep(600)


class SaysNothing(Speaker):
    """Never answers hello."""

    def greet(self) -> None:
        time.sleep(600)


class SpeaksAnotherProtocol(Speaker):
    """Says it speaks a later version of the protocol."""

    def greet(self) -> None:
        self.say(type="welcome", protocol=3, product="hostile", version="1")


class HasNoName(Speaker):
    """Does not say what product it is."""

    def greet(self) -> None:
        self.say(type="welcome", protocol=2, product="", version="1")


class DiesLoudly(Speaker):
    """Prints very much instead of answering hello."""

    def greet(self) -> None:
        for number in range(5000):
            print("\x1b[31mnoise", number, file=sys.stderr)
        sys.exit(4)


class DiesAtOnce(Speaker):
    """Ends with a status instead of answering hello."""

    def greet(self) -> None:
        print("cannot read my configuration", file=sys.stderr)
        sys.exit(4)


def wrap(speaker: type[Speaker], folder: Path) -> Path:
    """An executable file in ``folder`` that speaks like ``speaker``."""
    path = folder / speaker.__name__
    here = str(Path(__file__).parent)
    path.write_text(
        f"#!{sys.executable} -S\nimport sys\nsys.path.insert(0, {here!r})\nimport speakers\nspeakers.{speaker.__name__}().speak()\n"
    )
    path.chmod(0o755)
    return path
