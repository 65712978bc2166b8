"""Proofs as a mathematician reads them: claims, hypotheses and reasons as words and formulas.

A term that is long and comes back in a proof gets a name, V = ∫ ..., of which the reader is told
first. Hypotheses of one kind are said together, b, q > 0. A step is told under the hypotheses of
the statement; if it needs others, under these, and if it needs fewer, under its own. Steps that
only read something off (a hypothesis, one term of a sum) are marked as trivial.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import groupby

from ..proofs.entry import Entry
from ..proofs.rechecks import Line, proof_lines
from ..proofs.trusted import reasons as by
from ..proofs.trusted.claims import Claim
from ..theory.symbolic import Expr, Symbol, sympy
from .claim_words import Prose, Shown, hypotheses, joined, statement, values_of
from .formulas import Formula, related, symbol, term
from .proof_reasons import reason

_BINDERS = (sympy.Sum, sympy.Product, sympy.Integral)
_LONG, _OFTEN, _MOST = 30, 3, 3
_TOO_LONG = 60


@dataclass(frozen=True)
class Passage:
    """A step as it is read.

    Parameters
    ----------
    number : int
    claim, reason : Prose
    given : Prose
        Hypotheses beyond those of the statement, or all of its own if it needs fewer; empty if it
        has those of the statement.
    uses : tuple of int
        Numbers of the steps that it uses.
    proves : Claim
        The claim as the kernel knows it.
    is_trivial : bool
    is_of_refutation : bool
    """

    number: int
    claim: Prose
    given: Prose
    reason: Prose
    uses: tuple[int, ...]
    proves: Claim
    is_trivial: bool
    is_of_refutation: bool


@dataclass(frozen=True)
class Reading:
    """An entry as it is read.

    Parameters
    ----------
    holds, printed : Prose
        The true statement and the printed one; empty if there is none.
    given, printed_given : Prose
        Hypotheses of the two.
    names : tuple of Formula
        Definitions of names for the longest terms, which the statements use too.
    short_names : tuple of Formula
        Definitions of names that only the proofs use.
    passages : tuple of Passage
    witness : Prose
        Where the printed statement fails; empty if it is not denied.
    """

    holds: Prose
    given: Prose
    printed: Prose
    printed_given: Prose
    names: tuple[Formula, ...]
    short_names: tuple[Formula, ...]
    passages: tuple[Passage, ...]
    witness: Prose


def read(entry: Entry) -> Reading:
    """The entry's statements and proofs."""
    lines = proof_lines(entry)
    stated = [c for c in (entry.holds, entry.printed) if c is not None]
    named = _named([*stated, *(line.claim for line in lines)])

    def shown(e: Expr) -> Formula:
        return term(e.xreplace(named))

    very_long = {e: v for e, v in named.items() if _size(e) >= _TOO_LONG}

    def stated_as(e: Expr) -> Formula:
        return term(e.xreplace(very_long))

    def said(c: Claim | None) -> tuple[Prose, Prose]:
        return ((), ()) if c is None else (statement(c, stated_as), hypotheses(c.given))

    passages = tuple(_passage(line, lines, entry, shown) for line in lines)
    short = {e: v for e, v in named.items() if e not in very_long}
    witness = _witness(lines, stated_as) if entry.refutation else ()
    statements = (*said(entry.holds), *said(entry.printed))
    return Reading(*statements, _defined(very_long), _defined(short), passages, witness)


def _defined(names: dict[Expr, Symbol]) -> tuple[Formula, ...]:
    return tuple(related(symbol(v.name), "=", term(e)) for e, v in names.items())


def _named(claims: Sequence[Claim]) -> dict[Expr, Symbol]:
    """Long sums and integrals that come back, and a letter for each."""
    sides = [side for c in claims for side in (c.left, c.right)]
    bound = {x for e in sides for b in e.atoms(*_BINDERS) for x, *_ in b.limits}
    taken = {x.name for e in sides for x in e.atoms(sympy.Symbol)}
    taken |= {f.func.__name__ for e in sides for f in e.atoms(sympy.core.function.AppliedUndef)}
    found: dict[Expr, Symbol] = {}
    known: dict[Expr, tuple[int, bool, frozenset[Symbol]]] = {}
    while len(found) < _MOST:
        counts: dict[Expr, int] = {}
        for side in sides:
            parts: set[Expr] = set()
            _weigh(side.xreplace(found), known, parts)
            for part in parts:
                counts[part] = counts.get(part, 0) + 1
        gains = {
            e: (count - 1) * size
            for e, count in counts.items()
            if count >= _OFTEN and (size := known[e][0]) >= _LONG
            if known[e][1] and not known[e][2] & bound
        }
        if not gains:
            break
        best = max(gains, key=lambda e: (gains[e], str(e)))
        letters = "VWUABCDEFG" if best.has(sympy.Integral) else "ABCDEFGVWU"
        letter = next(x for x in letters if x not in taken)
        found[best] = sympy.Symbol(letter, real=True)
        taken.add(letter)
    return found


