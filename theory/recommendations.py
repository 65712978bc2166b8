"""Recommendations: which layouts of the catalogue reach the rates that are wanted.

A wanted rate is a claim REGION/CLASS ~ a [log Q]. A layout reaches it if on the supports of that
region, all of them, its order N^-a' (log N)^Q' is no larger: a' > a, or a' = a and Q' <= Q. On each
region the order is that of its profile against the class, exponent 1 − g + e·min(b, q).

Candidates are the families of the catalogue, and uncorrelated jitter for the partitions of the
axes into blocks. Axes that no wanted rate tells apart are interchangeable, so that partitions
count up to their exchange; a partition whose blocks are not in a row is the grammar's layout with
its coordinates handed out in another order.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache

from .admissible import admissible_counts, law_text
from .claims import RateClaim, parse_claim
from .decays import Decay
from .dominance import dominates
from .errors import InputError
from .expressions import is_whole
from .layouts import Layout
from .orders import Order
from .partitions import ALL_PARTITIONS, partitions
from .primitives import shells
from .profiles import SaturatingMonomial
from .rates import POINT, profile_of
from .regions import Region, region_of_support, select
from .samplers import FAMILIES, FURTHER_FAMILIES, Family, Sampler, parse_sampler
from .spelling import expression_text, order_text
from .symbolic import Expr, sympy


@dataclass(frozen=True)
class Reached:
    """What a layout has where a rate is wanted.

    Parameters
    ----------
    wanted : RateClaim
    region : str
        The layout's own label of the region that decides.
    order : Order
        The slowest on the supports of the wanted region.
    condition : str
        What makes it so: ``b < q: the sampler decides``.
    why : str
        The profile, the class and the exponent that follows.
    shortfall : Order or None
        Factor by which the variance exceeds the wanted one as N → ∞; None if the rate is reached.
    aliased : bool
        Whether all power there lies on the multiples of a number of strata, as that of a grid.
    """

    wanted: RateClaim
    region: str
    order: Order
    condition: str
    why: str
    shortfall: Order | None
    aliased: bool = False


@dataclass(frozen=True)
class Alternative:
    """A layout, judged.

    Parameters
    ----------
    layout : str
        In the grammar of samplers.
    axes : tuple of int
        Axis ``axes[i]``, from 1, takes the layout's coordinate i + 1.
    admissible : str
        Which N it has, such as ``N = t^2``.
    admitted : int
        How many N up to 1024 it has.
    reached : tuple of Reached
        One for each wanted rate.
    """

    layout: str
    axes: tuple[int, ...]
    admissible: str
    admitted: int
    reached: tuple[Reached, ...]

    @property
    def reaches_all(self) -> bool:
        """Whether every wanted rate is reached."""
        return all(r.shortfall is None for r in self.reached)

    @property
    def is_comb(self) -> bool:
        """Whether all its power lies on aliases where a rate is wanted, as that of a grid."""
        return any(r.aliased for r in self.reached)

    @property
    def warning(self) -> str | None:
        """What a rate does not tell of a comb, in a sentence."""
        if not self.is_comb:
            return None
        return (
            "aliasing: a regular grid's errors oscillate, and they do not vanish for integrands "
            "with power at multiples of n, the number of its points along an axis"
        )

    @property
    def failing(self) -> tuple[Reached, ...]:
        """Where it falls short."""
        return tuple(r for r in self.reached if r.shortfall is not None)


@dataclass(frozen=True)
class LeftOut:
    """What was not judged, and why."""

    what: str
    why: str


@dataclass(frozen=True)
class Recommendations:
    """The layouts in the order of preference, and what was left out.

    Parameters
    ----------
    dim : int
    wanted : tuple of RateClaim
    alternatives : tuple of Alternative
        Those that reach all rates first; then those that fall short, of the fewest rates first.
        Among these, random layouts before combs, and then the freest in N before others.
    left_out : tuple of LeftOut
    """

    dim: int
    wanted: tuple[RateClaim, ...]
    alternatives: tuple[Alternative, ...]
    left_out: tuple[LeftOut, ...]

    @property
    def layout(self) -> Alternative | None:
        """The recommended layout, if any reaches everything."""
        first = self.alternatives[0] if self.alternatives else None
        return first if first is not None and first.reaches_all else None


_Candidate = tuple[Sampler, tuple[int, ...]]


def recommend(wanted: Sequence[str], dim: int) -> Recommendations:
    """The layouts of the catalogue that reach wanted rates, and how far the others fall short.

    Parameters
    ----------
    wanted : sequence of str
        Rates ``REGION/CLASS ~ EXPONENT [log Q]``; the region is ``overall``, ``axis``, ``w=K``,
        ``generic`` or coordinates, which mean the same frequencies in every layout.
    dim : int

    Returns
    -------
    Recommendations

    Raises
    ------
    InputError
        If a rate is outside the grammar or none is wanted.
    """
    if not wanted:
        raise InputError("a recommendation needs a wanted rate: got none")
    if dim < 1:
        raise InputError(f"a recommendation needs a dimension of at least 1: got {dim}")
    claims = tuple(_rate(text, dim) for text in wanted)
    found: list[Alternative] = []
    left_out: list[LeftOut] = []
    named = _named_sets(claims, dim)
    for sampler, axes in _candidates(named, dim, left_out):
        try:
            found.append(_judged(sampler, axes, claims))
        except InputError as error:
            left_out.append(LeftOut(sampler.name, str(error)))
    order = sorted(range(len(found)), key=lambda i: (*_place(found[i]), i))
    return Recommendations(dim, claims, tuple(found[i] for i in order), tuple(left_out))


def _rate(text: str, dim: int) -> RateClaim:
    claim = parse_claim(text, dim)
    if not isinstance(claim, RateClaim):
        raise InputError(f"a wanted rate is REGION/CLASS ~ EXPONENT [log Q]: got {text!r}")
    return claim


def _place(found: Alternative) -> tuple[int, bool, int]:
    """Fewer rates missed first, then combs last, then more admissible N."""
    return len(found.failing), found.is_comb, -found.admitted


def _candidates(
    named: Sequence[frozenset[int]], dim: int, left_out: list[LeftOut]
) -> Iterator[_Candidate]:
    """Every family in a dimension, then uncorrelated jitter by partitions; tells what is left."""
    identity = tuple(range(1, dim + 1))
    for family in (*FAMILIES, *FURTHER_FAMILIES):
        if family.name == "uncorrelated-jitter":
            continue
        try:
            sampler = _of_family(family, dim)
        except InputError as error:
            left_out.append(LeftOut(family.name, str(error)))
            continue
        if sampler.counts_at is None or sampler.kernel is None:
            left_out.append(LeftOut(family.name, "a hypothesis on a profile, which has no points"))
            continue
        yield sampler, identity
    for axes in partitions(dim, named):
        if 1 < len(axes) < dim:  # one block is jitter, blocks of one axis are the Latin hypercube
            yield _blocks(axes)
    if dim > ALL_PARTITIONS:
        why = f"beyond {ALL_PARTITIONS} dimensions blocks hold whole named regions or single axes"
        left_out.append(LeftOut("other partitions of the axes into blocks", why))
    left_out.append(
        LeftOut(
            "strata in other proportions, such as jitter:4xN",
            "equal strata are judged; a proportion that stays has the same rates",
        )
    )


def _of_family(family: Family, dim: int) -> Sampler:
    """The family without parameter, or with its example where it needs one."""
    try:
        return parse_sampler(family.name, dim)
    except InputError as error:
        if not family.example:
            raise
        try:
            return parse_sampler(f"{family.name}:{family.example}", dim)
        except InputError:
            raise error from None


def _blocks(blocks: Sequence[tuple[int, ...]]) -> _Candidate:
    sizes = "+".join(str(len(b)) for b in blocks)
    axes = tuple(a for b in blocks for a in b)
    return parse_sampler(f"uncorrelated-jitter:{sizes}", len(axes)), axes


def _named_sets(claims: Sequence[RateClaim], dim: int) -> tuple[frozenset[int], ...]:
    """The sets of axes that wanted rates name, by coordinates or by their integrand."""
    found: dict[frozenset[int], None] = {}
    for claim in claims:
        for axes in (_coordinates(claim.region) or (), claim.decay.axes):
            if axes and max(axes) > dim:
                raise InputError(f"axes must be in 1..{dim}: got {claim.text!r}")
            if axes:
                found[frozenset(axes)] = None
    return tuple(found)


def _coordinates(region: str) -> tuple[int, ...] | None:
    parts = [p.strip() for p in region.split(",")]
    return tuple(int(p) for p in parts) if all(is_whole(p) for p in parts) else None


def _judged(sampler: Sampler, axes: tuple[int, ...], claims: Sequence[RateClaim]) -> Alternative:
    place = {axis: i + 1 for i, axis in enumerate(axes)}
    counts = admissible_counts(sampler)
    reached = tuple(_reached(sampler, claim, place) for claim in claims)
    return Alternative(sampler.name, axes, law_text(sampler, counts), len(counts), reached)


def _reached(sampler: Sampler, claim: RateClaim, place: Mapping[int, int]) -> Reached:
    """The slowest of the layout's orders on the wanted region, and how far it falls short."""
    decay = replace(claim.decay, axes=tuple(sorted(place[a] for a in claim.decay.axes)))
    slow: _Term | None = None
    for region in _regions(sampler.layout, claim.region, place):
        term = _slowest_term(sampler, decay, region)
        if term is not None and (slow is None or not dominates(slow.order, term.order)):
            slow = term
    if slow is None:
        nothing = "the integrand has no power there"
        return Reached(claim, claim.region, Order(sympy.oo), nothing, nothing, None)
    wanted = Order(claim.exponent, claim.log_power)
    short = None if dominates(wanted, slow.order) else _excess(slow.order, wanted)
    condition, why = _condition(slow), _why(slow)
    aliased = slow.monomial.degree is sympy.oo
    return Reached(claim, slow.region.label, slow.order, condition, why, short, aliased)


