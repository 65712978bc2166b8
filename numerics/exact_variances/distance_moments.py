r"""Moments E |h|^p and E |h|^p ln |h| of a vector h with independent triangular coordinates.

The density is ∏ (1/w_i)(1 - |h_i|/w_i), |h_i| < w_i: each h_i is the difference of two uniform
points of an interval of length w_i. A monomial x^I |x|^p is homogeneous, so that by the divergence
theorem its integral over the box ∏ [0, w_i] is 1/(|I| + p + d) times its flux through the faces
x_i = w_i. Summed over the monomials of the density, with I' those of a face and q = |I'|,

    E |h|^p = ∏_i (2/w_i) · Σ_faces w_face Σ_{I'} (-1)^q F_{I'}/((q + p + d)(q + p + d + 1)),
    F_{I'} = ∫_face ∏ (y_j/w_j)^{I'_j} |x|^p dy.

A factor y_j integrates at once; what is left are

    I_p = ∫_0^c (s² + y²)^{p/2} dy,             (p + 1) I_p = c (s² + c²)^{p/2} + p s² I_{p-2},
    F_p = ∫_0^b ∫_0^c (a² + y² + z²)^{p/2},     (p + 2) F_p = p a² F_{p-2} + b I_p(c; s² = a² + b²)
                                                              + c I_p(b; s² = a² + c²),

from I_{-1} = asinh(c/s), I_0 = c and F_{-3} = atan(b c/(a √(a² + b² + c²)))/a. The derivative with
respect to p gives the moments with a logarithm.
"""

from collections.abc import Iterator, Sequence
from itertools import count

from ..balls import Ball, flint


def moments(widths: Sequence[Ball], first: int) -> Iterator[Ball]:
    """E |h|^p for p = first, first + 2, ...

    Parameters
    ----------
    widths : sequence of Ball, length 1 to 3
        Half-widths w_i > 0.
    first : int
        1, or 2 for one or two widths.
    """
    if len(widths) == 1:
        return _linear_moments(widths[0], first)
    if len(widths) == 2:
        return _planar_moments(widths[0], widths[1], first)
    return _spatial_moments(widths[0], widths[1], widths[2])


def log_moment(widths: Sequence[Ball], p: int) -> Ball:
    """E |h|^p ln |h| for one width, or for two and an even p >= 2."""
    if len(widths) == 1:
        w = widths[0]
        return _derivative(2 * w**p, 2 * w**p * w.log(), p + 1)
    a, b = widths
    total = flint.arb(0)
    for near, far in ((a, b), (b, a)):  # the face at distance `near`, y from 0 to `far`
        line, log_line = _even_lines(far, near, p)
        tilted, log_tilted = _tilted_lines(far, near, p)
        total += near * _derivative(line, log_line, p + 2)
        total -= near * _derivative(tilted, log_tilted, p + 3) / far
    return 4 * total / (a * b)


def _derivative(value: Ball, log_value: Ball, q: int) -> Ball:
    """d/dq of value/(q (q + 1)), with ``log_value`` for d value/dq."""
    steps = flint.fmpq(1, q) + flint.fmpq(1, q + 1)
    return (log_value - value * steps) / (q * (q + 1))


def _linear_moments(w: Ball, first: int) -> Iterator[Ball]:
    power, square = 2 * w**first, w**2
    for p in count(first, 2):
        yield power / ((p + 1) * (p + 2))
        power *= square


def _planar_moments(a: Ball, b: Ball, first: int) -> Iterator[Ball]:
    scale = 4 / (a * b)
    for p, x, y, u, v in zip(
        count(first, 2),
        _lines(b, a**2, first),
        _lines(a, b**2, first),
        _power_gaps(a, b, first),
        _power_gaps(b, a, first),
        strict=False,
    ):
        straight = (a * x + b * y) / ((p + 2) * (p + 3))
        tilted = (a * u / b + b * v / a) / ((p + 2) * (p + 3) * (p + 4))
        yield scale * (straight - tilted)


