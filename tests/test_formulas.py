"""Formulas laid out and printed: what a reader computes from the print is the term's value."""

import re
from collections.abc import Callable
from typing import Any
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.integrands.protocol import mp
from specrate.report.formula_prints import latex, mathml, plain
from specrate.report.formulas import related, symbol, term
from specrate.theory.symbolic import sympy

from tests.latex import check_structure

x, y, N, c2, rho = sympy.symbols("x y N c_2 rho_0", real=True)
i, j, n = sympy.symbols("i j n", real=True)
a = sympy.Function("a")
VALUES = {"x": "7/10", "y": "13/10", "N": "3", "c₂": "2/5", "ρ₀": "21/10"}
_TOKEN = re.compile(r"\d+|[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+|sin|cos|exp|log|c₂|ρ₀|[A-Za-zπ]|[−+·/^()√|]")
_PLAIN = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")
_FUNCTIONS = {"sin": mp.sin, "cos": mp.cos, "exp": mp.exp, "log": mp.log, "√": mp.sqrt}


class Reader:
    """What a reader takes a printed term for: products and quotients from left to right."""

    def __init__(self, text: str) -> None:
        assert re.sub(_TOKEN, "", text).strip() == ""
        self.tokens = _TOKEN.findall(text)
        self.place = 0
        self.ends = "+−)"  # what ends a product

    @property
    def next(self) -> str:
        return self.tokens[self.place] if self.place < len(self.tokens) else ""

    def take(self) -> str:
        self.place += 1
        return self.tokens[self.place - 1]

    def sum(self) -> Any:
        total = self.product()
        while self.next in ("+", "−"):
            total += self.product() if self.take() == "+" else -self.product()
        return total

    def product(self) -> Any:
        if self.next == "−":
            self.take()
            return -self.product()
        total = self.power()
        while self.next and self.next not in self.ends:
            if self.next == "/":
                self.take()
                total /= self.power()
            else:
                self.take() if self.next == "·" else None
                total *= self.power()
        return total

    def power(self) -> Any:
        token = self.take()
        if token in _FUNCTIONS:
            above = self.exponent()
            assert self.next == "("
            return _FUNCTIONS[token](self.atom(self.take())) ** above
        value = self.atom(token)
        return value ** self.exponent()

    def exponent(self) -> Any:
        if self.next and self.next[0] in "⁰¹²³⁴⁵⁶⁷⁸⁹⁻":
            return mp.mpf(self.take().translate(_PLAIN))
        if self.next == "^":
            self.take()
            return self.atom(self.take())
        return mp.mpf(1)

    def atom(self, token: str) -> Any:
        if token in ("(", "|"):
            before, self.ends = self.ends, "+−)" + "|" * (token == "|")
            value = self.sum()
            assert self.take() == {"(": ")", "|": "|"}[token]
            self.ends = before
            return abs(value) if token == "|" else value
        if token == "π":
            return +mp.pi
        over, _, under = VALUES.get(token, token).partition("/")
        return mp.mpf(over) / mp.mpf(under or 1)


def _joined(make: Callable[..., Any]) -> Callable[[list[Any]], Any]:
    return lambda parts: make(*parts)


LEAVES = st.one_of(
    st.sampled_from([x, y, N, c2, rho, sympy.pi]),
    st.fractions(-5, 5, max_denominator=6).map(
        lambda q: sympy.Rational(q.numerator, q.denominator)
    ),
)
TERMS = st.recursive(
    LEAVES,
    lambda inner: st.one_of(
        st.lists(inner, min_size=2, max_size=3).map(_joined(sympy.Add)),
        st.lists(inner, min_size=2, max_size=4).map(_joined(sympy.Mul)),
        st.tuples(inner, st.integers(-3, 4)).map(lambda p: p[0] ** p[1] if p[0] != 0 else p[0]),
        st.tuples(st.sampled_from([x, N, rho]), LEAVES).map(lambda p: p[0] ** p[1]),
        inner.map(sympy.sin),
        inner.map(lambda e: sympy.exp(-(e**2))),
        inner.map(lambda e: sympy.sqrt(1 + e**2)),
        LEAVES.map(lambda e: sympy.Abs(e - 2)),
    ),
    max_leaves=7,
)


