"""Rates: how fast the variance falls, region by region and overall.

On a region whose profile is a set of saturating monomials (b_j, N_k = N^e_j) an integrand with
shell energies ρ^-q has Var ~ Σ_j N^-1 N^(−e_j min(b_j, q)), a logarithm exactly where b_j = q:

    exponent = 1 + min_j e_j · min(b_j, q).

Overall the slowest of the regions in which the integrand has power decides.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

from .combs import combs_of
from .decays import Decay
from .dominance import Case, cases, dominates, slowest
from .errors import UndecidedSign
from .expansions import expand
from .orders import Order
from .plateaus import plateau
from .primitives import Primitive, shells
from .profiles import SaturatingMonomial, newton_polygon
from .radial import Leading, Radial, leading
from .regions import Region, region_of_support, regions, select
from .samplers.definition import Sampler
from .signs import Assumptions, nonnegative
from .symbolic import Expr, Integer, sympy

POINT = Primitive("point", 0)

Profile = tuple[SaturatingMonomial, ...]


@dataclass(frozen=True)
class RegionRate:
    """The rate on one region.

    Parameters
    ----------
    region : Region
    profile : tuple of SaturatingMonomial
    q : sympy.Expr or None
        Shell exponent of the integrand; None: no power, the region is left out.
    order : Order or None
        None where the region is left out.
    """

    region: Region
    profile: Profile
    q: Expr | None
    order: Order | None


@lru_cache(maxsize=4096)
def _derived(sampler: Sampler, region: Region, on_line: bool) -> Profile:
    if sampler.kernel is None:
        return sampler.free_profile
    series = expand(sampler.kernel, sampler.layout, region)
    combs = combs_of(sampler.kernel, sampler.layout, region, on_line)
    return newton_polygon(series, combs, region.assumptions)


def profile_of(sampler: Sampler, region: Region, decay: Decay | None = None) -> Profile:
    """The profile of a sampler on a region, derived from its kernel (Eq. 18).

    Parameters
    ----------
    decay : Decay, optional
        The class of integrands that is to meet it: the teeth of combs lie denser on the line of
        frequencies that has the power of a ridge than they do in shells.
    """
    return _derived(sampler, region, decay is not None and decay.is_on_line)


def saturated(sampler: Sampler, rate: RegionRate) -> Profile:
    """The profile of a region with its plateau γ, the supremum of N·P_S as N → ∞."""
    if sampler.kernel is None or all(m.degree is sympy.oo for m in rate.profile):
        return rate.profile
    gamma = plateau(sampler, rate.region)
    return tuple(m if m.degree is sympy.oo else replace(m, plateau=gamma) for m in rate.profile)


def region_rates(
    sampler: Sampler, decay: Decay, primitive: Primitive = POINT
) -> tuple[RegionRate, ...]:
    """Rates on all regions of a sampler for a class of integrands.

    Raises
    ------
    UndecidedSign
        If the monomials of a region cannot be ordered.
    """
    return tuple(region_rate(sampler, decay, r, primitive) for r in regions(sampler.layout))


def region_rate(
    sampler: Sampler, decay: Decay, region: Region, primitive: Primitive = POINT
) -> RegionRate:
    """The rate on one region of a sampler for a class of integrands.

    Raises
    ------
    UndecidedSign
        If the monomials of the region cannot be ordered.
    """
    q = shells(primitive, decay, sampler.layout, region)
    if q is None:
        return RegionRate(region, (), None, None)
    profile = profile_of(sampler, region, decay)
    orders = [m.order_at(q, region.assumptions, decay.is_product) for m in profile]
    return RegionRate(region, profile, q, slowest(orders, region.assumptions))


def order_on(
    sampler: Sampler, decay: Decay, support: tuple[int, ...] | None = None
) -> Order | None:
    """The order of a class under a sampler of a known dimension, on one support or overall.

    Returns
    -------
    Order or None
        None if the class has no power there.
    """
    layout = sampler.layout
    chosen = select(layout, "overall") if support is None else (region_of_support(layout, support),)
    found = (region_rate(sampler, decay, region).order for region in chosen)
    orders = [order for order in found if order is not None]
    return slowest(orders) if orders else None


def overall(rates: tuple[RegionRate, ...], assumptions: Assumptions) -> tuple[Case, ...]:
    """The slowest order among the regions with power, by cases if it depends on a symbol.

    A sum of no terms, an integrand without power anywhere, has the order 0 (exponent oo).

    Raises
    ------
    UndecidedSign
        If the winner depends on two symbols, or on a region that exists for some values of them
        only (1 < w < d needs d >= 3).
    """
    powered = [r for r in rates if r.order is not None]
    lasting = _hardest([r for r in powered if r.region.assumptions == assumptions])
    if not lasting:
        return (Case(Order(sympy.oo)),)
    found = cases([r.order for r in lasting if r.order is not None], assumptions)
    for rate in powered:
        if rate.region.assumptions != assumptions and not _is_covered(rate, lasting):
            raise UndecidedSign(
                f"the region {rate.region.label}, which exists only for some values of its "
                "symbols, must not decide the rate: give the dimension as a number"
            )
    return found


def _is_covered(rate: RegionRate, others: list[RegionRate]) -> bool:
    """Whether another region is at least as slow wherever this one exists."""
    known = rate.region.assumptions
    return any(is_no_harder(o, rate) or _dominates(o, rate, known) for o in others)


def _dominates(first: RegionRate, second: RegionRate, known: Assumptions) -> bool:
    if first.order is None or second.order is None:
        return second.order is None
    return bool(dominates(first.order, second.order, known))


def _hardest(rates: list[RegionRate]) -> list[RegionRate]:
    """Of the regions with one profile, those with the smallest q: the others are no slower."""
    kept: list[RegionRate] = []
    for rate in rates:
        if any(is_no_harder(k, rate) for k in kept):
            continue
        kept = [k for k in kept if not is_no_harder(rate, k)]
        kept.append(rate)
    return kept


def is_no_harder(first: RegionRate, second: RegionRate) -> bool:
    """Whether the profiles are one, and q of the second is proved at least that of the first."""
    if first.profile != second.profile or first.q is None or second.q is None:
        return False
    if second.q is sympy.oo or first.q == second.q:
        return True
    return first.q is not sympy.oo and bool(
        nonnegative(second.q - first.q, second.region.assumptions)
    )


def leading_constant(sampler: Sampler, rate: RegionRate, decay: Decay) -> Leading | None:
    """Leading term of Eq. 17 on a region for the classes worst and best, in c_f and ρ0.

    For the monomial model: exact in the best case, where low frequencies decide; in the worst
    case the profile stands for the true spectrum near ρ = α N_k. None where the profile's
    coefficient, or the winner among several monomials, is not known.
    """
    if decay.family not in ("worst", "best") or rate.q is None or len(rate.profile) != 1:
        return None
    (monomial,) = saturated(sampler, rate)
    if monomial.coefficient is None or rate.order is None or not rate.order.log_power.is_Integer:
        return None
    s = rate.region.dimension
    gamma, alpha = monomial.plateau, monomial.alpha or Integer(1)
    decay_power = sympy.oo if rate.q is sympy.oo else s + rate.q
    problem = Radial(monomial.degree, s, decay_power, monomial.effective, gamma, alpha)
    return leading(problem, rate.region.assumptions)


@dataclass(frozen=True)
class Crossover:
    """N* = (C_fast/C_slow)^(1/(a_fast − a_slow)): from there on the slower region decides."""

    fast: str
    slow: str
    count: Expr


def crossover(fast: tuple[str, Expr, Order], slow: tuple[str, Expr, Order]) -> Crossover | None:
    """Where two regions' terms C N^-a are equal; None if a logarithm or equal powers forbid it.

    Parameters
    ----------
    fast, slow : (label, constant, order)
        The constants are positive numbers or symbols.
    """
    gap = fast[2].exponent - slow[2].exponent
    if gap == 0 or fast[2].log_power != 0 or slow[2].log_power != 0 or gap is sympy.oo:
        return None
    return Crossover(fast[0], slow[0], (fast[1] / slow[1]) ** (1 / gap))
