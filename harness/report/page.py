"""Makes pages of templates; each page of a report is one self-contained file."""

from __future__ import annotations

from pathlib import Path

import jinja2
from markupsafe import Markup

from ucm_cts.harness.report.order import ISOLATIONS, SEALS, SYMBOLS
from ucm_cts.harness.results.foreign import one_line

_TEMPLATES = Path(__file__).parent / "templates"


class Pages:
    """Templates in one folder, with the symbols that all pages share, and ``values`` for each of them."""

    def __init__(self, templates: Path, **values: object) -> None:
        self._environment = jinja2.Environment(
            loader=jinja2.FileSystemLoader(templates),
            autoescape=True,
            undefined=jinja2.StrictUndefined,
            trim_blocks=True,
            lstrip_blocks=True,
        )
        self._environment.filters["one_line"] = one_line
        self._environment.globals.update(values, symbols=SYMBOLS, seals=SEALS, isolations=ISOLATIONS)

    def rendered(self, template: str, **values: object) -> str:
        """The page that ``template`` makes of ``values``."""
        return self._environment.get_template(template).render(**values)


def rendered(template: str, **values: object) -> str:
    """The page that ``template``, beside this module, makes of ``values`` and of the style that all reports share."""
    return Pages(_TEMPLATES).rendered(template, style=part("report.css"), **values)


def part(name: str) -> Markup:
    """A file that pages contain as it is."""
    return Markup((_TEMPLATES / name).read_text(encoding="utf-8"))
