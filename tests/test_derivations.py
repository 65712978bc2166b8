"""Derivations: the paper's Eqs. 19-27, step by step, and their agreement with the rates."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.theory.decays import parse_decay
from specrate.theory.derivations import Derivation, Step, derive, document
from specrate.theory.errors import InputError
from specrate.theory.orders import Order
from specrate.theory.primitives import parse_primitive, sampled_dimension
from specrate.theory.rates import overall, region_rates
from specrate.theory.samplers import parse_sampler
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, Rational, sympy
from specrate.theory.tables import parse_dim
from strategies import catalogue_names

D, B = symbol("d"), sympy.Symbol("b", positive=True)


def steps(found: Derivation, region: str) -> dict[str, Step]:
    """The steps of a region by their equation; of several the last."""
    return {s.equation: s for s in found.steps if s.region == region}


def test_eqs_19_to_21_latin_hypercube_worst_case() -> None:
    """Corrected: the Jacobian on an axis is 1, not rho^(d-1), and Eq. 20 keeps the low piece."""
    found = steps(derive("latin-hypercube"), "axis")
    assert found["Eq. 18"].expression == (
        "N P_S ~ (pi^2/3) sum_u m_i^2 N^-2: b = 2, N_k = N, gamma/alpha^b = pi^2/3"
    )
    assert found["Eq. 16"].expression == (
        "P_f = c_f for rho < rho_0, c_f rho^-2 beyond; s = 1, p = 2, q = p - s = 1"
    )
    assert found["Eq. 19"].expression == (
        "V = (gamma/N) [int_0^rho_0 (rho/nu)^2 c_f d rho + int_rho_0^nu (rho/nu)^2 c_f rho^-2 d rho"
        " + int_nu^oo c_f rho^-2 d rho], nu = alpha N_k = sqrt(3)*N/pi"
    )
    assert "not rho^(d-1)" in found["Eq. 19"].reason
    assert found["Eq. 20"].expression == (
        "V = (1/N) [2*sqrt(3)*pi*c_f/(3*N) + pi^2*c_f*rho_0^3/(9*N^2) - pi^2*c_f*rho_0/(3*N^2)]"
    )
    assert found["Eq. 21"].expression == "V ~ (2*sqrt(3)*pi*c_f/3) N^-2"


def test_eqs_22_and_23_latin_hypercube_best_case() -> None:
    found = steps(derive("latin-hypercube", integrand="best"), "axis")
    low = [s for s in derive("latin-hypercube", integrand="best").steps if s.equation == "Eq. 22"]
    assert low[0].expression == (
        "V = (gamma/N) [int_0^rho_0 (rho/nu)^2 c_f d rho], nu = alpha N_k = sqrt(3)*N/pi"
    )
    assert found["Eq. 23"].expression == "V ~ (pi^2*c_f*rho_0^3/9) N^-3"


def sum_of(*arguments: str) -> tuple[str, str]:
    """Equation and expression of the last step."""
    last = derive(*arguments).steps[-1]
    assert last.region == "overall"
    return last.equation, last.expression


def test_eq_24() -> None:
    for integrand, axis in (("worst", "N^-2"), ("best", "N^-3")):
        assert sum_of("latin-hypercube", "d", integrand) == (
            "Eq. 24",
            f"Var(I_N) = O({axis}) [axis] + O(N^-1) [1<w<d] + O(N^-1) [generic] = O(N^-1)",
        )


def test_eq_25() -> None:
    for integrand, axis, rest in (
        ("worst", "N^-2", "N^(-1 - 1/d)"),
        ("best", "N^-3", "N^(-1 - 2/d)"),
    ):
        assert sum_of("multi-jitter", "d", integrand) == (
            "Eq. 25",
            f"Var(I_N) = O({axis}) [axis] + O({rest}) [1<w<d] + O({rest}) [generic] = O({rest})",
        )


def test_eq_26() -> None:
    name = "uncorrelated-jitter:1+2+(d-3)"
    assert sum_of(name, "d", "worst") == (
        "Eq. 26",
        "Var(I_N) = O(N^-2) [within {1}] + O(N^(-3/2)) [within {2,3}] + O(N^(-1 - 1/(d - 3))) "
        "[within {4..d}] + O(N^-1) [across] = O(N^-1)",
    )
    assert sum_of(name, "d", "best") == (
        "Eq. 26",
        "Var(I_N) = O(N^-3) [within {1}] + O(N^-2) [within {2,3}] + O(N^(-1 - 2/(d - 3))) "
        "[within {4..d}] + O(N^-1) [across] = O(N^-1)",
    )


def test_eq_26_within_the_blocks_depends_on_d() -> None:
    found = derive("uncorrelated-jitter:1+2+(d-3)", region="within")
    assert [(c.order, c.condition) for c in found.results] == [
        (Order(Rational(3, 2)), D <= 5),
        (Order(1 + 1 / (D - 3)), D >= 5),
    ]
    assert found.steps[-1].expression.endswith(
        "= O(N^(-3/2)) for d <= 5; O(N^(-1 - 1/(d - 3))) for d >= 5"
    )


def test_eq_27_line_samples_in_d_dimensions() -> None:
    """Worst N^(-d/(d-1)) for b > 1, best N^-((b+d-1)/(d-1)), for one free degree b."""
    best = derive("isotropic:b", "d", "best", primitive="line")
    assert best.steps[-1].equation == "Eq. 27"
    (case,) = best.results
    assert (
        sympy.simplify(case.order.exponent - (B + D - 1) / (D - 1)).subs(
            dict.fromkeys(case.order.exponent.free_symbols - {D}, B)
        )
        == 0
    )
    worst = derive("isotropic:3/2", "d", "worst", primitive="line")
    assert sympy.simplify(worst.results[0].order.exponent - D / (D - 1)) == 0
    for degree in (2, 3):
        found = derive(f"isotropic:{degree}", "d", "best", primitive="line").results[0].order
        assert sympy.simplify(found.exponent - (degree + D - 1) / (D - 1)) == 0


def test_table_1() -> None:
    assert derive("jitter").steps[-1].equation == "Table 1"
    for dim in (1, 2, 3):
        worst, best = derive("jitter", dim), derive("jitter", dim, "best")
        assert worst.results[0].order == Order(1 + Rational(1, dim))
        assert best.results[0].order == Order(1 + Rational(2, dim))


def test_a_tie_is_told_both_ways() -> None:
    found = [s.expression for s in derive("isotropic:b", region="axis").steps]
    (apart,) = [e for e in found if e.endswith("if b != 1")]
    (tied,) = [e for e in found if e.endswith("if b = 1")]
    assert "log(" in tied
    assert "log(" not in apart


def test_aliases_have_no_profile() -> None:
    found = derive("regular", "2").steps
    assert any("erratum to Eq. 18" in s.reason for s in found)
    assert derive("regular", "2", "best").results[0].order == Order(sympy.oo)


@given(st.data())
def test_derivations_end_where_the_rates_do(data: st.DataObject) -> None:
    dim = data.draw(st.sampled_from(["1", "2", "3", "5", "d"]))
    name = data.draw(st.sampled_from([*catalogue_names(int(dim) if dim != "d" else 3)]))
    integrand = data.draw(st.sampled_from(["worst", "best", "ball", "box", "additive", "p=99/2"]))
    primitive = data.draw(st.sampled_from(["point", "segment", "line"]))
    try:
        found = derive(name, dim, integrand, primitive=primitive)
    except InputError:
        return
    kind = parse_primitive(primitive)
    sampler = parse_sampler(name, sampled_dimension(kind, parse_dim(dim)))
    rates = region_rates(sampler, parse_decay(integrand), kind)
    assert found.results == overall(rates, sampler.layout.assumptions)
    leading = {s.region: s.expression for s in found.steps if s.equation in ("Eq. 21", "Eq. 23")}
    orders = {r.region.label: r.order for r in rates if r.order is not None}
    for region, expression in leading.items():
        if region in orders and len(leading) == len(orders):
            assert orders[region] is not None
            assert str(orders[region]).replace("Min(", "min(") in expression
    for step in found.steps:
        assert all((step.region, step.equation, step.expression, step.latex, step.reason))
        assert "**" not in step.expression


def test_the_document_is_strings() -> None:
    for arguments in (("multi-jitter",), ("isotropic:b", "d", "ball"), ("regular", "2", "best")):
        found = document(derive(*arguments))
        assert json.loads(json.dumps(found)) == found
        assert set(found) == {
            "sampler",
            "dim",
            "primitive",
            "integrand",
            "steps",
            "result",
            "cases",
        }
        for step in found["steps"]:  # type: ignore[attr-defined]
            assert all(isinstance(v, str) and v for v in step.values())
    assert document(derive("regular", "2", "best"))["result"] == {
        "exponent": "oo",
        "log_power": "0",
    }


@pytest.mark.parametrize(
    "arguments",
    [
        ("nothing",),
        ("jitter", "0"),
        ("jitter", "d", "worse"),
        ("jitter", "d", "worst", "nowhere"),
        ("jitter", "1", "worst", "overall", "line"),
    ],
)
def test_unusable_input(arguments: tuple[str, ...]) -> None:
    with pytest.raises(InputError):
        derive(*arguments)


def test_one_region_alone() -> None:
    found = derive("multi-jitter", "d", "worst", "axis")
    assert {s.region for s in found.steps} == {"axis", "overall"}
    assert found.results[0].order == Order(Integer(2))
