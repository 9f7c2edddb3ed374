"""All files of the site, by their names; the same certificates give the same bytes. Archives are copied as they are."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import ucm_cts
from ucm_cts.harness.catalogue.profiles import PROFILES
from ucm_cts.harness.catalogue.requirements import Requirement
from ucm_cts.harness.publishing.badges import badge_of
from ucm_cts.harness.publishing.certificate import Certificate
from ucm_cts.harness.publishing.earl import earl
from ucm_cts.harness.publishing.feed import atom
from ucm_cts.harness.publishing.index import SCHEMA_FILE, index, schema
from ucm_cts.harness.publishing.site import Product, Site
from ucm_cts.harness.report.order import count, shown
from ucm_cts.harness.report.page import Pages, part

FILES = (
    "index.html", "requirements.html", "about.html", "style.css", "site.js", "index.json", SCHEMA_FILE, "feed.atom",
    "products/*.html", "certificates/*.html", "certificates/*.jsonld", "certificates/*.ucmcert",
    "requirements/R-*.html", "badges/*.svg", "badges/*.json",
)  # fmt: skip
"""Patterns of all files of a site."""

PROFILES_IN_WORDS = {
    "container": "life cycle, containers and their API (clauses 11 and 12.10)",
    "core": "container, and the interaction patterns and services of clause 10.1",
    "extensions": "core, and those parts of clauses 10.2 to 10.5 that the vendor claims",
    "pim": "models are checked as clause 9 says",
    "idl": "IDL is generated as clause 12 says",
    "cpp11": "C++11 is generated as clause 13 says",
    "cpp03": "C++03 is generated as clause 13 says",
}

ASSURANCES = {
    "self-declared": "the vendor ran the tests and chose the seed",
    "challenged": "the vendor ran the tests; an auditor drew the seed after the vendor was committed to the product",
    "witnessed": "an auditor ran the tests",
}

_TEMPLATES = Path(__file__).parent / "templates"


def site_files(site: Site, catalogue: Iterable[Requirement], url: str = "") -> dict[str, bytes]:
    """The whole site but the archives. ``url`` is where it will be, ending with a slash; empty if that is not known."""
    products = {(one.product, one.signers): one for one in site.products}
    known = {entry.id: entry for entry in catalogue}
    pages = Pages(
        _TEMPLATES,
        site=site,
        products=products,
        catalogue=known,
        count=count,
        shown=shown,
        about=PROFILES_IN_WORDS,
        assurances=ASSURANCES,
        badge_of=badge_of,
        suite_version=ucm_cts.__version__,
        url=url,
        markdown=lambda product, one: _markdown(product, one, url),
    )
    files: dict[str, bytes] = {
        "style.css": (str(part("report.css")) + _part("site.css")).encode(),
        "site.js": _part("site.js").encode(),
        "index.json": index(site),
        SCHEMA_FILE: schema(),
        "feed.atom": atom(site, url),
    }
    for name in "index", "requirements", "about":
        files[f"{name}.html"] = pages.rendered(f"{name}.html.jinja", up="", at=name).encode()
    for product in site.products:
        files[product.page] = pages.rendered("product.html.jinja", up="../", at="", product=product).encode()
        for one in product.newest:
            files |= _badges(f"{product.file}-{one.profile}", one)
    for asked in site.requirements:
        files[asked.page] = pages.rendered("requirement.html.jinja", up="../", at="", asked=asked).encode()
    for one in site.certificates:
        files[one.page] = _certificate(pages, one, products[one.owner])
        files[f"certificates/{one.digest}.jsonld"] = earl(one)
        files |= _badges(one.digest, one)
    for fallen in site.fallen:
        if fallen.digest:
            badge = badge_of(fallen)
            files |= {f"badges/{fallen.digest}.svg": badge.svg, f"badges/{fallen.digest}.json": badge.json}
    return files


def _certificate(pages: Pages, one: Certificate, product: Product) -> bytes:
    titles = {entry.id: entry.title for entry in one.result.requirements}
    undecided = [entry for entry in one.result.requirements if entry.verdict in ("inconclusive", "error")]
    page = pages.rendered(
        "certificate.html.jinja",
        up="../",
        at="",
        one=one,
        product=product,
        titles=titles,
        failures=[failure for failure in one.result.failures if failure.requirement in titles],
        undecided=undecided,
    )
    return page.encode()


def _badges(name: str, one: Certificate) -> dict[str, bytes]:
    badge = badge_of(one)
    return {f"badges/{name}.svg": badge.svg, f"badges/{name}.json": badge.json}


def _markdown(product: Product, one: Certificate, url: str) -> str:
    """What shows the badge of ``product`` in a README; the name is left out, because it may be anything."""
    base = url or "https://SITE/"
    return f"[![UCM {one.profile}]({base}badges/{product.file}-{one.profile}.svg)]({base}{product.page})"


def _part(name: str) -> str:
    return (_TEMPLATES / name).read_text(encoding="utf-8")


assert PROFILES_IN_WORDS.keys() == {*PROFILES}
