"""docs/equation17.md: its tables are those of the program, its statements hold."""

from fractions import Fraction
from math import log, pi
from pathlib import Path

import numpy as np
import pytest
from specrate.numerics.equation17.readings import (
    INTEGRANDS,
    SAMPLERS,
    axis_row,
    latin_hypercube_by_directions,
    reading,
    tables,
)
from specrate.numerics.equation17.space_integrands import SpaceGaussian
from specrate.numerics.exact_variances.variances import exact_variance
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.theory.samplers import parse_sampler

PAGE = Path(__file__).parents[1] / "docs" / "equation17.md"
GAUSSIAN = SpaceGaussian((Fraction(1, 10),) * 2)


def test_the_page_has_the_tables_of_the_program():
    text = PAGE.read_text(encoding="utf-8")
    found = list(tables())
    assert len(found) == 3
    for table in found:
        assert table in text
    lines = [line for line in text.splitlines() if line.startswith("| ") and "---" not in line]
    assert len(lines) == sum(len(t.splitlines()) - 1 for t in found) + 4  # and the routes


@pytest.mark.parametrize("integrand", INTEGRANDS)
@pytest.mark.parametrize("sampler", SAMPLERS)
def test_only_jitter_is_as_printed(sampler, integrand):
    row = reading(sampler, integrand, 16)
    assert row.total == pytest.approx(row.integral - row.at_zero + row.null_sets, rel=1e-12)
    differs = abs(row.total / row.integral - 1) > 0.02 if row.integral else row.total > 1e-4
    assert differs == (sampler != "jitter")
    on_null_sets = abs(row.null_sets) > 1e-8
    assert on_null_sets == (sampler not in ("random", "jitter"))


def test_the_sum_over_directions_tends_to_the_integral():
    """The four half-axes have the weight 2π/m each: their error falls as 1/m, not to the truth."""
    row = reading("latin-hypercube", INTEGRANDS[0], 16)
    gaps = [row.integral - latin_hypercube_by_directions(GAUSSIAN, 16, m) for m in (64, 256, 1024)]
    assert gaps[0] / gaps[1] == pytest.approx(4, rel=1e-3)
    assert gaps[1] / gaps[2] == pytest.approx(4, rel=1e-3)
    said = f"tends to the integral {row.integral:.7f}, not to the variance {row.total:.7f}"
    assert said in " ".join(PAGE.read_text(encoding="utf-8").split())


@pytest.mark.parametrize("strata", [4, 9, 40])
def test_one_axis_is_the_sum_over_its_frequencies(strata):
    """N·Var of n jittered lines, and what 2D jitter has on one axis."""
    from scipy.special import jv

    a = np.arange(1, 300_000)
    power = (0.25 * jv(1, 2 * pi * 0.25 * a) / a) ** 2
    total = 2 * float(np.sum((1 - np.sinc(a / strata) ** 2) * power))
    assert total == pytest.approx(float(axis_row(Fraction(1, 4), strata).line), rel=2e-5)


def test_the_whole_is_the_exact_variance():
    row = axis_row(Fraction(1, 4), 16)
    sampler, disk = parse_sampler("jitter", 2), parse_integrand("disk:radius=1/4", 2)
    exact = exact_variance(sampler, {"N": 256, "n": 16}, disk).value * 256
    assert float(row.whole) == pytest.approx(float(exact), rel=1e-5)


@pytest.mark.parametrize("direction", [(1, 0), (1, 1), (2, 1)])
def test_no_rational_direction_has_the_rate_of_their_sum(direction):
    """Σ_j over (j, j)..: N² V grows as (R/(6|k|)) ln N, the slope between n = 256 and 1024."""
    from scipy.special import jv

    j = np.arange(1, 100_000)
    length = float(np.hypot(*direction))
    power = (0.25 * jv(1, 2 * pi * 0.25 * j * length) / (j * length)) ** 2
    scaled = []
    for n in (256, 1024):
        kept = np.prod([np.sinc(k * j / n) ** 2 for k in direction], axis=0)
        scaled.append(n**2 * 2 * float(np.sum((1 - kept) * power)))
    slope = (scaled[1] - scaled[0]) / log(16)
    assert slope == pytest.approx(0.25 / (6 * length), rel=2e-3)
