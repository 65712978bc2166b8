r"""Integrals of the disk's covariogram over rectangles with affine densities, by their boundary.

With J(z) = (arccos z - z √(1 - z²))/2 for z <= 1 and 0 beyond (lengths in units of 2R) and

    G_m(z) = z^-(m+2) ∫_0^z t^(m+1) J(t) dt,     div(x · x_1^i x_2^j G_{i+j}(|x|)) = x_1^i x_2^j J,

the integral of a monomial over a rectangle is the flux through its sides, to which sides on the
coordinate axes give nothing. On a side x_1 = b the integrand is b^{i+1} y^j G_m(√(b² + y²)):
analytic in φ up to the circle z = 1, with y = √(1 - b²) sin φ (near the foot of a long side in u,
y = b sinh u), and beyond it, where G_m = K_m z^-(m+2), elementary in the angle arctan(y/b).
"""

from collections.abc import Callable
from dataclasses import dataclass
from itertools import permutations
from typing import TypeAlias

from ..balls import Ball, Rational, flint, integrated

Jump: TypeAlias = tuple[Rational, Rational]
"""Of the density constant + slope x at a break: below minus above."""

_ROUNDED_BITS = 15  # by which an integral's tolerance lies above the last bit
_SMALL_BITS = 8
_SMALL = 2.0**-_SMALL_BITS  # distance below which a series replaces formulas that cancel
_STEEP = 4  # a side this many times longer than its distance has √(b² + y²) steep at its foot


@dataclass(frozen=True)
class Piece:
    """The density ``constant + slope x`` on start <= x <= end, start >= 0."""

    start: Rational
    end: Rational
    constant: Rational
    slope: Rational


def breaks(
    pieces: tuple[Piece, ...],
) -> list[tuple[Rational, Jump]]:
    """Where pieces end, b > 0, and the jump there."""
    jumps: dict[Rational, Jump] = {}
    for piece in pieces:
        for b, sign in ((piece.start, -1), (piece.end, 1)):
            c, s = jumps.get(b, (0, 0))
            jumps[b] = (c + sign * piece.constant, s + sign * piece.slope)
    return [(b, jump) for b, jump in jumps.items() if b > 0]


def disk_flux(axes: tuple[tuple[Piece, ...], ...]) -> Ball:
    """∫∫ g(x) h(y) J(√(x² + y²)) dx dy over x, y >= 0, for the densities of the two axes."""
    total = flint.arb(0)
    for across, along in permutations(axes):
        for b, jump in breaks(across):
            for piece in along:
                total += _side(b, jump, piece)
    return total


def _side(b: Rational, jump: Jump, piece: Piece) -> Ball:
    """Flux through the side x = b along a piece of the other axis."""
    weights = [[flint.arb(g * h) for h in (piece.constant, piece.slope)] for g in jump]
    half2 = 1 - b**2  # squared half of the chord x = b of the circle
    start, end = flint.arb(piece.start), flint.arb(piece.end)
    total = flint.arb(0)
    if piece.start**2 < half2:
        half = flint.arb(half2).sqrt()
        total = _inside(weights, b, half, *(_angle(y, half2) for y in (piece.start, piece.end)))
        start = half
    if piece.end**2 > half2:
        total += _outside(weights, flint.arb(b), start, end)
    return total


def _angle(y: Rational, half2: Rational) -> Ball:
    """arcsin(y/√half2), or π/2 where y lies beyond."""
    if y**2 >= half2:
        return flint.arb.pi() / 2
    return flint.arb.atan2(flint.arb(y), flint.arb(half2 - y**2).sqrt())


