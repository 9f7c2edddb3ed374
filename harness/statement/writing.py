"""Writes a statement as the commented TOML file that a vendor edits."""

from __future__ import annotations

import json
import textwrap
from pathlib import Path

import jinja2
import msgspec

import ucm_cts
from ucm_cts.harness.catalogue.documents import without_waiting
from ucm_cts.harness.catalogue.profiles import FRAMEWORK_PROFILES, PARTS, TOOLCHAIN_PROFILES
from ucm_cts.harness.catalogue.requirements import Interpretation, load_capabilities, load_interpretations
from ucm_cts.harness.hosting.locate import WrongUse
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.statement import IXIT, Statement, default_statement
from ucm_cts.harness.statement.files import Identity, stated_by

WIDTH = 120


def write_statement(out: Path, identity: Identity, adapter: str, force: bool = False) -> None:
    """Write the default statement for the vendor of ``identity`` to edit. Raises ``WrongUse``."""
    known = stated_by(None, adapter)
    models = tuple(str(path.resolve()) for path in known.model_paths)
    profiles = known.profiles if known.source else FRAMEWORK_PROFILES
    _write(out, msgspec.structs.replace(known, models=models, profiles=profiles), identity, adapter, force)


def write_toolchain_statement(
    out: Path, identity: Identity, profiles: tuple[str, ...], description: Path, force: bool = False
) -> None:
    """The same for the vendor of the tool chain that the file ``description`` describes, which claims ``profiles``. Raises ``WrongUse``."""
    statement = msgspec.structs.replace(default_statement(), profiles=profiles)
    _write(out, statement, identity, f"--toolchain {description}", force)


def _write(out: Path, known: Statement, identity: Identity, subject: str, force: bool) -> None:
    product, version = one_line(identity.product), one_line(identity.version)
    statement = msgspec.structs.replace(known, product=product, version=version)
    text = to_toml(statement, one_line(subject), one_line(str(out)))
    try:
        with open(out, "w" if force else "x", encoding="utf-8", opener=without_waiting) as file:
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
    families = [f for f in (FRAMEWORK_PROFILES, TOOLCHAIN_PROFILES) if set(f).intersection(statement.profiles)]
    profiles = [profile for family in families for profile in family]
    asked = {*FRAMEWORK_PROFILES, *statement.profiles}.intersection(profiles)
    parts = {part for profile in asked for part in PARTS[profile]}
    return environment.get_template("ics.toml.jinja").render(
        statement=statement,
        adapter=adapter,
        file=file,
        suite=f"UCM-CTS {ucm_cts.__version__}",
        profiles=profiles,
        of_framework=FRAMEWORK_PROFILES in families,
        capabilities=load_capabilities().capabilities,
        entries=[entry for entry in load_interpretations() if entry.options and entry.profile in parts],
        ixit=IXIT,
    )


def _toml(value: str | bool | float) -> str:
    """One value; JSON writes it as TOML does, but for DEL, and characters beyond the BMP if they are escaped."""
    if isinstance(value, float):
        return f"{value:g}" if value.is_integer() else repr(value)
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def _comment(entry: Interpretation) -> str:
    """The unclear place, the decision, and the consequence of each value, on lines of their own."""
    lines = [f"{entry.id} ({', '.join(entry.clauses)})", *entry.lines]
    return "\n".join(
        line for each in lines for line in textwrap.wrap(each, WIDTH, initial_indent="# ", subsequent_indent="#   ")
    )
