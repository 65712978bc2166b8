r"""Exact variance of the ball and of its chord lengths in real space, certified, at any N.

N·P_S is a sum of products over the coordinates, and each product is the Fourier transform of a
product measure (``axis_measures``), so that with the covariogram C_f(h) = ∫ f(x) f(x + h) dx

    N·Var = Σ coefficient · E C_f(h).

For the ball C_f(h) = Σ over integer translates of C(|h|), and C(r) = 0 for r >= 2R: unrolled to the
line, a measure is a row of teeth, and a uniform measure integrates C along its axis. Every product
of teeth is a cell, and a cell is

    beyond 2R                      nothing
    around 0, within 2R            C(0) less a series in the cell's size
    away from 0 and from 2R        a Taylor series
    else                           an integral over its faces,

all proven balls. What multiplies C(0) is added up exactly before: where it comes to nothing, as it
does for jitter, the small differences C(0) - C(h) are never differences of large numbers.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field
from itertools import product
from math import lcm, prod
from typing import TypeAlias

import numpy as np

from ...theory.errors import InputError
from ...theory.samplers import Sampler
from ..balls import Ball, Rational, certified, flint, rational
from ..integrands.ball import Ball as BallIntegrand
from ..integrands.chord import Chord
from .axis_measures import UNIFORM, AxisMeasure, OutOfReach, measure_terms
from .cell_means import mean_over_cell
from .covariogram_series import Tooth, mean_at_distance, mean_deficit
from .covariograms import Covariogram, at_zero, scale, unit_ball, value

MOST_CELLS = 20_000
"""Teeth with a width, over all products of axes."""

MOST_POINTS = 1_000_000
"""Teeth that are points, over all products of axes."""

MOST_DISTANCES = 200_000
"""Different distances of such points from 0."""

_SERIES_REACH = flint.fmpq(9, 10)  # squared: for wider cells the faces are faster

Cell: TypeAlias = tuple[int, tuple[Tooth, ...]]
"""The number of uniform axes, and the teeth on the others."""


@dataclass(frozen=True)
class _Sums:
    """N·Var = Σ coefficient · mean: exact coefficients, those of equal means added up.

    Parameters
    ----------
    at_zero : dict
        Of C(0), by the number of uniform axes; where all axes are uniform, of (∫f)².
    deficits, cells : dict
        Of E C - C(0) and of E C.
    points : list of _Points
    """

    at_zero: dict[int, Rational] = field(default_factory=dict[int, Rational])
    deficits: dict[Cell, Rational] = field(default_factory=dict[Cell, Rational])
    cells: dict[Cell, Rational] = field(default_factory=dict[Cell, Rational])
    points: list["_Points"] = field(default_factory=list["_Points"])


@dataclass(frozen=True)
class _Points:
    """Coefficient times Σ ways · C, at the squared distances squares/limit in units of 2R."""

    flat: int
    coefficient: Rational
    limit: Rational
    squares: tuple[int, ...]
    ways: tuple[int, ...]


def ball_variance(
    sampler: Sampler, counts: Mapping[str, int], integrand: BallIntegrand | Chord, digits: int
) -> Ball:
    """Variance of the randomly shifted estimator, with a relative radius below 10^-digits.

    Parameters
    ----------
    sampler : Sampler
        With a kernel, in the dimension of the integrand.
    counts : mapping of str to int
        Every count of the kernel, N among them.
    integrand : Ball or Chord
    digits : int
        Decimal digits, 1 or more.

    Raises
    ------
    OutOfReach
        If the ball has not two or three dimensions, the kernel has other shapes than sinc², or
        its combs have too many teeth within the distance 2R.
    InputError
        If the dimensions differ.
    """
    flat = int(isinstance(integrand, Chord))
    dim = integrand.dim + flat
    if dim not in (2, 3):
        rule = "a covariogram's ball must have 2 or 3 dimensions (an interval is a product)"
        raise OutOfReach(f"{rule}: got {dim}")
    if sampler.dim != integrand.dim:
        raise InputError(f"--dim of the sampler must be {integrand.dim}: got {sampler.dim}")
    radius = rational(integrand.radius)
    sums = _Sums()
    for measures, coefficient in measure_terms(sampler, counts).items():
        rows = [m for m in measures if m != UNIFORM]
        uniform = flat + len(measures) - len(rows)
        if not rows:
            sums.at_zero[dim] = coefficient
        elif all(m.strata == 0 for m in rows):
            _add_points(sums, uniform, rows, coefficient, radius)
        else:
            _add_cells(sums, Covariogram(dim, uniform), rows, coefficient, radius)
    return certified(lambda: _total(sums, dim, radius) / counts["N"], digits)


def _add_cells(
    sums: _Sums,
    covariogram: Covariogram,
    rows: list[AxisMeasure],
    coefficient: Rational,
    radius: Rational,
) -> None:
    """Every product of teeth that comes nearer to 0 than 2R; teeth at -p count with those at p."""
    teeth_within = [_teeth_within(m, radius) for m in rows]
    _require(prod(teeth_within), MOST_CELLS, "cells")
    unit, flat = 2 * radius, covariogram.flat
    weight = coefficient / prod(m.spacings for m in rows)
    widths = [1 / (unit * m.strata) if m.strata else flint.fmpq(0) for m in rows]
    centres = [
        [flint.fmpq(j, m.spacings) / unit for j in range(k)]
        for m, k in zip(rows, teeth_within, strict=True)
    ]
    polynomial = covariogram.dim == 3 and flat != 1
    series_reach = 1 if polynomial else _SERIES_REACH
    within = sum(w**2 for w in widths) < series_reach
    for place in product(*centres):
        gaps = (max(p - w, 0) for p, w in zip(place, widths, strict=True))
        if sum(g**2 for g in gaps) >= 1:
            continue
        here = weight * 2 ** sum(p != 0 for p in place)
        cell = (flat, tuple(sorted(zip(place, widths, strict=True))))
        if within and not any(place):
            sums.at_zero[flat] = sums.at_zero.get(flat, 0) + here
            sums.deficits[cell] = sums.deficits.get(cell, 0) + here
        else:
            sums.cells[cell] = sums.cells.get(cell, 0) + here


def _teeth_within(measure: AxisMeasure, radius: Rational) -> int:
    """How many teeth with j >= 0 a row has at j/spacings - 1/strata < 2R."""
    width = flint.fmpq(1, measure.strata) if measure.strata else 0
    return int((measure.spacings * (2 * radius + width)).ceil())


def _require(needed: int, most: int, what: str) -> None:
    if needed > most:
        raise OutOfReach(f"{what} within the ball's diameter must be at most {most}: got {needed}")


def _add_points(
    sums: _Sums, flat: int, rows: list[AxisMeasure], coefficient: Rational, radius: Rational
) -> None:
    """Points of a lattice by their distance: in how many ways k is a sum of d squares."""
    teeth_within = [_teeth_within(m, radius) for m in rows]
    _require(prod(teeth_within), MOST_POINTS, "points")
    weight = coefficient / prod(m.spacings for m in rows)
    sums.at_zero[flat] = sums.at_zero.get(flat, 0) + weight
    if prod(teeth_within) == 1:  # no row has a point between 0 and 2R
        return
    grid = lcm(*(m.spacings for m in rows))
    if grid >= 1 << 30:  # squares of whole numbers must stay below 2^63
        raise OutOfReach(f"points must lie on a grid 1/n with n < 2^30: got n = {grid}")
    squares, ways = np.zeros(1, np.int64), np.ones(1, np.int64)
    for m, k in zip(rows, teeth_within, strict=True):
        steps = np.arange(k) * (grid // m.spacings)
        squares, inverse = np.unique(np.add.outer(squares, steps**2), return_inverse=True)
        both_sides = np.multiply.outer(ways, np.where(steps == 0, 1, 2))
        ways = np.bincount(inverse.ravel(), both_sides.ravel()).astype(np.int64)
    limit = (2 * radius * grid) ** 2
    within = slice(1, int(np.searchsorted(squares, int(limit.ceil()))))
    _require(within.stop, MOST_DISTANCES, "distances")
    found = tuple(squares[within].tolist()), tuple(ways[within].tolist())
    sums.points.append(_Points(flat, weight, limit, *found))


def _total(sums: _Sums, dim: int, radius: Rational) -> Ball:
    """N·Var at the precision in force."""
    kinds = [Covariogram(dim, k) for k in range(dim)]
    totals = [at_zero(c) * sums.at_zero.get(c.flat, 0) for c in kinds]
    for (k, teeth), coefficient in sums.deficits.items():
        totals[k] -= coefficient * mean_deficit(kinds[k], [w for _, w in teeth if w != 0])
    for (k, teeth), coefficient in sums.cells.items():
        totals[k] += coefficient * _mean(kinds[k], teeth)
    for p in sums.points:
        share = 1 / flint.arb(p.limit)
        terms = zip(p.squares, p.ways, strict=True)
        values = (ways * value(kinds[p.flat], square * share) for square, ways in terms)
        totals[p.flat] += p.coefficient * sum(values, flint.arb(0))
    scaled = (t * scale(c, radius) for t, c in zip(totals, kinds, strict=True))
    return sum(scaled, sums.at_zero.get(dim, 0) * (unit_ball(dim) * radius**dim) ** 2)


def _mean(covariogram: Covariogram, teeth: tuple[Tooth, ...]) -> Ball:
    if any(p != 0 for p, _ in teeth):
        mean = mean_at_distance(covariogram, teeth)
        if mean is not None:
            return mean
    if any(w == 0 for _, w in teeth):
        raise OutOfReach(f"teeth near 0 or 2R must all have a width: got {teeth}")
    return mean_over_cell(covariogram, teeth)
