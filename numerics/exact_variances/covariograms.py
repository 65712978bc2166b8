r"""Covariogram of the ball, projected along axes: closed forms, Taylor and small-distance series.

The ball of radius R in d dimensions has the covariogram C(r) = ∫ 1_B(x) 1_B(x + h) dx, r = |h|,
with C'(r) = -κ_{d-1} (R² - r²/4)^{(d-1)/2} up to r = 2R and 0 beyond (κ_d: volume of the unit
ball). Integrated over k of the axes of h it stays radial in the others, and with z = r/(2R)

    C_k(r) = ∫_{R^k} C(√(r² + |t|²)) dt = κ_k κ_{d-1} R^{d-1} (2R)^{k+1} J(z),
    J(z) = ∫_z^1 (1 - σ²)^{(d-1)/2} (σ² - z²)^{k/2} dσ,

which is the covariogram of the ball projected along the k axes: for k = 1 of the chord length
2 √(R² - |x|²). As a function of y = z², J solves the hypergeometric equation

    y (1 - y) J'' + (c - (a + b + 1) y) J' - a b J = 0,  a = -k/2, b = -(d + k)/2, c = (1 - k)/2.
"""

from dataclasses import dataclass

from ..balls import Ball, Rational, flint


@dataclass(frozen=True)
class Covariogram:
    """J for a ball in ``dim`` dimensions projected along ``flat`` axes.

    Parameters
    ----------
    dim : int
        1, 2 or 3.
    flat : int
        Number of axes projected along, at least 0 and less than ``dim``.
    """

    dim: int
    flat: int


def unit_ball(dim: int) -> Ball:
    """κ_dim, the volume of the unit ball: 1, 2, π, 4π/3 for dim = 0, 1, 2, 3."""
    number = (1, 2, 1, flint.fmpq(4, 3))[dim]
    return number * flint.arb.pi() if dim > 1 else flint.arb(number)


def scale(covariogram: Covariogram, radius: Rational) -> Ball:
    """C_k(r)/J(z) = κ_k κ_{d-1} R^{d-1} (2R)^{k+1}."""
    d, k = covariogram.dim, covariogram.flat
    return unit_ball(k) * unit_ball(d - 1) * (2 ** (k + 1) * radius ** (d + k))


def value(covariogram: Covariogram, y: Ball) -> Ball:
    """J at y = z², 0 < y <= 1."""
    z = y.sqrt()
    rest = flint.arb.max(1 - y, flint.arb(0))
    match covariogram.dim, covariogram.flat:
        case 1, 0:
            return 1 - z
        case 2, 0:
            root = rest.sqrt()
            return (flint.arb.atan2(root, z) - z * root) / 2
        case 3, 0:
            return flint.fmpq(2, 3) - z + z * y / 3
        case 2, 1:
            k, e = _elliptic(y)
            return ((1 + y) * e - 2 * y * k) / 3
        case 3, 1:
            root = rest.sqrt()
            return (root * (2 + y) - y * (4 - y) * ((1 + root) / z).log()) / 8
        case _:  # 3, 2
            return (2 - 10 * y + 10 * z * y - 2 * z * y**2) / 15


def at_zero(covariogram: Covariogram) -> Ball:
    """J(0) = ∫_0^1 (1 - σ²)^{(d-1)/2} σ^k dσ."""
    quarter_pi, third = flint.arb.pi() / 4, flint.fmpq(1, 3)
    known = {(1, 0): flint.fmpq(1), (2, 0): quarter_pi, (2, 1): third}
    known |= {(3, 0): 2 * third, (3, 1): flint.fmpq(1, 4), (3, 2): flint.fmpq(2, 15)}
    return flint.arb(known[covariogram.dim, covariogram.flat])


def slope(covariogram: Covariogram, y: Ball) -> Ball:
    """dJ/dy at y = z², 0 < y < 1."""
    z, rest = y.sqrt(), 1 - y
    match covariogram.dim, covariogram.flat:
        case 1, 0:
            return -1 / (2 * z)
        case 2, 0:
            return -rest.sqrt() / (2 * z)
        case 3, 0:
            return -rest / (2 * z)
        case 2, 1:
            k, e = _elliptic(y)
            return (e - k) / 2
        case 3, 1:
            root = rest.sqrt()
            return (root - (2 - y) * ((1 + root) / z).log()) / 4
        case _:  # 3, 2
            return -value(Covariogram(3, 0), y)


def _elliptic(y: Ball) -> tuple[Ball, Ball]:
    """Complete elliptic integrals K(m) and E(m) at m = 1 - y, 0 < y <= 1.

    With the arithmetic-geometric mean from a_0 = 1, b_0 = √y and c_{n+1} = (a_n - b_n)/2,
    K = π/(2 lim a_n) and E = K (1 - Σ 2^(n-1) c_n²), c_0² = m (DLMF 19.8.5, 19.8.6). The limit lies
    between b_n and a_n, and each 2^(n-1) c_n² is less than half of the one before.
    """
    a, b = flint.arb(1), y.sqrt()
    power, total = flint.arb(1), (1 - y) / 2
    while True:
        gap = (a - b) / 2
        gap2 = power * gap * gap  # 2^(n-1) c_n²
        total += gap2
        a, b, power = (a + b) / 2, (a * b).sqrt(), 2 * power
        if not gap2 > flint.arb(2) ** -flint.ctx.prec:
            break
    k = flint.arb.pi() / (2 * a.union(b))
    return k, k * (1 - total - flint.arb(0, gap2.upper()))
