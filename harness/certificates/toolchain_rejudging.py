"""Judges the record of a run on a tool chain again, without the tool chain: the same campaign, on models that are derived again.

Generated IDL and C++ are the vendor's files. Other programs read them, and C++ is compiled and run, only if the certificate is signed
by somebody whom the verifier trusts, and C++ only in a sandbox. Nothing that a compiler said is taken from a record.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

import msgspec

from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.hosting.sandbox import why_none
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import ToolChainReport
from ucm_cts.harness.toolchains.campaign import TASKS, ToolChainCampaign, ToolChainPlan
from ucm_cts.harness.toolchains.commands.description import Command
from ucm_cts.harness.toolchains.cpp.compiling import NoCompiler, can_be_run
from ucm_cts.harness.toolchains.examinations import examination_for
from ucm_cts.harness.toolchains.recorded_form import why_no_file
from ucm_cts.harness.toolchains.recording import Replay, ToolChainRecord, impossible_times
from ucm_cts.harness.toolchains.renaming import Renaming
from ucm_cts.harness.toolchains.selecting import as_selected

UNTRUSTED = "the signature is not trusted"


@dataclass(frozen=True)
class Judged:
    """The ``report`` that follows from a record, and the ``problems`` of the record, a line each; none if it stands."""

    report: ToolChainReport
    problems: tuple[str, ...]


def judge_toolchain_again(
    record: ToolChainRecord,
    plan: ToolChainPlan,
    is_vouched_for: bool,
    expression: str = "",
    compiler: str = "g++",
    *,
    is_delta: bool = False,
) -> Judged:
    """Judge ``record``, which ``recorded_form.decoded`` gave, as a run of ``plan`` on what ``expression`` selects.

    ``is_vouched_for``: whether somebody whom the verifier trusts has signed it.
    ``is_delta``: whether another suite made the record: then it need not fit, and models that it does not have decide nothing.
    ``compiler``: the verifier's C++ compiler.
    Times, isolation and the name of the description are those of the record; how long requirements took is not derived.
    Raises ``WrongUse``.
    """
    task = TASKS[plan.profile]
    if task != record.task:
        raise WrongUse(f"the record is of '{record.task}'; profile '{plan.profile}' needs '{task}'")
    described = record.toolchain.command_for(task)
    assert described is not None
    command = of_verifier(described, compiler)
    untouched = _untouched(described, task, is_vouched_for, compiler)
    renaming = Renaming(plan.seed, record.toolchain.dialect)
    examination = examination_for(
        plan.profile, plan.statement, renaming, expression, command, network=False, untouched=untouched
    )
    names = [name for name, _ in examination.models]
    replay = Replay(record, is_delta)
    campaign = ToolChainCampaign(replay, examination, plan)
    try:
        for _ in campaign.process():
            pass
        campaign.judge()
        for _ in campaign.confirm():
            pass
    except NoCompiler as problem:
        raise WrongUse(str(problem)) from None
    report = as_selected(campaign.report(), campaign, plan.profile, expression)
    report = msgspec.structs.replace(report, started=record.started, seconds=record.seconds, adapter=record.source)
    misfits = () if is_delta else (*_of_another_run(record, plan), *replay.problems(names))
    problems = (*misfits, *impossible_times(record))
    if untouched:
        problems += (
            f"not judged: what was generated of {len(names)} models was read by no compiler, because {untouched}",
        )
    return Judged(report, problems)


def of_verifier(described: Command, compiler: str) -> Command:
    """``described`` with the verifier's ``compiler`` in place of the vendor's; harmless options stay."""
    options = tuple(word for word in described.compiler[1:] if _HARMLESS.fullmatch(word))
    return msgspec.structs.replace(described, compiler=(compiler, *options))


_HARMLESS = re.compile(r"-[DU]\w+(=[\w.+-]*)?|-f[a-z][a-z0-9-]*|-W[a-z][a-z0-9+-]*|-w|-O[0-3s]|-m[a-z0-9-]+|-pthread")
"""Options of a compiler that name neither files nor programs."""

_LIBRARY = re.compile(r"-l[\w+.-]+|-pthread")
"""Words for the linker that name libraries of the system."""


def _untouched(described: Command, task: str, is_vouched_for: bool, compiler: str) -> str:
    """Why no program may read what was generated; empty if one may, or if nothing was generated."""
    if task == "check":
        return ""
    return why_not_judged(described, task, compiler) if is_vouched_for else UNTRUSTED


def why_not_judged(described: Command, task: str, compiler: str = "g++") -> str:
    """Why nobody who trusts the signer could judge here what ``described`` generates for ``task``; empty if one could."""
    if task not in ("cpp11", "cpp03"):
        return ""
    odd = [word for word in described.compiler[1:] if not _HARMLESS.fullmatch(word)]
    odd += [word for word in described.libraries if not _LIBRARY.fullmatch(word)]
    odd += [word for word in described.include if word != "." and why_no_file(word)]
    if odd:
        return f"it needs '{one_line(odd[0], 80)}', which no certificate holds"
    if not can_be_run(compiler):
        return f"there is no compiler '{compiler}' here; install it, or name another"
    return f"generated programs run in a sandbox only, and there is none: {why_none()}" if why_none() else ""


def _of_another_run(record: ToolChainRecord, plan: ToolChainPlan) -> Iterator[str]:
    """Where the record says itself that it is of another run than ``plan``."""
    for what, recorded, planned in (
        ("product", record.toolchain.product, plan.product),
        ("version", record.toolchain.version, plan.version),
        ("seed", str(record.seed), str(plan.seed)),
    ):
        if one_line(recorded) != one_line(planned):
            yield f"the record is of another run: its {what} is '{one_line(recorded)}', and the certificate's is '{one_line(planned)}'"
