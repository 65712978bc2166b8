"""Exact expected power spectra on one support as multilinear forms that do not cancel.

On one support N·P_S is a polynomial p, of degree one in each of the variables A = sinc²(m_i/n), or
another shape g(m_i/n), and T = [n divides m_i]. At low frequencies all A are close to 1 and the
plain sum loses every digit: of correlated multi-jitter only N·P_S ~ N^-2 is left. With the deficit
x = 1 − A,

    p = A p|_{A=1} + x p|_{A=0},

and so on for every variable, down to the values of p at the vertices of the unit cube, which are
exact rationals. Negative ones, where there are any, stand beside larger positive ones: the sum does
not cancel, at low frequencies or high ones. Variables that p does not depend on drop out.

w coordinates have too many vertices for large w. From three coordinates on each term c ∏ F_i, with
v_i the limit of F_i as m_i → 0, is taken as

    c ∏ F_i = c ∏ v_i · (1 − E),   E = 1 − ∏ (1 − e_i),   e_i = 1 − F_i/v_i,

where the numbers c ∏ v_i are summed exactly and E grows by positive parts, E ← e_i + (1 − e_i) E.
Terms with a v_i = 0 are small at low frequencies as they are.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from math import prod
from typing import TypeAlias

from ...theory.kernels import Atom, Factor, Kernel
from ...theory.shapes import SINC2, Shape
from .coefficients import element_fraction

_JOINT = 2  # coordinates whose vertices are interpolated together


@dataclass(frozen=True)
class Variable:
    """shape(m_axis/count), or [count divides m_axis] for a comb.

    Parameters
    ----------
    axis : int
        Index among the coordinates of the support.
    count : int
    comb : bool
    occurrence : int
        Tells the variables of a power of a shape apart.
    shape : Shape
        sinc² unless told otherwise.
    """

    axis: int
    count: int
    comb: bool
    occurrence: int = 1
    shape: Shape = SINC2


@dataclass(frozen=True)
class Interpolation:
    """variable · at_one + (1 − variable) · at_zero."""

    variable: Variable
    at_one: "Multilinear"
    at_zero: "Multilinear"


Multilinear: TypeAlias = float | Interpolation
"""A polynomial of degree one in each variable, by interpolation between its vertices."""


@dataclass(frozen=True)
class Product:
    """coefficient · ∏ factors, or coefficient · (1 − ∏ (1 − factors)) for a complement."""

    coefficient: float
    factors: tuple[Multilinear, ...]
    complement: bool = False


@dataclass(frozen=True)
class SpectrumForm:
    """N·P_S on one support: constant + Σ products, and the variables that they name."""

    constant: float
    products: tuple[Product, ...]
    variables: tuple[Variable, ...]


_Linear: TypeAlias = tuple[tuple[Fraction, frozenset[Variable]], ...]
"""A factor on one axis: coefficients, each with the variables whose product it multiplies."""

_Terms: TypeAlias = Sequence[tuple[Fraction, Sequence[_Linear]]]
"""Coefficients, each with its factors."""

_ONE: _Linear = ((Fraction(1), frozenset()),)


@lru_cache(maxsize=4096)
def spectrum_form(
    kernel: Kernel, taken: tuple[int, ...], counts: tuple[tuple[str, int], ...]
) -> SpectrumForm:
    """N·P_S on the supports with ``taken[g]`` coordinates in group g.

    Parameters
    ----------
    counts : tuple of (str, int)
        Every count of the kernel, by its name.
    """
    numbers = dict(counts)
    axes = [group for group, k in enumerate(taken) for _ in range(k)]
    terms: list[tuple[Fraction, list[_Linear]]] = []
    for term in kernel.restrict(taken):
        factors = dict(term.factors)
        linear = [
            _linear(factors[group], axis, numbers) if group in factors else _ONE
            for axis, group in enumerate(axes)
        ]
        terms.append((element_fraction(term.coefficient, numbers), linear))
    if len(axes) <= _JOINT:
        constant, products = 0.0, [Product(1.0, (_multilinear(terms),))]
    else:
        constant, products = _term_by_term(terms)
    named = {v for p in products for f in p.factors for v in _named(f)}
    return SpectrumForm(constant, tuple(products), tuple(named))


def _linear(factor: Factor, axis: int, counts: Mapping[str, int]) -> _Linear:
    return tuple(
        (element_fraction(c, counts), _variables(atom, axis, counts)) for c, atom in factor.terms
    )


def _variables(atom: Atom, axis: int, counts: Mapping[str, int]) -> frozenset[Variable]:
    combs = {Variable(axis, int(element_fraction(c, counts)), True) for c in atom.combs}
    powers = Counter((int(element_fraction(c, counts)), shape) for shape, c in atom.shapes)
    shapes = {
        Variable(axis, n, False, k + 1, g) for (n, g), top in powers.items() for k in range(top)
    }
    return frozenset(combs | shapes)


def _term_by_term(terms: _Terms) -> tuple[float, list[Product]]:
    """The constant and the products of three coordinates or more."""
    constant, products = Fraction(0), list[Product]()
    for coefficient, factors in terms:
        limits = [_vertex(f, frozenset(v for v in _all_of([f]) if not v.comb)) for f in factors]
        whole = coefficient * prod(limits)
        constant += whole
        if whole == 0:
            parts = tuple(_multilinear([(Fraction(1), [f])]) for f in factors)
            products.append(Product(float(coefficient), parts))
            continue
        shortfalls = [
            (*_ONE, *((-c / limit, variables) for c, variables in f))
            for f, limit in zip(factors, limits, strict=True)
            if f != _ONE
        ]
        if shortfalls:
            parts = tuple(_multilinear([(Fraction(1), [e])]) for e in shortfalls)
            products.append(Product(-float(whole), parts, complement=True))
    return float(constant), products


def _vertex(factor: _Linear, ones: frozenset[Variable]) -> Fraction:
    """The factor where the variables in ``ones`` are 1 and all others 0."""
    return sum((c for c, variables in factor if variables <= ones), start=Fraction(0))


def _multilinear(terms: _Terms) -> Multilinear:
    """Σ coefficient · ∏ factors."""

    def between(variables: list[Variable], ones: frozenset[Variable]) -> Multilinear:
        if not variables:
            return float(sum(c * prod(_vertex(f, ones) for f in fs) for c, fs in terms))
        first, rest = variables[0], variables[1:]
        at_zero = between(rest, ones)
        if _kept_from_one(first, ones):
            return at_zero
        at_one = between(rest, ones | {first})
        return at_zero if at_one == at_zero else Interpolation(first, at_one, at_zero)

    return between(_all_of(f for _, fs in terms for f in fs), frozenset())


def _kept_from_one(variable: Variable, ones: frozenset[Variable]) -> bool:
    """On the teeth of its own comb a sinc² is zero."""
    return (not variable.comb and variable.shape.vanishes_on_integers) and any(
        v.comb and v.axis == variable.axis and v.count % variable.count == 0 for v in ones
    )


def _all_of(factors: Iterable[_Linear]) -> list[Variable]:
    """The variables of the factors, combs first."""
    found = {v for f in factors for _, variables in f for v in variables}
    return sorted(found, key=lambda v: (not v.comb, v.axis, v.count, v.occurrence, str(v.shape)))


def _named(polynomial: Multilinear) -> set[Variable]:
    if not isinstance(polynomial, Interpolation):
        return set()
    inner = _named(polynomial.at_one) | _named(polynomial.at_zero)
    return inner | {polynomial.variable}
