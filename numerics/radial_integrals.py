"""Eq. 17 along one region as a certified number, by three independent routes.

- ``closed``: the power-rule form of ``specrate.theory.radial``, in ball arithmetic.
- ``quadrature``: ball-arithmetic quadrature of the two spectra, with breaks at ρ0 and ν, each
  piece in t = log ρ, so that any N is a matter of the length of an interval; the ends at 0 and ∞
  are cut where the rest is bounded below the error asked for.
- ``mpmath``: ``mpmath.quad`` of the same pieces in t, an estimate that certifies nothing.

Every input is exact (a fraction; N a fraction or a power of ten), so that b = 1 ± 1e-12 or
N = 1e5000 lose nothing: ball arithmetic raises its precision until the digits stand.
"""

import re
import time
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from itertools import pairwise

from ..theory.errors import InputError
from ..theory.radial import Leading, PowerLog, Radial, leading, power_log_terms
from ..theory.symbolic import Expr, Integer, Rational, sympy
from .balls import Ball, Certified, certified, exact_ball, flint, spelled
from .integrands.protocol import Mpf, mp

_NUMBER = re.compile(
    r"[+-]?(\d{1,60}(\.\d{0,60})?|\.\d{1,60})([eE][+-]?\d{1,4})?|[+-]?\d{1,60}/\d{1,60}"
)
_LONGEST = 40  # in t = log ρ: over longer pieces mpmath.quad loses digits and does not say so
_LOG = re.compile(r"log:([+-]?\d{1,9}(\.\d{0,60})?)")


@dataclass(frozen=True)
class RadialProblem:
    """Eq. 17 for one monomial and one integrand, all numbers exact.

    Parameters
    ----------
    degree : Fraction
        b >= 0.
    dimension : int
        s >= 1.
    decay : Fraction or None
        p > s; None is the best case, no power beyond ρ0.
    log10_n : Fraction
        Decimal logarithm of N, if N is a power of ten; else None and ``count`` holds N.
    count : Fraction or None
        N > 0.
    effective : Fraction
        e >= 0 in ν = α N^e.
    gamma, alpha, rho0 : Fraction
        Positive.
    continuous : bool
        Whether P_f is continuous at ρ0, c2 = c ρ0^p with c = 1 (else c2 = c = 1, the paper's).
    """

    degree: Fraction
    dimension: int
    decay: Fraction | None
    count: Fraction | None
    log10_n: Fraction | None
    effective: Fraction
    gamma: Fraction = Fraction(1)
    alpha: Fraction = Fraction(1)
    rho0: Fraction = Fraction(1)
    continuous: bool = True

    def __post_init__(self) -> None:
        rules: list[tuple[bool, str, object]] = [
            (self.degree >= 0, "0 <= degree", self.degree),
            (self.dimension >= 1, "1 <= dim", self.dimension),
            (self.decay is None or self.decay > self.dimension, "decay > dim", self.decay),
            (self.effective >= 0, "0 <= effective", self.effective),
            (self.gamma > 0, "0 < gamma", self.gamma),
            (self.alpha > 0, "0 < alpha", self.alpha),
            (self.rho0 > 0, "0 < rho0", self.rho0),
            ((self.count is None) != (self.log10_n is None), "one N", self.count),
            (self.count is None or self.count > 0, "0 < n", self.count),
        ]
        for holds, rule, value in rules:
            if not holds:
                raise InputError(f"a radial problem must satisfy {rule}: got {value}")

    def theory(self) -> Radial:
        """The same problem in the theory room."""
        c2: Expr = Integer(0)
        if self.decay is not None:
            c2 = _rational(self.rho0) ** _rational(self.decay) if self.continuous else Integer(1)
        return Radial(
            _rational(self.degree),
            Integer(self.dimension),
            sympy.oo if self.decay is None else _rational(self.decay),
            _rational(self.effective),
            _rational(self.gamma),
            _rational(self.alpha),
            Integer(1),
            c2,
            _rational(self.rho0),
        )


@dataclass(frozen=True)
class RadialResult:
    """Value with its bound, its natural logarithm, leading term and the time it took."""

    value: Certified
    log_value: str
    leading: Leading | None
    route: str
    seconds: float


