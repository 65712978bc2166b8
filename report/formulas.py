"""Formulas: terms of the grammar of proofs laid out as fractions, scripts and large operators.

What is laid out is printed by ``formula_prints.py``. Order and signs are those of a textbook: a sum
begins with a term that is added, and ends with what has no end of its own, a Σ or a Π.
"""

from dataclasses import dataclass
from typing import Literal, TypeAlias

from ..theory.symbolic import Expr, sympy

Kind = Literal["letter", "number", "name", "prefix", "binary", "relation", "mark", "times", "space"]


@dataclass(frozen=True)
class Word:
    """A letter, number, name of a function, or sign."""

    text: str
    kind: Kind


@dataclass(frozen=True)
class Row:
    """Formulas side by side."""

    parts: tuple["Formula", ...]


@dataclass(frozen=True)
class Fraction:
    """One formula over another."""

    over: "Formula"
    under: "Formula"


@dataclass(frozen=True)
class Script:
    """A base with an index, an exponent, or both."""

    base: "Formula"
    below: "Formula | None" = None
    above: "Formula | None" = None


@dataclass(frozen=True)
class Large:
    """A large operator, ∑, ∏ or ∫, with its range."""

    sign: str
    below: "Formula"
    above: "Formula"


@dataclass(frozen=True)
class Bracket:
    """A formula in brackets."""

    body: "Formula"
    left: str = "("
    right: str = ")"


@dataclass(frozen=True)
class Root:
    """A square root."""

    body: "Formula"


Formula: TypeAlias = Word | Row | Fraction | Script | Large | Bracket | Root

TIMES, SPACE, MINUS = Word("", "times"), Word(" ", "space"), Word("−", "prefix")
_LARGE = {sympy.Sum: "∑", sympy.Product: "∏", sympy.Integral: "∫"}
GREEK: dict[str, str] = {
    "alpha": "α", "beta": "β", "gamma": "γ", "delta": "δ", "epsilon": "ε", "zeta": "ζ",
    "eta": "η", "theta": "θ", "iota": "ι", "kappa": "κ", "lambda": "λ", "mu": "μ", "nu": "ν",
    "xi": "ξ", "pi": "π", "rho": "ρ", "sigma": "σ", "tau": "τ", "upsilon": "υ", "phi": "φ",
    "chi": "χ", "psi": "ψ", "omega": "ω", "Gamma": "Γ", "Delta": "Δ", "Theta": "Θ",
    "Lambda": "Λ", "Xi": "Ξ", "Pi": "Π", "Sigma": "Σ", "Phi": "Φ", "Psi": "Ψ", "Omega": "Ω",
}  # fmt: skip
"""Names of Greek letters and the letters."""

_WIDE = 28  # nodes of a sum
_NAMES = {"besselj": "J", "gamma": "Γ", "Min": "min", "Max": "max"}


def row(*parts: Formula) -> Formula:
    """Formulas side by side, rows inside opened."""
    flat = [q for p in parts for q in (p.parts if isinstance(p, Row) else (p,))]
    return flat[0] if len(flat) == 1 else Row(tuple(flat))


def related(left: Formula, relation: str, right: Formula) -> Formula:
    """left relation right."""
    return row(left, Word(relation, "relation"), right)


def symbol(name: str) -> Formula:
    """A symbol by its name: rho_0, N_k, c2, alpha."""
    head, _, index = name.strip("_").partition("_")
    stem = head.rstrip("0123456789")
    if not index and stem and stem != head:
        head, index = stem, head[len(stem) :]
    text = GREEK.get(head, head)
    base = Word(text, "letter" if len(text) == 1 else "name")
    return Script(base, below=_index(index)) if index else base


def _index(text: str) -> Formula:
    return Word(text, "number") if text.isdigit() else symbol(text)


def term(e: Expr, flat: bool = False) -> Formula:
    """A term laid out; ``flat`` writes fractions as a/b, for exponents and arguments."""
    if e.is_Rational:
        return _rational(e, flat)
    if e == sympy.E:  # a bare e is the effective exponent
        return row(Word("exp", "name"), Bracket(Word("1", "number")))
    if e in (sympy.pi, sympy.oo, -sympy.oo):
        sign = "π" if e == sympy.pi else "∞"
        return row(MINUS, Word(sign, "letter")) if e == -sympy.oo else Word(sign, "letter")
    if e.is_Symbol:
        return symbol(e.name)
    if e.is_Add:
        return _sum(e, flat)
    if e.is_Mul or (e.is_Pow and _divides(e)):
        return _product(e, flat)
    if e.is_Pow:
        return _power(e.base, e.exp, flat)
    if isinstance(e, tuple(_LARGE)):
        return _ranged(e)
    return _applied(e, None)


