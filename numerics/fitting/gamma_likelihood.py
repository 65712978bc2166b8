"""Gamma likelihood of averaged periodograms: penalised fits, profile bounds, exceedance bounds.

An average of R periodograms of mean μ is Y ~ μ Gamma(R)/R, so that with r = Y/μ

    deviance = 2 Σ R (r − 1 − log r) >= 0,

and the Fisher information of log μ is R, whatever μ: scoring is least squares on r − 1. Parameters
that data may leave open carry a quadratic penalty, their normal prior. The cost, deviance plus
penalty, is minimised by damped scoring (Levenberg-Marquardt).

The sum of deviances has a known moment generating function, which bounds how often it exceeds a
threshold for any R, 1 included, where χ² is far off (Chernoff).
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import log, sqrt

import numpy as np

from ..integrands.protocol import Floats
from ..measuring.moments import special

_DAMPING = 1e-3
_FAR = 3.0  # largest change of a log μ in one step
_TRIALS = 10  # of a damping that lowers the cost
_RATIO = 600.0  # largest |log(Y/μ)| that is exponentiated
_EXPONENTS = np.linspace(0.005, 0.495, 99)  # of the Chernoff bound; any of them is valid
_NEAR = 0.03  # a bound is where the root of the cost is within this fraction of its target


@dataclass(frozen=True)
class Curve:
    """A model of log μ at one set of parameters.

    Parameters
    ----------
    log_mean : array (k,)
    jacobian : array (k, p)
        Of ``log_mean`` in the parameters.
    penalty : float
    pull : array (p,)
        Minus half the gradient of the penalty.
    stiffness : array (p, p)
        Half the Hessian of the penalty, positive semidefinite.
    """

    log_mean: Floats
    jacobian: Floats
    penalty: float
    pull: Floats
    stiffness: Floats


Model = Callable[[Floats], Curve]


@dataclass(frozen=True)
class Averages:
    """Averaged periodograms: positive values, their numbers of degrees R, and log values."""

    power: Floats
    shape: Floats
    log_power: Floats

    def with_shape(self, shape: Floats) -> "Averages":
        """The same values, held to be averages over other numbers of realisations."""
        return Averages(self.power, shape, self.log_power)


@dataclass(frozen=True)
class Optimum:
    """Least cost over the free parameters, and half the Hessian of the cost there.

    Parameters
    ----------
    parameters : array (p,)
    cost : float
    information : array (p, p)
        Expected information plus the penalty's stiffness, positive definite.
    """

    parameters: Floats
    cost: float
    information: Floats

    def covariance(self) -> Floats:
        """Inverse information: the parameters' covariance to leading order."""
        return np.asarray(np.linalg.inv(self.information), dtype=np.float64)


def averages(power: Floats, shape: Floats, floor: Floats | float) -> Averages:
    """Averages whose values below the floor are raised to it."""
    raised = np.maximum(power, floor)
    return Averages(raised, shape, np.log(raised))


def deviance(data: Averages, log_mean: Floats) -> Floats:
    """2R(r − 1 − log r) of each value."""
    gap = _gap(data, log_mean)
    return 2 * data.shape * (np.expm1(gap) - gap)


def fit(
    model: Model,
    data: Averages,
    start: Floats,
    limits: tuple[Floats, Floats],
    fixed: Sequence[int] = (),
    rounds: int = 100,
    tolerance: float = 1e-5,
) -> Optimum:
    """Least cost, from a start, of all parameters but the fixed ones.

    Parameters
    ----------
    limits : pair of arrays (p,)
        Smallest and largest values; a step beyond them ends on them.
    tolerance : float
        The search ends when a step promises, to first order, to lower the cost by less than twice
        this.

    Returns
    -------
    Optimum
        A local one: the start decides which.
    """
    free = np.ones(start.size, dtype=np.bool_)
    free[list(fixed)] = False
    at, damping = start.copy(), _DAMPING
    curve, cost = _cost(model, data, at)
    information = _information(curve, data)
    for _ in range(rounds):
        gradient, square = _gradient(curve, data)[free], information[free][:, free]
        scale, jacobian = np.diag(np.diag(square) + 1e-6), curve.jacobian[:, free]
        for _ in range(_TRIALS):
            trial = at.copy()
            trial[free] += _step(jacobian, square + damping * scale, gradient)
            trial = np.minimum(np.maximum(trial, limits[0]), limits[1])
            if gradient @ (trial - at)[free] < tolerance:
                return Optimum(at, cost, information)
            curve_there, cost_there = _cost(model, data, trial)
            if cost_there <= cost:
                break
            damping = max(8 * damping, 1e-5)
        else:
            break
        at, curve, cost = trial, curve_there, cost_there
        information, damping = _information(curve, data), damping / 6
    return Optimum(at, cost, information)


