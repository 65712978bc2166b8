"""The sampler catalogue: its grammar, its names, and the counts at which its samplers exist."""

from math import prod

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.theory.errors import InputError
from specrate.theory.samplers import FAMILIES, FURTHER_FAMILIES, family_of, parse_sampler
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, Rational, sympy
from specrate.theory.tables import table
from strategies import every_sampler, samplers

d = symbol("d")

VALID = [
    ("random", 1),
    ("random", 12),
    ("random", d),
    ("regular", 2),
    ("regular", d),
    ("regular:25x40", 2),
    ("regular:4xN", 2),
    ("jitter", 1),
    ("jitter", 7),
    ("jitter", d),
    ("jitter", d - 1),
    ("jitter:25x40", 2),
    ("jitter:5", 1),
    ("jitter:2x3x4", 3),
    ("jitter:4xN", 2),
    ("jitter:N^1/3xN^2/3", 2),
    ("jitter:N^1/2xNxN", 3),
    ("latin-hypercube", 1),
    ("latin-hypercube", d),
    ("multi-jitter", 1),
    ("multi-jitter", 2),
    ("multi-jitter", 5),
    ("multi-jitter", d),
    ("multi-jitter:8x16", 2),
    ("correlated-multi-jitter", 2),
    ("correlated-multi-jitter:8x16", 2),
    ("uncorrelated-jitter:3", 3),
    ("uncorrelated-jitter:1+2+3", 6),
    ("uncorrelated-jitter:1+1+1", 3),
    ("uncorrelated-jitter:1+2+(d-3)", d),
    ("uncorrelated-jitter:1+(d-1)", d),
    ("uncorrelated-jitter:1+N^1/3xN^2/3", 3),
    ("box-dpp", 1),
    ("box-dpp", d),
    ("box-dpp:25x40", 2),
    ("cloaked:1/2", 1),
    ("cloaked:3/2", d),
    ("cloaked:2", 3),
    ("difference-jitter", 1),
    ("isotropic:b", 2),
    ("isotropic:b", d),
    ("isotropic:3/2", 3),
    ("isotropic:0", 3),
]

INVALID = [
    ("", 2),
    ("jitters", 2),
    ("Jitter", 2),
    ("random:2", 2),
    ("latin-hypercube:2", 2),
    ("jitter", 0),
    ("jitter", -2),
    ("jitter", Rational(5, 2)),
    ("jitter:25x40", 3),
    ("jitter:25x40", d),
    ("jitter:", 0),
    ("jitter:0x4", 2),
    ("jitter:axb", 2),
    ("jitter:²x4", 2),
    ("jitter:N^1/2xN^1/3", 2),
    ("jitter:N^dxN", 2),
    ("regular:1x2x3", 2),
    ("multi-jitter:8x16", 3),
    ("multi-jitter:8", 2),
    ("multi-jitter:8x16", d),
    ("correlated-multi-jitter", 1),
    ("correlated-multi-jitter", 3),
    ("correlated-multi-jitter", d),
    ("correlated-multi-jitter:8", 2),
    ("uncorrelated-jitter", 3),
    ("uncorrelated-jitter:", 3),
    ("uncorrelated-jitter:1+2", 4),
    ("uncorrelated-jitter:1++2", 3),
    ("uncorrelated-jitter:1+2+", 3),
    ("uncorrelated-jitter:(1+2", 3),
    ("uncorrelated-jitter:1+2)", 3),
    ("uncorrelated-jitter:0+3", 3),
    ("uncorrelated-jitter:1.5+1.5", 3),
    ("uncorrelated-jitter:1+(d-1)", 3),
    ("uncorrelated-jitter:1+x", 3),
    ("uncorrelated-jitter:1+N^1/3xN^1/3", 3),
    ("box-dpp:25x40", 3),
    ("box-dpp:x", 1),
    ("cloaked", 2),
    ("cloaked:", 2),
    ("cloaked:0", 2),
    ("cloaked:-1/2", 2),
    ("cloaked:9/4", 2),
    ("cloaked:oo", 2),
    ("cloaked:1/1000000", 2),
    ("cloaked:x", 2),
    ("difference-jitter", 2),
    ("difference-jitter", d),
    ("difference-jitter:2", 1),
    ("isotropic", 2),
    ("isotropic:", 2),
    ("isotropic:-1", 2),
    ("isotropic:x", 2),
    ("isotropic:oo", 2),
    ("isotropic:__import__('os')", 2),
]


