"""Regions: what a "direction" of the paper becomes on the torus.

The paper divides the variance integral over directions n_k of the frequency sphere (Eq. 9) and
says that one direction decides the rate (Sec. 6.1). For homogenised sampling on the unit torus
that picture cannot be kept: frequencies are integer vectors m, Latin hypercube, multi-jitter and
uncorrelated jitter have their ridges on sets of directions of measure zero, where a Riemann sum
over directions does not see them, and a fixed single direction can fall faster than the whole
(jitter × disk: every rational direction gives N^-2 log N, the sum N^-3/2). What is exact is

    Var(I_N) = Σ_{u ≠ ∅} Σ_{supp m = u} P_S(m) P_f(m),    supp m = {i : m_i ≠ 0},

a sum over supports u, in which each of these samplers has one low-frequency form per class of
supports. A *region* is such a class: all supports that take the same number of axes from each
group of interchangeable axes. Its dimension s = |u| is what stands in the Jacobian ρ^(s−1) of
Eq. 17, so an axis has s = 1 and not d (erratum to Eqs. 19-25). Axes whose strata grow differently
lie in different groups and so in different regions.
"""

from dataclasses import dataclass
from itertools import product

from .errors import InputError
from .expressions import is_whole
from .layouts import Layout
from .signs import Assumptions, Range, at_least, nonnegative, symbol
from .symbolic import Expr, Integer, sympy

_MOST_REGIONS = 20_000


@dataclass(frozen=True)
class Region:
    """Supports that take ``counts[g]`` axes from group g of a layout.

    Parameters
    ----------
    counts : tuple of sympy.Expr
        One per group; a symbol ``w`` stands for every number strictly between 1 and the size.
    label : str
        Name in tables, in the grammar of regions.
    assumptions : Assumptions
        The layout's, and those of ``w``.
    """

    counts: tuple[Expr, ...]
    label: str
    assumptions: Assumptions = ()

    @property
    def dimension(self) -> Expr:
        """s, the number of nonzero coordinates."""
        return sympy.expand(sum(self.counts, Integer(0)))


def regions(layout: Layout) -> tuple[Region, ...]:
    """All regions of a layout: every frequency m ≠ 0 lies in exactly one.

    Raises
    ------
    InputError
        If there are more than 20 000.
    """
    choices = [_counts(layout, g) for g in range(len(layout.groups))]
    total = 1
    for c in choices:
        total *= len(c)
    if total > _MOST_REGIONS:
        raise InputError(f"a layout may have at most {_MOST_REGIONS} regions: got {total}")
    picks = [p for p in product(*choices) if any(count != 0 for count, _ in p)]
    found = [
        Region(counts, label(layout, counts), _with_ranges(layout, picks_of_w))
        for p in picks
        for counts, picks_of_w in [(tuple(c for c, _ in p), [r for _, rs in p for r in rs])]
    ]
    return tuple(sorted(found, key=lambda r: _place(layout, r)))


def _counts(layout: Layout, group: int) -> list[tuple[Expr, tuple[Range, ...]]]:
    """How many axes a support may take from a group, with the ranges of new symbols."""
    size = layout.groups[group].size
    if size.is_Integer:
        return [(Integer(k), ()) for k in range(int(size) + 1)]
    w = symbol("w" if len(layout.groups) == 1 else f"w_{group + 1}")
    return [
        (Integer(0), ()),
        (Integer(1), ()),
        (w, (Range(w, Integer(2)), at_least(size, w + 1))),
        (size, (at_least(size, 2),)),
    ]


def _with_ranges(layout: Layout, new: list[Range]) -> Assumptions:
    """The layout's assumptions and the new ones; of two ranges of a symbol the later holds.

    A range whose bound is larger comes later: w and then d >= w + 1; d >= 5 after d >= 4.
    """
    ranges = {r.symbol: r for r in (*(r for r in new if r.lower == 2), *layout.assumptions)}
    for r in new:
        old = ranges.get(r.symbol)
        if old is None or not nonnegative(old.lower - r.lower):
            ranges[r.symbol] = r
    return tuple(ranges.values())


def touched(layout: Layout, counts: tuple[Expr, ...]) -> tuple[int, ...]:
    """Indices of the blocks in which the support has coordinates."""
    return tuple(
        b for b, members in enumerate(layout.blocks) if any(counts[g] != 0 for g in members)
    )


