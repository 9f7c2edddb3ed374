"""Tool chains with one wrong behaviour each: ``fake.py BEHAVIOUR check MODEL``. Each function is one behaviour."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable

from ucm_cts.adapters.reference.toolchain.program import reference


def accepts_everything(text: str) -> int:
    """It never refuses."""
    return 0


def refuses_everything(text: str) -> int:
    """It never accepts, so what it refuses proves nothing."""
    return 1


def dies(text: str) -> int:
    """It is killed by a signal where it should refuse."""
    if reference().check(text.encode(), "model.xml")[1]:
        os.abort()
    return 0


def hangs(text: str) -> int:
    """It never comes back."""
    time.sleep(3600)
    return 0


def floods(text: str) -> int:
    """It does not stop talking."""
    while True:
        os.write(1, b"x" * 65536)


def ends_oddly(text: str) -> int:
    """Its exit status means nothing that was described."""
    return 70


def leaves_a_child(text: str) -> int:
    """A child of its own goes on, with the output open."""
    if os.fork() == 0:
        time.sleep(3600)
    return 1 if reference().check(text.encode(), "model.xml")[1] else 0


def tells_the_time(text: str) -> int:
    """Its diagnostics begin with a time, and name lines of other files."""
    print("22:46:05: ERROR no good\nother.xml:9999: neither\nerror:1042: a number")
    return 1 if reference().check(text.encode(), "model.xml")[1] else 0


def points_to_ends(text: str) -> int:
    """It tells what is missing where the element ends, as validators do."""
    reported = reference().check(text.encode(), "model.xml")[1]
    if reported:
        print(f"model.xml:{text.rstrip().count(chr(10)) + 1}: content is not complete")
    return 1 if reported else 0


def refuses_the_root(text: str) -> int:
    """It knows no root around several outermost modules."""
    refused = "<Model" in text[:200] or reference().check(text.encode(), "model.xml")[1]
    return 1 if refused else 0


def has_a_greedy_child(text: str) -> int:
    """A child of it takes the memory."""
    if os.fork() == 0:
        kept = bytearray(300 << 20)
        kept[::4096] = b"x" * len(kept[::4096])
        time.sleep(3600)
    os.wait()
    return 0


def prints_rubbish(text: str) -> int:
    """Its output is no text."""
    sys.stdout.buffer.write(b"\xff\xfe\x00\x1b[2Jmodel.xml:1: \x80\n" * 3)
    return 1 if reference().check(text.encode(), "model.xml")[1] else 0


if __name__ == "__main__":
    behaviour: Callable[[str], int] = globals()[sys.argv[1]]
    with open(sys.argv[3], encoding="utf-8") as stream:
        sys.exit(behaviour(stream.read()))
