"""Exact spectra on one region spelled out, as text and LaTeX."""

from .kernels import Atom, Factor, Term
from .regions import Region
from .samplers import Sampler
from .symbolic import Expr, FracElement, sympy


def factor_names(sampler: Sampler) -> tuple[str, ...]:
    """A subscript for sums over each group: its coordinates, ``u`` where there is one group."""
    groups = sampler.layout.groups
    return ("u",) if len(groups) == 1 else tuple(f"{{{g.coordinates}}}" for g in groups)


def spectrum_text(sampler: Sampler, region: Region) -> str:
    """``N P_S = 1 - prod_{i in u} sinc^2(m_i/n)``."""
    return "N P_S = " + _spelled(sampler, region, latex=False)


def spectrum_latex(sampler: Sampler, region: Region) -> str:
    """The same in LaTeX."""
    return "N P_S = " + _spelled(sampler, region, latex=True)


def _spelled(sampler: Sampler, region: Region, latex: bool) -> str:
    assert sampler.kernel is not None
    terms = _joined_on_axis(sampler.kernel.restrict(region.counts), region)
    parts = [_term(sampler, t, region.counts, latex) for t in terms]
    text = " + ".join(p for p in parts if p) or "0"
    return text.replace("+ -", "- ")


def _joined_on_axis(terms: tuple[Term, ...], region: Region) -> tuple[Term, ...]:
    """On a single axis all terms are one factor, in which much cancels."""
    if region.dimension != 1:
        return terms
    one = terms[0].coefficient / terms[0].coefficient
    total = Factor(())
    for t in terms:
        factor = t.factors[0][1] if t.factors else Factor(((one, Atom()),))
        total = total + factor.scaled(t.coefficient)
    group = next(i for i, c in enumerate(region.counts) if c == 1)
    ordered = sorted(total.terms, key=lambda term: term[1] != Atom())
    return tuple(Term(c, ((group, Factor(((one, a),))),)) for c, a in ordered)


def _term(sampler: Sampler, term: Term, counts: tuple[Expr, ...], latex: bool) -> str:
    coefficient, pieces = term.coefficient, list[str]()
    for group, factor in term.factors:
        single = counts[group] == 1
        if len(factor.terms) == 1 and single:  # one axis: its constant joins the coefficient
            coefficient, factor = coefficient * factor.terms[0][0], _unit(factor)
        pieces.append(_product(sampler, group, factor, single, latex))
    written = [p for p in pieces if p]
    expression = _tidy(coefficient)
    if not written:
        return sympy.latex(expression) if latex else str(expression)
    joint = r"\," if latex else " "
    body = joint.join(written)
    if expression in (1, -1):
        return body if expression == 1 else f"-{body}"
    front = sympy.latex(expression) if latex else str(expression)
    return f"{front}{joint}{body}" if expression.is_Atom else f"({front}){joint}{body}"


def _unit(factor: Factor) -> Factor:
    (coefficient, atom), *_ = factor.terms
    return Factor(((coefficient / coefficient, atom),))


def _product(sampler: Sampler, group: int, factor: Factor, single: bool, latex: bool) -> str:
    """One group's factor: on its one axis, or as a product over the axes of the support in it."""
    place = sampler.layout.groups[group]
    axis = str(place.first) if place.size == 1 else "i"
    inside = [_weighted(c, a, axis, latex) for c, a in factor.terms]
    body = " + ".join(inside).replace("+ -", "- ")
    if len(inside) > 1:
        body = rf"\left[{body}\right]" if latex else f"[{body}]"
    if body == "1" or single or place.size == 1:
        return "" if body == "1" else body
    domain = "u" if len(sampler.layout.groups) == 1 else f"u & {{{place.coordinates}}}"
    if latex:
        where = "u" if domain == "u" else rf"u\cap\{{{place.coordinates}\}}"
        return rf"\prod_{{i\in {where}}}{body}"
    return f"prod_(i in {domain}) {body}"


def _weighted(coefficient: FracElement, atom: Atom, axis: str, latex: bool) -> str:
    expression = _tidy(coefficient)
    body = _atom(atom, axis, latex)
    if expression == 1:
        return body
    if expression == -1:
        return f"-{body}"
    front = sympy.latex(expression) if latex else str(expression)
    if body == "1":
        return front
    if latex:
        return rf"{front}\,{body}"
    return f"{front} {body}" if expression.is_Atom else f"({front}) {body}"


def _atom(atom: Atom, axis: str, latex: bool) -> str:
    parts: list[str] = []
    for comb in atom.combs:
        name = _spoken(comb)
        parts.append(
            rf"[{sympy.latex(name)}\mid m_{{{axis}}}]" if latex else f"[{name} | m_{axis}]"
        )
    for count in atom.sincs:
        name = _spoken(count)
        if latex:
            parts.append(rf"\mathrm{{sinc}}^2(m_{{{axis}}}/{_bracketed(sympy.latex(name), name)})")
        else:
            parts.append(f"sinc^2(m_{axis}/{_bracketed(str(name), name)})")
    return (r"\," if latex else " ").join(parts) or "1"


def _bracketed(text: str, expression: Expr) -> str:
    return text if expression.is_Atom else f"({text})"


def _tidy(coefficient: FracElement) -> Expr:
    """Factored, with a denominator that does not start with a minus sign."""
    over, under = sympy.fraction(sympy.factor(_spoken(coefficient)))
    if under.could_extract_minus_sign():
        over, under = -over, -under
    return over / under


def _spoken(element: FracElement) -> Expr:
    """A coefficient as an expression, π² written as such."""
    return element.as_expr().xreplace({sympy.Symbol("pi2"): sympy.pi**2})
