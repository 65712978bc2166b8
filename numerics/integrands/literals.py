"""Exact literals of the integrand grammar: read without evaluation, written so that they read back.

A value is a number or a parenthesised list of numbers; a number is a decimal (``0.3``, ``1e-3``)
or a fraction (``3/10``), kept exactly.
"""

import re
from fractions import Fraction
from typing import TypeAlias

from ...theory.errors import InputError

Value: TypeAlias = Fraction | tuple[Fraction, ...]

_DECIMAL = r"[+-]?(?:\d{1,40}(?:\.\d{0,40})?|\.\d{1,40})(?:[eE][+-]?\d{1,3})?"  # bounded size
_NUMBER = re.compile(rf"{_DECIMAL}|[+-]?\d{{1,40}}/\d{{1,40}}", re.ASCII)
_LONGEST_DECIMAL = 12  # beyond that many decimals a fraction is easier to read


def parse_number(text: str) -> Fraction:
    """The decimal or fraction, exactly: ``0.3`` is 3/10.

    Raises
    ------
    InputError
        If the text is neither, or a fraction has denominator 0.
    """
    stripped = text.strip()
    denominator = stripped.partition("/")[2]
    if not _NUMBER.fullmatch(stripped) or (denominator and int(denominator) == 0):
        raise InputError(f"a number must be a decimal or a fraction p/q: got {text!r}")
    return Fraction(stripped)


def parse_value(text: str) -> Value:
    """A number, or the numbers between a pair of parentheses."""
    stripped = text.strip()
    if stripped.startswith("(") and stripped.endswith(")"):
        return tuple(parse_number(part) for part in stripped[1:-1].split(","))
    return parse_number(stripped)


def literal(value: Value) -> str:
    """Text that `parse_value` reads back: the decimal where it is short, else the fraction."""
    if isinstance(value, tuple):
        return f"({','.join(map(literal, value))})"
    for decimals in range(_LONGEST_DECIMAL + 1):
        scaled = value * 10**decimals
        if scaled.denominator == 1:
            digits = str(abs(scaled.numerator)).zfill(decimals + 1)
            sign, point = "-" * (value < 0), len(digits) - decimals
            return sign + digits[:point] + ("." + digits[point:]) * (decimals > 0)
    return str(value)


def positive(count: int | Fraction) -> int | Fraction:
    """The number of strata itself.

    Raises
    ------
    InputError
        Unless it is positive.
    """
    if not count > 0:
        raise InputError(f"a number of strata must satisfy 0 < n: got {count}")
    return count
