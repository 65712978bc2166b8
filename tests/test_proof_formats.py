"""Re-checked entries printed: terminal, JSON by its schema, LaTeX that compiles, a page alone."""

import json
import re
import shutil
import subprocess
from collections.abc import Iterator
from copy import deepcopy
from html.parser import HTMLParser
from importlib.resources import files
from pathlib import Path
from typing import Any, cast
from xml.etree import ElementTree

import jsonschema
import pytest
import sympy
from specrate.proofs import ledger, prove
from specrate.proofs.entry import Entry
from specrate.proofs.rechecks import Recheck, Rechecks, run
from specrate.proofs.theorems.tactics import positive, real, whole
from specrate.proofs.trusted import reasons as by
from specrate.proofs.trusted.claims import Claim
from specrate.proofs.trusted.kernel import Step
from specrate.report.claim_words import hypotheses, statement
from specrate.report.cli import main
from specrate.report.formula_prose import latex_text, pieces
from specrate.report.proof_formats import HEAD, document, render, text
from specrate.report.proof_reading import read, without_repeats

from tests.latex import check_structure

b, k, i, d, x, N = real("b k i d x N")
a = sympy.Function("a")
NAMES = ("5", "48", "50", "50, as a rate", "6.1", "18", "18, from below")
SCHEMA = json.loads((files("specrate.report") / "schemas" / "prove.json").read_text("utf-8"))


@pytest.fixture(scope="module")
def found() -> Rechecks:
    """Entries of each kind of step: sums, products, orders, and refutations."""
    places = [k for k, e in enumerate(ledger.ENTRIES) if e.number in NAMES]
    assert len(places) == len(NAMES)
    return Rechecks(tuple(run(place) for place in places))


@pytest.fixture
def two(monkeypatch: pytest.MonkeyPatch) -> None:
    """A ledger of two entries."""
    kept = tuple(e for e in ledger.ENTRIES if e.number in ("48", "6.1"))
    monkeypatch.setattr(ledger, "ENTRIES", tuple(sorted(kept, key=lambda e: e.number)))


@pytest.fixture
def wrong(monkeypatch: pytest.MonkeyPatch) -> Rechecks:
    """A ledger of one entry that the kernel refuses."""
    claim = Claim(x**2, "<=", sympy.S.Zero)
    entry = Entry(
        "7", "no square is > 0", "Section 1", "proved", claim, lambda: Step(claim, by.Combine())
    )
    monkeypatch.setattr(ledger, "ENTRIES", (entry,))
    return prove()


# Words


def test_hypotheses_of_one_kind_are_said_together() -> None:
    one, zero = sympy.S.One, sympy.S.Zero
    every = (Claim(i, "whole"), Claim(one, "<=", i))
    given = (
        *positive(b, d), *whole(N, k), Claim(zero, "<=", k), Claim(k, "<=", N - 1),
        Claim(one, "<", N), Claim(zero, "<=", a(i), every, over=(i,)),
        Claim(a(i), "<=", one, every, over=(i,)),
    )  # fmt: skip
    assert text(hypotheses(given)) == (
        "N, k whole, b, d > 0, 0 ≤ k ≤ N − 1, N > 1, 0 ≤ a_i ≤ 1 for all whole i ≥ 1"
    )


def test_claims_are_told_with_their_limits_and_denials() -> None:
    assert text(statement(Claim(x, "Theta", 1 / N, (), N))) == "x = Θ(1/N) as N → ∞"
    assert text(statement(Claim(x, "->", sympy.oo, (), N))) == "x → ∞ as N → ∞"
    assert text(statement(Claim(x, "<=", b, false=True))) == "it is false that x ≤ b"
    assert text(statement(Claim(x, "whole"))) == "x is whole"


def test_every_reason_is_in_words(found: Rechecks) -> None:
    for r in found.found:
        for p in read(r.entry).passages:
            assert text(p.reason)
            numbers = [int(n) for n in re.findall(r"\((\d+)\)", text(p.reason))]
            assert set(numbers) == set(p.uses)


def test_long_terms_get_a_name_and_keep_their_meaning() -> None:
    (place,) = [e for e in ledger.ENTRIES if e.number == "48"]
    reading = read(place)
    assert text(reading.holds) == "V = Θ(N^(−1 − e q)) as N → ∞"
    assert len(reading.names) == 1
    assert text(reading.names).startswith("V = ∫_0^{ρ₀} ")


def test_what_an_earlier_entry_has_shown_is_not_shown_again(found: Rechecks) -> None:
    (entry,) = [r.entry for r in found.found if r.entry.number == "48"]
    reading, shown = read(entry), dict[Claim, str]()
    first = without_repeats(reading, "Eq. 48", shown)
    assert first.passages == reading.passages
    again = without_repeats(reading, "another", shown)
    assert len(again.passages) == 2  # the last steps of proof and refutation
    assert text(again.passages[0].reason) == f"step {again.passages[0].number} of Eq. 48"


