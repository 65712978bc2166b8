r"""Leading constants of product integrands: kernel against the power along each axis, as N → ∞.

On a region N·Var is a sum over the kernel's terms of coefficient · ∏_i Σ_m F_i(m) φ(m), where φ is
the term's factor on axis i and the axes outside the support bring |f^_i(0)|². A factor is a linear
combination of 1, sinc²(m/n), combs [n | m] and [n | m] sinc²(m/n'), whose sums are

    t,     t − D(n),     t n^-p,     n^-p (t − D(n'/n)),           D(n) ~ δ n^-κ (ln n)^λ

(``axis_powers.py``). The product is multiplied out in the t and D with coefficients that stay in
the exact field of the counts, so that what cancels identically is gone before the growth laws of
the counts are put in (jitter loses its t's, correlated multi-jitter also its terms linear in the
coarse D's). The largest power of N that is left is the order, the sum of its constants the
constant. Where that sum vanishes, a fixed count stays in it or a comb oscillates at this order,
there is no constant.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import reduce
from math import comb, prod
from typing import Literal, TypeAlias

from .axis_powers import AxisPower, ProductPower
from .kernels import Atom, Factor, Term
from .leading_powers import leading_power
from .monomials import Monomial, Sum, collected, power_of, product_of, vanishes
from .orders import Order
from .radial import Leading
from .regions import Region
from .samplers.definition import Sampler
from .symbolic import Expr, FracElement, Integer, sympy

MOST_AXES = 12
"""Coordinates up to which the sums are multiplied out."""


@dataclass(frozen=True)
class _Letter:
    """D(n), or n^-p of a comb, on an axis of a group."""

    group: int
    kind: Literal["D", "comb"]
    count: FracElement


_Place: TypeAlias = tuple[Expr, Expr]  # powers of N and of log N


def product_constant(sampler: Sampler, region: Region, power: ProductPower) -> Leading | None:
    """Leading term of the variance that a region of a sampler leaves to a product integrand.

    Parameters
    ----------
    sampler : Sampler
        With a kernel, in a dimension that is a number.
    region : Region
        All its supports count, each with its own axes.
    power : ProductPower
        Of the same dimension.

    Returns
    -------
    Leading or None
        None where the region has no power, the leading term has no constant, or there are more
        than 12 axes.
    """
    if sampler.kernel is None or not sampler.dim.is_Integer or sampler.dim > MOST_AXES:
        return None
    total = collected(
        pair
        for term in sampler.kernel.restrict(region.counts)
        for pair in _multiplied_out(term, region, power).items()
    )
    weights = [
        _support_weights(power.axes[int(g.first) - 1 : int(g.first + g.size) - 1], int(w))
        for g, w in zip(sampler.layout.groups, region.counts, strict=True)
    ]
    laws = _laws(sampler, total)
    found: dict[_Place, list[Expr | None]] = {}
    for monomial, coefficient in total.items():
        weight = prod((w[_deficits(monomial, g)] for g, w in enumerate(weights)), start=Integer(1))
        if weight != 0 and not vanishes(coefficient, sampler.layout.growth):
            placed = _placed(sampler, laws, monomial, coefficient, power)
            if placed is None:
                return None
            place, constant = placed
            known = not power.oscillates or all(x.kind == "D" for x, _ in monomial)
            found.setdefault(place, []).append(constant * weight if known else None)
    return _largest(found)


def _largest(found: dict[_Place, list[Expr | None]]) -> Leading | None:
    if not found:
        return None
    exponent, log = max(found)
    constants = [c for c in found[exponent, log] if c is not None]
    constant = sympy.expand(sum(constants, Integer(0)))
    if constant == 0 or len(constants) < len(found[exponent, log]):
        return None
    return Leading(Order(1 - exponent, log), constant)


def _multiplied_out(term: Term, region: Region, power: ProductPower) -> Sum[_Letter]:
    """A term's sums over the axes of a support, in the D; t's are known from the number of axes."""
    factors = dict(term.factors)
    total: Sum[_Letter] = {frozenset(): term.coefficient}
    for group, count in enumerate(region.counts):
        if group in factors and count:
            on_axis = _axis_sum(group, factors[group], power)
            total = product_of(total, power_of(on_axis, int(count)))
    return total


def _axis_sum(group: int, factor: Factor, power: ProductPower) -> Sum[_Letter]:
    """Σ_m F(m) φ(m) on one axis."""
    return collected(
        (frozenset((letter, 1) for letter in letters), sign * coefficient)
        for coefficient, atom in factor.terms
        for sign, letters in _atom_sum(group, atom, power)
    )


def _atom_sum(
    group: int, atom: Atom, power: ProductPower
) -> Iterator[tuple[int, tuple[_Letter, ...]]]:
    """The sum of one atom, which has at most one comb and one sinc², as signed letters."""
    if atom.combs and power.comb.is_infinite:
        return
    scale = tuple(_Letter(group, "comb", n) for n in atom.combs)
    yield 1, scale
    for n in atom.sincs:
        inner = reduce(lambda count, tooth: count / tooth, atom.combs, n)
        yield -1, (*scale, _Letter(group, "D", inner))


def _deficits(monomial: Monomial[_Letter], group: int) -> int:
    """On how many axes of a group the monomial has a D."""
    return sum(k for letter, k in monomial if letter.kind == "D" and letter.group == group)


def _support_weights(axes: tuple[AxisPower, ...], count: int) -> list[Expr]:
    """Σ over supports of the mean of ∏ δ ∏ t ∏ |f^(0)|², by the number of axes that carry a δ."""
    if len(set(axes)) == 1:
        (axis,) = set(axes)
        front = comb(len(axes), count) * axis.mean_square ** (len(axes) - count)
        return [front * axis.total ** (count - k) * axis.deficit**k for k in range(count + 1)]
    # sums[c][k]: c axes of those seen so far are in the support, k of them carry a δ.
    zero = Integer(0)
    sums = [[Integer(int(c == k == 0)) for k in range(count + 1)] for c in range(count + 1)]
    for axis in axes:
        sums = [
            [
                sums[c][k] * axis.mean_square
                + (sums[c - 1][k] * axis.total if c else zero)
                + (sums[c - 1][k - 1] * axis.deficit if c and k else zero)
                for k in range(count + 1)
            ]
            for c in range(count + 1)
        ]
    # The multinomial theorem has already counted which of the axes carry the δ's.
    return [s.expand() / comb(count, k) for k, s in enumerate(sums[count])]


def _laws(sampler: Sampler, total: Sum[_Letter]) -> dict[_Letter, tuple[Expr, Expr]]:
    """(a, κ) with count ~ κ N^a of every letter."""
    letters = {letter for monomial in total for letter, _ in monomial}
    return {letter: leading_power(letter.count, sampler.layout.growth) for letter in letters}


def _placed(
    sampler: Sampler,
    laws: Mapping[_Letter, tuple[Expr, Expr]],
    monomial: Monomial[_Letter],
    coefficient: FracElement,
    power: ProductPower,
) -> tuple[_Place, Expr] | None:
    """((a, l), C) with the monomial ~ C N^a (log N)^l; None if one of its counts does not grow."""
    exponent, constant = leading_power(coefficient, sampler.layout.growth)
    log = Integer(0)
    for letter, k in monomial:
        rise, scale = laws[letter]
        if rise == 0:
            return None
        fall = power.fall if letter.kind == "D" else power.comb
        exponent, constant = exponent - k * fall * rise, constant * scale ** (-k * fall)
        if letter.kind == "D" and power.log:
            log, constant = log + k * power.log, constant * rise ** (k * power.log)
    return (exponent, log), constant
