"""Campaign plans: what one says, and that a wrong one is refused with file, line and remedy."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from command_line import ucm_cts

from ucm_cts.harness.campaigns.plan import Plan, read_plan

pytestmark = pytest.mark.usefixtures("here")

WHOLE = """\
profiles = ["container", "core"]
seeds = [3, 4]
scenarios = 50

[products.one]
adapter = "reference-py"
virtual-time = true
timeout = 2

[products.one.variants.strict]
statement = "strict.toml"
profiles = ["core"]

[products.two]
adapter = "reference-py"
seeds = [9]

[self-test]
names = ["calls_once"]
quick = true
"""


def read(text: str) -> Plan:
    path = Path("plan.toml")
    path.write_text(text)
    return read_plan(path)


def test_products_have_what_the_plan_says_and_variants_what_their_product_says() -> None:
    plan = read(WHOLE)
    one, strict, two = plan.products
    assert plan.scenarios == 50
    assert [p.name for p in plan.products] == ["one", "one/strict", "two"]
    assert (one.profiles, one.seeds, one.timeout, one.virtual_time) == (("container", "core"), (3, 4), 2.0, True)
    assert (strict.adapter, strict.statement, strict.profiles) == ("reference-py", "strict.toml", ("core",))
    assert (strict.seeds, strict.timeout, strict.virtual_time) == ((3, 4), 2.0, True)
    assert (two.seeds, two.virtual_time, two.sandbox) == ((9,), False, True)
    assert plan.self_test is not None
    assert (plan.self_test.names, plan.self_test.quick, plan.self_test.seeds) == (("calls_once",), True, (1,))


PRODUCT = '[products.p]\nadapter = "reference-py"\n'
WRONG = {
    "seeds = [": "plan.toml:1: not TOML",
    "": "plan.toml: plans nothing; name a product in a table",
    'profile = ["core"]\n': "plan.toml:1: there is no key 'profile'; did you mean 'profiles'?",
    'profiles = ["idl"]\n' + PRODUCT: "plan.toml:1: profile 'idl' is of tool chains, .* there is container, core",
    'profiles = ["cor"]\n' + PRODUCT: "plan.toml:1: there is no profile 'cor'; there is container",
    "seeds = []\n" + PRODUCT: r"plan.toml:1: Expected `array` of length >= 1 \(at \$.seeds\)",
    "seeds = [-1]\n" + PRODUCT: r"plan.toml:1: Expected `int` >= 0",
    "scenarios = 0\n" + PRODUCT: "plan.toml:1: Expected `int` >= 1",
    "[products.p]\nseeds = [1]\n": "plan.toml:1: p has no adapter; write adapter = ",
    "products = 3\n": r"plan.toml:1: Expected `object`, got `int` \(at \$.products\)",
    "[products]\np = 3\n": r"plan.toml:2: products.p is a table: write \[products.p\] on a line of its own",
    PRODUCT + 'timeout = "5s"\n': r"plan.toml:3: Expected `float \| null`, got `str` \(at \$.timeout\)",
    PRODUCT + "memory = 1\n": "plan.toml:3: Expected `int` >= 16",
    PRODUCT + "virtual_time = true\n": "plan.toml:3: there is no key 'virtual_time'; did you mean 'virtual-time'?",
    PRODUCT + "[products.p.variants.q]\nsede = [1]\n": "plan.toml:4: there is no key 'sede'; did you mean 'seeds'?",
    '[products."../p"]\nadapter = "reference-py"\n': "'../p' is no name for a folder; use letters",
    PRODUCT + '[products.p.variants.".."]\n': "'..' is no name for a folder; use letters",
    PRODUCT + "[self-test]\nname = 1\n": "plan.toml:4: there is no key 'name'; did you mean 'names'?",
    '[products.p]\nadapter = "reference-pie"\n': "plan.toml:1: 'reference-pie' names no adapter. Did you mean 'reference-py'?",
    PRODUCT
    + 'select = "R-99"\n': "plan.toml:1: p selects 'R-99', which matches no test purpose of profile container; try a",
    PRODUCT + 'statement = "gone.toml"\n': "gone.toml: cannot be read: No such file",
    PRODUCT + 'known-failures = "gone.yaml"\n': "gone.yaml: cannot be read: No such file",
    PRODUCT + 'artifacts = ["gone"]\n': "plan.toml:1: 'gone' cannot be read: No such file",
    '[products.p]\nadapter = "tcp://127.0.0.1:9"\n': "plan.toml:1: 'tcp://127.0.0.1:9' has no file here .* artifacts = ",
    '[self-test]\nnames = ["calls_twice"]\n': "plan.toml:1: there is no mutant or variant 'calls_twice'; 'ucm-cts selftest",
}


@pytest.mark.parametrize("text", WRONG)
def test_wrong_plan_is_refused_with_its_line_and_a_remedy(text: str) -> None:
    Path("plan.toml").write_text(text)
    outcome = ucm_cts("campaign", "plan.toml", "--dry-run")
    assert (outcome.status, outcome.out, outcome.err.count("\n")) == (2, "", 1), outcome
    assert re.search(WRONG[text], outcome.err), outcome.err


def test_profile_that_the_statement_does_not_claim_is_refused() -> None:
    Path("ics.toml").write_text('profiles = ["container"]\n')
    Path("plan.toml").write_text('profiles = ["core"]\n' + PRODUCT + 'statement = "ics.toml"\n')
    outcome = ucm_cts("campaign", "plan.toml", "--dry-run")
    assert outcome.status == 2
    assert (
        "plan.toml:2: the statement of p does not claim profile 'core'; claim it, or leave it out here" in outcome.err
    )
