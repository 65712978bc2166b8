"""Tables: the paper's Eqs. 24-27 and Table 1 derived, and the logarithms that they miss."""

import json

import pytest
from specrate.theory.errors import InputError
from specrate.theory.expressions import parse_expression
from specrate.theory.orders import Order
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, Rational, sympy
from specrate.theory.tables import default_samplers, document, parse_dim, table

d = symbol("d")
b = sympy.Symbol("b", positive=True)
F = Rational


def rates(sampler, dim, integrand, primitive="point"):
    """Order of each row by its region."""
    found = table((sampler,), (dim,), (integrand,), primitive)
    return {r.region: r.order for r in found.rows}


def O(exponent, log=0):  # noqa: E743
    return Order(sympy.sympify(exponent), sympy.sympify(log))


def test_eq_24_worst_case():
    """Latin hypercube: N^-2 on the axes, N^-1 elsewhere and overall."""
    found = rates("latin-hypercube", "d", "worst")
    assert found == {"axis": O(2), "1<w<d": O(1), "generic": O(1), "overall": O(1)}


def test_eq_24_best_case():
    found = rates("latin-hypercube", "d", "best")
    assert found == {"axis": O(3), "1<w<d": O(1), "generic": O(1), "overall": O(1)}


def test_eq_25_worst_case():
    """Multi-jitter: N^-2 on the axes, N^(-1-1/d) elsewhere."""
    found = rates("multi-jitter", "d", "worst")
    rest = O(1 + 1 / d)
    assert found == {"axis": O(2), "1<w<d": rest, "generic": rest, "overall": rest}


def test_eq_25_best_case():
    found = rates("multi-jitter", "d", "best")
    rest = O(1 + 2 / d)
    assert found == {"axis": O(3), "1<w<d": rest, "generic": rest, "overall": rest}


def test_eq_26_worst_case():
    """Blocks 1 + 2 + (d − 3): N^-2, N^-3/2, N^(-1-1/(d-3)), and N^-1 across them."""
    assert rates("uncorrelated-jitter:1+2+(d-3)", "d", "worst") == {
        "within {1}": O(2),
        "within {2,3}": O(F(3, 2)),
        "within {4..d}": O(1 + 1 / (d - 3)),
        "across": O(1),
        "overall": O(1),
    }


def test_eq_26_best_case():
    assert rates("uncorrelated-jitter:1+2+(d-3)", "d", "best") == {
        "within {1}": O(3),
        "within {2,3}": O(2),
        "within {4..d}": O(1 + 2 / (d - 3)),
        "across": O(1),
        "overall": O(1),
    }


def test_eq_27_worst_case():
    """Lines with an isotropic profile: N^(-d/(d-1)) for b > 1; the paper leaves b <= 1 out."""
    found = rates("isotropic:b", "d", "worst", "line")["overall"]
    at_two = found.exponent.xreplace({b: Integer(2)})
    assert sympy.simplify(at_two - d / (d - 1)) == 0
    assert found.log_power.xreplace({b: Integer(2)}).doit() == 0
    at_half = found.exponent.xreplace({b: F(1, 2)})
    assert sympy.simplify(at_half - 1 - 1 / (2 * (d - 1))) == 0


def test_eq_27_best_case():
    """N^(-(b + d - 1)/(d - 1))."""
    found = rates("isotropic:b", "d", "best", "line")["overall"]
    assert sympy.simplify(found.exponent - (b + d - 1) / (d - 1)) == 0
    assert found.log_power == 0


def test_eq_27_misses_the_logarithm_at_b_1():
    found = rates("isotropic:1", 3, "worst", "line")["overall"]
    assert found == O(F(3, 2), 1)
    assert rates("isotropic:b", "d", "worst", "line")["overall"].log_power == sympy.KroneckerDelta(
        1, b
    )


@pytest.mark.parametrize(
    ("dim", "best", "worst"),
    [("d", 1 + 2 / d, 1 + 1 / d), (1, 3, 2), (2, 2, F(3, 2)), (3, F(5, 3), F(4, 3))],
)
def test_table_1(dim, best, worst):
    """Jittered points: best N^(-1-2/d), worst N^(-1-1/d), and their numbers for d = 1, 2, 3."""
    assert set(rates("jitter", dim, "best").values()) == {O(best)}
    assert set(rates("jitter", dim, "worst").values()) == {O(worst)}


def test_table_1_in_ten_dimensions():
    assert rates("jitter", 10, "best")["overall"] == O(F(6, 5))
    assert rates("jitter", 10, "worst")["overall"] == O(F(11, 10))


