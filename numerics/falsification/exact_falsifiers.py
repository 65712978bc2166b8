"""Exact falsification: where a catalogue sampler, whose spectrum is known, is not what is claimed.

Against a claimed sampler the two exact spectra are compared, at the lowest frequencies first: the
witness is the first at which they differ by more than 25 %. Against a claimed rate the order that
theory derives is compared with the claimed one: the claim is wrong if the derived order is slower
(a faster one is no witness, here as in a check). The witness continues the exact variance V(N_1)
of a ridge by the claimed law to N_2 and compares it with the exact V(N_2), which is larger.
"""

from collections.abc import Iterator, Sequence
from math import log

import numpy as np

from ...theory.claims import RateClaim, SamplerClaim, parse_claim
from ...theory.decays import Decay
from ...theory.dominance import dominates
from ...theory.errors import InputError
from ...theory.orders import Order
from ...theory.rates import region_rate
from ...theory.regions import Region, select
from ...theory.samplers import Sampler, parse_sampler
from ...theory.spelling import order_text
from ...theory.symbolic import sympy
from ..checking.verdicts import MARGIN
from ..exact_variances.variances import exact_variance
from ..expected_spectra.spectra import power_array
from ..integrands.bernoulli import bernoulli
from ..integrands.grammar import parse_integrand
from ..integrands.protocol import Integrand
from ..integrands.ridge import Ridge
from ..measuring.moments import Interval
from ..measuring.probes import Frequency, frequencies, strata_of_claim
from ..point_sources.catalogue_source import counts_of
from .low_frequencies import canonical, low_frequencies, simplicity
from .witnesses import Witness

_TARGETS = (4, 9, 16, 27, 64, 256)  # N near which two spectra are compared
_NEAR, _FAR = 64, 4096  # N from and to which a claimed law continues a variance
_DEGREES = {"worst": 1, "best": 6}  # of the ridge of a class
_ROUNDING = 1e-20  # powers below are rounding errors of zero


def falsify_exactly(source: str, claim: str, dims: Sequence[int]) -> Witness | None:
    """The simplest witness against a claim on a catalogue sampler, without noise.

    Parameters
    ----------
    source : str
        A catalogue sampler.
    claim : str
        In the grammar of claims.
    dims : sequence of int
        Searched in increasing order.

    Returns
    -------
    Witness or None
        None if the spectra agree within 25 % wherever they were compared, or the derived order
        is no slower than claimed, in all dimensions that have both.

    Raises
    ------
    InputError
        If no dimension has both the sampler and the claim.
    """
    refusal: InputError | None = None
    searched = False
    for dim in sorted(set(dims)):
        try:
            sampler, parsed = parse_sampler(source, dim), parse_claim(claim, dim)
            if isinstance(parsed, SamplerClaim):
                found = _difference(sampler, parsed, dim)
            else:
                found = _slower(sampler, parsed, dim)
        except InputError as error:
            refusal = error
            continue
        searched = True
        if found is not None:
            return found
    if not searched:
        raise refusal or InputError("a search needs a dimension: got none")
    return None


def _difference(sampler: Sampler, claim: SamplerClaim, dim: int) -> Witness | None:
    """The lowest frequency, and the smallest N there, at which two spectra differ by 25 %."""
    claimed = claim.sampler
    found: list[tuple[Frequency, int, float, float]] = []
    numbers = common_counts(sampler, claimed)
    if not numbers:
        names = f"{sampler.name} and {claimed.name}"
        raise InputError(f"two samplers must have an N in common: got none for {names}")
    for n in numbers:
        strata = (*strata_of_claim(sampler, n), *strata_of_claim(claimed, n))
        low = low_frequencies(dim, 4 if dim <= 6 else 2)
        wanted = sorted({*low, *map(canonical, frequencies(n, dim, strata))}, key=simplicity)
        points = np.array(wanted, dtype=np.int64)
        own, other = (power_array(s, counts_of(s, n), points) for s in (sampler, claimed))
        apart = np.maximum(own, other) > (1 + MARGIN) * np.minimum(own, other) + _ROUNDING
        for i in map(int, np.flatnonzero(apart)[:1]):
            found.append((wanted[i], n, n * float(own[i]), n * float(other[i])))
    if not found:
        return None
    k, n, own, other = min(found, key=lambda f: (simplicity(f[0]), f[1]))
    ridge = Ridge(k, 2).name
    return Witness(
        sampler.name, claim.text, dim, n, k, ridge, "N P_S(k)",
        Interval(own, own, own), other, 0.0, 0,
    )  # fmt: skip