@given(TERMS)
def test_the_print_says_what_the_term_is(e: Any) -> None:
    names = {x: "x", y: "y", N: "N", c2: "c₂", rho: "ρ₀"}
    value = e.xreplace({s: sympy.Rational(VALUES[name]) for s, name in names.items()}).evalf(40)
    if not value.is_Float:
        return  # undefined, or not a real number
    read = Reader(plain(term(e)))
    with mp.workdps(60):
        assert abs(read.sum() - mp.mpf(str(value))) <= mp.mpf(10) ** -30 * (1 + abs(value))
    assert read.next == ""


@given(TERMS)
def test_latex_and_mathml_are_well_formed(e: Any) -> None:
    f = related(term(e), "≤", term(e + 1))
    check_structure(f"${latex(f)}$")
    assert not set(latex(f)) - set(map(chr, range(32, 127)))
    for display in (False, True):
        ElementTree.fromstring(f"<p>{mathml(f, display)}</p>")


EXAMPLES = {
    "1 − x²": 1 - x**2,
    "−x − y": -x - y,
    "−(x + y)": -(x + y) if (-(x + y)).is_Mul else sympy.Mul(-1, x + y, evaluate=False),
    "N^(−1 − x)": N ** (-1 - x),
    "1/N³": N**-3,
    "1/N^x": N**-x,
    "π²/3 ∑_{i=1}^n a_i²": sympy.pi**2 / 3 * sympy.Sum(a(i) ** 2, (i, 1, n)),
    "1 − ∏_{i=1}^n a_i": 1 - sympy.Product(a(i), (i, 1, n)),
    "∑_{i=1}^n (1 − a_i)": sympy.Sum(1 - a(i), (i, 1, n)),
    "(∑_{i=1}^n a_i)²": sympy.Sum(a(i), (i, 1, n)) ** 2,
    "−N + ∑_{i=1}^n a_i": sympy.Sum(a(i), (i, 1, n)) - N,
    "∏_{i=1}^n (−a_i)": sympy.Product(-a(i), (i, 1, n)),
    "∑_{j=1}^n ∑_{i=0}^∞ x^i y^j": sympy.Sum(x**i * y**j, (i, 0, sympy.oo), (j, 1, n)),
    "∫_0^N ρ₀² dρ₀": sympy.Integral(rho**2, (rho, 0, N)),
    "∫_0^1 (x + 1) dx": sympy.Integral(1 + x, (x, 0, 1)),
    "a_{n+1}": a(n + 1),
    "a(x)": a(x),
    "sin²(πx/N)": sympy.sin(sympy.pi * x / N) ** 2,
    "cos((N + 1)/x)": sympy.cos((1 + N) / x),
    "2 sin(x)": 2 * sympy.sin(x),
    "J_{1/2}(x)": sympy.besselj(sympy.Rational(1, 2), x),
    "min(1, x)": sympy.Min(1, x),
    "|x|": sympy.Abs(x),
    "Γ(x)": sympy.gamma(x),
    "√(N)": sympy.sqrt(N),
}


@pytest.mark.parametrize(("text", "e"), EXAMPLES.items(), ids=list(EXAMPLES))
def test_terms_are_printed_as_in_a_textbook(text: str, e: Any) -> None:
    assert plain(term(e)) == text


def test_symbols_are_split_into_letter_and_index() -> None:
    names = {"rho_0": "ρ₀", "N_k": "N_k", "c2": "c₂", "alpha": "α", "w": "w", "b_max": "b_{max}"}
    assert {name: plain(symbol(name)) for name in names} == names
    assert latex(symbol("rho_0")) == r"\rho _{0}"


def test_a_fraction_in_latex_and_mathml() -> None:
    f = term((1 + x) / N)
    assert latex(f) == r"\frac{x+1}{N}"
    assert "<mfrac>" in mathml(f)
    assert mathml(related(f, "=", f)).count("<math>") == 2
