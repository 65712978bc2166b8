"""Derivations: how a rate came about, step by step, with the paper's equation numbers.

Each region's steps follow the paper's Eqs. 19-23: the exact spectrum, its low-frequency profile
(Eq. 18), the integrand (Eq. 16), both put into Eq. 17, the integral in closed form, its leading
term. The last step adds the regions up as Eqs. 24-27 do. Where the paper errs the step says so.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass

from .decays import Decay, parse_decay
from .dominance import Case
from .integrals import integral_latex, integral_text, raised, raised_latex
from .orders import Order
from .primitives import Primitive, parse_primitive, sampled_dimension
from .profiles import SaturatingMonomial
from .radial import N, Radial, closed_form, leading
from .rates import RegionRate, overall, region_rates, saturated
from .regions import select
from .samplers import Sampler, parse_sampler
from .spelling import (
    big_o,
    cases_latex,
    condition_text,
    count_names,
    expression_latex,
    expression_text,
    factor_names,
    label_latex,
    order_latex,
    order_text,
    spectrum_latex,
    spectrum_text,
)
from .symbolic import Expr, Integer, sympy
from .tables import joined_regions, parse_dim

_SUMMARY = {
    "latin-hypercube": "Eq. 24",
    "multi-jitter": "Eq. 25",
    "uncorrelated-jitter": "Eq. 26",
    "jitter": "Table 1",
}


@dataclass(frozen=True)
class Step:
    """One step: an expression, and the reason why it holds.

    ``equation`` is the paper's equation that the step carries out or corrects.
    """

    region: str
    equation: str
    expression: str
    latex: str
    reason: str


@dataclass(frozen=True)
class Derivation:
    """The steps that lead to a sampler's rate for a class of integrands."""

    sampler: str
    dim: str
    primitive: str
    integrand: str
    steps: tuple[Step, ...]
    results: tuple[Case, ...]


def derive(
    sampler: str,
    dim: str | int = "d",
    integrand: str = "worst",
    region: str = "overall",
    primitive: str = "point",
) -> Derivation:
    """Derive the rate of a sampler, step by step.

    Parameters
    ----------
    sampler, integrand, region, primitive : str
        In their grammars.
    dim : str or int
        A number, or ``"d"``.

    Raises
    ------
    InputError
        If a text is outside its grammar, or the region does not exist.
    """
    kind, decay = parse_primitive(primitive), parse_decay(integrand)
    whole = parse_dim(dim)
    found = parse_sampler(sampler, sampled_dimension(kind, whole))
    chosen = {r.counts for r in select(found.layout, region)}
    rates = tuple(r for r in region_rates(found, decay, kind) if r.region.counts in chosen)
    joined = [(name, members[-1]) for name, members in joined_regions(found, rates)]
    steps: list[Step] = []
    for name, rate in joined:
        steps += _region_steps(found, decay, name, rate)
    results = _results(found, rates, region)
    steps.append(_sum_step(found, kind, joined, results))
    return Derivation(found.name, str(whole), kind.name, decay.name, tuple(steps), results)


def _results(sampler: Sampler, rates: tuple[RegionRate, ...], region: str) -> tuple[Case, ...]:
    """Overall order of the chosen regions; regions of one name count with their own symbols."""
    powered = [r for r in rates if r.order is not None]
    lasting = [r for r in powered if r.region.assumptions == sampler.layout.assumptions]
    if powered and not lasting:  # a region such as 1 < w < d alone, under its own assumptions
        return overall(tuple(powered), powered[0].region.assumptions)
    return overall(rates, sampler.layout.assumptions)


