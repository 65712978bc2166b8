"""The paper, checked, as a page: one self-contained HTML file, its mathematics as MathML.

The page needs no network and no script, and says so to the browser (Content-Security-Policy).
Proofs are folded, and in them the steps that only read something off. Each step is an anchor, and
a number in a reason leads to it.
"""

import re
from collections.abc import Sequence
from html import escape
from itertools import groupby

from ..proofs.rechecks import Recheck, Rechecks, identifier
from ..proofs.trusted.claims import Claim
from .claim_words import Prose
from .formula_prints import mathml
from .formula_prose import pieces
from .markup import Content, Html, element, items, joined, terms
from .page_style import stylesheet
from .proof_formats import STATUSES, cited, heading, part_of_paper, word
from .proof_reading import Passage, Reading, proof_parts, read, runs, without_repeats

_POLICY = "default-src 'none'; style-src 'unsafe-inline'"
_TITLE = "Monte Carlo Convergence Analysis for Anisotropic Sampling Power Spectra"
_FEW = 3  # entries whose proofs are shown unfolded

_RULES = """\
math{font-size:1.02em;white-space:nowrap}
.formula{overflow-x:auto;overflow-y:hidden;line-height:1.9;padding:.1rem 0}
.entry{border-top:1px solid var(--rule);padding:.6rem 0 1rem;max-width:58rem}
.entry h3{margin:.5rem 0 .1rem;font-size:1.12rem}
.entry h3 .word{font-size:.85rem;font-weight:600;white-space:nowrap;margin-left:.4rem}
.entry .source{color:var(--muted);font-size:.88rem;margin:0 0 .5rem}
.entry dl>div{grid-template-columns:minmax(5rem,6.5rem) minmax(0,1fr);align-items:baseline}
.entry dd{min-width:0}
ol.proof{list-style:none;margin:.4rem 0;padding:0}
ol.proof li{display:grid;grid-template-columns:2.6rem minmax(0,1fr);
align-items:baseline;padding:.12rem 0}
ol.proof li:target{background:var(--shade)}
ol.proof .n{color:var(--muted);font-size:.85rem}
.step{display:flex;flex-wrap:wrap;align-items:baseline;gap:0 1.4rem;min-width:0}
.step>*{max-width:100%;min-width:0}
.why{color:var(--muted);font-size:.9rem;overflow-x:auto;overflow-y:hidden;padding:.15rem 0}
.why a,nav a{text-decoration:none}
li.given,li.small{display:block!important}
li.given{font-style:italic;padding-top:.7rem!important}
li.small summary{font-size:.85rem;color:var(--muted);padding:.1rem 0 .1rem 2.6rem}
li.small li{font-size:.92rem}
.overview td:last-child{white-space:normal;min-width:13rem}
@media (max-width:34rem){.entry dl>div{grid-template-columns:minmax(0,1fr)}
ol.proof li{grid-template-columns:2.1rem minmax(0,1fr)}li.small summary{padding-left:2.1rem}}
"""


def page(found: Rechecks) -> str:
    """The page of the re-checked entries."""
    head = element(
        "head",
        element("meta", charset="utf-8"),
        element("meta", http_equiv="Content-Security-Policy", content=_POLICY),
        element("meta", name="viewport", content="width=device-width, initial-scale=1"),
        element("meta", name="color-scheme", content="light dark"),
        element("title", "The paper, checked - specrate prove"),
        element("style", Html(stylesheet() + _RULES)),
    )
    body = element("body", _header(found), element("main", _overview(found), *_sections(found)))
    return f"<!DOCTYPE html>\n{element('html', head, body, lang='en').text}"


def _header(found: Rechecks) -> Html:
    return element(
        "header",
        element("p", "specrate prove", class_="eyebrow"),
        element("h1", "The paper, checked"),
        element(
            "p",
            "The numbered equations and the claims of the text of G. Singh and W. Jarosz, ",
            element("i", _TITLE),
            " (Dartmouth TR2016-816); quotations may be shortened. The line Holds is what is "
            "proved, and a small kernel has checked it step by step. Of an estimator it is proved "
            "for the sum or integral that the line writes down: that this is a sampler's spectrum "
            "is shown by the entries named kernel only, and a rate with a profile γ/N in it is one "
            "in the model of Eqs. 16-18, which its entry says. What is argued besides, and how a "
            "quotation is read, stands in the notes.",
        ),
        element("p", *_counts(found), class_=f"verdict {'good' if found.is_accepted else 'bad'}"),
        element(
            "p",
            "A step is told under the hypotheses of its statement; where it needs others, they "
            "stand before it. What an earlier entry has shown is not shown again, and its numbers "
            "are left out. Numbers in brackets are steps: (3) − (2) is the difference "
            "of two equations, or of what lies between their sides.",
            class_="note",
        ),
    )


def _counts(found: Rechecks) -> list[Content]:
    accepted = [r for r in found.found if r.is_accepted]
    counts = {s: sum(r.entry.status == s for r in accepted) for s in STATUSES}
    said = ", ".join(f"{n} {s}" for s, n in counts.items() if n)
    parts: list[Content] = [f"{len(found.found)} entries, {sum(r.steps for r in accepted)} steps: "]
    parts.append(element("span", said or "none accepted", class_="word"))
    if len(accepted) < len(found.found):
        parts.append(f", {len(found.found) - len(accepted)} refused by the kernel")
    parts.append("." if not found.is_interrupted else ". Interrupted: the others were not checked.")
    return parts


