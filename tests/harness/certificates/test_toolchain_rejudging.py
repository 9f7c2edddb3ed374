"""Records of tool chains judged again: the same report without the tool chain; whatever was changed is told, each in its own line."""

from __future__ import annotations

from collections.abc import Callable

import msgspec
import pytest
from recorded_toolchains import SEED, Recorded, recorded, run_on, without_times

from ucm_cts.adapters.reference.toolchain.program import reference
from ucm_cts.harness.certificates.toolchain_rejudging import Judged, judge_toolchain_again
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.values import Incident
from ucm_cts.harness.toolchains.commands.description import Task
from ucm_cts.harness.toolchains.commands.processing import InProcess, Response
from ucm_cts.harness.toolchains.recorded_form import decoded, encoded
from ucm_cts.harness.toolchains.recording import Call, Said, ToolChainRecord

CASE = "R-9.2.4.3-02"
replace = msgspec.structs.replace


def again(run: Recorded, record: ToolChainRecord | None = None, *, is_vouched_for: bool = True) -> Judged:
    """``record``, or that of ``run``, through bytes and judged."""
    there = decoded(encoded(record or run.record))
    return judge_toolchain_again(there, run.plan, is_vouched_for, run.expression)


def assert_same(run: Recorded) -> None:
    judged = again(run)
    assert judged.problems == ()
    assert without_times(judged.report) == without_times(run.report)


@pytest.mark.parametrize(("profile", "expression"), [("pim", CASE), ("pim", "R-9.5.3"), ("idl", "data_types")])
def test_the_reference_tool_chain_is_judged_again_as_it_was(profile: str, expression: str) -> None:
    run = recorded(profile, expression)
    assert any(result.verdict == "pass" for result in run.report.requirements)
    assert_same(run)


@pytest.mark.slow
@pytest.mark.parametrize("profile", ["pim", "idl"])
def test_a_whole_run_is_judged_again_as_it_was(profile: str) -> None:
    run = recorded(profile)
    assert run.report.verdict == "conformant"
    assert_same(run)


@pytest.mark.parametrize(
    ("profile", "expression", "subject"),
    [
        ("pim", "R-9.2.2.4 or R-9.2.4", "without_data_types_exist"),
        ("pim", "R-9.2.1", "without_items_are_bound_to_no_constants"),
        ("idl", "interfaces or ports", "what_is_used_is_provided"),
        ("idl", "", "what_is_provided_is_forgotten"),
    ],
)
def test_a_wrong_tool_chain_fails_again_with_the_same_evidence(profile: str, expression: str, subject: str) -> None:
    run = recorded(profile, expression, subject)
    assert any(result.verdict == "fail" for result in run.report.requirements)
    assert any(call.again_for for call in run.record.calls), "each failure was looked at again"
    assert_same(run)


class Forgetful(InProcess):
    """Accepts what it should refuse, but only when it is asked first."""

    def __init__(self) -> None:
        super().__init__(reference())
        self._known: set[str] = set()

    def process(self, task: Task, name: str, text: str, again_for: str = "") -> Response:
        response = super().process(task, name, text, again_for)
        if name in self._known or response.accepted:
            return response
        self._known.add(name)
        return Response(replace(response.processed, status=0, output=""), True)


def test_a_failure_that_did_not_show_again_is_unstable_again() -> None:
    run = run_on(Forgetful(), "pim", "structures-have-fields/broken-1")
    assert any(finding.unstable for result in run.report.requirements for finding in result.findings)
    assert_same(run)


class Crashing(InProcess):
    """Ends oddly, or comes to no answer, with one model in three each."""

    def process(self, task: Task, name: str, text: str, again_for: str = "") -> Response:
        response = super().process(task, name, text, again_for)
        kind = sum(name.encode()) % 3
        if kind == 0:
            incident = Incident("exit", "exit status 70, which neither accepts (0) nor refuses (1)")
            return Response(replace(response.processed, status=70, incident=incident), None)
        if kind == 1:
            incident = Incident("flood", "more than 16 MiB of output")
            return Response(replace(response.processed, status=None, incident=incident), None)
        return response


