"""Series for small cells against the flux integrals of whole cells and against Gauss's rule."""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from specrate.numerics.balls import flint, rational
from specrate.numerics.exact_variances.cell_means import mean_over_cell
from specrate.numerics.exact_variances.covariogram_series import mean_at_distance, mean_deficit
from specrate.numerics.exact_variances.covariograms import Covariogram, at_zero, value

KINDS = tuple(Covariogram(d, k) for d in (2, 3) for k in range(d))
kinds = st.sampled_from(KINDS)
sizes = st.fractions(Fraction(1, 30), Fraction(9, 10), max_denominator=40)
NODES, WEIGHTS = np.polynomial.legendre.leggauss(12)


@st.composite
def small_cells(draw: st.DrawFn):
    """Half-widths with a sum of squares below 0.9."""
    kind = draw(kinds)
    axes = kind.dim - kind.flat
    widths = draw(st.lists(sizes, min_size=axes, max_size=axes))
    assume(sum(w**2 for w in widths) < Fraction(9, 10))
    return kind, [rational(w) for w in widths]


@st.composite
def far_cells(draw: st.DrawFn):
    """Cells away from 0 and 1, for which Taylor's series answers."""
    kind = draw(kinds)
    axes = kind.dim - kind.flat
    centres = draw(st.lists(sizes, min_size=axes, max_size=axes))
    y = sum(c**2 for c in centres)
    assume(y < Fraction(99, 100))
    room = min(y, 1 - y)
    shares = draw(st.lists(st.integers(1, 9), min_size=axes, max_size=axes))
    # |u| <= Σ (2p + w) w stays below 7/16 of the room
    widths = [room * s / (64 * axes) for s in shares]
    teeth = [(rational(c), rational(w)) for c, w in zip(centres, widths, strict=True)]
    assume(all(c >= w for c, w in teeth))
    return kind, teeth


@given(case=small_cells(), precision=st.sampled_from([53, 90, 200]))
def test_deficit_is_what_the_cell_leaves(case, precision):
    """Two forms with nothing in common but J: series in the size, fluxes through the sides."""
    kind, widths = case
    with flint.ctx.workprec(precision):
        deficit = mean_deficit(kind, widths)
        cell = mean_over_cell(kind, [(flint.fmpq(0), w) for w in widths])
        assert (at_zero(kind) - deficit).overlaps(cell)
        assert deficit.rad() < flint.arb(2) ** (20 - precision)
        assert cell.rad() < flint.arb(2) ** (1 - precision)


@given(case=far_cells(), precision=st.sampled_from([53, 120]))
def test_taylor_series_is_the_cell(case, precision):
    kind, teeth = case
    with flint.ctx.workprec(precision):
        mean = mean_at_distance(kind, teeth)
        assume(mean is not None)
        assert mean.overlaps(mean_over_cell(kind, teeth))
        assert mean.rad() < flint.arb(2) ** (20 - precision)


@given(case=far_cells())
def test_taylor_series_by_quadrature(case):
    """Gauss's rule on each half of each tooth; J is smooth there, to the twelfth order twice."""
    kind, teeth = case
    mean = mean_at_distance(kind, teeth)
    assume(mean is not None)
    t, weight = (NODES + 1) / 2, WEIGHTS / 2
    y, density = np.zeros(1), np.ones(1)
    for centre, width in teeth:
        c, w = (float(x.p) / float(x.q) for x in (centre, width))
        places = np.concatenate([c - w * t, c + w * t])
        y = np.add.outer(y, places**2).ravel()
        density = np.multiply.outer(density, np.tile(weight * (1 - t), 2)).ravel()
    values = [float(value(kind, flint.arb(x))) for x in y]
    assert float(density @ values) == pytest.approx(float(mean), rel=1e-9, abs=1e-12)


def test_deficits_of_small_cells_keep_their_digits():
    """d = 2: E |t| less E |t|³/6; J(0) = π/4 would leave nothing of it at 100 bits."""
    with flint.ctx.workprec(100):
        width = flint.fmpq(1, 10**40)
        deficit = mean_deficit(Covariogram(2, 0), [width, width])
        unit = (2 + flint.arb(2).sqrt() + 5 * flint.arb(1).asinh()) / 15
        assert deficit.overlaps(unit * width + flint.arb(0, 1e-120))
        assert deficit.rel_accuracy_bits() > 80


def test_projected_disk_has_a_logarithm():
    """d = 2, k = 1: J(0) - J(z) = (z²/2)(ln(4/z) - 1/2) + O(z⁴ ln z)."""
    with flint.ctx.workprec(100):
        width = flint.fmpq(1, 10**9)
        w = flint.arb(width)
        # E t² = w²/6 and E t² ln t = (w²/6)(ln w - 7/12)
        wanted = w**2 / 12 * ((4 / w).log() + flint.fmpq(7, 12) - flint.fmpq(1, 2))
        deficit = mean_deficit(Covariogram(2, 1), [width])
        assert abs(deficit / wanted - 1) < 1e-16


@pytest.mark.parametrize("kind", KINDS, ids=str)
def test_points(kind):
    y = flint.fmpq(9, 25) + (flint.fmpq(1, 4) if kind.dim - kind.flat > 1 else 0)
    teeth = [(flint.fmpq(3, 5), flint.fmpq(0)), (flint.fmpq(1, 2), flint.fmpq(0))]
    found = mean_at_distance(kind, teeth[: min(2, kind.dim - kind.flat)])
    assert found.overlaps(value(kind, flint.arb(y)))


def test_cells_that_touch_zero_or_one_are_left_to_others():
    kind, tenth = Covariogram(2, 0), flint.fmpq(1, 10)
    assert mean_at_distance(kind, [(tenth, tenth), (flint.fmpq(0), tenth)]) is None
    assert mean_at_distance(kind, [(flint.fmpq(1), tenth), (flint.fmpq(0), tenth)]) is None