def radial(
    degree: str,
    dim: int,
    decay: str,
    n: str,
    effective: str | None = None,
    alpha: str = "1",
    gamma: str = "1",
    rho0: str = "1",
    discontinuous: bool = False,
    digits: int = 15,
) -> RadialResult:
    """Eq. 17 along one region, certified.

    Parameters
    ----------
    degree, decay, n, effective, alpha, gamma, rho0 : str
        Exact numbers: ``3/2``, ``0.1``, ``1e-30``. ``decay`` may be ``oo``, the best case; ``n``
        may be ``log:5000``, its decimal logarithm. ``effective`` is 1/dim unless given.
    dim : int
        s, the dimension of the region.
    discontinuous : bool
        Whether c2 = c, as printed in the paper, instead of a continuous P_f.
    digits : int

    Raises
    ------
    InputError
        If a number is not one, or out of its range.
    """
    log_n = _LOG.fullmatch(n.strip())
    problem = RadialProblem(
        exact_number(degree, "degree"),
        dim,
        None if decay.strip() == "oo" else exact_number(decay, "decay"),
        None if log_n else exact_number(n, "n"),
        Fraction(log_n.group(1)) if log_n else None,
        Fraction(1, max(dim, 1)) if effective is None else exact_number(effective, "effective"),
        exact_number(gamma, "gamma"),
        exact_number(alpha, "alpha"),
        exact_number(rho0, "rho0"),
        not discontinuous,
    )
    return solve(problem, digits)


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


def _rational(value: Fraction) -> Expr:
    return Rational(value.numerator, value.denominator)


def solve(problem: RadialProblem, digits: int = 15, route: str = "closed") -> RadialResult:
    """Eq. 17 to a number of certified digits.

    Parameters
    ----------
    digits : int
        1 to 10 000.
    route : {"closed", "quadrature"}

    Raises
    ------
    InputError
        If the digits are out of range or out of reach.
    """
    if not 1 <= digits <= 10_000:
        raise InputError(f"--digits must be in 1..10000: got {digits}")
    began = time.perf_counter()
    evaluate = _closed(problem) if route == "closed" else _quadrature(problem)
    ball = certified(evaluate, digits)
    log_value = certified(lambda: evaluate().log(), min(digits, 15))
    seconds = time.perf_counter() - began
    found = leading(problem.theory())
    return RadialResult(
        spelled(ball, digits), spelled(log_value, min(digits, 15)).value, found, route, seconds
    )


def _count(problem: RadialProblem) -> Ball:
    return _log_count(problem).exp() if problem.count is None else exact_ball(problem.count)


def _log_count(problem: RadialProblem) -> Ball:
    if problem.count is not None:
        return exact_ball(problem.count).log()
    assert problem.log10_n is not None
    return exact_ball(problem.log10_n) * flint.arb(10).log()


def _log_nu(problem: RadialProblem) -> Ball:
    """log ν = log α + e log N, without forming N where its logarithm is given."""
    log_n = _log_count(problem)
    return exact_ball(problem.alpha).log() + exact_ball(problem.effective) * log_n


def is_crossed(problem: RadialProblem) -> bool:
    """Whether ρ0 <= ν, decided in balls; equality counts as crossed, both forms agree there."""
    for bits in (64, 256, 1024):
        before, flint.ctx.prec = flint.ctx.prec, bits
        try:
            gap = _log_nu(problem) - exact_ball(problem.rho0).log()
            if gap > 0:
                return True
            if gap < 0:
                return False
        finally:
            flint.ctx.prec = before
    return True


def _closed(problem: RadialProblem) -> Callable[[], Ball]:
    """The sum of powers of ν, term by term."""
    terms = power_log_terms(problem.theory(), is_crossed(problem))

    def evaluate() -> Ball:
        log_nu = _log_nu(problem)
        log_gap = log_nu - exact_ball(problem.rho0).log()
        total = flint.arb(0)
        for t in terms:
            total += _term(t, log_nu, log_gap)
        return total * exact_ball(problem.gamma) / _count(problem)

    return evaluate


def _term(term: PowerLog, log_nu: Ball, log_gap: Ball) -> Ball:
    value = _ball_of(term.coefficient) * (_ball_of(term.power) * log_nu).exp()
    return value * log_gap if term.log else value


def _ball_of(expression: Expr) -> Ball:
    """A product of rational powers of rationals as a ball."""
    if expression.is_Rational:
        return flint.arb(flint.fmpq(int(expression.p), int(expression.q)))
    if expression.is_Pow:
        return (_ball_of(expression.exp) * _ball_of(expression.base).log()).exp()
    if expression.is_Mul:
        value = flint.arb(1)
        for factor in expression.args:
            value *= _ball_of(factor)
        return value
    if expression.is_Add:
        return sum((_ball_of(a) for a in expression.args), flint.arb(0))
    raise InputError(f"a radial constant must be made of rational powers: got {expression}")


# A piece is (log amplitude, power, from, to): ∫ A e^(power t) dt, t = log ρ; None is ±∞.
_Piece = tuple[Ball, Ball, Ball | None, Ball | None]


