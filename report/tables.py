"""Convergence tables, printed: every region's term, the deciding one marked, as Eqs. 24-26 do."""

import json
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import Any

from ..theory.derivations import latex_label
from ..theory.orders import Order
from ..theory.tables import Row, Table, document, parse_dim, table
from .grids import aligned, booktabs, comma_separated, escaped, markdown

_HEAD = ("sampler", "d", "integrand", "region", "variance", "")


def render(
    samplers: Sequence[str],
    dims: Sequence[str],
    integrands: Sequence[str],
    primitive: str,
    form: str,
) -> str:
    """The table in one of the formats of the command line."""
    found = table(samplers, dims, integrands, primitive, constants=form in ("json", "csv"))
    meetings = _crossovers(found, integrands, dims) if primitive == "point" else []
    if form == "json":
        whole = document(found)
        whole["crossovers"] = meetings
        return json.dumps(whole, indent=1)
    if form == "latex":
        return _latex(found)
    if form == "csv":
        return _csv(found)
    rows = [_cells(r) for r in _merged(found.rows)]
    if form == "markdown":
        return markdown(_HEAD[:5], [r[:5] for r in rows])
    return "\n".join(
        [aligned(_HEAD, list(_without_repeats(rows))), *_notes(found), *_meeting_lines(meetings)]
    )


def _csv(found: Table) -> str:
    rows = document(found)["rows"]
    assert isinstance(rows, list)
    head = list(rows[0])  # pyright: ignore[reportUnknownArgumentType]
    body = [["" if v is None else str(v) for v in r.values()] for r in rows]  # pyright: ignore[reportUnknownVariableType, reportUnknownMemberType, reportUnknownArgumentType]
    return comma_separated(head, body)


def _crossovers(
    found: Table, integrands: Sequence[str], dims: Sequence[str]
) -> list[dict[str, Any]]:
    """Crossovers of Gaussians; only these need numbers, and only then is numpy loaded."""
    wanted = [i for i in integrands if "gaussian" in i]
    if not wanted:
        return []
    from ..numerics.crossovers import crossovers
    from ..numerics.integrands.grammar import parse_integrand
    from ..numerics.integrands.protocol import mp
    from ..theory.samplers import parse_sampler

    meetings: list[dict[str, Any]] = []
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
                        "fast": {"region": x.fast.region, "order": str(x.fast.order)},
                        "slow": {"region": x.slow.region, "order": str(x.slow.order)},
                        "n": mp.nstr(x.count, 6),
                    }
                )
    return meetings


def _merged(rows: Sequence[Row]) -> Iterator[Row]:
    """Rows of one sampler and class; neighbouring regions of one order share a row."""
    for _, group in groupby(rows, key=lambda r: (r.sampler, r.dim, r.integrand)):
        yield from _merged_regions(list(group))


def _merged_regions(rows: list[Row]) -> Iterator[Row]:
    inner = [r for r in rows if not r.is_overall]
    for _, same in groupby(inner, key=lambda r: r.order):
        members = list(same)
        first, last = members[0], members[-1]
        region = first.region
        if len(members) == len(inner) and len(inner) > 1:
            region = "every region"
        elif len(members) > 1:
            region = (
                f"{first.region} to {last.region}"
                if len(members) > 2
                else ", ".join(r.region for r in members)
            )
        decides = all(r.dominated for r in members)
        yield Row(*_head(first), region, first.order, None, False, decides)
    yield from (r for r in rows if r.is_overall)


def _head(row: Row) -> tuple[str, str, str, str]:
    return row.sampler, row.dim, row.primitive, row.integrand


def _cells(row: Row) -> tuple[str, ...]:
    order = str(row.order)
    if row.condition is not None:
        order += f"  for {row.condition}"
    mark = "<- decides" if row.is_overall else "dominated" if row.dominated else ""
    return row.sampler, row.dim, row.integrand, row.region, order, mark


def _without_repeats(rows: list[tuple[str, ...]]) -> Iterator[tuple[str, ...]]:
    """Sampler, d and class once per group: the eye finds the groups by the gaps."""
    before: tuple[str, ...] = ()
    for row in rows:
        same = row[:3] == before
        before = row[:3]
        yield (("", "", "") if same else row[:3]) + row[3:]


def _notes(found: Table) -> Iterator[str]:
    primitives = {r.primitive for r in found.rows} - {"point"}
    if primitives:
        yield f"\nsampling with the primitive {', '.join(primitives)}"
    regions: dict[tuple[str, str, str], list[str]] = {}
    for x in found.left_out:
        regions.setdefault((x.sampler, x.integrand, x.why), []).append(x.region)
    if regions:
        yield "\nleft out:"
    for (sampler, integrand, why), names in regions.items():
        shown = ", ".join(names[:6]) + (f" and {len(names) - 6} more" if len(names) > 6 else "")
        yield f"  {sampler} × {integrand}: {shown} ({why})"


def _meeting_lines(meetings: list[dict[str, Any]]) -> Iterator[str]:
    for x in meetings:
        yield (
            f"crossover: {x['sampler']} × {x['integrand']} in {x['dim']}D falls as "
            f"{x['fast']['order']} ({x['fast']['region']}) up to N* = {x['n']}, then as "
            f"{x['slow']['order']} ({x['slow']['region']})"
        )


def _latex(found: Table) -> str:
    """One line per sampler, dimension and class: the sum of its terms, and what it comes to."""
    lines: list[list[str] | None] = []
    groups = groupby(found.rows, key=lambda r: (r.sampler, r.dim, r.integrand))
    before = ""
    for (sampler, dim, integrand), group in groups:
        rows = list(group)
        terms = [_term(r) for r in _merged_regions(rows) if not r.is_overall]
        ends = [_end(r) for r in rows if r.is_overall]
        if before and before != sampler:
            lines.append(None)
        name = escaped(sampler) if sampler != before else ""
        before = sampler
        total = "$" + " + ".join(terms) + "$"
        lines.append([name, f"${dim}$", escaped(integrand), total, "$" + r";\ ".join(ends) + "$"])
    head = ["Sampler", "$d$", "Integrand", r"$\mathrm{Var}(I_N)$", "Overall"]
    return booktabs("llllr", head, lines)


def _term(row: Row) -> str:
    order = _big_o(row.order)
    return rf"\overbrace{{{order}}}^{{\text{{{latex_label(row.region)}}}}}"


def _end(row: Row) -> str:
    if row.condition is None:
        return _big_o(row.order)
    from ..theory.symbolic import sympy

    return rf"{_big_o(row.order)}\ ({sympy.latex(row.condition)})"


def _big_o(order: Order) -> str:
    return "0" if str(order) == "0" else rf"\mathcal{{O}}({order.latex()})"