def _weigh(
    e: Expr, known: dict[Expr, tuple[int, bool, frozenset[Symbol]]], parts: set[Expr]
) -> None:
    """Size, whether a sum or integral is in it, and free symbols, of a term and its parts."""
    if e in parts:
        return
    for part in e.args:
        _weigh(part, known, parts)
    parts.add(e)
    if e not in known:
        inner = [known[part] for part in e.args]
        is_binder = isinstance(e, _BINDERS)
        own = e.free_symbols if e.is_Symbol or is_binder else ()
        free = frozenset(own).union(*(i[2] for i in inner if not is_binder))
        known[e] = 1 + sum(i[0] for i in inner), is_binder or any(i[1] for i in inner), free


def _size(e: Expr) -> int:
    return sum(1 for _ in sympy.preorder_traversal(e))


def _passage(line: Line, lines: Sequence[Line], entry: Entry, shown: Shown) -> Passage:
    main = entry.printed if line.of_refutation and entry.holds is None else entry.holds
    assumed = main.given if main is not None else ()
    own = line.claim.given
    extra = tuple(h for h in own if h not in assumed)
    given = hypotheses(extra if set(assumed) <= set(own) else own, shown)
    if not own and assumed:
        given = ("no hypotheses",)
    used = tuple(lines[u - 1] for u in line.uses)
    return Passage(
        line.number,
        statement(line.claim, shown),
        given if not isinstance(line.reason, by.Counterexample) else (),
        reason(line, used, shown),
        line.uses,
        line.claim,
        _is_trivial(line, used),
        line.of_refutation,
    )


def _is_trivial(line: Line, used: Sequence[Line]) -> bool:
    match line.reason:
        case by.Given() | by.Range(None) | by.Linear(()):
            return True
        case by.Instance(()):
            return True
        case by.Combine(coefficients) if len(used) <= 1 and line.claim.relation in ("<=", "<"):
            same = used and used[0].claim.relation == line.claim.relation and coefficients == (1,)
            return bool(same) and _sides(used[0].claim) == _sides(line.claim)
        case _:
            return False


def _sides(c: Claim) -> Expr:
    return sympy.expand(c.gap)


def _witness(lines: Sequence[Line], shown: Shown) -> Prose:
    """The values at which the printed statement fails, and what holds there."""
    last = lines[-1]
    if not isinstance(last.reason, by.Counterexample):
        return ()
    values = values_of(last.reason.values, shown)
    facts = [statement(lines[u - 1].claim, shown) for u in last.uses]
    there: Prose = ("at ", *values, ": ") if values else ()
    return (*there, *joined(facts, "; "))


def proof_parts(reading: Reading) -> list[tuple[str, tuple[Passage, ...]]]:
    """The proof and the refutation, whichever there are."""
    proof = tuple(p for p in reading.passages if not p.is_of_refutation)
    refutation = tuple(p for p in reading.passages if p.is_of_refutation)
    both = (("Proof", proof), ("Refutation of what was printed", refutation))
    return [(name, chosen) for name, chosen in both if chosen]


def runs(passages: Sequence[Passage]) -> list[tuple[Prose | None, bool, list[Passage]]]:
    """Runs of steps that are trivial or not; hypotheses where they differ from those before."""
    found: list[tuple[Prose | None, bool, list[Passage]]] = []
    given: Prose = ()
    for (under, trivial), group in groupby(passages, key=_context):
        found.append((None if trivial or under == given else under, trivial, list(group)))
        given = given if trivial else under
    return found


def _context(p: Passage) -> tuple[Prose, bool]:
    """Hypotheses of a step, which a trivial one does not change."""
    return () if p.is_trivial else p.given, p.is_trivial


def without_repeats(reading: Reading, name: str, shown: dict[Claim, str]) -> Reading:
    """The reading without steps that an earlier entry has shown, and what only they need.

    Parameters
    ----------
    reading : Reading
    name : str
        What the entry is called.
    shown : dict of Claim to str
        Where each claim has been shown; those that this entry shows are added.
    """
    passages = {p.number: p for p in reading.passages}
    ends = {part[-1].number for _, part in proof_parts(reading)}
    kept: dict[int, Passage] = {}
    left = sorted(ends)
    while left:
        number = left.pop()
        if number not in kept:
            p = passages[number]
            place = None if p.is_trivial else shown.get(p.proves)
            kept[number] = p if place is None else replace(p, reason=(place,), uses=())
            left += kept[number].uses
    for number in sorted(kept):
        shown.setdefault(kept[number].proves, f"step {number} of {name}")
    return replace(reading, passages=tuple(kept[number] for number in sorted(kept)))
