"""Exact variances of separable integrands: the kernel's tree against one-dimensional power sums.

N·Var = Σ_{m≠0} K(m) |f^(m)|². The kernel K is a tree of sums and products whose leaves are
c ∏_i φ_i(m_i), and |f^(m)|² = ∏_i |f^_i(m_i)|²: a leaf gives a product over the coordinates of

    (φ_i(0) |f^_i(0)|², Σ_{m≠0} φ_i(m) |f^_i(m)|²),

two numbers that multiply as in `energies`, so that the mean is never subtracted. Coordinates that
share their strata and their f_i enter as one power. Where f is constant in a coordinate every
factor of a kernel is 1, as it is at m = 0: that coordinate is left out. What is left of
cancellation, between the leaves at low frequencies, is paid for in precision.
"""

from bisect import bisect_right
from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import groupby
from math import lcm
from typing import TypeAlias

from ...theory.errors import InputError
from ...theory.kernels import Atom, Kernel
from ...theory.kernels import Factor as KernelFactor
from ...theory.layouts import Layout
from ...theory.samplers import Sampler
from ...theory.shapes import SINC2
from ..balls import Ball, certified, flint
from ..expected_spectra.shape_sums import shape_sum
from ..expected_spectra.spectrum_balls import element_rational
from ..integrands.energies import Energy, factor_energy, unit_energy
from ..integrands.protocol import Factor, Part

Members: TypeAlias = tuple[tuple[tuple[Factor, int], ...], ...]
"""For each group of axes: the functions of one coordinate on its axes, and on how many each."""


def product_variance(
    sampler: Sampler, counts: Mapping[str, int], parts: Sequence[Part], digits: int
) -> Ball:
    """Variance with a relative radius below 10^-digits, or exactly zero.

    Parameters
    ----------
    sampler : Sampler
        With a kernel.
    counts : mapping of str to int
        Every count of the kernel.
    parts : sequence of Part
        Products without common frequencies.
    digits : int

    Raises
    ------
    InputError
        If the digits are out of reach.
    """
    kernel = sampler.kernel
    assert kernel is not None
    kinds = Counter(_members(sampler.layout, part) for part in parts)

    def evaluate() -> Ball:
        total = flint.arb(0)
        for members, repeated in kinds.items():
            energy, held = _tree_energy(kernel, counts, members)
            energy = energy * _unweighted(members, set(range(len(members))) - held)
            total += repeated * energy.beyond
        return total / counts["N"]

    return certified(evaluate, digits)


def _members(layout: Layout, part: Part) -> Members:
    firsts = [int(g.first) for g in layout.groups]
    found: list[Counter[Factor]] = [Counter() for _ in firsts]
    # Runs first: equal neighbours are mostly one object, and a hash of fractions is slow.
    placed = ((bisect_right(firsts, axis) - 1, factor) for axis, factor in part)
    for (group, factor), run in groupby(placed):
        found[group][factor] += sum(1 for _ in run)
    return tuple(tuple(counter.items()) for counter in found)


def _tree_energy(
    kernel: Kernel, counts: Mapping[str, int], members: Members
) -> tuple[Energy, set[int]]:
    """Energy over the groups that the kernel mentions, and these groups."""
    if kernel.term is not None:
        energy = unit_energy()
        for group, weight in kernel.term.factors:
            for factor, axes in members[group]:
                energy = energy * _weighted(factor, weight, counts).to_power(axes)
        held = {group for group, _ in kernel.term.factors}
        return energy.scaled(flint.arb(element_rational(kernel.term.coefficient, counts))), held
    found = [_tree_energy(k, counts, members) for k in _operands(kernel)]
    held = {group for _, groups in found for group in groups}
    if kernel.kind == "product":
        if sum(len(groups) for _, groups in found) != len(held):
            raise InputError("factors of a kernel's product must stand on different axes: got one")
        energy = unit_energy()
        for part, _ in found:
            energy = energy * part
        return energy, held
    energy = Energy(flint.arb(0), flint.arb(0))
    for part, groups in found:
        energy = energy + part * _unweighted(members, held - groups)
    return energy, held


def _operands(kernel: Kernel) -> list[Kernel]:
    """The operands of a chain (a + b) + c or (a × b) × c, however long."""
    found: list[Kernel] = []
    node = kernel
    while node.term is None and node.kind == kernel.kind:
        found += reversed(node.parts[1:])
        node = node.parts[0]
    return [node, *reversed(found)]


def _unweighted(members: Members, groups: set[int]) -> Energy:
    """Energy over the axes of groups that a part of the kernel does not mention."""
    energy = unit_energy()
    for group in groups:
        for factor, axes in members[group]:
            energy = energy * factor_energy(factor).to_power(axes)
    return energy


def _weighted(factor: Factor, weight: KernelFactor, counts: Mapping[str, int]) -> Energy:
    """Energy of a function of one coordinate, weighted by a kernel's factor, which is 1 at 0."""
    beyond = flint.arb(0)
    for coefficient, atom in weight.terms:
        if not atom.zero:
            beyond += element_rational(coefficient, counts) * _atom_energy(factor, atom, counts)
    mean = factor.mean()
    return Energy(mean * mean, beyond)


def _atom_energy(factor: Factor, atom: Atom, counts: Mapping[str, int]) -> Ball:
    """Σ over m ≠ 0 of |f^(m)|² against an atom without [m = 0]."""
    combs = [int(element_rational(c, counts).p) for c in atom.combs]
    shapes = [(shape, int(element_rational(c, counts).p)) for shape, c in atom.shapes]
    if len(shapes) > 1 or any(shape != SINC2 for shape, _ in shapes):
        if combs:
            raise InputError(f"a comb must stand beside one sinc² or nothing: got {shapes}")
        return shape_sum(factor, shapes)
    return factor.power_sum(lcm(*combs), shapes[0][1] if shapes else None)
