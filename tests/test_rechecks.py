"""Re-checks of the ledger: names of entries, refusals, interrupts, steps counted once."""

from dataclasses import replace

import pytest
import sympy
from specrate.proofs import ledger, prove
from specrate.proofs.entry import Entry
from specrate.proofs.rechecks import equation, identifier, proof_lines, selected
from specrate.proofs.theorems.tactics import real
from specrate.proofs.trusted import reasons as by
from specrate.proofs.trusted.claims import Claim
from specrate.proofs.trusted.kernel import Step
from specrate.theory.errors import InputError

x, y = real("x y")
TRUE = Claim(sympy.S.Zero, "<=", x**2)
FALSE = Claim(x**2, "<=", sympy.S.Zero)


def step(claim: Claim) -> Step:
    """A proof that right − left is a square."""
    return Step(claim, by.Combine((), x**2))


def entry(number: str, claim: Claim = TRUE) -> Entry:
    """An entry that is proved, or is said to be."""
    return Entry(number, "a square", "Section 1", "proved", claim, lambda: step(claim))


@pytest.mark.parametrize(
    ("number", "name", "about"),
    [
        ("25", "25", "25"),
        ("50, as a rate", "50-as-a-rate", "50"),
        ("15a", "15a", "15a"),
        ("33-36", "33-36", "33-36"),
        ("9, 10", "9-10", "9, 10"),
        ("6.1", "6.1", None),
        ("App. B", "app.-b", None),
        ("Table 1", "table-1", None),
        ("rate, b>q", "rate-b-gt-q", None),
        ("17, b=q", "17-b-eq-q", "17"),
    ],
)
def test_numbers_give_identifiers_and_equations(number: str, name: str, about: str | None) -> None:
    assert identifier(entry(number)) == name
    assert equation(entry(number)) == about


def test_identifiers_are_unique_and_plain() -> None:
    names = [identifier(e) for e in ledger.ENTRIES]
    assert len(set(names)) == len(names)
    assert all(set(name) <= set("abcdefghijklmnopqrstuvwxyz0123456789_.-") for name in names)


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> tuple[Entry, ...]:
    """A ledger of five entries, one of them wrong."""
    numbers = ("33-36", "50", "50, as a rate", "6.1")
    entries = (*map(entry, numbers), entry("7", FALSE))
    monkeypatch.setattr(ledger, "ENTRIES", entries)
    return entries


@pytest.mark.parametrize(
    ("names", "places"),
    [
        ((), (0, 1, 2, 3, 4)),
        (("50",), (1, 2)),
        (("(50)",), (1, 2)),
        (("Eq. 50",), (1, 2)),
        (("50, as a rate",), (2,)),
        (("50-AS-A-RATE",), (2,)),
        (("6.1", "34"), (0, 3)),
        (("33",), (0,)),
    ],
)
@pytest.mark.usefixtures("small")
def test_names_select(names: tuple[str, ...], places: tuple[int, ...]) -> None:
    assert selected(names) == places


@pytest.mark.parametrize("name", ["5", "37", "6", "", "rate", "__import__"])
@pytest.mark.usefixtures("small")
def test_unknown_names_are_refused(name: str) -> None:
    with pytest.raises(InputError, match="must be an id or equation of the ledger: got"):
        prove([name])


def test_no_jobs_are_refused() -> None:
    with pytest.raises(InputError, match="jobs must be at least 1: got 0"):
        prove(jobs=0)


def test_a_refused_entry_is_told_among_the_others(small: tuple[Entry, ...]) -> None:
    found = prove()
    assert [r.entry for r in found.found] == list(small)
    assert [r.is_accepted for r in found.found] == [True] * 4 + [False]
    assert not found.is_accepted
    refused = found.found[-1]
    assert refused.refusal is not None
    assert refused.refusal.startswith("Refused: not zero")
    assert refused.steps == 0
    assert prove(["50"]).is_accepted


def test_what_cannot_be_built_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken() -> Step:
        raise ZeroDivisionError("no step")

    monkeypatch.setattr(ledger, "ENTRIES", (replace(entry("1"), proof=broken),))
    (only,) = prove().found
    assert only.refusal == "ZeroDivisionError: no step"


@pytest.mark.usefixtures("small")
def test_an_interrupt_keeps_what_was_finished() -> None:
    told: list[str] = []

    def stop(text: str) -> None:
        told.append(text)
        if len(told) == 2:
            raise KeyboardInterrupt

    found = prove(progress=stop)
    assert found.is_interrupted
    assert [r.entry.number for r in found.found] == ["33-36", "50"]
    assert told[0] == "1 of 5 entries: 33-36, proved"


def test_errata_are_the_refuted_and_the_corrected() -> None:
    found = prove(["48", "18"], errata=True)
    assert found.found
    assert {r.entry.status for r in found.found} <= {"refuted", "corrected"}
    assert "48" in [r.entry.number for r in found.found]


def test_processes_find_what_one_process_finds() -> None:
    alone, together = prove(["lhs", "6.1"]), prove(["lhs", "6.1"], jobs=2)
    assert [replace(r, seconds=0) for r in alone.found] == [
        replace(r, seconds=0) for r in together.found
    ]
    assert together.is_accepted


def test_steps_come_after_those_they_use_and_once() -> None:
    for place in selected(["48", "18"]):
        lines = proof_lines(ledger.ENTRIES[place])
        assert [line.number for line in lines] == list(range(1, len(lines) + 1))
        assert all(u < line.number for line in lines for u in line.uses)
        keys = [(line.claim, line.reason, line.uses) for line in lines]
        assert len(set(keys)) == len(keys)


def test_the_refutation_comes_after_the_proof() -> None:
    (wrong,) = [e for e in ledger.ENTRIES if e.number == "48"]
    lines = proof_lines(wrong)
    marks = [line.of_refutation for line in lines]
    assert marks == sorted(marks)
    assert lines[marks.index(True) - 1].claim == wrong.holds
    assert lines[-1].claim.false


def test_equal_steps_are_counted_once() -> None:
    twice = Step(
        Claim(sympy.S.Zero, "<=", 2 * x**2),
        by.Combine((sympy.S.One, sympy.S.One)),
        (step(TRUE), step(TRUE)),
    )
    double = Entry("1", "twice a square", "Section 1", "proved", twice.claim, lambda: twice)
    assert [line.uses for line in proof_lines(double)] == [(), (1, 1)]
