"""How the strata of a sampler lie: groups of interchangeable axes, in independent blocks.

A *block* is a set of coordinates that a sampler treats together; different blocks are joined by
random permutations (uncorrelated jitter). Inside a block, axes that are stratified alike form a
*group*: the spectrum does not change when axes of a group are exchanged, so a support is known by
how many axes it takes from each group.

Strata counts obey growth laws n = κ N^a. Over one block the exponents a sum to 1, since the block
has N cells; a constant count has a = 0.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field

from .signs import Assumptions
from .symbolic import Expr, Integer, sympy


@dataclass(frozen=True)
class Growth:
    """A count that grows as constant · N^exponent."""

    exponent: Expr
    constant: Expr = Integer(1)


@dataclass(frozen=True)
class AxisGroup:
    """Interchangeable axes ``first .. first + size - 1`` (1-based) of one block.

    Parameters
    ----------
    size : sympy.Expr
        Number of axes; may be symbolic.
    first : sympy.Expr
        The first coordinate.
    block : int
        Index of the block to which the axes belong.
    """

    size: Expr
    first: Expr = Integer(1)
    block: int = 0

    @property
    def coordinates(self) -> str:
        """The axes as text: ``2``, ``2,3`` or ``4..d``."""
        return spelled(self.first, self.size)


def spelled(first: Expr, size: Expr) -> str:
    """Coordinates ``first .. first + size - 1`` as text."""
    last = first + size - 1
    if size == 1:
        return str(first)
    if last.is_Integer and int(size) <= 4:
        return ",".join(str(i) for i in range(int(first), int(last) + 1))
    return f"{first}..{last}"


@dataclass(frozen=True)
class Layout:
    """Groups of axes in blocks, the growth laws of the strata, and what is known of symbols.

    Parameters
    ----------
    groups : tuple of AxisGroup
        In the order of their coordinates; together they are all d coordinates.
    growth : mapping of str to Growth
        Growth law of every count that the kernel names; always holds ``N``.
    assumptions : Assumptions
        Ranges of the symbols, as d >= 4.
    """

    groups: tuple[AxisGroup, ...]
    growth: Mapping[str, Growth] = field(
        default_factory=lambda: {"N": Growth(Integer(1))}, hash=False
    )
    assumptions: Assumptions = ()

    @property
    def dim(self) -> Expr:
        """The dimension d."""
        return sympy.expand(sum((g.size for g in self.groups), Integer(0)))

    @property
    def blocks(self) -> tuple[tuple[int, ...], ...]:
        """Indices of the groups of each block."""
        names = dict.fromkeys(g.block for g in self.groups)
        return tuple(
            tuple(i for i, g in enumerate(self.groups) if g.block == name) for name in names
        )

    def block_coordinates(self, block: int) -> str:
        """The coordinates of a block as text."""
        members = [self.groups[i] for i in self.blocks[block]]
        return spelled(members[0].first, sum((g.size for g in members), Integer(0)))


def grouped(
    sizes: tuple[Expr, ...], blocks: tuple[int, ...] | None = None
) -> tuple[AxisGroup, ...]:
    """Groups of the given sizes, one after the other; each in block 0 unless told otherwise."""
    first: Expr = Integer(1)
    found: list[AxisGroup] = []
    for i, size in enumerate(sizes):
        found.append(AxisGroup(size, first, blocks[i] if blocks else 0))
        first = first + size
    return tuple(found)
