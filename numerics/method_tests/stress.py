"""Stiff and extreme cases: every method against a certified reference, and whether it is honest.

A method is honest in a case if the error that it reports, a bound or an estimate, is at least its
true error: no slack, and the same rule for both. The truth is a ball of 100 digits, computed once
per case, where two certified routes exist by another than the method's own. Where a method refuses
clearly, with an ``InputError``, it is honest; where it fails in another way it is not.
"""

import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass
from math import inf, isfinite, log2
from textwrap import shorten
from typing import Any, Generic, Literal, TypeVar

from ...theory.errors import InputError
from ..balls import Ball, flint
from ..integrands.protocol import Mpf, mp

DIGITS = 100
"""Certified digits of a reference."""

Kind = Literal["bound", "estimate"]
P = TypeVar("P")

_QUICK, _TIMES = 0.02, 5  # a method is called twice; more often while that takes so few seconds
_LINE = 160  # letters of a refusal
_BITS = 600  # of the comparison: more than a reference has


@dataclass(frozen=True)
class Outcome:
    """What a method says: a value, the absolute error that it allows for, and of which kind."""

    value: Mpf
    error: Mpf
    kind: Kind


@dataclass(frozen=True)
class Method(Generic[P]):
    """A way to a number.

    Parameters
    ----------
    name : str
    evaluate : callable
        Raises ``InputError`` where the problem is out of its reach.
    route : str
        The reference that rests on the same formula, if there is one.
    attempts : callable
        Whether the problem is of a kind that the method is for.
    """

    name: str
    evaluate: Callable[[P], Outcome]
    route: str = ""
    attempts: Callable[[P], bool] = lambda _: True


@dataclass(frozen=True)
class Reference(Generic[P]):
    """A certified route: a ball of 100 digits, or an ``InputError`` where it does not apply."""

    route: str
    evaluate: Callable[[P], Ball]


@dataclass(frozen=True)
class Family(Generic[P]):
    """Problems of one kind, by name, what solves them, and what is known of them for certain."""

    name: str
    problems: tuple[tuple[str, P], ...]
    methods: tuple[Method[P], ...]
    references: tuple[Reference[P], ...]


@dataclass(frozen=True)
class Judgement:
    """One method in one case.

    Parameters
    ----------
    reference : str
        The certified route that was compared with.
    seconds : float
        The shortest of two calls or more: the first one may import.
    relative_error, error_bound : float or None
        True and reported error, both relative to the true value, or absolute where that is 0;
        None if the method refused or failed.
    error_kind : {"bound", "estimate"} or None
    honest, refused : bool
    why : str or None
        Why it refused or failed, or what is wrong.
    value : str or None
    """

    name: str
    method: str
    reference: str
    seconds: float
    relative_error: float | None = None
    error_bound: float | None = None
    error_kind: Kind | None = None
    honest: bool = False
    refused: bool = False
    why: str | None = None
    value: str | None = None


def stress(
    families: Iterable[Family[Any]], progress: Callable[[str], None] = lambda _: None
) -> dict[str, Any]:
    """Every problem by every method that attempts it, as a document.

    Parameters
    ----------
    families : iterable of Family
    progress : callable
        Told the name of each case before it is computed.

    Returns
    -------
    dict
        ``cases``, one object per problem and method with the fields of `Judgement`; ``honest``,
        whether all are; ``interrupted``, whether some are missing; ``seconds``.
    """
    began, interrupted = time.perf_counter(), False
    found: list[Judgement] = []
    try:
        for family in families:
            for name, problem in family.problems:
                for judgement in _judged(family, f"{family.name}: {name}", problem, progress):
                    found.append(judgement)
    except KeyboardInterrupt:
        interrupted = True
    return {
        "cases": [asdict(j) for j in found],
        "honest": all(j.honest for j in found),
        "interrupted": interrupted,
        "seconds": time.perf_counter() - began,
    }


def _judged(
    family: Family[P], name: str, problem: P, progress: Callable[[str], None]
) -> Iterator[Judgement]:
    known: dict[str, Ball | None] = {}
    for method in family.methods:
        if not method.attempts(problem):
            continue
        progress(f"{name}, {method.name}")
        route, truth = _truth(family.references, problem, method.route, known)
        outcome, seconds = _attempt(method, problem)
        if isinstance(outcome, Exception):
            yield _unanswered(name, method.name, outcome, seconds, route)
        else:
            yield _judgement(name, method.name, outcome, seconds, route, truth)