@pytest.mark.parametrize(
    ("sampler", "worst", "best"),
    [
        ("random", 1, 1),
        ("jitter", F(3, 2), 2),
        ("latin-hypercube", 1, 1),
        ("multi-jitter", F(3, 2), 2),
        ("correlated-multi-jitter", F(3, 2), 3),
        ("regular", 1, sympy.oo),
    ],
)
def test_rates_in_two_dimensions(sampler, worst, best):
    assert rates(sampler, 2, "worst")["overall"] == O(worst)
    assert rates(sampler, 2, "best")["overall"] == O(best)


def test_disk_along_an_axis_of_jitter_has_a_logarithm():
    """d = 2, s = 1, p = 3: q = 2 = b. The paper's Jacobian would give no logarithm."""
    assert rates("jitter", 2, "disk") == {
        "axis": O(2, 1),
        "generic": O(F(3, 2)),
        "overall": O(F(3, 2)),
    }


@pytest.mark.parametrize("dim", [3, 4, 5, 10])
def test_ball_along_an_axis_of_jitter_has_none_above_two_dimensions(dim):
    found = rates("jitter", dim, "ball")
    assert found["axis"] == O(1 + F(2, dim))
    assert found[f"w={dim - 1}"] == O(1 + F(2, dim), 1)
    assert found["overall"] == O(1 + F(1, dim))


def test_ball_in_a_symbolic_dimension_has_its_logarithms():
    found = rates("jitter", "d", "ball")
    assert found["axis"].log_power.xreplace({d: Integer(2)}).doit() == 1
    assert found["axis"].log_power.xreplace({d: Integer(3)}).doit() == 0
    assert found["generic"] == O(1 + 1 / d)


def test_disk_under_jittered_lines_is_n_to_the_minus_3_log_n():
    """The paper measures 2.85 (Sec. 7.2) for what is N^-3 log N."""
    for sampler in ("jitter", "multi-jitter", "latin-hypercube"):
        assert rates(sampler, 2, "disk", "line")["overall"] == O(3, 1), sampler


@pytest.mark.parametrize("sampler", ["jitter", "multi-jitter"])
def test_ball_under_jittered_lines_has_a_logarithm(sampler):
    """N^(-1-2/(d-1)) log N, where the paper's worst case says N^(-1-1/(d-1))."""
    assert rates(sampler, "d", "ball", "line")["overall"] == O(1 + 2 / (d - 1), 1)
    assert rates(sampler, 3, "ball", "line")["overall"] == O(2, 1)


def test_ball_under_latin_hypercube_lines():
    """Disk: N^-3 log N as above; ball in 3D: N^-1 (2D offsets that are not additive)."""
    assert rates("latin-hypercube", 3, "ball", "line")["overall"] == O(1)


def test_ball_under_planes_is_smooth():
    """2-flats in 3D: q = 3 > 2 = b on the one axis left."""
    assert rates("jitter", 3, "ball", "2-flat")["overall"] == O(3)


def test_ball_under_segments():
    assert rates("jitter", 2, "disk", "segment")["overall"] == O(2, 1)
    assert rates("jitter", 3, "ball", "segment")["overall"] == O(F(5, 3), 1)


@pytest.mark.parametrize(
    ("degree", "expected"),
    [("1/2", O(F(5, 4))), ("1", O(F(3, 2), 1)), ("2", O(F(3, 2))), ("0", O(1)), ("3", O(F(3, 2)))],
)
def test_isotropic_worst_case_by_degree(degree, expected):
    assert rates(f"isotropic:{degree}", 2, "worst")["overall"] == expected


@pytest.mark.parametrize(
    ("degree", "expected"),
    [("1/2", O(F(5, 4))), ("1", O(F(3, 2))), ("2", O(2)), ("0", O(1)), ("3", O(F(5, 2)))],
)
def test_isotropic_best_case_by_degree(degree, expected):
    assert rates(f"isotropic:{degree}", 2, "best")["overall"] == expected


def test_regular_grid_by_support_size():
    """(w + 1)/d on w axes in the worst class, 2/d overall."""
    found = rates("regular", 5, "worst")
    for w in range(1, 6):
        name = {1: "axis", 5: "generic"}.get(w, f"w={w}")
        assert found[name] == O(F(w + 1, 5))
    assert found["overall"] == O(F(2, 5))
    assert rates("regular", "d", "worst")["overall"] == O(2 / d)


def test_regular_grid_on_a_ball_and_in_the_best_case():
    assert set(rates("regular", 4, "ball").values()) == {O(F(5, 4))}
    assert rates("regular", "d", "ball")["overall"] == O(1 + 1 / d)
    assert set(rates("regular", "d", "best").values()) == {O(sympy.oo)}


def test_blocks_in_ten_dimensions():
    found = rates("uncorrelated-jitter:2+2+3+3", 10, "worst")
    assert found == {
        "within {1,2}": O(F(3, 2)),
        "within {3,4}": O(F(3, 2)),
        "within {5,6,7}": O(F(4, 3)),
        "within {8,9,10}": O(F(4, 3)),
        "across": O(1),
        "overall": O(1),
    }


