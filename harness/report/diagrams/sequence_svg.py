"""Sequence diagrams as SVG for the report's page, which holds their style (``templates/report.css``)."""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from ucm_cts.harness.report.diagrams.sequence import Diagram, Lane, Line
from ucm_cts.harness.report.diagrams.svg_text import shortened, width_of

ROW, HEAD, TOP = 27, 26, 6
"""Heights: of a line, of a lane's head, and of the margin above it."""

BAR = 4
"""Half the width of an activity."""

LABEL = 62
"""Columns of the longest label; what is longer is cut, and whole in a tooltip."""


def to_svg(diagram: Diagram, name: str) -> Markup:
    """The diagram as an inline ``svg`` element; ``name`` is what a screen reader says."""
    gutter = 30 if not diagram.threads else 54
    x = _lane_positions(diagram.lanes, gutter)
    height = TOP + HEAD + 10 + ROW * len(diagram.lines) + 12
    right = max(x.values(), default=gutter) + 60
    width = max([right, *(_label_end(line, x) for line in diagram.lines)]) + 8
    parts = [
        Markup('<svg class="sq" viewBox="0 0 {w} {h}" width="{w}" height="{h}" role="img" aria-label="{name}">').format(
            w=width, h=height, name=name
        )
    ]
    y = {index: TOP + HEAD + 10 + ROW * index + 19 for index in range(len(diagram.lines))}
    parts += [_band(line, y[i], width) for i, line in enumerate(diagram.lines) if line.style != "normal"]
    parts += [_lifeline(x[lane.key], height) for lane in diagram.lanes]
    parts.append(Markup('<text class="n" x="27" y="{}">#</text>').format(TOP + 15))
    parts += [_head(lane, x[lane.key]) for lane in diagram.lanes]
    parts += _bars(diagram.lines, x, y)
    for index, line in enumerate(diagram.lines):
        parts.append(_gutter(line, y[index], diagram.threads))
        parts.append(_line(line, x, y[index], width))
    parts.append(Markup("</svg>"))
    return Markup("").join(parts)


def _lane_positions(lanes: Sequence[Lane], gutter: int) -> dict[str, int]:
    positions: dict[str, int] = {}
    at, before = gutter, 0.0
    for lane in lanes:
        half = (width_of(shortened(lane.label, 20)) + 18) / 2
        at = round(at + half + 6) if not positions else round(max(at + 92, at + before + half + 12))
        positions[lane.key] = at
        before = half
    return positions


def _label_start(line: Line, x: dict[str, int]) -> int:
    source = x.get(line.source, min(x.values()))
    target = x.get(line.target, source)
    return min(source, target) + (12 if line.kind == "note" or target != source else 28)


def _label_end(line: Line, x: dict[str, int]) -> int:
    start, margin = (60, 60) if line.kind in ("gap", "end") else (_label_start(line, x), 12)
    return start + width_of(shortened(line.label, LABEL)) + margin


def _band(line: Line, y: int, width: int) -> Markup:
    return Markup('<path class="band {}" d="M2 {}h{}v{}H2z"/>').format(line.style, y - 20, width - 4, ROW)


def _lifeline(x: int, height: int) -> Markup:
    return Markup('<path class="life" d="M{} {}V{}"/>').format(x, TOP + HEAD, height - 6)


def _head(lane: Lane, x: int) -> Markup:
    label = shortened(lane.label, 20)
    wide = width_of(label) + 18
    return Markup(
        '<g class="lane {kind}"><rect x="{left}" y="{top}" width="{wide}" height="{head}" rx="{round}"/>'
        '<text x="{x}" y="{base}">{label}</text>{title}</g>'
    ).format(
        kind=lane.kind,
        left=x - wide // 2,
        top=TOP,
        wide=wide,
        head=HEAD - 4,
        round=11 if lane.kind == "body" else 2,
        x=x,
        base=TOP + 15,
        label=label,
        title=_title(lane.label, label),
    )


