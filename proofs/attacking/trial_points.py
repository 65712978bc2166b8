"""Points at which the hypotheses of a claim hold, drawn at random.

Symbols have hundredths or whole numbers as values, now and then very small, large, or next to one
another. While a hypothesis does not hold, one of its symbols is drawn anew, or set where the
hypothesis says what it is. Hypotheses on all values of their own symbols are made to hold wherever
an undefined function is first looked at. Where N grows, those on N must hold for all large N.
"""

import random
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

from ...numerics.integrands.protocol import Mpf, mp
from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted.claims import Claim
from ..trusted.grammar import UNDEFINED_FUNCTION
from . import growth_series as growth
from .trial_values import Point, series, value
from .undecided import Undecided, Undefined

_DRAWN_DIGITS = 120
"""Digits of what is drawn: more than most trials are evaluated with."""

_DIGITS = 30
_LARGEST_SET = 20
"""The largest number that a symbol is set to because a hypothesis says what it is."""

_REPAIRS = 300
_REDRAWS = 400
_EDGE, _ROUNDING = mp.mpf("1e-12"), mp.mpf("1e-20")
"""How clearly a strict hypothesis must hold, as exact values differ by more or not at all; and what
may be amiss with one that is not strict."""

_LARGEST_WHOLE = (40, 16, 9, 6)
"""By how many sums and products lie in one another."""


class NoPoint(ArithmeticError):
    """No values were found for which the hypotheses hold."""


@dataclass(frozen=True)
class _Hypothesis:
    claim: Claim
    symbols: tuple[Symbol, ...]
    functions: frozenset[str]
    on_large: bool
    is_sign: bool
    given: tuple["_Hypothesis", ...]


@dataclass(frozen=True)
class _Design:
    """What is drawn, and what must hold.

    Parameters
    ----------
    wholes : dict
        The free symbols, and whether each is a whole number.
    positive : frozenset
        Those of which a hypothesis says that they are above a number that is not negative.
    most : int
        The largest whole number drawn: sums in sums have as many terms as its powers.
    plain, for_all : tuple
        Hypotheses of one point, and those said for all values of their own symbols.
    """

    wholes: dict[Symbol, bool]
    positive: frozenset[Symbol]
    most: int
    plain: tuple[_Hypothesis, ...]
    for_all: tuple[_Hypothesis, ...]


@lru_cache(maxsize=4096)
def _design(claim: Claim) -> _Design:
    whole = {h.left for h in claim.given if h.relation == "whole"}
    above = [h for h in claim.given if h.relation in ("<", "<=") and h.left.is_Rational]
    depth = max(_depth(claim.left), _depth(claim.right))
    return _Design(
        {s: s in whole for s in sorted(claim.free - {claim.along}, key=str)},
        frozenset(h.right for h in above if h.right.is_Symbol and h.left >= 0),
        _LARGEST_WHOLE[min(depth, len(_LARGEST_WHOLE) - 1)],
        tuple(_hypothesis(h, claim.along) for h in claim.given if not h.over),
        tuple(_hypothesis(h, None) for h in claim.given if h.over),
    )


def _hypothesis(h: Claim, along: Symbol | None) -> _Hypothesis:
    found = (*h.left.atoms(UNDEFINED_FUNCTION), *h.right.atoms(UNDEFINED_FUNCTION))
    given = tuple(_hypothesis(g, None) for g in h.given)
    free, functions = tuple(sorted(h.free, key=str)), frozenset(str(f.func) for f in found)
    on_large = along is not None and along in free
    is_sign = h.left == 0 and h.relation in ("<", "<=") and h.right in free and not on_large
    return _Hypothesis(h, free, functions, on_large, is_sign, given)


def symbols(claim: Claim) -> Mapping[Symbol, bool]:
    """The symbols whose values are free, and whether each is a whole number."""
    return _design(claim).wholes


def point(
    claim: Claim, rng: random.Random, start: Mapping[Symbol, Fraction] | None = None
) -> Point:
    """One point.

    Parameters
    ----------
    claim : Claim
    rng : random.Random
    start : mapping, optional
        Values of symbols to begin with, before any is drawn anew.

    Raises
    ------
    NoPoint
        If repairs do not end.
    """
    design, values = _design(claim), dict[Symbol, Any]()
    with mp.workdps(_DRAWN_DIGITS):
        for s, is_whole in design.wholes.items():
            begun = (start or {}).get(s)
            if begun is not None:
                values[s] = mp.mpf(begun.numerator) / begun.denominator
            else:
                drawn = _drawn(rng, is_whole, design.most, values)
                values[s] = abs(drawn) if s in design.positive else drawn
    if claim.along is not None:
        values[claim.along] = growth.growing()
    at = Point(values, lambda: _drawn(rng, rng.random() < 0.3, design.most))
    at.choose = lambda name, places: _choose(design, name, places, at, rng)
    for _ in range(_REPAIRS):
        broken = next((h for h in design.plain if not _holds(h, at)), None)
        if broken is None:
            return at
        _repair(broken, at, design, rng)
    raise NoPoint("no values for which the hypotheses hold")


