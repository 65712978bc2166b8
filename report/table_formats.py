"""Convergence tables, printed: every region's term, the deciding one marked, as Eqs. 24-26 do."""

import json
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import groupby
from typing import Any

from ..theory.dominance import Case
from ..theory.orders import Order
from ..theory.primitives import parse_primitive, sampled_dimension
from ..theory.spelling import (
    big_o,
    cases_latex,
    condition_text,
    label_latex,
    order_latex,
    order_text,
)
from ..theory.symbolic import Expr, sympy
from ..theory.tables import Row, Table, document, parse_dim, table
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

_HEAD = ("sampler", "d", "integrand", "region", "variance", "decides")
_LATEX_HEAD = ("Variance", "Overall")
_NAMES_IN_A_ROW = 6  # supports that are listed; of more the first and the last
_DIGITS = 15  # of constants in documents
_SHOWN_DIGITS = 6
_LINE = 50  # letters, roughly, of a sum in a LaTeX table


def render(
    samplers: Sequence[str],
    dims: Sequence[str],
    integrands: Sequence[str],
    primitive: str,
    form: str,
) -> str:
    """The table in one of the formats of the command line."""
    found = table(samplers, dims, integrands, primitive, constants=form != "latex")
    _check_parameters(integrands, dims)
    meetings = _crossovers(found, integrands) if primitive == "point" else []
    if form == "json":
        whole = _document(found)
        whole["crossovers"] = meetings
        return json.dumps(whole, indent=1)
    if form == "csv":
        return _csv(found)
    if form == "latex":
        return "\n".join([PREAMBLE, _latex(found), *_meetings_latex(meetings)])
    if form == "markdown":
        cells = [
            _cells(r, mark, f"${_factor(r)}{order_latex(r.order)}$")
            for r, mark in _merged(found.rows)
        ]
        notes = "\n".join(f"- {line}" for line in _notes(found, meetings))
        return "\n\n".join([_title(found) + ".", markdown(_HEAD, cells), notes]).rstrip()
    rows = [
        _cells(r, mark, f"{_factor(r)}{order_text(r.order)}") for r, mark in _merged(found.rows)
    ]
    lines = [_title(found), "", aligned(_HEAD, without_repeats(rows, 3)), ""]
    return "\n".join(lines + _notes(found, meetings)).rstrip()


def _check_parameters(integrands: Sequence[str], dims: Sequence[str]) -> None:
    """Refuse parameters out of range; rates do not depend on them, but a row shows them.

    Raises
    ------
    InputError
        If an integrand could not be built.
    """
    given = [i for i in integrands if ":" in i]
    if not given:
        return
    from ..numerics.integrands.grammar import parse_integrand

    for text in given:
        for dim in dims:
            parse_integrand(text, int(dim) if dim.strip().isdigit() else 2)


def _document(found: Table) -> Document:
    """The table's document with the constants that hold no symbol also as decimals."""
    whole: Any = document(found)
    for row, entry in zip(found.rows, whole["rows"], strict=True):
        entry["constant_value"] = _decimal(row.constant, _DIGITS)
    return whole


def _decimal(constant: Expr | None, digits: int) -> str | None:
    """Certified digits; numbers are loaded only where there is a constant."""
    if constant is None or constant.free_symbols:
        return None
    from ..numerics.balls import certified, spelled
    from ..numerics.exact_variances.constant_balls import constant_ball

    return spelled(certified(lambda: constant_ball(constant), digits), digits).value


def _factor(row: Row) -> str:
    """The constant before the order, to six digits; nothing where none is known."""
    found = None if row.order.exponent is sympy.oo else _decimal(row.constant, _SHOWN_DIGITS)
    return f"{found} " if found else ""


def _csv(found: Table) -> str:
    rows: list[Document] = _document(found)["rows"]
    return comma_separated(list(rows[0]), [[csv_cell(v) for v in r.values()] for r in rows])


def _crossovers(found: Table, integrands: Sequence[str]) -> list[Document]:
    """Crossovers of Gaussians; only these need numbers, and only then is numpy loaded."""
    wanted = [i for i in integrands if "gaussian" in i]
    if not wanted:
        return []
    from ..numerics.exact_variances.crossovers import crossovers
    from ..numerics.integrands.grammar import parse_integrand
    from ..numerics.integrands.protocol import mp
    from ..theory.samplers import parse_sampler

    meetings: list[Document] = []
    names = dict.fromkeys((r.sampler, r.dim) for r in found.rows)
    for name, dim in names:
        if not parse_dim(dim).is_Integer:
            continue
        for text in wanted:
            integrand = parse_integrand(text, int(dim))
            for x in crossovers(parse_sampler(name, int(dim)), integrand):
                meetings.append(
                    {
                        "sampler": name,
                        "dim": dim,
                        "integrand": integrand.name,
                        "fast": {"region": x.fast.region, "order": order_text(x.fast.order)},
                        "slow": {"region": x.slow.region, "order": order_text(x.slow.order)},
                        "n": mp.nstr(x.count, 6),
                    }
                )
    return meetings


