"""Uncorrelated jitter: jitter in each block of dimensions, blocks joined by random permutations.

With J_B = ∏_{i in B} sinc²(m_i/n_i), the pairs of points of a block have the characteristic
function q_B = (N [m_B = 0] − J_B)/(N − 1), and independently shuffled blocks multiply:

    N·P_S(m) = 1 + (N − 1) ∏_B (N [m_B = 0] − J_B)/(N − 1).

(Paper, Sec. 6.2; Cook 1986. Blocks of one dimension each are the Latin hypercube.)
"""

from collections.abc import Mapping, Sequence
from math import lcm

from ..errors import InputError
from ..expressions import parse_size
from ..kernels import Alphabet
from ..layouts import AxisGroup, Growth, Layout
from ..signs import Assumptions, at_least
from ..strata import Strata, equal_strata, nearest_root, parse_strata
from ..symbolic import Expr, Integer
from .definition import Sampler
from .jitter import cell_product
from .stratified import Counts

_RULE = "blocks are written as 1+2+3 (sizes with sum d)"


def uncorrelated_jitter(argument: str, dim: Expr, assumptions: Assumptions) -> Sampler:
    """``uncorrelated-jitter:1+2+3``, with symbolic d also ``1+2+(d-3)``; a part may be strata."""
    parts = _parts(argument)
    symbols = {str(s): s for s in dim.free_symbols}
    blocks: list[Expr | Strata] = []
    for part in parts:
        if "N" in part:
            blocks.append(parse_strata(part, len(part.split("x"))))
        else:
            blocks.append(parse_size(part, symbols))
    sizes = [Integer(len(b.factors)) if isinstance(b, Strata) else b for b in blocks]
    if (sum(sizes, Integer(0)) - dim).expand() != 0:
        raise InputError(f"{_RULE}: got {argument!r} for d = {dim}")
    ranges = {r.symbol: r for r in assumptions}
    for size in sizes:
        if not size.is_Integer:
            bound = at_least(size, 1)
            old = ranges.get(bound.symbol)
            if old is None or old.lower < bound.lower:
                ranges[bound.symbol] = bound
    return padded(tuple(blocks), tuple(ranges.values()), f"uncorrelated-jitter:{argument}")


def _parts(argument: str) -> list[str]:
    """Split at the plus signs outside parentheses."""
    if not argument:
        raise InputError(f"{_RULE}: got no blocks")
    depth, parts = 0, [""]
    for character in argument.replace(" ", ""):
        depth += (character == "(") - (character == ")")
        if character == "+" and depth == 0:
            parts.append("")
        else:
            parts[-1] += character
    if depth or not all(parts):
        raise InputError(f"{_RULE}: got {argument!r}")
    return parts


def padded(blocks: Sequence[Expr | Strata], assumptions: Assumptions, name: str) -> Sampler:
    """Uncorrelated jitter over blocks given by their size (equal strata) or their strata."""
    groups: list[AxisGroup] = []
    growth = {"N": Growth(Integer(1))}
    members: list[tuple[int, tuple[str, ...]]] = []  # first group and counts of each block
    first: Expr = Integer(1)
    for index, block in enumerate(blocks):
        sizes, laws = _axes(block)
        counts = tuple(f"n{index + 1}_{j + 1}" for j in range(len(laws)))
        members.append((len(groups), counts))
        for size, count, law in zip(sizes, counts, laws, strict=True):
            groups.append(AxisGroup(size, first, index))
            growth[count], first = law, first + size
    alphabet = Alphabet(("N", *(c for _, counts in members for c in counts)))
    n = alphabet.count("N")
    kernel = alphabet.constant(n - 1)
    for start, counts in members:
        inside = cell_product(alphabet, counts, start)
        kernel = kernel * (_outside(alphabet, counts, start).scaled(n) - inside).scaled(1 / (n - 1))
    layout = Layout(tuple(groups), growth, assumptions)
    counts_at = _counts(members, blocks)
    reference = "paper, Sec. 6.2; Cook 1986"
    return Sampler(
        name, "uncorrelated-jitter", layout, alphabet.constant() + kernel, counts_at, reference
    )


def _axes(block: Expr | Strata) -> tuple[tuple[Expr, ...], tuple[Growth, ...]]:
    """Sizes and growth laws of the groups of one block."""
    if isinstance(block, Strata):
        if block.equal:
            return (Integer(len(block.factors)),), block.growth[:1]
        return (Integer(1),) * len(block.factors), block.growth
    return (block,), (Growth(1 / block),)


def _outside(alphabet: Alphabet, counts: tuple[str, ...], start: int):
    """[m_B = 0] as a product over the groups of a block."""
    zero = alphabet.zero()
    product = alphabet.over(start, zero)
    for group in range(start + 1, start + len(counts)):
        product = product * alphabet.over(group, zero)
    return product


def _counts(
    members: list[tuple[int, tuple[str, ...]]], blocks: Sequence[Expr | Strata]
) -> Counts | None:
    """Counts at the nearest N that is a perfect power for every block; None if none is."""
    strata: list[Strata] = []
    for block in blocks:
        if isinstance(block, Strata):
            strata.append(block)
        elif block.is_Integer:
            strata.append(equal_strata(int(block)))
        else:
            return None
    if any(k != 1 for s in strata for k in s.factors):
        return None  # products of fixed factors meet at too few N to promise one
    power = lcm(*[sum(s.powers) for s in strata])

    def counts(n: int) -> Mapping[str, int]:
        t = max(2, nearest_root(n, 1, power))  # pairs of points need two
        found = {"N": t**power}
        for (_, names), s in zip(members, strata, strict=True):
            root = t ** (power // sum(s.powers))
            found |= {name: root**p for name, p in zip(names, s.powers, strict=False)}
        return found

    return counts
