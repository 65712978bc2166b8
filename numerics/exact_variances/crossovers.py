"""Crossovers: from which N on a slower region decides, for smooth product integrands.

Where all power lies far below α N_k, a region's variance is C N^-a with C from the low-frequency
form of the spectrum and the moments Σ_m M_λ(m²) |f^(m)|² on the region. A fast region with a large
C leads until N* = (C_fast/C_slow)^(1/(a_fast − a_slow)): n-rooks on an anisotropic Gaussian fall as
N^-3 up to N* and as N^-1 from there on.
"""

from dataclasses import dataclass
from itertools import combinations
from math import comb, prod

from ...theory.expansions import FULL, Partition
from ...theory.layouts import Layout
from ...theory.orders import Order
from ...theory.rates import profile_of
from ...theory.regions import Region, regions
from ...theory.samplers import Sampler
from ...theory.symbolic import sympy
from ..balls import Ball, certified, flint
from ..integrands.gaussian import GaussianFactor
from ..integrands.protocol import Factor, Integrand, Mpf, mp, to_mpf

_DIGITS = 30
_SCALE = 10**60  # Σ m² |f^|² from Σ |f^|² (1 − sinc²(m/n)), relative error O((1 + 1/σ)²/n²)
_MOST_SUPPORTS = 5000


@dataclass(frozen=True)
class RegionConstant:
    """V ~ constant · N^-exponent on a region, exact to about 1e-30 relative."""

    region: str
    constant: Mpf
    order: Order


@dataclass(frozen=True)
class Crossover:
    """Below N = ``count`` the fast regions' term is the larger one, above it the slow ones'."""

    fast: RegionConstant
    slow: RegionConstant
    count: Mpf


def region_constants(sampler: Sampler, integrand: Integrand) -> tuple[RegionConstant, ...]:
    """Leading constant of a Gaussian's variance on every region; empty for other integrands.

    The Gaussian is the catalogue's one integrand that is smooth and a product.
    """
    factors, layout = _gaussians(integrand), sampler.layout
    if not factors or sampler.kernel is None:
        return ()
    found: list[RegionConstant] = []
    for region in regions(layout):
        picks = zip(layout.groups, region.counts, strict=True)
        if prod(comb(int(g.size), int(c)) for g, c in picks) > _MOST_SUPPORTS:
            return ()
        for monomial in profile_of(sampler, region):
            if monomial.degree is sympy.oo:
                continue
            if any(
                p != FULL and set(p) - {1} for powers, _ in monomial.form for p in powers.partitions
            ):
                return ()  # moments of other orders than m_i² are not here
            with mp.workdps(_DIGITS + 10):
                value = mp.mpf(0)
                for powers, constant in monomial.form:
                    weight = mp.mpmathify(sympy.N(constant, mp.dps))
                    moment = _certified_moment(layout, region, powers.partitions, factors)
                    value += weight * moment
            order = Order(1 + monomial.effective * monomial.degree)
            found.append(RegionConstant(region.label, +value, order))
    return tuple(found)


def _gaussians(integrand: Integrand) -> tuple[Factor, ...]:
    """The factors of a Gaussian, one per coordinate; empty for other integrands."""
    factors = tuple(factor for part in integrand.parts for _, factor in part)
    return factors if all(isinstance(f, GaussianFactor) for f in factors) else ()


def _certified_moment(
    layout: Layout,
    region: Region,
    partitions: tuple[Partition, ...],
    factors: tuple[Factor, ...],
) -> Mpf:
    """Σ over the region's supports of Σ_m M_λ(m²) ∏ |f^_i(m_i)|², the others at m = 0."""
    return to_mpf(certified(lambda: _moment(layout, region, partitions, factors), _DIGITS + 10))


def _moment(
    layout: Layout,
    region: Region,
    partitions: tuple[Partition, ...],
    factors: tuple[Factor, ...],
) -> Ball:
    total = flint.arb(1)
    for group, count, partition in zip(layout.groups, region.counts, partitions, strict=True):
        first = int(group.first) - 1
        members = factors[first : first + int(group.size)]
        total *= _group_moment(members, int(count), partition)
    return total


def _group_moment(members: tuple[Factor, ...], count: int, partition: Partition) -> Ball:
    """One group's part: a choice of supports, and of the axes that carry the powers."""
    powers = (1,) * count if partition == FULL else partition
    total = flint.arb(0)
    for support in combinations(range(len(members)), count):
        for raised in combinations(support, len(powers)):
            value = flint.arb(1)
            for i, f in enumerate(members):
                if i in raised:
                    value *= _second_moment(f)
                else:
                    value *= f.power_sum() if i in support else f.mean() ** 2
            total += value
    return total


def _second_moment(factor: Factor) -> Ball:
    """Σ_{m≠0} m² |f^(m)|², from the deficit of its sinc² sum, (π²/3) Σ m² |f^|² / n²."""
    deficit = factor.power_sum() - factor.power_sum(count=_SCALE)
    return deficit * 3 * flint.arb(_SCALE) ** 2 / flint.arb.pi() ** 2


def crossovers(sampler: Sampler, integrand: Integrand) -> tuple[Crossover, ...]:
    """Where the leading region changes, in the order in which it happens.

    Regions of one order act together. Starting with the order whose term is the largest at N = 1,
    each later leader is the slower one that overtakes first.
    """
    constants = _by_order([c for c in region_constants(sampler, integrand) if c.constant > 0])
    if not constants:
        return ()
    leader = max(constants, key=lambda c: (c.constant, -float(c.order.exponent)))
    found: list[Crossover] = []
    while True:
        meetings = [
            Crossover(leader, c, (leader.constant / c.constant) ** (1 / _gap(leader, c)))
            for c in constants
            if _gap(leader, c) > 0
        ]
        if not meetings:
            return tuple(found)
        found.append(min(meetings, key=lambda x: x.count))
        leader = found[-1].slow


def _by_order(constants: list[RegionConstant]) -> list[RegionConstant]:
    """One constant per order, the sum over the regions that share it."""
    alike: dict[Order, list[RegionConstant]] = {}
    for c in constants:
        alike.setdefault(c.order, []).append(c)
    with mp.workdps(_DIGITS):
        return [
            RegionConstant(
                "; ".join(dict.fromkeys(c.region for c in members)),
                mp.fsum(c.constant for c in members),
                order,
            )
            for order, members in alike.items()
        ]


def _gap(fast: RegionConstant, slow: RegionConstant) -> Mpf:
    return mp.mpmathify(sympy.N(fast.order.exponent - slow.order.exponent, 30))