@pytest.mark.parametrize(("text", "dim"), VALID)
def test_names_read_back_to_the_same_sampler(text, dim):
    sampler = parse_sampler(text, dim)
    assert sampler.name == text
    assert parse_sampler(sampler.name, dim) == sampler
    assert parse_sampler(sampler.name, dim).name == sampler.name
    assert sampler.dim == dim
    assert sampler.family == text.partition(":")[0]
    assert sampler.reference


@pytest.mark.parametrize(("text", "dim"), INVALID)
def test_anything_else_is_one_line_of_complaint(text, dim):
    with pytest.raises(InputError) as caught:
        parse_sampler(text, dim)
    assert "\n" not in str(caught.value)


EVERY = (*FAMILIES, *FURTHER_FAMILIES)


@given(st.sampled_from([f.name for f in EVERY]), st.text(max_size=20), st.integers(1, 4))
def test_no_text_breaks_the_parser(family, text, dim):
    try:
        sampler = parse_sampler(f"{family}:{text}", dim)
    except InputError:
        return
    assert parse_sampler(sampler.name, dim).name == sampler.name


def test_aliases_and_spaces():
    assert parse_sampler("n-rooks", 2) == parse_sampler("latin-hypercube", 2)
    assert parse_sampler(" jitter ", 2) == parse_sampler("jitter", 2)
    assert parse_sampler("uncorrelated-jitter:1 + 2", 3).dim == 3
    assert family_of("n-rooks").name == "latin-hypercube"
    assert family_of("nothing") is None
    assert parse_sampler("cloaked:0.5", 2).name == "cloaked:1/2"


def test_families_are_unique_and_their_examples_parse():
    names = [n for f in EVERY for n in (f.name, *f.aliases)]
    assert len(set(names)) == len(names)
    for family in EVERY:
        if family.example:
            dims = {"1+2+3": 6, "b": 2}
            dim = dims.get(family.example, 2)
            name = f"{family.name}:{family.example}"
            assert parse_sampler(name, dim).family == family.name


@given(every_sampler(), st.integers(1, 10**6))
def test_counts_are_whole_and_hold_n(sampler, n):
    """Every count of the kernel, at an admissible N near the one asked for."""
    if sampler.counts_at is None:
        assert sampler.family == "uncorrelated-jitter"
        return
    counts = sampler.counts_at(n)
    assert set(counts) == set(sampler.layout.growth)
    assert all(isinstance(c, int) and c >= 1 for c in counts.values())
    for name, law in sampler.layout.growth.items():
        expected = float(law.constant) * counts["N"] ** float(law.exponent)
        if not sampler.family.endswith("multi-jitter"):  # there at least 2 per axis
            assert n > 2 or sampler.family != "difference-jitter" or counts["N"] == 3
            assert counts[name] == pytest.approx(expected, rel=1e-9)
    again = sampler.counts_at(counts["N"])
    assert again == counts


@pytest.mark.parametrize(
    ("name", "dim", "asked", "expected"),
    [
        ("random", 3, 100, {"N": 100}),
        ("jitter", 2, 100, {"N": 100, "n": 10}),
        ("jitter", 2, 110, {"N": 100, "n": 10}),
        ("jitter", 2, 111, {"N": 121, "n": 11}),
        ("jitter", 3, 1, {"N": 1, "n": 1}),
        ("jitter:25x40", 2, 1000, {"N": 1000, "n1": 25, "n2": 40}),
        ("jitter:4xN", 2, 400, {"N": 400, "n1": 4, "n2": 100}),
        ("jitter:N^1/3xN^2/3", 2, 1000, {"N": 1000, "n1": 10, "n2": 100}),
        ("latin-hypercube", 2, 1, {"N": 2}),
        ("latin-hypercube", 2, 17, {"N": 17}),
        ("multi-jitter", 1, 17, {"N": 17}),
        ("multi-jitter", 3, 1000, {"N": 1000, "s": 10}),
        ("multi-jitter:8x16", 2, 128, {"N": 128, "m": 8, "n": 16}),
        ("correlated-multi-jitter", 2, 1, {"N": 4, "m": 2, "n": 2}),
        ("uncorrelated-jitter:1+2", 3, 50, {"N": 49, "n1_1": 49, "n2_1": 7}),
        ("uncorrelated-jitter:1+2", 3, 1, {"N": 4, "n1_1": 4, "n2_1": 2}),
        ("uncorrelated-jitter:2+3", 5, 700, {"N": 729, "n1_1": 27, "n2_1": 9}),
        ("box-dpp", 2, 110, {"N": 100, "n": 10}),
        ("cloaked:1/2", 3, 1000, {"N": 1000, "n": 10}),
        ("difference-jitter", 1, 1, {"N": 3}),
        ("difference-jitter", 1, 17, {"N": 17}),
    ],
)
def test_counts_near_n(name, dim, asked, expected):
    assert dict(parse_sampler(name, dim).counts_at(asked)) == expected


