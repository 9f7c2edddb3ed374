"""The vendor's statement as a file: what is written, what is read, and what is refused."""

from __future__ import annotations

import re
from pathlib import Path

import msgspec
import pytest
from statements import PARTS, stating

from ucm_cts.adapters.contract.messages import PROTOCOL, Welcome
from ucm_cts.harness.catalogue.documents import DocumentError
from ucm_cts.harness.catalogue.requirements import load_options
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.statement import IXIT, Statement, default_statement
from ucm_cts.harness.statement.files import LARGEST, check_subject, read_statement
from ucm_cts.harness.statement.writing import to_toml

pytestmark = pytest.mark.usefixtures("here")


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
