"""Eq. 17 along one region as a certified number, by two independent routes.

- ``closed``: the power-rule form of ``specrate.theory.radial``, in ball arithmetic.
- ``quadrature``: ball-arithmetic quadrature of the two spectra, with breaks at ρ0 and ν, each
  piece in t = log ρ, so that any N is a matter of the length of an interval; the ends at 0 and ∞
  are cut where the rest is bounded below the error asked for.

Every input is exact (a fraction; N a fraction or a power of ten), so that b = 1 ± 1e-12 or
N = 1e5000 lose nothing: ball arithmetic raises its precision until the digits stand. Scales enter
by their logarithms: ρ0^b of a step is a number of a million digits, its logarithm is not.
"""

import re
import time
from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from math import ceil, log2
from typing import Any

from ...theory.errors import InputError
from ...theory.radial import RHO_0, Leading, PowerLog, Radial, leading, power_log_terms
from ...theory.symbolic import Expr, Integer, Rational, sympy
from ..balls import Ball, Certified, certified, exact_ball, exact_number, flint, integrated, spelled

_C_2, _ALPHA = sympy.Symbol("c_2", positive=True), sympy.Symbol("alpha", positive=True)
_EXPONENT_DIGITS = 100
_SPARE = 40  # digits with which V is certified for its logarithm, which may be small
_LARGEST_POWER = 4096  # bits of a power that is written out in a leading constant
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
        """The same problem in the theory room; ρ0, α and c2 are symbols there."""
        return Radial(
            _rational(self.degree),
            Integer(self.dimension),
            sympy.oo if self.decay is None else _rational(self.decay),
            _rational(self.effective),
            _rational(self.gamma),
            _ALPHA,
            Integer(1),
            Integer(0) if self.decay is None else _C_2,
            RHO_0,
        )


@dataclass(frozen=True)
class RadialResult:
    """Value with its bound, its natural logarithm, leading term and the time it took.

    The constant of the leading term has numbers for ρ0 and α, unless their powers are too long.
    """

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
    if log_n is None and n.strip().startswith("log:"):
        raise InputError(f"n by its decimal logarithm must be written log:5000: got {n!r}")
    problem = RadialProblem(
        _exponent(degree, "degree"),
        dim,
        None if decay.strip() == "oo" else _exponent(decay, "decay"),
        None if log_n else exact_number(n, "n"),
        Fraction(log_n.group(1)) if log_n else None,
        Fraction(1, max(dim, 1)) if effective is None else _exponent(effective, "effective"),
        exact_number(gamma, "gamma"),
        exact_number(alpha, "alpha"),
        exact_number(rho0, "rho0"),
        not discontinuous,
    )
    return solve(problem, digits)


def _exponent(text: str, name: str) -> Fraction:
    """A number that stands in exponents, and is written out there."""
    number = exact_number(text, name)
    if max(abs(number.numerator), number.denominator) >= 10**_EXPONENT_DIGITS:
        raise InputError(f"{name} must have at most {_EXPONENT_DIGITS} digits: got {text!r}")
    return number


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
    evaluate = prepared(problem, route)
    ball = certified(evaluate, digits)
    log_value = _log_text(evaluate, digits)
    seconds = time.perf_counter() - began
    return RadialResult(spelled(ball, digits), log_value, _leading(problem), route, seconds)


def _log_text(evaluate: Callable[[], Ball], digits: int) -> str:
    """log V with 15 digits at most; V = 1 has none of them, so that V is what gets certified."""
    ball = certified(evaluate, digits + _SPARE)
    with flint.ctx.workprec(ceil((digits + 2 * _SPARE) * log2(10))):
        log_value = ball.log()
    return "0" if log_value.contains(0) else spelled(log_value, min(digits, 15)).value


def prepared(problem: RadialProblem, route: str = "closed") -> Callable[[], Ball]:
    """Eq. 17 as a function that gives the ball at the precision in force, for ``certified``.

    What does not depend on the precision is done once, so that the closed form then takes
    microseconds.

    Parameters
    ----------
    route : {"closed", "quadrature"}
    """
    return _closed(problem) if route == "closed" else _quadrature(problem)


def _leading(problem: RadialProblem) -> Leading | None:
    found = leading(problem.theory(), crossed=problem.rho0 <= problem.alpha)
    if found is None:
        return None
    c2 = RHO_0 ** _rational(problem.decay or Fraction(0)) if problem.continuous else Integer(1)
    constant = found.constant.subs(_C_2, c2)
    for symbol, number in ((RHO_0, problem.rho0), (_ALPHA, problem.alpha)):
        powers = [x.as_base_exp()[1] for x in constant.atoms(symbol, sympy.Pow)]
        bits = max(log2(number.numerator), log2(number.denominator))
        if all((abs(k.p) + k.q) * bits <= _LARGEST_POWER for k in powers):
            constant = constant.subs(symbol, _rational(number))
    return Leading(found.order, constant)


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


@dataclass(frozen=True)
class _Term:
    """coefficient · ρ0^of_rho0 · ν^of_nu · log(ν/ρ0)^log, the numbers as ``flint.fmpq``."""

    coefficient: Any
    of_rho0: Any
    of_nu: Any
    log: int


def _closed(problem: RadialProblem) -> Callable[[], Ball]:
    """The sum of powers of ν, term by term."""
    terms = [_term(problem, t) for t in power_log_terms(problem.theory(), is_crossed(problem))]

    def evaluate() -> Ball:
        log_nu, log_rho0 = _log_nu(problem), exact_ball(problem.rho0).log()
        total = flint.arb(0)
        for t in terms:
            value = (t.of_rho0 * log_rho0 + t.of_nu * log_nu).exp() * t.coefficient
            total += value * (log_nu - log_rho0) if t.log else value
        return total * exact_ball(problem.gamma) / _count(problem)

    return evaluate


def _term(problem: RadialProblem, term: PowerLog) -> _Term:
    """A term of the theory, a rational times powers of ρ0 and c2, with c2 a power of ρ0 too."""
    powers = term.coefficient.as_powers_dict()
    coefficient, of_rho0 = Integer(1), powers.pop(RHO_0, Integer(0))
    if powers.pop(_C_2, 0) and problem.continuous:
        assert problem.decay is not None
        of_rho0 += _rational(problem.decay)
    for base, power in powers.items():
        coefficient *= base**power
    return _Term(_fmpq(coefficient), _fmpq(of_rho0), _fmpq(term.power), term.log)


def _fmpq(number: Expr) -> Any:
    assert number.is_Rational
    return flint.fmpq(int(number.p), int(number.q))


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

        head = integrated(density, 0, 1)
        value = (log_amplitude + power * top).exp() * length * head
        if low is None or high is None:
            edge = end if high is None else start
            rest = (log_amplitude + power * edge).exp() / abs(power)  # the tail's exact size
            value += rest.union(flint.arb(0))
        return value

    return evaluate
