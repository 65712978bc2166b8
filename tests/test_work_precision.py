"""Work and precision: what is measured, in which order, and what the budget leaves out."""

import json
from typing import Any

import numpy as np
import pytest
from specrate.numerics.measuring.moments import Interval
from specrate.numerics.method_tests.stress import Outcome, is_honest, relative_errors
from specrate.numerics.method_tests.work_precision import work_precision
from specrate.numerics.method_tests.work_precision_ladders import (
    DISK,
    EQ_17,
    PROBLEMS,
    REPETITIONS,
    Ladder,
    ladders,
)

TRUTHS = {p.name: p.truth(120) for p in PROBLEMS}
LADDERS = {(x.problem, x.method): x for x in ladders(0)}
DETERMINISTIC = {k: x for k, x in LADDERS.items() if x.method != "Monte Carlo"}


@pytest.fixture(scope="module")
def short() -> dict[str, Any]:
    """A budget that is spent at once: of everything the first."""
    told: list[str] = []
    return work_precision(1e-9, 3, told.append) | {"told": told}


def test_a_spent_budget_leaves_out_the_rest_and_says_so(short):
    (point,), (ratio,) = short["points"], short["ratios"]
    steps = sum(len(x["steps"]) for x in short["plan"]["ladders"])
    assert len(short["left_out"]) == 16 + steps - 2
    assert {x["why"] for x in short["left_out"]} == {"the budget was spent"}
    assert (point["problem"], point["method"]) == (EQ_17, "closed form, balls")
    assert (ratio["degree"], ratio["dim"], ratio["digits"], ratio["n"]) == ("1/2", 1, 50, "1e30")
    assert len(short["told"]) == 2


def test_the_plan_tells_what_was_run(short):
    plan = short["plan"]
    assert (plan["seed"], plan["budget"]) == (3, 1e-9)
    assert {"python", "specrate", "mpmath", "python-flint", "numpy", "scipy"} == set(
        plan["versions"]
    )
    assert {(x["problem"], x["method"]) for x in plan["ladders"]} == set(LADDERS)
    json.dumps(short, allow_nan=False)


def test_ratios_are_ratios(short):
    (r,) = short["ratios"]
    assert r["closed_ratio"] == r["mpmath_seconds"] / r["closed_seconds"]
    assert r["quadrature_ratio"] == r["mpmath_seconds"] / r["quadrature_seconds"]


def test_the_problems_are_what_they_are_called():
    """N·V = 2 ν^-1 − 3/4 ν^-2 of Eq. 17 with b = 2, q = 1, c = ρ0 = 1; the disk by quadrature."""
    nu, n = 1000, 10**6
    assert float(TRUTHS[EQ_17]) == pytest.approx((2 / nu - 3 / 4 / nu**2) / n, rel=1e-15)
    assert float(TRUTHS[DISK]) * 10**6 == pytest.approx(0.2606946923819862, rel=1e-12)


def answer(ladder: Ladder, step: Any) -> Outcome:
    found = ladder.read(ladder.call(step))
    assert not isinstance(found, Interval)
    return found


@pytest.mark.parametrize("key", DETERMINISTIC, ids=", ".join)
def test_ladders_climb_and_are_honest(key):
    """A later step is more exact, until rounding: no parameter is without effect."""
    ladder = DETERMINISTIC[key]
    truth = TRUTHS[ladder.problem]
    early, late = ladder.steps[0], ladder.steps[min(3, len(ladder.steps) - 1)]
    first, last = answer(ladder, early), answer(ladder, late)
    for outcome in (first, last):
        assert is_honest(outcome, truth)
    reported = [relative_errors(x, truth)[1] or 0.0 for x in (first, last)]
    assert reported[1] < reported[0] or len(ladder.steps) == 1
    if ladder.parameter == "digits":
        assert (relative_errors(last, truth)[0] or 0.0) < 10.0**-late


def test_the_steps_of_every_ladder_rise():
    for x in LADDERS.values():
        if x.parameter == "tolerance":
            assert list(x.steps) == sorted(x.steps, reverse=True)
        elif len(x.steps) > 1:
            assert list(x.steps) == sorted(x.steps)


def test_monte_carlo_estimates_the_variance_that_is_certified():
    """16 × 16 realisations: the mean of 256 squared errors is within a factor 2 of the truth.

    For normal errors chi^2 with 256 degrees of freedom leaves (1/2, 2) with probability below
    1e-12. The variance of independent points is 60 times as large.
    """
    ladder = LADDERS[DISK, "Monte Carlo"]
    variances = ladder.call(16)
    assert variances.shape == (REPETITIONS,)
    assert 0.5 < np.mean(variances) / float(TRUTHS[DISK]) < 2
    interval = ladder.read(variances)
    assert isinstance(interval, Interval)
    rms = np.sqrt(np.mean((variances / float(TRUTHS[DISK]) - 1) ** 2))
    assert interval.estimate == pytest.approx(rms)
    assert interval.low < interval.estimate < interval.high


def test_monte_carlo_depends_on_the_seed_alone():
    again, other = (
        next(x for x in ladders(seed) if x.method == "Monte Carlo").call(4) for seed in (0, 1)
    )
    assert (LADDERS[DISK, "Monte Carlo"].call(4) == again).all()
    assert (again != other).all()