def _rational(e: Expr, flat: bool) -> Formula:
    over, under = Word(str(abs(e.p)), "number"), Word(str(e.q), "number")
    size = over if e.q == 1 else _over(over, under, flat)
    return row(MINUS, size) if e.p < 0 else size


def _over(over: Formula, under: Formula, flat: bool) -> Formula:
    if not flat:
        return Fraction(over, under)
    return row(over, Word("/", "mark"), Bracket(under) if isinstance(under, Row) else under)


def _is_open(e: Expr) -> bool:
    """Whether the term ends in a Σ or Π, which would take in what follows."""
    return isinstance(e, (sympy.Sum, sympy.Product)) or (e.is_Mul and any(map(_is_open, e.args)))


def _is_negative(e: Expr) -> bool:
    return bool(e.as_coeff_Mul()[0].is_negative) or e == -sympy.oo


def _sum(e: Expr, flat: bool) -> Formula:
    terms = sorted(_in_order(e), key=_is_open)
    closed = [t for t in terms if not _is_open(t)]
    numbers = [t for t in closed if t.is_Rational]
    leads = (*(t for t in closed or terms if not _is_negative(t)), *numbers, terms[0])
    first = leads[0]
    terms.remove(first)
    parts = [term(first, flat)]
    for t in terms:
        if _is_open(first) and not _is_open(t):
            parts[-1] = Bracket(parts[-1])
        first = t
        negative = _is_negative(t)
        size = term(-t if negative else t, flat)
        parts += [Word("−" if negative else "+", "binary"), size]
    return row(*parts)


def _in_order(e: Expr) -> list[Expr]:
    """Terms in SymPy's order, which alone would work out each Σ, Π and ∫ that is a number."""
    numbers = sorted((b for b in e.atoms(*_LARGE) if not b.free_symbols), key=str)
    letters = {b: sympy.Symbol(f"~{k}") for k, b in enumerate(numbers)}
    back = {letter: b for b, letter in letters.items()}
    return [t.xreplace(back) for t in e.xreplace(letters).as_ordered_terms()]


def _divides(e: Expr) -> bool:
    """Whether a power stands below the line of a fraction: 1/N², α^−q, but not N^(−1−eq)."""
    negative = e.exp.is_Rational and e.exp < 0
    return bool(negative or (not e.exp.is_Add and not e.exp.is_Rational and _is_negative(e.exp)))


def _product(e: Expr, flat: bool) -> Formula:
    """Numerator over denominator; a Σ, Π or ∫ stands behind the fraction and not above the line."""
    number, rest = e.as_coeff_Mul()
    top, bottom = map(sympy.Integer, (abs(number.numerator), number.denominator))
    over, under, behind = [top], [bottom], list[Expr]()
    for f in sympy.Mul.make_args(rest):
        if f.is_Pow and _divides(f):
            under.append(f.base**-f.exp)
        else:
            (behind if _is_wide(f) and not flat else over).append(f)
    is_whole = all(f == 1 for f in under)
    over = over + behind if is_whole else over
    above = _side_by_side(over, flat, bracketed=flat and not is_whole)
    below = _side_by_side(under, flat)
    size = above if is_whole else _over(above, below, flat)
    if behind and not is_whole:
        size = row(size, TIMES, _side_by_side(behind, flat, bracketed=True))
    alone = rest.is_Add and bool(abs(number) == 1)
    size = Bracket(size) if alone and not isinstance(size, Bracket) else size
    return row(MINUS, size) if number < 0 else size


def _is_wide(f: Expr) -> bool:
    """Whether a factor is too wide to stand on a fraction's line."""
    if f.has(*_LARGE):
        return True
    return bool(f.is_Add) and sum(1 for _ in sympy.preorder_traversal(f)) > _WIDE


