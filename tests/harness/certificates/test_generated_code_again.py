"""C++ in records of tool chains: compiled and run again by the verifier, but only for trusted signers and in a sandbox."""

from __future__ import annotations

from pathlib import Path

import msgspec
import pytest
from recorded_toolchains import Recorded, recorded, without_times

from ucm_cts.harness.certificates.judging import unfinished_compilations
from ucm_cts.harness.certificates.toolchain_rejudging import Judged, judge_toolchain_again, of_verifier
from ucm_cts.harness.hosting.sandbox import why_none
from ucm_cts.harness.report.json_report import entry_of
from ucm_cts.harness.results.values import Incident
from ucm_cts.harness.toolchains.commands import bounded
from ucm_cts.harness.toolchains.commands.description import Command
from ucm_cts.harness.toolchains.cpp.comparing import _compared
from ucm_cts.harness.toolchains.recorded_form import decoded, encoded
from ucm_cts.harness.toolchains.recording import ToolChainRecord

pytestmark = [
    pytest.mark.native,
    pytest.mark.skipif(bool(why_none()), reason="there is no sandbox on this machine"),
]

replace = msgspec.structs.replace
MODEL = "data_types"


def again(run: Recorded, record: ToolChainRecord | None = None, *, is_vouched_for: bool = True) -> Judged:
    """Judged without what a run before has found out of the same files."""
    _compared.cache_clear()
    return judge_toolchain_again(decoded(encoded(record or run.record)), run.plan, is_vouched_for, run.expression)


@pytest.mark.parametrize("subject", ["", "dimensions_out_of_order_cpp11"])
def test_generated_code_is_compiled_and_run_again(subject: str) -> None:
    run = recorded("cpp11", MODEL, subject)
    judged = again(run)
    assert judged.problems == ()
    assert without_times(judged.report) == without_times(run.report)
    assert any(result.verdict == ("fail" if subject else "pass") for result in judged.report.requirements)


@pytest.mark.slow
@pytest.mark.parametrize("profile", ["cpp11", "cpp03"])
def test_a_whole_run_is_judged_again(profile: str) -> None:
    run = recorded(profile)
    judged = again(run)
    assert judged.problems == ()
    assert run.report.verdict == "conformant"
    assert without_times(judged.report) == without_times(run.report)


def test_libclang_is_asked_in_the_sandbox() -> None:
    judged = again(recorded("cpp11", "policy_example"))
    assert judged.problems == ()
    assert next(r.verdict for r in judged.report.requirements if r.id == "R-13-03") == "pass"


def test_code_of_a_stranger_is_neither_compiled_nor_run(monkeypatch: pytest.MonkeyPatch) -> None:
    run = recorded("cpp11", MODEL)

    def never(*_: object, **__: object) -> None:
        raise AssertionError("it was run")

    monkeypatch.setattr("ucm_cts.harness.toolchains.commands.bounded.start", never)
    judged = again(run, is_vouched_for=False)
    (problem,) = judged.problems
    assert problem.startswith("not judged: what was generated of ")
    assert problem.endswith("because the signature is not trusted")
    assert judged.report.verdict == "inconclusive"


def test_without_a_sandbox_nothing_is_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    run = recorded("cpp11", MODEL)
    monkeypatch.setattr("ucm_cts.harness.certificates.toolchain_rejudging.why_none", lambda: "it is not installed")
    (problem,) = again(run).problems
    assert problem.endswith("generated programs run in a sandbox only, and there is none: it is not installed")


def test_the_compiler_is_the_verifiers() -> None:
    theirs = Command((), compiler=("./our-g++", "-DORB=1", "-fplugin=evil.so", "-fno-rtti", "@more", "-B/tmp"))
    assert of_verifier(theirs, "g++").compiler == ("g++", "-DORB=1", "-fno-rtti")


@pytest.mark.parametrize(
    "needs",
    [
        {"compiler": ("g++", "-fplugin=./evil.so")},
        {"compiler": ("g++", "@options")},
        {"compiler": ("g++", "-I/home/them/orb")},
        {"libraries": ("lib/libacme.a",)},
        {"include": ("../../..",)},
    ],
)
def test_what_no_certificate_holds_is_named(needs: dict[str, tuple[str, ...]]) -> None:
    run = recorded("cpp11", MODEL)
    described = run.record.toolchain.cpp11
    assert described is not None
    toolchain = replace(run.record.toolchain, cpp11=replace(described, **needs))
    (problem,) = again(run, replace(run.record, toolchain=toolchain)).problems
    assert f"it needs '{next(iter(needs.values()))[-1]}', which no certificate holds" in problem


def hostile(record: ToolChainRecord, file: Path) -> ToolChainRecord:
    """``record`` with headers whose programs write ``file``."""
    attack = f'namespace {{ const int owned = std::system("touch {file}"); }}'
    code = f"\n#ifndef OWNED\n#define OWNED\n#include <cstdlib>\n{attack}\n#endif\n"
    headers = {
        n for call in record.calls for said in call.said for name, n in said.files.items() if name.endswith("hpp")
    }
    return replace(record, texts=tuple(t + code * (n in headers) for n, t in enumerate(record.texts)))


def test_generated_programs_reach_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    run = recorded("cpp11", MODEL)
    file = tmp_path / "owned"
    again(run, hostile(run.record, file))
    assert not file.exists()
    monkeypatch.setattr("ucm_cts.harness.toolchains.commands.bounded.why_none", lambda: "not here")
    again(run, hostile(run.record, file))
    assert file.exists(), "the attack is one, without a sandbox"


def test_a_compiler_that_comes_to_no_end_on_a_busy_machine_accuses_nobody(monkeypatch: pytest.MonkeyPatch) -> None:
    def hangs(*_: object, **__: object) -> bounded.Ended:
        return bounded.Ended(None, "", "", Incident("hang", f"{bounded.NO_END} 60 s"))

    run = recorded("cpp11", "policy_example")
    whole = entry_of(again(run).report)
    monkeypatch.setattr(bounded, "run", hangs)
    slow = entry_of(again(run).report)
    _compared.cache_clear()
    assert not list(unfinished_compilations(whole, whole))
    for said, shown, when in ((whole, slow, "here"), (slow, whole, "when it was made")):
        (problem,) = unfinished_compilations(said, shown)
        assert problem.startswith(f"not judged: {when}, policy_example: ")
        assert problem.endswith("try again when the machine is less busy")
