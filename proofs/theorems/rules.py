"""Rules that make spectra from spectra: padding, shear, and averages over designs.

Padding: two sets of N points, their orders joined at random, put each ordered pair of different
points of the one over each of the other equally often. With α_j, β_a the phases 2πm·s of a
frequency in the coordinates of the one and of the other, Q_α = Σ_j Σ_k cos(α_j − α_k) = N² P_α,

    Σ_j Σ_k Σ_a Σ_b cos(α_j − α_k + β_a − β_b) = Q_α Q_β,
    P_S = 1/N + (1 − 1/N) q_α q_β,      q = (N P − 1)/(N − 1),

where the sum over j ≠ k, a ≠ b is Q_α Q_β − N Q_α − N Q_β + N². Shear: with (x, y) goes
(x, y + c x mod 1), c whole, and P(m_1, m_2) becomes P(m_1 + c m_2, m_2); every integer matrix of
determinant 1 is a product of such shears. Averages: the variance is linear in the spectrum.
"""

from functools import cache
from typing import Any

from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from .shifts import K, W, X, ell, exchanged, instance, k, renamed, w, weight
from .strata import cos, pi, sin, sizes
from .tactics import ONE, ZERO, chain, combine, real, whole

N, gamma, a, b, m_1, m_2, c, turns, u, v, other = real("N gamma a b m_1 m_2 c w u v r")
alpha, beta, x, y, rest, wraps = (sympy.Function(s) for s in ("alpha", "beta", "x", "y", "r", "w"))
share, spectrum = sympy.Function("s"), sympy.Function("P")
TWO = sympy.Integer(2)
_INDEX = (*whole(k), Claim(ONE, "<=", k))
SIZE = sizes(N)


def total(f: Expr, index: Symbol) -> Expr:
    """Σ f over the N points."""
    return sympy.Sum(f, (index, 1, N))


def power_of(phases: Any, index: Symbol) -> Expr:
    """(Σ cos)² + (Σ sin)² = N² P."""
    return sympy.Add(*(total(f(phases(index)), index) ** 2 for f in (cos, sin)))


@cache
def pairs(phases: Any, outer: Symbol, inner: Symbol) -> Step:
    """Σ_outer Σ_inner cos(γ + phase − phase) = cos γ (C² + S²)."""
    inside = (*SIZE, *_point(outer))
    here = gamma + phases(outer)
    parts = ((cos(here), cos(phases(inner))), (sin(here), sin(phases(inner))))
    term = cos(here - phases(inner))
    line = sympy.Add(*(s * total(f, inner) for s, f in parts))
    row = Step(Claim(total(term, inner), "=", line, inside), by.Linear(parts))
    left, lines = total(row.claim.left, outer), total(line, outer)
    rows = Step(Claim(left, "=", lines, SIZE), by.Bind(), (row,))
    even, odd = (total(f(phases(inner)), inner) for f in (cos, sin))
    split = (
        (cos(gamma) * even + sin(gamma) * odd, cos(phases(outer))),
        (cos(gamma) * odd - sin(gamma) * even, sin(phases(outer))),
    )
    sums = sympy.Add(*(s * total(f, outer) for s, f in split))
    columns = Step(Claim(lines, "=", sums, SIZE), by.Linear(split))
    names = [
        instance(renamed(inner, outer), SIZE, (K, N), (X, sympy.Lambda(inner, f(phases(inner)))))
        for f in (cos, sin)
    ]
    claim = Claim(left, "=", cos(gamma) * power_of(phases, inner), SIZE)
    uses = ((-s, n) for (s, _), n in zip(split, names, strict=True))
    return combine(claim, (1, rows), (1, columns), *uses)


def _point(index: Symbol) -> tuple[Claim, ...]:
    return (*whole(index), Claim(ONE, "<=", index), Claim(index, "<=", N))


@cache
def all_pairs_of_both() -> Step:
    """Σ_l Σ_k Σ_a Σ_b cos(α_l − α_k + β_a − β_b) = Q_β Σ_l Σ_k cos(α_l − α_k)."""
    apart, power = alpha(ell) - alpha(k), power_of(beta, b)
    outer = (*SIZE, *_point(ell))
    inner = (*outer, *_point(k))
    moved = pairs(beta, a, b).claim.at((gamma, apart))
    both = Step(
        Claim(moved.left, "=", moved.right, inner), by.Instance(((gamma, apart),)),
        (pairs(beta, a, b),),
    )  # fmt: skip
    row = Step(Claim(total(moved.left, k), "=", total(moved.right, k), outer), by.Bind(), (both,))
    waves = total(cos(apart), k)
    out = Step(Claim(row.claim.right, "=", power * waves, outer), by.Linear(((power, cos(apart)),)))
    line = chain(Claim(row.claim.left, "=", power * waves, outer), row, out)
    rows = Step(
        Claim(total(row.claim.left, ell), "=", total(power * waves, ell), SIZE), by.Bind(), (line,)
    )
    value = power * total(waves, ell)
    scale = Step(Claim(rows.claim.right, "=", value, SIZE), by.Linear(((power, waves),)))
    return chain(Claim(rows.claim.left, "=", value, SIZE), rows, scale)


