"""The vendor's statement: its file, the requirements that apply under it, and false claims."""

from __future__ import annotations

import json
import re
import shlex
import tomllib
from collections.abc import Iterable
from pathlib import Path
from types import SimpleNamespace

import msgspec
import pytest
from command_line import report_of, ucm_cts, within
from lxml import etree

from ucm_cts.adapters.contract import scenario as s
from ucm_cts.adapters.contract.messages import PROTOCOL, Welcome
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES, PROFILES
from ucm_cts.harness.catalogue.requirements import load_capabilities, load_options, load_requirements
from ucm_cts.harness.cli.pytest_suite import _undecided
from ucm_cts.harness.execution.campaign import Campaign
from ucm_cts.harness.execution.driver import Driver
from ucm_cts.harness.execution.offers import offers_of
from ucm_cts.harness.hosting.locate import WrongUse, locate
from ucm_cts.harness.models.core_models import CHECKS, CORE, compare
from ucm_cts.harness.purposes.selection import load_purposes
from ucm_cts.harness.report.write import save_report
from ucm_cts.harness.results.statement import HOOKS, IXIT, Statement, default_statement
from ucm_cts.harness.results.values import Report
from ucm_cts.harness.statement.applicability import lacking_claims, lines_for, needs_of, purposes_for, why_not
from ucm_cts.harness.statement.claims import claimed
from ucm_cts.harness.statement.files import LARGEST, check_subject, read_statement, stated_by
from ucm_cts.harness.statement.writing import Wanted, to_short_toml, to_toml, write_statement

ADAPTER = "ucm_cts.adapters.reference.python.adapter:ReferenceAdapter"
REQUIREMENTS = {r.id: r for r in load_requirements()}
CORE_REQUIREMENTS = [r for r in load_requirements() if r.profile == "core" and not r.untestable]
PARTS = [capability.id for capability in load_capabilities().capabilities]
ASKED = {"unknown-policy": "refused", "incompatible-ends": "refused"}
"""Readings of which only those who declare them are asked anything."""
EVERYTHING = {hook: "hook" for hook in HOOKS} | ASKED


def stating(capabilities: dict[str, bool] | None = None, **changes: object) -> Statement:
    """What holds without a statement, but for this."""
    default = default_statement()
    readings = default.readings | EVERYTHING | changes.pop("readings", {})  # type: ignore[operator]
    return msgspec.structs.replace(
        default, readings=readings, capabilities=default.capabilities | (capabilities or {}), **changes
    )


@pytest.fixture(autouse=True)
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    within(tmp_path, monkeypatch)
    return tmp_path


# as a file


def written(statement: Statement | None = None) -> Path:
    Path("ics.toml").write_text(to_toml(statement or default_statement(), "adapter", "ics.toml"))
    return Path("ics.toml")


def test_written_statement_holds_the_defaults() -> None:
    assert msgspec.structs.replace(read_statement(written()), source="") == default_statement()


def test_written_statement_has_every_value_with_permitted_ones_meaning_and_clauses() -> None:
    text = written().read_text()
    for option, values in load_options().items():
        assert f'\n# {option}: {", ".join(values)}\n{option} = "{values[0]}"\n' in text
    for name in (*PARTS, *IXIT):
        assert re.search(rf"(?m)^{name} = \S+", text), name
    for paragraph in text.partition("[readings]")[2].partition("[ixit]")[0].split("\n\n")[1:-1]:
        assert re.match(r"# [\w-]+ \([\d., ]+\)\n# \S", paragraph), paragraph
    assert max(map(len, text.split("\n"))) <= 128


def test_any_product_name_is_kept() -> None:
    stated = stating(product='A "b" \\ #\t\x7f\x01\n\U0001f600é', version="'")
    assert read_statement(written(stated)).product == stated.product


def test_a_short_statement_leaves_the_rest_as_it_is(here: Path) -> None:
    Path("ics.toml").write_text('[readings]\nrun-trigger = "once"\n[ixit]\nclock-rate = 0.5\n')
    statement = read_statement(here / "ics.toml")
    default = default_statement()
    assert statement.readings == default.readings | {"run-trigger": "once"}
    assert (statement.ixit, statement.capabilities) == (default.ixit | {"clock-rate": 0.5}, default.capabilities)
    assert (statement.source, statement.ics.tolerance("clock-rate")) == ("ics.toml", 0.5)