def _region_steps(sampler: Sampler, decay: Decay, name: str, rate: RegionRate) -> Iterator[Step]:
    if sampler.kernel is not None:
        spectrum = spectrum_text(sampler, rate.region)
        yield Step(
            name,
            "Eq. 5" if sampler.family in ("random", "jitter") else "Eq. 5, for this sampler",
            spectrum,
            spectrum_latex(sampler, rate.region),
            "exact expected power spectrum on this region "
            f"({sampler.reference}){_laws(sampler, spectrum)}",
        )
    for monomial in saturated(sampler, rate):
        if monomial.degree is sympy.oo:
            yield from _alias_steps(decay, name, rate, monomial)
        else:
            yield _profile_step(sampler, name, rate, monomial)
            yield _integrand_step(decay, name, rate)
            yield from _integral_steps(name, rate, monomial)


def _laws(sampler: Sampler, spectrum: str) -> str:
    """How the counts that stand in the spectrum grow, where they are not N itself."""
    spelled = count_names(sampler)
    words = set(re.findall(r"\w+", spectrum))
    laws = [
        f"{spelled[name]} = {expression_text(law.constant * N**law.exponent)}"
        for name, law in sampler.layout.growth.items()
        if name != "N" and spelled[name] in words
    ]
    return f"; {', '.join(laws)}" if laws else ""


def _profile_step(
    sampler: Sampler, name: str, rate: RegionRate, monomial: SaturatingMonomial
) -> Step:
    b, e = monomial.degree, monomial.effective
    head = f"b = {b}, N_k = {expression_text(N**e)}"
    head_latex = rf"b={expression_latex(b)},\ N_k={expression_latex(N**e)}"
    if monomial.coefficient is None:
        free = f"b free, N_k = {expression_text(N**e)}" if b.is_Symbol else head
        text = f"N P_S = gamma min(1, (rho/(alpha N_k))^{b}), {free}"
        saturating = rf"\left(\frac{{\rho}}{{\alpha N_k}}\right)^{{{expression_latex(b)}}}"
        latex = (
            rf"N P_S = \gamma\min\left(1,{saturating}\right),"
            rf"\quad N_k={expression_latex(N**e)}"
        )
        return Step(name, "Eq. 18", text, latex, "the profile is given, not derived")
    constant = expression_text(monomial.coefficient)
    if b == 0:
        text = f"N P_S ~ {constant}: b = 0, gamma = {constant}"
        latex = rf"N P_S \sim {expression_latex(monomial.coefficient)},\quad b=0"
        return Step(name, "Eq. 18", text, latex, "flat from the lowest frequency on")
    names = factor_names(sampler)
    form = " + ".join(f"{_factor(c)} {p.text(names)}" for p, c in monomial.form)
    if len(monomial.form) > 1:
        form = f"[{form}]"
    fall = Order(sympy.expand(e * b))
    text = f"N P_S ~ {form} {order_text(fall)}: {head}, gamma/alpha^b = {constant}"
    latex = (
        rf"N P_S \sim {expression_latex(monomial.coefficient)}\,\rho^{{{expression_latex(b)}}}"
        rf"{order_latex(fall)},\quad {head_latex}"
    )
    reason = (
        "low-frequency series of the exact spectrum, a vertex of its Newton polygon; "
        "gamma/alpha^b is its mean over directions"
    )
    return Step(name, "Eq. 18", text, latex, reason)


def _factor(constant: Expr) -> str:
    return f"({expression_text(constant)})"


def _integrand_step(decay: Decay, name: str, rate: RegionRate) -> Step:
    s, q = rate.region.dimension, rate.q
    if q is sympy.oo:
        text = "P_f = c_f for rho < rho_0, no power beyond"
        latex = r"P_f = c_f\ (\rho<\rho_0),\quad 0\ (\rho\ge\rho_0)"
        return Step(name, "Eq. 16", text, latex, f"{decay.name}: low frequencies decide")
    p = sympy.expand(s + q)
    fall = raised("rho", -p)
    text = f"P_f = c_f for rho < rho_0, c_f {fall} beyond; s = {s}, p = {p}, q = p - s = {q}"
    latex = rf"P_f = c_f\ (\rho<\rho_0),\quad c_f\,{raised_latex(-p)}\ (\rho\ge\rho_0)"
    reason = f"{decay.name} on a region of dimension s: shells [rho, 2 rho) hold energy rho^-q"
    if s != 1 and decay.family == "worst":
        reason += " (p = s + 1 on the region)"
    return Step(name, "Eq. 16", text, latex, reason)


