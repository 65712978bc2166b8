r"""Sums of damped waves over the whole numbers m >= M, certified, by integrals along two rays.

Let e(z) = z^−p exp(−γz²) ∏ exp(−(z/n)^β), 0 < β <= 2, which is real on the positive real axis and
analytic right of the imaginary one, 0 <= h <= 1/2, E_h = exp(2πihz) and c = M − 1/2. Along any ray
z = c + re^(iφ), 0 < φ <= π/4, below which Re z^β >= 0,

    Σ_{m>=M} e(m) cos 2πhm = Re ∫ e(z) (E_h + E_(1−h))/(1 − E_1) dz,
    Σ_{m>=M} e(m) sin 2πhm = Im ∫ e(z) (E_h − E_(1−h))/(1 − E_1) dz:

1/(1 − E_1) has the residue −1/2πi at every m, and the mirror image of the ray brings the conjugate
of what E_(1−h) brings here (Lindelöf 1905). The integrand is split by

    (E_h ± E_(1−h))/(1 − E_1) = E_h + (E_h E_1 ± E_(1−h))/(1 − E_1),

the first part, smooth in ln z whatever the scales h and n, along φ = π/8, the second, gone after a
few periods, along φ = π/4. A large n costs the digits that cancel and no terms.
"""

from collections import defaultdict
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from fractions import Fraction
from math import log
from typing import TypeAlias

from .balls import Ball, Complex, Rational, exact_ball, flint, integrated

Waves: TypeAlias = Mapping[tuple[int, bool, Rational], Rational]
"""Coefficients of (2πm)^(−q) cos 2πhm, or sin for True, by (q, sine, h), 0 <= h <= 1/2, q >= 0."""


@dataclass(frozen=True)
class Envelope:
    """e(z) = z^−p exp(−(2πσz)²) ∏ exp(−(z/n)^β).

    Parameters
    ----------
    power : Fraction
        p, at least −1.
    sigma : Fraction
        0 for none; else p + q >= −1 is enough for all sums. Without it p + q > 1 is needed where
        h = 0, and p + q > 0 else.
    stretched : tuple of (Fraction, int)
        Pairs of 0 < β <= 2 and n.
    """

    power: Fraction = Fraction(0)
    sigma: Fraction = Fraction(0)
    stretched: tuple[tuple[Fraction, int], ...] = ()


def wave_product(first: Waves, second: Waves) -> Waves:
    """By 2 cos a cos b = cos(a + b) + cos(a − b) and its like."""
    found: list[tuple[int, bool, Rational, Rational]] = []
    for (q, sine, h), weight in first.items():
        for (q2, sine2, h2), weight2 in second.items():
            half = weight * weight2 / 2
            apart = h2 - h if sine2 and not sine else h - h2
            found.append((q + q2, sine != sine2, h + h2, -half if sine and sine2 else half))
            found.append((q + q2, sine != sine2, apart, half))
    return waves_of(found)


def waves_of(terms: list[tuple[int, bool, Rational, Rational]]) -> Waves:
    """Waves from (q, sine, h, coefficient) with any rational h, brought to 0 <= h <= 1/2."""
    found: dict[tuple[int, bool, Rational], Rational] = defaultdict(flint.fmpq)
    for q, sine, h, weight in terms:
        inside = h - h.floor()
        turned = 2 * inside > 1
        place = (q, sine, 1 - inside if turned else inside)
        found[place] += -weight if turned and sine else weight
    return {(q, s, h): w for (q, s, h), w in found.items() if w != 0 and not (s and h == 0)}


