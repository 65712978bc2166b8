"""Exact expressions: read from text without evaluating it, and put into one form.

Exponents, block sizes and dimensions come from users as text such as ``3/2``, ``1 + 1/d`` or
``d-3``. The text is parsed to a syntax tree and only whole numbers, decimals, the named symbols,
``oo``, ``min`` and + - * / ** (also ^) are accepted; nothing is ever executed.
"""

import ast
from collections.abc import Mapping

from .errors import InputError
from .symbolic import Expr, Integer, Rational, sympy

_LONGEST = 200  # characters: an exponent is short; longer text is not one
_LARGEST_POWER = 64

_RULE = "an exact expression uses numbers, + - * / ^, min, oo"


def parse_expression(text: str, symbols: Mapping[str, Expr] | None = None) -> Expr:
    """Exact SymPy expression written in ``text``.

    Parameters
    ----------
    text : str
        Decimals are read exactly: ``0.3`` is 3/10.
    symbols : mapping of str to sympy.Expr, optional
        The names that may occur, and what they stand for.

    Raises
    ------
    InputError
        For anything else, or a division by zero.
    """
    known = symbols or {}
    rule = _RULE + (f" and {', '.join(known)}" if known else "")
    if len(text) > _LONGEST:
        raise InputError(f"{rule}, in at most {_LONGEST} characters: got {len(text)}")
    try:
        tree = ast.parse(text.strip().replace("^", "**"), mode="eval").body
        value = _value(tree, text, known)
    except (SyntaxError, ValueError, RecursionError, MemoryError, ZeroDivisionError):
        raise InputError(f"{rule}: got {text!r}") from None
    if value.has(sympy.zoo, sympy.nan):
        raise InputError(f"{rule}, and never divides by zero: got {text!r}")
    return value


def _value(node: ast.expr, text: str, known: Mapping[str, Expr]) -> Expr:
    match node:
        case ast.Constant(value=bool()):
            raise ValueError
        case ast.Constant(value=int() as number):
            return Integer(number)
        case ast.Constant(value=float()):
            return Rational(ast.get_source_segment(text.strip().replace("^", "**"), node))
        case ast.Name(id="oo"):
            return sympy.oo
        case ast.Name(id=name) if name in known:
            return known[name]
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return -_value(inner, text, known)
        case ast.UnaryOp(op=ast.UAdd(), operand=inner):
            return _value(inner, text, known)
        case ast.BinOp(left=left, op=op, right=right):
            return _combined(op, _value(left, text, known), _value(right, text, known))
        case ast.Call(func=ast.Name(id="min" | "Min"), args=args, keywords=[]) if args:
            return sympy.Min(*[_value(a, text, known) for a in args])
        case _:
            raise ValueError


def _combined(op: ast.operator, left: Expr, right: Expr) -> Expr:
    match op:
        case ast.Add():
            return left + right
        case ast.Sub():
            return left - right
        case ast.Mult():
            return left * right
        case ast.Div():
            if right.is_zero:
                raise ZeroDivisionError
            return left / right
        case ast.Pow() if right.is_Integer and abs(int(right)) <= _LARGEST_POWER:
            return left**right
        case _:
            raise ValueError


def is_whole(text: str) -> bool:
    """Whether the text is written in the digits 0-9 alone (``isdigit`` also takes ² and ٣)."""
    return text.isascii() and text.isdigit()


def parse_size(text: str, symbols: Mapping[str, Expr] | None = None) -> Expr:
    """A dimension or block size: a positive whole number, or an expression in the symbols.

    Raises
    ------
    InputError
        If a number is not whole or below 1.
    """
    size = parse_expression(text, symbols)
    if size.is_number and not (size.is_Integer and size.is_positive):
        raise InputError(f"a size must be a whole number of at least 1: got {text!r}")
    return size


def partial_fractions(exponent: Expr) -> Expr:
    """One form for one exponent: d/(d − 1) + 1/(d − 1) becomes 1 + 2/(d − 1)."""
    expanded = sympy.expand(exponent)
    symbolic = [t for t in sympy.Add.make_args(expanded) if not t.is_number]
    if not symbolic or (len(symbolic) == 1 and symbolic[0].as_numer_denom()[0].is_number):
        return expanded
    if not expanded.is_rational_function():
        return expanded
    quotient = sympy.together(expanded)
    free = sympy.fraction(quotient)[1].free_symbols
    return sympy.expand(sympy.apart(quotient, *free)) if len(free) == 1 else expanded
