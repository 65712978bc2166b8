"""Orders of convergence N^-a (log N)^q, their product, comparison and sum.

Orders form a commutative monoid under the product, ordered by dominance: N^-a (log N)^q
dominates N^-a' (log N)^q' where it is the larger of the two as N → ∞, that is a < a', or a = a'
and q ≥ q'. A sum of orders keeps every term that no other dominates, because with symbols in the
exponents the winner may not be known term by term: 3/2 against 1 + 1/(d − 3) flips at d = 5, yet
a cross-block 1 dominates both.

The paper writes Var(I_N) < O(.) (errata: read =); an order here is two-sided, Θ.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise

from .errors import UndecidedSign
from .signs import Assumptions, Sign, sign_changes, sign_of
from .symbolic import Expr, Integer, Symbol, sympy


@dataclass(frozen=True)
class Order:
    """N^-exponent (log N)^log_power; exponent ``oo`` is faster than every power.

    Parameters
    ----------
    exponent : sympy.Expr
        Exact; may hold symbols such as d.
    log_power : sympy.Expr
        Exact. ``KroneckerDelta(2, d)`` is a logarithm that stands at d = 2 only.
    """

    exponent: Expr
    log_power: Expr = Integer(0)

    def __post_init__(self) -> None:
        object.__setattr__(
            self, "exponent", _partial_fractions(sympy.sympify(self.exponent, strict=True))
        )
        log = (
            Integer(0) if self.exponent is sympy.oo else sympy.sympify(self.log_power, strict=True)
        )
        object.__setattr__(self, "log_power", log)

    def __mul__(self, other: "Order") -> "Order":
        return Order(self.exponent + other.exponent, self.log_power + other.log_power)

    def __str__(self) -> str:
        if self.exponent is sympy.oo:
            return "0"
        power = "1" if self.exponent == 0 else f"N^{_power_text(self.exponent)}"
        if self.log_power == 0:
            return power
        return f"{power} {_log_text(self.log_power)}"

    def latex(self) -> str:
        r"""Body of \mathcal{O}(...), as in the paper's Eqs. 24-27."""
        if self.exponent is sympy.oo:
            return "0"
        power = "1" if self.exponent == 0 else f"N^{{{_latex_negated(self.exponent)}}}"
        if self.log_power == 0:
            return power
        if self.log_power == 1:
            return rf"{power}\log N"
        if isinstance(self.log_power, sympy.KroneckerDelta):
            return rf"{power}(\log N)^{{[{_latex_tie(self.log_power)}]}}"
        return rf"{power}(\log N)^{{{sympy.latex(self.log_power)}}}"


def _partial_fractions(exponent: Expr) -> Expr:
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


CONSTANT = Order(Integer(0))
"""The neutral order, N^0."""


def _negated_terms(exponent: Expr) -> list[Expr]:
    """The terms of −exponent, the plain number first, as the paper writes N^(-1-2/d)."""
    terms = sorted(sympy.Add.make_args(exponent), key=lambda t: (not t.is_number, str(t)))
    return [-t for t in terms]


def _power_text(exponent: Expr) -> str:
    terms = _negated_terms(exponent)
    if len(terms) == 1:
        return str(terms[0]) if terms[0].is_Integer or terms[0].is_Symbol else f"({terms[0]})"
    text = " + ".join(str(t) for t in terms)
    return f"({text.replace('+ -', '- ')})"


def _latex_negated(exponent: Expr) -> str:
    parts = [sympy.latex(t) for t in _negated_terms(exponent)]
    parts = ["-" + p[2:] if p.startswith("- ") else p for p in parts]
    return "".join(p if i == 0 or p.startswith("-") else f"+{p}" for i, p in enumerate(parts))


def _tie_sides(delta: Expr) -> tuple[Expr, Expr]:
    """The two sides of a Kronecker delta, the symbol first."""
    first, second = delta.args
    return (second, first) if second.is_Symbol and not first.is_Symbol else (first, second)


def _latex_tie(delta: Expr) -> str:
    return "=".join(sympy.latex(side) for side in _tie_sides(delta))


def _log_text(power: Expr) -> str:
    if isinstance(power, sympy.KroneckerDelta):
        return "(log N if {} = {})".format(*_tie_sides(power))
    if power == 1:
        return "log N"
    return f"(log N)^{power}" if power.is_Integer or power.is_Symbol else f"(log N)^({power})"


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
    lower = next(r.lower for r in assumptions if r.symbol == free)
    return _split(kept, free, lower, sorted({r for c in changes if c for r in c[1]}))


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