def label(layout: Layout, counts: tuple[Expr, ...]) -> str:
    """The region's name: ``axis``, ``w=2``, ``generic``, ``1,3``, ``within {2,3}``, ``across``."""
    block, *others = touched(layout, counts)
    if len(layout.blocks) > 1:
        if others:
            return "across " + _coordinates(layout, counts)
        name = f"within {{{layout.block_coordinates(block)}}}"
        if all(counts[g] == layout.groups[g].size for g in layout.blocks[block]):
            return name
        return f"{name} at " + _inside(layout, counts, layout.blocks[block])
    return _inside(layout, counts, layout.blocks[block])


def _inside(layout: Layout, counts: tuple[Expr, ...], members: tuple[int, ...]) -> str:
    """Name of a support inside one block."""
    member, *others = members
    if others:
        return _coordinates(layout, counts)
    count, size = counts[member], layout.groups[member].size
    if count == 1:
        return "axis"
    if count == size:
        return "generic"
    return f"w={count}" if count.is_Integer else f"1<{count}<{size}"


def _coordinates(layout: Layout, counts: tuple[Expr, ...]) -> str:
    """Support by coordinates where the groups are taken whole, else by numbers of axes."""
    parts: list[str] = []
    for g, count in zip(layout.groups, counts, strict=True):
        if count == g.size:
            parts.append(g.coordinates)
        elif count != 0:
            parts.append(f"{count} of {{{g.coordinates}}}")
    return ",".join(parts)


def _place(layout: Layout, region: Region) -> tuple[object, ...]:
    """Order in tables: block by block, small supports first, the across-block ones last."""
    blocks = touched(layout, region.counts)
    sizes = [
        int(c) if c.is_Integer else 10**6 if c in (g.size,) else 10**5
        for g, c in zip(layout.groups, region.counts, strict=True)
    ]
    return (len(blocks) > 1, blocks if len(blocks) == 1 else (), sum(sizes), [-s for s in sizes])


def region_of_support(layout: Layout, support: tuple[int, ...]) -> Region:
    """The region of a support given by its 1-based coordinates, in a layout of known sizes.

    Raises
    ------
    InputError
        If a coordinate is outside 1..d, repeated, or the sizes are symbolic.
    """
    if not layout.dim.is_Integer:
        raise InputError(f"a support by coordinates needs a number as dimension: got {layout.dim}")
    d = int(layout.dim)
    if len(set(support)) != len(support) or not support or not all(1 <= i <= d for i in support):
        given = ",".join(map(str, support))
        raise InputError(f"a support has distinct coordinates in 1..{d}: got {given}")
    counts = tuple(
        Integer(sum(bool(g.first <= i < g.first + g.size) for i in support)) for g in layout.groups
    )
    return Region(counts, label(layout, counts), layout.assumptions)


def select(layout: Layout, text: str) -> tuple[Region, ...]:
    """Regions that a REGION of the grammar names.

    ``overall``; a support by coordinates ``1`` or ``1,3``; ``axis`` (``w=1``), ``w=2``, ...,
    ``generic`` (``w=d``); ``within`` and ``across`` for blocks; or the label of a region.

    Raises
    ------
    InputError
        If no region of the layout has that name.
    """
    word = text.strip()
    everything = regions(layout)
    if word == "overall":
        return everything
    if word and all(is_whole(p.strip()) for p in word.split(",")):
        return (region_of_support(layout, tuple(int(p) for p in word.split(","))),)
    found = tuple(r for r in everything if _named(layout, r, word))
    if not found:
        names = ", ".join(dict.fromkeys(r.label for r in everything[:12]))
        rule = f"a region of this sampler is overall, {names}{_supports_told(layout)}"
        raise InputError(f"{rule}: got {text!r}")
    return found


def _supports_told(layout: Layout) -> str:
    """That coordinates name a support, where the dimension is a number."""
    if not layout.dim.is_Integer:
        return ""
    last = min(int(layout.dim), 3)
    return " or a support such as 1" + (f" or 1,{last}" if last > 1 else "")


def _named(layout: Layout, region: Region, word: str) -> bool:
    s = region.dimension
    if word in ("axis", "w=1"):
        return s == 1
    if word == "generic":
        return s == layout.dim
    if word.startswith("w="):
        return word[2:].strip() == str(s)
    blocks = touched(layout, region.counts)
    if word in ("within", "across"):
        return len(layout.blocks) > 1 and (len(blocks) > 1) == (word == "across")
    return word == region.label