GOOD = """\
product = "x"
profiles = ["core"]
[capabilities]
clock = true
[readings]
run-trigger = "once"
[ixit]
patience = 2000
[models]
core = ["models"]
"""
BAD = {
    "unknown table": (GOOD + "[redings]\n", 11, "did you mean 'readings'?"),
    "unknown key": (GOOD.replace("product", "prodct"), 1, "did you mean 'product'?"),
    "no text": (GOOD.replace('"x"', "1"), 1, "product is a text, in quotes"),
    "unknown profile": (GOOD.replace('"core"]\n[cap', '"cor"]\n[cap'), 2, "did you mean 'core'?"),
    "no list": (GOOD.replace('["core"]\n[cap', '"core"\n[cap'), 2, "profiles is a list"),
    "a number in a list": (GOOD.replace('["core"]\n[cap', '["core", 1]\n[cap'), 2, "profiles is a list"),
    "unknown capability": (GOOD.replace("clock =", "clok ="), 4, "did you mean 'clock'?"),
    "not yes or no": (GOOD.replace("true", '"yes"'), 4, "write true or false"),
    "unknown option": (GOOD.replace("run-trigger", "run-triger"), 6, "did you mean 'run-trigger'?"),
    "unknown value": (GOOD.replace("once", "twice"), 6, "'twice'; it can be observed, repeated, once"),
    "no value": (GOOD.replace('"once"', "true"), 6, "it can be observed, repeated, once"),
    "quoted option": (GOOD.replace("run-trigger", '"run-triger"'), 6, "did you mean 'run-trigger'?"),
    "unknown quantity": (GOOD.replace("patience", "patents"), 8, "did you mean 'patience'?"),
    "no number": (GOOD.replace("2000", '"2000"'), 8, "a number of ms"),
    "yes is no number": (GOOD.replace("2000", "true"), 8, "a number of ms"),
    "not a number": (GOOD.replace("2000", "nan"), 8, "a number of ms from 1"),
    "no end": (GOOD.replace("2000", "inf"), 8, "a number of ms"),
    "below nothing": (GOOD.replace("2000", "-1"), 8, "a number of ms"),
    "too long": (GOOD.replace("2000", "1e30"), 8, "a number of ms"),
    "a table is none": ("readings = 5\n", 1, "write [readings] on a line of its own"),
    "a list of tables": ("[[readings]]\n", None, "write [readings]"),
    "other models": (GOOD.replace("core = [", "probes = ["), 10, "there is no key 'probes'"),
    "models are a path": (GOOD.replace('["models"]', '"models"'), 10, "core is a list of texts"),
    "a path that none can be": (GOOD.replace('"models"', '"a\\u0000b"'), 10, "core is a list of texts"),
    "models that are not there": (
        GOOD.replace("[readings]", '[readings]\ncore-models = "built-in"'), 11, "leave them out"
    ),
    "given twice": (GOOD + 'core = ["more"]\n', 11, "not TOML: "),
    "not TOML": (GOOD.replace("clock = true", "clock: true"), 4, "not TOML: "),
    "YAML": ("- product: x\n", 1, "not TOML: "),
    "unfinished": (GOOD + 'x = "', 11, "not TOML: "),
    "control characters": ('product = "\x00"', 1, "not TOML: "),
    "a long number": ("[ixit]\npatience = " + "9" * 5000, None, "a number this long"),
    "deep lists": ("a = " + "[" * 100_000, None, "nests too deep"),
    "deep tables": ("a." * 100_000 + "b = 1", 1, "nests too deep"),
    "a long key": ("x" * 100_000 + " = 1", 1, "there is no table or key"),
    "huge": ("#" * (LARGEST + 1), None, f"is larger than {LARGEST} bytes"),
}  # fmt: skip


