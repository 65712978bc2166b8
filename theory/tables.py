"""Convergence tables: one row per region of a sampler, and one for the whole.

Regions of one size, of one block, or across blocks, are joined into one row where they agree;
where they differ each has its own row with its coordinates.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from .constants import MODELS, region_constant, summed_constant
from .decays import Decay, parse_decay
from .dominance import dominates
from .errors import InputError
from .expressions import is_whole, parse_size
from .orders import Order
from .primitives import Primitive, parse_primitive, sampled_dimension
from .radial import Leading
from .rates import RegionRate, is_no_harder, overall, region_rates
from .regions import touched
from .samplers import FAMILIES, Sampler, parse_sampler
from .signs import symbol
from .symbolic import Expr, Integer

_LONGEST_DIM = 6


@dataclass(frozen=True)
class Row:
    """One row: variance ~ constant · N^-exponent (log N)^log_power on a region.

    ``constant`` is exact for a named integrand, all supports of the region together; for a class it
    is that of the monomial model of Eq. 17 in c_f and ρ0; None where it is not known. ``dominated``
    says that the region falls faster than the whole. ``condition`` restricts the symbols (None:
    none).
    """

    sampler: str
    dim: str
    primitive: str
    integrand: str
    region: str
    order: Order
    constant: Expr | None
    is_overall: bool
    dominated: bool
    condition: Expr | None = None


@dataclass(frozen=True)
class LeftOut:
    """A region that a table leaves out, and why."""

    sampler: str
    integrand: str
    region: str
    why: str


@dataclass(frozen=True)
class Table:
    """Rows in the order asked for, and what was left out."""

    rows: tuple[Row, ...]
    left_out: tuple[LeftOut, ...]


def default_samplers(dim: Expr) -> tuple[str, ...]:
    """The catalogue in a dimension: each family once, with the paper's blocks for Eq. 26."""
    names = [f.name for f in FAMILIES if f.name not in ("uncorrelated-jitter", "isotropic")]
    if dim != Integer(2):
        names.remove("correlated-multi-jitter")
    if not dim.is_number:
        names.append(f"uncorrelated-jitter:1+2+({dim - 3})")
    elif dim >= 4:
        names.append(f"uncorrelated-jitter:1+2+{dim - 3}")
    return (*names, "isotropic:b")


def table(
    samplers: Sequence[str] = (),
    dims: Sequence[str | int] = ("d",),
    integrands: Sequence[str] = ("worst", "best"),
    primitive: str = "point",
    constants: bool = True,
) -> Table:
    """Convergence table of samplers × dimensions × integrand classes.

    Parameters
    ----------
    samplers : sequence of str
        Grammar of samplers; empty: the whole catalogue.
    dims : sequence of str or int
        Numbers, or ``"d"`` to keep the dimension symbolic.
    integrands : sequence of str
        Grammar of classes.
    primitive : str
        ``point``, ``line``, ``segment`` or ``K-flat``.
    constants : bool
        Whether the leading constants are wanted, which take as long as the rest.

    Returns
    -------
    Table
        Derived rows; nothing in it is typed in.

    Raises
    ------
    InputError
        If a text is outside its grammar or does not fit the dimension.
    """
    kind = parse_primitive(primitive)
    classes = [parse_decay(i) for i in integrands]
    rows: list[Row] = []
    left_out: list[LeftOut] = []
    for text in dims:
        dim = parse_dim(text)
        size = sampled_dimension(kind, dim)
        for name in samplers or default_samplers(size):
            sampler = parse_sampler(name, size)
            for decay in classes:
                rates = region_rates(sampler, decay, kind)
                rows += _rows(sampler, str(dim), kind, decay, rates, constants)
                left_out += _left_out(sampler, decay, rates)
    return Table(tuple(rows), tuple(left_out))


def parse_dim(text: str | int) -> Expr:
    """A dimension of the grammar: a whole number of at least 1, or ``d``."""
    if isinstance(text, int):
        return parse_size(str(text))
    if len(text.strip()) > _LONGEST_DIM:
        raise InputError(f"a dimension has at most {_LONGEST_DIM} digits: got {text!r}")
    if not (text.strip() == "d" or is_whole(text.strip())):
        raise InputError(f"a dimension is a whole number or d: got {text!r}")
    return parse_size(text, {"d": symbol("d")})