def test_symbolic_sizes_have_no_counts():
    assert parse_sampler("jitter", d).counts_at is None
    assert parse_sampler("uncorrelated-jitter:1+(d-1)", d).counts_at is None
    assert parse_sampler("isotropic:b", 2).counts_at is None


@given(samplers())
def test_cells_of_strata_are_n(sampler):
    if sampler.family not in ("jitter", "regular") or sampler.counts_at is None:
        return
    counts = sampler.counts_at(1000)
    names = [name for name in counts if name != "N"]
    sides = [counts[n] for n in names]
    total = sides[0] ** int(sampler.dim) if names == ["n"] else prod(sides)
    assert total == counts["N"]


def test_the_free_profile():
    sampler = parse_sampler("isotropic:3/2", 3)
    assert sampler.kernel is None
    (monomial,) = sampler.free_profile
    assert (monomial.degree, monomial.effective) == (Rational(3, 2), Rational(1, 3))
    (flat,) = parse_sampler("isotropic:0", 3).free_profile
    assert (flat.degree, flat.effective) == (0, 0)
    (free,) = parse_sampler("isotropic:b", d).free_profile
    assert (free.degree, free.effective) == (sympy.Symbol("b", positive=True), 1 / d)


@pytest.mark.parametrize(
    ("name", "dim", "worst", "best"),
    [
        ("box-dpp", "d", (1 + 1 / d, 1), (1 + 1 / d, 0)),
        ("box-dpp", 1, (2, 1), (2, 0)),
        ("cloaked:1/2", "d", (1 + 1 / (2 * d), 0), (1 + 1 / (2 * d), 0)),
        ("cloaked:1", 3, (Rational(4, 3), 1), (Rational(4, 3), 0)),
        ("cloaked:3/2", "d", (1 + 1 / d, 0), (1 + 3 / (2 * d), 0)),
        ("cloaked:2", "d", (1 + 1 / d, 0), (1 + 2 / d, 0)),
        ("difference-jitter", 1, (2, 0), (5, 0)),
    ],
)
def test_rates_of_other_degrees(name, dim, worst, best):
    """1 + e min(b, q), q = 1 for jumps, with a logarithm where b = q; e = 1/d."""
    rows = [r for r in table((name,), (dim,), ("worst", "best")).rows if r.is_overall]
    found = [(r.order.exponent, r.order.log_power) for r in rows]
    for (exponent, log), expected in zip(found, (worst, best), strict=True):
        assert (sympy.simplify(exponent - expected[0]), log) == (0, expected[1])


def test_further_families_are_in_no_default_table():
    everywhere = {r.sampler for dim in ("d", 1, 2) for r in table((), (dim,), ("best",)).rows}
    assert everywhere.isdisjoint(f.name for f in FURTHER_FAMILIES)


def test_equal_strata_are_one_sampler():
    assert parse_sampler("jitter:NxN", 2).layout == parse_sampler("jitter", 2).layout
    assert len(parse_sampler("jitter:7x7", 2).layout.groups) == 1
    assert parse_sampler("jitter:7x7", 2).counts_at(200) == {"N": 196, "n": 14}


def test_symbolic_dimensions_carry_their_range():
    assert [str(r) for r in parse_sampler("jitter", d).layout.assumptions] == ["d >= 2"]
    lines = parse_sampler("jitter", d - 1).layout.assumptions
    assert [str(r) for r in lines] == ["d >= 3"]
    assert Integer(2) == parse_sampler("uncorrelated-jitter:1+(d-1)", d).layout.assumptions[0].lower