def _holds(h: _Hypothesis, at: Point) -> bool:
    """Whether a hypothesis holds at a point; what cannot be told does not."""
    c = h.claim
    if h.is_sign and at.values[c.right] > _EDGE:
        return True
    try:
        if h.on_large:
            return _holds_for_large(c, at)
        with mp.workdps(_DIGITS):
            left = value(c.left, at)
            if c.relation == "whole":
                return abs(left - mp.nint(left)) <= _EDGE
            gap = value(c.right, at) - left
    except (Undefined, Undecided):
        return False
    match c.relation:
        case "=":
            return abs(gap) <= _ROUNDING * (1 + abs(left))
        case "!=":
            return abs(gap) > _EDGE
        case "<":
            return gap > _EDGE
        case "<=":
            return gap >= -_ROUNDING * (1 + abs(left))
        case _:
            return False


def _holds_for_large(h: Claim, at: Point) -> bool:
    if h.relation == "whole":
        return isinstance(at.values.get(h.left), growth.Series)
    with mp.workdps(growth.DIGITS):
        large = grown(at)
        minus = growth.constant(mp.mpf(-1))
        sign = growth.sign(series(h.right, large) + minus * series(h.left, large))
    return {"<": sign > 0, "<=": sign >= 0, "=": sign == 0, "!=": sign != 0}.get(h.relation, False)


def grown(at: Point) -> Point:
    """The point with constant series for values."""
    values = {
        s: v if isinstance(v, growth.Series) else growth.constant(v) for s, v in at.values.items()
    }
    return Point(values, at.draw, at.functions, at.choose)


def _repair(broken: _Hypothesis, at: Point, design: _Design, rng: random.Random) -> None:
    """Other values of what a broken hypothesis is about."""
    c = broken.claim
    if c.relation == "=" and rng.random() < 0.7:  # else one that it is not said of
        for one, other in ((c.left, c.right), (c.right, c.left)):
            is_free = one in design.wholes and one not in other.free_symbols
            if is_free and _is_set(one, other, at, max(design.most, _LARGEST_SET)):
                return
    if broken.functions:
        at.functions.clear()
    about = [s for s in broken.symbols if s in design.wholes]
    if about:
        s = rng.choice(about)
        others = {k: at.values[k] for k in design.wholes if k != s}
        drawn = _drawn(rng, design.wholes[s], design.most, others)
        at.values[s] = abs(drawn) if s in design.positive else drawn


def _is_set(one: Symbol, other: Expr, at: Point, most: int) -> bool:
    """Whether a symbol could be given the value of a term; sums to large numbers take long."""
    try:
        with mp.workdps(_DRAWN_DIGITS):
            number = value(other, at)
    except (Undefined, Undecided):
        return False
    if abs(number) > most:
        return False
    at.values[one] = number
    return True


def _choose(
    design: _Design, name: str, places: tuple[Mpf, ...], at: Point, rng: random.Random
) -> None:
    """Values of functions at a place, such that the hypotheses on them hold there."""
    alike = [h for h in design.for_all if len(h.claim.over) == len(places)]
    met = frozenset[str]().union(*(h.functions for h in alike if name in h.functions))
    there = [h for h in alike if met & h.functions]
    if not there:
        return
    names = sorted(met.union(*(h.functions for h in there)))
    wholes = frozenset[str]().union(*(h.functions for h in there if h.claim.relation == "whole"))
    for _ in range(_REDRAWS):
        for other in names:
            is_whole = other in wholes or rng.random() < 0.3
            at.functions[(other, *places)] = _drawn(rng, is_whole, design.most)
        if all(_holds_there(h, places, at) for h in there):
            return
    raise NoPoint(f"no values of {name} for which the hypotheses hold")


def _holds_there(h: _Hypothesis, places: tuple[Mpf, ...], at: Point) -> bool:
    c, here = h.claim, at
    for s, k in zip(c.over, places, strict=True):
        here = here.within(s, k)
    if not all(_holds(g, here) for g in h.given):
        return True
    if c.relation == "=" and isinstance(c.left, UNDEFINED_FUNCTION):
        here.functions[(str(c.left.func), *places)] = value(c.right, here)
    return _holds(h, here)


def _drawn(
    rng: random.Random, is_whole: bool, most: int, others: Mapping[Symbol, Mpf] | None = None
) -> Mpf:
    """A whole number, or a hundredth; now and then at or next to the value of another symbol."""
    if others and rng.random() < 0.08:
        near = int(mp.nint(100 * rng.choice(list(others.values()))))
        near += 0 if is_whole else rng.choice((-1, 0, 1))
        if not is_whole or near % 100 == 0:
            return _hundredths(near)
    sign = rng.choice((1, 1, 1, -1))
    if is_whole:
        usual = rng.random() < 0.8
        return mp.mpf(rng.randint(-2, min(6, most)) if usual else sign * rng.randint(0, most))
    size = 2 ** (rng.uniform(-3, 2.5) if rng.random() < 0.85 else rng.uniform(-6.6, 6))
    return _hundredths(sign * max(1, round(100 * size)))


def _hundredths(k: int) -> Mpf:
    with mp.workdps(_DRAWN_DIGITS):
        return mp.mpf(k) / 100


def _depth(e: Expr) -> int:
    inner = max((_depth(a) for a in e.args if isinstance(a, sympy.Basic)), default=0)
    is_finite = isinstance(e, (sympy.Sum, sympy.Product)) and e.limits[0][2] != sympy.oo
    return inner + (len(e.limits) if is_finite else 0)