def _rows(
    sampler: Sampler,
    dim: str,
    kind: Primitive,
    decay: Decay,
    rates: tuple[RegionRate, ...],
    constants: bool,
) -> Iterator[Row]:
    cases = overall(rates, sampler.layout.assumptions)
    terms = _terms(sampler, kind, decay, rates) if constants else {}
    head = (sampler.name, dim, kind.name, decay.name)
    top = cases[0].order
    for region, members in joined_regions(sampler, rates):
        order = members[0].order
        assert order is not None
        dominated = len(cases) == 1 and order != top and _is_dominated(members[0], top, rates)
        constant = _joint_constant(decay, [terms.get(m.region.counts) for m in members], order)
        yield Row(*head, region, order, constant, False, dominated)
    for case in cases:
        slowest = [terms.get(r.region.counts) for r in rates if r.order == case.order]
        is_whole = decay.family not in MODELS and len(cases) == 1 and slowest
        constant = summed_constant(slowest, case.order) if is_whole else None
        yield Row(*head, "overall", case.order, constant, True, False, case.condition)


_Terms = dict[tuple[Expr, ...], Leading | None]


def _terms(
    sampler: Sampler, kind: Primitive, decay: Decay, rates: tuple[RegionRate, ...]
) -> _Terms:
    """The leading term of each region."""
    return {r.region.counts: region_constant(sampler, r, decay, kind) for r in rates}


def _joint_constant(decay: Decay, terms: list[Leading | None], order: Order) -> Expr | None:
    """The sum of joined regions' constants; of a class, whose c_f is a region's own, the common."""
    if decay.family not in MODELS:
        return summed_constant(terms, order)
    constants = {None if t is None else t.constant for t in terms}
    return constants.pop() if len(constants) == 1 else None


def _is_dominated(rate: RegionRate, top: Order, rates: tuple[RegionRate, ...]) -> bool:
    known = rate.region.assumptions
    return (rate.order is not None and bool(dominates(top, rate.order, known))) or any(
        r.order == top and is_no_harder(r, rate) for r in rates
    )


def _left_out(sampler: Sampler, decay: Decay, rates: tuple[RegionRate, ...]) -> Iterator[LeftOut]:
    for rate in rates:
        if rate.order is None:
            why = "the integrand has no power there"
            yield LeftOut(sampler.name, decay.name, rate.region.label, why)


def joined_regions(
    sampler: Sampler, rates: tuple[RegionRate, ...]
) -> Iterator[tuple[str, tuple[RegionRate, ...]]]:
    """(name, rates) of the regions with power, those of one class joined where they agree."""
    classes: dict[str, list[RegionRate]] = {}
    for rate in rates:
        if rate.order is not None:
            classes.setdefault(_class(sampler, rate), []).append(rate)
    for name, members in classes.items():
        first = members[0]
        if all(_alike(first, m) for m in members):
            yield name, tuple(members)
        else:
            yield from ((m.region.label, (m,)) for m in members)


def _alike(first: RegionRate, second: RegionRate) -> bool:
    return first.order == second.order and first.profile == second.profile


def _class(sampler: Sampler, rate: RegionRate) -> str:
    """The common name of regions that are joined if they agree."""
    layout, counts = sampler.layout, rate.region.counts
    first, *others = touched(layout, counts)
    if len(layout.blocks) > 1:
        return "across" if others else f"within {{{layout.block_coordinates(first)}}}"
    s = rate.region.dimension
    if s == 1:
        return "axis"
    if s == layout.dim:
        return "generic"
    return f"w={s}" if s.is_Integer else f"1<{s}<{layout.dim}"


def document(found: Table) -> dict[str, object]:
    """The table as the JSON document of the command line."""
    return {
        "rows": [
            {
                "sampler": r.sampler,
                "dim": r.dim,
                "primitive": r.primitive,
                "integrand": r.integrand,
                "region": r.region,
                "exponent": str(r.order.exponent),
                "log_power": str(r.order.log_power),
                "constant": None if r.constant is None else str(r.constant),
                "origin": "derived",
                "overall": r.is_overall,
                "dominated": r.dominated,
                "condition": None if r.condition is None else str(r.condition),
            }
            for r in found.rows
        ],
        "crossovers": [],
        "left_out": [
            {"sampler": x.sampler, "integrand": x.integrand, "region": x.region, "why": x.why}
            for x in found.left_out
        ],
    }