@pytest.mark.parametrize(("text", "line", "problem"), BAD.values(), ids=BAD.keys())
def test_bad_statement_is_reported_with_file_line_and_remedy(text: str, line: int | None, problem: str) -> None:
    path = Path("bad.toml")
    path.write_text(text)
    with pytest.raises(DocumentError) as caught:
        read_statement(path)
    message = str(caught.value)
    assert message.startswith(f"bad.toml:{line}: " if line else "bad.toml: "), message
    assert problem in message
    assert len(message) < 400
    assert "\n" not in message


def test_not_utf8_not_there_and_a_good_one() -> None:
    path = Path("ics.toml")
    path.write_bytes(b'product = "x"\nversion = "\xff"\n')
    with pytest.raises(DocumentError, match=r":2: is not UTF-8"):
        read_statement(path)
    for missing in (Path("nowhere.toml"), Path()):
        with pytest.raises(DocumentError, match="cannot be read"):
            read_statement(missing)
    path.write_bytes(b"\xef\xbb\xbf" + GOOD.replace("\n", "\r\n").encode())
    assert read_statement(path).readings["run-trigger"] == "once"


@pytest.mark.parametrize(
    ("product", "version", "profile", "problem"),
    [
        ("Y", "1", "core", "is about product 'X'"),
        ("X", "2", "core", "is about version '1'"),
        ("X", "1", "container", "core"),
    ],
)
def test_statement_about_something_else_is_refused(product: str, version: str, profile: str, problem: str) -> None:
    statement = stating(product="X", version="1", profiles=("core",), source="ics.toml")
    check_subject(statement, Welcome(PROTOCOL, "X", "1", ""), "core")
    with pytest.raises(WrongUse, match=problem):
        check_subject(statement, Welcome(PROTOCOL, product, version, ""), profile)


# what applies


def test_needs_name_existing_capabilities_and_readings() -> None:
    known = {f"{option}={value}" for option, values in load_options().items() for value in values} | set(PARTS)
    for need in load_capabilities().needs:
        assert {*need.needs, *need.one_of} <= known
        for pattern in need.requirements:
            assert any(need in load_capabilities().of(r.id) for r in load_requirements()), pattern
    always = {r.id for r in CORE_REQUIREMENTS if not load_capabilities().of(r.id)}
    assert always == {
        *("R-10-02", "R-10.1-01", "R-10.1-02", "R-10.1-03", "R-10.1.1-02", "R-10.1.1-05", "R-10.1.1-06"),
        *(f"R-10.1.2-0{n}" for n in range(3, 9)),
    }


def test_everything_applies_if_everything_is_claimed() -> None:
    everything = stating()
    assert [r.id for r in load_requirements() if why_not(r, everything)] == []
    assert lacking_claims(everything, "core") == {}
    readings = tuple(f"{option}={value}" for option, value in EVERYTHING.items())
    assert len(purposes_for(everything, "core")) == len(load_purposes("core", *readings))
    reduced, whole = purposes_for(default_statement(), "container"), load_purposes("container")
    assert [(p.id, p.scenarios) for p in reduced] == [(p.id, p.scenarios) for p in whole]


def test_without_test_operations_only_their_requirements_are_left() -> None:
    default = default_statement()
    of_declared = ("R-9.4.3.2-06", "R-11.2.3-18")
    unmet = {r.id: why_not(r, default) for r in CORE_REQUIREMENTS if why_not(r, default)}
    assert {r: unmet.pop(r, ("", ""))[0] for r in of_declared} == dict.fromkeys(  # type: ignore[index]
        of_declared, "not applicable"
    )
    assert {verdict for verdict, _ in filter(None, unmet.values())} == {"inconclusive"}
    assert lacking_claims(default, "core").keys() <= unmet.keys()
    steps = [step for p in purposes_for(default, "core") for _, scenario in p.scenarios for step in scenario.steps]
    assert not [step for step in steps if isinstance(step, s.Break | s.ReadLog)]
    exercised = {r for p in purposes_for(default, "core") for r in p.requirements}
    behavioural = {r.id for r in CORE_REQUIREMENTS if not set(r.rules) <= CHECKS.keys() and r.id not in of_declared}
    assert behavioural - exercised - unmet.keys() <= behavioural - {
        r for p in load_purposes("core") for r in p.requirements
    }