def wave_sum(first: int, waves: Waves, envelope: Envelope) -> Ball:
    """Σ over m >= first of e(m) times the waves, at the precision in force.

    Powers of m alone, without waves or damping, have their zeta function ζ(s, M), and −ψ(M) at
    s = 1: a sum that diverges stands for its part in the difference of two such sums.
    """
    total, others = flint.arb(0), dict[tuple[int, bool, Rational], Rational]()
    is_power = envelope == Envelope(envelope.power)
    for (q, sine, h), weight in waves.items():
        if is_power and h == 0:
            scale = flint.arb(weight) / (2 * flint.arb.pi()) ** q
            total += scale * _zeta(q + envelope.power, first)
        else:
            others[q, sine, h] = weight
    if others:
        start = flint.arb(flint.fmpq(2 * first - 1, 2))
        scale = sum((abs(w) / flint.arb(6) ** q for (q, _, _), w in others.items()), flint.arb(0))
        total += _smooth_part(start, others, envelope, scale)
        total += _periodic_part(start, others, envelope, scale)
    return total


def _zeta(s: Fraction, first: int) -> Ball:
    if s == 1:
        return -flint.arb(first).digamma()
    return exact_ball(s).zeta(flint.arb(first))


def _smooth_part(start: Ball, waves: Waves, envelope: Envelope, scale: Ball) -> Ball:
    """∫ e E_h along z = c + re^(iπ/8), with r = c(e^u − 1)."""
    end, rest = _end_of_smooth_part(start, waves, envelope)
    direction = flint.acb(flint.fmpq(1, 8)).exp_pi_i()
    groups = list(_by_turn(waves))
    profile = _profile(envelope)

    def integrand(u: Complex, analytic: bool) -> Complex:
        growth = u.exp()
        z = start * (1 + direction * (growth - 1))
        total = flint.acb(0)
        for h, terms in groups:
            own = sum((_i_power(sine) * w * z**-q for q, sine, w in terms), flint.acb(0))
            total += own * (2 * h * z).exp_pi_i() if h != 0 else own
        return total * profile(z, z.log(analytic=analytic)) * direction * start * growth

    value = integrated(integrand, 0, end, abs_tol=_tolerance(scale))
    return value + (scale * rest).union(-scale * rest)


def _periodic_part(start: Ball, waves: Waves, envelope: Envelope, scale: Ball) -> Ball:
    """∫ e (E_h E_1 ± E_(1−h))/(1 − E_1) along z = c + re^(iπ/4).

    On it |z| >= r, Re z² >= c² and Re z^β >= 0. |E_h E_1| and |E_(1−h)| are at most
    exp(−πr sin π/4) < exp(−2r), and 1/|1 − E_1| < 5/2 as in ``_end_of_smooth_part``. Beyond R >= 1
    the rest is at most (5/2) exp(−2R) Σ |w| 6^−q, and (c + R + 1) exp(−γc²) times that where
    p + q < 0.
    """
    reach = flint.arb(1 + (flint.ctx.prec + 10) * log(2) / 2)
    rest = flint.arb(flint.fmpq(5, 2)) * (-2 * reach).exp()
    if min(q for q, _, _ in waves) + envelope.power < 0:
        rest *= (start + reach + 1) * (-_gamma(envelope) * start**2).exp()
    direction = flint.acb(flint.fmpq(1, 4)).exp_pi_i()
    groups = list(_by_turn(waves))
    profile = _profile(envelope)

    def integrand(r: Complex, analytic: bool) -> Complex:
        z = start + direction * r
        full, total = (2 * z).exp_pi_i(), flint.acb(0)
        for h, terms in groups:
            ahead, back = (2 * h * z).exp_pi_i() * full, (2 * (1 - h) * z).exp_pi_i()
            for q, sine, w in terms:
                wave = ahead - back if sine else ahead + back
                total += _i_power(sine) * w * z**-q * wave
        return total * profile(z, z.log(analytic=analytic)) * direction / (1 - full)

    value = integrated(integrand, 0, reach, abs_tol=_tolerance(scale))
    return value + (scale * rest).union(-scale * rest)


def _i_power(sine: bool) -> Complex:
    """Im X = Re(−iX)."""
    return flint.acb(0, -1) if sine else flint.acb(1)


