"""Series Σ c N^p (log N)^j of terms in a growing N, by which a limit or an order shows at a point.

All symbols but N have values, so that a term built of powers, and of what is analytic where N → ∞,
is a finite sum of such monomials, or one with a known order of what is left out:

    (c N^p (log N)^j (1 + ε))^r = c^r N^(pr) (log N)^(jr) Σ_i C(r, i) ε^i,   ε → 0,

and likewise log, exp, sin and cos by their Taylor series. The first monomial decides, however
slowly the others die out: no size of N is looked at. Exponents of drawn values are rationals with
small denominators, and two that differ by less than 10^-15 are the same; a coefficient that is less
than 10^-30 of its parts is 0, and one up to 10^-15 of them is not told apart from 0.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from ...numerics.integrands.protocol import Mpf, mp
from .undecided import Undecided, Undefined

Order: TypeAlias = tuple[Mpf, Mpf]
"""p, j of N^p (log N)^j; the larger one grows faster."""

DIGITS = 60
_SAME, _LOST, _DOUBTFUL = mp.mpf("1e-15"), mp.mpf("1e-30"), mp.mpf("1e-15")
_TAYLOR = 8
"""Powers of a small part that are kept."""

_MOST = 30
"""Monomials that are kept."""

STEADY: Order = (mp.mpf(0), mp.mpf(0))


@dataclass(frozen=True)
class Monomial:
    """c N^p (log N)^j, and the sum of the sizes of what c was added up from."""

    order: Order
    c: Mpf
    size: Mpf


@dataclass(frozen=True)
class Series:
    """Monomials, the fastest first, and the order of what is left out; none if nothing is."""

    monomials: tuple[Monomial, ...]
    cut: Order | None = None

    def __add__(self, other: "Series") -> "Series":
        return _collected((*self.monomials, *other.monomials), _larger(self.cut, other.cut))

    def __mul__(self, other: "Series") -> "Series":
        if self.is_single and other.is_single:
            (a,), (b,) = self.monomials, other.monomials
            return Series((Monomial(_times(a.order, b.order), a.c * b.c, a.size * b.size),))
        products = [
            Monomial(_times(a.order, b.order), a.c * b.c, a.size * b.size)
            for a in self.monomials
            for b in other.monomials
        ]
        ends = [
            _times(cut, first)
            for cut, first in ((self.cut, other.first), (other.cut, self.first))
            if cut is not None and first is not None
        ]
        cut = None
        for end in ends:
            cut = _larger(cut, end)
        return _collected(products, cut)

    @property
    def is_single(self) -> bool:
        """Whether the series is one monomial, and nothing is left out."""
        return self.cut is None and len(self.monomials) == 1

    @property
    def first(self) -> Order | None:
        """The order of the series; None if it is 0."""
        return self.monomials[0].order if self.monomials else self.cut

    @property
    def lead(self) -> Monomial | None:
        """The monomial that decides; None if the series is 0.

        Raises
        ------
        Undecided
            If what is left out may be larger.
        """
        if not self.monomials:
            if self.cut is not None:
                raise Undecided("nothing is left of a series but what was cut off")
            return None
        lead = self.monomials[0]
        if self.cut is not None and not compared(lead.order, self.cut) > 0:
            raise Undecided("what was cut off a series may lead it")
        return lead


def compared(a: Order, b: Order) -> int:
    """1 if N^p (log N)^j of a grows faster than that of b, 0 if as fast, -1 if slower."""
    for x, y in zip(a, b, strict=True):
        if abs(x - y) > _SAME:
            return 1 if x > y else -1
    return 0


def constant(c: Mpf) -> Series:
    """c."""
    return Series((Monomial(STEADY, c, abs(c)),)) if c != 0 else Series(())


def growing() -> Series:
    """N."""
    return Series((Monomial((mp.mpf(1), mp.mpf(0)), mp.mpf(1), mp.mpf(1)),))


def value_of(s: Series) -> Mpf:
    """The number that a series is.

    Raises
    ------
    Undecided
        If it depends on N.
    """
    if not s.monomials and s.cut is None:
        return mp.mpf(0)
    if len(s.monomials) == 1 and s.cut is None and not compared(s.monomials[0].order, STEADY):
        return s.monomials[0].c
    raise Undecided("a number was needed where N grows")


def sign(s: Series) -> int:
    """The sign for large N."""
    lead = s.lead
    return 0 if lead is None else (1 if lead.c > 0 else -1)


def lead_alike(s: Series, t: Series) -> bool:
    """Whether the first monomials are the same, to 15 digits."""
    a, b = s.lead, t.lead
    if a is None or b is None:
        return a is b
    return not compared(a.order, b.order) and abs(a.c - b.c) <= _SAME * abs(a.c)


def power(base: Series, exponent: Series) -> Series:
    """base^exponent."""
    if len(exponent.monomials) > 1 or exponent.cut is not None:
        return exp(exponent * log(base))
    if exponent.monomials and compared(exponent.monomials[0].order, STEADY):
        return exp(exponent * log(base))
    r, lead = value_of(exponent), base.lead
    if lead is None:
        if r < 0:
            raise Undefined("1/0")
        return constant(mp.mpf(int(r == 0)))
    whole = abs(r - mp.nint(r)) < _SAME
    if lead.c < 0 and not whole:
        raise Undefined("a power that is not real")
    raised = lead.c ** (int(mp.nint(r)) if whole else r)
    p, j = lead.order
    first = Series((Monomial((p * r, j * r), raised, abs(raised)),))
    if base.is_single:
        return first
    small = _small_part(base, lead)
    return first * _taylor(small, lambda i: mp.binomial(r, i), int(r) if whole and r > 0 else None)


def log(s: Series) -> Series:
    """log of a series without a power of log N in front."""
    lead = s.lead
    if lead is None or lead.c < 0:
        raise Undefined("the logarithm of no positive number")
    p, j = lead.order
    if abs(j) > _SAME:
        raise Undecided("log log N")
    order = (mp.mpf(0), mp.mpf(1))
    slope = Series((Monomial(order, p, abs(p)),)) if p != 0 else Series(())
    rest = _taylor(_small_part(s, lead), lambda i: mp.mpf(-1) ** (i + 1) / i if i else mp.mpf(0))
    return slope + constant(mp.log(lead.c)) + rest


def exp(s: Series) -> Series:
    """exp of a series that grows no faster than log N."""
    fixed, small = mp.mpf(0), Series((), s.cut)
    raised = mp.mpf(0)
    for m in s.monomials:
        against = compared(m.order, STEADY)
        if against > 0 and compared(m.order, (mp.mpf(0), mp.mpf(1))):
            raise Undecided("exponential growth")
        if against > 0:
            raised = m.c
        elif against == 0:
            fixed = m.c
        else:
            small = small + Series((m,))
    rest = _taylor(small, lambda i: 1 / mp.factorial(i))
    c = mp.exp(fixed)
    return Series((Monomial((raised, mp.mpf(0)), c, c),)) * rest


def sine(s: Series) -> Series:
    """sin of a series that does not grow."""
    fixed, small = _fixed_and_small(s)
    return _wave((mp.sin(fixed), mp.cos(fixed)), small)


def cosine(s: Series) -> Series:
    """cos of a series that does not grow."""
    fixed, small = _fixed_and_small(s)
    return _wave((mp.cos(fixed), -mp.sin(fixed)), small)


def sinc(s: Series) -> Series:
    """sin(x)/x of a series that does not grow."""
    fixed, small = _fixed_and_small(s)
    if fixed != 0:
        return sine(s) * power(s, constant(mp.mpf(-1)))
    return _taylor(
        small,
        lambda i: mp.mpf(0) if i % 2 else mp.mpf(-1) ** (i // 2) / mp.factorial(i + 1),
    )


def elsewhere(name: str) -> Callable[..., Series]:
    """A function that is known at numbers alone."""

    def applied(*parts: Series) -> Series:
        return constant(getattr(mp, name)(*map(value_of, parts)))

    return applied


def _wave(slopes: tuple[Mpf, Mpf], small: Series) -> Series:
    """Σ_i f^(i) small^i / i! of an f with f'' = −f, from f and f'."""
    return _taylor(small, lambda i: mp.mpf(-1) ** (i // 2) * slopes[i % 2] / mp.factorial(i))


def _fixed_and_small(s: Series) -> tuple[Mpf, Series]:
    if s.first is not None and compared(s.first, STEADY) > 0:
        raise Undecided("a wave of a growing argument")
    if s.monomials and not compared(s.monomials[0].order, STEADY):
        return s.monomials[0].c, Series(s.monomials[1:], s.cut)
    return mp.mpf(0), s


def _small_part(s: Series, lead: Monomial) -> Series:
    """ε of s = lead (1 + ε)."""
    over = Series((Monomial((-lead.order[0], -lead.order[1]), 1 / lead.c, 1 / abs(lead.c)),))
    return Series(s.monomials[1:], s.cut) * over


def _taylor(small: Series, coefficient: Callable[[int], Mpf], degree: int | None = None) -> Series:
    """Σ_i coefficient(i) small^i, cut off after some powers unless it ends before."""
    first, start = small.first, constant(coefficient(0))
    if first is None:
        return start
    last = _TAYLOR if degree is None or degree > _TAYLOR else degree
    cut = None if last == degree else (first[0] * (last + 1), first[1] * (last + 1))
    monomials, raised = list(start.monomials), constant(mp.mpf(1))
    for i in range(1, last + 1):
        raised, c = raised * small, coefficient(i)
        cut = _larger(cut, raised.cut) if c != 0 else cut
        monomials += [Monomial(m.order, c * m.c, abs(c) * m.size) for m in raised.monomials if c]
    return _collected(monomials, cut)


def _times(a: Order, b: Order) -> Order:
    return a[0] + b[0], a[1] + b[1]


def _larger(a: Order | None, b: Order | None) -> Order | None:
    if a is None or b is None:
        return b if a is None else a
    return a if compared(a, b) >= 0 else b


def _collected(monomials: Sequence[Monomial], cut: Order | None) -> Series:
    """Monomials of one order added, what is 0 dropped, and what lies below the cut."""
    there: list[Monomial] = []
    for of_one_power in _alike(monomials, 0):
        for group in _alike(of_one_power, 1):
            c, size = mp.fsum(m.c for m in group), mp.fsum(m.size for m in group)
            if abs(c) > _LOST * size and (cut is None or compared(group[0].order, cut) > 0):
                there.append(Monomial(group[0].order, c, size))
                if abs(c) <= _DOUBTFUL * size:
                    raise Undecided("a coefficient that may be 0")
    if len(there) > _MOST:
        cut, there = there[_MOST].order, there[:_MOST]
    return Series(tuple(there), cut)


def _alike(monomials: Sequence[Monomial], place: int) -> Iterator[list[Monomial]]:
    """Monomials of one power of N, or of log N, together, the largest power first."""
    group: list[Monomial] = []
    for m in sorted(monomials, key=lambda m: m.order[place], reverse=True):
        if group and group[0].order[place] - m.order[place] > _SAME:
            yield group
            group = []
        group.append(m)
    if group:
        yield group
