"""Integrand classes: their grammar, and how the energy of their shells falls."""

from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.theory.decays import Decay, parse_decay, shell_exponent
from specrate.theory.errors import InputError
from specrate.theory.regions import region_of_support, regions
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, Rational, sympy

d = symbol("d")


@pytest.mark.parametrize(
    ("text", "family", "number", "axes"),
    [
        ("worst", "worst", None, ()),
        (" best ", "best", None, ()),
        ("p=5/2", "p", Rational(5, 2), ()),
        ("p=2.5", "p", Rational(5, 2), ()),
        ("p=oo", "best", None, ()),
        ("ball", "ball", None, ()),
        ("disk:radius=0.3", "disk", None, ()),
        ("box", "box", None, ()),
        ("box:side=1/3", "box", None, ()),
        ("box:side=(1/3,1/2)", "box", None, (1, 2)),
        ("box:side=(1, 1/2, 1.0)", "box", None, (2,)),
        ("ridge:k=-3,b=1", "ridge", Integer(1), (1,)),
        ("gaussian", "gaussian", None, ()),
        ("anisotropic-gaussian", "anisotropic-gaussian", None, ()),
        ("product:k=3", "product", Integer(3), ()),
        ("product", "product", Integer(2), ()),
        ("bernoulli:k=1", "bernoulli", Integer(1), (1,)),
        ("bernoulli:k=4,axes=(1,3)", "bernoulli", Integer(4), (1, 3)),
        ("half-space", "half-space", None, (1,)),
        ("additive", "additive", None, ()),
        ("additive:k=3", "additive", Integer(3), ()),
        ("polylog", "polylog", Rational(5, 2), (1,)),
        ("polylog:p=3", "polylog", Integer(3), (1,)),
        ("ridge:k=(1,0,-2),b=3", "ridge", Integer(3), (1, 3)),
        ("chord:radius=0.3", "chord", None, ()),
    ],
)
def test_grammar(text, family, number, axes):
    found = parse_decay(text)
    assert (found.family, found.number, found.axes) == (family, number, axes)
    assert parse_decay(found.name) == found


@pytest.mark.parametrize(
    "text",
    [
        "",
        "wurst",
        "p=",
        "p=1",
        "p=1/2",
        "p=-3",
        "p=x",
        "p=2;3",
        "worst:1",
        "best:k=2",
        "additive:k=0",
        "polylog:p=1",
        "polylog:p=x",
        "polylog:k=3",
        "ridge:k=(0,0)",
        "ridge:k=(a)",
        "ridge:k=(1),b=0",
        "product:k=0",
        "product:k=-1",
        "product:k=1/2",
        "product:k=²",
        "bernoulli:axes=()",
        "bernoulli:axes=(0)",
        "bernoulli:axes=(a)",
        "bernoulli:axes=(²)",
    ],
)
def test_what_is_no_class_is_one_line_of_complaint(text):
    with pytest.raises(InputError) as caught:
        parse_decay(text)
    assert "\n" not in str(caught.value)


@given(st.text(max_size=25))
def test_no_text_breaks_the_parser(text):
    for prefix in ("", "p=", "product:k=", "bernoulli:axes=("):
        with suppress(InputError):
            assert isinstance(parse_decay(prefix + text), Decay)


@pytest.mark.parametrize(
    ("text", "dim", "support", "expected"),
    [
        ("worst", 3, (1,), 1),
        ("worst", 3, (1, 2, 3), 1),
        ("box", 3, (1, 2), 1),
        ("best", 3, (1, 2), sympy.oo),
        ("gaussian", 3, (1,), sympy.oo),
        ("ball", 3, (1,), 3),
        ("ball", 3, (1, 2), 2),
        ("ball", 3, (1, 2, 3), 1),
        ("disk", 2, (1,), 2),
        ("disk", 2, (1, 2), 1),
        ("p=4", 3, (1, 2, 3), 1),
        ("p=9/2", 3, (1,), Rational(7, 2)),
        ("product:k=1", 3, (1, 2), 1),
        ("product:k=3", 3, (1,), 5),
        ("additive", 3, (2,), 1),
        ("additive", 3, (1, 2), None),
        ("bernoulli:k=2", 3, (1,), 3),
        ("bernoulli:k=2,axes=(1,2)", 3, (1, 2), 3),
        ("bernoulli:k=2,axes=(1,2)", 3, (1,), None),
        ("additive:k=2", 3, (2,), 3),
        ("polylog:p=3", 3, (1,), 2),
        ("polylog:p=3", 3, (2,), 2),
        ("polylog:p=3", 3, (1, 2), None),
        ("ridge:k=(1,0,-2)", 3, (1, 3), 3),
        ("ridge:k=(1,0,-2)", 3, (1,), None),
        ("chord", 1, (1,), 2),
        ("chord", 2, (1,), 3),
        ("half-space", 3, (1,), 1),
        ("half-space", 3, (1, 2), None),
    ],
)
def test_shell_exponents(text, dim, support, expected):
    layout = parse_sampler("jitter", dim).layout
    assert shell_exponent(parse_decay(text), layout, region_of_support(layout, support)) == expected


def test_axes_are_those_of_the_layout():
    """In blocks 1 + 2 the axes 2 and 3 are of one kind, axis 1 of another."""
    layout = parse_sampler("uncorrelated-jitter:1+2", 3).layout
    decay = parse_decay("bernoulli:k=2,axes=(3)")
    found = {r.label: shell_exponent(decay, layout, r) for r in regions(layout)}
    assert found["within {2,3} at axis"] == 3
    assert [v for k, v in found.items() if k != "within {2,3} at axis"] == [None] * 4


def test_slices_of_a_ball_are_smoother():
    layout = parse_sampler("jitter", 2).layout
    generic = region_of_support(layout, (1, 2))
    assert [shell_exponent(parse_decay("ball"), layout, generic, flat) for flat in (0, 1, 2)] == [
        1,
        2,
        3,
    ]


def test_symbolic_dimensions():
    layout = parse_sampler("jitter", d).layout
    axis, middle, generic = regions(layout)
    ball = parse_decay("ball")
    assert shell_exponent(ball, layout, axis) == d
    assert shell_exponent(ball, layout, generic) == 1
    assert shell_exponent(ball, layout, middle) == d + 1 - middle.dimension
    assert shell_exponent(parse_decay("half-space"), layout, axis) == 1
    assert shell_exponent(parse_decay("half-space"), layout, generic) is None


@pytest.mark.parametrize(
    ("text", "dim", "support", "rule"),
    [
        ("p=2", 3, (1, 2), "p must exceed the support size"),
        ("p=2", 3, (1, 2, 3), "p must exceed the support size"),
        ("disk", 3, (1,), "a disk needs --dim 2"),
        ("bernoulli:axes=(4)", 3, (1,), "distinct coordinates in 1..3"),
        ("bernoulli:axes=(1,1)", 3, (1,), "distinct coordinates in 1..3"),
    ],
)
def test_what_does_not_fit_is_one_line_of_complaint(text, dim, support, rule):
    layout = parse_sampler("jitter", dim).layout
    region = region_of_support(layout, support)
    with pytest.raises(InputError, match=rule) as caught:
        shell_exponent(parse_decay(text), layout, region)
    assert "\n" not in str(caught.value)
