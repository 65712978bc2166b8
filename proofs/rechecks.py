"""Re-checks: entries of the ledger run through the kernel, one by one, in the ledger's order."""

import re
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from ..numerics.interruptible_pools import results
from ..theory.errors import InputError
from . import ledger
from .entry import Entry, recheck
from .trusted.claims import Axiom, Claim
from .trusted.kernel import Step
from .trusted.reasons import Reason

Progress = Callable[[str], None]

_EQUATIONS = re.compile(r"(?:Eqs?\. )?(\d+[a-z]?(?:(?:, |[-–])\d+[a-z]?)*)(?![\w.])")
_SIGNS = {">": " gt ", "<": " lt ", "=": " eq ", "'": " prime "}


@dataclass(frozen=True)
class Recheck:
    """What the kernel said of one entry.

    Parameters
    ----------
    entry : Entry
    refusal : str, optional
        Why its proofs do not bear its status; None if they do.
    axioms : frozenset of Axiom
        Cited theorems on which it leans.
    admitted : frozenset of str
        What is admitted and not proved.
    steps : int
        Steps of its proofs, each once.
    seconds : float
        Time taken; a lemma that an earlier entry has proved in the same process costs nothing.
    """

    entry: Entry
    refusal: str | None
    axioms: frozenset[Axiom]
    admitted: frozenset[str]
    steps: int
    seconds: float

    @property
    def is_accepted(self) -> bool:
        """Whether the kernel accepts the entry's proofs, and they bear its status."""
        return self.refusal is None


@dataclass(frozen=True)
class Rechecks:
    """Entries that have been re-checked, in the order of the ledger.

    Parameters
    ----------
    found : tuple of Recheck
    is_interrupted : bool
        Whether the run was stopped before all entries asked for were checked.
    """

    found: tuple[Recheck, ...]
    is_interrupted: bool = False

    @property
    def is_accepted(self) -> bool:
        """Whether no entry was refused."""
        return all(r.is_accepted for r in self.found)


def prove(
    names: Sequence[str] = (),
    errata: bool = False,
    jobs: int = 1,
    progress: Progress | None = None,
) -> Rechecks:
    """Re-check entries of the ledger; Ctrl-C ends the run with what was finished.

    Parameters
    ----------
    names : sequence of str
        Ids, numbers or equations of the paper: "25", "(25)", "6.1", "table-1"; none: all entries.
    errata : bool
        Only what is refuted or corrected.
    jobs : int
        Processes, at least 1. With more than one a script needs ``if __name__ == "__main__"``.
    progress : callable, optional
        Told in a line what was checked, entry by entry.

    Returns
    -------
    Rechecks
        A refused entry is in it like any other, and says why it was refused.

    Raises
    ------
    InputError
        If a name is not in the ledger, or jobs < 1.
    """
    if jobs < 1:
        raise InputError(f"jobs must be at least 1: got {jobs}")
    wanted = [
        place
        for place in selected(names)
        if not errata or ledger.ENTRIES[place].status in ("refuted", "corrected")
    ]
    found: dict[int, Recheck] = {}
    is_interrupted = False
    run = _in_processes if jobs > 1 and len(wanted) > 1 else _here
    try:
        for place, one in run(wanted, jobs):
            found[place] = one
            if progress is not None:
                word = one.entry.status if one.is_accepted else "REFUSED"
                progress(f"{len(found)} of {len(wanted)} entries: {one.entry.number}, {word}")
    except KeyboardInterrupt:
        is_interrupted = True
    return Rechecks(tuple(found[place] for place in sorted(found)), is_interrupted)


def selected(names: Sequence[str]) -> tuple[int, ...]:
    """Places in the ledger of the entries that any of the names means, all if there is none."""
    entries = range(len(ledger.ENTRIES))
    if not names:
        return tuple(entries)
    chosen = set[int]()
    for name in names:
        meant = [place for place in entries if _is_called(ledger.ENTRIES[place], name)]
        if not meant:
            raise InputError(f"what is proved must be an id or equation of the ledger: got {name}")
        chosen.update(meant)
    return tuple(sorted(chosen))


