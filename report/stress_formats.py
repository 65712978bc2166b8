"""Stiff and extreme cases, printed: which answers are dishonest first, then all of them."""

import json
from collections.abc import Callable, Iterator, Sequence
from itertools import groupby
from math import floor, log10
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

_PAGE = 60  # rows of a table in LaTeX
_HEAD = ("case", "method", "error", "reported", "kind", "ms", "honest")


def render(document: Document, form: str) -> str:
    """The document in one of the formats of the command line."""
    if form == "json":
        return json.dumps(document, indent=1, allow_nan=False)
    if form == "csv":
        cases = document["cases"]
        head = list(cases[0]) if cases else []
        return comma_separated(head, [[csv_cell(v) for v in c.values()] for c in cases])
    words = [*_words(document)]
    if form == "latex":
        return _latex(words, document["cases"])
    if form == "markdown":
        tables = [f"{name}\n\n{markdown(_HEAD, rows)}" for name, rows in _tables(document["cases"])]
        items = "\n".join(f"- {w.strip()}" for w in words[1:])
        return "\n\n".join([f"**{words[0]}**", items, *tables])
    tables = [
        f"{name}\n{aligned(_HEAD, without_repeats(rows, 1))}"
        for name, rows in _tables(document["cases"])
    ]
    return "\n\n".join(["\n".join(words), *tables])


def _words(document: Document) -> Iterator[str]:
    """What a reader must know first: whether all is honest, and what is not."""
    cases = document["cases"]
    problems, refused = len({c["name"] for c in cases}), sum(c["refused"] for c in cases)
    bad = [c for c in cases if not c["honest"]]
    end = f"{document['seconds']:.1f} s" + (", interrupted" if document["interrupted"] else "")
    if bad:
        yield f"DISHONEST: {len(bad)} of {len(cases)} answers to {problems} problems, {end}"
    else:
        answers = f"all {len(cases) - refused} answers to {problems} problems, {refused} refused"
        yield f"HONEST: {answers}, {end}"
    for c in bad:
        yield f"  {c['name']}, {c['method']}: {c['why']}"
    yield "  error: of the value, relative, against 100 certified digits from another route if any"
    yield "  reported: the error that the method allows for; a bound is proven, an estimate is not"
    yield "  honest: the error is at most the one reported, or the method refuses clearly"


def _tables(
    cases: Sequence[Document], write: Callable[[float | None], str] | None = None
) -> Iterator[tuple[str, list[list[str]]]]:
    """One table per kind of problem, the part of a case's name before the colon."""
    shown = write or _number
    for kind, group in groupby(cases, key=lambda c: c["name"].partition(": ")[0]):
        rows = [
            [
                c["name"].partition(": ")[2],
                c["method"],
                shown(c["relative_error"]),
                shown(c["error_bound"]),
                c["error_kind"] or ("refused" if c["refused"] else "failed"),
                f"{1000 * c['seconds']:.2f}",
                "yes" if c["honest"] else "NO",
            ]
            for c in group
        ]
        yield kind, rows


def _number(value: float | None) -> str:
    return "-" if value is None else "0" if value == 0 else f"{value:.1e}"


def _math(value: float | None) -> str:
    if not value:
        return _number(value)
    power = floor(log10(value))
    return rf"${value / 10.0**power:.1f}\times10^{{{power}}}$"


def _latex(words: Sequence[str], cases: Sequence[Document]) -> str:
    parts = [PREAMBLE, *(rf"\par\noindent {escaped(w.strip())}" for w in words)]
    for kind, rows in _tables(cases, _math):
        cells = [
            [r[0] and escaped(r[0]), escaped(r[1]), *r[2:4], *map(escaped, r[4:])]
            for r in without_repeats(rows, 1)
        ]
        for start in range(0, len(cells), _PAGE):
            table = booktabs("lllllrl", _HEAD, cells[start : start + _PAGE])
            title = escaped(kind) + (" (continued)" if start else "")
            parts.append(rf"\par\medskip\noindent {title}\par\noindent{{\tiny {table}}}")
    return "\n".join(parts)
