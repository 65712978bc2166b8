r"""Mean covariogram over any cell, also one that reaches distance 0 or crosses the diameter 2R.

A cell is a product of triangular teeth and of whole lines along the axes that the ball is projected
along. Each axis is split into pieces with affine densities (lengths in units of 2R), and the
integrals over the boxes become fluxes through their faces (``disk_fluxes``, ``ball_fluxes``).
"""

from collections.abc import Sequence
from dataclasses import replace
from math import ceil, isqrt, log

from ..balls import Ball, Rational, flint
from .ball_fluxes import ball_flux
from .covariogram_series import Tooth
from .covariograms import Covariogram, at_zero, unit_ball, value
from .disk_fluxes import Piece, disk_flux

_FIRST_SPARE = 30  # bits; fluxes cancel against each other
_MOST_BITS = 1 << 20


def mean_over_cell(covariogram: Covariogram, teeth: Sequence[Tooth]) -> Ball:
    """E J(|p + t|), t_i triangular with |t_i| < w_i, with a radius below 2^-precision J(0).

    Parameters
    ----------
    covariogram : Covariogram
        With dim - flat axes.
    teeth : sequence of Tooth, dim - flat of them
        With w_i > 0, and p_i = 0 or p_i >= w_i.
    """
    asked = flint.ctx.prec
    nearest2 = sum((max(p - w, 0) ** 2 for p, w in teeth), flint.fmpq(0))
    if nearest2 >= 1:
        return flint.arb(0)
    axes = _axes(covariogram, teeth, nearest2)
    flux = (_interval_mean, disk_flux, ball_flux)[covariogram.dim - 1]
    try:
        flint.ctx.prec = asked + _FIRST_SPARE
        radius = at_zero(covariogram) * flint.arb(2) ** -asked
        largest = value(covariogram, flint.arb(nearest2)) if nearest2 else at_zero(covariogram)
        if largest < radius:  # J falls with the distance
            return flint.arb(0, largest.upper())
        while True:
            mean = flux(axes) / unit_ball(covariogram.flat)
            error = mean.rad()
            if error < radius or flint.ctx.prec > _MOST_BITS:
                break
            flint.ctx.prec += _missing_bits(error, radius)
    finally:
        flint.ctx.prec = asked
    return +mean


def _interval_mean(axes: tuple[tuple[Piece, ...], ...]) -> Ball:
    """∫ g(x) (1 - x) over 0 <= x <= 1: J of an interval is a polynomial."""
    total = flint.fmpq(0)
    for piece in axes[0]:
        for x, sign in ((piece.start, -1), (min(piece.end, flint.fmpq(1)), 1)):
            constant, slope = x - x**2 / 2, x**2 / 2 - x**3 / 3
            total += sign * (piece.constant * constant + piece.slope * slope)
    return flint.arb(total)


def _missing_bits(error: Ball, radius: Ball) -> int:
    """By how many bits the error is too large, with a few to spare."""
    if not error.is_finite():
        return flint.ctx.prec
    return ceil(float((error / radius).log()) / log(2)) + _FIRST_SPARE // 3


def _axes(
    covariogram: Covariogram, teeth: Sequence[Tooth], nearest2: Rational
) -> tuple[tuple[Piece, ...], ...]:
    """Densities on the positive half-axes, cut off where every point is farther away than 1."""
    zero, one = flint.fmpq(0), flint.fmpq(1)
    line = (Piece(zero, one, flint.fmpq(2), zero),)
    axes = [(_tooth(p, w), max(p - w, 0)) for p, w in teeth] + [(line, zero)] * covariogram.flat
    return tuple(_cut(pieces, _root_above(1 - nearest2 + gap**2)) for pieces, gap in axes)


def _root_above(square: Rational) -> Rational:
    """A rational from √square to (1 + 2^-20) √square."""
    bits = 40 + max(0, int(square.q).bit_length() - int(square.p).bit_length())
    return flint.fmpq(isqrt(int(square.p * 4**bits // square.q)) + 1, 2**bits)


def _cut(pieces: tuple[Piece, ...], end: Rational) -> tuple[Piece, ...]:
    return tuple(replace(p, end=min(p.end, end)) for p in pieces if p.start < end)


def _tooth(centre: Rational, width: Rational) -> tuple[Piece, ...]:
    """The positive half of a tooth at 0, doubled, or both halves of another one."""
    zero, slope = flint.fmpq(0), 1 / width**2
    if centre == 0:
        return (Piece(zero, width, 2 / width, -2 * slope),)
    rising = Piece(centre - width, centre, 1 / width - centre * slope, slope)
    falling = Piece(centre, centre + width, 1 / width + centre * slope, -slope)
    return rising, falling
