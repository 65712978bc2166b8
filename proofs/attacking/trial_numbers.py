"""Kinds of numbers at a point: those of mpmath, or series in a growing N."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from ...numerics.integrands.protocol import Mpf, mp
from . import growth_series as growth
from .undecided import Undefined

Number = Any
"""An mpf, or a `growth_series.Series`."""


@dataclass(frozen=True, eq=False)
class Kind:
    """What numbers are: how they are made, raised to powers, compared and told apart.

    Parameters
    ----------
    make : callable
        Of an mpf.
    read : callable
        Back to an mpf; raises ``Undecided`` where there is none.
    power : callable
    functions : mapping
        By the names they have in sympy.
    sign : callable
        1, 0 or -1.
    agree : callable
        Whether two estimates are one, within a doubt.
    is_plain : bool
        Whether numbers are mpf, which can be remembered by.
    """

    make: Callable[[Mpf], Number]
    read: Callable[[Number], Mpf]
    power: Callable[[Number, Number], Number]
    functions: Mapping[str, Callable[..., Number]]
    sign: Callable[[Number], int]
    agree: Callable[[Number, Number, Mpf], bool]
    is_plain: bool


def _plain_power(base: Mpf, exponent: Mpf) -> Mpf:
    if base == 0 and exponent < 0:
        raise Undefined("1/0")
    if exponent == int(exponent):
        return base ** int(exponent)
    if base < 0:
        raise Undefined("a power that is not real")
    return base**exponent


def _plain_log(x: Mpf) -> Mpf:
    if x <= 0:
        raise Undefined("the logarithm of no positive number")
    return mp.log(x)


def _plain_gamma(x: Mpf) -> Mpf:
    if x <= 0 and x == mp.nint(x):
        raise Undefined("a pole of gamma")
    return mp.gamma(x)


PLAIN = Kind(
    lambda x: x,
    lambda x: x,
    _plain_power,
    {
        "sin": mp.sin, "cos": mp.cos, "exp": mp.exp, "log": _plain_log, "sinc": mp.sinc,
        "gamma": _plain_gamma, "besselj": mp.besselj, "Min": min, "Max": max, "Abs": abs,
    },
    lambda x: int(mp.sign(x)),
    lambda x, y, doubt: abs(x - y) <= doubt,
    True,
)  # fmt: skip


def _least(*parts: growth.Series) -> growth.Series:
    return _extreme(parts, -1)


def _greatest(*parts: growth.Series) -> growth.Series:
    return _extreme(parts, 1)


def _extreme(parts: tuple[growth.Series, ...], which: int) -> growth.Series:
    best, minus = parts[0], growth.constant(mp.mpf(-1))
    for p in parts[1:]:
        if growth.sign(p + minus * best) == which:
            best = p
    return best


def _size(s: growth.Series) -> growth.Series:
    return growth.constant(mp.mpf(-1)) * s if growth.sign(s) < 0 else s


GROWING = Kind(
    growth.constant,
    growth.value_of,
    growth.power,
    {
        "sin": growth.sine, "cos": growth.cosine, "exp": growth.exp, "log": growth.log,
        "sinc": growth.sinc, "Min": _least, "Max": _greatest, "Abs": _size,
        "gamma": growth.elsewhere("gamma"), "besselj": growth.elsewhere("besselj"),
    },
    growth.sign,
    lambda s, t, _: growth.lead_alike(s, t),
    False,
)  # fmt: skip
