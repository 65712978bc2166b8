"""Low-frequency expansion of a kernel on one region: terms C · m^powers · N^-decay.

On a region every factor is a power series in m_i², since sinc²(x) = Σ_k s_k π^2k x^2k. The
product of one factor φ = Σ_k c_k m^2k over w axes of a group is a sum of monomial symmetric
functions,

    ∏_i φ(m_i) = Σ_λ c_0^(w−ℓ(λ)) ∏_{k in λ} c_k · M_λ(m²),        λ a partition of ℓ(λ) ≤ w parts,

which also makes sense for a symbolic w (the power sums Σ m_i^2k in another basis). The orders
1, m², m⁴ of all groups together are kept, and where a factor has c_0 = 0 the first term that
does not vanish, (1, 1, ..., 1) of degree 2w. That nothing of consequence is lost is checked by the
two-sided comparison of profile and kernel in the numerics room.

Below the first alias a comb is [m = 0] and drops out; what it adds above is in ``combs.py``.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from itertools import product

from .kernels import Factor, Kernel, Term
from .layouts import Layout
from .leading_powers import Base, Coefficient, leading, summed
from .regions import Region
from .symbolic import Expr, FracElement, FracField, Integer, Rational, sympy

FULL = (-1,)
"""The partition (1, 1, ..., 1) with one part for each axis of the support in a group."""

_PARTITIONS: tuple[tuple[int, ...], ...] = ((), (1,), (2,), (1, 1))
_HIGHEST = 2  # powers of m² kept


@dataclass(frozen=True)
class Powers:
    """A monomial symmetric function of the m_i² of a region, one partition per group."""

    partitions: tuple[tuple[int, ...], ...]

    def degree(self, counts: tuple[Expr, ...]) -> Expr:
        """Total power of |m|."""
        parts = zip(self.partitions, counts, strict=True)
        return sum((2 * w if p == FULL else Integer(2 * sum(p)) for p, w in parts), Integer(0))

    def angular_mean(self, counts: tuple[Expr, ...]) -> Expr:
        """Mean over the sphere of the support of M_λ(m²)/|m|^degree (Dirichlet moments)."""
        s = sum(counts, Integer(0))
        mean = 1 / sympy.rf(s / 2, self.degree(counts) / 2)
        for partition, w in zip(self.partitions, counts, strict=True):
            if partition == FULL:
                mean *= Rational(1, 2) ** w
                continue
            number = sympy.ff(w, len(partition))
            for k in set(partition):
                number /= sympy.factorial(partition.count(k))
            mean *= number * sympy.prod([sympy.rf(Rational(1, 2), k) for k in partition])
        return sympy.cancel(sympy.expand_func(mean)) if mean.free_symbols else mean

    def text(self, names: tuple[str, ...]) -> str:
        """As in ``m_1^2 m_2^2`` or ``sum m_i^2``; one name per group."""
        found: list[str] = []
        for partition, name in zip(self.partitions, names, strict=True):
            if partition == FULL:
                found.append(f"prod_{name} m_i^2")
            elif partition == (1, 1):
                found.append(f"sum_{name} m_i^2 m_j^2")
            elif partition:
                found.append(f"sum_{name} m_i^{2 * partition[0]}")
        return " ".join(found) or "1"


@dataclass(frozen=True)
class SeriesTerm:
    """constant · M_powers(m²) · N^-decay, of total degree ``degree`` in |m|."""

    powers: Powers
    degree: Expr
    decay: Expr
    constant: Expr


@dataclass(frozen=True)
class Series:
    """Low-frequency terms of N·P_S on a region."""

    counts: tuple[Expr, ...]
    terms: tuple[SeriesTerm, ...]


def expand(kernel: Kernel, layout: Layout, region: Region) -> Series:
    """Low-frequency expansion of a kernel on a region."""
    counts = tuple(region.counts)
    terms = kernel.restrict(counts)
    found: list[SeriesTerm] = []
    for powers in _indices(counts):
        coefficient = summed(_term_coefficient(t, powers, counts) for t in terms)
        lead = leading(coefficient, layout.growth, region.assumptions)
        if lead is not None:
            found.append(SeriesTerm(powers, powers.degree(counts), sympy.expand(-lead[0]), lead[1]))
            if lead[0] == 0 and found[-1].degree == 0:
                break  # flat from the start: no other term can rise above it
    return Series(counts, tuple(found))


def _indices(counts: tuple[Expr, ...]) -> Iterator[Powers]:
    """Partitions per group with total at most 2, and full ones."""
    choices = [_partitions(w) for w in counts]
    for pick in product(*choices):
        plain = sum(sum(p) for p in pick if p != FULL)
        if plain <= (0 if FULL in pick else _HIGHEST):
            yield Powers(pick)


def _partitions(w: Expr) -> tuple[tuple[int, ...], ...]:
    if not w.is_Integer:
        return (*_PARTITIONS, FULL)
    kept = tuple(p for p in _PARTITIONS if len(p) <= int(w))
    return (*kept, FULL) if int(w) > 2 else kept


@cache
def _sinc2_coefficient(k: int) -> Expr:
    """s_k in sinc²(x) = Σ s_k π^2k x^2k, from (1 − cos 2πx)/(2π²x²)."""
    return Rational((-1) ** k * 2 ** (2 * k + 1), sympy.factorial(2 * k + 2))


@cache
def factor_series(factor: Factor) -> tuple[FracElement, ...]:
    """c_0, c_1, c_2 of the factor off its combs, φ(m) = Σ c_k m^2k."""
    field = factor.terms[0][0].field
    totals = [field(0)] * (_HIGHEST + 1)
    for coefficient, atom in factor.terms:
        if atom.combs:
            continue
        powers = [coefficient] + [field(0)] * _HIGHEST
        for count in atom.sincs:
            powers = _times_sinc2(powers, count, field)
        totals = [a + b for a, b in zip(totals, powers, strict=True)]
    return tuple(totals)


def _times_sinc2(
    powers: list[FracElement], count: FracElement, field: FracField
) -> list[FracElement]:
    pi2 = field.gens[0]
    sinc = [
        field(field.domain.from_sympy(_sinc2_coefficient(k))) * (pi2 / count**2) ** k
        for k in range(_HIGHEST + 1)
    ]
    return [
        sum((powers[j] * sinc[k - j] for j in range(k + 1)), field(0)) for k in range(_HIGHEST + 1)
    ]


def _term_coefficient(term: Term, powers: Powers, counts: tuple[Expr, ...]) -> Coefficient:
    factors = dict(term.factors)
    value: FracElement = term.coefficient
    bases: list[Base] = []
    for group, (partition, w) in enumerate(zip(powers.partitions, counts, strict=True)):
        if w == 0:
            continue
        if group not in factors:
            if partition:
                return {}
            continue
        coefficient, base = group_coefficient(factor_series(factors[group]), partition, w)
        if coefficient == 0:
            return {}
        value *= coefficient
        bases += base
    return {tuple(bases): value}


def group_coefficient(
    series: tuple[FracElement, ...], partition: tuple[int, ...], w: Expr
) -> tuple[FracElement, list[Base]]:
    """Coefficient of M_λ in the product of one factor over w axes, with a symbolic power."""
    one = series[0].field(1)
    if partition == FULL:
        if series[1] == 0:
            return series[1], []
        return (one, [(series[1], w)]) if not w.is_Integer else (series[1] ** int(w), [])
    value = one
    for k in partition:
        value *= series[k]
    rest = w - len(partition)
    if rest == 0 or series[0] == 1:
        return value, []
    if series[0] == 0:  # a symbolic rest is positive: FULL stands for the term without one
        return series[0], []
    if rest.is_Integer:
        return value * series[0] ** int(rest), []
    return value, [(series[0], rest)]
