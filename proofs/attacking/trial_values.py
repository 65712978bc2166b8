"""Values of terms at points: compiled once, then numbers of mpmath, or series in a growing N.

Nothing of the kernel is used. A sum, product or integral that depends on values alone, and not on
what is bound around it, is remembered by these values.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any, TypeAlias

from ...numerics.integrands.protocol import Mpf, mp
from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted.grammar import UNDEFINED_FUNCTION, bound, opened
from . import growth_series as growth
from .trial_integrals import (
    SETTLED,
    polylogarithm,
    power_and_wave,
    power_integral,
    powers,
    quadrature,
)
from .trial_numbers import GROWING, PLAIN, Kind, Number
from .undecided import Undecided, Undefined

_ANY = sympy.Wild("any")
_MOST_TERMS = 30_000
_MOST_REMEMBERED = 20_000


@dataclass
class Point:
    """Values of symbols, and of undefined functions as they are met.

    Parameters
    ----------
    values : dict
        Of symbols.
    draw : callable
        A value for a function where it has none yet.
    functions : dict
        Values of functions by name and arguments, ``("nu", 1)``.
    choose : callable, optional
        Told the name and the arguments of a value that is missing, before it is drawn: it may set
        it, and others with it.
    """

    values: dict[Symbol, Number]
    draw: Callable[[], Mpf]
    functions: dict[tuple[Any, ...], Mpf] = field(default_factory=dict[tuple[Any, ...], Mpf])
    choose: Callable[[str, tuple[Mpf, ...]], None] | None = None

    def within(self, x: Symbol, number: Number) -> "Point":
        """The point with one more symbol."""
        return Point({**self.values, x: number}, self.draw, self.functions, self.choose)

    def function(self, name: str, places: tuple[Mpf, ...]) -> Mpf:
        """The value of an undefined function, the same whenever it is asked for."""
        key = (name, *places)
        if key not in self.functions and self.choose is not None:
            self.choose(name, places)
        if key not in self.functions:
            self.functions[key] = self.draw()
        return self.functions[key]


@lru_cache(maxsize=50_000)
def has_quadrature(e: Expr) -> bool:
    """Whether an integral in e is not one of powers, so that its value is an estimate."""
    found = (opened(u) for u in e.atoms(sympy.Integral))
    return any(powers(f, x) is None for f, x, _, _ in found)


Term: TypeAlias = Callable[[Point], Number]


def value(e: Expr, at: Point) -> Mpf:
    """The number that e is at a point.

    Raises
    ------
    Undefined
        If it is none.
    Undecided
        If it is not found.
    """
    return evaluated(e, at, PLAIN)


def series(e: Expr, at: Point) -> growth.Series:
    """The series that e is where a symbol of the point grows; raises as `value` does."""
    return evaluated(e, at, GROWING)


def evaluated(e: Expr, at: Point, kind: Kind) -> Number:
    """What e is at a point whose values are of one kind."""
    try:
        return compiled(e, kind)(at)
    except (OverflowError, TypeError, ValueError, ZeroDivisionError, mp.NoConvergence) as error:
        raise Undecided(f"{type(error).__name__} in mpmath") from error


@lru_cache(maxsize=50_000)
def compiled(e: Expr, kind: Kind) -> Term:
    """The term as a function of the point."""
    if e.is_Rational or e in (sympy.pi, sympy.E):
        return _constant(e, kind)
    if e.is_Symbol:
        return lambda at: at.values[e]
    if isinstance(e, (sympy.Sum, sympy.Product, sympy.Integral)):
        return _remembered(e, kind)
    parts = tuple(compiled(a, kind) for a in e.args)
    if isinstance(e, UNDEFINED_FUNCTION):
        name = str(e.func)
        return lambda at: kind.make(at.function(name, tuple(kind.read(p(at)) for p in parts)))
    if e.is_Add or e.is_Mul:
        return _gathered(parts, bool(e.is_Add))
    if e.is_Pow:
        base, exponent = parts
        return lambda at: kind.power(base(at), exponent(at))
    applied = kind.functions.get(str(e.func))
    if applied is None:
        raise Undecided(f"{e.func} is not known here")
    return lambda at: applied(*(p(at) for p in parts))


def _constant(e: Expr, kind: Kind) -> Term:
    made: dict[int, Number] = {}

    def at_precision(_: Point) -> Number:
        if mp.prec not in made:
            number = mp.mpf(int(e.p)) / int(e.q) if e.is_Rational else getattr(mp, str(e).lower())
            made[mp.prec] = kind.make(+number)
        return made[mp.prec]

    return at_precision


def _gathered(parts: tuple[Term, ...], is_sum: bool) -> Term:
    first, *others = parts

    def total(at: Point) -> Number:
        result = first(at)
        for p in others:
            result = result + p(at) if is_sum else result * p(at)
        return result

    return total


def _remembered(e: Expr, kind: Kind) -> Term:
    """A sum, product or integral, kept by the values on which it depends."""
    run = _integral(e, kind) if isinstance(e, sympy.Integral) else _over_whole_numbers(e, kind)
    met = sorted(e.atoms(UNDEFINED_FUNCTION), key=str)
    if not kind.is_plain or any(f.free_symbols & bound(e) for f in met):
        return run
    without = e.xreplace({f: sympy.Dummy() for f in met})
    symbols = [s for s in sorted(e.free_symbols, key=str) if s in without.free_symbols]
    functions = [compiled(f, kind) for f in met]
    known: dict[tuple[Mpf, ...], Number] = {}

    def kept(at: Point) -> Number:
        key = (mp.prec, *(at.values[s] for s in symbols), *(f(at) for f in functions))
        if key not in known:
            if len(known) >= _MOST_REMEMBERED:
                known.clear()
            known[key] = run(at)
        return known[key]

    return kept


def _over_whole_numbers(e: Expr, kind: Kind) -> Term:
    # where the ends are no whole numbers, a sum has a value, whatever is meant, if its terms are 0
    f, x, a, b = opened(e)
    if b == sympy.oo:
        return _infinite_sum(f, x, a, kind)
    inner, low, high = compiled(f, kind), compiled(a, kind), compiled(b, kind)
    is_sum = isinstance(e, sympy.Sum)

    def total(at: Point) -> Number:
        ends = kind.read(low(at)), kind.read(high(at))
        is_whole = all(abs(u - mp.nint(u)) <= SETTLED * max(1, abs(u)) for u in ends)
        first, last = (int(mp.nint(u)) for u in ends)
        if last - first > _MOST_TERMS or not (is_whole or is_sum):
            raise Undecided("too many terms, or no whole number of factors")
        result, here = kind.make(mp.mpf(0 if is_sum else 1)), at.within(x, None)
        for k in range(first, last + 1):
            here.values[x] = kind.make(mp.mpf(k))
            result = result + inner(here) if is_sum else result * inner(here)
            if not is_whole and not (is_sum and kind.sign(result) == 0):
                raise Undefined("a sum whose ends are no whole numbers")
        return result

    return total


def _whole(x: Mpf) -> int:
    nearest = int(mp.nint(x))
    if abs(x - nearest) > SETTLED * max(1, abs(x)):
        raise Undefined("the end of a sum is no whole number")
    return nearest


def _infinite_sum(f: Expr, m: Symbol, start: Expr, kind: Kind) -> Term:
    """Σ over m >= start of a sum of c m^-p cos(θ m)."""
    halved = f.replace(sympy.sin(_ANY) ** 2, (1 - sympy.cos(2 * _ANY)) / 2)
    parts: list[tuple[Term, Term, Term]] = []
    expanded = sympy.expand(halved)
    for part in sympy.Add.make_args(expanded) if expanded != 0 else ():
        c, depends = part.as_independent(m, as_Add=False)
        power, theta = power_and_wave(depends, m)
        parts.append((compiled(c, kind), compiled(power, kind), compiled(theta, kind)))
    low = compiled(start, kind)

    def total(at: Point) -> Number:
        first = _whole(kind.read(low(at)))
        numbers = [tuple(kind.read(u(at)) for u in part) for part in parts]
        sums = _added(
            [(c, lambda p=p, t=t: polylogarithm(-p, t, first)) for c, p, t in numbers if c]
        )
        return kind.make(mp.fsum(sums))

    return total


def _added(parts: Sequence[tuple[Number, Callable[[], Number]]]) -> list[Number]:
    """Products c f(); where more than one f() diverges, their sum may not."""
    products: list[Number] = []
    divergent: list[Undefined] = []
    for c, f in parts:
        try:
            products.append(c * f())
        except Undefined as error:
            divergent.append(error)
    if len(divergent) > 1:
        raise Undecided("parts that diverge, and may cancel")
    if divergent:
        raise divergent[0]
    return products


def _outside(e: Expr) -> Expr:
    """An integral with the factors that do not depend on its symbol before it."""
    f, x, a, b = opened(e)
    c, depends = (_outside(f) if isinstance(f, sympy.Integral) else f).as_independent(
        x, as_Add=False
    )
    return c * sympy.Integral(depends, (x, a, b))


def _integral(e: Expr, kind: Kind) -> Term:
    whole = _outside(e)
    if not isinstance(whole, sympy.Integral):
        return compiled(whole, kind)
    f, x, a, b = opened(whole)
    sums = powers(f, x)
    low, high = (compiled(u, kind) if u not in (sympy.oo, -sympy.oo) else None for u in (a, b))
    if sums is None:
        if low is None or high is None:
            raise Undecided("no closed form of an integral to infinity")
        if not kind.is_plain and has_quadrature(f):
            raise Undecided("an integral of an integral may have two scales")
        return _between_numbers(compiled(f, kind), x, low, high, kind)
    if low is None:
        raise Undecided("an integral from −∞")
    terms = [(compiled(c, kind), compiled(k, kind)) for c, k in sums]

    def total(at: Point) -> Number:
        ends = low(at), None if high is None else high(at)
        numbers = [(c(at), kind.read(k(at))) for c, k in terms]
        parts = [(c, k) for c, k in numbers if kind.sign(c) != 0]
        result = kind.make(mp.mpf(0))
        for part in _added([(c, lambda k=k: power_integral(k, *ends, kind)) for c, k in parts]):
            result = result + part
        return result

    return total


def _between_numbers(f: Term, x: Symbol, low: Term, high: Term, kind: Kind) -> Term:
    def total(at: Point) -> Number:
        here = at.within(x, None)

        def inner(number: Number) -> Number:
            here.values[x] = number
            return f(here)

        return quadrature(inner, kind.read(low(at)), kind.read(high(at)), kind)

    return total
