"""Makes pages of the templates beside this module; each page is one self-contained file."""

from __future__ import annotations

from pathlib import Path

import jinja2
from markupsafe import Markup

from ucm_cts.harness.report.order import ISOLATIONS, SEALS, SYMBOLS
from ucm_cts.harness.results.foreign import one_line

_TEMPLATES = Path(__file__).parent / "templates"


def rendered(template: str, **values: object) -> str:
    """The page that ``template`` makes of ``values`` and of the style and symbols that all pages share."""
    environment = jinja2.Environment(
        loader=jinja2.FileSystemLoader(_TEMPLATES),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["one_line"] = one_line
    return environment.get_template(template).render(
        style=part("report.css"), symbols=SYMBOLS, seals=SEALS, isolations=ISOLATIONS, **values
    )


def part(name: str) -> Markup:
    """A file that pages contain as it is."""
    return Markup((_TEMPLATES / name).read_text(encoding="utf-8"))
