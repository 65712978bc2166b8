"""Grammar of proofs: which expressions there are, and how they are opened and substituted.

Symbols are real and nothing else; what more is known of them stands in hypotheses. Of SymPy is
trusted that it builds an expression without changing its value where it is defined, and that
``xreplace``, ``replace``, ``diff``, ``expand``, ``together``, ``reduced`` and ``factorint`` are
right; of python-flint, its balls.
"""

import re
from typing import Any

from ...theory.symbolic import Expr, Symbol, sympy

BINDERS = (sympy.Sum, sympy.Product, sympy.Integral)
ENTIRE = (sympy.exp, sympy.sin, sympy.cos, sympy.sinc)
KINKED = (sympy.Min, sympy.Max, sympy.Abs)
_FUNCTION: Any = sympy.core.function.UndefinedFunction
UNDEFINED_FUNCTION: Any = sympy.core.function.AppliedUndef

_OPERATIONS = {
    *ENTIRE, *KINKED, sympy.log, sympy.gamma, sympy.besselj, sympy.Add, sympy.Mul, sympy.Pow,
}  # fmt: skip
_NAME = re.compile(r"[^\W\d]\w*'*")  # no bracket: names of generators have some


class Refused(ValueError):
    """A step that the kernel cannot check."""


_TYPES = {
    *BINDERS, *_OPERATIONS, sympy.Symbol, sympy.Tuple, sympy.Integer, sympy.Rational,
    *map(type, (sympy.S.Zero, sympy.S.One, -sympy.S.One, sympy.S.Half, sympy.pi, sympy.E)),
    *map(type, (sympy.oo, -sympy.oo)),
}  # fmt: skip
_class: Any = type
_PLAIN: Any = sympy.Function("f")


def own(e: Any) -> bool:
    """Whether the outermost class of a term is one of SymPy's, and none made of it."""
    cls = _class(e)
    made_by_name = _class(cls) is _FUNCTION and cls.__bases__ == (UNDEFINED_FUNCTION,)
    plain = made_by_name and cls.__dict__.keys() == _PLAIN.__dict__.keys()
    return cls in _TYPES or bool(plain)


def require(condition: bool, what: str, *terms: Any) -> None:
    """Refuse the step unless the condition holds."""
    if not condition:
        raise Refused(": ".join(map(str, (what, *terms))))


def opened(e: Expr) -> tuple[Expr, Symbol, Expr, Expr]:
    """The term under the outermost range of a sum, product or integral, and that range."""
    *inner, outer = e.limits
    require(len(outer) == 3, "no range", e)
    return (e.func(e.function, *inner) if inner else e.function, *outer)


def bound(e: Expr) -> set[Symbol]:
    """Symbols bound by sums, products and integrals."""
    return {range_[0] for b in e.atoms(*BINDERS) for range_ in b.limits}


def well_formed(e: Expr) -> bool:
    """Whether the expression is in the grammar: real symbols, one range per binder."""
    if not own(e):
        return False
    if e.is_Symbol:
        return e == sympy.Symbol(e.name, real=True) and bool(_NAME.fullmatch(e.name))
    if e.is_Atom:
        return bool(e.is_Rational) or e in (sympy.pi, sympy.E)
    if isinstance(e, BINDERS):
        f, x, a, b = opened(e)
        ends = (a == -sympy.oo or well_formed(a)) and (b == sympy.oo or well_formed(b))
        free = not (a.free_symbols | b.free_symbols | bound(f)) & {x}
        return ends and free and well_formed(f)
    return known(e) and all(well_formed(a) for a in e.args)


def known(e: Expr) -> bool:
    """Whether the outermost operation is in the grammar; logarithms have no base but e."""
    name = str(e.func)
    if isinstance(e, UNDEFINED_FUNCTION):
        return own(e) and e.func == sympy.Function(name) and bool(_NAME.fullmatch(name))
    return type(e) in _OPERATIONS and (e.func is not sympy.log or len(e.args) == 1)


def substituted(e: Expr, values: tuple[tuple[Any, Expr], ...]) -> Expr:
    """Symbols and undefined functions replaced by terms (functions by Lambdas), all at once."""
    symbols = {k: v for k, v in values if getattr(k, "is_Symbol", False)}
    bodies = [v.expr for k, v in values if k not in symbols and type(v) is sympy.Lambda]
    inner = {s for b in bodies for s in bound(b)}
    caught, names = bound(e) | inner, e.free_symbols.union(*(v.free_symbols for _, v in values))
    require(not inner & (bound(e) | names), "would be caught", inner)
    for key, value in values:
        require(key in symbols or isinstance(key, _FUNCTION), "no name", key)
        require(key in symbols or type(value) is sympy.Lambda, "no function", value)
        body = value if key in symbols else value.expr
        require(well_formed(body), "no term", value)
        require(not caught & ({key} | value.free_symbols), "meets a bound symbol", key)
        if key not in symbols:
            e = e.replace(key, value)
    return e.xreplace(symbols)


def require_smooth(e: Expr, x: Symbol) -> None:
    """Require that e may be differentiated by x, wherever e is defined."""
    unknown = e.atoms(*KINKED, *BINDERS, UNDEFINED_FUNCTION, sympy.sinc, sympy.gamma, sympy.besselj)
    require(not any(x in u.free_symbols for u in unknown), "no derivative of", e)