@pytest.mark.parametrize(
    ("prose", "latex"),
    [
        ("N^-3", "$N$$^{-3}$"),
        ("V = Θ(N^(1/d)) >= b_k", r"$V$ = $\Theta$($N$$^{1/d}$) $\ge$ $b$$_{k}$"),
        ("ρ0^2 in a box", r"$\rho$$_{0}$$^{2}$ in a box"),
        ("|f^(m)|² & 5 %", r"$|$$\hat{f}$($m$)$|$$^{2}$ \& 5 \%"),
        ("i.e. A I, d = 2.", r"i.e. $A$ I, $d$ = 2."),
        ("A box in Appendix B; P̆_S", r"A box in Appendix B; $\breve{P}$$_{S}$"),
    ],
)
def test_prose_has_its_formulas_set(prose: str, latex: str) -> None:
    assert latex_text(prose).replace(" ", "") == latex.replace("$$", "").replace(" ", "")
    assert "".join(word for _, word in pieces("plain words.")) == "plain words."


def test_every_word_of_the_ledger_can_be_set_in_latex() -> None:
    for e in ledger.ENTRIES:
        for words in (e.title, e.source, e.notes, e.as_printed, e.number):
            assert latex_text(words).count("?") == words.count("?")
            check_structure(latex_text(words))
            assert latex_text(words).isascii()


@pytest.mark.parametrize(
    ("words", "set_as"),
    [
        ("∫_0^∞ ν", r"$\int _{0} ^{\infty }$ $\nu$"),
        ("N_k^b_k", r"$N _{k} ^{b_{k}}$"),
        ("|f^|²", r"$| \hat{f} | ^{2}$"),
        ("∏^(d−1) x", r"$\prod ^{d-1}$ $x$"),
    ],
)
def test_limits_and_indices_of_exponents_are_set(words: str, set_as: str) -> None:
    assert latex_text(words) == set_as


# Terminal and Markdown


def test_the_table_is_aligned_and_counted(found: Rechecks) -> None:
    lines = render(found, "terminal", whole=False).splitlines()
    assert lines[0].split() == list(HEAD)
    widths = [len(word) for word in lines[1].split("  ")]
    assert len(widths) == len(HEAD)
    for line, r in zip(lines[2:], found.found, strict=False):
        assert line[widths[0] + 2 :].lstrip().startswith((r.entry.number[0], "corrected"))
    assert re.search(r"^\d+ proved, \d+ corrected, \d+ refuted", "\n".join(lines), re.M)
    assert render(found, "markdown", whole=False).startswith("| id | equation |")


def test_a_whole_proof_has_every_step_with_its_reason(found: Rechecks) -> None:
    said = render(found, "terminal", whole=True)
    for r in found.found:
        assert f"{r.entry.title} [{r.entry.status}]" in said
    denied = [r for r in found.found if r.entry.refutation is not None]
    assert said.count("Refutation of what was printed") == len(denied) == 6
    assert len(re.findall(r"^ +\d+\. ", said, re.M)) == sum(r.steps for r in found.found)


def test_errata_say_what_was_printed_what_holds_and_where_it_fails(found: Rechecks) -> None:
    errata = Rechecks(tuple(r for r in found.found if r.entry.number == "50"))
    said = render(errata, "terminal", whole=False, errata=True)
    assert "printed   Var < O(1/(N N_k)), b_k >= 1; that is V = O(N^(−1 − e)) as N → ∞" in said
    assert "holds     V = Θ(N^(−1 − b e) log(N)) as N → ∞" in said
    assert re.search(r"^witness   at .*b = 1: .* → ∞ as N → ∞$", said, re.M)


def test_a_refused_entry_stands_out_everywhere(wrong: Rechecks) -> None:
    assert "REFUSED" in render(wrong, "terminal", whole=False)
    assert "REFUSED 7: Refused: not zero" in render(wrong, "markdown", whole=True)
    (record,) = document(wrong)["proofs"]
    assert (record["status"], record["accepted"], record["steps"]) == (None, False, 0)
    assert "Refused by the kernel" in render(wrong, "html", whole=False)
    check_structure(render(wrong, "latex", whole=False))


# JSON


def test_the_document_matches_its_schema(found: Rechecks, wrong: Rechecks) -> None:
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    for some in (found, wrong):
        jsonschema.validate(json.loads(render(some, "json", whole=False)), SCHEMA)


def _objects(node: Any) -> Iterator[dict[str, Any]]:
    if isinstance(node, dict):
        yield node
    children: Any = cast(Any, node).values() if isinstance(node, dict) else node
    for inner in children:
        if isinstance(inner, (dict, list)):
            yield from _objects(inner)


