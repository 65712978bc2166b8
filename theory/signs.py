"""Signs of exact expressions over a range of their symbols.

Orders of convergence are compared by the sign of a difference of exponents such as
3/2 − (1 + 1/(d − 3)). Here the sign is decided only where it can be proved: every symbol is
written as its lower bound plus t ≥ 0, and a rational function whose numerator and denominator
have coefficients of one sign only is of that sign. Where this does not decide and there is one
integer symbol, finitely many values are tried one by one and the rest by the same rule.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

from .symbolic import Expr, FracElement, FracField, Integer, Symbol, sympy

Sign = Literal["-", "<=0", "0", ">=0", "+"] | None
"""A proved sign: negative, not positive, zero, not negative, positive; None is undecided."""

_TRIED = 24  # integer values looked at singly before the coefficient rule takes the rest


@dataclass(frozen=True)
class Range:
    """``symbol >= lower``; the bound may use the symbols of ranges that stand before it."""

    symbol: Symbol
    lower: Expr
    integer: bool = True

    def __str__(self) -> str:
        return f"{self.symbol} {'>=' if self.integer else '>'} {self.lower}"


Assumptions = tuple[Range, ...]
"""What a layout knows of its symbols, as d >= 4 for blocks 1 + 2 + (d - 3)."""


def symbol(name: str) -> Symbol:
    """A positive integer of the theory: a dimension, a block size, a support size."""
    return sympy.Symbol(name, integer=True, positive=True)


def at_least(size: Expr, lower: Expr | int) -> Range:
    """``size >= lower`` as a range of the one symbol in a size such as d - 3."""
    (free,) = size.free_symbols
    return Range(free, sympy.expand(lower - (size - free)))


def nonnegative(expression: Expr, assumptions: Assumptions = ()) -> bool | None:
    """Whether the expression is proved >= 0 (True), proved < 0 (False), or neither (None)."""
    sign = sign_of(expression, assumptions)
    if sign in ("0", ">=0", "+"):
        return True
    return False if sign == "-" else None


@lru_cache(maxsize=4096)
def sign_of(expression: Expr, assumptions: Assumptions = ()) -> Sign:
    """Sign of a rational expression for all values of its symbols inside the assumptions.

    Parameters
    ----------
    expression : sympy.Expr
        A rational function of the assumed symbols, a number, or ±oo. ``Min`` is resolved by
        the signs of its arguments.
    assumptions : tuple of Range

    Returns
    -------
    Sign
        None where the sign varies or could not be proved.
    """
    if expression.is_number:
        return _sign_of_number(expression)
    if expression.has(sympy.Min):
        return _sign_with_min(expression, assumptions)
    offset = _shifted(expression, assumptions)
    if offset is None:
        return None
    sign = _sign_of_quotient(offset)
    free = sorted(offset.free_symbols, key=str)
    if sign is not None or len(free) != 1 or not free[0].is_integer:
        return sign
    return _sign_by_values(offset, free[0])


def _sign_of_number(number: Expr) -> Sign:
    if number.is_zero:
        return "0"
    if number.is_extended_positive:
        return "+"
    return "-" if number.is_extended_negative else None


def _sign_with_min(expression: Expr, assumptions: Assumptions) -> Sign:
    """Replace the first Min by each of its arguments; what their signs share is the sign.

    k (min(x, u) − min(x, v)) has the weak sign of k (u − v) whatever x is.
    """
    minima = sorted(expression.atoms(sympy.Min), key=str)
    if len(minima) == 2:
        x = set(minima[0].args) & set(minima[1].args)
        dummies = sympy.Dummy(), sympy.Dummy()
        linear = sympy.expand(expression.xreplace(dict(zip(minima, dummies, strict=True))))
        k = sympy.cancel(linear.coeff(dummies[0]))
        if len(x) == 1 and sympy.cancel(linear - k * (dummies[0] - dummies[1])) == 0:
            u, v = (sympy.Min(*(set(m.args) - x)) for m in minima)
            return _WEAK[sign_of(k * (u - v), assumptions)]
    least = minima[0]
    signs: set[Sign] = {sign_of(expression.xreplace({least: a}), assumptions) for a in least.args}
    return signs.pop() if len(signs) == 1 else _common_sign(signs)


_WEAK: dict[Sign, Sign] = {"+": ">=0", ">=0": ">=0", "-": "<=0", "<=0": "<=0", "0": "0", None: None}


def _shifted(expression: Expr, assumptions: Assumptions) -> Expr | None:
    """Write each symbol as its lower bound plus t >= 0; None if a symbol has no range."""
    known = {r.symbol for r in assumptions}
    if not expression.free_symbols <= known:
        return None
    for r in reversed(assumptions):
        t = sympy.Symbol(f"t_{r.symbol}", nonnegative=True, integer=r.integer or None)
        expression = expression.xreplace({r.symbol: r.lower + t})
    return expression


@lru_cache(maxsize=256)
def _functions(symbols: tuple[Symbol, ...]) -> FracField:
    """The rational functions of some symbols, in which signs of coefficients are read off."""
    return sympy.polys.fields.field(symbols, sympy.QQ)[0]


def _sign_of_quotient(expression: Expr) -> Sign:
    if expression.is_number:
        return _sign_of_number(expression)
    symbols = tuple(sorted(expression.free_symbols, key=str))
    element = _functions(symbols).from_expr(expression)
    over: Sign = _sign_of_polynomial(element.numer)
    under: Sign = _sign_of_polynomial(element.denom)
    if over is None or under not in ("+", "-"):
        return None
    return over if under == "+" else _OPPOSITE[over]


_OPPOSITE: dict[Sign, Sign] = {"+": "-", "-": "+", ">=0": "<=0", "<=0": ">=0", "0": "0"}


def _sign_of_polynomial(polynomial: FracElement) -> Sign:
    """Sign for all t >= 0, from the signs of the coefficients."""
    coefficients = dict(polynomial.terms())
    if not coefficients:
        return "0"
    constant = any(not any(powers) for powers in coefficients)
    if all(c > 0 for c in coefficients.values()):
        return "+" if constant else ">=0"
    if all(c < 0 for c in coefficients.values()):
        return "-" if constant else "<=0"
    return None


def _sign_by_values(expression: Expr, t: Symbol) -> Sign:
    """Sign of a function of one integer t >= 0: values one by one, then the rest at once."""
    seen: set[Sign] = set()
    for value in range(_TRIED):
        later = _sign_of_quotient(expression.xreplace({t: t + value}))
        if later is not None:
            seen.add(later)
            return _common_sign(seen)
        seen.add(_sign_of_number(sympy.cancel(expression.xreplace({t: Integer(value)}))))
    return None


def _common_sign(signs: set[Sign]) -> Sign:
    if signs <= {"+", ">=0", "0"}:
        return "+" if signs == {"+"} else ">=0"
    if signs <= {"-", "<=0", "0"}:
        return "-" if signs == {"-"} else "<=0"
    return None


def lower_bound(free: Symbol, assumptions: Assumptions) -> Expr | None:
    """The lower bound of a symbol's range; None if it has no range."""
    return next((r.lower for r in assumptions if r.symbol == free), None)


def sign_changes(expression: Expr, assumptions: Assumptions) -> tuple[Symbol, list[Expr]] | None:
    """Where the sign of a rational function of one symbol changes, or None if it has more.

    Returns
    -------
    (symbol, roots)
        The real roots above the symbol's lower bound, ascending.
    """
    if len(expression.free_symbols) != 1:
        return None
    (free,) = expression.free_symbols
    lower = lower_bound(free, assumptions)
    if lower is None or not lower.is_number:
        return None
    numerator, _ = sympy.fraction(sympy.together(expression))
    roots = sympy.Poly(numerator, free).real_roots()
    return free, sorted({r for r in roots if r >= lower})
