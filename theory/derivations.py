"""Derivations: how a rate came about, step by step, with the paper's equation numbers.

Each region's steps follow the paper's Eqs. 19-23: the exact spectrum, its low-frequency profile
(Eq. 18), the integrand (Eq. 16), both put into Eq. 17, the integral in closed form, its leading
term. The last step adds the regions up as Eqs. 24-27 do. Where the paper errs the step says so.
"""

from collections.abc import Iterator
from dataclasses import dataclass

from .decays import Decay, parse_decay
from .orders import Case
from .primitives import Primitive, parse_primitive, sampled_dimension
from .profiles import SaturatingMonomial
from .radial import N, Radial, closed_form, leading
from .rates import RegionRate, overall, region_rates, saturated
from .regions import select
from .samplers import Sampler, parse_sampler
from .spelling import factor_names, spectrum_latex, spectrum_text
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
    joined = list(joined_regions(found, rates))
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
        yield Step(
            name,
            "Eq. 5" if sampler.family in ("random", "jitter") else "Eq. 5, for this sampler",
            spectrum_text(sampler, rate.region),
            spectrum_latex(sampler, rate.region),
            f"exact expected power spectrum on this region ({sampler.reference}){_laws(sampler)}",
        )
    for monomial in saturated(sampler, rate):
        if monomial.degree is sympy.oo:
            yield from _alias_steps(name, rate, monomial)
        else:
            yield _profile_step(sampler, name, rate, monomial)
            yield _integrand_step(decay, name, rate)
            yield from _integral_steps(name, rate, monomial)


def _laws(sampler: Sampler) -> str:
    """How the counts in the spectrum grow, where they are not N itself."""
    assert sampler.kernel is not None
    laws = [
        f"{name} = {law.constant * N**law.exponent}"
        for name, law in sampler.layout.growth.items()
        if name != "N"
    ]
    return f"; {', '.join(laws)}" if laws else ""


def _profile_step(
    sampler: Sampler, name: str, rate: RegionRate, monomial: SaturatingMonomial
) -> Step:
    b, e = monomial.degree, monomial.effective
    power = f"N^({e})" if e != 1 else "N"
    head = f"b = {b}, N_k = {power if e != 0 else '1'}"
    if monomial.coefficient is None:
        text = f"N P_S = gamma min(1, (rho/(alpha N_k))^b), {head}"
        latex = rf"N P_S = \gamma\min\left(1,(\rho/(\alpha N_k))^{{b}}\right),\ b={sympy.latex(b)}"
        return Step(name, "Eq. 18", text, latex, "the profile is given, not derived")
    if b == 0:
        text = f"N P_S ~ {monomial.coefficient}: b = 0, gamma = {monomial.coefficient}"
        latex = rf"N P_S \sim {sympy.latex(monomial.coefficient)}"
        return Step(name, "Eq. 18", text, latex, "flat from the lowest frequency on")
    form = " + ".join(f"({c}) {p.text(factor_names(sampler))}" for p, c in monomial.form)
    fall = sympy.expand(-e * b)
    text = f"N P_S ~ [{form}] N^({fall}): {head}, gamma/alpha^b = {monomial.coefficient}"
    latex = (
        rf"N P_S \sim {sympy.latex(monomial.coefficient)}\,\rho^{{{sympy.latex(b)}}}"
        rf"N^{{{sympy.latex(sympy.expand(-e * b))}}}"
    )
    reason = (
        "low-frequency series of the exact spectrum, a vertex of its Newton polygon; "
        "gamma/alpha^b is its mean over directions"
    )
    return Step(name, "Eq. 18", text, latex, reason)


def _integrand_step(decay: Decay, name: str, rate: RegionRate) -> Step:
    s, q = rate.region.dimension, rate.q
    if q is sympy.oo:
        text = "P_f = c_f for rho < rho_0, no power beyond"
        latex = r"P_f = c_f\ (\rho<\rho_0),\quad 0\ (\rho\ge\rho_0)"
        return Step(name, "Eq. 16", text, latex, f"{decay.name}: low frequencies decide")
    p = sympy.expand(s + q)
    text = f"P_f = c_f for rho < rho_0, c_f rho^-({p}) beyond; s = {s}, q = p - s = {q}"
    latex = rf"P_f = c_f\ (\rho<\rho_0),\quad c_f\,\rho^{{-({sympy.latex(p)})}}\ (\rho\ge\rho_0)"
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
    text = f"V = (gamma/N) [{' + '.join(_pieces(problem, best))}]"
    if problem.degree != 0:
        text += f", nu = alpha N_k = {problem.alpha * N**problem.effective}"
    yield Step(
        name,
        "Eq. 22" if best else "Eq. 19",
        text,
        _integral_latex(problem, best),
        "Eqs. 16 and 18 put into Eq. 17; the Jacobian on the region is rho^(s-1), not rho^(d-1)",
    )
    for tied, condition in _ties(problem, rate):
        found = closed_form(problem, True, tied)
        where = f" if {condition}" if condition else ""
        yield Step(
            name,
            "Eq. 22" if best else "Eq. 20",
            f"V = {found}{where}",
            rf"V = {sympy.latex(found)}",
            "the power rule on each piece"
            + ("; b = q makes the middle one a logarithm" if tied else "")
            + ", for rho_0 <= nu",
        )
    yield _leading_step(name, rate, monomial, problem)


