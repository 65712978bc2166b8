"""Quadrature over the sphere: moments of directions, spherical means, honest errors."""

from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.equation17.densities import density_of, expanded
from specrate.numerics.equation17.sphere_rules import (
    refined,
    require_nodes,
    shell_mean,
    sphere_area,
    sphere_rule,
)
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler

sides = st.floats(-3, 3).map(lambda t: 10**t)


@pytest.mark.parametrize(("dim", "area"), [(1, 2), (2, 2 * pi), (3, 4 * pi), (4, 2 * pi**2)])
def test_areas(dim, area):
    assert sphere_area(dim) == pytest.approx(area, rel=1e-15)


@given(st.lists(sides, min_size=1, max_size=3))
def test_even_moments_of_directions(box):
    """E 1 = 1, E e_i² = 1/d, E e_i² e_j² = (1 + 2[i = j])/(d(d + 2)), whatever the box."""
    dim = len(box)
    e, weights = sphere_rule(box, 56)  # 40 leave 5e-9 for sides 1e6 : 1
    weights = weights / sphere_area(dim)
    assert np.all(e >= 0)
    assert np.allclose(np.linalg.norm(e, axis=1), 1, atol=1e-14)
    assert weights.sum() == pytest.approx(1, rel=1e-9)
    squares = e**2
    assert np.allclose(weights @ squares, 1 / dim, atol=1e-9)
    fourth = np.einsum("k,ki,kj->ij", weights, squares, squares)
    assert np.allclose(fourth, (1 + 2 * np.eye(dim)) / (dim * (dim + 2)), atol=1e-9)


@pytest.mark.parametrize("box", [(1.0, 4.0), (2.0, 1.0, 5.0)])
def test_edges_of_faces_are_on_axes_and_diagonals(box):
    """max(e_i/a_i) has ridges where faces meet: this box is exact, another one is not."""

    def change(sides):
        rules = (sphere_rule(sides, order) for order in (12, 24))
        coarse, fine = (float(w @ (e / np.array(box)).max(axis=1)) for e, w in rules)
        return abs(coarse / fine - 1)

    assert change(box) < 1e-8
    assert change((1.0,) * len(box)) > 1e-5


def test_spherical_mean_of_jitter():
    """d = 2: 1 − E J_0(2πρ|Δ|) over the difference Δ of two points of a cell."""
    from scipy.special import j0

    sampler = parse_sampler("jitter", 2)
    whole = expanded(density_of(sampler, {"N": 16, "n": 4}))
    rho = np.array([0.1, 1.0, 3.7, 9.0])
    x, w = np.polynomial.legendre.leggauss(40)
    t, w = (x + 1) / 2, w * (1 - (x + 1) / 2)  # density 2(1 − t) on (0, 1), half the rule's weight
    distance = np.hypot(t[:, None], t[None, :]) / 4
    expected = [1 - float(w @ j0(2 * pi * r * distance) @ w) for r in rho]
    assert np.allclose(shell_mean(whole, rho, 60), expected, rtol=1e-10)


def test_spherical_mean_of_random_points_is_one():
    whole = expanded(density_of(parse_sampler("random", 3), {"N": 5}))
    assert np.allclose(shell_mean(whole, np.array([0.0, 2.0]), 5), 1)


@pytest.mark.parametrize("power", [1.5, 2.5, 4.0])
def test_the_error_is_not_too_small(power):
    """A rule that converges as order^-p, and one that does at once."""
    found = refined(lambda order: 1 + order**-power, 1.0, 1e-4)
    assert abs(found.value - 1) <= found.error * 3
    exact = refined(lambda _: 1.0, 1.0, 1e-13)
    assert exact.value == 1
    assert 0 < exact.error < 2e-13


def test_agreement_by_chance_is_not_believed():
    values = {4: 0.0, 6: 1.0, 9: 1.0, 13: 1.2, 19: 1.1, 28: 1.1, 40: 1.1}
    assert refined(values.__getitem__, 1.0, 1e-3).value == pytest.approx(1.1)


def test_too_many_nodes_are_refused():
    with pytest.raises(InputError, match="at most 1500000 nodes: got 2000000"):
        require_nodes(2 * 10**6)
