"""Claims in words and formulas: relations, hypotheses of one kind together, values of symbols."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeAlias

from ..proofs.trusted.claims import Claim
from ..theory.symbolic import Expr, sympy
from .formulas import Bracket, Formula, Word, related, row, term

Prose: TypeAlias = tuple[str | Formula, ...]
"""Words and formulas in their order; words end and begin with blanks where there are any."""

Shown: TypeAlias = Callable[[Expr], Formula]
"""How terms are laid out, long ones by their names."""

_SIGNS = {"=": "=", "<=": "≤", "<": "<", "!=": "≠", "->": "→"}
_TURNED = {"<=": "≥", "<": ">"}


def statement(c: Claim, shown: Shown = term) -> Prose:
    """The relation, without its hypotheses."""
    grows: Prose = (" as ", related(term(c.along), "→", Word("∞", "letter"))) if c.along else ()
    denied: Prose = ("it is false that ",) if c.false else ()
    match c.relation:
        case "whole":
            return (*denied, shown(c.left), " is whole")
        case "O" | "Theta":
            sign = Word({"O": "O", "Theta": "Θ"}[c.relation], "letter")
            return (
                *denied,
                related(shown(c.left), "=", row(sign, Bracket(shown(c.right)))),
                *grows,
            )
        case _:
            sides = related(shown(c.left), _SIGNS[c.relation], shown(c.right))
            return (*denied, sides, *grows)


def hypotheses(given: Sequence[Claim], shown: Shown = term) -> Prose:
    """Hypotheses, those of one kind together: b, q > 0; N, m whole; 0 ≤ k ≤ N − 1."""
    plain = [h for h in given if not h.over and not h.given]
    whole = [h.left for h in plain if h.relation == "whole"]
    positive = [h.right for h in plain if h.relation == "<" and h.left == 0]
    parts: list[Prose] = []
    if whole:
        parts.append((listed([shown(e) for e in whole]), " whole"))
    if positive:
        named = listed([shown(e) for e in positive])
        parts.append((related(named, ">", Word("0", "number")),))
    said = [h for h in plain if h.relation == "whole" or (h.relation == "<" and h.left == 0)]
    parts += _chains([h for h in plain if h not in said], shown)
    quantified: dict[tuple[object, ...], list[Claim]] = {}
    for h in given:
        if h.over or h.given:
            quantified.setdefault((h.over, h.given), []).append(h)
    parts += [_for_all(group, shown) for group in quantified.values()]
    return joined(parts, ", ")


def _chains(left: list[Claim], shown: Shown) -> list[Prose]:
    """Relations, a <= x and x <= b as one, and a number on the right of what it bounds."""
    parts: list[Prose] = []
    while left:
        h = left.pop(0)
        chained = next((o for o in left if _continues(h, o)), None)
        if chained is not None:
            left.remove(chained)
            first = related(shown(h.left), _SIGNS[h.relation], shown(h.right))
            parts.append((related(first, _SIGNS[chained.relation], shown(chained.right)),))
        elif h.relation in _TURNED and h.left.is_number and not h.right.is_number:
            parts.append((related(shown(h.right), _TURNED[h.relation], shown(h.left)),))
        else:
            parts.append(statement(h, shown))
    return parts


def _continues(h: Claim, other: Claim) -> bool:
    return other.left == h.right and {h.relation, other.relation} <= {"<", "<="}


def _for_all(group: Sequence[Claim], shown: Shown) -> Prose:
    """Hypotheses for all values of the same symbols: 0 ≤ a_i ≤ 1 for all whole i ≥ 1."""
    over, under = group[0].over, group[0].given
    body = hypotheses([replace(h, given=(), over=()) for h in group], shown)
    whole = [g for g in under if g.relation == "whole" and g.left in over]
    kept = [g for g in under if g not in whole]
    word = " for all whole " if len(whole) == len(over) else " for all "
    condition = hypotheses(kept, shown)
    is_bound = len(over) == len(kept) == 1 and kept[0].right == over[0] and kept[0].left.is_number
    if is_bound or not over:
        return (*body, word if over else " if ", *condition)
    return (
        *body,
        word,
        listed([shown(x) for x in over]),
        *((" with ", *condition) if kept else ()),
    )


def listed(parts: Sequence[Formula]) -> Formula:
    """Formulas with commas between them."""
    found: list[Formula] = []
    for p in parts:
        found += [*([Word(",", "mark")] if found else []), p]
    return row(*found)


def joined(parts: Sequence[Prose], between: str) -> Prose:
    """Prose with words between."""
    found: list[str | Formula] = []
    for p in parts:
        found += [*([between] if found else []), *p]
    return tuple(found)


def values_of(values: Sequence[tuple[Expr, Expr]], shown: Shown) -> Prose:
    """Values given to symbols, equal ones together: b = 2, q = s = 1."""
    groups: dict[Expr, list[Formula]] = {}
    for key, value in values:
        is_function = isinstance(value, sympy.Lambda)
        name = term(key(*value.variables)) if is_function else term(key)
        groups.setdefault(value, []).append(name)
    parts: list[Prose] = []
    for value, keys in groups.items():
        body = value.expr if isinstance(value, sympy.Lambda) else value
        equal = keys[0]
        for k in keys[1:]:
            equal = related(equal, "=", k)
        parts.append((related(equal, "=", shown(body)),))
    return joined(parts, ", ")