def _side_by_side(factors: list[Expr], flat: bool, bracketed: bool = False) -> Formula:
    """Factors in a row: numbers first, then symbols, powers, sums in brackets, and Σ, Π, ∫ last."""
    kept = [f for f in factors if f != 1]
    if not kept:
        return Word("1", "number")
    if len(kept) == 1 and not bracketed:
        return term(kept[0], flat)
    kept.sort(key=_place_in_product)
    parts: list[Formula] = []
    for place, f in enumerate(kept):
        is_last = place == len(kept) - 1
        after_number = place > 0 and (kept[place - 1].is_number and not kept[place - 1].args)
        if place and after_number and f.is_Rational:
            parts.append(Word("·", "binary"))
        elif place and (not after_number or f.is_Function):
            parts.append(TIMES)
        shown = term(f, flat)
        parts.append(Bracket(shown) if f.is_Add or (_is_open(f) and not is_last) else shown)
    return row(*parts)


def _place_in_product(f: Expr) -> int:
    kinds = (f.is_Rational, f.is_number, f.is_Symbol, f.is_Pow and f.base.is_Symbol)
    if any(kinds):
        return kinds.index(True)
    return 6 if isinstance(f, tuple(_LARGE)) else 5 if f.is_Add else 4


def _power(base: Expr, exponent: Expr, flat: bool) -> Formula:
    if exponent == sympy.Rational(1, 2):
        return Root(term(base, flat))
    if exponent.is_Integer and (base.is_Function and not isinstance(base, sympy.exp)):
        return _applied(base, term(exponent))
    is_plain = base.is_Symbol or (base.is_Integer and base >= 0) or base == sympy.pi
    shown = term(base, flat)
    above = term(exponent, flat=True)
    if is_plain and isinstance(shown, Script):
        return Script(shown.base, shown.below, above)
    return Script(shown if is_plain else Bracket(shown), above=above)


def _applied(e: Expr, above: Formula | None) -> Formula:
    """A function of its arguments, to a power: sin²(x), a_i², J_1(x), |x|."""
    name = str(e.func.__name__)
    if isinstance(e, sympy.Abs):
        bars = Bracket(term(e.args[0]), "|", "|")
        return Script(bars, above=above) if above else bars
    arguments, index = list(e.args), None
    if isinstance(e, sympy.besselj):
        index = term(arguments.pop(0), flat=True)
    text = _NAMES.get(name, name)
    is_sequence = isinstance(e, sympy.core.function.AppliedUndef) and all(map(_is_place, e.args))
    base = symbol(text)
    if is_sequence:
        places = _listed(arguments)
        if isinstance(base, Script):
            base, places = base.base, row(base.below or places, Word(",", "mark"), places)
        return Script(base, places, above)
    if text in ("sin", "cos", "exp", "log", "sinc", "min", "max"):
        base = Word(text, "name")
    head = Script(base, index, above) if index or above else base
    return row(head, Bracket(_listed(arguments)))


def _is_place(e: Expr) -> bool:
    """Whether an argument counts, as i, n + 1 or 3, so that it is written as an index."""
    letters = {s.name[0] for s in e.free_symbols}
    return e.is_Integer or (letters <= set("hijklmnrMN") and (e.is_Symbol or e.is_Add))


def _listed(arguments: list[Expr]) -> Formula:
    parts: list[Formula] = []
    for a in arguments:
        parts += [*([Word(",", "mark")] if parts else []), term(a, flat=True)]
    return row(*parts)


def _ranged(e: Expr) -> Formula:
    f = e.function
    if isinstance(e, sympy.Integral):
        signs = [Large("∫", term(a, True), term(b, True)) for _, a, b in reversed(e.limits)]
        ends = [p for x, *_ in e.limits for p in (SPACE, Word("d", "name"), symbol(x.name))]
        return row(*signs, _body(f), *ends)
    sign = _LARGE[type(e)]
    signs = [
        Large(sign, related(symbol(x.name), "=", term(a, True)), term(b, True))
        for x, a, b in reversed(e.limits)
    ]
    return row(*signs, _body(f))


def _body(f: Expr) -> Formula:
    return Bracket(term(f)) if f.is_Add or _is_negative(f) else term(f)


def tall(f: Formula) -> int:
    """How high brackets around it must be: 0 as a letter, 1 with scripts, 2 fractions, 3 sums."""
    match f:
        case Word():
            return 0
        case Row(parts):
            return max(map(tall, parts))
        case Fraction():
            return 2
        case Script(base, _, above):
            return max(tall(base), 1 if above else 0)
        case Large():
            return 3
        case Bracket(body) | Root(body):
            return tall(body)
