"""Statements on the command line: what ics writes, and what run and replay make of it."""

from __future__ import annotations

import json
import re
import shlex
import tomllib
from pathlib import Path

import msgspec
import pytest
from command_line import report_of, ucm_cts
from lxml import etree
from statements import ADAPTER, CORE_REQUIREMENTS, EXTENSIONS, PARTS, REQUIREMENTS, UNASKED, stating

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import PROTOCOL, Welcome
from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES, PROFILES
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.execution.offers import offers_of
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.models.core_models import compare
from ucm_cts.harness.results.statement import HOOKS, default_statement
from ucm_cts.harness.statement.applicability import ALWAYS_NEEDED, lines_for
from ucm_cts.harness.statement.claims import Offer, claimed
from ucm_cts.harness.statement.files import check_subject, read_statement, stated_by
from ucm_cts.harness.statement.writing import Wanted, to_short_toml, write_statement

pytestmark = pytest.mark.usefixtures("here")


def test_ics_writes_a_statement_that_run_takes(here: Path) -> None:
    outcome = ucm_cts("ics", ADAPTER, "--full")
    assert (outcome.status, outcome.err) == (0, "")
    statement = read_statement(here / "ucm-cts-ics.toml")
    assert statement.product == "UCM-CTS reference framework (Python)"
    assert statement.profiles == FRAMEWORK_PROFILES
    unnamed = msgspec.structs.replace(statement, product="", version="", source="", folder=".", profiles=PROFILES)
    default = default_statement()
    readings = default.readings | dict.fromkeys(HOOKS, "hook")
    capabilities = default.capabilities | dict.fromkeys(EXTENSIONS, True)
    assert unnamed == msgspec.structs.replace(default, readings=readings, capabilities=capabilities)
    (command,) = re.findall(r"(ucm-cts run .*)", outcome.out)
    outcome = ucm_cts(*shlex.split(command)[1:], "-k", "R-11.2.2.1-13")
    assert (outcome.status, outcome.err) == (0, "")
    assert report_of(here / "ucm-cts-report")["statement"]["source"] == "ucm-cts-ics.toml"


def test_what_a_loaded_machine_shows_once_is_asked_again(here: Path) -> None:
    outcome = ucm_cts("ics", "subjects:SlowAtFirst", "--no-sandbox", "--full")
    assert (outcome.status, outcome.err) == (0, "")
    assert (here / "made").stat().st_size == 3, "it waited for ever, then in vain, and then answered"
    statement = read_statement(here / "ucm-cts-ics.toml")
    assert statement.profiles == FRAMEWORK_PROFILES
    assert [part for part, is_claimed in statement.capabilities.items() if not is_claimed] == UNASKED


def test_a_short_statement_has_what_differs_and_what_must_be_decided(here: Path) -> None:
    assert ucm_cts("ics", ADAPTER).status == 0
    text = (here / "ucm-cts-ics.toml").read_text()
    short = tomllib.loads(text)
    asked = dict.fromkeys(("unknown-policy", "incompatible-ends", "attribute-defaults"), "unasked")
    free = {
        "missing-execution-policy": "observed",
        "unprotected-concurrency": "may-serialise",
        "message-order": "unordered",
        "pending-value": "observed",
    }
    undecided = {"core-models": "shipped"} | asked | free
    assert short["readings"] == dict.fromkeys(HOOKS, "hook") | undecided
    assert (short["profiles"], short["models"]) == ([*FRAMEWORK_PROFILES], {"core": []})
    assert short["capabilities"] == dict.fromkeys(EXTENSIONS, True)
    assert short.keys() == {"product", "version", "profiles", "capabilities", "readings", "models"}
    assert text.count("# TO DECIDE: ") == len(undecided)
    assert max(len(line) for line in text.split("\n") if ADAPTER not in line) <= 128
    stated = read_statement(here / "ucm-cts-ics.toml")
    ucm_cts("ics", ADAPTER, "--full", "--force")
    full = read_statement(here / "ucm-cts-ics.toml")
    assert full == stated
    assert ucm_cts("ics", ADAPTER, "--profile", "container", "--force").status == 0
    assert tomllib.loads((here / "ucm-cts-ics.toml").read_text()).keys() == {"product", "version", "profiles"}


def test_a_short_statement_says_all_that_is_declared() -> None:
    readings = {"late-add": "refuse", "core-models": "built-in"}
    ixit = default_statement().ixit | {"clock-rate": 0.5}
    whole = stating(
        {"clock": False}, readings=readings, ixit=ixit, profiles=FRAMEWORK_PROFILES, product="x", version="1"
    )
    path = Path("ics.toml")
    path.write_text(to_short_toml(whole, "adapter", "ics.toml"))
    assert msgspec.structs.replace(read_statement(path), source="") == whole
    assert "TO DECIDE" not in path.read_text()
    assert to_short_toml(default_statement(), "adapter", "ics.toml").count("\n[") == 2, "readings and models"


