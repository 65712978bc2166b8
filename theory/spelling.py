"""Exact spectra, orders and names spelled out, as text and as LaTeX in the paper's notation."""

import re
from collections.abc import Sequence

from .dominance import Case
from .kernels import Atom, Factor, Term
from .orders import Order
from .regions import Region
from .samplers import Sampler
from .shapes import Shape
from .symbolic import Expr, FracElement, sympy

_INDICES = "ijklpq"  # of one axis each in several groups

_RELATIONS = {">=": r"\ge", "<=": r"\le", ">": ">", "<": "<", "==": "=", "!=": r"\ne"}


def expression_text(expression: Expr) -> str:
    """An expression with ``^`` for powers: ``N^(1/d)``, ``min(1, b)``."""
    return str(expression).replace("**", "^").replace("Min(", "min(")


def expression_latex(expression: Expr) -> str:
    r"""The same in LaTeX, set as tightly as in the paper: ``d-1``, ``\min(1,b)``."""
    return _tightened(sympy.latex(expression))


def order_text(order: Order) -> str:
    """``N^(-1 - 1/d)``."""
    return str(order).replace("Min(", "min(")


def order_latex(order: Order) -> str:
    r"""Body of \mathcal{O}(...): ``N^{-1-\frac{1}{d}}``."""
    return _tightened(order.latex())


def big_o(order: Order) -> str:
    r"""``\mathcal{O}(...)``, or 0 for a variance that vanishes."""
    return "0" if order.exponent is sympy.oo else rf"\mathcal{{O}}({order_latex(order)})"


def _tightened(latex: str) -> str:
    latex = re.sub(r"\\(min|max)\\left\(([^()]*?), ([^()]*?)\\right\)", r"\\\1(\2,\3)", latex)
    return re.sub(r" ([+-]) ", r"\1", latex)


def condition_text(condition: Expr) -> str:
    """A condition on one symbol: ``d >= 5``, or ``3 <= d <= 5``."""
    return " ".join(_condition(condition))


def condition_latex(condition: Expr) -> str:
    r"""The same in LaTeX."""
    words = _condition(condition)
    return " ".join(_RELATIONS.get(w, w) for w in words)


def _condition(condition: Expr) -> list[str]:
    """The words of a relation, or of two that bound one symbol from both sides."""
    parts = condition.args if isinstance(condition, sympy.And) else (condition,)
    found = [(str(p.lhs), p.rel_op, str(p.rhs)) for p in parts]
    below = [(x, rhs) for x, relation, rhs in found if relation == ">="]
    above = [(x, rhs) for x, relation, rhs in found if relation == "<="]
    if len(found) == 2 and len(below) == 1 and len(above) == 1 and below[0][0] == above[0][0]:
        return [below[0][1], "<=", below[0][0], "<=", above[0][1]]
    words: list[str] = []
    for triple in found:
        words += [*(["and"] if words else []), *triple]
    return words


def label_latex(name: str) -> str:
    """A region's name for LaTeX text mode, what is mathematical in it as mathematics."""
    name = re.sub(r" ([+-]) ", r"\1", name)
    if re.fullmatch(r"[\d,]+", name):
        return rf"$\{{{name}\}}$"
    pieces = re.split(r"(\{[^}]*\}|[\w.()+-]+(?:<=|[<=])\S+|\d[\d,.a-z]*)", name)
    return "".join(f"${_set_latex(p)}$" if i % 2 else p for i, p in enumerate(pieces))


def _set_latex(text: str) -> str:
    text = text.replace("{", r"\{").replace("}", r"\}").replace("<=", r"\le ")
    return text.replace("..", r",\ldots,")


