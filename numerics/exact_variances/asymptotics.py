r"""Exponents, logarithms and constants measured on exact variances, by extrapolation to N = ∞.

Exact variances cost little at any N, so that an order can be read off far from where it is
approached. On a ladder on which the counts are doubled, or tripled, at each rung, N_j = N_0 h^j,

    N^r V = a + b ln N + corrections that fall as powers of N, perhaps with logarithms,

and what converges geometrically in j is extrapolated by Wynn's epsilon algorithm (Wynn 1956), which
removes terms λ^j for unknown λ (Richardson's extrapolation where the powers need not be known):

    b = 0   local slopes ln(V_j/V_(j+1))/ln h → r. With b ≠ 0 they creep up as 1/ln N and are
            never used;
    b ≠ 0   (a + bj) μ^j has a double root: μ = (V_(j+1) − sqrt(V_(j+1)² − V_j V_(j+2)))/V_j is
            free of a and b, and −ln μ/ln h → r.

Of the two r the surer one is taken. Exponents of the theory are rational: the simplest fraction
within the error is taken for r itself, if it is too simple for an accident. The logarithm is then a
matter of d(N^r V)/d ln N: a limit that is 0 within its error means none and the constant a, any
other one logarithm and the constant b. All is done on two ladders, one of doubled and one of
tripled counts. Where they contradict each other, or the slopes keep swinging, the variance
oscillates with N (combs against jumps).

All errors are estimates (``extrapolation.py``).
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from math import ceil, gcd
from typing import Literal

from ...theory.errors import InputError
from ...theory.orders import Order
from ...theory.samplers import Sampler
from ..integrands.protocol import Integrand, Mpf, mp
from .extrapolation import Estimate, extrapolated
from .variances import exact_variance

START = 10**30
"""N of the first rung, about: counts of a sampler in 12 dimensions are then still over 300."""

RUNGS = 17
DIGITS = 60
"""Digits of the variances on a ladder."""

_BASES = (2, 3)  # of the ladders: what repeats along powers of the one does not along the other's
_LARGEST_POWER = 64  # of the base by which N grows from one rung to the next
_NICE = 30  # the first counts share no factor with it where they can: sides are decimals
_TRIED = 60  # first rungs, each start/101 above the one before
_LEAST_DIGITS = 20  # of a variance
_SURE = 1e-6  # error above which an exponent counts as not found
_SIGNIFICANT = 1000  # errors of d(N^r V)/d ln N that a logarithm must be away from 0
_NEGLIGIBLE = 1e-12  # d(N^r V)/d ln N below this part of N^r V is none
_ACCIDENT = Fraction(1, 1000)  # chance that a fraction so simple lies within the error

Verdict = Literal["settled", "oscillates", "undecided"]


@dataclass(frozen=True)
class Rung:
    """N, the variance there and a bound on its error."""

    n: int
    variance: Mpf
    error_bound: Mpf


@dataclass(frozen=True)
class MeasuredOrder:
    """V ~ constant · N^-exponent (ln N)^log_power, measured.

    Parameters
    ----------
    verdict : str
        ``settled``; ``oscillates`` or ``undecided`` where the numbers must not be used.
    exponent : Estimate
        As extrapolated.
    rational : Fraction or None
        The simplest fraction within the error of the exponent; None if one so simple is likely to
        lie there by chance.
    constant : Estimate
        For the rational exponent.
    log_power : int
        0 or 1.
    slopes : tuple of mpf
        −d ln V/d ln N between neighbouring rungs of the first ladder, the evidence.
    """

    verdict: Verdict
    exponent: Estimate
    rational: Fraction | None
    constant: Estimate
    log_power: int
    slopes: tuple[Mpf, ...]


def measured_order(
    sampler: Sampler,
    integrand: Integrand,
    start: int = START,
    rungs: int = RUNGS,
    digits: int = DIGITS,
) -> MeasuredOrder:
    """The order of the variance of a sampler on an integrand, from exact variances alone.

    Parameters
    ----------
    sampler : Sampler
        With a kernel whose counts can be doubled and tripled.
    integrand : Integrand
    start : int
        N of the first rung; from there on to half as much above, one without the factors 2, 3
        and 5 is looked for.
    rungs : int
        7 or more.
    digits : int
        Digits of the variances.

    Raises
    ------
    InputError
        If a variance vanishes, is not known to 20 digits, or the counts cannot be doubled.
    """
    with mp.workdps(digits + 10):
        return _agreed(
            *(order_on_ladder(ladder(sampler, integrand, start, rungs, digits, b)) for b in _BASES)
        )


def measured_constant(
    sampler: Sampler,
    integrand: Integrand,
    order: Order,
    start: int = START,
    rungs: int = RUNGS,
    digits: int = DIGITS,
) -> Estimate:
    """C of V ~ C N^-a (ln N)^q for a known order with q = 0 or 1; parameters as above.

    Raises
    ------
    InputError
        As above, or if the order holds symbols or another power of the logarithm.
    """
    if not order.exponent.is_Rational or order.log_power not in (0, 1):
        raise InputError(f"an order must be a number with one logarithm at most: got {order}")
    with mp.workdps(digits + 10):
        exponent = Fraction(int(order.exponent.p), int(order.exponent.q))
        limit = _growth if order.log_power else _amplitude
        return _joined(
            *(limit(ladder(sampler, integrand, start, rungs, digits, b), exponent) for b in _BASES)
        )


def ladder(
    sampler: Sampler, integrand: Integrand, start: int, rungs: int, digits: int, base: int = 2
) -> tuple[Rung, ...]:
    """Exact variances at N_0 h^j, h the least power of the base that multiplies whole counts.

    Raises
    ------
    InputError
        If a variance vanishes, is not known to 20 digits, or no such h is found.
    """
    found: list[Rung] = []
    for counts in _multiplied_counts(sampler, start, rungs, base):
        exact = exact_variance(sampler, counts, integrand, digits)
        if not exact.value > exact.error_bound * 10**_LEAST_DIGITS:
            raise InputError(
                f"the variance must be positive and known to {_LEAST_DIGITS} digits: got "
                f"{mp.nstr(exact.value, 5)} +/- {mp.nstr(exact.error_bound, 2)} at N = "
                f"{counts['N']}"
            )
        found.append(Rung(counts["N"], exact.value, exact.error_bound))
    return tuple(found)


def _multiplied_counts(
    sampler: Sampler, start: int, rungs: int, base: int
) -> list[Mapping[str, int]]:
    if sampler.counts_at is None:
        raise InputError(f"a ladder needs a sampler with points: got {sampler.name}")
    first = _first_counts(sampler.counts_at, start)
    for power in range(1, _LARGEST_POWER + 1):
        ratio = base**power
        found = [sampler.counts_at(first["N"] * ratio**j) for j in range(rungs)]
        if all(_are_multiplied(a, b, ratio) for a, b in pairwise(found)):
            return found
    raise InputError(f"the counts of a sampler must grow together: got {sampler.name}")


def _first_counts(counts_at: Callable[[int], Mapping[str, int]], start: int) -> Mapping[str, int]:
    """The first N from the start on, in steps of 1/101, that has no factor 2, 3 or 5."""
    tried = [counts_at(start + start * k // 101) for k in range(_TRIED)]
    return next((c for c in tried if gcd(c["N"], _NICE) == 1), tried[0])


def _are_multiplied(counts: Mapping[str, int], following: Mapping[str, int], ratio: int) -> bool:
    """Whether N grew by the ratio and every other count by a power of the base."""
    if following["N"] != counts["N"] * ratio:
        return False
    # A divisor of a power of a prime is itself a power of it.
    return all(
        following[k] % n == 0 and ratio % (following[k] // n) == 0 for k, n in counts.items()
    )


def order_on_ladder(rungs: Sequence[Rung]) -> MeasuredOrder:
    """The order that one ladder of constant h shows (see ``measured_order``)."""
    slopes = tuple(_local_slopes(rungs, [r.variance for r in rungs]))
    candidates = [_limit(rungs, _local_slopes), _limit(rungs, _double_root_slopes)]
    exponent = min(candidates, key=lambda c: c.error)
    rational = _simplest(exponent) if exponent.error <= _SURE else None
    if rational is None:
        unknown = Estimate(mp.mpf(0), mp.inf)
        return MeasuredOrder(_unsettled(slopes), exponent, None, unknown, 0, slopes)
    amplitude, growth = _amplitude(rungs, rational), _growth(rungs, rational)
    size = _scaled(rungs, [r.variance for r in rungs], rational)[-1]
    none = abs(growth.value) <= max(growth.error, _NEGLIGIBLE * size)
    clear = (
        growth.error <= _SURE * size if none else abs(growth.value) > _SIGNIFICANT * growth.error
    )
    verdict: Verdict = "settled" if clear else _unsettled(slopes)
    constant = amplitude if none else growth
    return MeasuredOrder(verdict, exponent, rational, constant, 0 if none else 1, slopes)


def _simplest(found: Estimate) -> Fraction | None:
    """The fraction of the smallest denominator within the error, unless it may be an accident."""
    low, high = (_exact(found.value + sign * found.error) for sign in (-1, 1))
    fraction = simplest_between(low, high)
    # Of the fractions of denominators up to q, about q² w lie in an interval of length w.
    return fraction if fraction.denominator**2 * (high - low) < _ACCIDENT else None


def simplest_between(low: Fraction, high: Fraction) -> Fraction:
    """The fraction of the smallest denominator in low..high, by continued fractions."""
    whole = ceil(low)
    if whole <= high:
        return Fraction(whole)
    return whole - 1 + 1 / simplest_between(1 / (high - whole + 1), 1 / (low - whole + 1))


def _exact(value: Mpf) -> Fraction:
    return Fraction(int(value.man)) * Fraction(2) ** int(value.exp)


_Transform = Callable[[Sequence[Rung], Sequence[Mpf]], list[Mpf]]


def _limit(rungs: Sequence[Rung], transform: _Transform) -> Estimate:
    """The limit of a sequence made of the variances; their errors are carried along."""
    moved = [r.variance + (r.error_bound if j % 4 < 2 else -r.error_bound)
             for j, r in enumerate(rungs)]  # fmt: skip
    return extrapolated(transform(rungs, [r.variance for r in rungs]), transform(rungs, moved))


def _log_ratio(rungs: Sequence[Rung]) -> Mpf:
    return mp.log(mp.mpf(rungs[1].n) / rungs[0].n)


def _local_slopes(rungs: Sequence[Rung], variances: Sequence[Mpf]) -> list[Mpf]:
    """−d ln V/d ln N between neighbouring rungs."""
    return [mp.log(a / b) / _log_ratio(rungs) for a, b in pairwise(variances)]


def _double_root_slopes(rungs: Sequence[Rung], variances: Sequence[Mpf]) -> list[Mpf]:
    """−ln μ/ln h where a + bj in front of μ^j is removed; the local slopes where b = 0."""
    found: list[Mpf] = []
    for a, b, c in zip(variances, variances[1:], variances[2:], strict=False):
        root = mp.sqrt(max(b * b - a * c, mp.mpf(0)))
        found.append(mp.log((b + root) / c) / _log_ratio(rungs))  # a/(b − root), not cancelling
    return found


def _scaled(rungs: Sequence[Rung], variances: Sequence[Mpf], exponent: Fraction) -> list[Mpf]:
    """N^r V."""
    r = mp.mpf(exponent.numerator) / exponent.denominator
    return [mp.mpf(x.n) ** r * v for x, v in zip(rungs, variances, strict=True)]


def _amplitude(rungs: Sequence[Rung], exponent: Fraction) -> Estimate:
    """The limit of N^r V."""
    return _limit(rungs, lambda at, v: _scaled(at, v, exponent))


def _growth(rungs: Sequence[Rung], exponent: Fraction) -> Estimate:
    """The limit of d(N^r V)/d ln N."""

    def quotients(at: Sequence[Rung], variances: Sequence[Mpf]) -> list[Mpf]:
        return [(b - a) / _log_ratio(at) for a, b in pairwise(_scaled(at, variances, exponent))]

    return _limit(rungs, quotients)


def _unsettled(slopes: Sequence[Mpf]) -> Verdict:
    """Whether the slopes swing to and fro without calming down."""
    half = len(slopes) // 2
    early, late = ([b - a for a, b in pairwise(s)] for s in (slopes[: half + 1], slopes[half:]))
    turns = sum(a * b < 0 for a, b in pairwise(late))
    largest = [max(abs(step) for step in steps) for steps in (early, late)]
    swings = turns >= 2 and bool(largest[1] >= largest[0] / 2)
    return "oscillates" if swings else "undecided"


def _agreed(first: MeasuredOrder, second: MeasuredOrder) -> MeasuredOrder:
    """What two ladders say together; if both settled on different things N decides, not a law."""
    exponent = _joined(first.exponent, second.exponent)
    if not first.verdict == second.verdict == "settled":
        verdict = first.verdict if first.verdict != "settled" else second.verdict
        return replace(first, verdict=verdict, exponent=exponent)
    alike = (first.rational, first.log_power) == (second.rational, second.log_power)
    alike = alike and _overlap(first.constant, second.constant)
    constant = _joined(first.constant, second.constant)
    verdict = "settled" if alike else "oscillates"
    return replace(first, verdict=verdict, exponent=exponent, constant=constant)


def _overlap(first: Estimate, second: Estimate) -> bool:
    return bool(abs(first.value - second.value) <= first.error + second.error)


def _joined(first: Estimate, second: Estimate) -> Estimate:
    """The surer of two estimates, with an error that covers the other."""
    best = min(first, second, key=lambda e: e.error)
    return Estimate(best.value, max(best.error, abs(first.value - second.value)))
