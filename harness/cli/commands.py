"""The command line: ``ucm-cts run``, ``ics``, ``explain``, ``replay``. Thin: reads arguments, calls the pipeline, prints."""

from __future__ import annotations

import os
import random
import resource
import sys
from collections.abc import Sequence
from pathlib import Path

import click
from click.core import ParameterSource

import ucm_cts
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.catalogue.profiles import PROFILES, TOOLCHAIN_PROFILES
from ucm_cts.harness.catalogue.requirements import load_life_cycle, load_requirements
from ucm_cts.harness.cli import options
from ucm_cts.harness.cli.certificate_commands import CERTIFICATE_COMMANDS
from ucm_cts.harness.cli.compare_command import compare
from ucm_cts.harness.cli.explanation import explanation, overview
from ucm_cts.harness.cli.explore_command import explore
from ucm_cts.harness.cli.framework_run import FrameworkRun, certify_framework
from ucm_cts.harness.cli.history_command import history
from ucm_cts.harness.cli.publish_command import publish
from ucm_cts.harness.cli.results_command import results
from ucm_cts.harness.cli.selftest_command import selftest
from ucm_cts.harness.cli.terminal import Output, ends_like_interrupts
from ucm_cts.harness.cli.toolchain_command import ToolChainRun, certify_toolchain, profiles_of
from ucm_cts.harness.execution.driver import Driver, Limits
from ucm_cts.harness.execution.offers import LIMITS, offers_of
from ucm_cts.harness.hosting.extras import remedy_for
from ucm_cts.harness.hosting.hosts import HostUnavailable
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.purposes.scripts import read_scripts, to_scenario
from ucm_cts.harness.purposes.systematic.purposes import MOST_EXTRA
from ucm_cts.harness.report.diagrams.sequence_text import finding_text, printed_text, replay_text
from ucm_cts.harness.results.foreign import LONGEST_STACKS, clean
from ucm_cts.harness.statement.files import stated_by
from ucm_cts.harness.statement.writing import Wanted, write_statement, write_toolchain_statement
from ucm_cts.harness.toolchains.commands.description import read_toolchain
from ucm_cts.harness.toolchains.declarations import asked_of_declared
from ucm_cts.reference_models.monitor import Monitor


