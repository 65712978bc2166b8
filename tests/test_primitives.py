"""Primitives: points, parallel flats and segments, and what they do to the decay."""

import pytest
from specrate.theory.decays import parse_decay
from specrate.theory.errors import InputError
from specrate.theory.primitives import Primitive, parse_primitive, sampled_dimension, shells
from specrate.theory.regions import region_of_support
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, sympy

d = symbol("d")


@pytest.mark.parametrize(
    ("text", "name", "flat"),
    [
        ("point", "point", 0),
        (" line ", "line", 1),
        ("segment", "segment", 0),
        ("1-flat", "line", 1),
        ("2-flat", "2-flat", 2),
        ("11-flat", "11-flat", 11),
    ],
)
def test_grammar(text, name, flat):
    found = parse_primitive(text)
    assert found == Primitive(name, flat)
    assert parse_primitive(found.name) == found


@pytest.mark.parametrize(
    "text", ["", "points", "0-flat", "-flat", "x-flat", "²-flat", "flat", "2flat"]
)
def test_what_is_no_primitive_is_one_line_of_complaint(text):
    with pytest.raises(InputError, match="a primitive is point, line") as caught:
        parse_primitive(text)
    assert "\n" not in str(caught.value)


def test_flats_leave_fewer_dimensions():
    assert sampled_dimension(parse_primitive("line"), Integer(3)) == 2
    assert sampled_dimension(parse_primitive("3-flat"), d) == d - 3
    assert sampled_dimension(parse_primitive("segment"), Integer(3)) == 3
    with pytest.raises(InputError, match="line needs --dim above 1: got 1"):
        sampled_dimension(parse_primitive("line"), Integer(1))


@pytest.mark.parametrize(
    ("primitive", "decay", "support", "expected"),
    [
        ("point", "ball", (1, 2), 1),
        ("line", "ball", (1, 2), 2),
        ("2-flat", "ball", (1, 2), 3),
        ("segment", "ball", (1, 2), 2),
        ("line", "ball", (1,), 3),
        ("segment", "ball", (1,), 2),
        ("line", "worst", (1, 2), 1),
        ("segment", "worst", (1, 2), 1),
        ("2-flat", "worst", (1,), 1),
        ("line", "best", (1,), sympy.oo),
        ("segment", "best", (1, 2), sympy.oo),
    ],
)
def test_curved_bodies_gain_smoothness_and_faces_do_not(primitive, decay, support, expected):
    """Sampled in two dimensions: q = k + 1 on the whole slice of a ball, 1 in the worst class."""
    layout = parse_sampler("jitter", 2).layout
    region = region_of_support(layout, support)
    assert shells(parse_primitive(primitive), parse_decay(decay), layout, region) == expected
