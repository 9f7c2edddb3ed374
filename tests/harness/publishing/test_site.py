"""The site: what pages, badges, EARL, feed and index say, and what hostile texts cannot do to them."""

from __future__ import annotations

import hashlib
import json
import re
from pathlib import Path
from urllib.parse import unquote, urljoin

import jsonschema
import msgspec
import pytest
import rdflib
from certified import WAIVER, decided_in, report, verified
from lxml import etree, html
from made_up_run import HOSTILE

from ucm_cts.harness.catalogue.requirements import load_requirements
from ucm_cts.harness.certificates.problems import Problem
from ucm_cts.harness.certificates.verified import Subject, Uncovered, Verified
from ucm_cts.harness.publishing.certificate import Certificate, Fallen, file_name, settled
from ucm_cts.harness.publishing.pages import FILES, site_files
from ucm_cts.harness.publishing.site import site_of
from ucm_cts.harness.report.out_folder import OutFolder
from ucm_cts.harness.report.published import read_published
from ucm_cts.harness.report.published_pages import overview

FAILS, OTHER = "R-11.2.2.1-13", "R-11.2.1.3-03"
EARL = rdflib.Namespace("http://www.w3.org/ns/earl#")


def certificate(of: Verified) -> Certificate:
    digest = hashlib.sha256(msgspec.json.encode(of)).hexdigest()
    made = settled(msgspec.structs.replace(of, digest=digest), digest, "acme.ucmcert", 4096)
    assert isinstance(made, Certificate)
    return made


OLD = certificate(verified(report(version="1.0", verdicts={FAILS: "fail"}, observed="Started first, stopped first.")))
NEW = certificate(
    verified(
        report(version="1.1", verdicts={OTHER: "inconclusive"}),
        issued="2031-03-01T00:00:00+01:00",
        assurance="challenged",
    )
)
NEWER_RULES = certificate(verified(report("Borealis", "7"), judged_by="0.2.0", signers=("borealis",)))
FALLEN = Fallen("bad.ucmcert", "cd" * 32, (Problem("signature", "no trusted key signed it"),), "Acme UCM 9")


def files(*certificates: Certificate, fallen: tuple[Fallen, ...] = (), url: str = "") -> dict[str, bytes]:
    ordered = sorted(certificates, key=lambda one: one.age)
    return site_files(site_of(ordered, fallen, load_requirements()), load_requirements(), url)


SITE = files(OLD, NEW, NEWER_RULES, fallen=(FALLEN,))


def page(name: str, site: dict[str, bytes] = SITE) -> html.HtmlElement:
    return html.document_fromstring(site[name].decode())


def text(element: html.HtmlElement) -> str:
    return re.sub(r" ([,.:;])", r"\1", " ".join(" ".join(element.itertext()).split()))


def product_page(site: dict[str, bytes] = SITE) -> html.HtmlElement:
    return page(f"products/{file_name('Acme UCM', 'acme')}.html", site)


def test_every_link_leads_to_a_file_and_nothing_is_foreign() -> None:
    for name, content in SITE.items():
        if not name.endswith(".html"):
            continue
        tree = html.document_fromstring(content.decode())
        ids = set(tree.xpath("//@id"))
        for link in tree.xpath("//@href | //@src"):
            assert "://" not in link, f"{name}: {link}"
            path, _, anchor = link.partition("#")
            target = unquote(urljoin(name, path)) if path else name
            assert target in {*SITE, *(one.archive for one in (OLD, NEW, NEWER_RULES))}, f"{name}: {link}"
            assert not anchor or target != name or anchor in ids, f"{name}: {link}"
    assert not [name for name, content in SITE.items() if re.search(rb"@import|url\((?!#)", content)]


def test_the_same_certificates_give_the_same_bytes() -> None:
    assert files(NEWER_RULES, NEW, OLD, fallen=(FALLEN,)) == SITE


