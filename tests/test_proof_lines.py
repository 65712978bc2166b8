"""Bounds on lines, segments and Appendices A and B, attacked at random points.

Both sides are evaluated by mpmath formulas written here, without the terms of the proofs.
"""

from typing import Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from specrate.numerics.integrands.protocol import mp

_PLAIN = st.floats(0.05, 20.0)
_SHARE = st.floats(0.01, 0.99)


def sinc2(x: float) -> float:
    return float(mp.sincpi(x) ** 2)


@given(_PLAIN, _PLAIN)
def test_mean_over_the_sphere(length: float, rho: float) -> None:
    size = mp.pi * length * rho
    assume(size > 1)
    cuts = [mp.mpf(k) / 16 for k in range(17)]

    def share(t: Any) -> Any:
        return mp.sincpi(length * rho * t) ** 2

    mean = mp.quad(share, cuts, maxdegree=4)
    assert mean <= 2 / size
    if size > 20:  # the constant is 1/2 of the true one at most: ∫ sinc² over the line is 1
        assert mean >= 1 / (2 * size)


@given(_PLAIN, _PLAIN, _SHARE)
def test_no_weights_are_better_than_inverse_variances(v1: float, v2: float, w: float) -> None:
    least = v1 * v2 / (v1 + v2)
    assert least <= (w * w * v1 + (1 - w) ** 2 * v2) * (1 + 1e-12)
    best = v2 / (v1 + v2)
    assert best**2 * v1 + (1 - best) ** 2 * v2 == pytest.approx(least)


@given(_SHARE, st.integers(2, 10**6))
def test_random_directions_keep_their_variance(p: float, n: int) -> None:
    power = p * p * (1 - sinc2(1 / n)) / n + p * (1 - p) / n
    assert p * (1 - p) / n * (1 - 1e-9) <= power <= p / n * (1 + 1e-9)


@given(st.integers(2, 10**6))
def test_parallel_lines_fall_as_the_cube(n: int) -> None:
    with mp.workdps(40):
        power = (1 - mp.sincpi(mp.mpf(1) / n) ** 2) / n
        assert mp.pi**2 / (3 + mp.pi**2) <= power * n**3 <= mp.pi**2 / 3


@given(st.integers(1, 3), st.tuples(*[st.integers(1, 40)] * 3), st.floats(1.0, 1e6))
def test_jitter_lies_between_its_monomial_and_its_share(
    dimension: int, modes: tuple[int, ...], n: float
) -> None:
    scaled = [m / n ** (1 / dimension) for m in modes[:dimension]]
    with mp.workdps(30):
        power = 1 - mp.fprod(mp.sincpi(x) ** 2 for x in scaled)
        level = mp.pi**2 / 3 * mp.fsum(mp.mpf(x) ** 2 for x in scaled)
        slack = mp.mpf(10) ** -20
        assert level / (1 + level) - slack <= power <= level + slack


def _ray_power(n: int, modes: tuple[int, int, int]) -> float:
    share = sinc2(modes[0] / n) * sinc2(modes[1] / n) * sinc2(modes[2] / n)
    return (1 - share) / n**3 / sum(m * m for m in modes) ** 2


@given(st.integers(1, 60), st.tuples(*[st.integers(1, 9)] * 3), st.integers(1, 60))
def test_rays_fall_faster_than_the_whole(n: int, k: tuple[int, int, int], terms: int) -> None:
    on_ray = sum(_ray_power(n, (j * k[0], j * k[1], j * k[2])) for j in range(1, terms + 1))
    assert on_ray <= 2 * float(mp.pi) ** 2 / (3 * sum(m * m for m in k) * n**5)


@pytest.mark.parametrize("n", [1, 2, 4, 6])
def test_the_whole_is_bounded_from_below(n: int) -> None:
    ends = range(1, 2 * n + 1)
    whole = sum(_ray_power(n, (a, b, c)) for a in ends for b in ends for c in ends)
    assert whole >= 1 / (288 * n**4)


@given(_SHARE, _SHARE, st.floats(0.1, 3), st.floats(0.1, 3))
def test_the_least_product_decides(b1: float, b2: float, e1: float, e2: float) -> None:
    """Local slopes of two worst-case regions, all else 1, at N = exp(4000)."""
    assume(abs(e1 * b1 - e2 * b2) > 0.02 and max(b1, b2) < 0.9)

    def total(log_n: float) -> float:
        def one(b: float, e: float) -> float:
            nu = mp.exp(e * log_n)
            inner = nu**-b * (1 / mp.mpf(1 + b) + (1 - nu ** (b - 1)) / (1 - b))
            return mp.exp(-log_n) * (inner + 1 / nu)

        return mp.log(one(b1, e1) + one(b2, e2))

    slope = (total(4400.0) - total(4000.0)) / 400
    assert slope == pytest.approx(-1 - min(e1 * b1, e2 * b2), abs=1e-3)
