"""Groups, growth laws and counts shared by the samplers that have one set of strata."""

from collections.abc import Callable, Mapping
from math import prod

from ..layouts import AxisGroup, Growth, grouped
from ..strata import Strata, equal_strata, nearest_root, parse_strata
from ..symbolic import Expr, Integer

Counts = Callable[[int], Mapping[str, int]]


def strata_of(argument: str, dim: Expr) -> Strata | None:
    """The strata that an argument names; None for equal ones (also in symbolic dimensions)."""
    if not argument:
        return None
    strata = parse_strata(argument, int(dim) if dim.is_Integer else -1)
    return None if strata == equal_strata(int(dim)) else strata


def grid_of(
    strata: Strata | None, dim: Expr
) -> tuple[tuple[AxisGroup, ...], tuple[str, ...], dict[str, Growth], Counts | None]:
    """Groups, the count of each group, growth laws and counts near N.

    Equal strata make one group with the count ``n``; else each axis is a group of its own, with
    counts ``n1``, ``n2``, ...
    """
    laws = {"N": Growth(Integer(1))}
    if strata is None or strata.equal:
        laws["n"] = strata.growth[0] if strata else Growth(1 / dim)
        counts = _equal_counts(int(dim), strata) if dim.is_Integer else None
        return grouped((dim,)), ("n",), laws, counts
    names = tuple(f"n{i + 1}" for i in range(len(strata.factors)))
    laws |= dict(zip(names, strata.growth, strict=True))
    groups = grouped((Integer(1),) * len(names))
    return groups, names, laws, _unequal_counts(names, strata)


def _equal_counts(dim: int, strata: Strata | None) -> Counts:
    factor = strata.factors[0] if strata else 1

    def counts(n: int) -> Mapping[str, int]:
        per_axis = factor * nearest_root(n, factor**dim, dim)
        return {"N": per_axis**dim, "n": per_axis}

    return counts


def _unequal_counts(names: tuple[str, ...], strata: Strata) -> Counts:
    def counts(n: int) -> Mapping[str, int]:
        per_axis = strata.counts_near(n)
        return {"N": prod(per_axis), **dict(zip(names, per_axis, strict=True))}

    return counts