def _problem(rate: RegionRate, monomial: SaturatingMonomial) -> Radial:
    s = rate.region.dimension
    p = sympy.oo if rate.q is sympy.oo else s + rate.q
    known = monomial.coefficient is not None
    gamma = monomial.plateau if known else sympy.Symbol("gamma", positive=True)
    alpha = (monomial.alpha or Integer(1)) if known else sympy.Symbol("alpha", positive=True)
    return Radial(monomial.degree, s, p, monomial.effective, gamma, alpha)


def _integral_steps(name: str, rate: RegionRate, monomial: SaturatingMonomial) -> Iterator[Step]:
    problem = _problem(rate, monomial)
    best = rate.q is sympy.oo
    text = integral_text(problem, best)
    if problem.degree != 0:
        text += f", nu = alpha N_k = {expression_text(problem.alpha * N**problem.effective)}"
    yield Step(
        name,
        "Eq. 22" if best else "Eq. 19",
        text,
        integral_latex(problem, best),
        "Eqs. 16 and 18 put into Eq. 17; the Jacobian on the region is rho^(s-1), not rho^(d-1)",
    )
    for tied, sides in _ties(problem, rate):
        found = closed_form(problem, True, tied)
        relation = ("=", "=") if tied else ("!=", r"\ne ")
        inside = found * N / problem.gamma
        front = rf"\frac{{{expression_latex(problem.gamma)}}}{{N}}"
        text = f"V = ({expression_text(problem.gamma)}/N) [{expression_text(inside)}]"
        latex = rf"V = {front}\left[{expression_latex(inside)}\right]"
        if sides:
            degree, q = sides
            text += f" if {expression_text(degree)} {relation[0]} {expression_text(q)}"
            latex += rf"\quad({expression_latex(degree)}{relation[1]}{expression_latex(q)})"
        reason = "the power rule on each piece"
        if tied:
            reason += "; b = q makes the middle one a logarithm"
        if problem.degree != 0:
            reason += ", for rho_0 <= nu"
        yield Step(name, "Eq. 22" if best else "Eq. 20", text, latex, reason)
    yield _leading_step(name, rate, monomial, problem)


def _ties(problem: Radial, rate: RegionRate) -> list[tuple[bool | None, tuple[Expr, Expr] | None]]:
    """Whether b = q; both ways, with the sides b and q, where a symbol decides."""
    gap = sympy.oo if rate.q is sympy.oo else problem.degree - rate.q
    if rate.q is sympy.oo or gap.is_number:
        return [(None if rate.q is sympy.oo or gap != 0 else True, None)]
    assert rate.order is not None
    if rate.order.log_power.is_Integer:
        return [(bool(rate.order.log_power == 1), None)]
    sides = (problem.degree, rate.q)
    return [(False, sides), (True, sides)]


def _leading_step(
    name: str, rate: RegionRate, monomial: SaturatingMonomial, problem: Radial
) -> Step:
    order = monomial.order_at(rate.q, rate.region.assumptions)
    text, latex = f"V = Theta({order_text(order)})", rf"V = \Theta({order_latex(order)})"
    if rate.q is sympy.oo or (problem.degree - rate.q).is_number:
        found = leading(problem, rate.region.assumptions)
        if found is not None:
            bracket = found.constant.is_Add
            constant, constant_latex = _factor(found.constant), expression_latex(found.constant)
            text = f"V ~ {constant} {order_text(found.order)}"
            if bracket:
                constant_latex = rf"\left({constant_latex}\right)"
            latex = rf"V \sim {constant_latex}\,{order_latex(found.order)}"
    reason = "leading term: exponent 1 + e min(b, q), with N_k = N^e"
    if order.log_power != 0:
        reason += ", and a logarithm at the tie b = q"
    return Step(name, "Eq. 23" if rate.q is sympy.oo else "Eq. 21", text, latex, reason)


