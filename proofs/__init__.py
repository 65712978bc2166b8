"""Machine-checked statements about the paper: a small kernel, proofs, and the ledger.

Trusted is the folder ``trusted/``: ``kernel.py``, the rules, and what decides for them. Everything
else finds steps (``theorems/``), states what they prove (``entries/``) or tries to refute it by
numbers (``attacking/``), and a mistake there cannot make a theorem.

To add an entry:

1. State it. A ``Claim`` is left, relation, right, hypotheses ``given``, and for limits and orders
   the symbol ``along`` that grows. Symbols are real (``tactics.real``); that b is positive or n is
   whole is a hypothesis (``tactics.positive``, ``tactics.whole``). A hypothesis on a function says
   ``over`` which symbols it is meant for all of, as 0 <= a(i) for all whole i >= 1.
2. Prove it by a tree of ``Step(claim, reason, uses)``; the reasons are in ``trusted/reasons.py``.
   ``Combine`` adds equations and inequalities with coefficients, the remainder a visible sum of
   squares; ``Monotone`` and ``Antiderivative`` are calculus; ``Range``, ``Linear``, ``Bind`` and
   ``Improper`` handle sums and integrals; ``Limit``, ``Squeeze``, ``Eventually``, ``Order`` handle
   N → ∞. Steps used may have fewer hypotheses, or ones that are seen to hold. If a sign is not
   seen, prove it as a step and use it with coefficient 0. Functions that build steps are cached,
   so that a step is checked once.
3. A refutation proves a claim that contradicts the printed one at numbers (``<`` for a failed
   ``<=``, a limit 0 or ∞ of left/right for an order), and gives it to ``Counterexample``.
4. Put an ``Entry`` (``entry.py``) into the file of its section in ``entries/``; ``ledger.py`` lists
   the files. ``entry.recheck`` runs the proofs and holds them against the status.

A definition is checked by a claim on it: both sides scale alike when frequencies or values are
multiplied, or the weights sum to 1. A cited theorem is an ``Axiom`` in ``ledger.AXIOMS``.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .rechecks import prove

__all__ = ["prove"]

_DOORS = {"prove": ".rechecks"}


def __getattr__(name: str) -> Any:
    """Load a door's module when it is first used: the ledger brings SymPy with it."""
    if name not in _DOORS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_DOORS[name], __name__), name)
