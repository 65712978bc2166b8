"""Chords of a ball: values, mean, power and its sum, all from the chord length alone."""

from fractions import Fraction
from math import pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.integrands.chord import Chord
from specrate.theory.errors import InputError

radii = st.fractions(Fraction(1, 100), Fraction(49, 100), max_denominator=100)


@given(radius=radii, x=st.floats(0, 1, exclude_max=True))
def test_values(radius, x):
    """(f/2)² + |x - c|² = R² where the line meets the ball."""
    f, r = Chord(2, radius), float(radius)
    value = float(f(np.array([x, 0.5])))
    if abs(x - 0.5) < r:
        assert (value / 2) ** 2 + (x - 0.5) ** 2 == pytest.approx(r**2, rel=1e-12)
    else:
        assert value == 0


def chord_coefficient(radius: float, m: int) -> float:
    """∫ 2 √(R² - x²) cos(2π m x) dx, x = R sin t, by the trapezoidal rule, exact to rounding."""
    t = np.arange(4000) * pi / 4000
    return (
        float(np.mean(2 * (radius * np.sin(t)) ** 2 * np.cos(2 * pi * m * radius * np.cos(t)))) * pi
    )


@given(radius=radii, m=st.integers(0, 300))
def test_power_on_the_line(radius, m):
    found = Chord(1, radius).coefficient_power(np.array([[m]]))
    wanted = chord_coefficient(float(radius), m) ** 2
    assert found[0] == pytest.approx(wanted, rel=1e-10, abs=1e-15 * float(radius) ** 4)


@given(radius=radii)
def test_mean(radius):
    """The area of the disk and the volume of the ball."""
    r = float(radius)
    assert float(Chord(1, radius).mean(17)) == pytest.approx(pi * r**2, rel=1e-15)
    assert float(Chord(2, radius).mean(17)) == pytest.approx(4 * pi / 3 * r**3, rel=1e-15)


@given(radius=radii)
def test_total(radius):
    """∫ f² = 16 R³/3 on the line, 2π R⁴ in the plane, less the squared mean."""
    r = float(radius)
    line = 16 * r**3 / 3 - (pi * r**2) ** 2
    plane = 2 * pi * r**4 - (4 * pi / 3 * r**3) ** 2
    assert float(Chord(1, radius).total(17)) == pytest.approx(line, rel=1e-14)
    assert float(Chord(2, radius).total(17)) == pytest.approx(plane, rel=1e-14)


@pytest.mark.parametrize("dim", [1, 2])
def test_power_adds_up_to_the_total(dim):
    """|fhat|² <= R^d/(2π² ρ^(d+2)) × 2 beyond the box, up to the envelope's 1 %."""
    f, half = Chord(dim, Fraction(3, 10)), {1: 2000, 2: 200}[dim]
    axis = np.arange(-half, half + 1)
    m = np.stack(np.meshgrid(*[axis] * dim, indexing="ij"), axis=-1).reshape(-1, dim)
    energy = float(f.coefficient_power(m[(m != 0).any(axis=1)]).sum())
    shells = {1: 2.0, 2: 2 * pi}[dim]
    tail = 1.01 * 0.3**dim / pi**2 * shells * half**-2.0 / 2
    total = float(f.total(17))
    assert total - tail < energy < total + 1e-13


@given(radius=radii, dim=st.integers(1, 3))
def test_value_semantics(radius, dim):
    f = Chord(dim, radius)
    assert f == Chord(dim, radius)
    assert hash(f) == hash(Chord(dim, radius))
    assert f.parts == ()
    assert f.mean(30).overlaps(f.mean(10))


@pytest.mark.parametrize(("dim", "radius"), [(0, "1/4"), (1, "0"), (1, "1/2"), (2, "-1/4")])
def test_refused(dim, radius):
    with pytest.raises(InputError, match="must satisfy"):
        Chord(dim, Fraction(radius))