def _merged(rows: Sequence[Row]) -> Iterator[tuple[Row, str]]:
    """Rows and whether they decide; neighbouring regions of one order share a row.

    Where all regions share one order that row is the overall one.
    """
    for _, group in groupby(rows, key=lambda r: (r.sampler, r.dim, r.integrand)):
        members = list(group)
        merged = list(_merged_regions(members))
        ends = [r for r in members if r.is_overall]
        if len(merged) == 1 and len(ends) == 1 and merged[0].order == ends[0].order:
            shared = merged[0].region == "every region"
            name = "overall, every region" if shared else f"overall, {merged[0].region} alone"
            yield replace(merged[0], region=name, is_overall=True, dominated=False), ""
            continue
        for row in merged:
            decides = len(ends) == 1 and row.order == ends[0].order and not row.dominated
            yield row, "yes" if decides else ""
        yield from ((r, "") for r in ends)


def _merged_regions(rows: list[Row]) -> Iterator[Row]:
    """Regions without the overall row; a merged row is dominated if all its members are."""
    inner = [r for r in rows if not r.is_overall]
    for _, same in groupby(inner, key=lambda r: r.order):
        members = list(same)
        dominated = all(r.dominated for r in members)
        constants = [r.constant for r in members if r.constant is not None]
        yield replace(
            members[0],
            region=_joint_name(members, len(inner)),
            constant=sympy.Add(*constants) if len(constants) == len(members) else None,
            condition=None,
            dominated=dominated,
        )


def _joint_name(members: Sequence[Row], regions: int) -> str:
    """One name for neighbouring regions: ``1<w<=d``, ``2<=w<=5``, or their names in a row."""
    names = [r.region for r in members]
    if len(names) == 1:
        return names[0]
    if len(names) == regions:
        return "every region"
    sizes = [_size(r) for r in members]
    if names[-1] == "generic" and names[-2].startswith("1<w<"):
        return names[-2].replace("w<", "w<=")
    if None not in sizes:
        return f"{sizes[0]}<=w<={sizes[-1]}"
    if len(names) <= _NAMES_IN_A_ROW:
        return "; ".join(names)
    return f"{names[0]} to {names[-1]}"


def _size(row: Row) -> str | None:
    """w of a region of all supports of one size; None for others and in symbolic dimensions."""
    if row.region == "axis":
        return "1"
    if row.region == "generic":
        dim = sampled_dimension(parse_primitive(row.primitive), parse_dim(row.dim))
        return str(dim) if dim.is_Integer else None
    return row.region[2:] if row.region.startswith("w=") else None


def _cells(row: Row, mark: str, order: str) -> tuple[str, ...]:
    if row.condition is not None:
        order += f"  for {condition_text(row.condition)}"
    return row.sampler, row.dim, row.integrand, row.region, order, mark


def _title(found: Table) -> str:
    kind = found.rows[0].primitive
    placed = "points" if kind == "point" else f"parallel {kind}s"
    what = "term" if any(_factor(r) for r in found.rows) else "order"
    return f"Variance of an estimate from N {placed}, leading {what} as N -> oo"


def _notes(found: Table, meetings: Sequence[Document]) -> list[str]:
    return [*_legend(found), *_left_out(found), *map(_meeting, meetings)]


def _legend(found: Table) -> Iterator[str]:
    """What the words of this table mean; only those that occur."""
    regions = {r.region for r in found.rows if not r.is_overall}
    if any(r == "axis" or r == "generic" or "w" in r for r in regions):
        yield "region: frequencies with w nonzero coordinates; axis: w = 1, generic: all of them"
    if any(r.startswith(("within", "across")) for r in regions):
        yield "region: frequencies within one block of jointly stratified coordinates, or across"
    if any(r.replace(",", "").isdigit() for r in regions):
        yield "region 1,3: frequencies that are not zero in coordinates 1 and 3 alone"
    if any(r.primitive == "segment" for r in found.rows):
        yield "segments lie along the last axis; a row holds the slower of the regions it joins"
    if any(order_text(r.order) == "0" for r in found.rows):
        yield "variance 0: it falls faster than every power of N"
    if any(r.sampler.startswith("isotropic") and not _is_number(r) for r in found.rows):
        yield "isotropic:b: a free profile of degree b at low frequencies (Eq. 18)"