def test_incidents_are_judged_again() -> None:
    run = run_on(Crashing(reference()), "pim", CASE)
    assert run.report.verdict != "conformant"
    assert_same(run)


Tamper = Callable[[ToolChainRecord], ToolChainRecord]


def of_first(change: Callable[[Said], Said]) -> Tamper:
    """Change what came back of the first model."""

    def tampered(record: ToolChainRecord) -> ToolChainRecord:
        call, *others = record.calls
        return replace(record, calls=(replace(call, said=(change(call.said[0]), *call.said[1:])), *others))

    return tampered


def of_calls(change: Callable[[tuple[Call, ...]], tuple[Call, ...]]) -> Tamper:
    return lambda record: rebuilt(replace(record, calls=change(record.calls)))


def rebuilt(record: ToolChainRecord) -> ToolChainRecord:
    """``record`` with the commands and texts that its calls still refer to, as the suite orders them: a forger knows how."""
    texts: dict[str, int] = {}

    def said(one: Said) -> Said:
        output = texts.setdefault(record.texts[one.output], len(texts))
        files = {name: texts.setdefault(record.texts[n], len(texts)) for name, n in one.files.items()}
        return replace(one, output=output, files=files)

    calls = tuple(replace(call, said=tuple(map(said, call.said))) for call in record.calls)
    return replace(record, calls=calls, texts=tuple(texts))


def without_first_model(calls: tuple[Call, ...]) -> tuple[Call, ...]:
    return replace(calls[0], said=calls[0].said[1:]), *calls[1:]


def with_one_more(calls: tuple[Call, ...]) -> tuple[Call, ...]:
    more = replace(calls[0].said[0], name="one-more")
    return replace(calls[0], said=(*calls[0].said, more)), *calls[1:]


def with_two_swapped(calls: tuple[Call, ...]) -> tuple[Call, ...]:
    one, two, *others = calls[0].said
    return replace(calls[0], said=(two, one, *others)), *calls[1:]


def without_second_looks(calls: tuple[Call, ...]) -> tuple[Call, ...]:
    return tuple(call for call in calls if not call.again_for)


def with_undue_second_look(calls: tuple[Call, ...]) -> tuple[Call, ...]:
    last = max(call.ended for call in calls)
    return *calls, Call(last, last, (calls[0].said[0],), "R-99")


def with_second_looks_before(calls: tuple[Call, ...]) -> tuple[Call, ...]:
    return tuple(replace(call, begun=0.0, ended=0.0) if call.again_for else call for call in calls)


def at_one_time(calls: tuple[Call, ...]) -> tuple[Call, ...]:
    return tuple(replace(call, begun=0.0, ended=0.001) for call in calls)


HANG = Incident("hang", "no end after 20 s")