@pytest.mark.parametrize("part", PARTS)
def test_scenarios_of_a_part_that_is_left_out_are_not_run(part: str) -> None:
    without = stating({part: False})
    for purpose in purposes_for(without, "core"):
        assert part not in {need for _, scenario in purpose.scenarios for need in needs_of(scenario)}, purpose.id
        if purpose.draw is not None:
            drawn = purpose.draw(1, without.readings)
            assert [name for name, _ in drawn] == [name for name, _ in purpose.scenarios]
    gone = {r.id for r in CORE_REQUIREMENTS if why_not(r, without)}
    assert gone
    assert {why_not(REQUIREMENTS[r], without)[0] for r in gone} == {"not applicable"}  # type: ignore[index]


def test_readings_may_make_requirements_not_apply() -> None:
    narrow = stating(readings={"log-message": "narrow-255", "port-trace-parameters": "none"})
    gone = {r.id for r in CORE_REQUIREMENTS if why_not(r, narrow)}
    assert gone == {"R-10.1.4.2-47", *(f"R-10.1.4.2-{n}" for n in range(31, 36))}
    built_in = stating(readings={"core-models": "built-in"})
    of_models = {r.id for r in CORE_REQUIREMENTS if set(r.rules) <= CHECKS.keys()}
    assert {r.id for r in CORE_REQUIREMENTS if why_not(r, built_in)} == of_models


@pytest.mark.parametrize(
    ("transport", "connector", "verdict"),
    [
        ("impossible", "hook", None),
        ("impossible", "impossible", "not applicable"),
        ("impossible", "none", "inconclusive"),
    ],
)
def test_what_cannot_fail_need_not_be_broken(transport: str, connector: str, verdict: str | None) -> None:
    stated = stating(readings={"transport-fault": transport, "connector-fault": connector})
    verdicts = {r: (why_not(REQUIREMENTS[r], stated) or (None,))[0] for r in ("R-10.1.2-01", "R-10.1.2-12")}
    assert verdicts == {"R-10.1.2-01": verdict, "R-10.1.2-12": "not applicable"}


def test_patience_is_the_vendors() -> None:
    hasty = stating(ixit=default_statement().ixit | {"patience": 500.0})
    usual = {name: scenario for p in purposes_for(stating(), "core") for name, scenario in p.scenarios}
    for purpose in purposes_for(hasty, "core"):
        for name, scenario in purpose.scenarios:
            assert scenario.patience == round(usual[name].patience / 4)


# what comes of it


def run(statement: Statement, *requirements: str, adapter: str = ADAPTER) -> Report:
    """A report for profile core, of those purposes that are to exercise ``requirements``."""
    chosen = [p for p in purposes_for(statement, "core") if {*p.requirements} & {*requirements}]
    with Driver(locate(adapter, in_process=True), 1) as driver:
        campaign = Campaign(driver, "core", (), statement)
        list(campaign.check(chosen))
        list(campaign.shorten())
        return campaign.report()


@pytest.mark.parametrize(
    ("adapter", "declared", "verdict"),
    [
        ("ucm_cts.adapters.mutants.python:starts_all_at_a_time", "at-once", "not applicable"),
        ("ucm_cts.adapters.mutants.python:starts_all_at_a_time", "one-by-one", "fail"),
        ("ucm_cts.adapters.mutants.python:starts_all_at_a_time", "observed", "inconclusive"),
        (ADAPTER, "at-once", "fail"),
        (ADAPTER, "one-by-one", "pass"),
        (ADAPTER, "observed", "pass"),
    ],
)
def test_simultaneous_start_has_no_order_to_reverse(adapter: str, declared: str, verdict: str) -> None:
    hasty = default_statement().ixit | {"patience": 100.0}
    statement = stating(readings={"start-order": declared}, ixit=hasty)
    chosen = [p for p in purposes_for(statement, "container") if "R-11.2.2.1-13" in p.requirements]
    with Driver(locate(adapter, in_process=True), 1) as driver:
        campaign = Campaign(driver, "container", (), statement)
        list(campaign.check(chosen))
        assert verdicts(campaign.report(), ["R-11.2.2.1-13"]) == {"R-11.2.2.1-13": verdict}