def test_the_matrix_has_versions_by_profile_and_the_fallen_are_listed_apart() -> None:
    index = page("index.html")
    rows = [[text(cell) for cell in row] for row in index.xpath("//*[@id='matrix']/tbody/tr")]
    assert rows == [
        ["Acme UCM 1.1 signed by acme", "? inconclusive challenged", "2031-02-28"],
        ["Acme UCM 1.0 signed by acme", "✗ not conformant self-declared, 1 fail", "2031-02-03"],
        ["Borealis 7 signed by borealis", "↻ other rules self-declared", "2031-02-03"],
    ]
    assert "signature: no trusted key signed it" in text(index.get_element_by_id("fallen"))
    assert not [name for name in SITE if "cd" * 32 in name and not name.startswith("badges/")]


def test_the_matrix_says_how_much_fails_and_how_much_was_not_asked() -> None:
    one = certificate(verified(report(verdicts={FAILS: "fail", OTHER: "not applicable"})))
    site = files(one)
    assert "self-declared, 1 fail, 1 not applicable" in text(page("index.html", site))
    assert "self-declared, 1 fail, 1 not applicable, 2031-02-03" in text(product_page(site))


def test_a_product_shows_what_changed_between_its_certificates() -> None:
    (changes,) = product_page().find_class("changes")
    assert [" ".join(text(line).split()) for line in changes] == [
        f"{OTHER} {title(OTHER)} ✓ pass → ? inconclusive",
        f"{FAILS} {title(FAILS)} ✗ fail → ✓ pass",
    ]
    assert "1 fixed" in text(product_page().find_class("history")[0])
    assert "version: 1.0 → 1.1; assurance: self-declared → challenged" in text(product_page())


def title(requirement: str) -> str:
    return next(r.title for r in load_requirements() if r.id == requirement)


def test_a_requirement_shows_who_fails_it_and_how() -> None:
    tree = page(f"requirements/{FAILS}.html")
    (case,) = tree.find_class("cases")[0]
    assert "Acme UCM 1.0, container" in text(case)
    assert "Started first, stopped first." in text(case)
    assert "Nobody" in text(page(f"requirements/{decided_in('container')[0].id}.html"))


def test_a_certificate_says_its_scope_and_what_it_does_not_cover() -> None:
    one = certificate(
        verified(
            report(verdicts={FAILS: "not applicable"}),
            uncovered=Uncovered(("R-11-01",), (FAILS,), (WAIVER,), ("late-add",)),
            word=("The isolation is what the signer says.",),
            subjects=(Subject("libacme.so", "12" * 32),),
        )
    )
    shown = text(page(one.page, files(one)))
    asked = len(decided_in("container")) - 1
    for expected in (
        f"Asked {asked} requirements", "Not applicable 1", "Not testable 1", "UCM 1.2 (formal/22-02-02)",
        "self-declared: the vendor ran the tests and chose the seed", "Signed by acme, 2031-02-03", "Isolation in a sandbox (bubblewrap)",
        f"{WAIVER.requirement} until 2031-12-31: Mended in 1.3.", "The isolation is what the signer says.",
        f"libacme.so {'12' * 32}", "late-add observed: refuse", f"SHA-256 {one.digest}",
    ):  # fmt: skip
        assert expected in shown


def test_only_an_ordinary_certificate_has_an_ordinary_badge() -> None:
    shown = {one.digest: json.loads(SITE[f"badges/{one.digest}.json"]) for one in (OLD, NEW, NEWER_RULES, FALLEN)}
    assert [(b["label"], b["message"]) for b in shown.values()] == [
        ("UCM container", "not conformant, self-declared"),
        ("UCM container", "inconclusive, challenged"),
        ("UCM container", "conformant by the rules of suite 0.2.0, not certified"),
        ("UCM", "certificate does not stand"),
    ]
    assert [b.get("isError", False) for b in shown.values()] == [False, False, True, True]
    assert len({shown[one.digest]["color"] for one in (NEWER_RULES, FALLEN)} - {shown[OLD.digest]["color"]}) == 1
    for digest, badge in shown.items():
        picture = etree.fromstring(SITE[f"badges/{digest}.svg"])
        assert badge["message"] in picture.get("aria-label", "")
        assert ("stroke-dasharray" in SITE[f"badges/{digest}.svg"].decode()) is badge.get("isError", False)


