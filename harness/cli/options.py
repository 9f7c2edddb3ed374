"""Options and exit statuses that several commands share."""

from __future__ import annotations

import difflib
import math
import re
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NoReturn, TypeVar

import click
from click.core import ParameterSource

import ucm_cts
from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES, PROFILES, TOOLCHAIN_PROFILES
from ucm_cts.harness.catalogue.requirements import in_the_making, load_requirements
from ucm_cts.harness.cli.terminal import Output
from ucm_cts.harness.execution.driver import Limits
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.purposes.selection import words_of
from ucm_cts.harness.purposes.systematic.purposes import MOST_EXTRA
from ucm_cts.harness.report.summary import summary
from ucm_cts.harness.report.write import Saved
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.known_failures import KnownFailure, stale, succeeded
from ucm_cts.harness.results.values import Report
from ucm_cts.harness.statement.files import Identity

F = TypeVar("F", bound=Callable[..., Any])

CONFORMANT, NOT_CONFORMANT, WRONG_USE, HARNESS_FAILED = 0, 1, 2, 3
"""Exit statuses; NOT_CONFORMANT includes inconclusive runs."""


_UNITS = {"s": 1, "m": 60, "h": 3600}
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


@dataclass(frozen=True)
class Budget:
    """What drawing scenarios may cost: a number of seconds, or of scenarios."""

    amount: float
    is_time: bool = True

    def spent(self, scenarios: int, seconds: float) -> float:
        """The part of ``amount`` that is used up."""
        return seconds if self.is_time else scenarios


class DrawnScenarios(click.ParamType):  # type: ignore[type-arg] # generic since click 8.2
    """A budget as people write it. It may be nothing if ``or_none``."""

    name = "budget"

    def __init__(self, or_none: bool = False) -> None:
        self._or_none = or_none

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Budget:
        match = re.fullmatch(r"(\d{1,9})(s|m|h|scenarios)|(\d{1,6}\.\d{1,3})(s|m|h)", str(value))
        if match is None or not (self._or_none or float(match[1] or match[3])):
            self.fail(
                f"'{value}' is no budget; write a time or a number of scenarios: 60s, 5m, 2h, 500scenarios.", param, ctx
            )
        amount, unit = float(match[1] or match[3]), match[2] or match[4]
        return Budget(amount * _UNITS[unit]) if unit in _UNITS else Budget(amount, is_time=False)


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


def out_folder(default: str, text: str = "The folder for the report.") -> Callable[[F], F]:
    """The option ``--out`` of a command that writes a folder."""
    kind = Folder(file_okay=False, path_type=Path)
    return click.option("--out", type=kind, default=Path(default), show_default=True, help=text)


def out_file(default: str, text: str) -> Callable[[F], F]:
    """The option ``--out`` of a command that writes one file."""
    kind = click.Path(dir_okay=False, path_type=Path)
    return click.option("--out", type=kind, default=Path(default), show_default=True, help=text)


adapter_argument = click.argument("adapter", default="", required=False)
_PROFILE_HELP = "What to check: "
_OF_FRAMEWORKS = (
    "container is clauses 11 and 12.10, the life cycle and the Container API; core adds 10.1, connections; extensions adds the parts "
    "of 10.2 to 10.5 that the statement claims"
)
profile_option = click.option(
    "--profile",
    type=Profile(PROFILES),
    default="container",
    show_default=True,
    help=f"{_PROFILE_HELP}{_OF_FRAMEWORKS}; the others are of tool chains.",
)
framework_profile_option = click.option(
    "--profile",
    type=Profile(FRAMEWORK_PROFILES),
    default="container",
    show_default=True,
    help=f"{_PROFILE_HELP}{_OF_FRAMEWORKS}.",
)
in_process_option = click.option(
    "--in-process", is_flag=True, help="Run the product in the process of ucm-cts: for debuggers and sanitizers."
)
virtual_time_option = click.option(
    "--virtual-time",
    is_flag=True,
    help="Run the product in virtual time, in which waits take no time; a report says so.",
)
jobs_option = click.option(
    "--jobs",
    type=click.IntRange(min=1),
    help="How many hosts there may be at once: scenarios that wait do so side by side, and those of a slow product. [default: hosts-at-once of the statement]",
)
no_sandbox_option = click.option(
    "--no-sandbox", is_flag=True, help="Run the product without a sandbox; a report says so."
)
seed_option = click.option(
    "--seed", type=int, help="Repeat a run: all names and data that a product sees are drawn from this number."
)
ics_option = click.option(
    "--ics", type=click.Path(dir_okay=False, path_type=Path), help="The vendor's statement; 'ucm-cts ics' writes one."
)
toolchain_option = click.option(
    "--toolchain",
    type=click.Path(dir_okay=False, path_type=Path),
    help="A file that describes a tool chain, which is tested instead of an adapter.",
)
timeout_option = click.option(
    "--timeout",
    type=Seconds(min=0.1),
    default=Limits.seconds,
    show_default=True,
    help="Seconds that a scenario may take.",
)