def _pieces(problem: Radial, best: bool) -> list[str]:
    """The integrals of Eq. 17 between the breaks 0, rho_0, nu, oo, as text."""
    rho = "" if problem.dimension == 1 else f"{_raised('rho', problem.dimension - 1)} "
    falling = f" {_raised('rho', -problem.decay)}"
    if problem.degree == 0:
        whole = [f"int_0^rho_0 {rho}c_f d rho", f"int_rho_0^oo {rho}c_f{falling} d rho"]
        return whole[:1] if best else whole
    rising = _raised("(rho/nu)", problem.degree)
    low = f"int_0^rho_0 {rho}{rising} c_f d rho"
    middle = f"int_rho_0^nu {rho}{rising} c_f{falling} d rho"
    return [low] if best else [low, middle, f"int_nu^oo {rho}c_f{falling} d rho"]


def _raised(base: str, power: Expr) -> str:
    if power == 1:
        return base
    return f"{base}^{power}" if power.is_Atom and power.is_positive else f"{base}^({power})"


def _ties(problem: Radial, rate: RegionRate) -> list[tuple[bool | None, str]]:
    """Whether b = q; both ways, with their conditions, where a symbol decides."""
    gap = sympy.oo if rate.q is sympy.oo else problem.degree - rate.q
    if rate.q is sympy.oo or gap.is_number:
        return [(None, "")]
    assert rate.order is not None
    if rate.order.log_power.is_Integer:
        return [(bool(rate.order.log_power == 1), "")]
    return [(False, f"{problem.degree} != {rate.q}"), (True, f"{problem.degree} = {rate.q}")]


def _leading_step(
    name: str, rate: RegionRate, monomial: SaturatingMonomial, problem: Radial
) -> Step:
    order = monomial.order_at(rate.q, rate.region.assumptions)
    text, latex = f"V = Theta({order})", rf"V = \Theta({order.latex()})"
    if rate.q is sympy.oo or (problem.degree - rate.q).is_number:
        found = leading(problem, rate.region.assumptions)
        if found is not None:
            constant = f"({found.constant})" if found.constant.is_Add else f"{found.constant}"
            text = f"V ~ {constant} * {found.order}"
            latex = rf"V \sim {sympy.latex(found.constant)}\,{found.order.latex()}"
    reason = "leading term: exponent 1 + e min(b, q)"
    if order.log_power != 0:
        reason += ", with a logarithm at the tie b = q"
    return Step(name, "Eq. 23" if rate.q is sympy.oo else "Eq. 21", text, latex, reason)


def _integral_latex(problem: Radial, best: bool) -> str:
    b, s = sympy.latex(problem.degree), sympy.latex(problem.dimension - 1)
    low = rf"\int_0^{{\rho_0}}\rho^{{{s}}}\left(\frac{{\rho}}{{\nu}}\right)^{{{b}}}c_f\,d\rho"
    if best:
        return rf"V = \frac{{\gamma}}{{N}}{low}"
    p = sympy.latex(problem.decay)
    middle = (
        rf"\int_{{\rho_0}}^{{\nu}}\rho^{{{s}}}\left(\frac{{\rho}}{{\nu}}\right)^{{{b}}}"
        rf"\frac{{c_f}}{{\rho^{{{p}}}}}\,d\rho"
    )
    high = rf"\int_{{\nu}}^{{\infty}}\rho^{{{s}}}\frac{{c_f}}{{\rho^{{{p}}}}}\,d\rho"
    return rf"V = \frac{{\gamma}}{{N}}\left[{low}+{middle}+{high}\right]"


def _alias_steps(name: str, rate: RegionRate, step: SaturatingMonomial) -> Iterator[Step]:
    order = step.order_at(rate.q, rate.region.assumptions)
    if rate.q is sympy.oo:
        text = f"V = 0 once the first alias N^({step.effective}) lies beyond rho_0"
        latex = rf"V = 0,\quad N^{{{sympy.latex(step.effective)}}}>\rho_0"
        yield Step(name, "Eq. 22", text, latex, "a comb has no power below its first alias")
        return
    p = sympy.expand(rate.region.dimension + rate.q)
    text = f"V = sum over aliases of c_f |m|^-({p}) = Theta({order})"
    latex = (
        rf"V = \sum_{{m \in \mathrm{{aliases}}}} c_f|m|^{{-({sympy.latex(p)})}}"
        rf" = \Theta({order.latex()})"
    )
    reason = (
        f"a comb has no monomial profile (erratum to Eq. 18): below |m| = N^({step.effective}) it "
        f"is 0, above it N P_S = N^({step.plateau_exponent}) in the mean"
    )
    yield Step(name, "Eq. 17", text, latex, reason)


def latex_label(name: str) -> str:
    """A region's name for LaTeX text mode."""
    text = name.replace("{", r"\{").replace("}", r"\}")
    return text.replace("<", "$<$").replace("..", r"\ldots ")


def _sum_step(
    sampler: Sampler,
    kind: Primitive,
    joined: list[tuple[str, RegionRate]],
    results: tuple[Case, ...],
) -> Step:
    terms = [(n, r.order) for n, r in joined if r.order is not None]
    text = " + ".join(f"O({o}) [{n}]" for n, o in terms) or "0"
    latex = " + ".join(
        rf"\overbrace{{\mathcal{{O}}({o.latex()})}}^{{\text{{{latex_label(n)}}}}}" for n, o in terms
    )
    ends = "; ".join(
        f"O({c.order})" + (f" for {c.condition}" if c.condition is not None else "")
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
        f"Var = {text} = {ends}",
        rf"\mathrm{{Var}} = {latex or '0'} = "
        + r";\ ".join(rf"\mathcal{{O}}({c.order.latex()})" for c in results),
        "sum over supports; the slowest of the regions with power decides",
    )


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