@click.group(context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(ucm_cts.__version__, prog_name="ucm-cts")
def cli() -> None:
    """Certify a UCM framework: does it do what the Unified Component Model says, and how do you know?"""


@cli.command()
@options.adapter_argument
@options.profile_option
@click.option("-k", "expression", default="", help="Only test purposes whose id, clause or requirement contains this.")
@options.seed_option
@options.out_folder("ucm-cts-report")
@click.option("--known-failures", type=click.Path(dir_okay=False, path_type=Path), help="Failures expected for now.")
@options.ics_option
@options.toolchain_option
@click.option("--repeat", type=click.IntRange(min=1), default=1, show_default=True, help="Runs, with a seed each.")
@options.in_process_option
@options.no_sandbox_option
@options.timeout_option
@click.option("--memory", type=click.IntRange(min=16), default=1024, show_default=True, help="MiB a host may use.")
@click.option(
    "--incident-time",
    type=options.Seconds(min=0),
    default=Limits.incident_seconds,
    show_default=True,
    help="Seconds that crashes and hangs may take in all before scenarios that would meet more of them are left out.",
)
@click.option(
    "--systematic",
    type=click.IntRange(0, MOST_EXTRA),
    default=0,
    show_default=True,
    help="Systematic suites find out frameworks with so many states more than the life-cycle table gives them.",
)
@click.option(
    "--explore",
    type=options.DrawnScenarios(or_none=True),
    default="2s",
    show_default=True,
    help="How long to draw random scenarios after those of the suite, or how many: 3s, 500scenarios, 0s.",
)
@click.option("--failed-first", is_flag=True, help="Begin with what failed in the last run into the same --out.")
@click.option("--resume", is_flag=True, help="Go on with the interrupted run in the same --out.")
@click.option("--all", "everything", is_flag=True, help="List every failure, cause and undecided requirement.")
@click.pass_context
def run(
    context: click.Context,
    adapter: str,
    profile: str,
    expression: str,
    seed: int | None,
    out: Path,
    known_failures: Path | None,
    ics: Path | None,
    toolchain: Path | None,
    repeat: int,
    in_process: bool,
    no_sandbox: bool,
    timeout: float,
    memory: int,
    incident_time: float,
    systematic: int,
    explore: options.Budget,
    failed_first: bool,
    resume: bool,
    everything: bool,
) -> None:
    """Run a profile on ADAPTER, or on a tool chain, and write report.html, report.json and junit.xml.

    ADAPTER is a short name (reference-cpp, reference-py, ipopo, ...), package.module:Class, a pybind11 module, an
    executable, tcp://host:port or unix:/path. Exit status: 0 conformant, 1 not conformant or inconclusive, 2 wrong
    use, 3 the harness failed.
    """
    drawn = seed if seed is not None else random.SystemRandom().randrange(2**32)
    if toolchain is not None:
        _refuse(context, ("adapter", *OF_FRAMEWORKS))
        chosen = profile if _is_given(context, "profile") else TOOLCHAIN_PROFILES[0]
        certify_toolchain(
            ToolChainRun(
                toolchain, chosen, expression, out, known_failures, ics, drawn, everything, failed_first, not no_sandbox
            )
        )
    if profile in TOOLCHAIN_PROFILES:
        raise WrongUse(f"profile '{profile}' is of tool chains; name the file that describes one with --toolchain")
    certify_framework(
        FrameworkRun(
            adapter=adapter,
            profile=profile,
            expression=expression,
            seed=drawn,
            out=out,
            known_failures=known_failures,
            ics=ics,
            repeat=repeat,
            in_process=in_process,
            sandbox=not no_sandbox,
            limits=Limits(timeout, memory, incident_seconds=incident_time),
            systematic=systematic,
            explore=explore,
            everything=everything,
            failed_first=failed_first,
            resume=resume,
            is_seeded=seed is not None,
        )
    )


OF_FRAMEWORKS = ("repeat", "in_process", "timeout", "memory", "incident_time", "systematic", "explore", "resume")
"""Options of ``run`` that tool chains do not have."""


def _is_given(context: click.Context, parameter: str) -> bool:
    return context.get_parameter_source(parameter) is ParameterSource.COMMANDLINE


def _refuse(context: click.Context, parameters: Sequence[str]) -> None:
    """Raise ``WrongUse`` if one of ``parameters`` was given, because only adapters have them."""
    for parameter in context.command.params:
        if parameter.name in parameters and _is_given(context, parameter.name):
            name = "ADAPTER" if parameter.name == "adapter" else parameter.opts[0]
            raise WrongUse(
                f"{name} is for frameworks behind adapters, and --toolchain names a tool chain; leave one out"
            )


@cli.command()
@options.adapter_argument
@options.out_file("ucm-cts-ics.toml")
@options.toolchain_option
@options.no_sandbox_option
@click.option("--force", is_flag=True, help="Write over a file that is there.")
@click.option("--full", is_flag=True, help="With every value that can be stated, and what it means.")
@click.option(
    "--profile", type=options.Profile(PROFILES), help="Claim this profile.  [default: what the product can have]"
)
@click.pass_context
def ics(
    context: click.Context,
    adapter: str,
    out: Path,
    toolchain: Path | None,
    no_sandbox: bool,
    force: bool,
    full: bool,
    profile: str | None,
) -> None:
    """Write the statement of the product behind ADAPTER, or of a tool chain, for its vendor to edit.

    It claims what the adapter offers, and has what differs from the defaults and what the vendor must decide. Give the edited
    one to 'ucm-cts run --ics'.
    """
    subject = adapter
    wanted = Wanted(out, force, full, profile or "")
    if toolchain is not None:
        _refuse(context, ("adapter",))
        subject = f"--toolchain {toolchain}"
        described = read_toolchain(toolchain)
        possible = profiles_of(described)
        if profile and profile not in possible:
            raise WrongUse(f"{toolchain} says how {', '.join(possible)} are done, and not '{profile}'")
        write_toolchain_statement(wanted, described, possible, toolchain, asked_of_declared())
    else:
        if profile in TOOLCHAIN_PROFILES:
            raise WrongUse(f"profile '{profile}' is of tool chains; name the file that describes one with --toolchain")
        with ends_like_interrupts(), Driver(locate(adapter, sandbox=not no_sandbox), 0, LIMITS) as driver:
            identity, offers = driver.identity, offers_of(driver)
        write_statement(wanted, identity, adapter, offers)
    console = Output()
    console.say(f"{out} is written; edit it, then: ucm-cts run {subject} --ics {out}")
    options.leave(console, options.CONFORMANT)


@cli.command()
@click.argument("topic", default="", required=False)
def explain(topic: str) -> None:
    """Explain TOPIC: a requirement (R-11.2.2.1-13), a clause (10.1.3) or an operation (remove_component, on_disconnect).

    A requirement with its clause, level, meaning, interpretation and scenarios; a clause or an operation with the requirements
    that concern it. Without TOPIC, list the catalogue.
    """
    console = Output()
    console.print(explanation(topic) if topic else overview(), soft_wrap=not console.is_terminal)
    options.leave(console, options.CONFORMANT)


@cli.command()
@click.argument("file", type=click.Path(dir_okay=False, path_type=Path))
@options.adapter_argument
@options.ics_option
@options.in_process_option
@options.no_sandbox_option
@options.seed_option
@options.timeout_option
def replay(
    file: Path,
    adapter: str,
    ics: Path | None,
    in_process: bool,
    no_sandbox: bool,
    seed: int | None,
    timeout: float,
) -> None:
    """Run the scenario in FILE on ADAPTER and print what happens as a sequence diagram.

    Exit status 1 if there is any finding.
    """
    if file.suffix == ".xml":
        raise WrongUse(
            f"{file} is a model and no scenario; the report shows the command that gives it to the tool chain again"
        )
    scripts = read_scripts(file, may_overlap=True)
    endpoint = locate(adapter, in_process, sandbox=not no_sandbox)
    monitor = Monitor(load_life_cycle(), stated_by(ics, adapter, not no_sandbox).ics)
    titles = {requirement.id: requirement.title for requirement in load_requirements()}
    console = Output()
    failed = False
    with ends_like_interrupts(), Driver(endpoint, seed or 0, Limits(timeout)) as driver:
        for script in scripts:
            (answer,) = driver.run([(script.scenario, to_scenario(script))])
            execution = driver.revealed(answer)
            judged = monitor.judge(answer.disguised, answer.trace).findings if execution.incident is None else ()
            findings = [driver.reveal(finding) for finding in judged]
            console.out(f"{execution.name} on {options.name_of(driver.identity)}\n", highlight=False)
            console.out(replay_text(execution, findings), highlight=False)
            if answer.printed.strip():
                console.out(printed_text(answer.printed, file, adapter), highlight=False)
            if execution.incident is not None:
                failed = True
                text = f"{clean(execution.incident.detail)}\n{clean(execution.incident.stacks, LONGEST_STACKS)}"
                console.out(f"\n{execution.incident.kind}: {text}", highlight=False)
                continue
            for finding in findings:
                console.out("\n" + finding_text(finding, titles[finding.requirement], execution), highlight=False)
            failed = failed or bool(findings)
            number = f"{len(findings) or 'no'} finding{'' if len(findings) == 1 else 's'}"
            console.out(f"\n{number}", highlight=False)
    options.leave(console, options.NOT_CONFORMANT if failed else options.CONFORMANT)


cli.add_command(selftest)
cli.add_command(explore)
cli.add_command(compare)
cli.add_command(results)
cli.add_command(publish)
for certificate_command in CERTIFICATE_COMMANDS:
    cli.add_command(certificate_command)
cli.add_command(history)


def _check_current_folder() -> None:
    """Raise ``WrongUse`` if there is none: paths and adapters are looked for in it."""
    try:
        os.getcwd()
    except OSError as error:
        raise WrongUse(f"the current folder cannot be used: {error.strerror}; go to another one") from None


_OPEN_FILES = 64
"""Hosts and their channels, the report and what is loaded need fewer open files than this."""


def _permit_open_files() -> None:
    """Raise the limit of open files as far as needed. Raises ``WrongUse`` if the system does not permit that."""
    usual, most = resource.getrlimit(resource.RLIMIT_NOFILE)
    if usual == resource.RLIM_INFINITY or usual >= _OPEN_FILES:
        return
    if most != resource.RLIM_INFINITY and most < _OPEN_FILES:
        needed = f"{_OPEN_FILES} are needed: ulimit -n {_OPEN_FILES}"
        raise WrongUse(f"at most {most} files may be open at once; {needed}, or what your system has for that")
    resource.setrlimit(resource.RLIMIT_NOFILE, (_OPEN_FILES, most))


def main() -> None:
    """The console entry point: turns an error into one clear line and an exit status."""
    try:
        _check_current_folder()
        _permit_open_files()
        cli(standalone_mode=False)
    except click.exceptions.Exit as end:
        sys.exit(end.exit_code)
    except click.ClickException as error:
        error.show()
        sys.exit(options.WRONG_USE)
    except (WrongUse, DocumentError, HostUnavailable) as error:
        click.echo(f"ucm-cts: {clean(str(error))}", err=True)
        sys.exit(options.WRONG_USE)
    except (click.exceptions.Abort, KeyboardInterrupt):
        click.echo("ucm-cts: interrupted", err=True)
        sys.exit(options.HARNESS_FAILED)
    except ImportError as error:
        remedy = remedy_for(error)
        click.echo(f"ucm-cts: {remedy or f'the harness failed: {type(error).__name__}: {error}'}", err=True)
        sys.exit(options.WRONG_USE if remedy else options.HARNESS_FAILED)
    except Exception as error:  # noqa: BLE001 - the last resort: a user sees one line, not a traceback
        click.echo(f"ucm-cts: the harness failed: {type(error).__name__}: {error}", err=True)
        sys.exit(options.HARNESS_FAILED)