def _is_number(row: Row) -> bool:
    return row.sampler.partition(":")[2].replace("/", "").isdigit()


def _left_out(found: Table) -> Iterator[str]:
    regions: dict[tuple[str, str, str], list[str]] = {}
    for x in found.left_out:
        regions.setdefault((x.sampler, x.integrand, x.why), []).append(x.region)
    samplers: dict[tuple[str, str, tuple[str, ...]], list[str]] = {}
    for (sampler, integrand, why), names in regions.items():
        samplers.setdefault((integrand, why, tuple(names)), []).append(sampler)
    for (integrand, why, names), who in samplers.items():
        shown = ", ".join(names[:6]) + (f" and {len(names) - 6} more" if len(names) > 6 else "")
        whose = "every sampler" if len(samplers) == 1 and len(who) > 1 else ", ".join(who)
        yield f"left out: {integrand} on {shown} ({whose}): {why}"


def _meeting(x: Document) -> str:
    return (
        f"crossover: {x['sampler']} × {x['integrand']} in {x['dim']}D falls as "
        f"{x['fast']['order']} ({x['fast']['region']}) up to N* = {x['n']}, then as "
        f"{x['slow']['order']} ({x['slow']['region']})"
    )


def _latex(found: Table) -> str:
    """One tabular per dimension: a class per line, the sum of its terms, what it comes to."""
    parts: list[str] = []
    for dim, members in groupby(found.rows, key=lambda r: r.dim):
        lines: list[list[str] | None] = []
        for sampler, group in groupby(members, key=lambda r: r.sampler):
            if lines:
                lines.append(None)
            lines.append([rf"\multicolumn{{3}}{{l}}{{{_sampler(sampler)}}}"])
            for integrand, same in groupby(group, key=lambda r: r.integrand):
                lines.append(_line(integrand, list(same)))
        parts.append(booktabs("lll", ["$d$" if dim == "d" else f"$d={dim}$", *_LATEX_HEAD], lines))
    return "\n\n\\bigskip\\noindent\n".join([*parts])


def _line(integrand: str, rows: list[Row]) -> list[str]:
    ends = [Case(r.order, r.condition) for r in rows if r.is_overall]
    terms = _sum(list(_merged_regions(rows)))
    return [rf"\quad {escaped(integrand)}", terms, f"${cases_latex(ends)}$"]


def _sampler(name: str) -> str:
    """A sampler's name; its blocks and strata as mathematics."""
    family, colon, argument = name.partition(":")
    if not colon:
        return escaped(family)
    argument = argument.replace(" ", "").replace("x", r"\times ")
    return f"{escaped(family)} ${argument}$"


def _sum(rows: Sequence[Row]) -> str:
    """The regions' terms, each under its name, on as many lines as they need."""
    if len(rows) == 1:
        return f"${big_o(rows[0].order)}$"
    lines: list[list[str]] = [[]]
    length = 0.0
    for row in rows:
        width = 2 + max(0.7 * len(row.region), 4 + 0.7 * len(order_text(row.order)))
        if lines[-1] and length + width > _LINE:
            lines.append([])
            length = 0.0
        lines[-1].append(_term(row.order, row.region))
        length += width
    sums = [" + ".join(terms) for terms in lines]
    if len(sums) == 1:
        return f"${sums[0]}$"
    return r"$\begin{aligned}&" + r" \\ &{}+ ".join(sums) + r"\end{aligned}$"


def _term(order: Order, region: str) -> str:
    return rf"\overbrace{{{big_o(order)}}}^{{\text{{{label_latex(region)}}}}}"


def _meetings_latex(meetings: Sequence[Document]) -> Iterator[str]:
    """Up to which N the faster region leads."""
    for x in meetings:
        fast, slow = x["fast"], x["slow"]
        yield (
            rf"\par\noindent {_sampler(x['sampler'])}, {escaped(x['integrand'])}: "
            f"${_power(fast['order'])}$ ({label_latex(fast['region'])}) up to $N^*={x['n']}$, "
            f"then ${_power(slow['order'])}$ ({label_latex(slow['region'])})"
        )


def _power(order: str) -> str:
    """``N^(-3/2)`` in LaTeX; crossovers have plain numbers as exponents."""
    base, _, exponent = order.partition("^")
    return f"{base}^{{{exponent.strip('()')}}}"
