"""Combs: what [n divides m] adds to a spectrum above its first alias, in the mean over shells.

Below the first alias a comb is [m = 0] and drops out of the low-frequency series. Above it the
teeth stand one frequency in n along each of the comb's axes, so that a comb of height H N^a over
axes with the counts n_i adds H N^a / ∏ n_i in the mean. Along a line of frequencies j k, on which
a ridge has its power, they stand one j in lcm n_i/gcd(n_i, k_i), of the order of one n_i where all
grow alike.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import reduce
from itertools import product
from operator import add

from .errors import UndecidedSign
from .expansions import factor_series, group_coefficient
from .kernels import Factor, Kernel, Term
from .layouts import Layout
from .leading_powers import Base, Bases, Coefficient, leading, leading_power, summed
from .regions import Region
from .signs import nonnegative
from .symbolic import Expr, FracElement, Integer, sympy


@dataclass(frozen=True)
class Comb:
    """Mean of a comb above its first alias: constant · N^height for |m| >= scale · N^threshold.

    ``spread`` is the sum of the exponents of the counts over the comb's axes: its teeth have
    every one of these coordinates beyond its count, ∏ |m_i| >= N^spread.
    """

    threshold: Expr
    height: Expr
    constant: Expr
    scale: Expr = Integer(1)
    spread: Expr = Integer(0)


def combs_of(
    kernel: Kernel, layout: Layout, region: Region, on_line: bool = False
) -> tuple[Comb, ...]:
    """The mean that each set of comb axes adds above its first alias, on a region.

    Parameters
    ----------
    on_line : bool
        Whether the mean is over the multiples of one frequency instead of shells.

    Raises
    ------
    UndecidedSign
        If on a line the counts of a set of combs grow with different powers of N.
    """
    return tuple(_means(kernel.restrict(tuple(region.counts)), layout, region, on_line))


def _means(
    terms: tuple[Term, ...], layout: Layout, region: Region, on_line: bool
) -> Iterator[Comb]:
    heights: dict[Bases, list[Coefficient]] = {}
    for term in terms:
        for combs, coefficient in _comb_terms(term, region.counts):
            heights.setdefault(combs, []).append(coefficient)
    for combs, parts in heights.items():
        lead = leading(summed(iter(parts)), layout.growth, region.assumptions)
        if lead is None:
            continue
        height, constant = lead
        threshold, scale, spread = Integer(0), Integer(1), Integer(0)
        for count, axes in combs:  # the comb meets one frequency in n on each of its axes
            exponent, factor = leading_power(count, layout.growth, region.assumptions)
            spread = spread + axes * exponent
            height, constant = height - axes * exponent, constant / factor**axes
            if exponent == threshold:
                scale = sympy.Max(scale, factor)
            elif on_line and threshold != 0:
                raise UndecidedSign(
                    "combs along a line must grow with one power of N: "
                    f"got N^({threshold}) and N^({exponent})"
                )
            elif nonnegative(exponent - threshold, region.assumptions):
                threshold, scale = exponent, factor
        if on_line:
            height, spread = height + spread - threshold, threshold
        yield Comb(threshold, sympy.expand(height), constant, scale, sympy.expand(spread))


def _comb_terms(term: Term, counts: tuple[Expr, ...]) -> Iterator[tuple[Bases, Coefficient]]:
    """Choices of comb axes in a term: (count, number of axes) and the coefficient at m = 0."""
    choices = [list(_comb_choices(factor, counts[g])) for g, factor in term.factors]
    for pick in product(*choices):
        combs = tuple(c for combs, _ in pick for c in combs)
        if combs:
            value: FracElement = term.coefficient
            bases: list[Base] = []
            for _, (coefficient, base) in pick:
                value, bases = value * coefficient, bases + base
            if value != 0:
                yield combs, {tuple(bases): value}


def _comb_choices(
    factor: Factor, w: Expr
) -> Iterator[tuple[Bases, tuple[FracElement, list[Base]]]]:
    """For one group: no comb at all, or all w axes on a comb (mixed only for w = 1)."""
    plain = Factor(tuple((c, a) for c, a in factor.terms if not a.combs))
    if plain.terms:
        yield (), group_coefficient(factor_series(plain), (), w)
    counts = sorted({n for _, a in factor.terms for n in a.combs}, key=str)
    if counts and plain.terms and w != Integer(1):
        raise ValueError(f"a comb beside other terms must stand on a group of one axis: got {w}")
    for count in counts:
        field = factor.terms[0][0].field
        value = reduce(add, (c for c, a in factor.terms if a.combs == (count,)), field(0))
        yield ((count, w),), ((value ** int(w), []) if w.is_Integer else (field(1), [(value, w)]))
