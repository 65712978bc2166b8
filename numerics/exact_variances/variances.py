"""Exact variance of the randomly shifted estimator, Var = Σ_{m≠0} P_S(m) |f^(m)|².

Of several routes the first that applies is taken:

- ``parseval``: independent points, Var = Σ_{m≠0} |f^(m)|² / N;
- ``product``: sums of products of functions of one coordinate, in closed form;
- ``ridge``: functions of k·x, summed over the multiples of k in closed form;
- ``covariogram``: balls and their chords in real space, in up to three dimensions;
- ``lattice``: any other integrand, summed over a box of frequencies, the rest bounded.

All but the last give as many digits as asked for, at any N.
"""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import ceil, floor, log2, log10

from ...theory.errors import InputError
from ...theory.samplers import Sampler, parse_sampler
from ..balls import Ball, Certified, certified, exact_number, flint, spelled
from ..integrands.ball import Ball as BallIntegrand
from ..integrands.chord import Chord
from ..integrands.grammar import parse_integrand
from ..integrands.protocol import Integrand, Mpf, to_mpf
from ..integrands.ridge import Ridge
from .axis_measures import OutOfReach
from .covariogram_variances import ball_variance
from .lattice_variances import BOX, LARGEST_DIM, lattice_variance
from .product_variances import product_variance
from .ridge_variances import ridge_variance

_LARGEST_DIM = 100_000
_LARGEST = 10**4000  # Python writes no integers of more than 4300 digits


@dataclass(frozen=True)
class ExactVariance:
    """A variance with an error that it cannot exceed.

    Parameters
    ----------
    value : mpf
    error_bound : mpf
        The value's distance from the variance is at most this.
    method : str
        The route taken.
    """

    value: Mpf
    error_bound: Mpf
    method: str


@dataclass(frozen=True)
class VarianceResult:
    """An exact variance as asked for by names.

    Parameters
    ----------
    sampler, integrand : str
        Canonical names.
    dim, n : int
        n is the N of the value, the admissible one nearest to the N asked for.
    n_asked : str
    value : Certified
        With the digits asked for, or as many as are certain.
    method : str
    seconds : float
    left_out : tuple of (str, str)
        What does not enter the value, and why.
    """

    sampler: str
    integrand: str
    dim: int
    n: int
    n_asked: str
    value: Certified
    method: str
    seconds: float
    left_out: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class _Asked:
    """What a route is given: counts of the sampler's kernel, digits, frequencies of a lattice."""

    sampler: Sampler
    counts: Mapping[str, int]
    integrand: Integrand
    digits: int
    box: int


def variance(
    sampler: str,
    integrand: str,
    dim: int,
    n: str | int,
    digits: int = 15,
    method: str | None = None,
) -> VarianceResult:
    """Exact variance of a catalogue sampler on a catalogue integrand, certified.

    Parameters
    ----------
    sampler, integrand : str
        In their grammars: ``jitter``, ``disk:radius=0.3``.
    dim : int
        1 to 100 000.
    n : str or int
        Number of points, ``1000000`` or ``"1e30"``.
    digits : int
        1 to 4000.
    method : str, optional
        The route to take instead of the first that applies.

    Raises
    ------
    InputError
        If a name, a number or the method is unusable, or no route applies.
    """
    if not 1 <= digits <= 4_000:  # Python reads no integers of more than 4300 digits
        raise InputError(f"--digits must be in 1..4000: got {digits}")
    if not 1 <= dim <= _LARGEST_DIM:
        raise InputError(f"--dim must be in 1..{_LARGEST_DIM}: got {dim}")
    asked = _whole(str(n))
    found, f = parse_sampler(sampler, dim), parse_integrand(integrand, dim)
    if found.kernel is None or found.counts_at is None:
        raise InputError(f"an exact variance needs a sampler with points: got {found.name}")
    began = time.perf_counter()
    counts = found.counts_at(asked)
    ball, used = _certified_variance(_Asked(found, counts, f, digits, BOX), method)
    seconds = time.perf_counter() - began
    shown = min(digits, max(2, floor(ball.rel_accuracy_bits() * log10(2)) + 1))
    value = spelled(ball, digits if ball.is_exact() else shown)
    left = _left_out(found, f, asked, counts["N"])
    return VarianceResult(found.name, f.name, dim, counts["N"], str(n), value, used, seconds, left)


def _whole(n: str) -> int:
    if n.strip().startswith("log:"):
        raise InputError(f"n must be the number of points itself, such as 1e300: got {n!r}")
    number = exact_number(n, "n")
    if number.denominator != 1 or not 1 <= number <= _LARGEST:
        raise InputError(f"n must be a whole number from 1 to 1e4000: got {n!r}")
    return number.numerator