def verdicts(report: Report, of: Iterable[str] = ()) -> dict[str, str]:
    return {r.id: r.verdict for r in report.requirements if r.id in of or not of}


def test_a_part_left_out_is_a_failure_of_the_core_and_the_rest_of_it_does_not_apply(here: Path) -> None:
    report = run(stating({"clock": False}, source="ics.toml"), "R-10.1.3.2-15", "R-10.1.4.1-08")
    wanted = ("R-10.1-01", "R-10.1.4.1-08", "R-10.1.3.2-15")
    assert verdicts(report, wanted) == dict(zip(wanted, ("fail", "not applicable", "pass"), strict=True))
    assert report.verdict == "not conformant"
    results = {r.id: r for r in report.requirements}
    assert results["R-10.1.4.1-08"].reason == "ics.toml says clock = false"
    (failed,) = results["R-10.1-01"].findings
    assert failed.execution is None
    assert failed.finding.observed == "the vendor's statement (ics.toml) leaves out clock"
    save_report(report, here / "out")
    document = report_of(here / "out")
    assert document["statement"]["capabilities"]["clock"] is False
    (entry,) = [r for r in document["requirements"] if r["id"] == "R-10.1-01"]
    assert (entry["findings"][0]["replay"], entry["findings"][0]["scenario"]) == ("", "")
    assert {path.name for path in (here / "out" / "failures").iterdir()} == {"ics.toml"}
    page = etree.HTML((here / "out" / "report.html").read_text())
    cells = {row[0][0].text: row[1].text for row in page.xpath("//section[@id='statement']//tr") if len(row[0])}
    assert (cells["clock"], cells["port_trace"], cells["trace-sink"]) == ("no", "yes", "hook")
    (reported,) = page.xpath("//tbody[@id='R-10.1-01']//section")
    assert not reported.xpath(".//svg")
    assert "Replay" not in "".join(reported.itertext())
    junit = etree.parse(here / "out" / "junit.xml")
    assert junit.xpath("//testcase[starts-with(@name, 'R-10.1-01')]/failure/@message") == [failed.finding.observed]
    assert junit.xpath("//testcase[starts-with(@name, 'R-10.1.4.1-08')]/skipped/@message") == [
        "not applicable: ics.toml says clock = false"
    ]
    again = read_statement(here / "out" / "failures" / "ics.toml")
    assert again.capabilities == report.statement.capabilities


def test_requirement_without_scenario_is_not_green_in_pytest() -> None:
    without = stating({"clock": False})
    everything = SimpleNamespace(checked=purposes_for(without, "core"), statement=without, known=())
    (line,) = [line for line in _undecided(everything, run(without)) if line.startswith("fail ")]  # type: ignore[arg-type]
    assert line.startswith("fail R-10.1-01: expected ")
    everything.checked = ()
    assert _undecided(everything, run(without)) == []  # type: ignore[arg-type]


def test_core_is_claimed_and_there() -> None:
    assert verdicts(run(stating(), "R-10.1.5.1-09"), ["R-10.1-01"]) == {"R-10.1-01": "pass"}


def test_claimed_operation_that_is_not_offered_is_a_false_claim() -> None:
    report = run(stating(), "R-10.1.5.1-09", adapter="subjects:has_no_services")
    assert verdicts(report, ["R-10.1-01"]) == {"R-10.1-01": "fail"}
    honest = run(stating({s.SERVICE_CONNECTOR: False}), "R-10.1.5.1-09", adapter="subjects:has_no_services")
    assert verdicts(honest, ["R-10.1-01", "R-10.1.5.1-09"]) == {"R-10.1-01": "fail", "R-10.1.5.1-09": "not applicable"}


