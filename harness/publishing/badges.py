"""Badges: an SVG, and the JSON of an endpoint for shields.io. Only an ordinary certificate that stands has an ordinary badge."""

from __future__ import annotations

from dataclasses import dataclass
from xml.sax.saxutils import escape, quoteattr

import msgspec

from ucm_cts.harness.publishing.certificate import Certificate, Fallen
from ucm_cts.harness.results.foreign import one_line
from ucm_cts.harness.results.values import Overall

_COLOURS: dict[Overall, str] = {"conformant": "#0c6b46", "not conformant": "#b3201c", "inconclusive": "#855300"}
_GREY, _LABEL = "#5a6474", "#39424f"

_WIDTH = 6.6
"""Pixels that a character of 11 pixels takes on average; ``textLength`` makes it exact."""


@dataclass(frozen=True)
class Badge:
    """``label`` and ``message`` are what it shows, ``title`` what it is of. ``is_ordinary``: it may be read as a certificate's verdict."""

    label: str
    message: str
    colour: str
    title: str
    is_ordinary: bool

    @property
    def svg(self) -> bytes:
        """The picture. One that is not ordinary has a dashed frame, and says so to those who do not see it."""
        left, right = (round(len(text) * _WIDTH) + 14 for text in (self.label, self.message))
        width = left + right
        alt = f"{self.title}: {self.label}: {self.message}"
        frame = "" if self.is_ordinary else ' stroke="#fff" stroke-width="1.5" stroke-dasharray="4 3"'
        texts = "".join(
            f'<text x="{x + 7}" y="14" textLength="{wide - 14}" lengthAdjust="spacingAndGlyphs">{escape(text)}</text>'
            for text, x, wide in ((self.label, 0, left), (self.message, left, right))
        )
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="20" viewBox="0 0 {width} 20" role="img"'
            f" aria-label={quoteattr(alt)}><title>{escape(alt)}</title>"
            f'<clipPath id="c"><rect width="{width}" height="20" rx="4"/></clipPath><g clip-path="url(#c)">'
            f'<rect width="{left}" height="20" fill="{_LABEL}"/>'
            f'<rect x="{left}" width="{right}" height="20" fill="{self.colour}"/></g>'
            f'<rect x="1" y="1" width="{width - 2}" height="18" rx="3" fill="none"{frame}/>'
            f'<g fill="#fff" font-family="Verdana,DejaVu Sans,sans-serif" font-size="11">{texts}</g></svg>\n'
        ).encode()

    @property
    def json(self) -> bytes:
        """What shields.io reads from an endpoint."""
        answer: dict[str, object] = {"schemaVersion": 1, "label": self.label, "message": self.message}
        answer["color"] = self.colour.removeprefix("#")
        if not self.is_ordinary:
            answer["isError"] = True
        return msgspec.json.format(msgspec.json.encode(answer), indent=1) + b"\n"


def badge_of(one: Certificate | Fallen) -> Badge:
    """The badge of a certificate, or of what is none that stands."""
    if isinstance(one, Fallen):
        return Badge("UCM", "certificate does not stand", _GREY, one_line(one.file, 60), False)
    label = f"UCM {one.profile}"
    if one.is_delta:
        message = f"{one.verdict} by the rules of suite {one_line(one.judged_by, 20)}, not certified"
        return Badge(label, message, _GREY, one.name, False)
    return Badge(label, f"{one.verdict}, {one.assurance}", _COLOURS[one.verdict], one.name, True)
