"""Integrands on R^d: made from torus integrands, with checked parameters."""

from fractions import Fraction

import pytest
from specrate.numerics.equation17.space_integrands import SpaceBall, SpaceGaussian, on_space
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.theory.errors import InputError

F = Fraction


@pytest.mark.parametrize(
    ("text", "dim", "expected"),
    [
        ("disk:radius=0.3", 2, SpaceBall(2, F(3, 10))),
        ("ball:radius=1/4", 3, SpaceBall(3, F(1, 4))),
        ("gaussian:sigma=0.1", 2, SpaceGaussian((F(1, 10),) * 2)),
        ("anisotropic-gaussian:sigma=(0.1,0.5)", 2, SpaceGaussian((F(1, 10), F(1, 2)))),
    ],
)
def test_the_function_of_which_the_torus_has_the_sum(text, dim, expected):
    found = on_space(parse_integrand(text, dim))
    assert found == expected
    assert found.dim == dim


def test_isotropic_is_told_from_anisotropic():
    assert SpaceGaussian((F(1), F(1))).is_isotropic
    assert not SpaceGaussian((F(1), F(2))).is_isotropic


@pytest.mark.parametrize("text", ["bernoulli:k=2", "box:side=0.3", "product:k=2"])
def test_others_are_refused(text):
    with pytest.raises(InputError, match="must be a ball or a gaussian: got"):
        on_space(parse_integrand(text, 2))


@pytest.mark.parametrize(
    ("build", "rule"),
    [
        (lambda: SpaceBall(0, F(1)), "1 <= dim: got 0"),
        (lambda: SpaceBall(2, F(0)), "0 < radius: got 0"),
        (lambda: SpaceGaussian(()), "1 <= dim: got 0"),
        (lambda: SpaceGaussian((F(1), F(-1))), "0 < sigma: got -1"),
    ],
)
def test_parameters_have_ranges(build, rule):
    with pytest.raises(InputError, match=rule):
        build()