memory_option = click.option(
    "--memory",
    type=click.IntRange(min=16),
    default=Limits.memory,
    show_default=True,
    help="MiB that the product may use, with all processes that it starts.",
)
incident_time_option = click.option(
    "--incident-time",
    type=Seconds(min=0),
    default=Limits.incident_seconds,
    show_default=True,
    help="Seconds that crashes and hangs may take in all; then scenarios that would meet more of them are left out.",
)
systematic_option = click.option(
    "--systematic",
    type=click.IntRange(0, MOST_EXTRA),
    default=0,
    show_default=True,
    help="Find every framework that has up to so many states more than the life-cycle table.",
)
explore_option = click.option(
    "--explore",
    type=DrawnScenarios(or_none=True),
    default="2s",
    show_default=True,
    help="How long to draw random scenarios after those of the suite, or how many: 3s, 500scenarios, 0s for none.",
)
known_failures_option = click.option(
    "--known-failures", type=click.Path(dir_okay=False, path_type=Path), help="A file with failures expected for now."
)
everything_option = click.option(
    "--all", "everything", is_flag=True, help="List every failure, cause and undecided requirement."
)


OF_FRAMEWORKS = (
    "repeat",
    "in_process",
    "virtual_time",
    "jobs",
    "timeout",
    "memory",
    "incident_time",
    "systematic",
    "explore",
    "resume",
)
"""Options that tool chains do not have."""


def profile_for(context: click.Context, toolchain: Path | None, profile: str) -> str:
    """The profile of an adapter, or of ``toolchain``, which has another default and not all options. Raises ``WrongUse``."""
    if toolchain is None:
        if profile in TOOLCHAIN_PROFILES:
            raise WrongUse(f"profile '{profile}' is of tool chains; name the file that describes one with --toolchain")
        return profile
    refuse(context, ("adapter", *OF_FRAMEWORKS))
    chosen = profile if _is_given(context, "profile") else TOOLCHAIN_PROFILES[0]
    if chosen not in TOOLCHAIN_PROFILES:
        raise WrongUse(f"profile '{chosen}' is of frameworks; a tool chain has {', '.join(TOOLCHAIN_PROFILES)}")
    return chosen


def refuse(context: click.Context, parameters: Sequence[str]) -> None:
    """Raise ``WrongUse`` if one of ``parameters`` was given, because only adapters have them."""
    for parameter in context.command.params:
        if parameter.name in parameters and _is_given(context, parameter.name):
            name = "ADAPTER" if parameter.name == "adapter" else parameter.opts[0]
            raise WrongUse(
                f"{name} is for frameworks behind adapters, and --toolchain names a tool chain; leave one out"
            )


def _is_given(context: click.Context, parameter: str) -> bool:
    return context.get_parameter_source(parameter) is ParameterSource.COMMANDLINE


def nothing_selected(expression: str, candidates: Iterable[str], what: str) -> WrongUse:
    """``-k`` selected none of ``what``, though there are ``candidates``."""
    words = words_of(expression)
    near = [name for word in words for name in difflib.get_close_matches(word, [*dict.fromkeys(candidates)], 3, 0.5)]
    reasons = [
        f"; {r.id} is not tested: {r.untestable or r.pending}"
        for r in load_requirements()
        if r.id.lower() in words and (r.untestable or r.pending)
    ]
    hint = f"; near it: {', '.join(dict.fromkeys(near))}" if near else ""
    return WrongUse(
        f"no {what} matches -k '{expression}'{''.join(reasons) or hint}; try a requirement, a clause or an operation"
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
    saved: Saved,
    known: Sequence[KnownFailure],
    everything: bool = False,
) -> NoReturn:
    """Print the end of a run, and end with its status. After a whole run, ``known`` failures that are gone are named."""
    lost = saved.place is None
    whole = lost or not console.is_terminal
    console.print(summary(report, saved.place, whole, everything or lost), soft_wrap=whole or everything)
    is_partial = bool(report.selection or report.incomplete)
    outdated = [] if is_partial else stale(known, report.requirements)
    for entry in outdated:
        console.say(f"known failure of {entry.requirement} no longer occurs ({entry.observed}): remove it")
    if report.incomplete.startswith("interrupted"):
        console.print("interrupted: the report holds what was measured so far")
    elif report.incomplete:
        console.say(f"{report.incomplete}; the report holds the runs before")
    if saved.problem:
        console.file.flush()
        where = "no folder took it, and this summary is all that is left" if lost else f"it is in '{saved.place}'"
        click.echo(f"ucm-cts: the report cannot be written: {saved.problem}; {where}", err=True)
        sys.exit(HARNESS_FAILED)
    failed = outdated or report.incomplete or not succeeded(report)
    leave(console, NOT_CONFORMANT if failed else CONFORMANT, f"; the report is in {saved.place}")


def leave(console: Output, status: int, remainder: str = "") -> NoReturn:
    """End with ``status``, or with a failure if output was lost."""
    console.file.flush()
    if console.error:
        click.echo(f"ucm-cts: standard output cannot be written: {console.error}{remainder}", err=True)
        sys.exit(HARNESS_FAILED)
    sys.exit(status)
