"""``feed.atom``: the newest certificates. An entry has the same id for ever: it follows from the archive."""

from __future__ import annotations

import uuid
from xml.sax.saxutils import escape, quoteattr

from ucm_cts.harness.publishing.certificate import Certificate
from ucm_cts.harness.publishing.site import Site
from ucm_cts.harness.report.matrix import tally
from ucm_cts.harness.report.order import count
from ucm_cts.harness.results.foreign import one_line

NEWEST = 100
"""The entries of the feed."""

_NAMES = uuid.UUID("6a2f3c1e-8f0b-5d57-9a53-0f6f6e0b8d11")
"""The name space of the ids: chosen once, never to be changed."""


def atom(site: Site, url: str) -> bytes:
    """The feed. ``url`` is where the site will be, empty if that is not known; links are relative then."""
    newest = sorted(site.certificates, key=lambda one: one.age, reverse=True)[:NEWEST]
    lines = [
        '<?xml version="1.0" encoding="utf-8"?>',
        '<feed xmlns="http://www.w3.org/2005/Atom" xml:lang="en">',
        "<title>UCM certificates</title>",
        f"<id>{uuid.uuid5(_NAMES, 'feed ' + url).urn}</id>",
        f"<updated>{site.updated}</updated>",
        "<author><name>UCM-CTS</name></author>",
        f'<link rel="alternate" type="text/html" href={quoteattr(url + "index.html")}/>',
        *([f'<link rel="self" type="application/atom+xml" href={quoteattr(url + "feed.atom")}/>'] if url else []),
        *(_entry(one, url) for one in newest),
        "</feed>",
    ]
    return ("\n".join(lines) + "\n").encode()


def _entry(one: Certificate, url: str) -> str:
    counts = tally(count(one.result.requirements))
    how = (
        f"Judged again by the rules of suite {one_line(one.judged_by, 40)}; no certificate of it. "
        if one.is_delta
        else ""
    )
    summary = f"{how}{counts}. Assurance: {one.assurance}. Signed by {', '.join(one_line(s, 60) for s in one.signers)}."
    return "\n".join((
        "<entry>",
        f"<title>{escape(f'{one.name}: {one.verdict}, profile {one.profile}')}</title>",
        f"<id>{uuid.uuid5(_NAMES, one.digest).urn}</id>",
        f"<updated>{one.issued}</updated>",
        f'<link rel="alternate" type="text/html" href={quoteattr(url + one.page)}/>',
        f"<summary>{escape(summary)}</summary>",
        "</entry>",
    ))  # fmt: skip
