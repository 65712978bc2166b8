"""Exact variances of ridges f(x) = B_b({k·x}): sums of the kernel over the multiples of k.

N·Var = Σ_{j≠0} K(j k) b!²/(2πj)^(2b). On the support of k the kernel is a sum of products over the
coordinates i of sinc²(j k_i/n), of combs, n | j k_i where n/gcd(n, k_i) | j, and of both. With
s = k_i/n

    sinc²(j s) = s^-2 (2πj)^-2 (2 − e^(2πijs) − e^(−2πijs)),

so that a product of them is a short sum of waves e^(2πijh) (2πj)^(−2q) on the multiples j of a
comb: every sum is a rational combination of the K_(q+b)(h) of the splines, and is taken as such.
"""

from collections import defaultdict
from collections.abc import Mapping
from math import factorial, gcd, lcm
from typing import TypeAlias

from ...theory.errors import InputError
from ...theory.kernels import Atom, Term
from ...theory.samplers import Sampler
from ...theory.shapes import SINC2
from ..balls import Ball, Rational, certified, flint
from ..expected_spectra.spectra import support_counts
from ..expected_spectra.spectrum_balls import element_rational
from ..integrands.ridge import Ridge
from ..integrands.spline import cosine_sum
from .axis_measures import OutOfReach

_MOST_WAVES = 100_000

Waves: TypeAlias = Mapping[tuple[int, int, Rational], Rational]
"""Coefficients of [comb | j] e^(2πijh) (2πj)^(−2q), by (q, comb, h), 0 <= h < 1."""


def ridge_variance(sampler: Sampler, counts: Mapping[str, int], ridge: Ridge, digits: int) -> Ball:
    """Variance with a relative radius below 10^-digits; the rational value rounded.

    Raises
    ------
    OutOfReach
        If the spectrum has shapes other than sinc².
    InputError
        If the product over the coordinates has more than 100 000 waves: too many different k_i.
    """
    assert sampler.kernel is not None
    support = ridge.support
    total = flint.fmpq(0)
    for term in sampler.kernel.restrict(support_counts(sampler.layout, support)):
        waves = _term_waves(term, sampler, counts, ridge)
        scale = element_rational(term.coefficient, counts)
        total += scale * _summed(waves, ridge.b)
    exact = total * factorial(ridge.b) ** 2 / counts["N"]
    return certified(lambda: flint.arb(exact), digits)


def _term_waves(term: Term, sampler: Sampler, counts: Mapping[str, int], ridge: Ridge) -> Waves:
    """A term of the kernel along the ridge, without its coefficient."""
    waves: Waves = {(0, 1, flint.fmpq(0)): flint.fmpq(1)}
    for group, factor in term.factors:
        axes = sampler.layout.groups[group]
        first = int(axes.first)
        for i in ridge.support:
            if not first <= i < first + int(axes.size):
                continue
            found: dict[tuple[int, int, Rational], Rational] = defaultdict(flint.fmpq)
            for coefficient, atom in factor.terms:
                scale = element_rational(coefficient, counts)
                for key, value in _atom_waves(atom, counts, abs(ridge.k[i - 1])).items():
                    found[key] += scale * value
            waves = _product(waves, found)
    return waves


def _atom_waves(atom: Atom, counts: Mapping[str, int], k: int) -> Waves:
    """An atom of the kernel at the frequencies j k, j ≠ 0."""
    others = [shape.kind for shape, _ in atom.shapes if shape != SINC2]
    if others:
        rule = "the closed form along a ridge must have a spectrum of sinc² and combs alone"
        raise OutOfReach(f"{rule}: got the shape {others[0]}")
    waves: Waves = {(0, 1, flint.fmpq(0)): flint.fmpq(1)}
    for element in atom.combs:
        n = int(element_rational(element, counts).p)
        waves = _product(waves, {(0, n // gcd(n, k), flint.fmpq(0)): flint.fmpq(1)})
    for element in atom.sincs:
        s = k / element_rational(element, counts)
        lobes: dict[tuple[int, int, Rational], Rational] = defaultdict(flint.fmpq)
        for h, weight in ((flint.fmpq(0), 2), (s, -1), (-s, -1)):
            lobes[1, 1, h - h.floor()] += weight / s**2
        waves = _product(waves, lobes)
    return waves


def _product(first: Waves, second: Waves) -> Waves:
    waves = len(first) * len(second)
    if waves > _MOST_WAVES:
        raise InputError(
            f"the spectrum along a ridge must have at most {_MOST_WAVES} waves, so fewer different "
            f"k_i: got {waves}"
        )
    found: dict[tuple[int, int, Rational], Rational] = defaultdict(flint.fmpq)
    for (q, comb, h), value in first.items():
        for (q2, comb2, h2), value2 in second.items():
            shift = h + h2
            found[q + q2, lcm(comb, comb2), shift - shift.floor()] += value * value2
    return found


def _summed(waves: Waves, b: int) -> Rational:
    """Σ over j ≠ 0 of the waves times (2πj)^(−2b)."""
    even: dict[tuple[int, int, Rational], Rational] = defaultdict(flint.fmpq)
    for (q, comb, h), value in waves.items():
        even[q + b, comb, min(h, 1 - h)] += value
    return sum(
        (
            v * cosine_sum(q, comb * h) / flint.fmpq(comb) ** (2 * q)
            for (q, comb, h), v in even.items()
        ),
        flint.fmpq(0),
    )