def _is_called(entry: Entry, name: str) -> bool:
    plain = re.sub(r"^eqs?\.? *", "", name.strip(), flags=re.I).strip("()").casefold()
    own = (entry.number.casefold(), identifier(entry))
    return plain in own or name.casefold() in own or plain in _equations(entry)


def identifier(entry: Entry) -> str:
    """The entry's number without blanks and signs: "50-as-a-rate", "table-1", "rate-b-gt-q"."""
    text = entry.number.casefold()
    for sign, word in _SIGNS.items():
        text = text.replace(sign, word)
    return "-".join(re.findall(r"[\w.]+", text)).strip(".")


def equation(entry: Entry) -> str | None:
    """The paper's equation or equations, "50" or "33-36"; None if the entry is about none."""
    found = _EQUATIONS.match(entry.number)
    return found.group(1) if found else None


def _equations(entry: Entry) -> set[str]:
    """All equations meant, also those inside a range, and "15" for "15a"."""
    found = set[str]()
    for part in (equation(entry) or "").split(", "):
        if ends := re.findall(r"\d+", part):
            found |= {part, *(str(k) for k in range(int(ends[0]), int(ends[-1]) + 1))}
    return found


def _here(places: Sequence[int], _: int) -> Iterator[tuple[int, Recheck]]:
    for place in places:
        yield place, run(place)


def _in_processes(places: Sequence[int], jobs: int) -> Iterator[tuple[int, Recheck]]:
    """Re-checks as they end; at an interrupt those under way end too, and no others begin."""
    for place, outcome in results(_outcome, places, min(jobs, len(places))):
        yield place, Recheck(ledger.ENTRIES[place], *outcome)


def run(place: int) -> Recheck:
    """The re-check of the entry at a place of the ledger."""
    return Recheck(ledger.ENTRIES[place], *_outcome(place))


_Outcome = tuple[str | None, frozenset[Axiom], frozenset[str], int, float]


def _outcome(place: int) -> _Outcome:
    entry, began = ledger.ENTRIES[place], time.perf_counter()
    try:
        verdict = recheck(entry)
        count = len(proof_lines(entry))
    except Exception as error:  # whatever happens to it: a proof that cannot be run is no proof
        told = " ".join(f"{type(error).__name__}: {error}".split())
        return told, frozenset(), frozenset(), 0, time.perf_counter() - began
    return None, verdict.axioms, verdict.admitted, count, time.perf_counter() - began


@dataclass(frozen=True)
class Line:
    """A step of a proof as it is counted.

    Parameters
    ----------
    number : int
        From 1; a step comes after those it uses.
    claim : Claim
    reason : Reason
    uses : tuple of int
        Numbers of the steps it uses.
    of_refutation : bool
        Whether only the refutation needs it.
    """

    number: int
    claim: Claim
    reason: Reason
    uses: tuple[int, ...]
    of_refutation: bool


def proof_lines(entry: Entry) -> tuple[Line, ...]:
    """The steps of an entry's proof and then of its refutation, equal ones once."""
    known: dict[tuple[Claim, Reason, tuple[int, ...]], Line] = {}
    seen: dict[int, int] = {}
    kept: list[Step] = []  # so that no two steps have had one id

    def number(step: Step, of_refutation: bool) -> int:
        if id(step) not in seen:
            key = step.claim, step.reason, tuple(number(u, of_refutation) for u in step.uses)
            seen[id(step)] = known.setdefault(key, Line(len(known) + 1, *key, of_refutation)).number
            kept.append(step)
        return seen[id(step)]

    for build, of_refutation in ((entry.proof, False), (entry.refutation, True)):
        if build is not None:
            number(build(), of_refutation)
    return tuple(known.values())
