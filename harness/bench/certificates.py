"""Measures the site of a thousand certificates: making it, and filtering its table in Chromium.

The command is ``python -m ucm_cts.harness.bench.certificates``.
"""

from __future__ import annotations

import hashlib
import shutil
import statistics
import sys
import tempfile
import time
from pathlib import Path

from rich.console import Console
from selenium import webdriver
from selenium.webdriver.chrome.service import Service

from ucm_cts.harness.bench.measuring import empty_table, limit
from ucm_cts.harness.catalogue.requirements import load_requirements, requirements_of
from ucm_cts.harness.certificates.verified import Uncovered
from ucm_cts.harness.publishing.certificate import Certificate
from ucm_cts.harness.publishing.pages import site_files
from ucm_cts.harness.publishing.site import site_of
from ucm_cts.harness.report.published import PublishedResult, PublishedVerdict

NUMBER = 1000
"""Certificates of the site."""

MILLISECONDS = 100
"""The limit of filtering them, until the count is right and the first rows are laid out."""

ROUNDS = 15

_FILTER = """
const [id, value, done] = arguments;
const field = document.getElementById(id);
field.value = value;
const began = performance.now();
field.dispatchEvent(new Event("input", { bubbles: true }));
document.body.offsetHeight;
const laidOut = performance.now() - began;
const table = document.getElementById("matrix");
const end = () => table.ariaBusy ? setTimeout(end) : done([laidOut, performance.now() - began]);
requestAnimationFrame(() => setTimeout(end));
"""

_CASES = {
    "a word that one product has": ("search", "certified-77 "),
    "no word: all": ("search", ""),
    "a verdict that half have": ("verdict", "not conformant"),
    "any verdict: all": ("verdict", ""),
}


def certificates(number: int = NUMBER) -> list[Certificate]:
    """Made-up certificates of profile ``core``, in four versions each."""
    verdicts = tuple(PublishedVerdict(r.id, r.level, "pass") for r in requirements_of("core") if r.rules)
    result = PublishedResult("", "", "core", "conformant", "0.1.0", verdicts)
    made = []
    for count in range(number):
        digest = hashlib.sha256(str(count).encode()).hexdigest()
        made.append(
            Certificate(
                digest, "a.ucmcert", 1_000_000, f"certified-{count // 4} framework", f"{count % 4}.0", "core",
                "not conformant" if count % 2 else "conformant", "self-declared", (f"vendor-{count // 4}",),
                f"2031-01-{count % 28 + 1:02}T00:00:00Z", "0.1.0", "", "UCM", "bubblewrap", Uncovered(), (), (), result, "",
            )
        )  # fmt: skip
    return sorted(made, key=lambda one: one.age)


def main() -> None:
    """Measure, and print the table."""
    console = Console()
    if not shutil.which("chromium") or not shutil.which("chromedriver"):
        console.print("Chromium and chromedriver are not installed: filtering cannot be measured.")
        sys.exit(1)
    began = time.perf_counter()
    files = site_files(site_of(certificates(), (), load_requirements()), load_requirements())
    made, size = time.perf_counter() - began, sum(map(len, files.values())) / 1e6
    table = empty_table(
        f"The table of {NUMBER:,} certificates in Chromium, median of {ROUNDS}",
        "filtered by|answer, ms|last row painted, ms|limit",
    )
    with tempfile.TemporaryDirectory() as place:
        for name in ("index.html", "style.css", "site.js"):
            (Path(place) / name).write_bytes(files[name])
        for case, (laid_out, painted) in _filtered(Path(place) / "index.html").items():
            table.add_row(case, f"{laid_out:.1f}", f"{painted:.1f}", limit(MILLISECONDS, laid_out))
    console.print(table)
    console.print(f"The site is made in {made:.1f} s: {len(files):,} files, {size:.0f} MB.")


def _filtered(page: Path) -> dict[str, tuple[float, float]]:
    """The medians of each case, in milliseconds: until the first rows are laid out, and until the last one is painted."""
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage"):
        options.add_argument(argument)
    options.binary_location = str(shutil.which("chromium"))
    driver = webdriver.Chrome(options, Service(shutil.which("chromedriver")))
    try:
        driver.get(page.as_uri())
        taken: dict[str, list[tuple[float, float]]] = {case: [] for case in _CASES}
        for _ in range(ROUNDS):
            for case, arguments in _CASES.items():
                laid_out, painted = driver.execute_async_script(_FILTER, *arguments)
                taken[case].append((laid_out, painted))
    finally:
        driver.quit()
    return {
        case: (statistics.median(a for a, _ in pairs), statistics.median(b for _, b in pairs))
        for case, pairs in taken.items()
    }


if __name__ == "__main__":
    main()
