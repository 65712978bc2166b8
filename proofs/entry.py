"""Entries of the ledger: an equation or claim of the paper, as printed and as it holds, with proof.

A status says what became of the printed statement:

    proved       it holds as printed; ``proof`` proves it.
    corrected    it is false or says too little; ``proof`` proves ``holds``, ``refutation`` denies
                 ``printed`` where it is false.
    refuted      it is false and nothing stands in its place; ``refutation`` denies it.
    admitted     ``proof`` rests on what is admitted, not proved.
    definition   it defines; ``proof`` proves what a definition needs (that it scales alike on both
                 sides, or a normalisation).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal

from .trusted.claims import Axiom, Claim
from .trusted.grammar import require
from .trusted.kernel import Step, Theorem, check

Status = Literal["proved", "corrected", "refuted", "admitted", "definition"]


@dataclass(frozen=True)
class Entry:
    """One statement.

    Parameters
    ----------
    number : str
        As the paper numbers it, "25", "15a", "Table 1", "6.1", "App. B"; a theorem beyond the
        paper has a name.
    title : str
        What it says, in a line.
    source : str
        Where it stands.
    status : Status
    holds : Claim, optional
        What is true.
    proof : callable, optional
        The proof of ``holds``.
    printed : Claim, optional
        The statement as printed, where a relation of terms can say it.
    as_printed : str
        The same in the paper's notation.
    refutation : callable, optional
        The proof that ``printed`` is false.
    notes : str
        What was wrong, and why the correction is the right one.
    """

    number: str
    title: str
    source: str
    status: Status
    holds: Claim | None = None
    proof: Callable[[], Step] | None = None
    printed: Claim | None = None
    as_printed: str = ""
    refutation: Callable[[], Step] | None = None
    notes: str = ""


def proved(
    number: str, title: str, source: str, proof: Callable[[], Step],
    notes: str = "", as_printed: str = "",
) -> Entry:  # fmt: skip
    """What holds as printed, or beyond the paper: the claim of its proof."""
    holds = proof().claim
    return Entry(number, title, source, "proved", holds, proof, as_printed=as_printed, notes=notes)


@dataclass(frozen=True)
class Verdict:
    """An entry with the theorems that bear it.

    Parameters
    ----------
    entry : Entry
    proof, refutation : Theorem, optional
        Of ``holds``, and of the denial of ``printed``.
    """

    entry: Entry
    proof: Theorem | None
    refutation: Theorem | None

    @property
    def axioms(self) -> frozenset[Axiom]:
        """Cited theorems on which the entry leans."""
        found = (t.axioms for t in (self.proof, self.refutation) if t)
        return frozenset[Axiom]().union(*found)

    @property
    def admitted(self) -> frozenset[str]:
        """What was admitted."""
        found = (t.admitted for t in (self.proof, self.refutation) if t)
        return frozenset[str]().union(*found)


def recheck(entry: Entry) -> Verdict:
    """The entry's proofs, run through the kernel.

    Raises
    ------
    Refused
        If a proof fails, proves another claim, or does not bear the status.
    """
    proof = check(entry.proof()) if entry.proof else None
    refutation = check(entry.refutation()) if entry.refutation else None
    require((proof.claim if proof else None) == entry.holds, "proves another claim", entry.number)
    if refutation is not None:
        require(entry.printed is not None, "what is refuted must be printed", entry.number)
        denied = replace(refutation.claim, false=False)
        require(refutation.claim.false and denied == entry.printed, "denies another", entry.number)
    verdict = Verdict(entry, proof, refutation)
    needed = {
        "proved": proof is not None and refutation is None,
        "corrected": proof is not None,
        "refuted": refutation is not None,
        "admitted": bool(verdict.admitted),
        "definition": proof is not None,
    }
    require(needed[entry.status], "status without its proof", entry.number)
    honest = (entry.status == "admitted") == bool(verdict.admitted)
    require(honest, "admitted and not said so", entry.number)
    return verdict