@cache
def padding() -> Step:
    """P_S of two sets joined in random order, from their own spectra."""
    given = (*whole(N), Claim(TWO, "<=", N))
    both = instance(all_pairs_of_both(), given)
    own, other = (
        instance(pairs(*which), given, (gamma, ZERO)) for which in ((alpha, ell, k), (beta, a, b))
    )
    powers = power_of(alpha, k), power_of(beta, b)
    different = both.claim.left - N * own.claim.left - N * other.claim.left + N**2
    scale = 1 / (N**3 * (N - 1))
    shares = [(p / N - 1) / (N - 1) for p in powers]
    least = Step(Claim(TWO, "<=", N, given), by.Given())
    known = [combine(Claim(ZERO, "<", N - s, given), (1, least), remainder=2 - s) for s in (0, 1)]
    right = 1 / N + (1 - 1 / N) * shares[0] * shares[1]
    return combine(
        Claim(1 / N + different * scale, "=", right, given),
        (scale, both), (scale * (powers[1] - N), own), (-scale * N, other),
        *((0, s) for s in known),
    )  # fmt: skip


def _sheared(f: Any) -> Step:
    """A wave of the sheared points, phase r in the other coordinates, at one point."""
    given = whole(m_2, c, turns)
    new = v + c * u - turns
    left = f(other + 2 * pi * (m_1 * u + m_2 * new))
    right = f(other + 2 * pi * ((m_1 + c * m_2) * u + m_2 * v))
    return combine(Claim(left, "=", right, given))


@cache
def shear() -> Step:
    """P(m_1, m_2) of the points (x, y + c x − w) is P(m_1 + c m_2, m_2) of the points (x, y)."""
    about = Claim(wraps(k), "whole", ZERO, _INDEX, over=(k,))
    given = (about, *whole(m_2, c), *SIZE)
    inside = (*given, *_point(k))
    here = Step(Claim(wraps(k), "whole", ZERO, inside), by.Given())
    values = ((u, x(k)), (v, y(k)), (turns, wraps(k)), (other, rest(k)))
    uses: list[tuple[Expr, Step]] = []
    for f in (cos, sin):
        moved = _sheared(f).claim.at(*values)
        point = Step(
            Claim(moved.left, "=", moved.right, inside), by.Instance(values), (_sheared(f), here)
        )
        sums = total(moved.left, k), total(moved.right, k)
        both = Step(Claim(sums[0], "=", sums[1], given), by.Bind(), (point,))
        uses.append(((sums[0] + sums[1]) / N**2, both))
    sides = (sympy.Add(*(getattr(s.claim, side) ** 2 for _, s in uses)) / N**2
             for side in ("left", "right"))  # fmt: skip
    least = Step(Claim(ONE, "<=", N, given), by.Given())
    large = combine(Claim(ZERO, "<", N, given), (1, least), remainder=1)
    return combine(Claim(next(sides), "=", next(sides), given), *uses, (0, large))


@cache
def average() -> Step:
    """Σ_ω w_ω Σ_k s_k P_k(ω) = Σ_k s_k Σ_ω w_ω P_k(ω): a design drawn at random from designs."""
    given = (*sizes(W), *whole(K), Claim(ONE, "<=", K))
    designs = (*given, *whole(w), Claim(ONE, "<=", w), Claim(w, "<=", W))
    modes = (*given, *whole(k), Claim(ONE, "<=", k), Claim(k, "<=", K))
    cell = share(k) * spectrum(w, k)
    one = sympy.Sum(cell, (k, 1, K))
    term = sympy.Sum(weight(w) * cell, (k, 1, K))
    inner = Step(Claim(term, "=", weight(w) * one, designs), by.Linear(((weight(w), cell),)))
    back = chain_back(inner)
    rows = Step(
        Claim(sympy.Sum(weight(w) * one, (w, 1, W)), "=", sympy.Sum(term, (w, 1, W)), given),
        by.Bind(), (back,),
    )  # fmt: skip
    swapped = exchanged(weight(w) * cell, w, W, k, given)
    expected = sympy.Sum(weight(w) * spectrum(w, k), (w, 1, W))
    column = Step(
        Claim(sympy.Sum(weight(w) * cell, (w, 1, W)), "=", share(k) * expected, modes),
        by.Linear(((share(k), weight(w) * spectrum(w, k)),)),
    )
    columns = Step(
        Claim(swapped.claim.right, "=", sympy.Sum(share(k) * expected, (k, 1, K)), given),
        by.Bind(), (column,),
    )  # fmt: skip
    return chain(Claim(rows.claim.left, "=", columns.claim.right, given), rows, swapped, columns)


def chain_back(equation: Step) -> Step:
    """g = f from f = g."""
    c = equation.claim
    return combine(Claim(c.right, "=", c.left, c.given), (-1, equation))