def test_the_badge_of_a_product_is_of_its_newest_certificate_by_its_own_rules() -> None:
    judged_again = certificate(verified(report(version="1.2"), judged_by="0.2.0", issued="2031-05-01T00:00:00+00:00"))
    site = files(OLD, NEW, judged_again)
    name = f"badges/{file_name('Acme UCM', 'acme')}-container.svg"
    assert site[name] == SITE[name] == SITE[f"badges/{NEW.digest}.svg"]
    assert not [name for name in SITE if "borealis" in name and name.endswith(".svg")]


def test_certificates_of_one_name_by_different_keys_are_never_mixed() -> None:
    forged = certificate(verified(report(version="1.0"), signers=("mallory",), issued="2031-09-01T00:00:00+00:00"))
    site = files(OLD, forged)
    rows = [text(row) for row in page("index.html", site).xpath("//*[@id='matrix']/tbody/tr")]
    assert [("signed by acme" in row, "not conformant" in row) for row in rows] == [(True, True), (False, False)]
    assert "Other keys signed certificates of the same name: mallory" in text(product_page(site))


def test_results_in_earl_are_those_of_the_certificate() -> None:
    one = certificate(
        verified(report(verdicts={FAILS: "fail", OTHER: "inconclusive"}), uncovered=Uncovered(("R-11-01",), (), (), ()))
    )
    graph = rdflib.Graph().parse(
        data=files(one)[f"certificates/{one.digest}.jsonld"],
        format="json-ld",
        publicID="https://example.org/certificates/x.jsonld",
    )
    outcomes = {}
    for assertion in graph.subjects(rdflib.RDF.type, EARL.Assertion):
        assert len(list(graph.objects(assertion, EARL.assertedBy))) == 1
        (subject,) = graph.objects(assertion, EARL.subject)
        assert str(graph.value(subject, rdflib.DCTERMS.title)) == "Acme UCM"
        test = graph.value(assertion, EARL.test)
        assert (test, rdflib.RDF.type, EARL.TestRequirement) in graph
        outcome = graph.value(graph.value(assertion, EARL.result), EARL.outcome)
        outcomes[str(test).rpartition("/")[2].removesuffix(".html")] = str(outcome).removeprefix(EARL)
    failed = {FAILS: "failed", OTHER: "cantTell", "R-11-01": "untested"}
    assert outcomes == {r.id: "passed" for r in decided_in("container")} | failed


def test_the_feed_is_atom_with_ids_that_never_change() -> None:
    atom = "{http://www.w3.org/2005/Atom}"

    def entries(site: dict[str, bytes]) -> dict[str, str]:
        feed = etree.fromstring(site["feed.atom"])
        assert [feed.findtext(f"{atom}{name}") for name in ("title", "updated")] == ["UCM certificates", NEW.issued]
        return {e.findtext(f"{atom}id"): e.findtext(f"{atom}title") for e in feed.findall(f"{atom}entry")}

    alone, all_of_them = entries(files(NEW)), entries(SITE)
    assert list(alone.values()) == ["Acme UCM 1.1: inconclusive, profile container"]
    assert alone.items() <= all_of_them.items()
    assert len(all_of_them) == 3
    assert b'href="https://example.org/certificates/' in files(NEW, url="https://example.org/")["feed.atom"]


