"""Mutants of proofs: one exponent, constant, relation or hypothesis of a step changed.

A mutant keeps the reason and the steps used, so that it is a proof that someone might have written
by mistake. Some mutants say what is true; whether one is false is for ``trials.py`` to find.
"""

from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, cast

from ...theory.symbolic import Expr, sympy
from ..trusted.claims import Claim
from ..trusted.kernel import Step


@dataclass(frozen=True)
class Mutant:
    """A changed step, and what was changed."""

    step: Step
    change: str


def steps_of(root: Step) -> tuple[Step, ...]:
    """A proof's steps, each once."""
    found: dict[Step, None] = {}
    stack = [root]
    while stack:
        step = stack.pop()
        if step not in found:
            found[step] = None
            stack += step.uses
    return tuple(found)


def mutants(step: Step) -> Iterator[Mutant]:
    """Mutants of one step: of its claim, and of claim and reason together."""
    c = step.claim
    for changed, what in _claims(c):
        yield Mutant(replace(step, claim=changed), what)
    for old in sorted(_numbers(c.left) | _numbers(c.right), key=str):
        for new in (old + 1, -old, old / 2):
            if new != old:
                together = _replaced(step.reason, old, new)
                sides = [s.xreplace({old: new}) for s in (c.left, c.right)]
                claim = replace(c, left=sides[0], right=sides[1])
                what = f"{old} to {new} everywhere"
                yield Mutant(replace(step, claim=claim, reason=together), what)


def _claims(c: Claim) -> Iterator[tuple[Claim, str]]:
    for side in ("left", "right"):
        for term, what in _terms(getattr(c, side)):
            yield replace(c, **{side: term}), f"{side}: {what}"
    for h in c.given:
        yield replace(c, given=tuple(g for g in c.given if g != h)), f"without {h}"
        if h.relation in ("<", "<=") and h.left != 0 and not h.over:
            turned = replace(h, left=h.right, right=h.left)
            given = tuple(turned if g == h else g for g in c.given)
            yield replace(c, given=given), f"{turned} instead of {h}"
    yield from _relations(c)


def _relations(c: Claim) -> Iterator[tuple[Claim, str]]:
    turned = replace(c, left=c.right, right=c.left)
    if c.relation in ("<=", "<"):
        yield turned, "turned"
        yield replace(c, relation="="), "= instead of a bound"
    if c.relation == "=":
        yield replace(c, relation="<"), "< instead of ="
        yield replace(turned, relation="<"), "> instead of ="
    if c.relation == "->":
        for right in (sympy.S.Zero, sympy.S.One, sympy.oo):
            if right != c.right:
                yield replace(c, right=right), f"limit {right}"
    if c.relation in ("O", "Theta"):
        assert c.along is not None
        for factor in (1 / sympy.log(c.along), 1 / c.along, sympy.log(c.along)):
            yield replace(c, right=c.right * factor), f"order times {factor}"
    if c.relation == "O":
        yield replace(c, relation="Theta"), "Theta instead of O"


def _terms(e: Expr) -> Iterator[tuple[Expr, str]]:
    """e with one number, exponent or symbol changed."""
    if e in (sympy.oo, sympy.S.Zero):
        return
    yield 2 * e, "twice"
    yield -e, "negative"
    for old in sorted(_numbers(e), key=str):
        for new in (old + 1, old - 1, old / 2, -old):
            if new != old:
                yield e.xreplace({old: new}), f"{old} to {new}"
    for p in sorted(e.atoms(sympy.Pow), key=str):
        for exponent in (p.exp + 1, p.exp - 1, 2 * p.exp, -p.exp):
            yield e.xreplace({p: p.base**exponent}), f"{p} to the {exponent}"
    symbols = sorted(e.free_symbols, key=str)
    for x in symbols:
        for y in symbols:
            if x != y:
                yield e.xreplace({x: y}), f"{x} to {y}"


def _numbers(e: Expr) -> set[Expr]:
    """Rational numbers of a term."""
    return {r for r in e.atoms(sympy.Rational) if r != 0}


def _replaced(reason: Any, old: Expr, new: Expr) -> Any:
    """A reason with one number changed wherever it stands."""
    if isinstance(reason, sympy.Basic):
        return reason.xreplace({old: new})
    if isinstance(reason, tuple):
        return tuple(_replaced(part, old, new) for part in cast(tuple[Any, ...], reason))
    if is_dataclass(reason) and not isinstance(reason, (Claim, type)):
        parts = {f.name: _replaced(getattr(reason, f.name), old, new) for f in fields(reason)}
        return replace(reason, **parts)
    return reason
