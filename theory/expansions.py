"""Low-frequency expansion of a kernel on one region: terms C · m^powers · N^-decay.

On a region every factor is a power series in m_i², or, with other shapes than sinc², in rational
powers of it. The product of one factor φ = Σ_k c_k m^2k over w axes of a group is a sum of monomial
symmetric functions,

    ∏_i φ(m_i) = Σ_λ c_0^(w−ℓ(λ)) ∏_{k in λ} c_k · M_λ(m²),        λ a partition of ℓ(λ) ≤ w parts,

which also makes sense for a symbolic w (the power sums Σ m_i^2k in another basis). With u the
smallest part of a region, 1 for sinc², all orders of all groups together up to twice u are kept (1,
m², m⁴), and where a factor has c_0 = 0 the first term that does not vanish, (u, u, ..., u) of
degree 2uw. That nothing of consequence is lost is checked by the two-sided comparison of profile
and kernel in the numerics room.

Below the first alias a comb is [m = 0] and drops out; what it adds above is in ``combs.py``.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import product
from typing import TypeAlias

from .kernels import Atom, Factor, Kernel, Term
from .layouts import Layout
from .leading_powers import Base, Bases, Coefficient, leading, summed
from .regions import Region
from .shapes import Shape, series
from .symbolic import Expr, FracElement, FracField, Integer, Rational, sympy

Part: TypeAlias = int | Fraction
"""A power of m²."""

Partition: TypeAlias = tuple[Part, ...]
"""Parts in descending order, or a full partition, marked by one negative part."""

FULL: Partition = (-1,)
"""The partition (1, 1, ..., 1) with one part for each axis of the support in a group.

