"""Prints the generated part of commands.md, from the commands themselves: ``python docs/commands.py``."""

from __future__ import annotations

import inspect
from collections.abc import Iterator

import click

from ucm_cts.harness.cli.commands import cli

HEADING = "## Commands"

MORE = {
    "run": "report.md",
    "certify": "certificates.md",
    "verify": "certificates.md",
    "commit": "certificates.md",
    "challenge": "certificates.md",
    "history": "ci.md#history",
    "campaign": "campaigns.md",
    "compare": "report.md#what-changed",
    "publish": "publication.md",
    "explore": "explore.md",
    "selftest": "detection.md",
    "replay": "scenarios.md",
    "ics": "statement.md",
    "results": "report.md#published-results",
    "--profile": "profile-core.md",
    "--toolchain": "toolchains.md",
    "--ics": "statement.md",
    "--known-failures": "known-failures.md",
    "--no-sandbox": "verdicts.md#isolation",
    "--virtual-time": "virtual-time.md",
    "--incident-time": "verdicts.md",
    "--repeat": "verdicts.md",
    "--systematic": "systematic.md",
    "--explore": "explore.md#in-every-run",
    "--baseline": "report.md#what-changed",
    "--budget": "explore.md",
}
"""The page that says more, by command or option."""


def commands() -> Iterator[str]:
    """Each command with its arguments, and what it does."""
    for name, command in sorted(cli.commands.items()):
        arguments = [p.make_metavar(click.Context(command)) for p in command.params if isinstance(p, click.Argument)]
        more = f" ([more]({MORE[name]}))" if name in MORE else ""
        text = " ".join(inspect.cleandoc(command.help or "").split())
        yield f"**{' '.join((name, *arguments))}**: {text}{more}\n"


def options() -> Iterator[str]:
    """Each option, with the commands that have it; one that means several things has a row for each."""
    rows: dict[tuple[str, str], list[str]] = {}
    for name, command in sorted(cli.commands.items()):
        context = click.Context(command)
        for option in command.params:
            if isinstance(option, click.Option):
                record = option.get_help_record(context)
                assert record is not None
                typed, meaning = record[0].replace(" RANGE", ""), record[1]
                rows.setdefault((typed, meaning), []).append(name)
    for (typed, meaning), names in sorted(rows.items(), key=lambda row: row[0][0].lstrip("-").lower()):
        more = f" ([more]({MORE[typed.split()[0]]}))" if typed.split()[0] in MORE else ""
        yield f"| `{typed.replace('|', chr(92) + '|')}` | {', '.join(names)} | {' '.join(meaning.split())}{more} |"


if __name__ == "__main__":
    print(HEADING, "", *commands(), sep="\n")
    print("## Options\n\n| option | of | meaning |\n|---|---|---|", *options(), sep="\n")
