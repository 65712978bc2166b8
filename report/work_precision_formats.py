"""Work and precision, printed: ratios of times, then every step of every method."""

import json
from collections.abc import Iterator
from typing import Any

from .grids import (
    PREAMBLE,
    aligned,
    booktabs,
    comma_separated,
    csv_cell,
    escaped,
    markdown,
    without_repeats,
)

Document = dict[str, Any]

_RATIOS = ("b", "d", "prepare", "closed form", "quadrature", "mpmath.quad", "closed", "quad.")
_POINTS = ("problem", "method", "asked", "error", "reported", "seconds")


def render(document: Document, form: str) -> str:
    """The document in one of the formats of the command line; CSV holds the points."""
    if form == "json":
        return json.dumps(document, indent=1, allow_nan=False)
    if form == "csv":
        points = document["points"]
        return comma_separated(list(points[0]), [[csv_cell(v) for v in p.values()] for p in points])
    words, ratios, points = [*_words(document)], [*_ratios(document)], [*_points(document)]
    if form == "latex":
        tables = [
            booktabs(
                "l" * len(head), [escaped(h) for h in head], [[*map(escaped, r)] for r in rows]
            )
            for head, rows in (
                (_RATIOS, without_repeats(ratios, 1)),
                (_POINTS, without_repeats(points, 2)),
            )
        ]
        prose = (rf"\par\noindent {escaped(w)}" for w in words)
        small = (rf"\par\medskip\noindent{{\small {t}}}" for t in tables)
        return "\n".join([PREAMBLE, *prose, *small])
    if form == "markdown":
        items = "\n".join(f"- {w}" for w in words)
        return "\n\n".join([items, markdown(_RATIOS, ratios), markdown(_POINTS, points)])
    shown = aligned(_POINTS, without_repeats(points, 2))
    return "\n\n".join(["\n".join(words), aligned(_RATIOS, without_repeats(ratios, 1)), shown])


def _words(document: Document) -> Iterator[str]:
    first = document["ratios"][0]
    closed = min(r["closed_ratio"] for r in document["ratios"])
    quadrature = min(r["quadrature_ratio"] for r in document["ratios"])
    yield (
        f"Eq. 17 to {first['digits']} digits at N = {first['n']}: the closed form is at least "
        f"{closed:.0f} times as fast as mpmath.quad, ball quadrature {quadrature:.0f} times"
    )
    yield "times in seconds; the last two columns: how many times as long mpmath.quad takes"
    yield "error: measured, relative; of Monte Carlo the root mean square, with a 95 % interval"
    yield "reported: what the method says of its error"
    for p in document["problems"]:
        yield f"{p['name']}: {p['about']}; value {p['value']}"
    for x in document["left_out"]:
        yield f"left out: {x['what']}: {x['why']}"


def _ratios(document: Document) -> Iterator[list[str]]:
    times = ("preparation_seconds", "closed_seconds", "quadrature_seconds", "mpmath_seconds")
    for r in document["ratios"]:
        ratios = [f"{r[k]:.0f}" for k in ("closed_ratio", "quadrature_ratio")]
        yield [r["degree"], str(r["dim"]), *(f"{r[k]:.1e}" for k in times), *ratios]


def _points(document: Document) -> Iterator[list[str]]:
    for p in sorted(document["points"], key=lambda p: (p["problem"], p["method"])):
        error = _number(p["relative_error"])
        if p["low"] is not None:
            error += f" [{_number(p['low'])}, {_number(p['high'])}]"
        asked = f"{p['parameter']} {p['step']}"
        reported, seconds = _number(p["reported_error"]), f"{p['seconds']:.1e}"
        yield [p["problem"], p["method"], asked, error, reported, seconds]


def _number(value: float | None) -> str:
    return "-" if value is None else "0" if value == 0 else f"{value:.1e}"