def test_what_no_adapter_can_be_asked_about_is_claimed_as_the_published_statement_does() -> None:
    offers = dict.fromkeys(EXTENSIONS, Offer())
    for published in (False, True):
        known = stating(dict.fromkeys(UNASKED, published))
        assert {part: claimed(known, offers).capabilities[part] for part in UNASKED} == dict.fromkeys(
            UNASKED, published
        )


@pytest.mark.parametrize("full", [False, True])
def test_a_statement_claims_nothing_that_the_adapter_does_not_offer(here: Path, full: bool) -> None:
    form = ["--full"] if full else []
    assert ucm_cts("ics", "subjects:has_no_services", *form).status == 0
    text = (here / "ucm-cts-ics.toml").read_text()
    assert tomllib.loads(text)["profiles"] == ["container"]
    if not full:
        assert "simple_service_connector (link is not offered)" in " ".join(text.split())
    assert ucm_cts("ics", "subjects:has_no_services", "--profile", "core", "--force", *form).status == 0
    stated = read_statement(here / "ucm-cts-ics.toml")
    assert (stated.profiles, [part for part in (*PARTS, *EXTENSIONS) if not stated.capabilities[part]]) == (
        ("container", "core"),
        [s.SERVICE_CONNECTOR, *EXTENSIONS],
    )
    assert {stated.readings[hook] for hook in HOOKS} == {"hook"}, "messages can be broken, too"


@pytest.mark.parametrize(
    ("lacks", "of"),
    [
        ("subjects:HidesItsLog", {"trace-sink"}),
        ("subjects:Unbreakable", {"transport-fault", "connector-fault"}),
        ("subjects:IgnoresClockAndTrace", {"clock", "component_trace"}),
        ("subjects:NeverRunsByItself", {"protected_self-executing_component"}),
        ("subjects:RefusesPortTraces", {"port_trace"}),
        ("subjects:ActiveAsAWhole", set()),
    ],
)
def test_what_an_adapter_offers_is_found_out(lacks: str, of: set[str]) -> None:
    with Driver(locate(lacks, in_process=True), 1) as driver:
        offers = offers_of(driver)
    assert offers.keys() == {*PARTS, *EXTENSIONS, *HOOKS, ALWAYS_NEEDED}
    assert {name for name, offer in offers.items() if offer.lacking} == of
    assert not [offer for offer in offers.values() if "not tried" in offer.lacking]
    declared = claimed(default_statement(), offers).readings["protected-active-applicability"]
    assert declared == ("onComponent" if lacks.endswith("AsAWhole") else "onPort")


@pytest.mark.parametrize("profile", ["container", "extensions"])
@pytest.mark.parametrize(
    "name",
    [
        "refuses_components_without_policy",
        "refuses_to_start_components_without_policy",
        "gives_a_policy_to_those_without",
    ],
)
def test_a_framework_that_needs_execution_policies_gets_a_statement_that_says_so(
    name: str, profile: str, here: Path
) -> None:
    assert ucm_cts("ics", f"ucm_cts.adapters.mutants.python:{name}", "--profile", profile).status == 0
    stated = tomllib.loads((here / "ucm-cts-ics.toml").read_text())
    needs = stated.get("readings", {}).get(ALWAYS_NEEDED) == "refuse"
    assert needs == name.startswith("refuses")
    assert stated.get("capabilities", {}).get("request-response", False) == (profile == "extensions")


def test_an_adapter_that_crashes_gets_a_statement_that_says_so(here: Path) -> None:
    outcome = ucm_cts("ics", "subjects:Dying")
    assert (outcome.status, outcome.err) == (0, "")
    text = " ".join((here / "ucm-cts-ics.toml").read_text().replace("\n#", "").split())
    assert 'profiles = ["container"]' in text
    assert "does not show that it offers" in text
    assert "crash: SIGSEGV" in text


def test_lines_for_want_of_which_a_run_is_inconclusive_are_named(here: Path) -> None:
    (here / "nothing.toml").write_text('profiles = ["core"]\n')
    selection = ("--profile", "core", "-k", "R-10.1.4.2-04", "--in-process")
    for statement, remedy in (
        ((), f"'ucm-cts ics {ADAPTER} --profile core' writes them"),
        (("--ics", "nothing.toml"), "add to nothing.toml"),
    ):
        outcome = ucm_cts("run", ADAPTER, *selection, *statement, "--out", "out")
        assert "1 inconclusive requirement for want of a statement" in outcome.out
        assert '[readings] trace-sink = "hook"' in outcome.out
        assert remedy in outcome.out
        (wanted,) = etree.HTML((here / "out" / "report.html").read_text()).xpath("//section[@id='statement']/ul")
        assert '[readings] trace-sink = "hook"' in "".join(wanted.itertext())
    (here / "trace.toml").write_text('[readings]\ntrace-sink = "hook"\n')
    outcome = ucm_cts("run", ADAPTER, *selection, "--ics", "trace.toml", "--out", "out")
    assert (outcome.status, "for want of a statement" in outcome.out) == (0, False)


