"""Low-frequency expansion of a kernel on one region: terms C · m^powers · N^-decay.

On a region every factor is a power series in m_i², since sinc²(x) = Σ_k s_k π^2k x^2k. The
product of one factor φ = Σ_k c_k m^2k over w axes of a group is a sum of monomial symmetric
functions,

    ∏_i φ(m_i) = Σ_λ c_0^(w−ℓ(λ)) ∏_{k in λ} c_k · M_λ(m²),        λ a partition of ℓ(λ) ≤ w parts,

which also makes sense for a symbolic w (the power sums Σ m_i^2k in another basis). The orders
1, m², m⁴ of all groups together are kept, and where a factor has c_0 = 0 the first term that
does not vanish, (1, 1, ..., 1) of degree 2w. That nothing of consequence is lost is checked by the
two-sided comparison of profile and kernel in the numerics room.

Below the first alias a comb is [m = 0] and drops out; what it adds above is kept as its mean.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cache, reduce
from itertools import product
from operator import add

from .errors import UndecidedSign
from .kernels import Factor, Kernel, Term
from .layouts import Growth, Layout
from .regions import Region
from .signs import Assumptions, nonnegative
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
class Comb:
    """Mean of a comb above its first alias: constant · N^height for |m| >= scale · N^threshold."""

    threshold: Expr
    height: Expr
    constant: Expr
    scale: Expr = Integer(1)


@dataclass(frozen=True)
class Series:
    """Low-frequency terms of N·P_S on a region, and its combs."""

    counts: tuple[Expr, ...]
    terms: tuple[SeriesTerm, ...]
    combs: tuple[Comb, ...]


# A coefficient is a sum of field elements times symbolic powers of field elements.
_Base = tuple[FracElement, Expr]
_Bases = tuple[_Base, ...]
_Coefficient = dict[_Bases, FracElement]


def expand(kernel: Kernel, layout: Layout, region: Region) -> Series:
    """Low-frequency expansion of a kernel on a region."""
    counts = tuple(region.counts)
    terms = kernel.restrict(counts)
    found: list[SeriesTerm] = []
    for powers in _indices(counts):
        coefficient = _summed(_term_coefficient(t, powers, counts) for t in terms)
        lead = _leading(coefficient, layout.growth, region.assumptions)
        if lead is not None:
            found.append(SeriesTerm(powers, powers.degree(counts), sympy.expand(-lead[0]), lead[1]))
            if lead[0] == 0 and found[-1].degree == 0:
                break  # flat from the start: no other term can rise above it
    return Series(counts, tuple(found), tuple(_combs(terms, layout, region)))


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
def _series(factor: Factor) -> tuple[FracElement, ...]:
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


def _term_coefficient(term: Term, powers: Powers, counts: tuple[Expr, ...]) -> _Coefficient:
    factors = dict(term.factors)
    value: FracElement = term.coefficient
    bases: list[_Base] = []
    for group, (partition, w) in enumerate(zip(powers.partitions, counts, strict=True)):
        if w == 0:
            continue
        if group not in factors:
            if partition:
                return {}
            continue
        coefficient, base = _group_coefficient(_series(factors[group]), partition, w)
        if coefficient == 0:
            return {}
        value *= coefficient
        bases += base
    return {tuple(bases): value}


def _group_coefficient(
    series: tuple[FracElement, ...], partition: tuple[int, ...], w: Expr
) -> tuple[FracElement, list[_Base]]:
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


def _summed(coefficients: Iterator[_Coefficient]) -> _Coefficient:
    total: _Coefficient = {}
    for coefficient in coefficients:
        for bases, value in coefficient.items():
            total[bases] = total[bases] + value if bases in total else value
    return {b: v for b, v in total.items() if v != 0}


def _leading(
    coefficient: _Coefficient, growth: Mapping[str, Growth], assumptions: Assumptions
) -> tuple[Expr, Expr] | None:
    """Largest power of N in a coefficient and its constant; None for a zero coefficient."""
    found: list[tuple[Expr, Expr]] = []
    for bases, value in coefficient.items():
        exponent, constant = leading_power(value, growth, assumptions)
        for base, power in bases:
            e, c = leading_power(base, growth, assumptions)
            exponent, constant = exponent + power * e, constant * c**power
        found.append((sympy.expand(exponent), constant))
    return _largest(found, assumptions) if found else None


def leading_power(
    element: FracElement, growth: Mapping[str, Growth], assumptions: Assumptions = ()
) -> tuple[Expr, Expr]:
    """(a, C) with element ~ C N^a under the growth laws of its counts."""
    over = _leading_of_polynomial(element.numer, growth, assumptions)
    under = _leading_of_polynomial(element.denom, growth, assumptions)
    return over[0] - under[0], over[1] / under[1]


def _leading_of_polynomial(
    polynomial: FracElement, growth: Mapping[str, Growth], assumptions: Assumptions
) -> tuple[Expr, Expr]:
    laws = [growth[str(s)] for s in polynomial.ring.symbols[1:]]
    found: list[tuple[Expr, Expr]] = []
    for (half_pi, *powers), number in polynomial.terms():
        exponent, constant = (
            Integer(0),
            sympy.pi ** (2 * half_pi) * Rational(number.numerator, number.denominator),
        )
        for law, k in zip(laws, powers, strict=True):
            if k:
                exponent, constant = exponent + k * law.exponent, constant * law.constant**k
        found.append((sympy.expand(exponent), constant))
    return _largest(found, assumptions)


def _largest(terms: list[tuple[Expr, Expr]], assumptions: Assumptions) -> tuple[Expr, Expr]:
    """The largest exponent with the sum of its constants; sums that vanish are passed over."""
    sums: dict[Expr, Expr] = {}
    for exponent, constant in terms:
        sums[exponent] = sums.get(exponent, Integer(0)) + constant
    left = [(e, c) for e, c in sums.items() if c != 0]
    best = left[0]
    for candidate in left[1:]:
        larger = nonnegative(candidate[0] - best[0], assumptions)
        if larger is None and not nonnegative(best[0] - candidate[0], assumptions):
            raise UndecidedSign(
                "powers of N must be comparable: the sign of "
                f"{candidate[0] - best[0]} varies for {', '.join(map(str, assumptions))}"
            )
        best = candidate if larger else best
    return best


def _combs(terms: tuple[Term, ...], layout: Layout, region: Region) -> Iterator[Comb]:
    """The mean that each set of comb axes adds above its first alias."""
    heights: dict[_Bases, list[_Coefficient]] = {}
    for term in terms:
        for combs, coefficient in _comb_terms(term, region.counts):
            heights.setdefault(combs, []).append(coefficient)
    for combs, parts in heights.items():
        lead = _leading(_summed(iter(parts)), layout.growth, region.assumptions)
        if lead is None:
            continue
        height, constant = lead
        threshold, scale = Integer(0), Integer(1)
        for count, axes in combs:  # the comb meets one frequency in n on each of its axes
            exponent, factor = leading_power(count, layout.growth, region.assumptions)
            height, constant = height - axes * exponent, constant / factor**axes
            if exponent == threshold:
                scale = sympy.Max(scale, factor)
            elif nonnegative(exponent - threshold, region.assumptions):
                threshold, scale = exponent, factor
        yield Comb(threshold, sympy.expand(height), constant, scale)


def _comb_terms(term: Term, counts: tuple[Expr, ...]) -> Iterator[tuple[_Bases, _Coefficient]]:
    """Choices of comb axes in a term: (count, number of axes) and the coefficient at m = 0."""
    choices = [list(_comb_choices(factor, counts[g])) for g, factor in term.factors]
    for pick in product(*choices):
        combs = tuple(c for combs, _ in pick for c in combs)
        if combs:
            value: FracElement = term.coefficient
            bases: list[_Base] = []
            for _, (coefficient, base) in pick:
                value, bases = value * coefficient, bases + base
            if value != 0:
                yield combs, {tuple(bases): value}


def _comb_choices(
    factor: Factor, w: Expr
) -> Iterator[tuple[_Bases, tuple[FracElement, list[_Base]]]]:
    """For one group: no comb at all, or all w axes on a comb (mixed only for w = 1)."""
    plain = Factor(tuple((c, a) for c, a in factor.terms if not a.combs))
    if plain.terms:
        yield (), _group_coefficient(_series(plain), (), w)
    counts = sorted({n for _, a in factor.terms for n in a.combs}, key=str)
    if counts and plain.terms and w != Integer(1):
        raise ValueError(f"a comb beside other terms must stand on a group of one axis: got {w}")
    for count in counts:
        field = factor.terms[0][0].field
        value = reduce(add, (c for c, a in factor.terms if a.combs == (count,)), field(0))
        yield ((count, w),), ((value ** int(w), []) if w.is_Integer else (field(1), [(value, w)]))
