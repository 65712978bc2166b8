"""Exact spectra, orders, conditions and names spelled out."""

import math
import re
from collections.abc import Mapping

import pytest
from hypothesis import given
from hypothesis import strategies as st
from latex import check_structure
from specrate.theory.dominance import Case
from specrate.theory.orders import Order
from specrate.theory.regions import Region, region_of_support, regions, select
from specrate.theory.samplers import Sampler, parse_sampler
from specrate.theory.signs import symbol
from specrate.theory.spelling import (
    big_o,
    cases_latex,
    condition_latex,
    condition_text,
    count_names,
    expression_latex,
    expression_text,
    label_latex,
    order_latex,
    order_text,
    spectrum_latex,
    spectrum_text,
)
from specrate.theory.symbolic import Integer, Rational, sympy
from specrate.theory.tables import parse_dim
from strategies import every_sampler, supports

D, B = symbol("d"), sympy.Symbol("b", positive=True)


def region(sampler: Sampler, name: str) -> Region:
    """The last region of a name: of a block the one with all its axes."""
    return select(sampler.layout, name)[-1]


@pytest.mark.parametrize(
    ("name", "dim", "support", "text"),
    [
        ("random", "d", "generic", "1"),
        ("regular", "d", "generic", "N prod_(i in u) [n | m_i]"),
        ("jitter", "d", "axis", "1 - sinc^2(m_i/n)"),
        ("jitter", "d", "generic", "1 - prod_(i in u) sinc^2(m_i/n)"),
        ("latin-hypercube", "d", "axis", "1 - sinc^2(m_i/N)"),
        (
            "latin-hypercube",
            "d",
            "generic",
            "1 + (N - 1) prod_(i in u) [-sinc^2(m_i/N)/(N - 1)]",
        ),
        ("multi-jitter", "d", "axis", "1 - sinc^2(m_i/N)"),
        (
            "multi-jitter",
            "d",
            "generic",
            "1 + N prod_(i in u) [(sinc^2(m_i/s) - sinc^2(m_i/N))/(N - s)]"
            " - prod_(i in u) [(N sinc^2(m_i/s) - s sinc^2(m_i/N))/(N - s)]",
        ),
        ("multi-jitter:8x16", "2", "1", "1 - sinc^2(m_1/(m*n))"),
        ("correlated-multi-jitter", "2", "2", "1 - sinc^2(m_2/(m*n))"),
        ("uncorrelated-jitter:1+2", "3", "1", "1 - sinc^2(m_1/n_1)"),
        (
            "uncorrelated-jitter:1+2",
            "3",
            "within {2,3}",
            "1 - prod_(i in u & {2,3}) sinc^2(m_i/n_2)",
        ),
        (
            "uncorrelated-jitter:1+2",
            "3",
            "1,2,3",
            "1 + (1/(N - 1)) sinc^2(m_1/n_1) prod_(i in u & {2,3}) sinc^2(m_i/n_2)",
        ),
        ("uncorrelated-jitter:1+1", "2", "1,2", "1 + sinc^2(m_1/n_1) sinc^2(m_2/n_2)/(N - 1)"),
        ("box-dpp", "d", "generic", "1 - prod_(i in u) (1 - |m_i|/n)^+"),
        ("box-dpp:2x3", "2", "1,2", "1 - (1 - |m_1|/n1)^+ (1 - |m_2|/n2)^+"),
        ("cloaked:2", "1", "axis", "1 - sinc^2(m_1/n) exp(-|m_1/n|^2)"),
        (
            "cloaked:1/2",
            "d",
            "generic",
            "1 - prod_(i in u) [sinc^2(m_i/n) exp(-|m_i/n|^(1/2))]",
        ),
        (
            "difference-jitter",
            "1",
            "axis",
            "1 - [3 sinc^3(m_1/N) sinc(3 m_1/N) - 2 sinc^2(m_1/N) sinc(4 m_1/N)]",
        ),
    ],
)
def test_spectra(name: str, dim: str, support: str, text: str) -> None:
    sampler = parse_sampler(name, parse_dim(dim))
    assert spectrum_text(sampler, region(sampler, support)) == f"N P_S = {text}"