def cases_latex(results: Sequence[Case]) -> str:
    """The order that decides, by cases where symbols decide it."""
    if len(results) == 1 and results[0].condition is None:
        return big_o(results[0].order)
    rows = [
        big_o(c.order) + (rf" & {condition_latex(c.condition)}" if c.condition is not None else "")
        for c in results
    ]
    return r"\begin{cases}" + r" \\ ".join(rows) + r"\end{cases}"


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
        if single and factor.terms:  # one axis: its constant joins the coefficient
            terms, under = _over_one_denominator(factor)
            coefficient, factor = coefficient / under, Factor(tuple(terms))
            if len(terms) == 1:
                coefficient, factor = coefficient * terms[0][0], _unit(factor)
        axis = _axis(sampler, counts, group)
        pieces.append(_product(sampler, group, factor, axis, latex))
    return _scaled(sampler, coefficient, [p for p in pieces if p], latex)


def _unit(factor: Factor) -> Factor:
    (coefficient, atom), *_ = factor.terms
    return Factor(((coefficient / coefficient, atom),))


def _scaled(sampler: Sampler, coefficient: FracElement, pieces: list[str], latex: bool) -> str:
    """coefficient · pieces, its denominator below them all: ``-sinc^2(m_1/N)/(N - 1)``."""
    expression = _tidy(sampler, coefficient)
    spell = expression_latex if latex else expression_text
    if not pieces:
        return spell(expression)
    body = (r"\," if latex else " ").join(pieces)
    over, under = sympy.fraction(expression)
    sign = "-" if over.could_extract_minus_sign() else ""
    over = -over if sign else over
    front = "" if over == 1 else _bracketed(spell(over), over) + (r"\," if latex else " ")
    if under == 1:
        return f"{sign}{front}{body}"
    if latex:
        return rf"{sign}\frac{{{front}{body}}}{{{spell(under)}}}"
    if "prod" in body:
        return f"{sign}({spell(over)}/{_bracketed(spell(under), under)}) {body}"
    return f"{sign}{front}{body}/{_bracketed(spell(under), under)}"


def _axis(sampler: Sampler, counts: tuple[Expr, ...], group: int) -> str | None:
    """Index of the one axis that a support takes from a group; None if it takes more."""
    place = sampler.layout.groups[group]
    if place.size == 1:
        return str(place.first)
    if counts[group] != 1:
        return None
    ambiguous = (
        sum(c != 0 and g.size != 1 for c, g in zip(counts, sampler.layout.groups, strict=True)) > 1
    )
    return _INDICES[group % len(_INDICES)] if ambiguous else "i"


def _product(sampler: Sampler, group: int, factor: Factor, axis: str | None, latex: bool) -> str:
    """One group's factor: on its one axis, or as a product over the axes of the support in it."""
    place = sampler.layout.groups[group]
    index = axis or "i"
    over, under = _over_one_denominator(factor)
    inside = [
        _scaled(sampler, c, [_atom(sampler, a, index, latex)] if a != Atom() else [], latex)
        for c, a in over
    ]
    body = " + ".join(inside).replace("+ -", "- ")
    below = _tidy(sampler, under)
    body = _divided(body, len(inside) > 1, below, latex)
    if body == "1":
        return ""
    single = len(inside) == 1 and sum(len(a.combs) + len(a.shapes) for _, a in over) == 1
    closed = below == 1 and single and not body.startswith("-")
    if latex:
        closed = closed or body.startswith(r"\frac")
    brackets = (r"\left[", r"\right]") if latex else ("[", "]")
    if axis is not None:
        return body if len(inside) == 1 else body.join(brackets)
    return _over_axes(sampler, place.coordinates, latex) + (body if closed else body.join(brackets))


def _over_axes(sampler: Sampler, coordinates: str, latex: bool) -> str:
    """``prod_(i in u)``, or over the part of the support u that lies in one group."""
    if len(sampler.layout.groups) == 1:
        return r"\prod_{i\in u}" if latex else "prod_(i in u) "
    block = "{" + coordinates + "}"
    return rf"\prod_{{i\in u\cap {_set_latex(block)}}}" if latex else f"prod_(i in u & {block}) "


