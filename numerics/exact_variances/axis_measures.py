"""Kernels read in real space: each factor of N·P_S is a probability measure on one axis.

A function φ(m) of one frequency is the Fourier transform of a measure μ on the circle, and
Σ_m φ(m) |f^(m)|² = E C_f(h) with h drawn from μ, where C_f(h) = ∫ f(x) f(x + h) dx. The atoms are

    1                      the point 0,
    sinc²(m/n)             the triangle n (1 - n|h|) on |h| < 1/n (for n = 1 it closes up: uniform),
    [m = 0]                the uniform measure,
    [c divides m]          c equal points j/c,
    the comb × sinc²(m/n)  c equal triangles of half-width 1/n around the points j/c,

so that N·Var = Σ coefficient · E C_f over products of such measures. On the line, unrolled, all but
the uniform measure are *teeth*: points j/c, all integers j, each with mass 1/c and a half-width.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from itertools import product

from ...theory.errors import InputError
from ...theory.kernels import Atom, Kernel
from ...theory.samplers import Sampler
from ...theory.shapes import SINC2
from ...theory.symbolic import FracElement
from ..balls import Rational, flint
from ..expected_spectra.spectrum_balls import element_rational


class OutOfReach(InputError):
    """An exact variance that would take too many cells, or formulas that are not here."""


@dataclass(frozen=True, order=True)
class AxisMeasure:
    """Teeth at j/spacings with half-width 1/strata; points where strata is 0.

    Parameters
    ----------
    spacings : int
        How many teeth a period has; 0 for the uniform measure.
    strata : int
        Inverse half-width of a tooth, at least 2 per tooth; 0 for points.
    """

    spacings: int
    strata: int


UNIFORM = AxisMeasure(0, 0)


def measure_terms(
    sampler: Sampler, counts: Mapping[str, int]
) -> dict[tuple[AxisMeasure, ...], Rational]:
    """N·Var = Σ coefficient · E C_f, for an f that no exchange of coordinates changes.

    Parameters
    ----------
    sampler : Sampler
        With a kernel, in a dimension that is a number.
    counts : mapping of str to int
        Every count of the kernel.

    Returns
    -------
    dict
        Exact coefficients of products of measures, each product sorted: like terms have been added
        and the mean's own term -N·P_S(0) (∫f)² is among the uniform ones.

    Raises
    ------
    OutOfReach
        If an atom is none of those above.
    """
    assert sampler.kernel is not None
    sizes = tuple(int(g.size) for g in sampler.layout.groups)
    sums: dict[tuple[AxisMeasure, ...], Rational] = {}
    at_zero = flint.fmpq(0)
    for coefficient, atoms in _axis_terms(sampler.kernel, sizes):
        number = element_rational(coefficient, counts)
        key = tuple(sorted(_measure(a, counts) for a in atoms))
        sums[key] = sums.get(key, 0) + number
        at_zero += number  # every atom is 1 at m = 0
    uniform = (UNIFORM,) * sum(sizes)
    sums[uniform] = sums.get(uniform, 0) - at_zero
    return {key: number for key, number in sums.items() if number != 0}


@lru_cache(maxsize=256)
def _axis_terms(
    kernel: Kernel, sizes: tuple[int, ...]
) -> tuple[tuple[FracElement, tuple[Atom, ...]], ...]:
    """The kernel multiplied out: coefficients, and one atom per axis."""
    if kernel.term is None:
        parts = [{a: c for c, a in _axis_terms(p, sizes)} for p in kernel.parts]
        total = parts[0]
        for part in parts[1:]:
            total = _added(total, part) if kernel.kind == "sum" else _multiplied(total, part)
    else:
        factors = dict(kernel.term.factors)
        total = {(Atom(),) * sum(sizes): kernel.term.coefficient}
        for group, factor in factors.items():
            for axis in range(sum(sizes[:group]), sum(sizes[: group + 1])):
                here = [Atom()] * sum(sizes)
                factor_terms: dict[tuple[Atom, ...], FracElement] = {}
                for c, atom in factor.terms:
                    here[axis] = atom
                    factor_terms[tuple(here)] = c
                total = _multiplied(total, factor_terms)
    return tuple((c, atoms) for atoms, c in total.items() if c != 0)


def _added(
    x: dict[tuple[Atom, ...], FracElement], y: dict[tuple[Atom, ...], FracElement]
) -> dict[tuple[Atom, ...], FracElement]:
    total = dict(x)
    for atoms, c in y.items():
        total[atoms] = total[atoms] + c if atoms in total else c
    return total


def _multiplied(
    x: dict[tuple[Atom, ...], FracElement], y: dict[tuple[Atom, ...], FracElement]
) -> dict[tuple[Atom, ...], FracElement]:
    total: dict[tuple[Atom, ...], FracElement] = {}
    for (left, c), (right, k) in product(x.items(), y.items()):
        atoms = tuple(a * b for a, b in zip(left, right, strict=True))
        total[atoms] = total[atoms] + c * k if atoms in total else c * k
    return total


def _measure(atom: Atom, counts: Mapping[str, int]) -> AxisMeasure:
    """The measure whose Fourier transform is the atom."""
    if atom.zero:
        return UNIFORM
    combs = [int(element_rational(c, counts).p) for c in atom.combs]
    strata = [int(element_rational(c, counts).p) for shape, c in atom.shapes if shape == SINC2]
    if len(combs) > 1 or len(strata) > 1 or len(strata) < len(atom.shapes):
        raise OutOfReach(f"an atom must have at most one comb and one sinc²: got {atom}")
    spacings = combs[0] if combs else 1
    if not strata:
        return AxisMeasure(spacings, 0)
    if spacings % strata[0] == 0:  # sinc² vanishes on the comb but at 0
        return UNIFORM
    if strata[0] % spacings:
        raise OutOfReach(f"a comb must divide the count of its sinc²: got {spacings}, {strata[0]}")
    return AxisMeasure(spacings, strata[0])