def _bars(lines: Sequence[Line], x: dict[str, int], y: dict[int, int]) -> list[Markup]:
    """Activities, from the line that begins one to the line that ends it, or to the last line."""
    open_at: list[tuple[str, int, int]] = []
    bars: list[tuple[int, int, int]] = []
    for index, line in enumerate(lines):
        if line.begins and line.target in x:
            if line.ends:
                bars.append((x[line.target], y[index], y[index] + 5))
            else:
                open_at.append((line.target, line.thread, index))
        elif line.ends:
            mine = [entry for entry in open_at if entry[:2] == (line.source, line.thread)]
            if mine:
                open_at.remove(mine[-1])
                bars.append((x[line.source], y[mine[-1][2]], y[index]))
    if lines:
        bars += [(x[lane], y[index], y[len(lines) - 1] + 6) for lane, _, index in open_at]
    return [
        Markup('<path class="bar" d="M{} {}h{}V{}h-{}z"/>').format(at - BAR, top, 2 * BAR, bottom, 2 * BAR)
        for at, top, bottom in bars
    ]


def _gutter(line: Line, y: int, threads: bool) -> Markup:
    mark = {"offending": "✗", "expected": "✓"}.get(line.style)
    if mark:
        texts = Markup('<text class="n sign {}" x="27" y="{}">{}</text>').format(line.style, y + 3, mark)
    else:
        texts = Markup('<text class="n" x="27" y="{}">{}</text>').format(y + 3, line.events[0] if line.events else "")
    if threads and line.events:
        texts += Markup('<text class="n" x="49" y="{}">t{}</text>').format(y + 3, line.thread)
    return texts


def _line(line: Line, x: dict[str, int], y: int, width: int) -> Markup:
    label = shortened(line.label, LABEL)
    title = _title(line.label, label)
    if line.kind in ("gap", "end"):
        mark = "⋯ " if line.kind == "gap" else "⚡ "
        return Markup(
            '<g class="{kind} {style}"><path d="M34 {y}H{right}"/>'
            '<text x="46" y="{base}">{mark}{label}</text>{title}</g>'
        ).format(
            kind=line.kind, style=line.style, y=y + 4, right=width - 8, base=y - 1, mark=mark, label=label, title=title
        )
    text = Markup('<text x="{}" y="{}">{}</text>{}').format(
        _label_start(line, x), y + 3 if line.kind == "note" else y - 5, label, title
    )
    return Markup('<g class="{} {}">{}{}</g>').format(line.kind, line.style, _drawing(line, x, y), text)


def _drawing(line: Line, x: dict[str, int], y: int) -> Markup:
    source = x.get(line.source, min(x.values()))
    if line.kind == "note":
        return Markup('<circle cx="{}" cy="{}" r="4"/>').format(source, y - 1)
    if line.target not in x:
        return Markup('<path d="M{} {}h34"/><circle cx="{}" cy="{}" r="4"/>').format(source + BAR, y, source + 42, y)
    target = x[line.target]
    if target == source:
        return Markup('<path d="M{a} {b}h18v10h-14"/><path class="tip" d="M{c} {d}l7-4v8z"/>').format(
            a=source + BAR, b=y - 6, c=source + BAR, d=y + 4
        )
    way = 1 if target > source else -1
    start, end = source + way * BAR, target - way * BAR
    if line.kind == "answer":
        return Markup('<path d="M{} {}H{}"/><path class="open" d="M{} {}l{} 4l{} 4"/>').format(
            start, y, end, end - way * 7, y - 4, way * 7, -way * 7
        )
    return Markup('<path d="M{} {}H{}"/><path class="tip" d="M{} {}l{}-4v8z"/>').format(
        start, y, end - way * 7, end, y, -way * 8
    )


def _title(whole: str, shown: str) -> Markup:
    return Markup("<title>{}</title>").format(whole) if whole != shown else Markup("")
