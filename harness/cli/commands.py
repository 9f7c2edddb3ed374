"""The command line: ``ucm-cts run``, ``ics``, ``explain``, ``replay``. Thin: reads arguments, calls the pipeline, prints."""

from __future__ import annotations

import gc
import os
import random
import resource
import sys
from pathlib import Path

import click

import ucm_cts
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.catalogue.profiles import PROFILES, TOOLCHAIN_PROFILES
from ucm_cts.harness.catalogue.requirements import load_life_cycle, load_requirements
from ucm_cts.harness.cli import options
from ucm_cts.harness.cli.campaign_command import campaign
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
from ucm_cts.harness.hosting.compiled_parts import HOW_TO_COMPILE
from ucm_cts.harness.hosting.extras import need, remedy_for
from ucm_cts.harness.hosting.hosts import HostUnavailable
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.purposes.scripts import read_scripts, to_scenario
from ucm_cts.harness.report.diagrams.sequence_text import finding_text, printed_text, replay_text
from ucm_cts.harness.results.foreign import LONGEST_STACKS, clean
from ucm_cts.harness.statement.files import stated_by
from ucm_cts.harness.statement.writing import Wanted, write_statement, write_toolchain_statement
from ucm_cts.harness.toolchains.commands.description import read_toolchain
from ucm_cts.harness.toolchains.declarations import asked_of_declared
from ucm_cts.reference_models.monitor import Monitor


def _print_cmakedir(context: click.Context, _option: click.Parameter, is_asked: bool) -> None:
    if not is_asked:
        return
    folder = Path(ucm_cts.__file__).parent / "share" / "cmake" / "ucm_cts"
    if not folder.is_dir():
        raise WrongUse(f"this installation has no CMake package: {HOW_TO_COMPILE}")
    click.echo(folder)
    context.exit()


@click.group(context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(ucm_cts.__version__, prog_name="ucm-cts")
@click.option(
    "--cmakedir",
    is_flag=True,
    is_eager=True,
    expose_value=False,
    callback=_print_cmakedir,
    help="Print where CMake finds the package for adapters in C++.",
)
def cli() -> None:
    """Conformance tests for the Unified Component Model (UCM): test a product, certify it, verify certificates, publish."""


@cli.command()
@options.adapter_argument
@options.profile_option
@click.option(
    "-k",
    "expression",
    default="",
    help="Test only what concerns this: a requirement, a clause, an operation or a part of such a name.",
)
@options.seed_option
@options.out_folder("ucm-cts-report")
@options.known_failures_option
@options.ics_option
@options.toolchain_option
@click.option(
    "--repeat",
    type=click.IntRange(min=1),
    default=1,
    show_default=True,
    help="Run everything so often, with another seed each time; a verdict that changes is unstable.",
)
@options.in_process_option
@options.virtual_time_option
@options.jobs_option
@options.no_sandbox_option
@options.timeout_option
@options.memory_option
@options.incident_time_option
@options.systematic_option
@options.explore_option
@click.option("--failed-first", is_flag=True, help="Begin with what failed in the last run into the same --out.")
@click.option("--resume", is_flag=True, help="Go on with the interrupted run in the same --out.")
@options.everything_option
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
    virtual_time: bool,
    jobs: int | None,
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
    """Test a product, and write a report.

    ADAPTER is a short name (reference-cpp, reference-py, ipopo, ...), package.module:Class, a pybind11 module, an
    executable, tcp://host:port or unix:/path; --toolchain names a tool chain instead. The report is report.html for
    people, report.json and junit.xml for machines. Exit status: 0 conformant, 1 not conformant or inconclusive, 2 wrong
    use, 3 UCM-CTS itself failed.
    """
    drawn = seed if seed is not None else random.SystemRandom().randrange(2**32)
    profile = options.profile_for(context, toolchain, profile)
    if toolchain is not None:
        certify_toolchain(
            ToolChainRun(
                toolchain,
                profile,
                expression,
                out,
                known_failures,
                ics,
                drawn,
                everything,
                failed_first,
                not no_sandbox,
            )
        )
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
            virtual_time=virtual_time,
            jobs=jobs,
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


@cli.command()
@options.adapter_argument
@options.out_file("ucm-cts-ics.toml", "The statement.")
@options.toolchain_option
@options.no_sandbox_option
@click.option("--force", is_flag=True, help="Write over a file that is there.")
@click.option("--full", is_flag=True, help="Write every value that can be stated, and what it means.")
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
    """Write the statement of a product, for its vendor to edit.

    The statement says what the vendor claims and how unclear places of the specification are read. It claims what the adapter
    offers, and has what differs from the defaults and what the vendor must decide. Give the edited one to 'ucm-cts run --ics'.
    """
    subject = adapter
    wanted = Wanted(out, force, full, profile or "")
    if toolchain is not None:
        options.refuse(context, ("adapter",))
        subject = f"--toolchain {toolchain}"
        described = read_toolchain(toolchain)
        need("toolchain", "the statement of a tool chain")
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
    """Explain a requirement, a clause or an operation.

    TOPIC is a requirement (R-11.2.2.1-13), shown with clause, level, meaning, interpretation and scenarios; or a clause (10.1.3)
    or an operation (remove_component, on_disconnect), shown with the requirements that concern it. Without TOPIC, list all.
    """
    console = Output()
    console.print(explanation(topic) if topic else overview(), soft_wrap=not console.is_terminal)
    options.leave(console, options.CONFORMANT)


@cli.command()
@click.argument("file", type=click.Path(dir_okay=False, path_type=Path))
@options.adapter_argument
@options.ics_option
@options.in_process_option
@options.virtual_time_option
@options.no_sandbox_option
@options.seed_option
@options.timeout_option
def replay(
    file: Path,
    adapter: str,
    ics: Path | None,
    in_process: bool,
    virtual_time: bool,
    no_sandbox: bool,
    seed: int | None,
    timeout: float,
) -> None:
    """Run one saved scenario, and print a sequence diagram.

    FILE holds the scenario; a report saves one for each failure. Exit status 1 if the product fails any requirement in it.
    """
    if file.suffix == ".xml":
        raise WrongUse(
            f"{file} is a model and no scenario; the report shows the command that gives it to the tool chain again"
        )
    scripts = read_scripts(file, may_overlap=True)
    endpoint = locate(adapter, in_process, sandbox=not no_sandbox, virtual_time=virtual_time)
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
cli.add_command(campaign)


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


_OBJECTS_BETWEEN_COLLECTIONS = 100_000


def _collect_seldom() -> None:
    """Judging makes millions of values and hardly a cycle of them: the search for cycles would take a tenth of the time."""
    gc.freeze()  # what is imported stays
    gc.set_threshold(_OBJECTS_BETWEEN_COLLECTIONS)


def main() -> None:
    """The console entry point: turns an error into one clear line and an exit status."""
    _collect_seldom()
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
        click.echo(f"ucm-cts: {remedy or f'UCM-CTS itself failed: {type(error).__name__}: {error}'}", err=True)
        sys.exit(options.WRONG_USE if remedy else options.HARNESS_FAILED)
    except Exception as error:  # noqa: BLE001 - the last resort: a user sees one line, not a traceback
        click.echo(f"ucm-cts: UCM-CTS itself failed: {type(error).__name__}: {error}", err=True)
        sys.exit(options.HARNESS_FAILED)