def test_models_give_verdicts(here: Path) -> None:
    models = here / "models"
    models.mkdir()
    for path in CORE.glob("*.xml"):
        (models / path.name).write_text(path.read_text().replace('name="ok" value="0"', 'name="ok" value="7"'))
    (models / "container_services.xml").unlink()
    report = run(stating(models=("models",), folder=str(here), source="ics.toml"))
    results = {r.id: r for r in report.requirements}
    (failed,) = results["R-10.1.2-05"].findings
    assert (results["R-10.1.2-05"].verdict, failed.finding.rule) == ("fail", "core_declarations")
    assert failed.finding.observed == "value 7 (return_codes.xml:10)"
    assert results["R-10.1.2-06"].verdict == "pass"
    assert results["R-10.1.2-06"].exercised == 1
    assert results["R-10.1.4.2-20"].verdict == "inconclusive"
    assert results["R-10.1.4.2-20"].reason == "models: what should contain it is missing"
    assert report.readings["comm-ecode-index"] == ("declared-type",)
    save_report(report, here / "out")
    assert "return_codes.xml:10" in (here / "out" / "report.html").read_text()


def test_unusable_models_are_reported_before_the_run(here: Path) -> None:
    for models, problem in ((("none.xml",), "none.xml: cannot be read"), (("bad.xml",), "bad.xml:1: is not XML")):
        (here / "bad.xml").write_text("<a>")
        with pytest.raises(DocumentError, match=problem):
            run(stating(models=models, folder=str(here)))


def test_optional_parts_of_models_do_not_apply(here: Path) -> None:
    for path in CORE.glob("*.xml"):
        text = re.sub(r'<PrimitiveInteger name="log_severity_enumerator_t"[^>]*>', "", path.read_text())
        (here / path.name).write_text(text)
    (result,) = [r for r in run(stating(models=(".",), folder=str(here))).requirements if r.id == "R-10.1.4.2-45"]
    assert (result.verdict, result.exercised) == ("not applicable", 0)
    assert "it may be missing, and it is" in result.reason


def test_without_models_their_requirements_are_open(here: Path) -> None:
    (result,) = [r for r in run(stating()).requirements if r.id == "R-10.1.2-05"]
    assert (result.verdict, result.reason) == ("inconclusive", "models: there is no model to look at")


# commands


def test_ics_writes_a_statement_that_run_takes(here: Path) -> None:
    outcome = ucm_cts("ics", ADAPTER, "--full")
    assert (outcome.status, outcome.err) == (0, "")
    statement = read_statement(here / "ucm-cts-ics.toml")
    assert statement.product == "UCM-CTS reference framework (Python)"
    assert statement.profiles == FRAMEWORK_PROFILES
    unnamed = msgspec.structs.replace(statement, product="", version="", source="", folder=".", profiles=PROFILES)
    default = default_statement()
    assert unnamed == msgspec.structs.replace(default, readings=default.readings | dict.fromkeys(HOOKS, "hook"))
    (command,) = re.findall(r"(ucm-cts run .*)", outcome.out)
    outcome = ucm_cts(*shlex.split(command)[1:], "-k", "R-11.2.2.1-13")
    assert (outcome.status, outcome.err) == (0, "")
    assert report_of(here / "ucm-cts-report")["statement"]["source"] == "ucm-cts-ics.toml"


def test_a_short_statement_has_what_differs_and_what_must_be_decided(here: Path) -> None:
    assert ucm_cts("ics", ADAPTER).status == 0
    text = (here / "ucm-cts-ics.toml").read_text()
    short = tomllib.loads(text)
    undecided = {"core-models": "shipped", "unknown-policy": "unasked", "incompatible-ends": "unasked"}
    assert short["readings"] == dict.fromkeys(HOOKS, "hook") | undecided
    assert (short["profiles"], short["models"]) == (["container", "core"], {"core": []})
    assert short.keys() == {"product", "version", "profiles", "readings", "models"}
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
    assert (stated.profiles, [part for part in PARTS if not stated.capabilities[part]]) == (
        FRAMEWORK_PROFILES,
        [s.SERVICE_CONNECTOR],
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
    assert offers.keys() == {*PARTS, *HOOKS}
    assert {name for name, offer in offers.items() if offer.lacking} == of
    assert not [offer for offer in offers.values() if "not tried" in offer.lacking]
    declared = claimed(default_statement(), offers).readings["protected-active-applicability"]
    assert declared == ("onComponent" if lacks.endswith("AsAWhole") else "onPort")


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