def _left_out(
    sampler: Sampler, integrand: Integrand, asked: int, used: int
) -> tuple[tuple[str, str], ...]:
    found: list[tuple[str, str]] = []
    if used != asked:
        found.append((f"N = {asked}", f"{sampler.name} has no such N: the nearest it has is taken"))
    axes = {axis for part in integrand.parts for axis, _ in part} or {*(integrand.support or ())}
    ignored = [i for i in range(1, integrand.dim + 1) if i not in axes] if axes else []
    if ignored:
        why = "the integrand does not depend on them: there every factor of the kernel is 1"
        found.append((f"coordinates {_ranges(ignored)}", why))
    return tuple(found)


def _ranges(numbers: list[int]) -> str:
    """Increasing numbers as text, ``1,4..9``."""
    runs: list[list[int]] = []
    for i in numbers:
        if runs and runs[-1][1] == i - 1:
            runs[-1][1] = i
        else:
            runs.append([i, i])
    return ",".join(str(a) if a == b else f"{a}..{b}" for a, b in runs)


def exact_variance(
    sampler: Sampler,
    counts: Mapping[str, int],
    integrand: Integrand,
    digits: int = 15,
    method: str | None = None,
    box: int = BOX,
) -> ExactVariance:
    """Exact variance at the N of the given counts.

    Parameters
    ----------
    sampler : Sampler
    counts : mapping of str to int
        Every count of the sampler's kernel, N among them.
    integrand : Integrand
    digits : int
        Decimal digits; lattice sums give what they can.
    method : str, optional
        The route to take instead of the first that applies.
    box : int
        Frequencies in a lattice sum.

    Raises
    ------
    InputError
        If the sampler has no kernel, there is no such method, or no route applies.
    """
    ball, used = _certified_variance(_Asked(sampler, counts, integrand, digits, box), method)
    before, flint.ctx.prec = flint.ctx.prec, ceil((digits + 3) * log2(10))
    try:
        rounded = +ball  # the rounding goes into the radius
    finally:
        flint.ctx.prec = before
    return ExactVariance(to_mpf(rounded), to_mpf(rounded.rad()), used)


def _certified_variance(asked: _Asked, method: str | None) -> tuple[Ball, str]:
    """The variance as a ball, and the route taken."""
    if asked.sampler.kernel is None:
        rule = "an exact variance needs a sampler with a spectrum"
        raise InputError(f"{rule}: got {asked.sampler.name}")
    if asked.sampler.dim != asked.integrand.dim:
        dims = f"{asked.sampler.dim} and {asked.integrand.dim}"
        raise InputError(f"a sampler and its integrand must have one dimension: got {dims}")
    if method is not None and method not in _ROUTES:
        raise InputError(f"a method must be one of {', '.join(_ROUTES)}: got {method!r}")
    unreached: OutOfReach | None = None
    for name, route in _ROUTES.items():
        if method not in (None, name):
            continue
        try:
            ball = route(asked)
        except OutOfReach as error:
            unreached = error
            continue
        if ball is not None:
            return ball, name
    if unreached is not None:
        raise unreached
    names = f"{asked.integrand.name} under {asked.sampler.name}"
    raise InputError(f"the method {method} must apply to the integrand and sampler: got {names}")


def _parseval(asked: _Asked) -> Ball | None:
    """Independent points: N·P_S = 1."""
    if asked.sampler.family != "random":
        return None
    more = asked.digits + 2
    return certified(lambda: asked.integrand.total(more) / asked.counts["N"], asked.digits)


def _product(asked: _Asked) -> Ball | None:
    parts = asked.integrand.parts
    return product_variance(asked.sampler, asked.counts, parts, asked.digits) if parts else None


def _ridge(asked: _Asked) -> Ball | None:
    f = asked.integrand
    if not isinstance(f, Ridge):
        return None
    return ridge_variance(asked.sampler, asked.counts, f, asked.digits)


def _covariogram(asked: _Asked) -> Ball | None:
    f = asked.integrand
    if not isinstance(f, BallIntegrand | Chord):
        return None
    return ball_variance(asked.sampler, asked.counts, f, asked.digits)


def _lattice(asked: _Asked) -> Ball:
    f = asked.integrand
    largest = LARGEST_DIM - isinstance(f, Chord)  # of the ball whose chord it is
    if f.dim > largest:
        raise OutOfReach(
            "an exact variance of an integrand that is neither a sum of products nor, under sinc² "
            f"and combs alone, a ridge must have --dim of at most {largest}: "
            f"got {f.name} with --dim {f.dim}"
        )
    return lattice_variance(asked.sampler, asked.counts, f, asked.box)


_ROUTES: dict[str, Callable[[_Asked], Ball | None]] = {
    "parseval": _parseval,
    "product": _product,
    "ridge": _ridge,
    "covariogram": _covariogram,
    "lattice": _lattice,
}
