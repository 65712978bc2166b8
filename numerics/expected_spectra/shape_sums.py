r"""Power of a function of one coordinate against shapes: sums over m ≠ 0 of |f^(m)|² ∏ g(m/n).

|f^(m)|² is, up to a constant, an envelope m^−p exp(−γm²) times waves (2πm)^(−q) cos 2πhm. With
φ = 2πm/n, sinc²(m/n) and the shape of difference jitter multiply it by more of them,

    sinc²(x) = 2 (1 − cos φ)/φ²,                                      x = m/n,
    3 sinc³(x) sinc(3x) − 2 sinc²(x) sinc(4x)
             = 2 (cos 3φ − 3 cos 2φ + 3 cos φ − 1)/φ⁴ + (sin 3φ − 2 sin 2φ + sin φ)/φ³,

exp(−|x|^β) joins the envelope, and the tent is Σ_{m<n} (1 − m/n), the difference of sums from 1 and
from n on. All of them are sums of damped waves (``wave_sums.py``). Of splines those without damping
are rational, by the Fourier series of the Bernoulli polynomials, and those of a Bernoulli
polynomial against the tent are differences of Hurwitz's zeta functions.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from math import factorial

from ...theory.errors import InputError
from ...theory.shapes import Shape
from ..balls import Ball, Rational, exact_ball, flint, rational
from ..integrands.gaussian import GaussianFactor
from ..integrands.polylog import PolylogFactor
from ..integrands.protocol import Factor
from ..integrands.spline import SplineFactor
from ..wave_sums import Envelope, Waves, wave_product, wave_sum, waves_of


def shape_sum(factor: Factor, shapes: Sequence[tuple[Shape, int]]) -> Ball:
    """Σ over m ≠ 0 of |f^(m)|² ∏ g(m/n), at the precision in force.

    Parameters
    ----------
    factor : Factor
        f: a spline, a polylogarithm or a Gaussian.
    shapes : sequence of (Shape, int)
        The shapes g and their counts n, each at least 1; at most one of them a tent.

    Returns
    -------
    Ball
        Exactly zero where every g(m/n) is.

    Raises
    ------
    InputError
        If f or the product of shapes is of another kind.
    """
    if any(n == 1 and shape.vanishes_on_integers for shape, n in shapes):
        return flint.arb(0)
    return _shape_sum(factor, tuple(shapes), flint.ctx.prec)


@lru_cache(maxsize=512)
def _shape_sum(factor: Factor, shapes: tuple[tuple[Shape, int], ...], precision: int) -> Ball:
    del precision  # part of the key alone
    front, waves, envelope = _power(factor)
    tents: list[int] = []
    for shape, n in shapes:
        match shape.kind:
            case "sinc2":
                waves = wave_product(waves, _sinc2_waves(n))
            case "difference":
                waves = wave_product(waves, _difference_waves(n))
            case "stretched":
                assert shape.beta is not None
                envelope = replace(envelope, stretched=(*envelope.stretched, (shape.beta, n)))
            case "tent":
                tents.append(n)
    if len(tents) > 1 or (tents and envelope.stretched):
        kinds = [shape.kind for shape, _ in shapes]
        raise InputError(f"a tent must stand alone or beside undamped shapes: got {kinds}")
    if not tents and envelope == Envelope() and all((q % 2 == 1) == s for q, s, _ in waves):
        return 2 * front * flint.arb(_periodic_sum(waves))
    if not tents:
        return 2 * front * wave_sum(1, waves, envelope)
    (n,) = tents
    raised = replace(envelope, power=envelope.power - 1)
    total = wave_sum(1, waves, envelope) - wave_sum(n, waves, envelope)
    moment = wave_sum(1, waves, raised) - wave_sum(n, waves, raised)
    return 2 * front * (total - moment / n)


def _periodic_sum(waves: Waves) -> Rational:
    """Σ over m >= 1 of cosines with even q and sines with odd q, exactly.

    Σ cos 2πhm/(2πm)^q and Σ sin 2πhm/(2πm)^q, up to their signs, are B_q(h)/2q!.
    """
    total = flint.fmpq(0)
    for (q, _, h), weight in waves.items():
        sign = 1 if q % 4 in (2, 3) else -1
        value = flint.fmpq_poly.bernoulli_poly(q)(h) / (2 * factorial(q))
        total += weight * (value if sign > 0 else -value)
    return total


def _power(factor: Factor) -> tuple[Ball, Waves, Envelope]:
    """|f^(m)|² as a constant, waves and an envelope."""
    constant = waves_of([(0, False, flint.fmpq(0), flint.fmpq(1))])
    match factor:
        case SplineFactor():
            pairs = [(c, s, d, t) for c, s in factor.knots for d, t in factor.knots]
            order = 2 * factor.order
            waves = [(order, False, rational(s - t), rational(c * d)) for c, s, d, t in pairs]
            return flint.arb(factorial(factor.order) ** 2), waves_of(waves), Envelope()
        case PolylogFactor():
            return flint.arb(1), constant, Envelope(power=factor.p)
        case GaussianFactor():
            front = 2 * flint.arb.pi() * exact_ball(factor.sigma) ** 2
            return front, constant, Envelope(sigma=factor.sigma)
        case _:
            kinds = "splines, polylogarithms and Gaussians"
            raise InputError(f"power against a shape can be summed for {kinds}: got {factor}")


def _sinc2_waves(n: int) -> Waves:
    step, height = flint.fmpq(1, n), 2 * flint.fmpq(n) ** 2
    return waves_of([(2, False, 0 * step, height), (2, False, step, -height)])


def _difference_waves(n: int) -> Waves:
    step, height = flint.fmpq(1, n), flint.fmpq(n)
    cosines = [(4, False, k * step, 2 * w * height**4) for k, w in enumerate((-1, 3, -3, 1))]
    sines = [(3, True, k * step, w * height**3) for k, w in ((1, 1), (2, -2), (3, 1))]
    return waves_of([*cosines, *sines])