def common_counts(first: Sampler, second: Sampler) -> list[int]:
    """A few N, small ones first, of which both samplers have realisations."""
    near = {counts_of(s, t)["N"] for s in (first, second) for t in _TARGETS}
    both = [n for n in near if all(counts_of(s, n)["N"] == n for s in (first, second))]
    return sorted(n for n in both if n >= 2)[:8]


def _slower(sampler: Sampler, claim: RateClaim, dim: int) -> Witness | None:
    """A witness if the derived order is slower than the claimed one."""
    if sampler.kernel is None:
        raise InputError(f"an exact witness needs a sampler with a spectrum: got {sampler.name}")
    derived = _derived(sampler, claim)
    claimed = Order(claim.exponent, claim.log_power)
    if derived is None or dominates(claimed, derived[1]):
        return None
    region, order = derived
    detail = f"derived {order_text(order)} on {region.label}, claimed {order_text(claimed)}"
    numbers = counts_of(sampler, _NEAR)["N"], counts_of(sampler, _FAR)["N"]
    finite = claim.exponent is not sympy.oo and numbers[0] < numbers[1]
    for f in _shows(claim.decay, sampler, region) if finite else ():
        shown = _continued(sampler, f, claim, numbers)
        if shown is not None and shown[0] > (1 + MARGIN) * shown[1]:
            value, predicted = shown
            exact = Interval(value, value, value)
            return Witness(
                sampler.name, claim.text, dim, numbers[1], _frequency(f), f.name, "variance",
                exact, predicted, 0.0, 0, f"continued from N = {numbers[0]}; {detail}",
            )  # fmt: skip
    own = float(order.exponent)
    return Witness(
        sampler.name, claim.text, dim, numbers[1], (), claim.decay.name, "exponent",
        Interval(own, own, own), float(claim.exponent), 0.0, 0, detail,
    )  # fmt: skip


def _derived(sampler: Sampler, claim: RateClaim) -> tuple[Region, Order] | None:
    """The slowest region among those claimed, with its order; None if there is no power."""
    slow: tuple[Region, Order] | None = None
    for region in select(sampler.layout, claim.region):
        order = region_rate(sampler, claim.decay, region).order
        if order is not None and (slow is None or not dominates(slow[1], order)):
            slow = region, order
    return slow


def _shows(decay: Decay, sampler: Sampler, region: Region) -> Iterator[Integrand]:
    """A ridge of the class on the region, the Bernoulli integrand, or the one that is named."""
    dim, k = int(sampler.dim), [0] * int(sampler.dim)
    if decay.family not in ("worst", "best", "p"):
        yield parse_integrand(decay.name, dim)
        return
    for group, count in zip(sampler.layout.groups, region.counts, strict=True):
        for i in range(int(count)):
            k[int(group.first) - 1 + i] = 1
    half = 1 if decay.number is None else int((decay.number - sum(k) + 1) / 2)
    degree = _DEGREES.get(decay.family, min(max(half, 1), 12))
    yield Ridge(tuple(k), degree)
    yield bernoulli(dim, degree, tuple(i + 1 for i, on in enumerate(k) if on))


def _continued(
    sampler: Sampler, f: Integrand, claim: RateClaim, numbers: tuple[int, int]
) -> tuple[float, float] | None:
    """V(N_2), and what the claimed law makes of V(N_1); None without exact variances."""
    near, far = numbers
    try:
        first, second = (
            float(exact_variance(sampler, counts_of(sampler, n), f).value) for n in numbers
        )
    except InputError:
        return None
    ratio = (near / far) ** float(claim.exponent)
    return second, first * ratio * (log(far) / log(near)) ** float(claim.log_power)


def _frequency(f: Integrand) -> Frequency:
    if isinstance(f, Ridge):
        return f.k
    return tuple(int(i + 1 in f.support) for i in range(f.dim)) if f.support else ()
