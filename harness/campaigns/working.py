"""What a worker does with one unit: the ordinary pipeline runs it, and a small value comes back."""

from __future__ import annotations

import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import msgspec

from ucm_cts.adapters.contract.value import Value
from ucm_cts.harness.campaigns.products import (
    check_same,
    check_trial,
    endpoint_of,
    limits_of,
    purposes_of,
    statement_at,
)
from ucm_cts.harness.campaigns.units import Conclusion, GeneratedTrial, PlannedRun, Slice, Trial, decoded
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.campaign_state import CampaignState
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.hosting.hosts import HostUnavailable
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.purposes.scripts import TestPurpose
from ucm_cts.harness.purposes.selection import asked_by
from ucm_cts.harness.results.foreign import clean_report
from ucm_cts.harness.results.known_failures import KnownFailure
from ucm_cts.harness.results.tally import of_selection
from ucm_cts.harness.results.values import FrameworkReport
from ucm_cts.harness.selftest.generated import python_programs
from ucm_cts.harness.selftest.generated.trial import Outcome, stated, try_out
from ucm_cts.harness.selftest.matrix import MutantResult, VariantResult
from ucm_cts.harness.selftest.trials import all_mutants, all_variants, examine_mutant, examine_variant
from ucm_cts.harness.statement.files import check_subject


class UnitFailed(Exception):
    """A unit gave no result; the text says why, for people."""


class Done(Value, frozen=True):
    """The result of one unit: the one of these that fits its kind."""

    part: CampaignState | None = None
    report: FrameworkReport | None = None
    mutant: MutantResult | None = None
    variant: VariantResult | None = None
    outcome: Outcome | None = None


_decode = msgspec.json.Decoder(Done).decode


def packed(done: Done) -> bytes:
    """``done`` as it travels and is kept."""
    try:
        content = msgspec.json.encode(done)
    except UnicodeEncodeError:  # a framework's text with lone surrogates
        content = msgspec.json.encode(_cleaned(done))
    return zlib.compress(content)


def unpacked(data: bytes) -> Done:
    """The result that was ``packed``."""
    return _decode(zlib.decompress(data))


def carry_out(unit: bytes, parts: Sequence[bytes] = (), hidden: Sequence[str] = ()) -> bytes:
    """Do the ``unit``, which is encoded, and return its result, packed. Raises ``UnitFailed``.

    ``parts``: for a conclusion the results of its parts, in their order. ``hidden``: what hosts must not see on this machine.
    """
    try:
        return packed(_done(decoded(unit), parts, hidden))
    except (WrongUse, DocumentError, HostUnavailable) as problem:
        raise UnitFailed(str(problem)) from None


def _done(unit: Slice | Conclusion | Trial | GeneratedTrial, parts: Sequence[bytes], hidden: Sequence[str]) -> Done:
    match unit:
        case Slice():
            return Done(part=_part(unit, hidden))
        case Conclusion():
            return Done(report=_report(unit, [unpacked(part).part for part in parts], hidden))
        case Trial():
            check_trial(unit)
            mutant = all_mutants().get(unit.name)
            if mutant is not None:
                return Done(mutant=examine_mutant(mutant, unit.how))
            return Done(variant=examine_variant(all_variants()[unit.name], unit.how))
        case GeneratedTrial():
            check_trial(unit)
            statement = stated(python_programs.HOME / "ics.toml")
            with python_programs.python_endpoint(unit.mutant) as endpoint:
                concerned = python_programs.CONCERNED[unit.mutant.file]
                return Done(outcome=try_out(endpoint, statement, concerned, "", unit.seed))


def _part(unit: Slice, hidden: Sequence[str]) -> CampaignState:
    """Run the purposes of ``unit`` with the names and payloads that they have in one run of all."""
    with _begun(unit.run, (), hidden) as (campaign, purposes):
        campaign.pass_over(purposes[: unit.first])
        for _ in campaign.check(purposes[unit.first : unit.end]):
            pass
        return campaign.state


def _report(unit: Conclusion, parts: Sequence[CampaignState | None], hidden: Sequence[str]) -> FrameworkReport:
    """Go on from where the parts ended, as ``ucm-cts run --resume`` does: run again what was lost, confirm, and shorten."""
    expression = unit.run.select
    with _begun(unit.run, unit.known, hidden) as (campaign, purposes):
        for state in parts:
            assert state is not None
            campaign.restore(state)
        for part in unit.parts:
            for _ in campaign.check(purposes[part.first : part.end]):
                pass
        campaign.confirm()
        for _ in campaign.shorten():
            pass
        number = len(unit.lost)
        report = campaign.report(f"{number} of {number + len(unit.parts)} parts gave no result" if number else "")
    return of_selection(report, expression, asked_by(purposes, expression)) if expression else report


@contextmanager
def _begun(
    run: PlannedRun, known: Sequence[KnownFailure], hidden: Sequence[str]
) -> Iterator[tuple[Campaign, tuple[TestPurpose, ...]]]:
    """A campaign with a host, and the purposes of ``run``."""
    endpoint, statement = endpoint_of(run, hidden), statement_at(run.statement, run.adapter, run.sandbox)
    check_same(run, endpoint, statement)
    with Driver(endpoint, run.seed, limits_of(run)) as driver:
        check_subject(statement, driver.identity, run.profile)
        yield Campaign(driver, run.profile, known, statement), purposes_of(run, statement)


def _cleaned(done: Done) -> Done:
    part = done.part
    if part is not None:
        part = msgspec.structs.replace(part, report=clean_report(part.report))
    report = clean_report(done.report) if done.report is not None else None
    return msgspec.structs.replace(done, part=part, report=report)
