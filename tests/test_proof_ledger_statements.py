"""What the ledger says of its entries: model or sampler, what was printed, and what is denied."""

import re
from collections import defaultdict
from dataclasses import replace

import pytest
from specrate.proofs.entry import Entry
from specrate.proofs.ledger import ENTRIES
from specrate.proofs.model import IN_MODEL, of_model, says_so
from specrate.proofs.theorems import (
    homogenisation,
    multi_jitter_spectra,
    point_rates,
    radial,
    single_direction,
    stratified_spectra,
)
from specrate.proofs.trusted.claims import Claim

_READING = re.compile(r"as a rate|[Rr]ead as|\bhence\b|, at [a-zνρ] =|[Dd]enied")
"""Words of a reader, which no quotation has."""
_ASYMPTOTIC = ("O", "Theta", "->")


def _entry(claim: Claim) -> Entry:
    return Entry("0", "", "", "proved", claim)


def test_the_model_is_told_from_samplers_by_what_is_integrated() -> None:
    for of_the_model in (radial.order("b=q"), radial.closed_form("b<q"), point_rates.flat_order()):
        assert of_model(_entry(of_the_model.claim))
    for other in (
        homogenisation.shifted(), single_direction.each_direction(), stratified_spectra.jitter(),
        multi_jitter_spectra.on_an_axis(),
    ):  # fmt: skip
        assert not of_model(_entry(other.claim))


def test_what_is_of_the_model_says_so_and_nothing_else_does() -> None:
    found = [e for e in ENTRIES if of_model(e)]
    assert len(found) > 60
    assert [e.number for e in found if not says_so(e)] == []
    assert [e.number for e in ENTRIES if says_so(e) and not of_model(e)] == []
    assert not says_so(replace(found[0], title="multi-jitter: Θ(N^−2)", notes=""))


def test_a_title_that_names_a_sampler_has_the_model_in_it() -> None:
    samplers = re.compile(r"jitter|[Ll]atin|lines|segments|flats|disk|ball")
    named = [e for e in ENTRIES if of_model(e) and samplers.search(e.title)]
    assert len(named) >= 20
    assert [e.number for e in named if IN_MODEL not in e.title] == []


@pytest.mark.parametrize("status", ["corrected", "refuted"])
def test_what_is_wrong_is_denied_or_is_notation(status: str) -> None:
    found = [e for e in ENTRIES if e.status == status]
    assert found
    silent = [e for e in found if e.refutation is None and "wrong is notation" not in e.notes]
    assert [e.number for e in silent] == []


def test_what_is_denied_is_quoted_and_its_reading_is_in_the_notes() -> None:
    denied = [e for e in ENTRIES if e.printed is not None]
    assert len(denied) > 60
    assert [e.number for e in denied if not e.as_printed] == []
    assert [e.number for e in ENTRIES if _READING.search(e.as_printed)] == []
    rates = [e for e in denied if e.printed is not None and e.printed.relation == "Theta"]
    assert [e.number for e in rates if "ead as" not in e.notes] == []


def test_the_title_of_what_is_refuted_denies_it() -> None:
    refuted = [e for e in ENTRIES if e.status == "refuted"]
    assert [e.number for e in refuted if not re.search(r"\bnot\b", e.title)] == []
    assert [e.number for e in refuted if e.holds is not None] == []


def test_what_is_denied_twice_says_where_else() -> None:
    groups: dict[Claim, list[Entry]] = defaultdict(list)
    for e in ENTRIES:
        if e.printed is not None:
            groups[e.printed].append(e)
    twice = [g for g in groups.values() if len(g) > 1]
    assert twice
    for group in twice:
        others = [e for e in group if not _names_another(e, group)]
        assert len(others) <= 1, [e.number for e in group]


def _names_another(e: Entry, group: list[Entry]) -> bool:
    names = (re.escape(o.number) for o in group if o is not e)
    return any(re.search(rf"(?<![\w.]){name}(?!\w)", e.notes) for name in names)


def test_what_holds_as_printed_is_no_claim_that_is_denied() -> None:
    denied = {e.printed for e in ENTRIES if e.printed is not None}
    assert [e.number for e in ENTRIES if e.holds is not None and e.holds in denied] == []


def test_numbers_are_unique_and_claims_are_there() -> None:
    assert len({e.number for e in ENTRIES}) == len(ENTRIES)
    assert all(e.title and e.source for e in ENTRIES)
    orders = [e for e in ENTRIES if e.holds is not None and e.holds.relation in _ASYMPTOTIC]
    assert all(e.holds is not None and e.holds.along is not None for e in orders)
