"""Writes a statement as the commented TOML file that a vendor edits."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

import jinja2
import msgspec

import ucm_cts
from ucm_cts.harness.catalogue.documents import without_waiting
from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES, PARTS, TOOLCHAIN_PROFILES
from ucm_cts.harness.catalogue.requirements import Interpretation, capabilities_for, declarable, load_capabilities
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.statement import HOOKS, IXIT, Statement, default_statement
from ucm_cts.harness.statement.applicability import ALWAYS_NEEDED
from ucm_cts.harness.statement.claims import Offers, claimed, lacking, to_decide
from ucm_cts.harness.statement.files import Identity, stated_by

WIDTH = 120

MOST_NAMED = 4
"""How many requirements are named that wait for a decision."""


@dataclass(frozen=True)
class Wanted:
    """How a statement is written.

    ``out``: the file.
    ``force``: write over a file that is there.
    ``full``: with all values and their meanings; otherwise with what differs from the defaults and what must be decided.
    ``profile``: the profile to claim; empty to claim what the product can have.
    """

    out: Path
    force: bool = False
    full: bool = False
    profile: str = ""


def write_statement(wanted: Wanted, identity: Identity, adapter: str, offers: Offers) -> None:
    """Write the statement for the vendor of ``identity``, whose adapter has these ``offers``, to edit. Raises ``WrongUse``."""
    known = stated_by(None, adapter)
    statement = claimed(known, offers, wanted.profile)
    models = tuple(str(path.resolve()) for path in known.model_paths)
    statement = msgspec.structs.replace(statement, models=models)
    _write(wanted, statement, identity, adapter, lacking(offers), {})


def write_toolchain_statement(
    wanted: Wanted,
    identity: Identity,
    profiles: tuple[str, ...],
    description: Path,
    asked: Mapping[str, frozenset[str]],
) -> None:
    """The same for the vendor of the tool chain that the file ``description`` describes, which claims ``profiles``.

    ``asked`` are options, and the requirements that are only asked of those who declare them. Raises ``WrongUse``.
    """
    statement = msgspec.structs.replace(default_statement(), profiles=(wanted.profile,) if wanted.profile else profiles)
    _write(wanted, statement, identity, f"--toolchain {description}", {}, asked)


def _write(
    wanted: Wanted,
    known: Statement,
    identity: Identity,
    subject: str,
    missing: Mapping[str, str],
    asked: Mapping[str, frozenset[str]],
) -> None:
    product, version = one_line(identity.product), one_line(identity.version)
    statement = msgspec.structs.replace(known, product=product, version=version)
    out = wanted.out
    subject, file_name = one_line(subject), one_line(str(out))
    if wanted.full:
        text = to_toml(statement, subject, file_name)
    else:
        text = to_short_toml(statement, subject, file_name, missing, asked)
    try:
        with open(out, "w" if wanted.force else "x", encoding="utf-8", opener=without_waiting) as file:
            file.write(text)
    except FileExistsError:
        raise WrongUse(
            f"'{out}' is there already; choose another file with --out, or --force to write over it"
        ) from None
    except (OSError, ValueError) as error:
        problem = getattr(error, "strerror", None) or error
        raise WrongUse(f"'{out}' cannot be written: {problem}; choose another file with --out") from None


def to_toml(statement: Statement, adapter: str, file: str) -> str:
    """The whole file: each value with its meaning, its permitted values, and the unclear place of the specification.

    ``adapter`` and ``file`` are for the command that it shows.
    """
    families = [f for f in (FRAMEWORK_PROFILES, TOOLCHAIN_PROFILES) if set(f).intersection(statement.profiles)]
    profiles = [profile for family in families for profile in family]
    asked = {*FRAMEWORK_PROFILES, *statement.profiles}.intersection(profiles)
    parts = {part for profile in asked for part in PARTS[profile]}
    return _template("ics.toml.jinja").render(
        statement=statement,
        adapter=adapter,
        file=file,
        suite=f"UCM-CTS {ucm_cts.__version__}",
        profiles=profiles,
        of_framework=FRAMEWORK_PROFILES in families,
        capabilities=[c for c in capabilities_for(parts) if c.profile == "core"],
        extensions=[c for c in capabilities_for(parts) if c.profile == "extensions"],
        entries=[entry for entry in declarable() if entry.options and entry.profile in parts],
        ixit=IXIT,
    )


def to_short_toml(
    statement: Statement,
    adapter: str,
    file: str,
    missing: Mapping[str, str] | None = None,
    asked: Mapping[str, frozenset[str]] | None = None,
) -> str:
    """What differs from the defaults, and what the vendor must decide, for the profiles that ``statement`` claims.

    ``missing`` says how the adapter shows that it does not offer something; ``asked`` is for ``to_decide``.
    """
    missing = missing or {}
    default = default_statement()
    parts = {part for profile in statement.profiles for part in PARTS[profile]}
    family = TOOLCHAIN_PROFILES if {*statement.profiles} <= {*TOOLCHAIN_PROFILES} else FRAMEWORK_PROFILES
    waiting = to_decide(statement, asked or {})
    options = {o: (entry, values) for entry in declarable() for o, values in entry.options.items()}
    of_profiles = {o: known for o, known in options.items() if known[0].profile in parts or o == ALWAYS_NEEDED}
    different = {o: v for o, (_, v) in of_profiles.items() if statement.readings[o] != default.readings[o]}
    offered = [o for o in different if o in HOOKS and statement.readings[o] == "hook"]
    undecided: dict[str, tuple[Interpretation, list[tuple[str, tuple[str, ...], str]]]] = {}
    for option, (entry, values) in of_profiles.items():
        if option in waiting:
            undecided.setdefault(entry.id, (entry, []))[1].append((option, values, _ids(waiting[option])))
    return _template("ics-short.toml.jinja").render(
        statement=statement,
        adapter=adapter,
        file=file,
        suite=f"UCM-CTS {ucm_cts.__version__}",
        profiles=family,
        remarks=_remarks(statement, missing, family),
        capabilities=[c for c in capabilities_for(parts) if c.profile == "core" and not statement.capabilities[c.id]],
        extensions=[c for c in capabilities_for(parts) if c.id in statement.extensions],
        lacking=missing,
        offered=offered,
        different={o: v for o, v in different.items() if o not in offered},
        undecided=list(undecided.values()),
        ixit={n: q for n, q in IXIT.items() if statement.ixit[n] != q.default},
        of_models=statement.models or "core-models" in waiting,
    )


def _remarks(statement: Statement, missing: Mapping[str, str], family: Collection[str]) -> list[str]:
    """What the adapter does not offer, and what that means for the claims."""
    names = {capability.id for capability in load_capabilities().capabilities if capability.profile == "core"}
    parts = _by_reason({name: why for name, why in missing.items() if name in names})
    hooks = _by_reason({name: why for name, why in missing.items() if name in HOOKS})
    remarks = []
    if parts and "core" in family and "core" not in statement.profiles:
        remarks.append(f"core is not claimed, because the adapter does not show that it offers {parts}.")
    if hooks and "core" in statement.profiles:
        remarks.append(f"The adapter does not offer these operations for tests: {hooks}.")
    return remarks


def _by_reason(missing: Mapping[str, str]) -> str:
    names: dict[str, list[str]] = {}
    for name, why in missing.items():
        names.setdefault(why, []).append(name)
    return "; ".join(f"{', '.join(some)} ({why})" for why, some in names.items())


def _ids(requirements: Collection[str]) -> str:
    shown = sorted(requirements)[:MOST_NAMED]
    more = len(requirements) - len(shown)
    return f"{', '.join(shown)} and {more} more requirements" if more else ", ".join(shown)


def _template(name: str) -> jinja2.Template:
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(Path(__file__).parent / "templates"),
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        autoescape=False,
    )
    environment.filters["toml"] = _toml
    environment.filters["comment"] = _comment
    environment.filters["lines"] = _lines
    return environment.get_template(name)


def _toml(value: str | bool | float) -> str:
    """One value; JSON writes it as TOML does, but for DEL, and characters beyond the BMP if they are escaped."""
    if isinstance(value, float):
        return f"{value:g}" if value.is_integer() else repr(value)
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def _comment(entry: Interpretation) -> str:
    """The unclear place, the decision, and the consequence of each value, on lines of their own."""
    return "\n".join(map(_lines, [f"{entry.id} ({', '.join(entry.clauses)})", *entry.lines]))


def _lines(text: str) -> str:
    return "\n".join(textwrap.wrap(text, WIDTH, initial_indent="# ", subsequent_indent="#   "))
