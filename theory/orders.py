"""Orders of convergence N^-a (log N)^q, their product, and how they are written.

Orders form a commutative monoid under the product; ``dominance.py`` compares and adds them.

The paper writes Var(I_N) < O(.) (errata: read =); an order here is two-sided, Θ.
"""

from dataclasses import dataclass

from .expressions import partial_fractions
from .symbolic import Expr, Integer, sympy


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
            self, "exponent", partial_fractions(sympy.sympify(self.exponent, strict=True))
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