def test_the_index_fits_its_schema() -> None:
    index, schema = json.loads(SITE["index.json"]), json.loads(SITE["index.schema.json"])
    jsonschema.Draft202012Validator(schema).validate(index)
    assert schema["$id"] == "urn:ucm-cts:schema:certificates:2"
    assert (index["$schema"], index["schema_version"]) == ("index.schema.json", 2)
    assert [(c["product"], c["version"], c["verdict"]) for c in index["certificates"]] == [
        (c.product, c.version, c.verdict) for c in sorted((OLD, NEW, NEWER_RULES), key=lambda one: one.age)
    ]
    assert [f["problems"] for f in index["fallen"]] == [[{"check": "signature", "detail": "no trusted key signed it"}]]
    for one in index["certificates"]:
        assert {one["page"], one["earl"], one["badge"]} <= SITE.keys()
    assert [c["download"] for c in index["certificates"]] == [
        f"certificates/{c['digest']}.ucmcert" for c in index["certificates"]
    ]


HOSTILE_TEXTS = (
    HOSTILE,
    "../../etc/passwd",
    "a" * 10_000,
    "\u202egpj.exe",
    "]]><x/>",
    "javascript:alert(1)",
    "שלום",
    "",
    "{{7*7}}\n# x",
)


@pytest.mark.parametrize("bad", HOSTILE_TEXTS, ids=range(len(HOSTILE_TEXTS)))
def test_hostile_texts_stay_texts(bad: str) -> None:
    bad = bad.replace("\ud800", "\ufffe")  # no JSON can hold a lone surrogate
    one = certificate(
        verified(
            report(bad, bad, verdicts={FAILS: "fail"}, observed=bad),
            signers=(bad or "x",), specification=bad, isolation=bad, word=(bad,), subjects=(Subject(bad, "12" * 32),),
            uncovered=Uncovered((), (), (msgspec.structs.replace(WAIVER, requirement=FAILS, reason=bad),), (bad,)),
        )
    )  # fmt: skip
    again = certificate(
        verified(report(bad, bad), signers=(bad or "x",), issued="2031-09-01T00:00:00+00:00", judged_by=bad)
    )
    fallen = Fallen(bad or "x", "cd" * 32, (Problem(bad, bad),), bad)
    site = files(one, again, fallen=(fallen,))
    for name, content in site.items():
        assert re.fullmatch(r"([a-z]+/)?[A-Za-z0-9.-]{1,90}", name), name
        shown = content.decode()
        assert not re.search("[\u202a-\u202e\x00-\x08\x1b]", shown), name
        if name.endswith(".html"):
            tree = html.document_fromstring(shown)
            assert {script.get("src") for script in tree.iter("script")} <= {"site.js"}
            assert not tree.xpath("//img[starts-with(@src, 'x')] | //@onerror | //*[starts-with(@href, 'javascript')]")
            assert "49" not in tree.findtext(".//title")
        elif name.endswith((".svg", ".atom")):
            assert not [e for e in etree.fromstring(content).iter() if "script" in str(e.tag) or "img" in str(e.tag)]
        elif name.endswith((".json", ".jsonld")):
            json.loads(shown)
        assert len(shown) < 400_000, name


def test_names_that_look_alike_have_files_of_their_own() -> None:
    names = ["Acme UCM", "acme ucm", "Acme-UCM", "Acme\u200bUCM", "ACME UCM!", ".", "..", "con"]
    assert len({file_name(name) for name in names}) == len(names)


def test_the_site_is_written_and_replaced_without_touching_what_is_foreign(tmp_path: Path) -> None:
    with OutFolder(tmp_path / "site", FILES) as folder:
        folder.save(SITE, FILES)
    (tmp_path / "site" / "CNAME").write_text("ucm.example.org")
    (tmp_path / "site" / "products" / "mine.txt").write_text("mine")
    fewer = files(NEW)
    with OutFolder(tmp_path / "site", FILES) as folder:
        folder.save(fewer, FILES)
    there = {str(p.relative_to(tmp_path / "site")) for p in (tmp_path / "site").rglob("*") if p.is_file()}
    assert there == {*fewer, "CNAME", "products/mine.txt", "ucm-cts-manifest.json"}


def test_the_readme_of_results_is_the_same_matrix() -> None:
    from files import ROOT

    lines = overview(read_published(ROOT / "results"))
    assert lines[2].startswith("| product | container | core |")
    assert any("✗ not conformant: 13 fail" in line for line in lines)
