"""Means over cells of any shape: partitions of a line add up to the ball projected along it."""

from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from specrate.numerics.balls import Ball, flint, rational
from specrate.numerics.exact_variances.cell_means import mean_over_cell
from specrate.numerics.exact_variances.covariograms import Covariogram, unit_ball

steps = st.fractions(Fraction(1, 4), Fraction(3, 2), max_denominator=20)


@st.composite
def teeth(draw: st.DrawFn):
    """A tooth around 0, or one that may cross the diameter."""
    width = draw(steps)
    centre = draw(st.one_of(st.just(Fraction(0)), st.fractions(0, 1, max_denominator=9)))
    return rational(centre + width if centre else centre), rational(width)


def whole_mean(kind: Covariogram, cell) -> Ball:
    """Mean over the cell; ∫ J over all axes, κ_d/(κ_{d-1} 2^{d+1}), where none is left.

    With C_k = κ_k κ_{d-1} R^{d-1} (2R)^{k+1} J and ∫ C over R^d the squared volume.
    """
    if kind.flat < kind.dim:
        return mean_over_cell(kind, cell)
    return unit_ball(kind.dim) / (unit_ball(kind.dim - 1) * 2 ** (kind.dim + 1))


def lines_add_up(kind: Covariogram, step, others, precision: int) -> None:
    """Σ_j s E J_k(tooth at j s of half-width s) = (κ_{k+1}/κ_k) E J_{k+1}: they add up to 1."""
    with flint.ctx.workprec(precision):
        total, place = flint.arb(0), flint.fmpq(0)
        while place - step < 1:
            mean = mean_over_cell(kind, [(place, step), *others])
            total += step * mean * (2 if place else 1)
            place += step
        wider = Covariogram(kind.dim, kind.flat + 1)
        ratio = unit_ball(kind.flat + 1) / unit_ball(kind.flat)
        whole = ratio * whole_mean(wider, others)
        assert total.overlaps(whole)
        assert (total - whole).rad() < flint.arb(2) ** (6 - precision)


@given(step=steps, data=st.data(), precision=st.sampled_from([53, 130]))
def test_teeth_add_up_to_a_line(step, data, precision):
    flat = data.draw(st.integers(0, 1))
    others = [data.draw(teeth()) for _ in range(1 - flat)]
    lines_add_up(Covariogram(2, flat), rational(step), others, precision)


@settings(max_examples=8)  # up to a dozen cells of twelve edges and more each
@given(step=steps, data=st.data())
def test_teeth_add_up_to_a_line_in_three_dimensions(step, data):
    flat = data.draw(st.integers(0, 2))
    others = [data.draw(teeth()) for _ in range(2 - flat)]
    lines_add_up(Covariogram(3, flat), rational(max(step, Fraction(1, 2))), others, 60)


@pytest.mark.parametrize("dim", [2, 3])
def test_a_box_that_holds_the_ball(dim):
    """Half-widths w >> 1: w^d E J tends to ∫ J dx over R^d, from below by less than d/w.

    The densities are ∏ (1 - |x_i|/w)/w, and |x_i| <= 1 where J is not 0.
    """
    kind, width = Covariogram(dim, 0), flint.fmpq(10**6)
    with flint.ctx.workprec(150):
        scaled = width**dim * mean_over_cell(kind, [(flint.fmpq(0), width)] * dim)
        lost = 1 - scaled / (unit_ball(dim) * whole_mean(Covariogram(dim, dim), ()))
        assert 0 < lost < flint.arb(dim) / width


@pytest.mark.parametrize("exponent", [8, 15, 24])
def test_needles(exponent):
    """Half-widths 1.2 and w = 10^-exponent: J falls by at most |t_2| from what a line sees."""
    width, thin = flint.fmpq(6, 5), flint.fmpq(1, 10**exponent)

    def along_line(x, analytic):
        root = (1 - x * x).sqrt(analytic=analytic)
        angle = flint.acb(0, -1) * (x + flint.acb(0, 1) * root).log(analytic=analytic)
        return (1 - x / width) * (angle - x * root)

    with flint.ctx.workprec(250):
        line = flint.acb.integral(along_line, 0, 1).real / width
        mean = mean_over_cell(Covariogram(2, 0), [(flint.fmpq(0), width), (flint.fmpq(0), thin)])
        assert 0 < line - mean < flint.arb(thin)


def test_far_cells_are_bounded_by_their_nearest_point():
    """At z >= 1 - 1e-12 J is below 1e-17; more bits tell where in the bound it lies."""
    kind, thin = Covariogram(2, 0), flint.fmpq(1, 10**12)
    cell = [(flint.fmpq(1), thin), (flint.fmpq(0), thin)]
    with flint.ctx.workprec(53):
        coarse = mean_over_cell(kind, cell)
    with flint.ctx.workprec(200):
        fine = mean_over_cell(kind, cell)
    assert coarse.overlaps(fine)
    assert coarse.contains(0)
    assert fine > 0
    assert fine.rel_accuracy_bits() > 50
