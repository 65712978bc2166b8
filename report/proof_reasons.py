"""Reasons in words: why a step of a proof holds, by the numbers of the steps that it uses."""

import re
from collections.abc import Iterator, Sequence

from ..proofs.rechecks import Line
from ..proofs.trusted import reasons as by
from ..theory.symbolic import Expr
from .claim_words import Prose, Shown, joined, values_of
from .formulas import Bracket, Formula, Word, related, term


def reason(line: Line, used: Sequence[Line], shown: Shown) -> Prose:
    """The reason of a step in words, which name all steps that it uses."""
    said = tuple(_worded(line, used, shown))
    numbers = re.findall(r"\((\d+)\)", "".join(p for p in said if isinstance(p, str)))
    missing = [u for u in used if str(u.number) not in numbers]
    return (*said, f"; with {_steps(missing)}") if missing else said


def _worded(line: Line, used: Sequence[Line], shown: Shown) -> Iterator[str | Formula]:
    all_of_them = _steps(used)
    match line.reason:
        case by.Given():
            yield "a hypothesis"
        case by.Combine(coefficients, remainder):
            yield from _combination(line, used, coefficients, remainder, shown)
        case by.Interval(depth):
            halved = f" over the whole range, halved {depth} times at most"
            yield "by ball arithmetic" + (halved if line.claim.gap.free_symbols else "")
        case by.Monotone(x, start):
            yield from (term(line.claim.right), " does not fall where ")
            yield from (related(term(x), ">", shown(start)), f", by {all_of_them}")
        case by.Antiderivative(big):
            yield from (shown(big), " has the integrand as its derivative")
        case by.Range(None):
            yield "one term, or none"
        case by.Range(at):
            yield from ("the range is cut after ", shown(at))
        case by.Linear():
            yield "constants and sums are drawn out"
        case by.Bind():
            yield f"term by term, by {all_of_them}"
        case by.Improper():
            yield f"so it is defined, as the limit {all_of_them}"
        case by.Induction(n, start):
            yield from ("induction on ", term(n), " from ", shown(start))
            yield f": {_steps(used[:1])} begins, {_steps(used[1:])} goes on"
        case by.Split(x, at):
            point = (related(term(x), sign, shown(at)) for sign in ("<", "=", ">"))
            parts = [(f"({u.number}) for ", p) for u, p in zip(used, point, strict=False)]
            yield from ("by cases: ", *joined(parts, ", "))
        case by.Instance(values):
            yield from _instance(used, values, shown)
        case _:
            yield from _limit_reason(line, used, shown)


def _limit_reason(line: Line, used: Sequence[Line], shown: Shown) -> Iterator[str | Formula]:
    """Reasons for limits and orders, denials, and what is not proved."""
    all_of_them = _steps(used)
    match line.reason:
        case by.Limit():
            yield "power by power, by the signs of the exponents"
        case by.Squeeze():
            yield _squeezed(used[::2], used[1::2])
        case by.Eventually():
            yield f"({used[0].number}), of which one hypothesis holds for all large "
            yield from (term(line.claim.along), f", by ({used[1].number})")
        case by.Order(()):
            yield f"the ratio has the limit {all_of_them}"
        case by.Order(constants):
            parts: list[Prose] = [(shown(k),) for k in constants]
            yield "bounded with the constants "
            yield from (*joined(parts, " and "), f", {all_of_them}")
        case by.Counterexample(values):
            there = values_of(values, shown)
            yield from (f"{all_of_them} denies it", *((" at ", *there) if there else ()))
        case by.Cite(axiom):
            yield f"{axiom.name}, cited: {axiom.source}"
        case by.Admit(why):
            yield f"admitted, not proved: {why}"
        case other:
            told = (type(other).__doc__ or type(other).__name__).split("\n")[0].rstrip(".")
            yield f"{told[0].lower()}{told[1:]}" + (f", by {all_of_them}" if used else "")


def _combination(
    line: Line, used: Sequence[Line], coefficients: Sequence[Expr], rest: Expr, shown: Shown
) -> Iterator[str | Formula]:
    """A sum of steps with their coefficients, and what is left over."""
    pairs = list(zip(coefficients, used, strict=False))
    added = sorted((p for p in pairs if p[0] != 0), key=lambda p: p[0] != 1)
    signs = [u for k, u in pairs if k == 0]
    if added:
        yield "by "
    for place, (k, u) in enumerate(added):
        negative = bool(k.as_coeff_Mul()[0].is_negative)
        yield (" − " if place else "−") if negative else " + " if place else ""
        size = -k if negative else k
        if size != 1:
            yield from (Bracket(shown(size)) if size.is_Add else shown(size), " · ")
        yield f"({u.number})"
    if rest != 0:
        sign = "≥" if line.claim.relation in ("<=", "<") else "≠"
        yield ", and " if added else "right minus left is "
        yield related(shown(rest), sign, Word("0", "number"))
    elif not added:
        yield "by algebra"
    if signs:
        yield f"; signs by {_steps(signs)}"


def _instance(
    used: Sequence[Line], values: Sequence[tuple[Expr, Expr]], shown: Shown
) -> Iterator[str | Formula]:
    yield f"({used[0].number})"
    if values:
        yield from (" at ", *values_of(values, shown))
    if used[1:]:
        yield f", which may be used by {_steps(used[1:])}"


def _steps(used: Sequence[Line]) -> str:
    """(3), (4) and (7)."""
    names = [f"({line.number})" for line in used]
    return " and ".join([", ".join(names[:-1]), names[-1]] if len(names) > 1 else names)


def _squeezed(bounds: Sequence[Line], limits: Sequence[Line]) -> str:
    if len(bounds) > 1:
        return f"between {_steps(bounds)}, which have the limits {_steps(limits)}"
    if bounds[0].claim.relation == "=":
        return f"by {_steps(bounds)} and the limit {_steps(limits)}"
    return f"by the bound {_steps(bounds)} and its limit {_steps(limits)}"
