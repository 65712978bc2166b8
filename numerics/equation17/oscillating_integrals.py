"""The frequency integral of jitter against a ball along an axis, certified: J² to infinity.

    I = ∫_0^∞ (1 − (sin bt/(bt))²) J_{d/2}(t)² t^(−1−κ) dt,        b > 0, 0 <= κ < d.

J² falls as 1/t only, and 1 − sinc² saturates at t ~ 1/b, which may be 1e30. Therefore

- up to a cut T the integrand, which is entire, is integrated in ball arithmetic;
- beyond T Hankel's expansion J = √(2/(πt)) Re e^{iω}(Σ_{k<K} i^k a_k/t^k + R), ω = t − (d+1)π/4,
  splits J² into its mean and its oscillation e^{2it}, both sums of powers of 1/t. Their integrals
  against 1 and sinc²(bt) are generalised exponential integrals E_q(z) = ∫_1^∞ e^{−zw} w^{−q} dw
  at z = −2iT times 0, b, 1, 1 ± b.

The remainder has |R(t)| <= |a_K| t^(−K) for K >= max((d − 1)/2, 1) (DLMF 10.17(iii), t real), and
0 <= 1 − sinc²(x) <= min(1, x²/3), so that what is left out is bounded, for any b.
"""

from fractions import Fraction
from math import ceil, log2

from ..balls import Ball, exact_ball, flint, integrated


def ball_axis_integral(dim: int, kappa: int, ratio: Fraction) -> Ball:
    """The integral I above, to about the precision in force.

    Parameters
    ----------
    dim : int
        d >= 1.
    kappa : int
        κ with 0 <= κ < d.
    ratio : Fraction
        b > 0.
    """
    bits = flint.ctx.prec
    smallness = max(0, ceil(-log2(ratio)))
    goal = bits + min(2, kappa + 1) * smallness  # for b → 0 I falls as b, b² log b or b²
    cut = ceil(0.7 * bits + dim**2 / 4 + 2)
    tolerance = flint.arb(2) ** -goal
    try:
        flint.ctx.prec = ceil(goal + 1.3 * cut + 20)  # the series of J cancels
        head = _head(dim, kappa, exact_ball(ratio), cut, tolerance)
        # So do that of E_q at |z| <= 2(1 + b)T, and 1 − sinc² where bt is small.
        flint.ctx.prec = goal + 2 * smallness + ceil(3 * (1 + ratio) * cut) + 20
        return head + _tail(dim, kappa, exact_ball(ratio), cut, tolerance)
    finally:
        flint.ctx.prec = bits


def _head(dim: int, kappa: int, b: Ball, cut: int, tolerance: Ball) -> Ball:
    """∫_0^T, with J_ν(t) = (t/2)^ν 0F1(ν + 1; −t²/4)/Γ(ν + 1), ν = d/2."""
    order = exact_ball(Fraction(dim, 2)) + 1
    scale = flint.arb(2) ** -dim / order.gamma() ** 2

    def density(t: Ball, _: bool) -> Ball:
        wave = (t * t / -4).hypgeom_0f1(order)
        return t ** (dim - kappa - 1) * wave * wave * (1 - (b * t).sinc() ** 2)

    goal = tolerance / scale
    return integrated(density, 0, cut, rel_tol=0, abs_tol=goal) * scale


def _hankel(dim: int, weight: Ball, cut: int, tolerance: Ball) -> tuple[list[Ball], Ball]:
    """The coefficients a_0 .. a_{K−1} of Hankel's expansion, and a bound on |R(t)| for t >= T."""
    found, power = [flint.arb(1)], 0
    while True:
        power += 1
        step = flint.fmpq(dim**2 - (2 * power - 1) ** 2, 8 * power)
        following = found[-1] * step
        size = abs(following) * flint.arb(cut) ** -power
        # At k = 2T the terms are below exp(−2T) < 2^(−2 bits): the search ends before.
        if following.is_zero() or (power >= max(4, dim / 2) and size * weight < tolerance / 8):
            return found, size
        found.append(following)


def _tail(dim: int, kappa: int, b: Ball, cut: int, tolerance: Ball) -> Ball:
    """∫_T^∞ of (1 − sinc²(bt)) t^(−2−κ) (|S|² + Re e^{2iω}S²)/π, S = Σ i^k a_k t^(−k)."""
    # R falls as t^(−K), K >= 4: three powers of T/t go to the weight (else R = 0).
    weight = _weight(5 + kappa, b, cut) * flint.arb(cut) ** 3
    a, remainder = _hankel(dim, weight, cut, tolerance)
    phase = (flint.acb(0, -1) * flint.arb.pi() * flint.fmpq(dim + 1, 2)).exp()
    total = flint.arb(0)
    for m in range(2 * len(a) - 1):
        power = 2 + m + kappa
        pairs = range(max(0, m - len(a) + 1), min(m, len(a) - 1) + 1)
        size = sum((abs(a[j] * a[m - j]) for j in pairs), flint.arb(0))
        bound = 2 * size * _weight(power, b, cut)
        if bound < tolerance / (4 * len(a)):
            total += flint.arb(0, bound.upper())
            continue
        turn = flint.acb(0, 1) ** m
        square = sum((a[j] * a[m - j] for j in pairs), flint.arb(0))
        total += (square * turn * phase * _moment(power, 1, b, cut)).real
        if m % 2 == 0:  # of |S|² only the even powers are left
            norm = sum(((-1) ** (m - j) * a[j] * a[m - j] for j in pairs), flint.arb(0))
            total += (norm * turn * _moment(power, 0, b, cut)).real
    largest = sum((abs(c) * flint.arb(cut) ** -k for k, c in enumerate(a)), flint.arb(0))
    left_out = 2 * (2 * largest + remainder) * remainder * weight  # 2(2|S||R| + |R|²)
    return (total + flint.arb(0, left_out.upper())) / flint.arb.pi()


def _weight(power: int, b: Ball, cut: int) -> Ball:
    """An upper bound of ∫_T^∞ (1 − sinc²(bt)) t^(−q) dt, by 1 − sinc²(x) <= min(1, x²/3)."""
    scale = flint.arb(cut) ** (1 - power)
    plain = scale / (power - 1)
    if power <= 3:
        return plain
    damped = scale * (b * cut) ** 2 / (3 * (power - 3))
    return damped if damped < plain else plain


def _moment(power: int, wave: int, b: Ball, cut: int) -> Ball:
    """∫_T^∞ (1 − sinc²(bt)) e^{2i·wave·t} t^(−q) dt, with sinc² in exponentials."""
    x, q = b * cut, power

    def tail(frequency: Ball, exponent: int) -> Ball:
        return (flint.acb(0, -2) * frequency).expint(exponent)

    at = flint.arb(wave * cut)
    if wave == 0:
        spread = flint.arb(1) / (q + 1) - tail(x, q + 2).real
        value = flint.acb(flint.arb(1) / (q - 1) - spread / (2 * x * x))
    else:
        spread = tail(at, q + 2) - (tail(at + x, q + 2) + tail(at - x, q + 2)) / 2
        value = tail(at, q) - spread / (2 * x * x)
    return value * flint.arb(cut) ** (1 - q)
