"""The ledger: all entries re-checked, what was admitted, and what is refused."""

import io
import tokenize
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest
import specrate.proofs
import sympy
from specrate.proofs import ledger
from specrate.proofs.entries import appendix_b
from specrate.proofs.entry import Entry, Verdict, recheck
from specrate.proofs.theorems import radial
from specrate.proofs.theorems.radial import N, b, e
from specrate.proofs.trusted import reasons as by
from specrate.proofs.trusted.claims import Claim
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step, check

_NUMBERS = [entry.number for entry in ledger.ENTRIES]
_TRUSTED = Path(specrate.proofs.__path__[0]) / "trusted"


@cache
def verdict(number: int) -> Verdict:
    return recheck(ledger.ENTRIES[number])


@pytest.mark.parametrize(
    "number", range(len(ledger.ENTRIES)), ids=lambda k: ledger.ENTRIES[k].number
)
def test_entries_bear_their_status(number: int) -> None:
    assert verdict(number).axioms <= set(ledger.AXIOMS)


def test_little_is_admitted() -> None:
    admitted = [v for v in map(verdict, range(len(ledger.ENTRIES))) if v.admitted]
    assert len(admitted) <= 3
    assert len({entry.number for entry in ledger.ENTRIES}) == len(ledger.ENTRIES)


@pytest.mark.parametrize(
    "number", range(len(ledger.ENTRIES)), ids=lambda k: ledger.ENTRIES[k].number
)
def test_an_entry_is_refused_with_another_claim(number: int) -> None:
    entry = ledger.ENTRIES[number]
    if entry.holds is not None:
        with pytest.raises(Refused):
            recheck(replace(entry, holds=replace(entry.holds, right=sympy.Integer(7))))
    if entry.printed is not None:
        with pytest.raises(Refused):
            recheck(replace(entry, printed=replace(entry.printed, left=sympy.Integer(7))))


def test_a_status_without_its_proof_is_refused() -> None:
    entry = ledger.ENTRIES[0]
    with pytest.raises(Refused):
        recheck(replace(entry, proof=None, holds=None))
    with pytest.raises(Refused):
        recheck(Entry("0", "", "", "refuted"))
    with pytest.raises(Refused):
        recheck(replace(entry, status="admitted"))


_RATES = {case: radial.rate(case) for case in ("b>q", "b=q", "b<q")}
"""What an order may be proved from; the wrong ones must not follow from any of them."""


@pytest.mark.parametrize(
    "wrong",
    [appendix_b.EQ_48, appendix_b.EQ_50, appendix_b.EQ_50_RATE],
    ids=["48 as a rate", "50 at b = 1 as a bound", "50 at b = 1 as a rate"],
)
def test_wrong_rates_of_the_paper_are_refused(wrong: Claim) -> None:
    for found in _RATES.values():
        with pytest.raises(Refused):
            check(Step(wrong, by.Order(), (found,)))
    for case in ("b>q", "b=q", "b<q"):
        for constant in (sympy.Integer(1), radial.c2 * 10**6, radial.gamma / b):
            closed = radial.closed_form(case)
            with pytest.raises(Refused):
                check(Step(wrong, by.Order((constant,)), (closed,)))


def test_the_tie_needs_its_logarithm() -> None:
    right = radial.order("b=q").claim
    assert check(radial.order("b=q")).claim == right
    without = replace(right, right=N ** (-1 - e * b))
    with pytest.raises(Refused):
        check(Step(without, by.Order(), (radial.rate("b=q"),)))


def _lines_of_code(path: Path) -> int:
    text = path.read_text()
    skipped = (
        tokenize.COMMENT, tokenize.NL, tokenize.NEWLINE, tokenize.INDENT, tokenize.DEDENT,
        tokenize.ENDMARKER,
    )  # fmt: skip
    lines: set[int] = set()
    for t in tokenize.generate_tokens(io.StringIO(text).readline):
        is_docstring = t.type == tokenize.STRING and t.line.strip().startswith('"""')
        if t.type not in skipped and not is_docstring:
            lines |= set(range(t.start[0], t.end[0] + 1))
    return len(lines)


def test_the_rules_stay_small() -> None:
    assert _lines_of_code(_TRUSTED / "kernel.py") < 300
    assert sum(map(_lines_of_code, _TRUSTED.glob("*.py"))) < 900
