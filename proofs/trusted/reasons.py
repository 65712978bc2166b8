"""Reasons: what a step of a proof may give for its claim, a closed list.

Each is data: which rule, and what the rule cannot find by itself. What is needed besides are the
steps used. The rules stand in ``kernel.py``.
"""

from dataclasses import dataclass
from typing import Any, TypeAlias

from ...theory.symbolic import Expr, Symbol, sympy
from .claims import Axiom, Claim


@dataclass(frozen=True)
class Given:
    """The claim is one of its hypotheses, at the values of its quantified symbols."""


@dataclass(frozen=True)
class Combine:
    """right − left = Σ coefficient · (right − left of a used step) + remainder, the last >= 0."""

    coefficients: tuple[Expr, ...] = ()
    remainder: Expr = sympy.S.Zero


@dataclass(frozen=True)
class Interval:
    """Balls over the whole box of the hypotheses, halved up to ``depth`` times."""

    depth: int = 12


@dataclass(frozen=True)
class Monotone:
    """f(start) <= f(x), right = f(x), as the step used says 0 <= f'(x) for start < x."""

    symbol: Symbol
    start: Expr


@dataclass(frozen=True)
class Antiderivative:
    """∫_a^b f = F(b) − F(a), since F' = f."""

    antiderivative: Expr


@dataclass(frozen=True)
class Range:
    """∫_a^b = ∫_a^c + ∫_c^b; sums and products to c and from c + 1; without c, one term or none."""

    at: Expr | None = None


@dataclass(frozen=True)
class Linear:
    """A sum or integral of Σ c f is Σ c times the sum or integral of f; pairs (c, f)."""

    parts: tuple[tuple[Expr, Expr], ...]


@dataclass(frozen=True)
class Bind:
    """From f <= g (or =) in the range to the same of their sums, products or integrals."""


@dataclass(frozen=True)
class Improper:
    """A sum or integral to infinity, or from 0 of an integrand that is open there, is a limit."""


@dataclass(frozen=True)
class Induction:
    """For whole n >= start: at the start, and from n to n + 1."""

    symbol: Symbol
    start: Expr


@dataclass(frozen=True)
class Split:
    """The steps used hold for x < a, at x = a, and for a < x; whole x − a is then <= −1, >= 1."""

    symbol: Symbol
    at: Expr


@dataclass(frozen=True)
class Instance:
    """The step used at other values; its hypotheses hold there, by the other steps where needed."""

    values: tuple[tuple[Any, Expr], ...]


@dataclass(frozen=True)
class Limit:
    """left = Σ c exp(r N) N^k (log N)^j; for a limit oo the first of the terms leads."""

    terms: tuple[tuple[Expr, Expr, Expr, int], ...]


@dataclass(frozen=True)
class Squeeze:
    """Bounds of the left side (or one equation), each followed by its limit."""


@dataclass(frozen=True)
class Eventually:
    """A hypothesis on N that holds for all large N is dropped: its gap grows to infinity."""


@dataclass(frozen=True)
class Order:
    """O or Theta: from the limit of left/right, or from bounds c·right with the constants c."""

    constants: tuple[Expr, ...] = ()


@dataclass(frozen=True)
class Counterexample:
    """The claim is false at these values."""

    values: tuple[tuple[Symbol, Expr], ...]


@dataclass(frozen=True)
class Cite:
    """A cited theorem."""

    axiom: Axiom


@dataclass(frozen=True)
class Admit:
    """Not proved, and counted."""

    why: str


Reason: TypeAlias = (
    Given | Combine | Interval | Monotone | Antiderivative | Range | Linear | Bind | Improper
    | Induction | Split | Instance | Limit | Squeeze | Eventually | Order
    | Counterexample | Cite | Admit
)  # fmt: skip


@dataclass(frozen=True, eq=False)
class Step:
    """A claim, the reason for it, and the steps that the reason uses, in its order."""

    claim: Claim
    reason: Reason
    uses: tuple["Step", ...] = ()