def test_unequal_growth():
    """N^1/3 × N^2/3: N_k = N^1/3 on axis 1 and in the plane, N^2/3 on axis 2."""
    assert rates("jitter:N^1/3xN^2/3", 2, "worst") == {
        "1": O(F(4, 3)),
        "2": O(F(5, 3)),
        "generic": O(F(4, 3)),
        "overall": O(F(4, 3)),
    }
    assert rates("jitter:N^1/3xN^2/3", 2, "best")["overall"] == O(F(5, 3))
    assert rates("jitter:N^1/3xN^2/3", 2, "best")["2"] == O(F(7, 3))


def test_a_fixed_count_does_not_converge_faster_than_random():
    assert rates("jitter:4xN", 2, "best") == {
        "1": O(1),
        "2": O(3),
        "generic": O(1),
        "overall": O(1),
    }


def test_additive_integrands_have_the_rate_of_the_axes():
    found = table(("latin-hypercube",), (3,), ("additive",))
    assert {r.region: r.order for r in found.rows} == {"axis": O(2), "overall": O(2)}
    assert {x.region for x in found.left_out} == {"w=2", "generic"}
    assert {x.why for x in found.left_out} == {"the integrand has no power there"}


TABLES = [
    ((), ("d",), ("worst", "best", "ball"), "point"),
    ((), (1, 2, 3), ("worst", "best", "ball", "product:k=3"), "point"),
    ((), ("d", 2, 3), ("worst", "best", "ball"), "line"),
    ((), (10,), ("worst", "box", "gaussian"), "segment"),
    (("jitter:N^1/3xN^2/3", "regular:2x3"), (2,), ("worst", "best"), "point"),
]


@pytest.mark.parametrize("arguments", TABLES)
def test_rows_are_whole(arguments):
    """One overall row per sampler, dimension and class; those not dominated have its order."""
    found = table(*arguments)
    heads = {(r.sampler, r.dim, r.integrand) for r in found.rows}
    for head in heads:
        rows = [r for r in found.rows if (r.sampler, r.dim, r.integrand) == head]
        overall = [r for r in rows if r.is_overall]
        assert [r.region for r in overall] == ["overall"] * len(overall)
        assert len({r.region for r in rows}) == len(rows) - len(overall) + 1
        (only,) = overall
        top = [r for r in rows if not r.is_overall and not r.dominated]
        assert top
        assert {r.order for r in top} == {only.order}


@pytest.mark.parametrize("arguments", TABLES)
def test_document_is_of_strings_that_read_back(arguments):
    found = table(*arguments)
    whole = json.loads(json.dumps(document(found)))
    for row, entry in zip(found.rows, whole["rows"], strict=True):
        names = {"d": d, "b": b, "w": symbol("w")}
        for key in ("sampler", "dim", "primitive", "integrand", "region", "exponent", "log_power"):
            assert isinstance(entry[key], str)
        exponent = parse_expression(entry["exponent"], names)
        assert Order(exponent).exponent == row.order.exponent
        if not row.order.log_power.has(sympy.KroneckerDelta):
            assert parse_expression(entry["log_power"], names) == row.order.log_power
        assert entry["overall"] is row.is_overall
        assert entry["dominated"] is row.dominated
        assert isinstance(entry["constant"], str | None)


@pytest.mark.parametrize("dim", [1, 2, 3, 4, 12])
def test_default_samplers_fit_their_dimension(dim):
    names = default_samplers(Integer(dim))
    assert len(set(names)) == len(names)
    for name in names:
        assert parse_sampler(name, dim).dim == dim
    assert ("correlated-multi-jitter" in names) == (dim == 2)
    assert any(n.startswith("uncorrelated-jitter") for n in names) == (dim >= 4)


@pytest.mark.parametrize("text", ["0", "-1", "1.5", "x", "", "²", "d+1"])
def test_what_is_no_dimension_is_one_line_of_complaint(text):
    with pytest.raises(InputError) as caught:
        parse_dim(text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "arguments",
    [
        (("jitters",), (2,)),
        (("jitter",), ("e",)),
        (("jitter",), (2,), ("wurst",)),
        (("jitter",), (2,), ("worst",), "lines"),
        (("jitter",), (1,), ("worst",), "line"),
        (("jitter:2x3",), (3,)),
        (("jitter:2x3",), ("d",)),
        (("jitter",), (3,), ("disk",)),
        (("jitter",), (3,), ("p=2",)),
    ],
)
def test_unusable_input_is_one_line_of_complaint(arguments):
    with pytest.raises(InputError) as caught:
        table(*arguments)
    assert "\n" not in str(caught.value)
