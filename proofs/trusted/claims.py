"""Claims: what a theorem says, a relation of two terms under hypotheses.

A claim is true for all values of its free symbols that its hypotheses allow; both sides are then
defined. Improper integrals and sums to infinity are limits of proper ones. ``left -> right`` along
N is the limit as N grows over the values that the hypotheses allow; O and Theta likewise.
"""

from dataclasses import dataclass, replace
from typing import Any, Literal, get_args

from ...theory.symbolic import Expr, Symbol, sympy
from .grammar import bound, require, substituted, well_formed

Relation = Literal["=", "<=", "<", "!=", "whole", "->", "O", "Theta"]
_class: Any = type
ASYMPTOTIC: tuple[Relation, ...] = ("->", "O", "Theta")


@dataclass(frozen=True)
class Claim:
    """A statement: for all that ``given`` allows, left relation right.

    Parameters
    ----------
    left, right : sympy.Expr
        ``right`` is of no meaning for "whole"; it may be ``oo`` for "->".
    relation : Relation
    given : tuple of Claim
        Hypotheses. One with ``over`` is itself said for all values of these symbols.
    along : sympy.Symbol, optional
        What tends to infinity in "->", "O" and "Theta".
    false : bool
        The statement denied: it fails for some values.
    """

    left: Expr
    relation: Relation
    right: Expr = sympy.S.Zero
    given: tuple["Claim", ...] = ()
    along: Symbol | None = None
    over: tuple[Symbol, ...] = ()
    false: bool = False

    def __str__(self) -> str:
        words = (
            f"{self.left} whole"
            if self.relation == "whole"
            else (f"{self.left} {self.relation} {self.right}")
        )
        words = f"not ({words})" if self.false else words
        words += f" as {self.along} grows" if self.along is not None else ""
        given = ", ".join(f"({h})" if h.given else str(h) for h in self.given)
        return f"{words} given {given}" if given else words

    @property
    def gap(self) -> Expr:
        """right − left, which is 0, or not negative."""
        return self.right - self.left

    @property
    def free(self) -> set[Symbol]:
        """Free symbols of both sides and of the hypotheses."""
        own: set[Symbol] = {*self.left.free_symbols, *self.right.free_symbols}
        return own.union(*(h.free for h in self.given)).difference(self.over)

    def at(self, *values: tuple[Any, Expr]) -> "Claim":
        """The claim at other values of its symbols and undefined functions."""
        pairs = tuple((k, v) for k, v in values if k not in self.over)
        caught = {s for _, v in pairs for s in v.free_symbols} & {*self.over, self.along}
        require(not caught, "would be caught", caught)
        require(self.along not in [k for k, _ in pairs], "grows", self.along)
        sides = substituted(self.left, pairs), substituted(self.right, pairs)
        given = tuple(h.at(*pairs) for h in self.given)
        return replace(self, left=sides[0], right=sides[1], given=given)


def require_grammar(c: Claim) -> None:
    """Require that the terms of a claim and of its hypotheses, none denied, are in the grammar."""
    own = type(c) is Claim and type(c.given) is type(c.over) is tuple and type(c.relation) is str
    require(own and type(c.false) is bool, "no claim", c)
    named = (*c.over, *(() if c.along is None else (c.along,)))
    require(all(well_formed(s) and s.is_Symbol for s in named), "no symbols", named)
    infinite = c.right == sympy.oo and c.relation == "->"
    require(well_formed(c.left) and (infinite or well_formed(c.right)), "no term", c)
    require(c.relation in get_args(Relation), "no relation", c.relation)
    caught = (bound(c.left) | bound(c.right)) & c.free
    require(not caught, "both bound and free", caught)
    for h in c.given:
        require(not h.false, "a denial is no hypothesis", h)
        require_grammar(h)


def require_fixed(part: Any) -> None:
    """Require that what is listed, at any depth, is the same whenever it is asked for."""
    cls = _class(part)
    require(cls is tuple or not issubclass(cls, (tuple, list)), "no tuple", part)
    for p in part if cls is tuple else ():
        require_fixed(p)


@dataclass(frozen=True)
class Axiom:
    """A theorem of the literature, cited and not proved."""

    name: str
    claim: Claim
    source: str