def test_latex_spectra() -> None:
    sampler = parse_sampler("multi-jitter", parse_dim("d"))
    assert spectrum_latex(sampler, region(sampler, "axis")) == (
        r"N P_S = 1 - \mathrm{sinc}^2(m_{i}/N)"
    )
    assert spectrum_latex(sampler, region(sampler, "generic")) == (
        r"N P_S = 1 + N\,\prod_{i\in u}\frac{\mathrm{sinc}^2(m_{i}/s) - \mathrm{sinc}^2(m_{i}/N)}"
        r"{N-s} - \prod_{i\in u}\frac{N\,\mathrm{sinc}^2(m_{i}/s) - s\,\mathrm{sinc}^2(m_{i}/N)}"
        r"{N-s}"
    )


def read(
    text: str, sampler: Sampler, frequency: tuple[int, ...], counts: Mapping[str, int]
) -> float:
    """N·P_S as a reader of the text computes it: an evaluator that knows nothing of kernels."""
    source = text.removeprefix("N P_S = ")
    source = re.sub(r"\[([^][|]+) \| m_(\w+)\]", r"divides(\1,m_\2)", source)
    source = re.sub(r"sinc\^2\(m_(\w+)/(\([^()]*\)|\w+)\)", r"sinc2(m_\1,\2)", source)
    source = re.sub(r"\(1 - \|m_(\w+)\|/(\w+)\)\^\+", r"tent(m_\1,\2)", source)
    source = re.sub(r"exp\(-\|m_(\w+)/(\w+)\|\^(\([\d/]+\)|\d)\)", r"stretched(m_\1,\2,\3)", source)
    source = re.sub(r"sinc\^3\(m_(\w+)/(\w+)\)", r"sinc(1,m_\1,\2)^3", source)
    source = re.sub(r"sinc\((\d) m_(\w+)/(\w+)\)", r"sinc(\1,m_\2,\3)", source)
    support = [i for i, m in enumerate(frequency, 1) if m]
    while found := re.search(r"prod_\(i in u(?: & {([^}]*)})?\) ", source):
        block = support if found.group(1) is None else _inside(found.group(1), support)
        body, end = _operand(source, found.end())
        whole = " ".join(f"({body.replace('m_i', f'm_{i}')})" for i in block)
        source = source[: found.start()] + whole + source[end:]
    source = source.replace("[", "(").replace("]", ")").replace("^", "**")
    source = re.sub(r"(?<=[\w)]) (?=[\w(])", "*", source)
    names: dict[str, object] = {f"m_{i}": m for i, m in enumerate(frequency, 1)}
    names |= {"sinc2": _sinc2, "divides": lambda n, m: float(m % n == 0)}
    names |= {"sinc": lambda k, m, n: math.sin(math.pi * k * m / n) / (math.pi * k * m / n)}
    names |= {"tent": lambda m, n: max(0.0, 1 - abs(m) / n)}
    names |= {"stretched": lambda m, n, power: math.exp(-(abs(m / n) ** power))}
    names |= _single_axes(sampler, support, frequency)
    return float(eval(source, {"__builtins__": {}}, names | dict(counts)))


def _inside(coordinates: str, support: list[int]) -> list[int]:
    first, _, last = coordinates.replace("..", ",").partition(",")
    if ".." in coordinates:
        return [i for i in support if int(first) <= i <= int(last)]
    return [i for i in support if str(i) in coordinates.split(",")]


def _operand(source: str, start: int) -> tuple[str, int]:
    """What a product sign applies to: a bracket, or one function of m_i."""
    depth = 0
    for at in range(start, len(source)):
        depth += (source[at] in "[(") - (source[at] in "])")
        if depth == 0 and source[at] in "])":
            return source[start : at + 1], at + 1
    raise AssertionError(source)


def _single_axes(
    sampler: Sampler, support: list[int], frequency: tuple[int, ...]
) -> dict[str, object]:
    """m_i for the one axis in a group; m_i, m_j, ... where several groups could be meant."""
    wide: dict[int, list[int]] = {}
    for index, group in enumerate(sampler.layout.groups):
        inside = [i for i in support if group.first <= i < group.first + group.size]
        if inside and group.size > 1:
            wide[index] = inside
    letters = {g: "i" if len(wide) == 1 else "ijklpq"[g % 6] for g in wide}
    return {f"m_{letters[g]}": frequency[x[0] - 1] for g, x in wide.items() if len(x) == 1}


def _sinc2(m: int, n: int) -> float:
    x = math.pi * m / n
    return (math.sin(x) / x) ** 2


