"""Claimed rates against measured variances: the first probe of a region that falls too slowly."""

from collections.abc import Sequence

import numpy as np

from ...theory.claims import RateClaim
from ...theory.errors import InputError
from ..checking.designs import rate_probes
from ..checking.verdicts import FALSE_ALARM, LEAST, exponent_margin
from ..integrands.protocol import Integrand
from ..measuring.drift import DriftTest, drift_test
from ..measuring.moments import Interval, log_error, variance_interval
from ..measuring.slopes import RatePoint
from ..measuring.tails import is_resolved, is_seen
from .searches import LEVEL, SUSPICION, Search, drawn, shifted_errors
from .witnesses import Witness

_EXPLORED, _CONFIRMED = 128, 512  # realisations at each of five N
_RATE_LADDER = (16, 64, 256, 1024, 4096)


def slow_variance(search: Search, claim: RateClaim) -> Witness | None:
    """The first probe of the claimed region whose variance falls more slowly than claimed."""
    targets = search.source.counts or _RATE_LADDER
    numbers = sorted({search.source.admissible(t) for t in targets} - {1})
    for f in rate_probes(claim, search.dim):
        if search.is_over:
            return None
        first = _ladder(search, f, numbers, 0, _EXPLORED, SUSPICION)
        if _drift(search, claim, first, SUSPICION).verdict != "contradicted":
            continue
        start = _EXPLORED + search.tally.spent * _CONFIRMED
        search.tally.spent += 1
        second = _ladder(search, f, numbers, start, _CONFIRMED, LEVEL)
        tested = _drift(search, claim, second, LEVEL)
        if tested.verdict == "contradicted":
            return _rate_witness(search, claim, f, second, tested)
    return None


def _ladder(
    search: Search, f: Integrand, numbers: Sequence[int], start: int, count: int, level: float
) -> list[tuple[int, int, Interval]]:
    """N, realisations and the variance's interval, at those N that tell of N → ∞."""
    found: list[tuple[int, int, Interval]] = []
    for n in numbers:
        moments = shifted_errors(search, f, drawn(search, n, start, count))
        if moments.count < LEAST or not (is_resolved(f, n) and is_seen(f, n, moments.count)):
            continue
        interval = variance_interval(moments, level)
        if interval.low > 0 and interval.high < float("inf"):
            found.append((n, moments.count, interval))
    return found


def _drift(
    search: Search, claim: RateClaim, found: Sequence[tuple[int, int, Interval]], level: float
) -> DriftTest:
    points = [RatePoint(n, v.estimate, log_error(v, level)) for n, _, v in found]
    if len(points) < 3:
        raise InputError(f"a rate needs 3 numbers of points that tell of it: got {len(points)}")
    exponent, log_power = float(claim.exponent), float(claim.log_power)
    return drift_test(points, exponent, log_power, level, margin=exponent_margin(search.dim))


def _rate_witness(
    search: Search,
    claim: RateClaim,
    f: Integrand,
    found: Sequence[tuple[int, int, Interval]],
    tested: DriftTest,
) -> Witness:
    (near, _, first), (far, count, last) = found[0], found[-1]
    law = (near / far) ** float(claim.exponent)
    law *= (np.log(far) / np.log(near)) ** float(claim.log_power)
    frequency = tuple(int(i + 1 in f.support) for i in range(f.dim)) if f.support else ()
    detail = (
        f"continued from N = {near}; chi^2 of the claimed exponent is {tested.chi2:.3g}, "
        f"excluded above {tested.threshold:.3g}, drift at finite N being allowed for"
    )
    return Witness(
        search.source.name, search.claim, search.dim, far, frequency, f.name, "variance", last,
        first.estimate * float(law), FALSE_ALARM, count, detail,
    )  # fmt: skip