def _inside(weights: list[list[Ball]], b: Rational, half: Ball, start: Ball, end: Ball) -> Ball:
    """∫ Σ g_i h_j b^{i+1} y^j G_{i+j} dy, z <= 1, from angle start to end with y = half · sin φ."""
    (w00, w01), (w10, w11) = weights
    near, near2, quarter_turn = flint.arb(b), flint.arb(b**2), flint.arb.pi() / 2
    i = flint.acb(0, 1)

    def flux(y: Ball, z: Ball, t: Ball, analytic: bool) -> Ball:
        """Of z² = b² + y² and t² = 1 - z²."""
        angle = -i * (z + i * t).log(analytic=analytic)  # arccos z
        zt, t2 = z * t, t * t
        j = (angle - zt) / 2
        if z.abs_upper() < _SMALL:
            m0, m1, m2 = _small_moments(z)
        else:
            z2 = z * z
            a0 = (zt + quarter_turn - angle) / 2  # ∫_0^z √(1 - τ²) dτ
            a2 = (a0 - zt * t2) / 4
            a3 = (2 - t * t2 * (5 - 3 * t2)) / 15
            a4 = (3 * a2 - zt * z2 * t2) / 6
            m0, m1, m2 = a2 / z2, a3 / (z * z2), a4 / (z2 * z2)
        g0, g1, g2 = (j + m0) / 2, (j + m1) / 3, (j + m2) / 4
        return w00 * g0 + (w10 * near + w01 * y) * g1 + w11 * near * y * g2

    def along_angle(phi: Ball, analytic: bool) -> Ball:
        y, t = half * phi.sin(), half * phi.cos()
        return t * flux(y, (near2 + y * y).sqrt(analytic=analytic), t, analytic)

    def along_area(u: Ball, analytic: bool) -> Ball:
        sinh, cosh = u.sinh_cosh()
        y, z = near * sinh, near * cosh
        return z * flux(y, z, (1 - z * z).sqrt(analytic=analytic), analytic)

    middle = flint.arb.pi() / 6
    if not half > _STEEP * near or not middle > start:
        return near * integral(along_angle, start, end)
    middle = flint.arb.min(middle, end)
    first, last = ((half * phi.sin() / near).asinh() for phi in (start, middle))
    steep = integral(along_area, first, last)
    return near * (steep + integral(along_angle, middle, end))


def _small_moments(z: Ball) -> tuple[Ball, Ball, Ball]:
    """z^-n ∫_0^z τ^n √(1 - τ²) dτ = z Σ_j binom(1/2, j) (-z²)^j/(2j + n + 1) for n = 2, 3, 4.

    As |binom(1/2, j)| <= 1, what follows k terms is at most |z|^(2k+1)/(1 - |z|²).
    """
    size = z.abs_upper()
    z2, power, totals = z * z, z, [flint.acb(0)] * 3
    terms = 1 + flint.ctx.prec // (2 * _SMALL_BITS)
    for j in range(terms):
        totals = [total + power / (2 * j + n) for n, total in enumerate(totals, 3)]
        power = power * z2 * (2 * j - 1) / (2 * j + 2)
    tail = flint.arb(0, (size ** (2 * terms + 1) / (1 - size**2)).upper())
    return tuple(total + flint.acb(tail, tail) for total in totals)


def _outside(weights: list[list[Ball]], b: Ball, start: Ball, end: Ball) -> Ball:
    """The same for z >= 1: ∫ g_i h_j K_{i+j} cos^i φ sin^j φ dφ with tan φ = y/b."""
    (w00, w01), (w10, w11) = weights
    eighth_pi = flint.arb.pi() / 8
    k0, k1, k2 = eighth_pi / 4, flint.arb(2) / 45, eighth_pi / 16

    def primitive(y: Ball) -> Ball:
        z = (b**2 + y**2).sqrt()
        sine, cosine = y / z, b / z
        angle = flint.arb.atan2(y, b)
        return k0 * w00 * angle + k1 * (w10 * sine - w01 * cosine) + k2 * w11 * sine**2 / 2

    return primitive(end) - primitive(start)


def integral(integrand: Callable[[Ball, bool], Ball], start: Ball, end: Ball) -> Ball:
    """∫ of a function that is real on the line, with a proven error (Johansson 2018).

    The tolerance lies a few bits above the rounding: a larger precision lowers both.
    """
    tolerance = flint.arb(2) ** (_ROUNDED_BITS - flint.ctx.prec)
    return integrated(integrand, start, end, abs_tol=tolerance)