def _alias_steps(
    decay: Decay, name: str, rate: RegionRate, step: SaturatingMonomial
) -> Iterator[Step]:
    order = step.order_at(rate.q, rate.region.assumptions, decay.is_product)
    first = expression_text(step.scale * N**step.effective)
    if rate.q is sympy.oo:
        text = f"V = 0 once the first alias {first} lies beyond rho_0"
        latex = rf"V = 0,\quad {expression_latex(step.scale * N**step.effective)}>\rho_0"
        yield Step(name, "Eq. 22", text, latex, "a comb has no power below its first alias")
        return
    fall, fall_latex = _fall(decay, rate)
    text = f"V = sum over aliases m of c_f {fall} = Theta({order_text(order)})"
    latex = (
        rf"V = \sum_{{m \in \mathrm{{aliases}}}} c_f\,{fall_latex}"
        rf" = \Theta({order_latex(order)})"
    )
    reason = (
        f"a comb has no monomial profile (erratum to Eq. 18): it is 0 below the first alias {first}"
        f", above it N P_S is of order {expression_text(N**step.plateau_exponent)} in the mean"
    )
    yield Step(name, "Eq. 17", text, latex, reason)


def _fall(decay: Decay, rate: RegionRate) -> tuple[str, str]:
    """How the integrand's power falls with m, as text and LaTeX."""
    assert rate.q is not None
    if decay.is_product:
        power = -(rate.q + 1)
        return f"prod_i {raised('|m_i|', power)}", rf"\prod_i|m_i|^{{{expression_latex(power)}}}"
    p = sympy.expand(rate.region.dimension + rate.q)
    return raised("|m|", -p), rf"|m|^{{{expression_latex(-p)}}}"


def _sum_step(
    sampler: Sampler,
    kind: Primitive,
    joined: list[tuple[str, RegionRate]],
    results: tuple[Case, ...],
) -> Step:
    terms = [(n, r.order) for n, r in joined if r.order is not None]
    text = " + ".join(f"{_big_o_text(o)} [{n}]" for n, o in terms) or "0"
    latex = " + ".join(rf"\overbrace{{{big_o(o)}}}^{{\text{{{label_latex(n)}}}}}" for n, o in terms)
    ends = "; ".join(
        _big_o_text(c.order)
        + (f" for {condition_text(c.condition)}" if c.condition is not None else "")
        for c in results
    )
    equation = (
        "Eq. 27"
        if kind.flat and sampler.family == "isotropic"
        else _SUMMARY.get(sampler.family, "Eq. 9")
    )
    return Step(
        "overall",
        equation,
        f"Var(I_N) = {text} = {ends}",
        rf"\mathrm{{Var}}(I_N) = {latex or '0'} = {cases_latex(results)}",
        "sum over supports; the slowest of the regions with power decides",
    )


def _big_o_text(order: Order) -> str:
    return "0" if order.exponent is sympy.oo else f"O({order_text(order)})"


def document(found: Derivation) -> dict[str, object]:
    """The derivation as the JSON document of the command line."""
    top = found.results[0].order
    cases = [
        {
            "condition": None if c.condition is None else str(c.condition),
            "exponent": str(c.order.exponent),
            "log_power": str(c.order.log_power),
        }
        for c in found.results
    ]
    return {
        "sampler": found.sampler,
        "dim": found.dim,
        "primitive": found.primitive,
        "integrand": found.integrand,
        "steps": [
            {
                "region": s.region,
                "equation": s.equation,
                "expression": s.expression,
                "latex": s.latex,
                "reason": s.reason,
            }
            for s in found.steps
        ],
        "result": {"exponent": str(top.exponent), "log_power": str(top.log_power)},
        "cases": cases,
    }


__all__ = ["Derivation", "Step", "derive", "document"]
