r"""Integrals of the ball's covariogram over boxes with affine densities, by their edges.

In three dimensions J(z) = 2/3 - z + z³/3 = Σ c_p z^p for z <= 1 and 0 beyond (lengths in units of
2R). With m = i + j + k and q = j + k,

    G_m(z) = z^-(m+3) ∫_0^z t^(m+2) J(t) dt:  Σ c_p z^p/(m + p + 3) inside, K_m z^-(m+3) outside,

the integral of x_1^i x_2^j x_3^k J over a box is the flux of x times the monomial times G_m through
its faces. On a face x_1 = a the same step, around the foot of the perpendicular from 0, leads on to
its edges: with s² = b² + x_3² on the edge x_2 = b,

    ∫ a^{i+1} b^{j+1} x_3^k s^-(q+2) V dx_3,    V = ∫_0^s t^(q+1) G_m(√(a² + t²)) dt,

where V is elementary. Faces and edges in the coordinate planes give nothing.
"""

from collections import Counter
from collections.abc import Callable
from itertools import permutations
from typing import TypeAlias

from ..balls import Ball, Rational, flint
from .disk_fluxes import Jump, Piece, breaks, integral

_SERIES = ((0, flint.fmpq(2, 3)), (1, flint.fmpq(-1)), (3, flint.fmpq(1, 3)))  # p, c_p

Values: TypeAlias = tuple[Ball, Ball, Ball]
Profile: TypeAlias = Callable[[Ball, Ball, bool], Values]
"""V_q for q = 0, 1, 2 as a function of s and r = √(a² + s²)."""


def ball_flux(axes: tuple[tuple[Piece, ...], ...]) -> Ball:
    """∫ g(x) h(y) k(z) J(|(x, y, z)|) over x, y, z >= 0, for the densities of the three axes."""
    orders = Counter(permutations(axes))  # equal axes have equal edges
    total = flint.arb(0)
    for (across, up, along), times in orders.items():
        for a, jump in breaks(across):
            inside = _inside(a, jump)
            outside = _outside(a, jump, inside)
            for b, side in breaks(up):
                for piece in along:
                    total += times * _edge((a, b), side, piece, inside, outside)
    return total


def _moments(a: Rational, jump: Jump, q: int) -> list[Rational]:
    """Σ_i g_i a^{i+1} c_p/(i + q + p + 3) for p = 0, 1, 3."""
    return [
        sum(g * a ** (i + 1) * c / (i + q + p + 3) for i, g in enumerate(jump)) for p, c in _SERIES
    ]


def _inside(a: Rational, jump: Jump) -> Profile:
    """For r <= 1, from ∫_0^s t r^p dt = (r^(p+2) - a^(p+2))/(p + 2) and ∫_0^s r^p dt."""
    (u0, u1, u3), (v0, v1, v3), (w0, w1, w3) = (_moments(a, jump, q) for q in range(3))
    a2 = a**2
    even = [-(a**3) * (u1 / 3 + u3 * a2 / 5), u0 / 2, u1 / 3, u3 / 5]
    odd = [v0 / 3, -a2 * (v1 / 8 + v3 * a2 / 16), v1 / 4 - v3 * a2 / 24, v3 / 6]
    log = -(a2**2) * (v1 / 8 + v3 * a2 / 16)
    top = [2 * a**5 * (w1 / 15 + w3 * a2 / 35), w0 / 4, -a2 * w1 / 3, (w1 - a2 * w3) / 5, w3 / 7]
    e0, e2, e3, e5 = map(flint.arb, even)
    o0, o1, o3, o5 = map(flint.arb, odd)
    t0, t4, t3, t5, t7 = map(flint.arb, top)
    o_log, near = flint.arb(log), flint.arb(a)

    def profile(s: Ball, r: Ball, analytic: bool) -> Values:
        s2, r2 = s * s, r * r
        r3 = r * r2
        arc = ((s + r) / near).log(analytic=analytic)
        return (
            e0 + e2 * s2 + r3 * (e3 + e5 * r2),
            s * (o0 * s2 + r * (o1 + r2 * (o3 + o5 * r2))) + o_log * arc,
            t0 + t4 * s2 * s2 + r3 * (t3 + r2 * (t5 + t7 * r2)),
        )

    return profile


def _outside(a: Rational, jump: Jump, inside: Profile) -> Profile:
    """For r >= 1, where G_m = K_m r^-(m+3); what V has up to the sphere comes from inside."""
    near = flint.arb(a)
    a2 = near**2
    weights = [g * a ** (i + 1) for i, g in enumerate(jump)]
    (u0, u1), (v0, v1), (w0, w1) = (
        [flint.arb(w * sum(c / (i + q + p + 3) for p, c in _SERIES)) for i, w in enumerate(weights)]
        for q in range(3)
    )
    unit = flint.acb(0, 1)

    def primitive(s: Ball, r: Ball, analytic: bool) -> Values:
        x = 1 / r
        x2, sx = x * x, s * x
        angle = (near * x + unit * sx).log(analytic=analytic) / (unit * near)  # arctan(s/a)/a
        return (
            -x * (u0 + u1 * x / 2),
            v0 * (angle - sx * x) / 2 + v1 * sx * sx * sx / (3 * a2),
            -x * (w0 * (1 - a2 * x2 / 3) + w1 * x * (2 - a2 * x2) / 4),
        )

    if a < 1:
        sphere = (flint.acb(1 - a**2).sqrt(), flint.acb(1), False)
        pairs = zip(inside(*sphere), primitive(*sphere), strict=True)
        c0, c1, c2 = (v - w for v, w in pairs)
    else:
        c0, c1, c2 = (-w for w in primitive(flint.acb(0), flint.acb(a), False))

    def profile(s: Ball, r: Ball, analytic: bool) -> Values:
        v0, v1, v2 = primitive(s, r, analytic)
        return c0 + v0, c1 + v1, c2 + v2

    return profile


def _edge(
    place: tuple[Rational, Rational], jump: Jump, piece: Piece, inside: Profile, outside: Profile
) -> Ball:
    """Flux of the face x_1 = a through its side x_2 = b along a piece of the third axis."""
    distance2 = sum(x**2 for x in place)
    b = place[1]
    near, distance = flint.arb(b), flint.arb(distance2)
    start, end = ((x / near).asinh() for x in (flint.arb(piece.start), flint.arb(piece.end)))
    u, v = (flint.arb(g * b**j) for j, g in enumerate(jump))
    h, k = flint.arb(piece.constant), flint.arb(piece.slope)
    uh, vh = u * h, v * h

    def integrand_of(profile: Profile) -> Callable[[Ball, bool], Ball]:
        def integrand(w: Ball, analytic: bool) -> Ball:
            """Of w with x_3 = b sinh w, s = b cosh w."""
            sinh, cosh = w.sinh_cosh()
            z, s = near * sinh, near * cosh
            r = (distance + z * z).sqrt(analytic=analytic)
            v0, v1, v2 = profile(s, r, analytic)
            kz = k * z
            return (uh * v0 + ((vh + u * kz) * v1 + v * kz * v2 / s) / s) / cosh

        return integrand

    total = flint.arb(0)
    left2 = 1 - distance2  # squared half of the edge's chord of the sphere
    if piece.start**2 < left2:
        crosses = piece.end**2 > left2
        stop = (flint.arb(left2).sqrt() / near).asinh() if crosses else end
        total = integral(integrand_of(inside), start, stop)
        start = stop
    if piece.end**2 > left2:
        total += integral(integrand_of(outside), start, end)
    return total