def _spatial_moments(a: Ball, b: Ball, c: Ball) -> Iterator[Ball]:
    """For p = 1, 3, ..."""
    faces = [_face_moments(*order) for order in ((a, b, c), (b, c, a), (c, a, b))]
    scale = 8 / (a * b * c)
    for fluxes in zip(*faces, strict=True):
        yield scale * sum(fluxes)


def _face_moments(a: Ball, b: Ball, c: Ball) -> Iterator[Ball]:
    """a Σ_{I'} (-1)^q F_{I'}/((q + p + 3)(q + p + 4)) of the face at distance a, p = 1, 3, ..."""
    a2, b2, c2 = a**2, b**2, c**2
    corner = (a2 + b2 + c2).sqrt()
    face = (b * c / (a * corner)).atan() / a
    edges = zip(_lines(c, a2 + b2, -1), _lines(b, a2 + c2, -1), strict=True)
    ends = zip(_lines(c, a2, 3), _lines(b, a2, 3), strict=True)
    over_b, over_c = next(edges)
    face = b * over_b + c * over_c - a2 * face  # F_{-1}
    over_b, over_c = next(edges)
    for p, (from_b, from_c) in zip(count(1, 2), ends, strict=False):
        face = (p * a2 * face + b * over_b + c * over_c) / (p + 2)
        over_b, over_c = next(edges)  # I_{p+2}, for this p's tilts and the next p's face
        tilted = ((over_b - from_b) / b + (over_c - from_c) / c) / (p + 2)
        q = p + 4
        gaps = corner**q - (a2 + b2).sqrt() ** q - (a2 + c2).sqrt() ** q + a**q
        twice = gaps / (b * c * (p + 2) * q)
        flux = face / ((p + 3) * (p + 4)) - tilted / ((p + 4) * (p + 5))
        yield a * (flux + twice / ((p + 5) * (p + 6)))


def _lines(c: Ball, s2: Ball, first: int) -> Iterator[Ball]:
    """I_p for p = first, first + 2, ..."""
    corner2 = s2 + c**2
    if first % 2:
        p, line, power = -1, (c / s2.sqrt()).asinh(), c / corner2.sqrt()
    else:
        p, line, power = 0, c, c
    while True:
        if p >= first:
            yield line
        p, power = p + 2, power * corner2
        line = (power + p * s2 * line) / (p + 1)


def _power_gaps(a: Ball, b: Ball, first: int) -> Iterator[Ball]:
    """(a² + b²)^{q/2} - a^q for q = first + 2, first + 4, ..., summed without cancellation."""
    a2, b2 = a**2, b**2
    corner2 = a2 + b2
    q, gap, power = (1, b2 / (corner2.sqrt() + a), a) if first % 2 else (2, b2, a2)
    while True:
        if q >= first + 2:
            yield gap
        gap, power, q = corner2 * gap + b2 * power, power * a2, q + 2


def _even_lines(c: Ball, s: Ball, p: int) -> tuple[Ball, Ball]:
    """I_p and its derivative L_p = ∫_0^c r^p ln r dy, r² = s² + y², for even p."""
    s2 = s**2
    corner2 = s2 + c**2
    log = corner2.log() / 2
    line, log_line = c, c * log - c + s * (c / s).atan()
    for k in range(2, p + 1, 2):
        power = c * corner2 ** (k // 2)
        before, line = line, (power + k * s2 * line) / (k + 1)
        log_line = (power * log + k * s2 * log_line - line + s2 * before) / (k + 1)
    return line, log_line


def _tilted_lines(c: Ball, s: Ball, p: int) -> tuple[Ball, Ball]:
    """∫_0^c y r^p dy and ∫_0^c y r^p ln r dy, r² = s² + y², for even p."""
    q = p + 2
    corner2 = s**2 + c**2
    top = corner2 ** (q // 2)
    gap = (top - s**q) / q
    return gap, (top * corner2.log() / 2 - s**q * s.log() - gap) / q
