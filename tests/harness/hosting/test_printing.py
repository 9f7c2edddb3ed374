"""However much a host prints, its end is kept, and neither memory nor disk grows with it."""

from __future__ import annotations

import os
import re
from pathlib import Path

import pytest
from aftermath import nothing_left  # noqa: F401 - a fixture

from ucm_cts.adapters.contract.messages import Run
from ucm_cts.adapters.contract.scenario import Scenario
from ucm_cts.harness.hosting.hosts import Hosts, HostUnavailable, Limits
from ucm_cts.harness.hosting.last_words import KEPT, Listener
from ucm_cts.harness.hosting.locate import locate
from ucm_cts.harness.results.foreign import LONGEST_STACKS, clean
from ucm_cts.harness.results.values import Incident

pytestmark = pytest.mark.usefixtures("nothing_left")

LIMITS = Limits(seconds=20, memory=250)
FLOOD = "[os.write(2, b'x' * 65535 + b'\\n') for _ in range(200)]; os.write(2, b'last words\\n')"
MINE = """
import os, subprocess
from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter
{top}

class Mine(ReferenceAdapter):
    def create_runtime(self, implementations):
        {each}
        return super().create_runtime(implementations)
"""


def adapter(here: Path, top: str = "", each: str = "pass") -> str:
    (here / "mine.py").write_text(MINE.format(top=top, each=each))
    return "mine:Mine"


def is_bounded(text: str) -> bool:
    """Whether the last words of a flood are there, and in a report, too, after what says how much is missing."""
    shown = clean(text, LONGEST_STACKS)
    return (
        bool(re.match(r"\(\d{8} bytes were printed before and are not kept\)\n", shown))
        and shown.endswith("last words\n")
        and len(text) <= LONGEST_STACKS
    )


def test_a_host_that_prints_and_dies_is_heard_to_the_end(here: Path) -> None:
    with Hosts(locate(adapter(here, each=f"{FLOOD}; os._exit(3)")), LIMITS) as hosts:
        (answer,) = hosts.run([Run(0, Scenario({}, ()))])
    assert isinstance(answer.reply, Incident)
    assert is_bounded(answer.reply.stacks)


def test_a_host_that_prints_and_lives_is_heard_to_the_end(here: Path) -> None:
    with Hosts(locate(adapter(here, each=FLOOD)), LIMITS) as hosts:
        (answer,) = hosts.run([Run(0, Scenario({}, ()))])
    assert is_bounded(answer.printed)


def test_an_adapter_that_prints_when_it_is_loaded_is_heard_to_the_end(here: Path) -> None:
    with Hosts(locate(adapter(here, f"{FLOOD}; os._exit(3)")), LIMITS) as hosts, pytest.raises(HostUnavailable) as said:
        hosts.welcome  # noqa: B018
    assert is_bounded(said.value.incident.stacks)


def test_a_helper_that_never_stops_to_print_holds_up_nothing(here: Path) -> None:
    with Hosts(locate(adapter(here, "subprocess.Popen('yes', stdout=2)")), LIMITS) as hosts:
        (answer,) = hosts.run([Run(0, Scenario({}, ()))])
    assert not isinstance(answer.reply, Incident)


def test_who_prints_never_waits() -> None:
    listener = Listener()
    for _ in range(100):
        os.write(listener.target, b"x" * (1 << 16))
    listener.close()
    assert listener.text() == f"({(100 << 16) - KEPT} bytes were printed before and are not kept)\n" + "x" * KEPT
