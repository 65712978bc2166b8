"""The plateau γ of Eq. 18: the supremum of N·P_S over a region, as N → ∞.

On a support N·P_S is linear in each of its factors sinc²(m_i/n), so that it is largest where all
of them are at an end of their range. As N → ∞ the scales n of one axis part: at |m_i| = N^x those
that grow slower than N^x have sinc² → 0, those that grow faster sinc² → 1, and at most one lies
between. The supremum is then the largest value over such nested corners, and it is attained.
(Latin hypercube: N/(N − 1) → 1. Multi-jitter: its supremum is 1.234 at n = 3 and tends to 1.)
Combs are left out: their teeth are kept apart, as a mean. Other shapes than sinc² lie between 0
and 1 too, but that of difference jitter: there γ = 1 is the limit at |m| ≫ N, and N·P_S rises
above it by up to a sixth where m is of the size of N.

Axes of one group are exchangeable, so that a corner is known by how many axes have each pattern of
factors switched on. For a symbolic number of axes 2 and 3 axes are looked at and must agree.
"""

from functools import lru_cache
from itertools import combinations_with_replacement, product

from .errors import UndecidedSign
from .kernels import Factor, Term
from .leading_powers import leading_power
from .regions import Region
from .samplers.definition import Sampler
from .signs import nonnegative, sign_of
from .symbolic import Expr, FracElement, Integer

_MOST_AXES = 3  # of one group: more axes have no corner of another kind


@lru_cache(maxsize=1024)
def plateau(sampler: Sampler, region: Region) -> Expr:
    """γ on a region: the largest limit of N·P_S over nested corners.

    Raises
    ------
    UndecidedSign
        If N·P_S without its combs is unbounded, or 2 and 3 axes of a symbolic number disagree.
    """
    assert sampler.kernel is not None
    terms = sampler.kernel.restrict(region.counts)
    sizes = [(2, 3) if not c.is_Integer else (min(int(c), _MOST_AXES),) for c in region.counts]
    found = {_largest_corner(sampler, region, terms, counts) for counts in product(*sizes)}
    if len(found) != 1:
        raise UndecidedSign(f"the plateau must not depend on the number of axes: got {found}")
    return found.pop()


def _largest_corner(
    sampler: Sampler, region: Region, terms: tuple[Term, ...], counts: tuple[int, ...]
) -> Expr:
    groups = [g for g, count in enumerate(counts) if count]
    names = {g: _counts_in(terms, g) for g in groups}
    corners = [
        list(combinations_with_replacement(_nested(sampler, region, names[g]), counts[g]))
        for g in groups
    ]
    best: Expr = Integer(0)
    for pick in product(*corners):
        value = _corner_value(terms, dict(zip(groups, pick, strict=True)))
        limit = _limit(sampler, region, value)
        best = limit if nonnegative(limit - best) else best
    return best


def _counts_in(terms: tuple[Term, ...], group: int) -> tuple[FracElement, ...]:
    """The counts of all shapes on a group."""
    found = {
        c
        for t in terms
        for g, factor in t.factors
        if g == group
        for _, atom in factor.terms
        for _, c in atom.shapes
    }
    return tuple(sorted(found, key=str))


def _nested(
    sampler: Sampler, region: Region, names: tuple[FracElement, ...]
) -> list[frozenset[FracElement]]:
    """Which factors are 1 and not 0: with a scale all those that grow faster."""
    growth = dict(sampler.layout.growth)
    power = {n: leading_power(n, growth, region.assumptions)[0] for n in names}
    found: list[frozenset[FracElement]] = []
    for switch in product((False, True), repeat=len(names)):
        on = frozenset(n for n, chosen in zip(names, switch, strict=True) if chosen)
        off = [n for n in names if n not in on]
        if not any(
            sign_of(power[f] - power[n], region.assumptions) == "+" for n in on for f in off
        ):
            found.append(on)
    return found


def _corner_value(
    terms: tuple[Term, ...], corner: dict[int, tuple[frozenset[FracElement], ...]]
) -> FracElement:
    total = terms[0].coefficient * 0
    for term in terms:
        value, factors = term.coefficient, dict(term.factors)
        for group, patterns in corner.items():
            if group in factors:
                for pattern in patterns:
                    value = value * _switched(factors[group], pattern)
        total = total + value
    return total


def _switched(factor: Factor, pattern: frozenset[FracElement]) -> FracElement | int:
    return sum(
        (c for c, a in factor.terms if not a.combs and {n for _, n in a.shapes} <= pattern),
        start=0,
    )


def _limit(sampler: Sampler, region: Region, value: FracElement) -> Expr:
    if value == 0:
        return Integer(0)
    exponent, constant = leading_power(value, dict(sampler.layout.growth), region.assumptions)
    if exponent == 0:
        return constant
    if nonnegative(-exponent, region.assumptions):
        return Integer(0)
    raise UndecidedSign(f"N P_S must be bounded: got the power {exponent} of N")
