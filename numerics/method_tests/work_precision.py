"""Work and precision: the error that methods make on one problem against the time they take.

A method climbs a ladder of its own accuracy parameter: digits, tolerance, frequencies,
realisations. The error of each step is measured against a reference with more digits than any step
asks for; of Monte Carlo it is the root mean square over independent repetitions, with an interval.
Times are those of warm calls, the shortest of several.

Beside it stand the times in which Eq. 17 is had to 50 digits at N = 1e30, and their ratios.
"""

import platform
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from fractions import Fraction
from functools import partial
from importlib.metadata import version
from itertools import zip_longest
from math import inf
from typing import Any, TypeVar

from ..balls import Ball, certified
from ..equation17.radial_estimates import by_mpmath
from ..equation17.radial_integrals import RadialProblem, prepared
from ..measuring.moments import Interval
from .stress import relative_errors
from .work_precision_ladders import LEVEL, PROBLEMS, REPETITIONS, Ladder, ladders

T = TypeVar("T")

_REFERENCE = 120  # digits
_DIGITS, _POWER = 50, 30  # of the ratios: digits, and N = 10^30
_DEGREES = ("1/2", "1", "2", "3")
_DIMENSIONS = (1, 2, 3, 10)
_SPENT, _MOST_CALLS = 0.05, 200  # seconds of calls, and how many, among which the shortest counts


@dataclass(frozen=True)
class Point:
    """One step of one method.

    Parameters
    ----------
    problem, method : str
    parameter, step : str
        What was asked of the method, such as ``digits`` and ``50``.
    relative_error : float
        Measured; of Monte Carlo the root mean square.
    low, high : float or None
        95 % interval of a root mean square.
    reported_error : float or None
        What the method says of its error, relative to the value.
    seconds : float
        For one answer.
    """

    problem: str
    method: str
    parameter: str
    step: str
    relative_error: float | None
    low: float | None
    high: float | None
    reported_error: float | None
    seconds: float


@dataclass(frozen=True)
class Ratio:
    """Times of Eq. 17 in the worst case, for one degree b and dimension d.

    Parameters
    ----------
    degree : str
    dim, digits : int
    n : str
    preparation, closed, quadrature, mpmath : float
        Seconds: preparing the closed form, one evaluation of it, ball quadrature, mpmath.quad.
    closed_ratio, quadrature_ratio : float
        How many times as long mpmath.quad takes.
    """

    degree: str
    dim: int
    n: str
    digits: int
    preparation_seconds: float
    closed_seconds: float
    quadrature_seconds: float
    mpmath_seconds: float
    closed_ratio: float
    quadrature_ratio: float


def work_precision(
    budget: float = 60.0, seed: int = 0, progress: Callable[[str], None] = lambda _: None
) -> dict[str, Any]:
    """Points of the work-precision diagram and ratios of times, as a document.

    Parameters
    ----------
    budget : float
        Seconds after which no further step is begun, half of them for the ratios; of each at least
        one is made.
    seed : int
        Of Monte Carlo.
    progress : callable
        Told each step before it is taken.

    Returns
    -------
    dict
        ``problems`` with their values, ``points`` as in `Point`, ``ratios`` as in `Ratio`,
        ``left_out``, and the ``plan`` that was executed.
    """
    began = time.perf_counter()
    truths = {p.name: p.truth(_REFERENCE) for p in PROBLEMS}
    climbed = [*ladders(seed)]
    ratios, missing = _until(began + budget / 2, _ratios(), progress)
    points, late = _until(began + budget, _steps(climbed, truths), progress)
    return {
        "problems": [
            {"name": p.name, "about": p.about, "value": truths[p.name].str(30, radius=False)}
            for p in PROBLEMS
        ],
        "points": [asdict(p) for p in points],
        "ratios": [asdict(r) for r in ratios],
        "left_out": [{"what": x, "why": "the budget was spent"} for x in missing + late],
        "plan": _plan(climbed, budget, seed),
        "seconds": time.perf_counter() - began,
    }