def _regions(layout: Layout, name: str, place: Mapping[int, int]) -> tuple[Region, ...]:
    """The layout's regions of a name, coordinates being those of the user's axes."""
    support = _coordinates(name)
    if support is not None:
        return (region_of_support(layout, tuple(sorted(place[a] for a in support))),)
    return select(layout, name)


@dataclass(frozen=True)
class _Term:
    """The monomial that decides on a region, with its order."""

    region: Region
    monomial: SaturatingMonomial
    q: Expr
    order: Order


@lru_cache(maxsize=4096)
def _slowest_term(sampler: Sampler, decay: Decay, region: Region) -> _Term | None:
    q = shells(POINT, decay, sampler.layout, region)
    slow: _Term | None = None
    for monomial in profile_of(sampler, region, decay) if q is not None else ():
        order = monomial.order_at(q, region.assumptions, decay.is_product)
        if slow is None or not dominates(slow.order, order):
            slow = _Term(region, monomial, q, order)
    return slow


def _excess(slow: Order, wanted: Order) -> Order:
    """What the variance is above the wanted one, as a factor N^x (log N)^y."""
    if wanted.exponent is sympy.oo:
        return Order(-sympy.oo)
    return Order(slow.exponent - wanted.exponent, slow.log_power - wanted.log_power)


