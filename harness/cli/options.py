"""Options and exit statuses that several commands share."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NoReturn, TypeVar

import click

import ucm_cts
from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES, PROFILES
from ucm_cts.harness.catalogue.requirements import in_the_making
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.execution.driver import Limits
from ucm_cts.harness.report.summary import summary
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.known_failures import KnownFailure, stale, succeeded
from ucm_cts.harness.results.values import Report
from ucm_cts.harness.statement.files import Identity

F = TypeVar("F", bound=Callable[..., Any])

CONFORMANT, NOT_CONFORMANT, WRONG_USE, HARNESS_FAILED = 0, 1, 2, 3
"""Exit statuses; NOT_CONFORMANT includes inconclusive runs."""

DEFAULT_ADAPTER = "reference-cpp"


MOST_SECONDS = 86_400
"""The longest time that an option can give."""


class Seconds(click.FloatRange):
    """A finite number of seconds."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        seconds = super().convert(value, param, ctx)
        if seconds > MOST_SECONDS and math.isfinite(seconds):
            self.fail(f"'{value}' is longer than a day; give at most {MOST_SECONDS} seconds.", param, ctx)
        if not math.isfinite(seconds):
            self.fail(f"'{value}' is no number of seconds.", param, ctx)
        return seconds


class Folder(click.Path):
    """A folder; its name must not be empty."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        if value == "":
            self.fail("name a folder for the report.", param, ctx)
        return super().convert(value, param, ctx)


class Profile(click.Choice):  # type: ignore[type-arg] # generic since click 8.2
    """A profile that can be chosen; the message for another one says why."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        unfinished = in_the_making(value)
        if unfinished:
            self.fail(f"{unfinished}; there is {', '.join(self.choices)}.", param, ctx)
        return super().convert(value, param, ctx)


def out_folder(default: str, text: str = "") -> Callable[[F], F]:
    """The option ``--out`` of a command that writes a folder."""
    kind = Folder(file_okay=False, path_type=Path)
    return click.option("--out", type=kind, default=Path(default), show_default=True, help=text or None)


def out_file(default: str, text: str = "") -> Callable[[F], F]:
    """The option ``--out`` of a command that writes one file."""
    kind = click.Path(dir_okay=False, path_type=Path)
    return click.option("--out", type=kind, default=Path(default), show_default=True, help=text or None)


adapter_argument = click.argument("adapter", default=DEFAULT_ADAPTER, required=False)
profile_option = click.option("--profile", type=Profile(PROFILES), default="container", show_default=True)
framework_profile_option = click.option(
    "--profile", type=Profile(FRAMEWORK_PROFILES), default="container", show_default=True
)
in_process_option = click.option("--in-process", is_flag=True, help="No host process: for debuggers and sanitizers.")
seed_option = click.option("--seed", type=int, help="Repeat a run: names and payloads are drawn from it.")
ics_option = click.option("--ics", type=click.Path(dir_okay=False, path_type=Path), help="The vendor's statement.")
toolchain_option = click.option(
    "--toolchain",
    type=click.Path(dir_okay=False, path_type=Path),
    help="The tool chain that this file describes, instead of an adapter.",
)
timeout_option = click.option(
    "--timeout", type=Seconds(min=0.1), default=Limits.seconds, show_default=True, help="Seconds a scenario may take."
)


def name_of(identity: Identity) -> str:
    """Product and version, on one line."""
    return one_line(f"{identity.product} {identity.version}", 80)


def greet(console: Output, what: str, profile: str, seed: int) -> None:
    """Print product, profile and seed."""
    console.say(f"UCM-CTS {ucm_cts.__version__}: {what}, profile {profile}, seed {seed}")


def leave_with(
    console: Output,
    report: Report,
    out: Path,
    known: Sequence[KnownFailure],
    is_whole: bool,
    interrupted: bool,
    cut_short: str = "",
) -> NoReturn:
    """Print the end of a run, and end with its status. If the run ``is_whole``, ``known`` failures that are gone are named."""
    console.print(summary(report, out))
    outdated = stale(known, report.requirements) if is_whole and not interrupted else []
    for entry in outdated:
        console.say(f"known failure of {entry.requirement} no longer occurs ({entry.observed}): remove it")
    if interrupted:
        console.print("interrupted: the report holds what was measured so far")
    if cut_short:
        console.say(f"{cut_short}; the report holds the runs before")
    failed = outdated or interrupted or cut_short or not succeeded(report)
    leave(console, NOT_CONFORMANT if failed else CONFORMANT, f"; the report is in {out}")


def leave(console: Output, status: int, remainder: str = "") -> NoReturn:
    """End with ``status``, or with a failure if output was lost."""
    console.file.flush()
    if console.error:
        click.echo(f"ucm-cts: standard output cannot be written: {console.error}{remainder}", err=True)
        sys.exit(HARNESS_FAILED)
    sys.exit(status)
