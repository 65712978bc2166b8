"""Ball arithmetic: exact input, and as many certified digits as asked for.

A ball is a number with a proven bound on its error (python-flint's ``arb``). Input is exact,
a fraction or a power of ten, and is made a ball anew at each precision; ``certified`` raises the
precision until the digits stand, so that cancellation costs time and never digits.
"""

import re
import signal
import threading
from collections.abc import Callable, Generator
from contextlib import contextmanager
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, log2
from types import FrameType
from typing import Any, TypeAlias

import flint as _flint  # pyright: ignore[reportMissingTypeStubs]

from ..theory.errors import InputError

flint: Any = _flint
"""The python-flint module, which carries no types."""

Ball: TypeAlias = Any
"""A real ball, ``flint.arb``. The square of one that may hold 0 is x * x: x**2 gives nan."""

Complex: TypeAlias = Any
"""A complex ball, ``flint.acb``."""

Rational: TypeAlias = Any
"""An exact rational number, ``flint.fmpq``."""

_MOST_BITS = 1 << 20
_NOTHING: Any = flint.acb("nan", "nan")
_NUMBER = re.compile(
    r"[+-]?(\d{1,60}(\.\d{0,60})?|\.\d{1,60})([eE][+-]?\d{1,4})?|[+-]?\d{1,60}/\d{1,60}"
)


@dataclass(frozen=True)
class Certified:
    """A number and a bound that its error cannot exceed, as decimal strings.

    Parameters
    ----------
    value : str
        With the digits asked for.
    error_bound : str
        Of ``value`` as written: the ball's radius and the rounding to decimals.
    """

    value: str
    error_bound: str


def rational(number: Fraction | int) -> Any:
    """The number as ``flint.fmpq``, whose arithmetic is exact and fast."""
    return flint.fmpq(number.numerator, number.denominator)


def exact_ball(number: Fraction | int) -> Ball:
    """The ball around a rational, at the precision in force."""
    return flint.arb(rational(number))


def certified(evaluate: Callable[[], Ball], digits: int) -> Ball:
    """The ball of ``evaluate()`` with a relative radius below 10^-digits, or exactly zero.

    Parameters
    ----------
    evaluate : callable
        Builds its ball from exact input at the precision in force.
    digits : int
        Decimal digits, 1 or more.

    Raises
    ------
    InputError
        If a million bits are not enough.
    """
    bits = ceil((digits + 3) * log2(10)) + 20
    before = flint.ctx.prec
    try:
        while bits <= _MOST_BITS:
            flint.ctx.prec = bits
            ball = evaluate()
            if ball.is_exact() or ball.rel_accuracy_bits() >= (digits + 1) * log2(10):
                return ball
            bits *= 2
    finally:
        flint.ctx.prec = before
    raise InputError(
        f"{digits} digits must be within reach of {_MOST_BITS} bits: got no convergence"
    )


def integrated(
    integrand: Callable[[Complex, bool], Complex],
    start: Ball | int,
    end: Ball | int,
    **options: Any,
) -> Ball:
    """The real part of a ball-arithmetic integral, ``flint.acb.integral``.

    The compiled integral goes on past what its integrand raises, with a value that says nothing;
    so that is kept and raised here. An interrupt waits for the integrand to be asked again: raised
    between two lines of it, it would get lost.
    """
    raised: list[BaseException] = []

    def guarded(x: Complex, analytic: bool) -> Complex:
        try:
            return _NOTHING if raised else integrand(x, analytic)
        except BaseException as error:
            raised.append(error)
            return _NOTHING

    with _interrupts(raised):
        value = flint.acb.integral(guarded, start, end, **options).real
    if raised:
        raise raised[0]
    return value


@contextmanager
def _interrupts(raised: list[BaseException]) -> Generator[None]:
    """Interrupts are put on the list; they come to the main thread alone."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def note(_number: int, _frame: FrameType | None) -> None:
        raised.append(KeyboardInterrupt())

    before = signal.signal(signal.SIGINT, note)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


def spelled(ball: Ball, digits: int) -> Certified:
    """The ball's middle with ``digits`` digits, and a bound on the error of that text."""
    before = flint.ctx.prec
    try:
        flint.ctx.prec = max(before, ceil((digits + 10) * log2(10)))
        text = ball.mid().str(digits, radius=False)
        error = abs(flint.arb(text) - ball).upper()
        bound = (error * (1 + flint.arb(2) ** -20)).str(3, radius=False)
        if flint.arb(bound) < error:
            bound = (error * flint.arb("1.01")).str(3, radius=False)
        return Certified(text, bound)
    finally:
        flint.ctx.prec = before


def exact_number(text: str, name: str) -> Fraction:
    """A fraction, decimal or power-of-ten literal, read exactly.

    Raises
    ------
    InputError
        If it is none, or longer than a number needs to be.
    """
    word = text.strip()
    if not _NUMBER.fullmatch(word) or word.endswith("/0"):
        raise InputError(f"{name} must be a number such as 3/2, 0.1 or 1e-30: got {text!r}")
    try:
        return Fraction(word)
    except ZeroDivisionError:
        raise InputError(f"{name} must be a number such as 3/2: got {text!r}") from None