@pytest.mark.parametrize(
    ("tamper", "problem"),
    [
        (of_calls(without_first_model), "models are missing in the record: "),
        (of_calls(with_one_more), "models in the record are none of this run: one-more"),
        (of_calls(with_two_swapped), "the record has models in another order than they are asked in"),
        (of_first(lambda said: replace(said, model="0" * 16)), "models are not those that this suite makes"),
        (of_first(lambda said: replace(said, status=70)), "answers in the record are impossible: "),
        (of_first(lambda said: replace(said, status=None)), "has neither an exit status nor an incident"),
        (of_first(lambda said: replace(said, incident=HANG)), "which does not go with the incident 'hang"),
        (of_first(lambda said: replace(said, status=None, incident=HANG)), "in a call shorter than the limit of 20 s"),
        (of_first(lambda said: replace(said, status=1, files={"a.h": said.output})), "was not accepted, and has files"),
        (of_calls(without_second_looks), "second looks that failures call for are missing in the record: "),
        (of_calls(with_undue_second_look), "second looks in the record are due to no failure: "),
        (of_calls(with_second_looks_before), "a failure was looked at again before all models had been asked once"),
        (of_calls(at_one_time), "more calls go on at a time than the 2 that the run allowed"),
        (lambda record: replace(record, seconds=0.0), "a call began or ended outside the time of the run"),
        (lambda record: replace(record, seed=7), "its seed is '7', and the certificate's is '5'"),
        (
            lambda record: replace(record, toolchain=replace(record.toolchain, product="theirs")),
            "its product is 'theirs', and the certificate's is 'ours'",
        ),
        (
            lambda record: replace(record, toolchain=replace(record.toolchain, version="2")),
            "its version is '2', and the certificate's is '1'",
        ),
    ],
)
def test_what_was_changed_is_told(tamper: Tamper, problem: str) -> None:
    run = recorded("pim", "R-9.2.2.4", "without_data_types_exist")
    judged = again(run, tamper(run.record))
    assert any(problem in line for line in judged.problems), judged.problems
    assert all("\n" not in line for line in judged.problems)


def test_all_that_was_changed_is_told_together() -> None:
    run = recorded("pim", "R-9.2.2.4", "without_data_types_exist")
    judged = again(run, of_calls(without_second_looks)(replace(run.record, seed=7)))
    assert len(judged.problems) == 2


def test_a_second_look_left_out_does_not_make_a_failure_unstable() -> None:
    run = recorded("pim", "R-9.2.2.4", "without_data_types_exist")
    judged = again(run, of_calls(without_second_looks)(run.record))
    assert judged.report.verdict == "not conformant"


def test_a_verdict_follows_from_the_answers_not_from_what_was_said_of_them() -> None:
    run = recorded("pim", CASE)
    refused = next(said for call in run.record.calls for said in call.said if said.status == 1)

    def accepts(calls: tuple[Call, ...]) -> tuple[Call, ...]:
        changed = replace(refused, status=0)
        return tuple(
            replace(call, said=tuple(changed if said is refused else said for said in call.said)) for call in calls
        )

    assert again(run, of_calls(accepts)(run.record)).report.verdict == "not conformant"


def test_a_record_of_another_seed_is_of_another_run() -> None:
    other = recorded("pim", CASE, seed=6)
    judged = again(recorded("pim", CASE), replace(other.record, seed=SEED))
    assert any(
        "is of another run: " in line and " are not those that this suite makes with this seed" in line
        for line in judged.problems
    )


def test_by_another_suite_only_what_both_ask_is_judged() -> None:
    run = recorded("pim", CASE)
    calls = tuple(
        replace(call, said=tuple(replace(said, model="0" * 16) for said in call.said)) for call in run.record.calls
    )
    for record, verdicts in ((run.record, {"pass"}), (replace(run.record, calls=calls), {"inconclusive"})):
        judged = judge_toolchain_again(record, run.plan, is_vouched_for=True, expression=CASE, is_delta=True)
        assert judged.problems == ()
        assert {result.verdict for result in judged.report.requirements} == verdicts


def test_a_record_of_another_task_is_refused() -> None:
    with pytest.raises(WrongUse, match="the record is of 'check'; profile 'idl' needs 'idl'"):
        judge_toolchain_again(recorded("pim", CASE).record, recorded("idl", "data_types").plan, is_vouched_for=True)


def test_no_program_reads_what_a_stranger_generated(monkeypatch: pytest.MonkeyPatch) -> None:
    def never(*_: object, **__: object) -> None:
        raise AssertionError("it was run")

    run = recorded("idl", "data_types")
    monkeypatch.setattr("ucm_cts.harness.toolchains.commands.bounded.run", never)
    judged = again(run, is_vouched_for=False)
    assert judged.problems == (
        "not judged: what was generated of 1 models was read by no compiler, because the signature is not trusted",
    )