def _plan(climbed: Sequence[Ladder], budget: float, seed: int) -> dict[str, Any]:
    packages = ("specrate", "python-flint", "mpmath", "numpy", "scipy")
    return {
        "seed": seed,
        "budget": budget,
        "reference_digits": _REFERENCE,
        "repetitions": REPETITIONS,
        "level": LEVEL,
        "ladders": [
            {
                "problem": x.problem,
                "method": x.method,
                "parameter": x.parameter,
                "steps": [f"{s:g}" if isinstance(s, float) else str(s) for s in x.steps],
            }
            for x in climbed
        ],
        "versions": {"python": platform.python_version()} | {p: version(p) for p in packages},
        "machine": platform.machine(),
    }


def _until(
    deadline: float, tasks: Iterable[tuple[str, Callable[[], T]]], progress: Callable[[str], None]
) -> tuple[list[T], list[str]]:
    """What the tasks give, the first one in any case, and the names of those that came too late."""
    found: list[T] = []
    late: list[str] = []
    for name, task in tasks:
        if found and time.perf_counter() > deadline:
            late.append(name)
        else:
            progress(name)
            found.append(task())
    return found, late


def _steps(
    climbed: Sequence[Ladder], truths: Mapping[str, Ball]
) -> Iterator[tuple[str, Callable[[], Point]]]:
    """The first step of every ladder, then the second ones, and so on."""
    for rung in zip_longest(*([(x, step) for step in x.steps] for x in climbed)):
        for place in filter(None, rung):
            ladder, step = place
            name = f"{ladder.problem}, {ladder.method}: {ladder.parameter} {step}"
            yield name, partial(_point, ladder, step, truths[ladder.problem])


def _point(ladder: Ladder, step: Any, truth: Ball) -> Point:
    ladder.call(step if ladder.warm_up is None else ladder.warm_up)
    result, seconds = _shortest(partial(ladder.call, step), _MOST_CALLS if ladder.repeated else 1)
    answer = ladder.read(result)
    low = high = reported = None
    if isinstance(answer, Interval):
        error, low, high = answer
    else:
        error, reported = relative_errors(answer, truth)
    shown = f"{step:g}" if isinstance(step, float) else str(step)
    place = (ladder.problem, ladder.method, ladder.parameter, shown)
    return Point(*place, error, low, high, reported, seconds / ladder.answers)


def _shortest(call: Callable[[], T], most: int) -> tuple[T, float]:
    """The result, and the shortest time of calls that take 0.05 s or two of them."""
    shortest, spent, calls = inf, 0.0, 0
    while True:
        began = time.perf_counter()
        result = call()
        seconds = time.perf_counter() - began
        shortest, spent, calls = min(shortest, seconds), spent + seconds, calls + 1
        if calls >= most or (calls >= 2 and spent > _SPENT):
            return result, shortest


def _ratios() -> Iterator[tuple[str, Callable[[], Ratio]]]:
    for degree in _DEGREES:
        for dim in _DIMENSIONS:
            yield f"times of Eq. 17, b = {degree}, d = {dim}", partial(_ratio, degree, dim)


def _ratio(degree: str, dim: int) -> Ratio:
    problem = RadialProblem(
        Fraction(degree), dim, Fraction(dim + 1), Fraction(10**_POWER), None, Fraction(1, dim)
    )
    closed, preparation = _shortest(lambda: prepared(problem), _MOST_CALLS)
    quadrature = prepared(problem, "quadrature")
    _, by_closed = _shortest(lambda: certified(closed, _DIGITS), _MOST_CALLS)
    _, by_quadrature = _shortest(lambda: certified(quadrature, _DIGITS), _MOST_CALLS)
    _, by_mp = _shortest(lambda: by_mpmath(problem, _DIGITS), _MOST_CALLS)
    times = (preparation, by_closed, by_quadrature, by_mp)
    ratios = (by_mp / by_closed, by_mp / by_quadrature)
    return Ratio(degree, dim, f"1e{_POWER}", _DIGITS, *times, *ratios)