def promised(model: Model, data: Averages, at: Floats) -> float:
    """To first order, by how much the least cost is below that at some parameters (score test)."""
    curve = model(at)
    gradient = _gradient(curve, data)
    return float(gradient @ np.linalg.solve(_information(curve, data), gradient))


def _step(jacobian: Floats, square: Floats, gradient: Floats) -> Floats:
    """The scoring step, shortened where it would move a log μ far: r grows exponentially."""
    step = np.asarray(np.linalg.solve(square, gradient), dtype=np.float64)
    return step * min(1.0, _FAR / max(float(np.abs(jacobian @ step).max()), 1e-300))


def _cost(model: Model, data: Averages, at: Floats) -> tuple[Curve, float]:
    curve = model(at)
    return curve, float(deviance(data, curve.log_mean).sum()) + curve.penalty


def _gradient(curve: Curve, data: Averages) -> Floats:
    """Minus half the gradient of the cost."""
    return curve.jacobian.T @ (data.shape * np.expm1(_gap(data, curve.log_mean))) + curve.pull


def _gap(data: Averages, log_mean: Floats) -> Floats:
    return np.minimum(np.maximum(data.log_power - log_mean, -_RATIO), _RATIO)


def _information(curve: Curve, data: Averages) -> Floats:
    return (curve.jacobian * data.shape[:, None]).T @ curve.jacobian + curve.stiffness


def profile_bound(
    model: Model,
    data: Averages,
    best: Optimum,
    index: int,
    side: int,
    rise: float,
    limits: tuple[Floats, Floats],
    elsewhere: Callable[[float], Floats] | None = None,
) -> float | None:
    """Where the least cost with one parameter held exceeds the least cost of all by ``rise``.

    Parameters
    ----------
    index : int
        The parameter.
    side : {-1, 1}
        Below or above its best value.
    rise : float
        A quantile of χ² with one degree of freedom makes this the end of a likelihood interval.
    elsewhere : callable, optional
        Parameters to start from as well for a held value, where the cost may have two valleys.

    Returns
    -------
    float or None
        None if the parameter's limit is reached first.

    Notes
    -----
    The root of the rise is nearly linear in the parameter, so that secants on it find the end.
    """
    centre, limit = float(best.parameters[index]), float(limits[side > 0][index])
    target, least, at = sqrt(rise), best.cost, best.parameters
    inner, outer = (0.0, 0.0), None
    spread = best.covariance()[:, index]
    along = spread / spread[index]  # how the others move with it while the cost stays least
    distance = target * sqrt(float(spread[index]))
    for _ in range(12):
        reached = min(distance, abs(limit - centre))
        held = at + (centre + side * reached - at[index]) * along
        starts = [np.clip(held, *limits)]
        if elsewhere is not None:
            starts.append(elsewhere(float(starts[0][index])))
        fits = [fit(model, data, s, limits, (index,), 25, 1e-2) for s in starts]
        found = min(fits, key=lambda f: f.cost)
        least, at = min(least, found.cost), found.parameters
        root = sqrt(found.cost - least)
        if abs(root - target) <= _NEAR * target:
            return centre + side * reached
        if root < target:
            if reached < distance or reached == abs(limit - centre):
                return None
            inner = (reached, root)
        else:
            outer = (reached, root)
        distance = _next(inner, outer, target)
    return centre + side * distance


def _next(inner: tuple[float, float], outer: tuple[float, float] | None, target: float) -> float:
    """Next distance to try: further out by the ratio of roots, or between two by the secant."""
    if outer is None:
        return inner[0] * min(max(target / max(inner[1], 1e-3), 1.1), 2.5)
    share = (target - inner[1]) / max(outer[1] - inner[1], 1e-12)
    return inner[0] + (outer[0] - inner[0]) * min(max(share, 0.05), 0.95)


def largest_deviance(shape: Floats, level: float) -> float:
    """A threshold that the deviance at the true μ exceeds with probability at most ``level``.

    With K(λ) = Σ log E exp(2λR(g − 1 − log g)), g ~ Gamma(R)/R, the Chernoff bound is
    P(D >= (K(λ) + log(1/level))/λ) <= level for every 0 < λ < 1/2. One term of K is, by the gamma
    integral with a = R(1 − 2λ), R log R − log Γ(R) + log Γ(a) − a log a − 2Rλ.

    Notes
    -----
    Values that vary less than Gamma(R)/R in the convex order obey it too, the deviance being
    convex: averages over more than R realisations among them.
    """
    values, times = np.unique(shape, return_counts=True)
    gammaln = special().gammaln
    rest = values[:, None] * (1 - 2 * _EXPONENTS)
    terms = values * np.log(values) - gammaln(values)
    grown = terms[:, None] + gammaln(rest) - rest * np.log(rest)
    grown -= 2 * values[:, None] * _EXPONENTS
    return float(np.min((times @ grown - log(level)) / _EXPONENTS))