def test_models_and_operations_for_tests_are_lines_that_help() -> None:
    wanted = {str(line) for r in CORE_REQUIREMENTS for line in lines_for(r, default_statement())}
    assert {line for line in wanted if "readings" not in line} == {'[models] core = ["FOLDER"]'}
    assert lines_for(REQUIREMENTS["R-10.1.4.2-04"], stating()) == ()
    assert [str(line) for line in lines_for(REQUIREMENTS["R-10.1.4.2-04"], stating({"port_trace": False}))] == [
        "[capabilities] port_trace = true"
    ]


def test_ics_overwrites_only_with_the_option(here: Path) -> None:
    identity = Welcome(PROTOCOL, "Fancy\n\x00" + "x" * 1000, "1", "")
    (here / "mine.toml").write_text("mine")
    with pytest.raises(WrongUse, match="--force"):
        write_statement(Wanted(here / "mine.toml"), identity, "adapter", {})
    assert (here / "mine.toml").read_text() == "mine"
    write_statement(Wanted(here / "mine.toml", force=True), identity, "adapter\nrm", {})
    check_subject(read_statement(here / "mine.toml"), identity, "core")
    for out in (here / "none" / "ics.toml", here):
        with pytest.raises(WrongUse, match=r"cannot be written|is there already"):
            write_statement(Wanted(out), identity, "adapter", {})
    assert ucm_cts("ics", "nobody").status == 2


def test_a_declared_reading_that_is_not_taken_fails_and_replays(here: Path) -> None:
    (here / "mine.toml").write_text('[readings]\nremove-while-ready = "cascade"\n')
    selection = ("-k", "R-11.2.3-11", "--out", "out")
    outcome = ucm_cts("run", "reference-py", "--ics", "mine.toml", *selection)
    assert outcome.status == 1
    assert "✗ R-11.2.3-11" in outcome.out
    document = report_of(here / "out")
    assert document["readings"]["remove-while-ready"] == ["refuse"]
    (failing,) = [r for r in document["requirements"] if r["verdict"] == "fail"]
    assert failing["findings"][0]["rule"] == "declared_choices"
    page = etree.HTML((here / "out" / "report.html").read_text())
    replay, repeat = page.xpath("//p[@class='command']/code/text()")[0], page.xpath("//dt[.='Repeat']/../dd//text()")[0]
    assert repeat.endswith(" --ics mine.toml")
    scenario = here / "out" / "failures" / "R-11.2.3-11.json"
    assert json.loads(scenario.read_text())["exercises"] == ["R-11.2.3-11"]
    (here / "mine.toml").unlink()
    words = [word if "/" not in word else f"out/{word}" for word in shlex.split(replay)[1:]]
    assert "remove-while-ready = cascade" in ucm_cts(*words).out
    assert "no findings" in ucm_cts("replay", scenario, "reference-py").out
    ucm_cts("run", "reference-py", "-k", "R-11.2.3-11", "--out", "out")
    assert "R-11.2.3-11.json" not in {path.name for path in (here / "out" / "failures").iterdir()}


def test_wrong_statements_are_wrong_use(here: Path) -> None:
    (here / "bad.toml").write_text("[readings]\nx = 1\n")
    (here / "other.toml").write_text('product = "Other"\n')
    for file, problem in (
        ("bad.toml", "bad.toml:2: there is no option 'x'"),
        ("other.toml", "other.toml:1 is about product 'Other'"),
    ):
        outcome = ucm_cts("run", "reference-py", "--ics", file)
        assert outcome.status == 2
        assert problem in outcome.err
        assert len(outcome.err.splitlines()) == 1
    outcome = ucm_cts("run", "reference-py", "--ics", "nowhere.toml")
    assert (outcome.status, outcome.err) == (2, "ucm-cts: nowhere.toml: cannot be read: No such file or directory\n")


@pytest.mark.native
def test_ics_writes_the_published_statement_of_a_short_name(here: Path) -> None:
    assert ucm_cts("ics", "reference-cpp", "--out", "own.toml").status == 0
    own, published = read_statement(here / "own.toml"), stated_by(None, "reference-cpp")
    assert (own.readings, own.product) == (published.readings, published.product)
    assert {r.status for r in compare(own.model_paths, own.readings).results} == {"kept"}


@pytest.mark.native
def test_reference_frameworks_publish_statements(here: Path) -> None:
    for name in ("reference-py", "reference-cpp"):
        assert ucm_cts("run", name, "-k", "R-11.2.2.1-13", "--out", name).err == ""
        stated = report_of(here / name)["statement"]
        assert (stated["source"], stated["readings"]["trace-sink"]) == ("ics.toml", "hook")
