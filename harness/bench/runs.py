"""What whole runs take: ``python -m ucm_cts.harness.bench.runs``; with ``--slow`` a product that takes 50 ms an operation, too, in ten minutes."""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console

from ucm_cts.harness.bench.measuring import empty_table

AIMS = {"container": 0.8, "core": 10.0, "extensions": 45.0}
"""Seconds of a run of the C++ reference framework on two idle cores."""

VIRTUAL_AIM = 15.0
"""Seconds of profile extensions in virtual time, which has one host."""

_ONE_HOST = ("container", "core")
"""Profiles that are run with one host, too; the other one waits for minutes."""

SLOW_AIM = 600.0
"""Seconds of profile core for a product that takes 50 ms an operation, with 8 hosts."""

_SLOW = """
import time

from ucm_cts.adapters.reference.python.adapter import ReferenceAdapter

OPERATIONS = (
    "create_runtime", "destroy", "start", "stop", "add_component", "remove_component", "create_container", "remove_container",
    "connect", "disconnect", "get_port_element", "get_components",
)

def later(operation):
    def after(*arguments):
        time.sleep(0.05)
        return operation(*arguments)
    return after

Slow = type("Slow", (ReferenceAdapter,), {name: later(getattr(ReferenceAdapter, name)) for name in OPERATIONS})
"""


@dataclass(frozen=True)
class _Run:
    """``whole``: seconds of the command; ``seconds``: those that the report names."""

    whole: float
    scenarios: int
    seconds: float


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--adapter", default="reference-cpp")
    parser.add_argument("--slow", action="store_true")
    options = parser.parse_args()
    console = Console()
    table = empty_table(f"Runs of {options.adapter}, seconds", "profile|scenarios|one host|as usual|the command|aim")
    for profile, aim in AIMS.items():
        alone = f"{_run(options.adapter, profile, '--jobs', '1').seconds:.1f}" if profile in _ONE_HOST else ""
        usual = _run(options.adapter, profile)
        figures = (f"{usual.scenarios:,}", alone, f"{usual.seconds:.1f}", f"{usual.whole:.1f}", f"{aim:.1f}")
        table.add_row(profile, *figures)
    virtual = _run(options.adapter, "extensions", "--virtual-time")
    figures = (f"{virtual.scenarios:,}", f"{virtual.seconds:.1f}", "", f"{virtual.whole:.1f}", f"{VIRTUAL_AIM:.1f}")
    table.add_row("extensions, in virtual time", *figures)
    console.print(table)
    if options.slow:
        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "slow.py").write_text(_SLOW)
            slow = _run("slow:Slow", "core", "--jobs", "8", folder=folder)
        console.print(
            f"50 ms an operation, core, 8 hosts: {slow.scenarios} scenarios, {slow.seconds:.0f} s (aim {SLOW_AIM:.0f})"
        )


def _run(adapter: str, profile: str, *options: str, folder: str | None = None) -> _Run:
    """Run it as a user does, and read its report. Raises ``AssertionError`` if it is not conformant."""
    with tempfile.TemporaryDirectory() as out:
        command = [sys.executable, "-m", "ucm_cts", "run", adapter, "--profile", profile, "--seed", "1", "--out", out]
        began = time.perf_counter()
        subprocess.run([*command, *options], check=False, stdout=subprocess.DEVNULL, cwd=folder)
        whole = time.perf_counter() - began
        report = json.loads(Path(out, "report.json").read_text())
    assert report["verdict"] == "conformant", f"{adapter}, {profile}: {report['verdict']}"
    return _Run(whole, report["scenarios"], report["seconds"])


if __name__ == "__main__":
    main()