def _truth(
    references: Sequence[Reference[P]], problem: P, avoided: str, known: dict[str, Ball | None]
) -> tuple[str, Ball]:
    """The first reference that applies, those of the method's own route last."""
    for reference in sorted(references, key=lambda r: r.route == avoided):
        if reference.route not in known:
            known[reference.route] = _reference_ball(reference, problem)
        ball = known[reference.route]
        if ball is not None:
            return reference.route, ball
    raise AssertionError("a stress case must have a certified reference")


def _reference_ball(reference: Reference[P], problem: P) -> Ball | None:
    try:
        ball = reference.evaluate(problem)
    except InputError:
        return None
    has_digits = ball.is_exact() or ball.rel_accuracy_bits() >= (DIGITS - 1) * log2(10)
    return ball if has_digits else None


def _attempt(method: Method[P], problem: P) -> tuple[Outcome | Exception, float]:
    """The outcome, or why there is none, and the time it took."""
    outcome: Outcome | Exception = InputError("not attempted")
    shortest, spent, calls = inf, 0.0, 0
    while calls < 2 or (spent < _QUICK and calls < _TIMES):
        began = time.perf_counter()
        try:
            outcome = method.evaluate(problem)
        except Exception as error:  # whatever it is, the method has failed and the run goes on
            outcome = error
        seconds = time.perf_counter() - began
        shortest, spent, calls = min(shortest, seconds), spent + seconds, calls + 1
    return outcome, shortest


def _unanswered(name: str, method: str, error: Exception, seconds: float, route: str) -> Judgement:
    refused = isinstance(error, InputError)
    why = f"refused: {error}" if refused else f"failed: {type(error).__name__}: {error}"
    return Judgement(
        name, method, route, seconds, honest=refused, refused=refused, why=shorten(why, _LINE)
    )


def _judgement(
    name: str, method: str, outcome: Outcome, seconds: float, route: str, truth: Ball
) -> Judgement:
    value = mp.nstr(outcome.value, 20)
    place: dict[str, Any] = {"name": name, "method": method, "reference": route}
    place |= {"value": value, "error_kind": outcome.kind, "seconds": seconds}
    if not (mp.isfinite(outcome.value) and mp.isfinite(outcome.error)):
        why = f"not a number: {value} with an error of {mp.nstr(outcome.error, 3)}"
        return Judgement(**place, why=why)
    true_error, error = relative_errors(outcome, truth)
    honest = is_honest(outcome, truth)
    why = None if honest else f"its {outcome.kind} of the error is below the error"
    return Judgement(**place, relative_error=true_error, error_bound=error, honest=honest, why=why)


def is_honest(outcome: Outcome, truth: Ball) -> bool:
    """Whether the reported error is at least the true one, as far as the reference can tell."""
    with flint.ctx.workprec(_BITS):
        return not abs(as_ball(outcome.value) - truth) > as_ball(outcome.error)


def relative_errors(outcome: Outcome, truth: Ball) -> tuple[float | None, float | None]:
    """True and reported error over the true value; themselves where that is 0; None: too large."""
    with flint.ctx.workprec(_BITS):
        unit: Ball = flint.arb(1) if truth.is_zero() else abs(truth.mid())
        gap: Ball = abs(as_ball(outcome.value) - truth.mid()) / unit
        return _finite(float(gap)), _finite(float(as_ball(outcome.error) / unit))


def _finite(number: float) -> float | None:
    return number if isfinite(number) else None


def as_ball(number: Mpf) -> Ball:
    """A number of mpmath as it is, with radius 0."""
    sign, mantissa, exponent, _ = mp.convert(number)._mpf_  # as it is: mp.mpf would round
    return flint.arb((-mantissa if sign else mantissa, exponent))


def number_text(n: int) -> str:
    """A whole number in the name of a case: ``1000000000``, ``1e300``."""
    return f"{n:.10g}".replace("e+", "e")