def shortfall_text(short: Order) -> str:
    """``N^(1/2)``, the factor by which a variance is larger than wanted."""
    if short.exponent == -sympy.oo:
        return "more than any power of N"
    text = order_text(short).removeprefix("1 ")
    return "N" + text[3:] if text == "N^1" or text.startswith("N^1 ") else text


def _condition(term: _Term) -> str:
    b, q = term.monomial.degree, term.q
    if term.monomial.effective == 0:
        return "b = 0: no gain from strata"
    if b == q:
        return "b = q: a logarithm" if b is not sympy.oo else "no power below the first alias"
    return (
        "b < q: the sampler decides" if q is sympy.oo or b < q else "q < b: the integrand decides"
    )


def _why(term: _Term) -> str:
    monomial = term.monomial
    b, e, q = (expression_text(x) for x in (monomial.degree, monomial.effective, term.q))
    scale = "N" if monomial.effective == 1 else f"N^({e})"
    if monomial.effective == 0:
        profile = "N P_S does not fall towards m = 0"
    elif monomial.degree is sympy.oo:
        profile = f"N P_S is 0 below an alias at {scale}"
    else:
        profile = f"N P_S ~ (m/{scale})^b, b = {b}"
    tail = "no power at high m" if term.q is sympy.oo else f"shells of energy rho^-q, q = {q}"
    vanishes = term.order.exponent is sympy.oo
    result = "the variance vanishes" if vanishes else f"variance ~ {order_text(term.order)}"
    return f"{profile}; {tail}: {result}"


def document(found: Recommendations) -> dict[str, object]:
    """The recommendations as the JSON document of the command line."""
    best = found.layout
    return {
        "scene": f"{found.dim}D, " + "; ".join(c.text for c in found.wanted),
        "dim": found.dim,
        "wanted": [c.text for c in found.wanted],
        "layout": None if best is None else best.layout,
        "regions": [] if best is None else [_region(r) for r in best.reached],
        "alternatives": [
            {
                "layout": a.layout,
                "axes": list(a.axes),
                "admissible": a.admissible,
                "reaches": a.reaches_all,
                "regions": [_region(r) for r in a.reached],
                "warning": a.warning,
            }
            for a in found.alternatives
        ],
        "left_out": [{"what": x.what, "why": x.why} for x in found.left_out],
    }


def _region(found: Reached) -> dict[str, object]:
    short = found.shortfall
    return {
        "region": found.wanted.region,
        "exponent": str(found.order.exponent),
        "log_power": str(found.order.log_power),
        "why": found.why,
        "condition": found.condition,
        "decides": found.region,
        "wanted": found.wanted.text,
        "reached": short is None,
        "shortfall": None if short is None else shortfall_text(short),
    }