def test_a_document_with_a_field_missing_or_strange_does_not(found: Rechecks) -> None:
    small = document(Rechecks(found.found[:2]))
    validator: Any = jsonschema.Draft202012Validator(SCHEMA)
    for place in range(len(list(_objects(small)))):
        for key in [*list(_objects(small))[place], "surprise"]:
            mutant = deepcopy(small)
            there = list(_objects(mutant))[place]
            there.pop(key) if key in there else there.setdefault(key, 1)
            assert not validator.is_valid(mutant), key
            if place > 60:
                break


def test_denied_statements_are_refuted_in_the_document(found: Rechecks) -> None:
    records = {p["number"]: p for p in document(found)["proofs"]}
    assert (records["48"]["ledger_status"], records["48"]["status"]) == ("corrected", "refuted")
    proved = records["18, from below"]
    assert (proved["ledger_status"], proved["status"]) == ("proved", "proved")
    errata = {e["id"] for e in document(found)["errata"]}
    assert {"5", "48", "50", "50-as-a-rate", "6.1"} <= errata
    assert "18" in errata
    assert "18, from below" not in errata


# LaTeX and HTML


def test_the_latex_document_compiles(found: Rechecks, tmp_path: Path) -> None:
    source = render(found, "latex", whole=False)
    check_structure(source.replace(r"\biggl(", "").replace(r"\biggr)", ""))
    program = shutil.which("pdflatex")
    if program is None:
        return
    (tmp_path / "paper.tex").write_text(source, encoding="utf-8")
    command = [program, "-interaction=nonstopmode", "-halt-on-error", "paper.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, errors="replace")
    assert done.returncode == 0, done.stdout[-3000:]
    assert "Missing character" not in done.stdout
    assert not [
        w for w in re.findall(r"Overfull \\hbox \(([\d.]+)pt", done.stdout) if float(w) > 20
    ]


class _Page(HTMLParser):
    """Elements opened and closed in order, anchors, links, and what a page may not have."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.anchors: list[str] = []
        self.links: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        assert tag not in ("script", "img", "link", "iframe")
        values = dict(attrs)
        if "id" in values:
            self.anchors.append(str(values["id"]))
        if tag == "a":
            self.links.append(str(values["href"]))
        if tag not in ("meta", "br"):
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_the_page_stands_alone_and_its_links_lead_somewhere(found: Rechecks) -> None:
    whole = render(found, "html", whole=False)
    page = _Page()
    page.feed(whole)
    assert not page.open
    assert len(set(page.anchors)) == len(page.anchors)
    assert {link.removeprefix("#") for link in page.links} <= set(page.anchors)
    assert "http" not in re.sub(r'http-equiv="Content-Security-Policy"', "", whole)
    for formula in re.findall(r"<math.*?</math>", whole)[:500]:
        ElementTree.fromstring(formula)


def test_proofs_of_few_entries_are_open(found: Rechecks) -> None:
    assert '<details open="open">' in render(Rechecks(found.found[:1]), "html", whole=True)
    assert '<details open="open">' not in render(found, "html", whole=False)


def test_admitted_and_cited_are_told(found: Rechecks) -> None:
    entry = found.found[0].entry
    leans = Recheck(entry, None, frozenset(), frozenset({"the theorem of Riesz"}), 1, 0.0)
    for form in ("terminal", "markdown", "latex", "html", "json"):
        assert "the theorem of Riesz" in render(Rechecks((leans,)), form, whole=False).replace(
            "$", ""
        )


# The command


@pytest.fixture
def alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """One process, which sees what a test has put into the ledger."""
    monkeypatch.setattr("os.cpu_count", lambda: 1)


@pytest.mark.usefixtures("alone", "two")
def test_exit_codes(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    target = tmp_path / "proofs.json"
    assert main(["prove", "48", "--format", "json", "--output", str(target)]) == 0
    assert [p["id"] for p in json.loads(target.read_text("utf-8"))["proofs"]] == ["48"]
    assert main(["prove", "99"]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err == "specrate: what is proved must be an id or equation of the ledger: got 99\n"


@pytest.mark.usefixtures("alone", "wrong")
def test_a_refused_proof_is_1(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["prove"]) == 1
    assert "REFUSED 7" in capsys.readouterr().out


@pytest.mark.usefixtures("alone", "two")
def test_an_interrupt_is_130_and_prints_what_was_finished(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    told: list[str] = []

    def stop(words: str) -> None:
        told.append(words)
        if len(told) == 1:
            raise KeyboardInterrupt

    monkeypatch.setattr("specrate.report.cli._progress", stop)
    assert main(["prove", "--format", "json"]) == 130
    printed = json.loads(capsys.readouterr().out)
    assert printed["interrupted"]
    assert [p["id"] for p in printed["proofs"]] == ["48"]