def _by_turn(waves: Waves) -> Iterator[tuple[Ball, list[tuple[int, bool, Ball]]]]:
    """Every h with its (q, sine, coefficient of m^−q)."""
    found: dict[Rational, list[tuple[int, bool, Ball]]] = defaultdict(list)
    for (q, sine, h), weight in waves.items():
        found[h].append((q, sine, flint.arb(weight) / (2 * flint.arb.pi()) ** q))
    for h, terms in found.items():
        yield flint.arb(h), terms


def _profile(envelope: Envelope) -> Callable[[Complex, Complex], Complex]:
    """e(z), from z and ln z."""
    power, gamma = exact_ball(envelope.power), _gamma(envelope)
    stretched = [(exact_ball(b), flint.arb(n).log()) for b, n in envelope.stretched]

    def profile(z: Complex, logarithm: Complex) -> Complex:
        exponent = -power * logarithm
        if envelope.sigma:
            exponent -= gamma * z * z
        for beta, log_n in stretched:
            exponent -= (beta * (logarithm - log_n)).exp()
        return exponent.exp()

    return profile


def _gamma(envelope: Envelope) -> Ball:
    return (2 * flint.arb.pi() * exact_ball(envelope.sigma)) ** 2


def _tolerance(scale: Ball) -> Ball:
    return scale * flint.arb(2) ** -flint.ctx.prec


def _end_of_smooth_part(start: Ball, waves: Waves, envelope: Envelope) -> tuple[Ball, Ball]:
    """u where the ray may end, and a bound on what is left beyond it over Σ |w| 6^−q.

    On the ray |z| >= r and |arg z| <= π/8, so that Re z² >= k|z|², Re z^β >= kr^β with k = 7/10 <
    cos π/4, and |E_h| <= exp(−2πhr sin π/8) < exp(−2hr). With a the least of the p + q and R >= 1
    (and 2kγR² >= 1, where |z| exp(−kγ|z|²) falls) the rest is at most

        D(R) R^(1−a)/(a − 1)        a > 1, D the product of the exp(−k(r/n)^β);
        R^−a exp(−κR)/κ             a > 0, κ = 2 min h > 0;
        exp(−kγR²)/(2kγ)            a >= −1, γ > 0.

    (As E_1 = −exp(2πire^(iφ)), Re E_1 > 0 only where |E_1| <= exp(−(π/2) tan φ) < 3/5, for φ = π/8
    and for steeper rays: |1 − E_1| > 2/5.)
    """
    a, bits = min(q for q, _, _ in waves) + envelope.power, (flint.ctx.prec + 10) * log(2)
    kappa, gamma = 2 * flint.arb(min(h for _, _, h in waves)), _gamma(envelope)
    k = flint.arb(flint.fmpq(7, 10))

    def by_power(reach: Ball) -> Ball:
        damping = sum(((reach / n) ** exact_ball(b) for b, n in envelope.stretched), flint.arb(0))
        return (-k * damping).exp() * reach ** exact_ball(1 - a) / exact_ball(a - 1)

    def by_waves(reach: Ball) -> Ball:
        return (-kappa * reach).exp() / kappa * reach ** exact_ball(-a)

    def by_gaussian(reach: Ball) -> Ball:
        return (-k * gamma * reach**2).exp() / (2 * k * gamma)

    ends: list[tuple[float, Callable[[Ball], Ball]]] = []  # ln R
    if a > 1:
        ends.append((bits / float(a - 1), by_power))
        ends += [(log(2 * bits) / float(b) + log(n), by_power) for b, n in envelope.stretched]
    if a > 0 and kappa > 0:
        ends.append((float((bits / kappa).log()), by_waves))
    if a >= -1 and envelope.sigma:
        ends.append((float((2 * bits / gamma).log()) / 2, by_gaussian))
    at, bound = min(ends, key=lambda end: end[0])
    reach = flint.arb(max(at, 1.0)).exp()
    return (reach / start + 1).log().mid() + flint.arb(2) ** -20, bound(reach)