@given(st.data())
def test_text_evaluates_to_the_spectrum(data: st.DataObject) -> None:
    sampler = data.draw(every_sampler())
    support = data.draw(supports(sampler))
    counts = (
        sampler.counts_at(data.draw(st.sampled_from([16, 100, 729])))
        if (sampler.counts_at)
        else None
    )
    if counts is None or counts["N"] < 4 or min(counts.values()) < 2 or counts["N"] > 10**12:
        return
    if sampler.family in ("multi-jitter", "latin-hypercube") and counts["N"] < 3:
        return
    dim = int(sampler.layout.dim)
    if len([g for g in sampler.layout.groups if g.size > 1]) > 6:
        return
    frequency = tuple(data.draw(st.integers(1, 40)) if i + 1 in support else 0 for i in range(dim))
    spelled = {v: counts[k] for k, v in count_names(sampler).items()}
    text = spectrum_text(sampler, region_of_support(sampler.layout, support))
    exact = kernel_value(sampler, frequency, counts)
    assert read(text, sampler, frequency, spelled) == pytest.approx(exact, rel=1e-6, abs=1e-9)


def kernel_value(sampler: Sampler, frequency: tuple[int, ...], counts: Mapping[str, int]) -> float:
    """N·P_S from the numerical room."""
    import numpy as np
    from specrate.numerics.expected_spectra.spectra import power_array

    values = power_array(sampler, counts, np.array([frequency], dtype=np.int64))
    return counts["N"] * float(values[0])


@given(every_sampler())
def test_latex_of_every_region_is_well_formed(sampler: Sampler) -> None:
    for place in regions(sampler.layout)[:20]:
        check_structure("$" + spectrum_latex(sampler, place) + "$")
        check_structure(label_latex(place.label))


@pytest.mark.parametrize(
    ("order", "text", "latex"),
    [
        (Order(1 + 2 / D), "N^(-1 - 2/d)", r"N^{-1-\frac{2}{d}}"),
        (Order(1 + 1 / (D - 3)), "N^(-1 - 1/(d - 3))", r"N^{-1-\frac{1}{d-3}}"),
        (Order(Rational(3, 2), Integer(1)), "N^(-3/2) log N", r"N^{-\frac{3}{2}}\log N"),
        (Order(1 + sympy.Min(1, B) / D), "N^(-1 - min(1, b)/d)", r"N^{-1-\frac{\min(1,b)}{d}}"),
        (Order(Integer(3)), "N^-3", "N^{-3}"),
    ],
)
def test_orders(order: Order, text: str, latex: str) -> None:
    assert order_text(order) == text
    assert order_latex(order) == latex
    assert big_o(order) == rf"\mathcal{{O}}({latex})"


def test_no_variance() -> None:
    assert big_o(Order(sympy.oo)) == "0"


def test_expressions() -> None:
    n = sympy.Symbol("N", positive=True)
    assert expression_text(n ** (1 / (D - 3))) == "N^(1/(d - 3))"
    assert expression_latex(D - 1) == "d-1"
    assert expression_latex(sympy.Min(1, B)) == r"\min(1,b)"


def test_conditions() -> None:
    assert condition_text(D >= 5) == "d >= 5"
    assert condition_text(sympy.And(D >= 3, D <= 5)) == "3 <= d <= 5"
    assert condition_latex(sympy.And(D >= 3, D <= 5)) == r"3 \le d \le 5"
    two = [Case(Order(Integer(1)), D <= 5), Case(Order(Integer(2)), D >= 5)]
    assert cases_latex(two) == (
        r"\begin{cases}\mathcal{O}(N^{-1}) & d \le 5 \\ \mathcal{O}(N^{-2}) & d \ge 5\end{cases}"
    )


@pytest.mark.parametrize(
    ("name", "latex"),
    [
        ("axis", "axis"),
        ("1<w<d", "$1<w<d$"),
        ("1<w<=d", r"$1<w\le d$"),
        ("2<=w<=4", r"$2\le w\le 4$"),
        ("w=2", "$w=2$"),
        ("1,3", r"$\{1,3\}$"),
        ("within {4..d}", r"within $\{4,\ldots,d\}$"),
        ("across 1 of {2,3},4..d", r"across $1$ of $\{2,3\}$,$4,\ldots,d$"),
        ("1<w_3<d - 3", "$1<w_3<d-3$"),
    ],
)
def test_labels(name: str, latex: str) -> None:
    assert label_latex(name) == latex