``(-u,)`` is the partition (u, u, ..., u) of a group whose factors have no smaller part than u.
"""

_LEVELS = 2  # orders up to so many times the smallest part are kept


@dataclass(frozen=True)
class Powers:
    """A monomial symmetric function of the m_i² of a region, one partition per group."""

    partitions: tuple[Partition, ...]

    def degree(self, counts: tuple[Expr, ...]) -> Expr:
        """Total power of |m|."""
        parts = zip(self.partitions, counts, strict=True)
        return sum((2 * (_exact(-p[0]) * w if _is_full(p) else _sum(p)) for p, w in parts), _ZERO)

    def angular_mean(self, counts: tuple[Expr, ...]) -> Expr:
        """Mean over the sphere of the support of M_λ(m²)/|m|^degree (Dirichlet moments)."""
        s = sum(counts, _ZERO)
        mean = 1 / _rising(s / 2, self.degree(counts) / 2)
        for partition, w in zip(self.partitions, counts, strict=True):
            if _is_full(partition):
                mean *= _rising(Rational(1, 2), _exact(-partition[0])) ** w
                continue
            number = sympy.ff(w, len(partition))
            for k in set(partition):
                number /= sympy.factorial(partition.count(k))
            mean *= number * sympy.prod([_rising(Rational(1, 2), _exact(k)) for k in partition])
        return sympy.cancel(sympy.expand_func(mean)) if mean.free_symbols else mean

    def text(self, names: tuple[str, ...]) -> str:
        """As in ``m_1^2 m_2^2``, ``sum m_i^2`` or ``sum |m_i|^(1/2)``; one name per group."""
        found: list[str] = []
        for partition, name in zip(self.partitions, names, strict=True):
            if _is_full(partition):
                found.append(f"prod_{name} {_power('m_i', -partition[0])}")
            elif partition:
                letters = ("m_i", "m_j")[: len(partition)]
                powers = map(_power, letters, partition)
                found.append(f"sum_{name} {' '.join(powers)}")
        return " ".join(found) or "1"


_ZERO = Integer(0)


def _is_full(partition: Partition) -> bool:
    return bool(partition) and partition[0] < 0


def _exact(part: Part) -> Expr:
    return Rational(part.numerator, part.denominator)


def _sum(partition: Partition) -> Expr:
    return sum(map(_exact, partition), _ZERO)


def _rising(base: Expr, steps: Expr) -> Expr:
    """Γ(base + steps)/Γ(base)."""
    if steps.is_Rational and not steps.is_Integer:
        return sympy.gamma(base + steps) / sympy.gamma(base)
    return sympy.rf(base, steps)


def _power(letter: str, part: Part) -> str:
    """m^(2 part), as ``m_i^2``, ``|m_i|`` or ``|m_i|^(1/2)``."""
    power = Fraction(2 * part)
    if power.denominator == 1 and power % 2 == 0:
        return f"{letter}^{power}"
    shown = f"^{power}" if power.denominator == 1 else f"^({power})"
    return f"|{letter}|" + ("" if power == 1 else shown)


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
    for powers in _indices(_parts(terms, len(counts)), counts):
        coefficient = summed(_term_coefficient(t, powers, counts) for t in terms)
        lead = leading(coefficient, layout.growth, region.assumptions)
        if lead is not None:
            found.append(SeriesTerm(powers, powers.degree(counts), sympy.expand(-lead[0]), lead[1]))
            if lead[0] == 0 and found[-1].degree == 0:
                break  # flat from the start: no other term can rise above it
    return Series(counts, tuple(found))


def _parts(terms: tuple[Term, ...], groups: int) -> list[list[Part]]:
    """The positive powers of m² in the factors of each group, ascending."""
    found: list[set[Part]] = [set() for _ in range(groups)]
    for term in terms:
        for group, factor in term.factors:
            found[group] |= {k for k in factor_series(factor) if k > 0}
    return [sorted(parts) for parts in found]


def _indices(parts: list[list[Part]], counts: tuple[Expr, ...]) -> Iterator[Powers]:
    """Partitions per group with total at most twice the smallest part, and full ones."""
    highest = _LEVELS * min((group[0] for group in parts if group), default=0)
    choices = [_partitions(group, w, highest) for group, w in zip(parts, counts, strict=True)]
    for pick in product(*choices):
        is_full = any(map(_is_full, pick))
        if sum(sum(p) for p in pick if not _is_full(p)) <= (0 if is_full else highest):
            yield Powers(pick)


def _partitions(parts: list[Part], w: Expr, highest: Part) -> list[Partition]:
    """Of one group: no part, one, two of the smallest, and the full partition."""
    if not parts or w == 0:
        return [()]
    smallest = parts[0]
    kept: list[Partition] = [(), *((k,) for k in parts if k <= highest)]
    few = int(w) if w.is_Integer else 3
    if few > 1 and 2 * smallest <= highest:
        kept.append((smallest, smallest))
    return [*kept, (-smallest,)] if few > 2 else kept


AxisSeries: TypeAlias = Mapping[Part, tuple[FracElement, Bases]]
"""c_k by k, in φ(m) = Σ c_k |m|^2k: an element of the field, times powers of counts outside it."""


@cache
def factor_series(factor: Factor) -> AxisSeries:
    """The series of a factor off its combs, to twice its smallest positive power; c_0 always."""
    field = factor.terms[0][0].field
    plain = [(c, atom) for c, atom in factor.terms if not atom.combs]
    degrees = [shape.degree for _, atom in plain for shape, _ in atom.shapes]
    highest = _LEVELS * min(degrees, default=Fraction(0))
    total: dict[Part, tuple[FracElement, Bases]] = {Fraction(0): (field(0), ())}
    for coefficient, atom in plain:
        for part, (value, bases) in _atom_series(atom, highest, field).items():
            before, same = total.get(part, (field(0), bases))
            if same != bases:
                raise ValueError(f"powers of counts must agree to be added: got {same}, {bases}")
            total[part] = before + coefficient * value, bases
    return total


def _atom_series(atom: Atom, highest: Fraction, field: FracField) -> AxisSeries:
    """∏ g(m/n): the shapes of one count multiplied first, as their powers of |m|/n join."""
    total: dict[Part, tuple[FracElement, Bases]] = {Fraction(0): (field(1), ())}
    for count in dict.fromkeys(n for _, n in atom.shapes):
        own = _joined([shape for shape, n in atom.shapes if n == count], highest, field)
        found: dict[Part, tuple[FracElement, Bases]] = {}
        for (part, (value, bases)), (power, number) in product(total.items(), own.items()):
            if (joined := part + power / 2) > highest / 2:
                continue
            if power.denominator == 1:
                number, outside = number / count ** int(power), bases
            else:
                outside = (*bases, (count, -_exact(power)))
            before, _ = found.get(joined, (field(0), ()))
            found[joined] = before + value * number, outside
        total = found
    return total


def _joined(
    shapes: list[Shape], highest: Fraction, field: FracField
) -> dict[Fraction, FracElement]:
    """The product of shapes of one x, in powers of |x|."""
    total: dict[Fraction, FracElement] = {Fraction(0): field(1)}
    for shape in shapes:
        found: dict[Fraction, FracElement] = {}
        for (power, value), term in product(total.items(), series(shape, highest)):
            if (joined := power + term.power) <= highest:
                number = field(term.rational.numerator) / field(term.rational.denominator)
                part = value * number * field.gens[0] ** term.half_pi
                found[joined] = found.get(joined, field(0)) + part
        total = found
    return total


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
    series: AxisSeries, partition: Partition, w: Expr
) -> tuple[FracElement, list[Base]]:
    """Coefficient of M_λ in the product of one factor over w axes, with a symbolic power."""
    at_zero = series[0][0]
    nothing = at_zero * 0, ()
    if _is_full(partition):
        smallest, outside = series.get(-partition[0], nothing)
        if smallest == 0:
            return smallest, []
        own, value = (
            ([], smallest ** int(w)) if w.is_Integer else ([(smallest, w)], at_zero * 0 + 1)
        )
        return value, [*own, *((base, power * w) for base, power in outside)]
    value, bases = at_zero * 0 + 1, list[Base]()
    for k in partition:
        coefficient, outside = series.get(k, nothing)
        value, bases = value * coefficient, [*bases, *outside]
    rest = w - len(partition)
    if rest == 0 or at_zero == 1:
        return value, bases
    if at_zero == 0:  # a symbolic rest is positive: a full partition stands for the term without
        return at_zero, []
    if rest.is_Integer:
        return value * at_zero ** int(rest), bases
    return value, [*bases, (at_zero, rest)]