def _pieces(problem: RadialProblem) -> list[_Piece]:
    """The integrand ρ^s P_S P_f of d(log ρ) between the breaks −∞, log ρ0, log ν, ∞."""
    log_nu, log_rho0 = _log_nu(problem), exact_ball(problem.rho0).log()
    b, s = exact_ball(problem.degree), exact_ball(problem.dimension)
    crossed = is_crossed(problem)
    breaks = [log_rho0, log_nu] if crossed else [log_nu, log_rho0]
    found: list[_Piece] = []
    for index, (low, high) in enumerate(zip([None, *breaks], [*breaks, None], strict=True)):
        rising = high is log_nu or (index == 0 and crossed)
        falling = low is log_rho0 or (index == 2 and crossed)
        if falling and problem.decay is None:
            continue
        log_amplitude, power = flint.arb(0), s
        if rising:
            log_amplitude, power = log_amplitude - b * log_nu, power + b
        if falling:
            assert problem.decay is not None
            p = exact_ball(problem.decay)
            power = power - p
            log_amplitude = log_amplitude + (p * log_rho0 if problem.continuous else 0)
        found.append((log_amplitude, power, low, high))
    return found


def _quadrature(problem: RadialProblem) -> Callable[[], Ball]:
    """Ball quadrature of each piece; tails are cut where they are bounded and added as errors."""

    def evaluate() -> Ball:
        total = flint.arb(0)
        for log_amplitude, power, low, high in _pieces(problem):
            total += integral(log_amplitude, power, low, high)
        return total * exact_ball(problem.gamma) / _count(problem)

    def integral(log_amplitude: Ball, power: Ball, low: Ball | None, high: Ball | None) -> Ball:
        cut = flint.arb(flint.ctx.prec) * flint.arb(2).log() / abs(power)
        anchor = low if low is not None else high
        assert anchor is not None
        start = low if low is not None else anchor - cut
        end = high if high is not None else anchor + cut
        length = end - start
        # The quadrature's absolute tolerance is made for values near 1: scale by the larger end.
        top = end if power > 0 else start
        turn = flint.acb(0 if top is start else -1)
        steep = flint.acb(power * length)

        def density(x: Ball, _: bool) -> Ball:
            return (steep * (x + turn)).exp()

        head = flint.acb.integral(density, 0, 1).real
        value = (log_amplitude + power * top).exp() * length * head
        if low is None or high is None:
            edge = end if high is None else start
            rest = (log_amplitude + power * edge).exp() / abs(power)  # the tail's exact size
            value += rest.union(flint.arb(0))
        return value

    return evaluate


def by_mpmath(problem: RadialProblem, digits: int = 15) -> Mpf:
    """``mpmath.quad`` over the same pieces in log ρ: an estimate, certified by nothing."""
    with mp.workdps(digits + 10):
        ten = mp.mpf(10)
        if problem.count is not None:
            n = mp.mpf(problem.count.numerator) / problem.count.denominator
        else:
            assert problem.log10_n is not None
            n = ten ** (mp.mpf(problem.log10_n.numerator) / problem.log10_n.denominator)
        b, e, rho0 = (_mpf(v) for v in (problem.degree, problem.effective, problem.rho0))
        nu = _mpf(problem.alpha) * n**e

        def density(t: Mpf) -> Mpf:
            rho = mp.exp(t)
            below = min(rho / nu, mp.mpf(1)) ** b
            if rho < rho0:
                return rho**problem.dimension * below
            if problem.decay is None:
                return mp.mpf(0)
            p = _mpf(problem.decay)
            fall = (rho0 / rho) ** p if problem.continuous else rho**-p
            return rho**problem.dimension * below * fall

        breaks = sorted({mp.log(rho0), mp.log(nu)})
        reach = (digits + 10) * mp.log(10)
        slowest = 1 if problem.decay is None else _mpf(problem.decay) - problem.dimension
        ends = [breaks[0] - reach, *breaks, breaks[-1] + reach / slowest]
        points = [
            low + (high - low) * k / parts
            for low, high in pairwise(ends)
            for parts in [max(1, int(mp.ceil((high - low) / _LONGEST)))]
            for k in range(parts)
        ]
        # mpmath.quad stops at an absolute error: make the largest value about 1.
        top = max(density(t - mp.mpf("0.01")) for t in breaks)  # inside: at ρ0 P_f may be 0
        total = mp.quad(lambda t: density(t) / top, [*points, ends[-1]])  # pyright: ignore[reportUnknownLambdaType]
        return +(_mpf(problem.gamma) / n * top * total)


def _mpf(value: Fraction) -> Mpf:
    return mp.mpf(value.numerator) / value.denominator