def _overview(found: Rechecks) -> Html:
    """All entries in a table, what is admitted, and what is cited."""
    head = element("tr", *(element("th", h, scope="col") for h in ("Entry", "Status", "Statement")))
    rows = (
        element(
            "tr",
            element("th", element("a", heading(r), href=f"#{identifier(r.entry)}"), scope="row"),
            element("td", _status(r)),
            element("td", _text(r.entry.title)),
        )
        for r in found.found
    )
    whole = element("table", element("thead", head), element("tbody", *rows), class_="overview")
    framed = element(
        "div", whole, class_="scroll", role="region", aria_label="All entries", tabindex="0"
    )
    admitted = [joined(heading(r), ": ", _text(a)) for r in found.found for a in sorted(r.admitted)]
    sources = [
        joined(_text(f"{a.name}, {a.source}"), f", in {', '.join(numbers)}")
        for a, numbers in cited(found)
    ]
    return element(
        "section",
        element("h2", "All entries"),
        framed,
        element("h3", "Admitted, not proved"),
        items(admitted) if admitted else element("p", "Nothing."),
        element("h3", "Cited theorems"),
        items(sources) if sources else element("p", "None: every step is proved."),
    )


def _sections(found: Rechecks) -> list[Html]:
    shown: dict[Claim, str] = {}
    is_open = len(found.found) <= _FEW
    return [
        element("section", element("h2", name), *(_entry(r, is_open, shown) for r in group))
        for name, group in groupby(found.found, key=part_of_paper)
    ]


def _status(r: Recheck) -> Html:
    good = r.is_accepted and r.entry.status in ("proved", "definition")
    return element("span", word(r).lower(), class_=f"word {'good' if good else 'bad'}")


def _entry(r: Recheck, is_open: bool, shown: dict[Claim, str]) -> Html:
    name = identifier(r.entry)
    title = element("h3", heading(r), ": ", _text(r.entry.title), " ", _status(r))
    source = element("p", _text(r.entry.source), class_="source")
    if not r.is_accepted:
        told = element("p", f"Refused by the kernel: {r.refusal}")
        return element("article", title, source, told, id=name, class_="entry")
    reading = without_repeats(read(r.entry), heading(r), shown)
    facts = terms([(k, v) for k, v in _facts(r, reading) if v is not None])
    proofs = [_folded(name, part, steps, is_open, reading) for part, steps in proof_parts(reading)]
    return element("article", title, source, facts, *proofs, id=name, class_="entry")


def _facts(r: Recheck, reading: Reading) -> list[tuple[Content, Html | None]]:
    as_printed = _text(r.entry.as_printed) if r.entry.as_printed else None
    where = _formula(reading.names) if reading.names else None
    given = reading.given or reading.printed_given
    return [
        ("As printed", as_printed),
        ("that is" if as_printed else "As printed", _formula(reading.printed)),
        ("Holds", _formula(reading.holds)),
        ("Given", element("div", _set(given), class_="formula") if given else None),
        ("Where", where),
        ("Fails", _formula(reading.witness)),
        ("Note", _text(r.entry.notes) if r.entry.notes else None),
    ]


def _folded(
    name: str, part: str, steps: Sequence[Passage], is_open: bool, reading: Reading
) -> Html:
    listed: list[Html] = []
    if reading.short_names and not steps[0].is_of_refutation:
        told = joined("Write ", *(_set((n,)) for n in reading.short_names))
        listed.append(element("li", told, class_="given formula"))
    for under, is_trivial, passages in runs(steps):
        if under is not None:
            told = _set(under) if under else "the hypotheses of the statement"
            listed.append(element("li", "Given ", told, ":", class_="given formula"))
        rows = [_step(name, p) for p in passages]
        listed += [_small(passages, rows)] if is_trivial else rows
    summary = element("summary", f"{part}, {len(steps)} step{'s' if len(steps) > 1 else ''}")
    proof = element("ol", *listed, class_="proof")
    attributes = {"open": "open"} if is_open else {}
    return element("details", summary, proof, **attributes)


def _small(passages: Sequence[Passage], rows: Sequence[Html]) -> Html:
    """A run of steps that only read something off, folded."""
    first, last = passages[0].number, passages[-1].number
    numbers = f"({first})" if first == last else f"({first}) to ({last})"
    inner = element("ol", *rows, class_="proof")
    return element(
        "li", element("details", element("summary", f"{numbers}: read off"), inner), class_="small"
    )


def _step(name: str, p: Passage) -> Html:
    return element(
        "li",
        element("span", f"({p.number})", class_="n"),
        element(
            "div",
            _formula(p.claim) or "",
            element("div", _reason(name, p.reason), class_="why"),
            class_="step",
        ),
        id=f"{name}:{p.number}",
    )


def _reason(name: str, reason: Prose) -> Html:
    """A reason, its numbers as links to the steps."""
    linked = rf'<a href="#{escape(name, quote=True)}:\1">(\1)</a>'
    return joined(
        *(
            Html(re.sub(r"\((\d+)\)", linked, _text(part).text))
            if isinstance(part, str)
            else Html(mathml(part))
            for part in reason
        )
    )


def _formula(prose: Prose) -> Html | None:
    """Prose with formulas in a block that scrolls where a formula is wider than the page."""
    return element("div", _set(prose, display=True), class_="formula") if prose else None


def _set(prose: Prose, display: bool = False) -> Html:
    return joined(*(_text(p) if isinstance(p, str) else Html(mathml(p, display)) for p in prose))


def _text(text: str) -> Html:
    """Prose with letters, indices and exponents of formulas set as such."""
    tags = {"letter": "i", "above": "sup", "below": "sub"}
    return joined(
        *(
            element(tags[kind], _text(w) if "_" in w else w) if kind in tags else w
            for kind, w in pieces(text)
        )
    )
