"""Integrands by name: ``NAME`` or ``NAME:key=value,key=value``, read without evaluation.

A value is an exact decimal or fraction, or a parenthesised list of them, one per coordinate:
``disk:radius=0.3``, ``box:side=(1/3,0.5)``, ``bernoulli:k=2,axes=(1,2)``, ``ridge:k=(1,-1)``.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from ...theory.errors import InputError
from .additive import additive
from .ball import Ball
from .bernoulli import bernoulli
from .box import box
from .chord import Chord
from .gaussian import gaussian
from .half_space import half_space
from .literals import Value, literal, parse_value
from .polylog import polylog
from .product import product
from .protocol import Integrand
from .ridge import Ridge

Values: TypeAlias = Mapping[str, Value]

_LONGEST = 20_000  # characters, a list of a thousand numbers; longer text is no integrand
_COMMA = re.compile(r",(?![^()]*\))")  # commas outside parentheses


@dataclass(frozen=True)
class Entry:
    """An integrand of the catalogue: its name, its keys and what builds it from dim and values."""

    name: str
    keys: tuple[str, ...]
    build: Callable[[int, Values], Integrand]


def _disk(dim: int, values: Values) -> Integrand:
    if dim != 2:
        raise InputError(f"disk: the dimension must be 2 (else ball): got {dim}")
    return _ball(dim, values)


def _ball(dim: int, values: Values) -> Integrand:
    return Ball(dim, _number(values, "radius", Fraction(3, 10)))


def _chord(dim: int, values: Values) -> Integrand:
    return Chord(dim, _number(values, "radius", Fraction(3, 10)))


def _gaussian(dim: int, values: Values) -> Integrand:
    return gaussian((_number(values, "sigma", Fraction(1, 10)),) * dim)


def _anisotropic_gaussian(dim: int, values: Values) -> Integrand:
    default = (Fraction(1, 10), *(Fraction(2, 5),) * (dim - 1))
    return gaussian(_per_axis(values, "sigma", default))


def _box(dim: int, values: Values) -> Integrand:
    return box(_per_axis(values, "side", (Fraction(3, 10),) * dim))


def _half_space(dim: int, values: Values) -> Integrand:
    return half_space(dim, _number(values, "side", Fraction(3, 10)))


def _bernoulli(dim: int, values: Values) -> Integrand:
    axes = values.get("axes", Fraction(1))
    numbers = axes if isinstance(axes, tuple) else (axes,)
    return bernoulli(dim, _integer(values, "k", 2), tuple(_whole("axes", n) for n in numbers))


def _product(dim: int, values: Values) -> Integrand:
    return product(dim, _integer(values, "k", 2), _number(values, "c", Fraction(1)))


def _additive(dim: int, values: Values) -> Integrand:
    return additive(dim, _integer(values, "k", 2))


def _polylog(dim: int, values: Values) -> Integrand:
    return polylog(dim, _number(values, "p", Fraction(5, 2)))


def _ridge(dim: int, values: Values) -> Integrand:
    direction = _per_axis(values, "k", (Fraction(1),) * dim)
    return Ridge(tuple(_whole("k", n) for n in direction), _integer(values, "b", 2))


CATALOGUE: tuple[Entry, ...] = (
    Entry("disk", ("radius",), _disk),
    Entry("ball", ("radius",), _ball),
    Entry("chord", ("radius",), _chord),
    Entry("gaussian", ("sigma",), _gaussian),
    Entry("anisotropic-gaussian", ("sigma",), _anisotropic_gaussian),
    Entry("box", ("side",), _box),
    Entry("half-space", ("side",), _half_space),
    Entry("bernoulli", ("k", "axes"), _bernoulli),
    Entry("product", ("k", "c"), _product),
    Entry("additive", ("k",), _additive),
    Entry("polylog", ("p",), _polylog),
    Entry("ridge", ("k", "b"), _ridge),
)


def parse_integrand(text: str, dim: int) -> Integrand:
    """The integrand that the text names, in the given dimension.

    Parameters
    ----------
    text : str
        ``NAME`` or ``NAME:key=value,...``.
    dim : int
        Number of coordinates, at least 1.

    Returns
    -------
    Integrand
        Equal texts give equal objects, and ``parse_integrand(f.name, f.dim) == f``.

    Raises
    ------
    InputError
        If a name or key is unknown or repeated, or a value is malformed or out of range.
    """
    if dim < 1:
        raise InputError(f"the dimension of an integrand must satisfy 1 <= dim: got {dim}")
    name, colon, rest = text[:_LONGEST].strip().partition(":")
    entry = next((e for e in CATALOGUE if e.name == name), None)
    if entry is None or len(text) > _LONGEST:
        known = ", ".join(e.name for e in CATALOGUE)
        raise InputError(f"an integrand must be one of {known}: got {text[:80]!r}")
    return entry.build(dim, _assignments(entry, rest) if colon else {})


def _assignments(entry: Entry, text: str) -> Values:
    """The key=value pairs, each key known and given once."""
    values: dict[str, Value] = {}
    for part in _COMMA.split(text):
        key, equals, value = part.partition("=")
        key = key.strip()
        if key not in entry.keys or not equals or key in values:
            keys = ", ".join(entry.keys)
            rule = f"{entry.name}: parameters must be key=value, once each, with a key of {keys}"
            raise InputError(f"{rule}: got {part!r}")
        values[key] = parse_value(value)
    return values


def _number(values: Values, key: str, default: Fraction) -> Fraction:
    value = values.get(key, default)
    if isinstance(value, tuple):
        raise InputError(f"{key} must be one number: got {literal(value)}")
    return value


def _integer(values: Values, key: str, default: int) -> int:
    return _whole(key, _number(values, key, Fraction(default)))


def _whole(key: str, value: Fraction) -> int:
    if value.denominator != 1:
        raise InputError(f"{key} must be an integer: got {literal(value)}")
    return value.numerator


def _per_axis(values: Values, key: str, default: tuple[Fraction, ...]) -> tuple[Fraction, ...]:
    """One value per coordinate; a single number serves all of them."""
    value = values.get(key, default)
    dim = len(default)
    if not isinstance(value, tuple):
        return (value,) * dim
    if len(value) != dim:
        raise InputError(f"{key} must have one value per coordinate ({dim}): got {literal(value)}")
    return value
