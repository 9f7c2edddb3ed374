"""The site as values: products, their versions and histories, and requirements, made of the certificates that stand."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass

from ucm_cts.harness.catalogue.requirements import Requirement
from ucm_cts.harness.publishing.certificate import LONGEST_NAME, Certificate, Fallen, file_name
from ucm_cts.harness.report.matrix import Matrix, matrix
from ucm_cts.harness.report.order import Shown, clause_key, count, shown
from ucm_cts.harness.report.published import PublishedFailure, PublishedVerdict
from ucm_cts.harness.results.foreign import one_line


@dataclass(frozen=True)
class Change:
    """A requirement whose verdict differs from that of the certificate before; None: it was not asked."""

    id: str
    title: str
    before: Shown | None
    after: Shown | None

    @property
    def kind(self) -> str:
        """``fixed``, ``broken`` or ``other``."""
        bad = ("fail", "error")
        if self.before in bad and self.after == "pass":
            return "fixed"
        return "broken" if self.after in bad and self.before not in (*bad, None) else "other"


@dataclass(frozen=True)
class Entry:
    """A certificate in the history of its product: the one of the same profile ``before`` it, and what changed since."""

    certificate: Certificate
    before: Certificate | None
    changes: tuple[Change, ...]
    remarks: tuple[str, ...]


@dataclass(frozen=True)
class Product:
    """All certificates of one product that the same keys signed. ``history`` begins with the newest one."""

    product: str
    signers: tuple[str, ...]
    history: tuple[Entry, ...]
    versions: Matrix[Certificate]
    namesakes: tuple[Product, ...] = ()

    @property
    def name(self) -> str:
        """Its name on one line."""
        return one_line(self.product, LONGEST_NAME)

    @property
    def file(self) -> str:
        """What its files are called."""
        return file_name(self.product, *self.signers)

    @property
    def page(self) -> str:
        """The name of its page."""
        return f"products/{self.file}.html"

    @property
    def newest(self) -> list[Certificate]:
        """Of each profile the newest certificate that was judged by the rules of its own run."""
        found: dict[str, Certificate] = {}
        for entry in self.history:
            if not entry.certificate.is_delta:
                found.setdefault(entry.certificate.profile, entry.certificate)
        return [found[profile] for profile in self.versions.profiles if profile in found]


@dataclass(frozen=True)
class Broken:
    """A certificate that shows a requirement broken or undecided, and how."""

    certificate: Certificate
    verdict: Shown
    reason: str
    failures: tuple[PublishedFailure, ...]


@dataclass(frozen=True)
class Asked:
    """A requirement, and what the newest certificates of each version and profile say of it.

    ``requirement`` is None if the catalogue of this suite does not have it.
    """

    id: str
    clause: str
    title: str
    requirement: Requirement | None
    counts: dict[Shown, int]
    broken: tuple[Broken, ...]

    @property
    def page(self) -> str:
        """The name of its page."""
        return f"requirements/{self.id}.html"


@dataclass(frozen=True)
class Site:
    """Everything that is published. ``certificates`` begin with the oldest, ``products`` are in the order of their names."""

    certificates: tuple[Certificate, ...]
    fallen: tuple[Fallen, ...]
    products: tuple[Product, ...]
    versions: Matrix[Certificate]
    requirements: tuple[Asked, ...]

    @property
    def updated(self) -> str:
        """When the newest certificate was issued."""
        return max((one.issued for one in self.certificates), default="1970-01-01T00:00:00Z")

    def product_of(self, certificate: Certificate) -> Product:
        """The product that ``certificate`` is of."""
        return next(one for one in self.products if (one.product, one.signers) == certificate.owner)


def site_of(certificates: Sequence[Certificate], fallen: Sequence[Fallen], catalogue: Iterable[Requirement]) -> Site:
    """The site of ``certificates``, which begin with the oldest."""
    owned: dict[tuple[str, tuple[str, ...]], list[Certificate]] = {}
    for one in certificates:
        owned.setdefault(one.owner, []).append(one)
    order = sorted(owned, key=lambda owner: (owner[0].casefold(), owner))
    products = [
        Product(owner[0], owner[1], tuple(reversed(_history(owned[owner]))), _versions(owned[owner])) for owner in order
    ]
    rows = [row for product in products for row in product.versions.rows]
    # the same order of columns and rows as on the pages of products
    whole = matrix([cell for row in rows for cell in row.held], lambda one: (one.owner, one.version))
    named: dict[str, list[Product]] = {}
    for product in products:
        named.setdefault(product.product, []).append(product)
    return Site(
        tuple(certificates),
        tuple(fallen),
        tuple(_among(product, named[product.product]) for product in products),
        whole,
        tuple(_asked(certificates, {cell.digest for row in whole.rows for cell in row.held}, catalogue)),
    )


def _among(product: Product, same: Sequence[Product]) -> Product:
    others = tuple(other for other in same if other.signers != product.signers)
    return Product(product.product, product.signers, product.history, product.versions, others)


def _versions(certificates: Sequence[Certificate]) -> Matrix[Certificate]:
    """The versions of one product, the one that was certified last first. A certificate that other rules were applied to never
    takes the place of an ordinary one.
    """
    ordered = sorted(certificates, key=lambda one: (not one.is_delta, one.age))
    whole = matrix(ordered)
    rows = sorted(whole.rows, key=lambda row: max(cell.age for cell in row.held), reverse=True)
    return Matrix(whole.profiles, tuple(rows))


def _history(certificates: Sequence[Certificate]) -> list[Entry]:
    last: dict[str, Certificate] = {}
    entries = []
    for one in certificates:
        before = last.get(one.profile)
        entries.append(Entry(one, before, *(_difference(before, one) if before else ((), ()))))
        last[one.profile] = one
    return entries


def _difference(before: Certificate, after: Certificate) -> tuple[tuple[Change, ...], tuple[str, ...]]:
    old, new = ({entry.id: entry for entry in one.result.requirements} for one in (before, after))
    changes = []
    for id_ in sorted(old.keys() | new.keys(), key=_place):
        was, now = (shown(entries[id_]) if id_ in entries else None for entries in (old, new))
        if was != now:
            title = next((e[id_].title for e in (new, old) if id_ in e and e[id_].title), "")
            changes.append(Change(id_, title, was, now))
    facts = (
        ("version", before.version, after.version),
        ("suite", before.suite_version, after.suite_version),
        ("specification", before.specification, after.specification),
        ("assurance", before.assurance, after.assurance),
    )
    return tuple(changes), tuple(f"{what}: {_short(was)} → {_short(now)}" for what, was, now in facts if was != now)


def _short(text: str) -> str:
    return one_line(text, 40) or "none"


def _place(id_: str) -> tuple[tuple[int, ...], str]:
    return clause_key(id_.removeprefix("R-").rpartition("-")[0]), id_


def _asked(
    certificates: Sequence[Certificate], newest: Collection[str], catalogue: Iterable[Requirement]
) -> list[Asked]:
    """All requirements that any of ``certificates`` asks, with what those say whose digests are in ``newest``."""
    known = {entry.id: entry for entry in catalogue}
    entries: dict[str, list[tuple[Certificate, PublishedVerdict]]] = {}
    titles: dict[str, str] = {}
    for one in certificates:
        for entry in one.result.requirements:
            said = entries.setdefault(entry.id, [])
            titles[entry.id] = entry.title or titles.get(entry.id, "")
            if one.digest in newest:
                said.append((one, entry))
    failures = {one.digest: _by_requirement(one.result.failures) for one in certificates}
    found = []
    for id_ in sorted(entries, key=_place):
        requirement = known.get(id_)
        broken = [
            Broken(one, shown(entry), entry.reason, failures[one.digest].get(id_, ()))
            for one, entry in entries[id_]
            if entry.verdict not in ("pass", "not applicable")
        ]
        verdicts = count(entry for _, entry in entries[id_])
        title = requirement.title if requirement else titles[id_]
        clause = id_.removeprefix("R-").rpartition("-")[0]
        found.append(Asked(id_, clause, title, requirement, verdicts, tuple(broken)))
    return found


def _by_requirement(failures: Iterable[PublishedFailure]) -> dict[str, tuple[PublishedFailure, ...]]:
    found: dict[str, list[PublishedFailure]] = {}
    for failure in failures:
        found.setdefault(failure.requirement, []).append(failure)
    return {id_: tuple(group) for id_, group in found.items()}
