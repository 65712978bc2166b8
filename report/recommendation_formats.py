"""Recommendations, printed: the layout that reaches the wanted rates, then the others and why."""

import json
from collections.abc import Iterator, Sequence

from ..theory.orders import Order
from ..theory.recommendations import (
    Alternative,
    Reached,
    Recommendations,
    document,
    recommend,
    shortfall_text,
)
from ..theory.spelling import order_latex, order_text
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

_HEAD = ("layout", "points", "wanted", "variance", "short by", "decides", "because")
_CSV = ("layout", "axes", "admissible", "wanted", "region", "exponent", "log_power", "reached",
        "shortfall", "decides", "condition", "why")  # fmt: skip
_SHOWN = 12  # alternatives in a table; JSON and CSV have all


def render(claims: Sequence[str], dim: int, form: str) -> str:
    """The recommendations in one of the formats of the command line.

    Parameters
    ----------
    claims : sequence of str
        Wanted rates ``REGION/CLASS ~ EXPONENT [log Q]``.
    dim : int
    form : str
        ``terminal``, ``json``, ``latex``, ``markdown`` or ``csv``.

    Raises
    ------
    InputError
        If a wanted rate is outside the grammar.
    """
    found = recommend(claims, dim)
    if form == "json":
        return json.dumps(document(found), indent=1)
    if form == "csv":
        return _csv(found)
    shown = found.alternatives[:_SHOWN]
    notes = list(_notes(found))
    if form == "latex":
        return _latex(found, shown, notes)
    rows = [_cells(a, r) for a in shown for r in a.reached]
    if form == "markdown":
        lines = "\n".join(f"- {n}" for n in notes)
        return "\n\n".join([_title(found), markdown(_HEAD, rows), lines])
    grid = aligned(_HEAD, without_repeats(rows, 2))
    return "\n".join([_title(found), "", grid, "", *notes])


def _title(found: Recommendations) -> str:
    wanted = "; ".join(c.text for c in found.wanted)
    best = found.layout
    if best is None:
        return f"{found.dim}D, wanted {wanted}: no layout reaches all of it."
    return f"{found.dim}D, wanted {wanted}: {_name(best)}, {best.admissible}."


def _name(found: Alternative) -> str:
    """The layout, with the order of its axes where that is not their own."""
    if found.axes == tuple(sorted(found.axes)):
        return found.layout
    return f"{found.layout} on axes {','.join(map(str, found.axes))}"


def _cells(found: Alternative, r: Reached) -> list[str]:
    short = "" if r.shortfall is None else shortfall_text(r.shortfall)
    variance = order_text(r.order)
    head = [_name(found), found.admissible, r.wanted.text]
    return [*head, variance, short, r.region, r.condition]


def _notes(found: Recommendations) -> Iterator[str]:
    for r in found.layout.reached if found.layout else ():
        yield f"{r.wanted.text}: {r.why}"
    for a in found.alternatives[:_SHOWN]:
        if a.warning is not None:
            yield f"{_name(a)}: {a.warning}"
    hidden = len(found.alternatives) - _SHOWN
    if hidden > 0:
        yield f"{hidden} more layouts are in the formats json and csv."
    for x in found.left_out:
        yield f"left out: {x.what}: {x.why}"


def _csv(found: Recommendations) -> str:
    rows: list[list[str]] = []
    for a in found.alternatives:
        for r in a.reached:
            short = None if r.shortfall is None else shortfall_text(r.shortfall)
            cells = (a.layout, " ".join(map(str, a.axes)), a.admissible, r.wanted.text,
                     r.wanted.region, r.order.exponent, r.order.log_power, r.shortfall is None,
                     short, r.region, r.condition, r.why)  # fmt: skip
            rows.append([csv_cell(c) for c in cells])
    return comma_separated(_CSV, rows)


def _latex(found: Recommendations, shown: Sequence[Alternative], notes: Sequence[str]) -> str:
    rows: list[list[str] | None] = []
    for a in shown:
        names = [escaped(_name(a)), escaped(a.admissible)]
        for i, r in enumerate(a.reached):
            short = "" if r.shortfall is None else _factor(r.shortfall)
            head = names if i == 0 else ["", ""]
            cells = [escaped(r.wanted.text), f"${order_latex(r.order)}$", short, escaped(r.region)]
            rows.append([*head, *cells])
    head = [h.replace("variance", "Variance") for h in _HEAD[:-1]]
    table = booktabs("llllll", head, rows)
    lines = [_title(found), *notes]
    return "\n".join([PREAMBLE, table, *(rf"\par\noindent {escaped(n)}" for n in lines)])


def _factor(short: Order) -> str:
    """The shortfall in LaTeX."""
    if shortfall_text(short).startswith("more"):
        return escaped(shortfall_text(short))
    factor = order_latex(short).removeprefix("1").replace("N^{1}", "N")
    return f"${factor}$"
