"""The site in a real Chromium, from files: sizes, colours, keyboard, print, without scripts, and with a thousand certificates."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from pathlib import Path

import msgspec
import pytest
from browser import Browser, browser
from certified import WAIVER, decided_in, report, verified
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys

from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.certificates.verified import Uncovered, Verified
from ucm_cts.harness.publishing.certificate import Certificate, Fallen, settled
from ucm_cts.harness.publishing.pages import site_files
from ucm_cts.harness.publishing.site import Site, site_of

pytestmark = [pytest.mark.native, pytest.mark.slow]

FAILS = "R-11.2.2.1-13"
SHOWN = "return [...document.querySelectorAll('#matrix tbody tr')].filter((row) => row.checkVisibility()).length"
FIRST = "return document.querySelector('#matrix tbody tr').cells[0].innerText"


def certificate(of: Verified) -> Certificate:
    digest = hashlib.sha256(msgspec.json.encode(of)).hexdigest()
    made = settled(msgspec.structs.replace(of, digest=digest), digest, "acme.ucmcert", 4096)
    assert isinstance(made, Certificate)
    return made


def written(folder: Path, site: Site) -> Path:
    for name, content in site_files(site, load_requirements()).items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(content)
    return folder


@pytest.fixture(scope="module")
def chromium() -> Iterator[Browser]:
    with browser() as opened:
        yield opened


@pytest.fixture(scope="module")
def certificates() -> list[Certificate]:
    """Everything that a page can show: versions, profiles, degrees, waivers, other rules, a long name."""
    made = [
        verified(report(version="1.0", verdicts={FAILS: "fail", "R-11.2.1.3-03": "not applicable"})),
        verified(
            report(version="1.1", verdicts={FAILS: "inconclusive", "R-11.2.1.3-03": "error"}), assurance="challenged",
            issued="2031-03-01T00:00:00+00:00", uncovered=Uncovered(("R-11-01",), (), (WAIVER,), ("late-add",)),
        ),
        verified(report(version="1.1", profile="core"), assurance="witnessed", issued="2031-03-02T00:00:00+00:00"),
        verified(report("Borealis" + " middleware" * 20, "7" * 90), judged_by="0.2.0", signers=("borealis",)),
        *(verified(report("Tool chain", "3", profile), signers=("tools",)) for profile in ("pim", "idl", "cpp11", "cpp03")),
    ]  # fmt: skip
    return sorted(map(certificate, made), key=lambda one: one.age)


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory, certificates: list[Certificate]) -> Path:
    fallen = Fallen("bad.ucmcert", "cd" * 32, (Problem("signature", "no trusted key signed it"),), "Acme UCM 9")
    return written(tmp_path_factory.mktemp("site"), site_of(certificates, [fallen], load_requirements()))


def pages(site: Path, certificates: list[Certificate]) -> list[Path]:
    products = sorted((site / "products").glob("*.html"))
    return [
        site / "index.html", site / "about.html", *products, *(site / one.page for one in certificates[:5]),
        site / "requirements" / f"{FAILS}.html",
    ]  # fmt: skip


@pytest.mark.parametrize(("width", "scheme"), [(1440, "light"), (1440, "dark"), (390, "light"), (390, "dark")])
def test_pages_fit_and_axe_core_objects_to_nothing(
    chromium: Browser, site: Path, certificates: list[Certificate], width: int, scheme: str
) -> None:
    for page in pages(site, certificates):
        chromium.open(page, width, scheme)
        assert chromium.run("return document.documentElement.scrollWidth") <= width, page.name
        assert chromium.violations() == [], page.name
        assert chromium.complaints() == [], page.name


def test_the_list_of_requirements_fits_and_axe_core_objects_to_nothing(
    chromium: Browser, tmp_path: Path, certificates: list[Certificate]
) -> None:
    small = site_of([one for one in certificates if one.profile == "container"], [], load_requirements())
    folder = written(tmp_path, small)
    for width in (1440, 390):
        chromium.open(folder / "requirements.html", width)
        assert chromium.run(SHOWN) == len(decided_in("container"))
        assert chromium.run("return document.documentElement.scrollWidth") <= width
        assert chromium.violations() == []
    chromium.driver.find_element(By.ID, "broken").click()
    assert chromium.run(SHOWN) == 1
    assert FAILS in chromium.run("return document.querySelector('#matrix').innerText")


def test_no_verdict_reaches_out_of_its_cell_and_sizes_keep_their_order_on_paper(chromium: Browser, site: Path) -> None:
    wide = """return [...document.querySelectorAll('.matrix td .badge')].filter((one) =>
        one.getBoundingClientRect().right > one.closest('td').getBoundingClientRect().right).length"""
    for width in (1440, 1024, 390):
        chromium.open(site / "index.html", width)
        assert chromium.run("return document.querySelectorAll('.matrix td .badge').length") > 6
        assert chromium.run(wide) == 0, width
    sizes = "return ['body', '.under'].map((one) => parseFloat(getComputedStyle(document.querySelector(one)).fontSize))"
    chromium.open(site / "index.html", media="print")
    body, under = chromium.run(sizes)
    assert under < body, "what is said beside is smaller, on paper, too"


def test_colours_and_styles_apply(chromium: Browser, site: Path) -> None:
    background = "return getComputedStyle(document.body).backgroundColor"
    colours = []
    for scheme in ("light", "dark"):
        chromium.open(site / "index.html", scheme=scheme)
        colours.append(chromium.run(background))
    assert len(set(colours)) == 2
    chromium.open(next((site / "products").glob("acme*")))
    broken = "return [...document.images].filter((one) => !one.naturalWidth).map((one) => one.src)"
    assert chromium.run("return document.images.length") > 0
    assert chromium.run(broken) == []


def test_filters_and_sorting_by_keyboard_only(chromium: Browser, site: Path) -> None:
    chromium.open(site / "index.html")
    assert chromium.run(SHOWN) == 4
    body = chromium.driver.switch_to.active_element
    body.send_keys("/")
    search = chromium.driver.switch_to.active_element
    assert search.get_attribute("id") == "search"
    search.send_keys("acme 1.1")
    assert chromium.run(SHOWN) == 1
    search.send_keys(Keys.ESCAPE)
    assert chromium.run(SHOWN) == 4
    search.send_keys(Keys.TAB, "core")
    profile = chromium.driver.switch_to.active_element
    assert (profile.get_attribute("id"), profile.get_attribute("value")) == ("profile", "core")
    assert chromium.run(SHOWN) == 1
    assert "profile=core" in chromium.driver.current_url
    chromium.open(site / "index.html")
    seen = set()
    for _ in range(60):
        chromium.driver.switch_to.active_element.send_keys(Keys.TAB)
        active = chromium.driver.switch_to.active_element
        outline = chromium.run("return getComputedStyle(arguments[0]).outlineStyle", active)
        assert outline != "none" or active.tag_name == "body"
        seen.add((active.tag_name, active.get_attribute("id") or active.text))
        if active.tag_name == "button" and active.text == "Product":
            active.send_keys(Keys.ENTER, Keys.ENTER)
            assert active.find_element(By.XPATH, "..").get_attribute("aria-sort") == "descending"
            assert "Tool chain" in chromium.run(FIRST)
    assert {("input", "search"), ("select", "verdict"), ("button", "Clear"), ("button", "Issued")} <= seen
    assert any(tag == "a" and "Tool chain" in text for tag, text in seen)


def test_choices_fit_one_and_the_same_cell(chromium: Browser, site: Path) -> None:
    for state, rows in (
        ("profile=container&verdict=inconclusive&assurance=challenged", 1),
        ("profile=core&verdict=inconclusive", 0),
        ("verdict=not+conformant", 1),
        ("assurance=witnessed", 1),
        ("newest=1", 3),
        ("search=no+such+thing", 0),
        ("verdict=bogus", 4),
    ):
        chromium.open(site / "index.html")
        chromium.run("location.hash = arguments[0]", "#" + state)
        chromium.driver.execute_async_script("setTimeout(arguments[0], 50)")
        assert chromium.run(SHOWN) == rows, state
    chromium.run("location.hash = '#search=nothing'")
    chromium.driver.execute_async_script("setTimeout(arguments[0], 50)")
    chromium.driver.find_element(By.ID, "clear").click()
    chromium.driver.execute_async_script("setTimeout(arguments[0], 50)")
    assert chromium.run(SHOWN) == 4


def test_without_scripts_everything_is_shown(chromium: Browser, site: Path) -> None:
    chromium.open(site / "index.html", scripts=False)
    try:
        rows = chromium.driver.find_elements(By.CSS_SELECTOR, "#matrix tbody tr")
        assert [row.is_displayed() for row in rows] == [True] * 4
        assert not chromium.driver.find_element(By.CSS_SELECTOR, ".filter").is_displayed()
    finally:
        chromium.driver.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})


def test_print_has_what_a_reader_of_paper_needs(chromium: Browser, site: Path, certificates: list[Certificate]) -> None:
    chromium.open(site / certificates[1].page, media="print")
    shown = chromium.run("return document.body.innerText")
    assert WAIVER.reason in shown or "libacme.so" in shown
    assert "Requirements\n" not in shown.partition("Scope")[0]
    hidden = "return [...document.querySelectorAll('details > :not(summary)')].filter((one) => !one.checkVisibility()).length"
    assert chromium.run(hidden) == 0
    chromium.open(site / "index.html", media="print")
    assert not chromium.run("return document.querySelector('.filter').checkVisibility()")
    assert chromium.run(SHOWN) == 4


def test_a_thousand_certificates_are_filtered(chromium: Browser, tmp_path: Path) -> None:
    plain = certificate(verified())
    many = [
        msgspec.structs.replace(
            plain,
            digest=hashlib.sha256(str(number).encode()).hexdigest(),
            product=f"Product {number % 250}",
            version=f"{number // 250}.0",
            verdict=("conformant", "not conformant")[number % 5 == 0],
        )
        for number in range(1000)
    ]
    count = f"""
        const done = arguments[0], table = document.getElementById("matrix");
        const look = () => table.ariaBusy ? setTimeout(look) : done((() => {{ {SHOWN} }})());
        look();
    """
    chromium.open(written(tmp_path, site_of(many, [], load_requirements())) / "index.html")
    assert chromium.driver.execute_async_script(count) == 1000
    search = chromium.driver.find_element(By.ID, "search")
    search.send_keys("product 249")
    assert chromium.driver.execute_async_script(count) == 4
    search.send_keys(Keys.ESCAPE)
    assert chromium.driver.execute_async_script(count) == 1000
    chromium.driver.find_element(By.ID, "newest").click()
    assert chromium.driver.execute_async_script(count) == 250
    chromium.driver.find_element(By.ID, "verdict").send_keys("not")
    assert chromium.driver.execute_async_script(count) == 50
    assert "50 of 1000" in chromium.driver.find_element(By.ID, "shown").text
