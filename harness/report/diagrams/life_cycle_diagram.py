"""The life cycle as a state diagram, each transition with the verdict of this run.

The four states stand in a row. Transitions to the right run above, those to the left below, and what changes no
state is listed inside it. The complete list of rows stands beside the diagram, as a table.
"""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from ucm_cts.harness.report.diagrams.svg_text import width_of
from ucm_cts.harness.report.diagrams.transitions import STATES, RowSeen, Transition, transitions, worst
from ucm_cts.harness.report.order import SYMBOLS
from ucm_cts.reference_models.model.life_cycle import State

BOX, GAP = 168, 172
"""Widths of a state and of the space between two."""

LINE = 17
"""Height of one line of text."""

LEVEL = 30
"""Height between two transitions that pass above each other."""

_EXPLAIN = {"pass": "kept", "fail": "broken", "inconclusive": "never exercised"}


def to_svg(rows: Sequence[RowSeen]) -> Markup:
    """The diagram as an inline ``svg`` element."""
    found = transitions(rows)
    inner = {state: [t for t in found if t.state == t.next == state] for state in STATES}
    ways: dict[tuple[State, State], list[Transition]] = {}
    for transition in found:
        if transition.state != transition.next:
            ways.setdefault((transition.state, transition.next), []).append(transition)
    above = _levels([way for way in ways if _column(way[1]) - _column(way[0]) > 1], ways)
    below = _levels([way for way in ways if _column(way[0]) - _column(way[1]) > 1], ways)
    top = 22 + max((offset for offset in above.values()), default=0)
    box = 40 + LINE * max((len(items) for items in inner.values()), default=1)
    box = max(box, 150)
    bottom = top + box
    width = len(STATES) * BOX + (len(STATES) - 1) * GAP + 4
    height = bottom + 14 + max((offset for offset in below.values()), default=0)
    parts = [
        Markup(
            '<svg class="lc" viewBox="0 0 {w} {h}" width="{w}" height="{h}" role="img" '
            'aria-label="Life cycle of a component instance; the table below says the same in words">'
        ).format(w=width, h=height)
    ]
    for way, offset in above.items():
        parts.append(_long_way(way, ways[way], top, -offset))
    for way, offset in below.items():
        parts.append(_long_way(way, ways[way], bottom, offset))
    for way, items in ways.items():
        if abs(_column(way[0]) - _column(way[1])) == 1:
            parts.append(_short_way(way, items, top, box))
    parts += [_state(state, inner[state], top, box) for state in STATES]
    parts.append(Markup("</svg>"))
    return Markup("").join(parts)


def _column(state: State) -> int:
    return STATES.index(state)


def _left(state: State) -> int:
    return 2 + _column(state) * (BOX + GAP)


def _levels(
    far: Sequence[tuple[State, State]], ways: dict[tuple[State, State], list[Transition]]
) -> dict[tuple[State, State], int]:
    """How far from the states each long way runs: the longer, the farther; ways that do not meet share a level."""
    offsets: dict[tuple[State, State], int] = {}
    for way in sorted(far, key=lambda w: (abs(_column(w[0]) - _column(w[1])), _column(w[0]))):
        need = LEVEL + LINE * (len(ways[way]) - 1) + 4
        under = [offset for other, offset in offsets.items() if _meet(way, other)]
        offsets[way] = max(under, default=6) + need
    return offsets


def _meet(one: tuple[State, State], other: tuple[State, State]) -> bool:
    (a, b), (c, d) = (sorted(map(_column, way)) for way in (one, other))
    return a < d and c < b


def _long_way(way: tuple[State, State], items: Sequence[Transition], edge: int, offset: int) -> Markup:
    source, target = way
    forward = _column(target) > _column(source)
    start = _left(source) + (BOX - 40 - 14 * _column(target) if forward else 40 + 14 * (3 - _column(target)))
    end = _left(target) + (66 - 14 * _column(source) if forward else BOX - 24 - 14 * _column(source))
    level = edge + offset
    turn = 10 if offset > 0 else -10
    step = 10 if end > start else -10
    verdict = worst([item.verdict for item in items if item.chosen] or ["inconclusive"])
    path = (
        f"M{start} {edge}V{level - turn}q0 {turn} {step} {turn}"
        f"H{end - step}q{step} 0 {step} {-turn}V{edge + (turn * 9) // 10}"
    )
    tip = f"M{end} {edge}l-4 {'-' if offset < 0 else ''}9h8z"
    # words stand near the source, where no other way crosses them
    left = start + 14 if forward else start - 14 - max(width_of(f"✓ {item.operation}") for item in items)
    lines = [_words(item, left, level - 6 - LINE * (len(items) - 1 - i)) for i, item in enumerate(items)]
    return Markup('<g class="way {}"><path d="{}"/><path class="tip" d="{}"/></g>{}').format(
        _class(verdict, items), path, tip, Markup("").join(lines)
    )


def _short_way(way: tuple[State, State], items: Sequence[Transition], top: int, box: int) -> Markup:
    source, target = way
    forward = _column(target) > _column(source)
    start = _left(source) + (BOX if forward else 0)
    end = _left(target) + (0 if forward else BOX)
    y = top + (box // 4 + 6 if forward else box // 2 + box // 8 + LINE)
    sign = -1 if forward else 1
    verdict = worst([item.verdict for item in items if item.chosen] or ["inconclusive"])
    left = min(start, end) + 10
    lines = [_words(item, left, y - 7 - LINE * (len(items) - 1 - i)) for i, item in enumerate(items)]
    return Markup('<g class="way {}"><path d="M{} {}H{}"/><path class="tip" d="M{} {}l{}-4v8z"/></g>{}').format(
        _class(verdict, items), start, y, end + sign * 8, end, y, sign * 9, Markup("").join(lines)
    )


def _state(state: State, items: Sequence[Transition], top: int, box: int) -> Markup:
    left = _left(state)
    lines = [_words(item, left + 12, top + 44 + LINE * i) for i, item in enumerate(items)]
    return Markup(
        '<g class="state {state}"><rect x="{left}" y="{top}" width="{wide}" height="{box}" rx="10"/>'
        '<path d="M{left} {rule}h{wide}"/><text class="name" x="{middle}" y="{base}">{state}</text></g>{lines}'
    ).format(
        state=state,
        left=left,
        top=top,
        wide=BOX,
        box=box,
        rule=top + 26,
        middle=left + BOX // 2,
        base=top + 18,
        lines=Markup("").join(lines),
    )


def _words(item: Transition, x: int, y: int) -> Markup:
    result = _EXPLAIN[item.verdict] if item.chosen else "another permitted outcome was observed"
    symbol = SYMBOLS[item.verdict] if item.chosen else "–"
    return Markup(
        '<a href="#lc-{operation}-{state}"><text class="op {css}" x="{x}" y="{y}"><tspan class="mark">{symbol}</tspan> '
        "{operation}<title>{state} → {next}: {operation}, {result}, exercised {n} times</title></text></a>"
    ).format(
        css=_class(item.verdict, [item]),
        operation=item.operation,
        state=item.state,
        next=item.next,
        x=x,
        y=y,
        symbol=symbol,
        result=result,
        n=item.exercised,
    )


def _class(verdict: str, items: Sequence[Transition]) -> str:
    return verdict if any(item.chosen for item in items) else "aside"
