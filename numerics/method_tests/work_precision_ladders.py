"""The problems of the work-precision diagram, and the methods that climb their ladders of accuracy.

Eq. 17 for jitter's degree in two dimensions and the worst case, b = 2, s = 2, p = 3, N = 1e6; and
the variance of jitter on a disk, R = 1/4, N = 1e4. What does not depend on the accuracy asked for
is prepared before a method is timed.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import sqrt
from typing import Any

import numpy as np

from ...theory.samplers import parse_sampler
from ..balls import Ball, certified
from ..equation17 import radial_estimates
from ..equation17.radial_estimates import Estimate
from ..equation17.radial_integrals import RadialProblem, prepared
from ..exact_variances.covariogram_variances import ball_variance
from ..exact_variances.variances import exact_variance
from ..generators import generate
from ..integrands.ball import Ball as BallIntegrand
from ..integrands.protocol import Floats, to_mpf
from ..measuring.moments import Interval, Moments, estimates, shifted, update, variance_interval
from ..streams import stream
from . import disk_estimates
from .stress import Outcome

EQ_17, DISK = "Eq. 17", "jitter on a disk"

REPETITIONS = 16
"""Of Monte Carlo, for the root mean square of its error."""
LEVEL = 0.05
"""How often the interval of that root mean square should miss."""

_DIGITS = (5, 10, 15, 20, 30, 50, 70, 100)
_TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12, radial_estimates.FINEST)
_FREQUENCIES = (10**2, 10**3, 10**4, 10**5, 10**6, 4 * 10**6)
_REALISATIONS = (4, 16, 64, 256)

_RADIAL = RadialProblem(Fraction(2), 2, Fraction(3), Fraction(10**6), None, Fraction(1, 2))
_CELLS, _RADIUS = 100, Fraction(1, 4)
_JITTER, _COUNTS = parse_sampler("jitter", 2), {"N": _CELLS**2, "n": _CELLS}
_BALL = BallIntegrand(2, _RADIUS)


@dataclass(frozen=True)
class Problem:
    """A number that is wanted, and a certified route to any number of its digits."""

    name: str
    about: str
    truth: Callable[[int], Ball]


PROBLEMS = (
    Problem(EQ_17, "b = 2, s = 2, p = 3, N = 1e6", lambda k: certified(prepared(_RADIAL), k)),
    Problem(
        DISK,
        "variance, R = 1/4, d = 2, N = 1e4",
        lambda k: ball_variance(_JITTER, _COUNTS, _BALL, k),
    ),
)


@dataclass(frozen=True)
class Ladder:
    """A method on one problem, climbing by one parameter.

    Parameters
    ----------
    parameter : str
        What the steps are, such as ``digits``.
    steps : tuple
        Cheapest first.
    call : callable
        What is timed.
    read : callable
        What came of it: an answer, or the interval of a root mean square error, relative.
    answers : int
        How many answers one call gives.
    warm_up : object
        A step with which ``call`` is called once before it is timed.
    repeated : bool
        Whether it may be called again for the shortest time.
    """

    problem: str
    method: str
    parameter: str
    steps: tuple[Any, ...]
    call: Callable[[Any], Any]
    read: Callable[[Any], Outcome | Interval]
    answers: int = 1
    warm_up: Any = None
    repeated: bool = True


def ladders(seed: int) -> Iterator[Ladder]:
    """All methods on both problems; Monte Carlo draws from the streams of the seed."""
    yield from _ladders_of_eq_17()
    yield from _ladders_of_the_disk()
    exact = float(to_mpf(ball_variance(_JITTER, _COUNTS, _BALL, 20)))
    yield Ladder(
        DISK,
        "Monte Carlo",
        "realisations",
        _REALISATIONS,
        lambda count: _monte_carlo(count, seed),
        lambda variances: _root_mean_square(variances / exact - 1),
        answers=REPETITIONS,
        warm_up=2,
        repeated=False,
    )


def _ladders_of_eq_17() -> Iterator[Ladder]:
    for method, route in (("closed form, balls", "closed"), ("quadrature, balls", "quadrature")):
        evaluate = prepared(_RADIAL, route)
        yield Ladder(EQ_17, method, "digits", _DIGITS, _certifier(evaluate), _of_ball)

    def by_mpmath(digits: int) -> Estimate:
        return radial_estimates.by_mpmath(_RADIAL, digits)

    def by_scipy(tolerance: float) -> Estimate:
        return radial_estimates.by_scipy(_RADIAL, tolerance)

    def by_doubles(_: str) -> Estimate:
        return radial_estimates.by_doubles(_RADIAL)

    yield Ladder(EQ_17, "mpmath.quad", "digits", _DIGITS, by_mpmath, _of_estimate)
    yield Ladder(EQ_17, "scipy quad", "tolerance", _TOLERANCES, by_scipy, _of_estimate)
    yield Ladder(EQ_17, "closed form, doubles", "precision", ("double",), by_doubles, _of_estimate)


def _certifier(evaluate: Callable[[], Ball]) -> Callable[[int], Ball]:
    return lambda digits: certified(evaluate, digits)


def _ladders_of_the_disk() -> Iterator[Ladder]:
    def by_covariogram(digits: int) -> Ball:
        return ball_variance(_JITTER, _COUNTS, _BALL, digits)

    def by_mpmath(digits: int) -> Estimate:
        return disk_estimates.by_mpmath(_CELLS, _RADIUS, digits)

    def by_scipy(tolerance: float) -> Estimate:
        return disk_estimates.by_scipy(_CELLS, _RADIUS, tolerance)

    def by_lattice(box: int) -> Outcome:
        found = exact_variance(_JITTER, _COUNTS, _BALL, 15, "lattice", box)
        return Outcome(found.value, found.error_bound, "bound")

    yield Ladder(DISK, "covariogram, balls", "digits", _DIGITS, by_covariogram, _of_ball)
    yield Ladder(DISK, "mpmath.quad", "digits", _DIGITS[:-2], by_mpmath, _of_estimate)
    yield Ladder(DISK, "scipy quad", "tolerance", _TOLERANCES, by_scipy, _of_estimate)
    yield Ladder(  # not repeated: it keeps the coefficients of the integrand
        DISK,
        "lattice sum",
        "frequencies",
        _FREQUENCIES,
        by_lattice,
        lambda outcome: outcome,
        warm_up=50,
        repeated=False,
    )


def _of_ball(ball: Ball) -> Outcome:
    return Outcome(to_mpf(ball), to_mpf(ball.rad()), "bound")


def _of_estimate(estimate: Estimate) -> Outcome:
    return Outcome(estimate.value, estimate.error, "estimate")


def _monte_carlo(count: int, seed: int) -> Floats:
    """The variance of the estimator from ``count`` realisations, as often as there are repetitions.

    The mean of f is known, so that squares of errors are averaged.
    """
    mean = float(_BALL.mean(17))
    found = np.empty(REPETITIONS)
    for repetition in range(REPETITIONS):
        rng = stream(seed, count, repetition)
        points = generate(_JITTER, _COUNTS, count, rng)
        errors = estimates(_BALL, shifted(points, rng.random((count, 2)))) - mean
        found[repetition] = np.mean(errors**2)
    return found


def _root_mean_square(errors: Floats) -> Interval:
    square = variance_interval(update(Moments(), errors), LEVEL)
    return Interval(*(sqrt(v) for v in square))
