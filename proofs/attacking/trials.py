"""Trials of claims: a claim evaluated at random points by mpmath, without any of the kernel.

A trial holds, fails or is undecided. One that fails refutes the claim, as a claim says that both
sides have values, and how they are related, wherever its hypotheses hold; one that holds proves
nothing; one that is undecided does not count. Numbers are compared with 30 digits, with 100 where
30 do not tell or tell that the claim is false, and with 300 before it is said to fail. Limits and
orders are read off the first monomial of a series in N (`growth_series.py`), not off values at
large N, so that a difference of exponents of 0.01, or a factor log N, is seen for what it is.
"""

import random
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from ...numerics.integrands.protocol import Mpf, mp
from ...theory.symbolic import sympy
from ..trusted.claims import ASYMPTOTIC, Claim
from . import growth_series as growth
from .trial_points import NoPoint, grown, point
from .trial_values import Point, has_quadrature, series, value
from .undecided import Undecided, Undefined

__all__ = ["Point", "Trial", "Undecided", "Undefined", "refuted", "trial", "trials", "value"]

Verdict = Literal["holds", "fails", "undecided"]

_DIGITS, _MORE_DIGITS, _MOST_DIGITS = 30, 100, 300
_CLEAR = mp.mpf("1e-12")
"""A gap, over the size of the sides or 1, that is no rounding at 30 digits."""

_SAME = mp.mpf("1e-18")
"""A gap over the size of the sides that makes them equal at 30 digits."""

_EQUAL, _IDENTICAL = mp.mpf("1e-60"), mp.mpf("1e-250")
"""A gap, over the size of the sides or 1, that makes them equal at 100 digits, and at 300."""

_BY_QUADRATURE, _AT_ALL = mp.mpf("1e-8"), mp.mpf("1e-14")
"""What quadrature tells: it has settled to 10^-20 of the size of integrands."""


@dataclass(frozen=True)
class Trial:
    """What one point says of a claim.

    Parameters
    ----------
    verdict : {"holds", "fails", "undecided"}
    why : str
        Why it fails or is undecided.
    slack : float, optional
        Of a bound: (right − left) over the larger of their sizes.
    """

    verdict: Verdict
    why: str = ""
    slack: float | None = None


def refuted(claim: Claim, seed: int = 0, trials: int = 12) -> bool:
    """Whether one of some trials fails; a denial, that it fails somewhere, no trial can refute.

    Claims that differ have other points, lest the same few points miss what many mutants change.
    """
    if claim.false:
        return False
    rng = random.Random(f"{seed} {claim}")
    return any(_drawn_trial(claim, rng).verdict == "fails" for _ in range(trials))


def trials(claim: Claim, seed: int, count: int) -> Iterator[Trial]:
    """Trials at some points; undecided where no point is found."""
    rng = random.Random(seed)
    for _ in range(count):
        yield _drawn_trial(claim, rng)


def _drawn_trial(claim: Claim, rng: random.Random) -> Trial:
    try:
        at = point(claim, rng)
    except NoPoint:
        return Trial("undecided", "no point")
    return trial(claim, at)


def trial(claim: Claim, at: Point) -> Trial:
    """What a point at which the hypotheses hold says of a claim."""
    if claim.false:
        return Trial("undecided", "a denial")
    try:
        if claim.relation in ASYMPTOTIC:
            return _for_large(claim, at)
        return _by_numbers(claim, at)
    except Undefined as error:
        return Trial("fails", str(error))
    except (Undecided, NoPoint) as error:
        return Trial("undecided", str(error))


def _by_numbers(claim: Claim, at: Point) -> Trial:
    """With as many digits as it takes."""
    with mp.workdps(_DIGITS):
        left, right = _sides(claim, at)
        if has_quadrature(claim.left) or has_quadrature(claim.right):
            return _estimated(claim.relation, left, right)
        gap, size = right - left, max(abs(left), abs(right))
        if claim.relation == "=" and abs(gap) <= _SAME * size:
            return Trial("holds")
        is_right = claim.relation == "!=" or (claim.relation in ("<", "<=") and gap > 0)
        if is_right and abs(gap) > _CLEAR * max(1, size):
            return Trial("holds", slack=_slack(claim.relation, gap, size))
    return _by_more_digits(claim, at)


