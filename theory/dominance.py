"""Dominance: which of two orders is larger as N → ∞, and what a sum of orders comes to.

N^-a (log N)^q dominates N^-a' (log N)^q' where it is the larger of the two, that is a < a', or
a = a' and q ≥ q'. A sum of orders keeps every term that no other dominates, because with symbols in
the exponents the winner may not be known term by term: 3/2 against 1 + 1/(d − 3) flips at d = 5,
yet a cross-block 1 dominates both. Only where more than one is left at the end is there a split
by cases, or an error that names the undecided sign.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

from .errors import UndecidedSign
from .orders import Order
from .signs import Assumptions, Sign, lower_bound, sign_changes, sign_of
from .symbolic import Expr, Symbol, sympy


def dominates(first: Order, second: Order, assumptions: Assumptions = ()) -> bool | None:
    """Whether the first order is at least as large as the second, as N → ∞.

    Returns
    -------
    bool or None
        None where the sign that decides it varies inside the assumptions.
    """
    faster = _exponent_gap(first, second, assumptions)
    if faster == "+":
        return True
    if faster in ("-", None):
        return False if faster == "-" else None
    logs = sign_of(first.log_power - second.log_power, ())
    if logs is None:
        logs = _sign_of_deltas(first.log_power, second.log_power)
    more_logs = logs in ("+", "0", ">=0")
    if faster == "0":
        return more_logs if logs is not None else None
    if faster == ">=0":  # larger, or equal for some values: then the logarithms decide
        return True if more_logs else None
    return None if more_logs or logs is None else False


def _exponent_gap(first: Order, second: Order, assumptions: Assumptions) -> Sign:
    """Sign of (second exponent − first exponent)."""
    if first.exponent == second.exponent:
        return "0"
    if second.exponent is sympy.oo:
        return "+"
    if first.exponent is sympy.oo:
        return "-"
    return sign_of(second.exponent - first.exponent, assumptions)


def _sign_of_deltas(first: Expr, second: Expr) -> Sign:
    """A Kronecker delta lies in [0, 1]: compare it with the numbers 0 and 1."""
    if first == second:
        return "0"
    if first.is_number and first >= 1:
        return ">=0"
    return ">=0" if second == 0 else "<=0" if first == 0 else None


def undominated(orders: Iterable[Order], assumptions: Assumptions = ()) -> tuple[Order, ...]:
    """The terms of a sum of orders that no other term dominates, each once."""
    kept: list[Order] = []
    for order in orders:
        if any(dominates(k, order, assumptions) for k in kept):
            continue
        kept = [k for k in kept if not dominates(order, k, assumptions)]
        kept.append(order)
    return tuple(kept)


def slowest(orders: Iterable[Order], assumptions: Assumptions = ()) -> Order:
    """The one order that dominates a sum.

    Raises
    ------
    UndecidedSign
        Where more than one term is left; the message names the sign that would decide.
    """
    kept = undominated(orders, assumptions)
    if len(kept) == 1:
        return kept[0]
    gap = kept[0].exponent - kept[1].exponent
    known = ", ".join(map(str, assumptions)) or "no assumptions"
    raise UndecidedSign(f"exponents must be comparable: the sign of {gap} varies for {known}")


@dataclass(frozen=True)
class Case:
    """An order and the condition on the symbols under which it holds (None: always)."""

    order: Order
    condition: Expr | None = None


def cases(orders: Iterable[Order], assumptions: Assumptions = ()) -> tuple[Case, ...]:
    """The dominating order of a sum, split by cases where the winner depends on one symbol.

    Raises
    ------
    UndecidedSign
        Where the winner depends on more than one symbol, or on one that has no range.
    """
    kept = undominated(orders, assumptions)
    if len(kept) == 1:
        return (Case(kept[0]),)
    gaps = [a.exponent - b.exponent for i, a in enumerate(kept) for b in kept[i + 1 :]]
    changes = [sign_changes(g, assumptions) for g in gaps]
    names = {c[0] for c in changes if c is not None}
    if None in changes or len(names) != 1:
        slowest(kept, assumptions)  # raises, naming the sign
    free = names.pop()
    return _split(
        kept, free, lower_bound(free, assumptions), sorted({r for c in changes if c for r in c[1]})
    )


def _split(
    kept: tuple[Order, ...], free: Symbol, lower: Expr, roots: list[Expr]
) -> tuple[Case, ...]:
    """One case below, between and above the roots; a root joins the side that agrees there."""
    between = [(a + b) / 2 for a, b in pairwise(roots)]
    found: list[Case] = []
    for i, at in enumerate([(lower + roots[0]) / 2, *between, roots[-1] + 1]):
        if i == 0 and roots[0] == lower:
            continue
        order = min(kept, key=lambda o: o.exponent.xreplace({free: at}))
        bounds = [free >= roots[i - 1]] if i > 0 else []
        bounds += [free <= roots[i]] if i < len(roots) else []
        found.append(Case(order, sympy.And(*bounds)))
    return tuple(found)
