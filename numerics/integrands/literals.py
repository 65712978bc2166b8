"""Exact literals of the integrand grammar: read without evaluation, written so that they read back.

A value is a number or a parenthesised list of numbers; a number is a decimal (``0.3``, ``1e-3``)
or a fraction (``3/10``) of at most 40 digits, kept exactly.
"""

import re
from fractions import Fraction
from typing import TypeAlias

from ...theory.errors import InputError

Value: TypeAlias = Fraction | tuple[Fraction, ...]

_DECIMAL = r"[+-]?(?:\d{1,40}(?:\.\d{0,40})?|\.\d{1,40})(?:[eE][+-]?\d{1,3})?"  # bounded size
_NUMBER = re.compile(rf"{_DECIMAL}|[+-]?\d{{1,40}}/\d{{1,40}}", re.ASCII)
_DIGITS = 40
_SMALLEST, _LARGEST = Fraction(1, 10**999), Fraction(10**999)
_LONGEST_DECIMAL = 12  # beyond that many decimals a fraction is easier to read


def parse_number(text: str) -> Fraction:
    """The decimal or fraction, exactly: ``0.3`` is 3/10.

    Raises
    ------
    InputError
        If the text is neither, has more digits, is beyond 1e±999, or has denominator 0.
    """
    stripped = text.strip()
    denominator = stripped.partition("/")[2]
    if not _NUMBER.fullmatch(stripped) or (denominator and int(denominator) == 0):
        raise InputError(f"a number must be a decimal or a fraction p/q: got {text!r}")
    number = Fraction(stripped)
    digits = re.split("[eE]", stripped)[0].replace(".", "").lstrip("+-").strip("0")
    if not denominator and (len(digits) > _DIGITS or not _SMALLEST <= abs(number or 1) <= _LARGEST):
        rule = f"a number must have at most {_DIGITS} digits and lie within 1e-999 and 1e999"
        raise InputError(f"{rule}: got {text!r}")
    return number


def parse_value(text: str) -> Value:
    """A number, or the numbers between a pair of parentheses."""
    stripped = text.strip()
    if stripped.startswith("(") and stripped.endswith(")"):
        return tuple(parse_number(part) for part in stripped[1:-1].split(","))
    return parse_number(stripped)


def literal(value: Value) -> str:
    """Text that `parse_value` reads back: the decimal where it is short, else the fraction.

    A decimal whose fraction is longer than the grammar has it is written with its exponent.
    """
    if isinstance(value, tuple):
        return f"({','.join(map(literal, value))})"
    for decimals in range(_LONGEST_DECIMAL + 1):
        scaled = value * 10**decimals
        if scaled.denominator == 1 and abs(scaled.numerator) < 10**_DIGITS:
            digits = str(abs(scaled.numerator)).zfill(decimals + 1)
            sign, point = "-" * (value < 0), len(digits) - decimals
            return sign + digits[:point] + ("." + digits[point:]) * (decimals > 0)
    if max(abs(value.numerator), value.denominator) < 10**_DIGITS:
        return str(value)
    power = 0
    while value.denominator != 1:
        power, value = power - 1, value * 10
    while value % 10 == 0:
        power, value = power + 1, value / 10
    return f"{value}e{power}"


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