def _over_one_denominator(
    factor: Factor,
) -> tuple[list[tuple[FracElement, Atom]], FracElement]:
    """The factor's terms times their common denominator, and that denominator."""
    (first, _), *_ = factor.terms
    common = first.denom
    for c, _ in factor.terms:
        common = common.lcm(c.denom)
    under = first.field(common)
    return [(c * under, a) for c, a in factor.terms], under


def _divided(body: str, is_sum: bool, under: Expr, latex: bool) -> str:
    if under == 1:
        return body
    if latex:
        return rf"\frac{{{body}}}{{{expression_latex(under)}}}"
    below = _bracketed(expression_text(under), under)
    return f"({body})/{below}" if is_sum else f"{body}/{below}"


def _atom(sampler: Sampler, atom: Atom, axis: str, latex: bool) -> str:
    parts: list[str] = []
    for comb in atom.combs:
        name = _spoken(sampler, comb)
        parts.append(
            rf"[{expression_latex(name)}\mid m_{{{axis}}}]" if latex else f"[{name} | m_{axis}]"
        )
    for shape, count in atom.shapes:
        name = _spoken(sampler, count)
        if latex:
            below = _bracketed(expression_latex(name), name)
            parts.append(_shape_latex(shape, f"m_{{{axis}}}", below))
        else:
            below = _bracketed(expression_text(name), name)
            parts.append(_shape_text(shape, f"m_{axis}", below))
    return (r"\," if latex else " ").join(parts) or "1"


def _shape_text(shape: Shape, m: str, n: str) -> str:
    x = f"{m}/{n}"
    match shape.kind:
        case "sinc2":
            return f"sinc^2({x})"
        case "tent":
            return f"(1 - |{m}|/{n})^+"
        case "stretched":
            power = str(shape.beta)
            return f"exp(-|{x}|^{power if power.isdigit() else f'({power})'})"
        case "difference":
            return f"[3 sinc^3({x}) sinc(3 {x}) - 2 sinc^2({x}) sinc(4 {x})]"


def _shape_latex(shape: Shape, m: str, n: str) -> str:
    x, sinc = f"{m}/{n}", r"\mathrm{sinc}"
    match shape.kind:
        case "sinc2":
            return rf"{sinc}^2({x})"
        case "tent":
            return rf"(1-|{m}|/{n})^+"
        case "stretched":
            return rf"\exp(-|{x}|^{{{shape.beta}}})"
        case "difference":
            pairs = rf"3\,{sinc}^3({x})\,{sinc}(3{x})-2\,{sinc}^2({x})\,{sinc}(4{x})"
            return rf"\left[{pairs}\right]"


def _bracketed(text: str, expression: Expr) -> str:
    return text if expression.is_Atom or expression.is_Pow else f"({text})"


def _tidy(sampler: Sampler, coefficient: FracElement) -> Expr:
    """Factored, with a denominator that does not start with a minus sign."""
    over, under = sympy.fraction(sympy.factor(_spoken(sampler, coefficient)))
    if under.could_extract_minus_sign():
        over, under = -over, -under
    return over / under


def _spoken(sampler: Sampler, element: FracElement) -> Expr:
    """A coefficient as an expression, π² and the names of counts written as such."""
    names = {sympy.Symbol(k): sympy.Symbol(v) for k, v in count_names(sampler).items()}
    return element.as_expr().xreplace({sympy.Symbol("pi2"): sympy.pi**2, **names})


def count_names(sampler: Sampler) -> dict[str, str]:
    """Counts as they are spelled: block 2's only one is ``n_2`` and not ``n2_1``."""
    growth = sampler.layout.growth
    return {
        name: name.replace("n", "n_").removesuffix("_1")
        if name.endswith("_1") and name[:-1] + "2" not in growth
        else name
        for name in growth
    }