def _by_more_digits(claim: Claim, at: Point) -> Trial:
    """With 100 digits; with 300 before it is said that the claim fails."""
    relation = claim.relation
    with mp.workdps(_MORE_DIGITS):
        left, right = _sides(claim, at)
        gap, size = right - left, max(abs(left), abs(right))
        is_equal = abs(gap) <= _EQUAL * max(1, size)
        slack = _slack(relation, mp.mpf(0) if is_equal else gap, size)
        is_right = relation == "!=" or (relation in ("<", "<=") and gap > 0)
        if relation in ("=", "whole", "<=") if is_equal else is_right:
            return Trial("holds", slack=slack)
    with mp.workdps(_MOST_DIGITS):
        left, right = _sides(claim, at)
        finer = right - left
        if is_equal and abs(finer) > _IDENTICAL * max(1, size):
            is_right = relation == "!=" or finer > 0
            return Trial("holds" if is_right else "fails", _numbers(left, right), slack)
        if not is_equal and abs(finer - gap) > abs(gap) / 100:
            return Trial("undecided", "rounding at 100 digits")
    return Trial("fails", _numbers(left, right), slack)


def _sides(claim: Claim, at: Point) -> tuple[Mpf, Mpf]:
    """Both sides; for "whole", the left one and the whole number next to it."""
    left = value(claim.left, at)
    return left, mp.nint(left) if claim.relation == "whole" else value(claim.right, at)


def _estimated(relation: str, left: Mpf, right: Mpf) -> Trial:
    """What sides with integrals by quadrature tell."""
    gap, size = right - left, max(abs(left), abs(right))
    doubt, slack = _BY_QUADRATURE * size + _AT_ALL, _slack(relation, gap, size)
    if relation in ("=", "whole"):
        if abs(gap) > doubt:
            return Trial("fails", _numbers(left, right))
        is_seen = abs(gap) <= _CLEAR * size or size <= _AT_ALL
        return Trial("holds") if is_seen else Trial("undecided", "within the doubt of quadrature")
    if abs(gap) > doubt or (gap == 0 and relation == "<="):
        is_right = gap >= 0 or relation == "!="
        return Trial("holds" if is_right else "fails", _numbers(left, right), slack)
    return Trial("undecided", "within the doubt of quadrature")


def _slack(relation: str, gap: Mpf, size: Mpf) -> float | None:
    return float(gap / size) if relation in ("<", "<=") and size != 0 else None


def _numbers(left: Mpf, right: Mpf) -> str:
    return f"{mp.nstr(left, 8)} against {mp.nstr(right, 8)}"


def _for_large(claim: Claim, at: Point) -> Trial:
    """A limit or an order by the first monomials of both sides."""
    with mp.workdps(growth.DIGITS):
        large = grown(at)
        left = series(claim.left, large)
        if claim.relation == "->" and claim.right == sympy.oo:
            return _verdict(_is_infinite(left), left)
        right = series(claim.right, large)
        if claim.relation == "->":
            lead = (left + growth.constant(mp.mpf(-1)) * right).lead
            return _verdict(lead is None or growth.compared(lead.order, growth.STEADY) < 0, left)
        lead, other = left.lead, right.lead
        if lead is None or other is None:
            return _verdict(lead is None and (claim.relation == "O" or other is None), left)
        faster = growth.compared(lead.order, other.order)
        return _verdict(faster == 0 or (faster < 0 and claim.relation == "O"), left)


def _is_infinite(s: growth.Series) -> bool:
    lead = s.lead
    return lead is not None and lead.c > 0 and growth.compared(lead.order, growth.STEADY) > 0


def _verdict(is_right: bool, left: growth.Series) -> Trial:
    if is_right:
        return Trial("holds")
    lead = left.lead
    p, j, c = (mp.mpf(0),) * 3 if lead is None else (*lead.order, lead.c)
    return Trial("fails", f"{mp.nstr(c, 8)} N^{mp.nstr(p, 8)} (log N)^{mp.nstr(j, 8)}")
