"""Partitions of the axes into blocks, up to the exchange of axes that nothing tells apart."""

from collections.abc import Iterator, Sequence

from .symbolic import sympy

ALL_PARTITIONS = 6
"""Dimensions up to which every partition is listed; 203 in six, if all axes differ."""

_MOST_ROLES = 4  # kinds of axes beyond: 15 partitions of them, each split or not
_MOST_BLOCKS = 8  # beyond: a layout has up to 2^blocks regions


def partitions(
    dim: int, named: Sequence[frozenset[int]] = ()
) -> Iterator[tuple[tuple[int, ...], ...]]:
    """Partitions of the axes 1..dim into blocks, up to the exchange of axes of one role.

    Axes have one role if they lie in the same named sets. Beyond 6 dimensions only partitions
    whose blocks hold whole roles, or single axes of a role that is split, with at most 8 blocks;
    none where there are more than 4 roles.

    Parameters
    ----------
    named : sequence of sets of int

    Yields
    ------
    tuple of blocks
        Each an increasing tuple of axes; blocks in the order of their first axes.
    """
    roles: dict[tuple[bool, ...], list[int]] = {}
    for axis in range(1, dim + 1):
        roles.setdefault(tuple(axis in s for s in named), []).append(axis)
    members = list(roles.values())
    if dim <= ALL_PARTITIONS:
        labels = [i for i, axes in enumerate(members) for _ in axes]
        for parts in _multiset_partitions(labels):
            yield _assigned(parts, members)
        return
    if len(members) <= _MOST_ROLES:
        yield from _of_whole_roles(members)


def _multiset_partitions(labels: list[int]) -> Iterator[list[list[int]]]:
    yield from sympy.utilities.iterables.multiset_partitions(labels)


def _assigned(
    parts: Sequence[Sequence[int]], members: Sequence[Sequence[int]]
) -> tuple[tuple[int, ...], ...]:
    """Blocks of axes from blocks of roles: the axes of a role are handed out in their order."""
    left = [iter(axes) for axes in members]
    ordered = sorted(parts, key=lambda p: (min(p), len(p)))
    blocks = [tuple(sorted(next(left[role]) for role in part)) for part in ordered]
    return tuple(sorted(blocks))


def _of_whole_roles(members: Sequence[Sequence[int]]) -> Iterator[tuple[tuple[int, ...], ...]]:
    """Roles joined in all ways; a role that is alone is one block, or single axes."""
    roles = list(range(len(members)))
    for parts in _multiset_partitions(roles):
        alone = [p[0] for p in parts if len(p) == 1 and len(members[p[0]]) > 1]
        for mask in range(1 << len(alone)):
            split = {role for i, role in enumerate(alone) if mask >> i & 1}
            blocks: list[tuple[int, ...]] = []
            for part in parts:
                axes = sorted(a for role in part for a in members[role])
                blocks += [(a,) for a in axes] if part[0] in split else [tuple(axes)]
            if len(blocks) <= _MOST_BLOCKS:
                yield tuple(sorted(blocks))
