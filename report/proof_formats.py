"""Re-checked entries of the ledger, printed: a table and counts, whole proofs, errata, JSON."""

import json
import re
from collections.abc import Sequence
from typing import Any

from ..proofs.rechecks import Recheck, Rechecks, equation, identifier
from ..proofs.trusted.claims import Axiom
from .claim_words import Prose
from .formula_prints import plain
from .grids import aligned, markdown
from .proof_reading import Passage, Reading, read

HEAD = ("id", "equation", "status", "statement", "steps", "seconds")
STATUSES = ("proved", "corrected", "refuted", "definition", "admitted")
_WORDS = {"definition": "definitions checked"}


def render(found: Rechecks, form: str, whole: bool, errata: bool = False) -> str:
    """The re-checked entries in one of the formats of the command line.

    Parameters
    ----------
    found : Rechecks
    form : str
        terminal, markdown, json, latex or html.
    whole : bool
        Whether terminal and markdown give whole proofs in place of a table.
    errata : bool
        Whether they give what was printed and what holds in place of a table.
    """
    if form == "json":
        return json.dumps(document(found), indent=1, ensure_ascii=False)
    if form == "latex":
        from .proof_latex import paper_checked

        return paper_checked(found)
    if form == "html":
        from .proof_pages import page

        return page(found)
    parts: list[str] = []
    if whole or errata:
        parts += [_entry(r, form, whole) for r in found.found]
    else:
        rows = [row(r) for r in found.found]
        parts.append(markdown(HEAD, rows) if form == "markdown" else _table(rows))
    return "\n\n".join([*parts, "\n".join(counted(found))])


def _table(rows: Sequence[Sequence[str]]) -> str:
    return aligned(HEAD, rows) if rows else "no entries"


def row(r: Recheck) -> tuple[str, ...]:
    """An entry's line of the table."""
    told = r.entry.title if r.is_accepted else f"{r.entry.title}: {r.refusal}"
    return (
        identifier(r.entry), equation(r.entry) or "", word(r), told, str(r.steps),
        f"{r.seconds:.2f}",
    )  # fmt: skip


def word(r: Recheck) -> str:
    """The entry's status, or that it was refused."""
    return r.entry.status if r.is_accepted else "REFUSED"


def counted(found: Rechecks) -> list[str]:
    """How many entries have each status, what is admitted, and what is cited, in lines."""
    accepted = [r for r in found.found if r.is_accepted]
    counts = [(s, sum(r.entry.status == s for r in accepted)) for s in STATUSES]
    lines = [", ".join(f"{n} {_WORDS.get(s, s)}" for s, n in counts) + "."]
    refused = [r for r in found.found if not r.is_accepted]
    lines += [f"REFUSED {r.entry.number}: {r.refusal}" for r in refused]
    lines += [f"admitted in {r.entry.number}: {a}" for r in accepted for a in sorted(r.admitted)]
    lines += [
        f"cited: {axiom.name} ({axiom.source}), in {', '.join(numbers)}"
        for axiom, numbers in cited(found)
    ]
    if not any(r.axioms for r in accepted):
        lines.append("No theorem is cited without proof.")
    if found.is_interrupted:
        lines.append("Interrupted: the other entries were not checked.")
    return lines


def cited(found: Rechecks) -> list[tuple[Axiom, list[str]]]:
    """Cited theorems, and the numbers of the entries that lean on each."""
    where: dict[str, tuple[Axiom, list[str]]] = {}
    for r in found.found:
        for axiom in sorted(r.axioms, key=lambda a: a.name):
            where.setdefault(axiom.name, (axiom, []))[1].append(r.entry.number)
    return list(where.values())


def text(prose: Prose) -> str:
    """Prose as plain text."""
    return "".join(p if isinstance(p, str) else plain(p) for p in prose)


def heading(r: Recheck) -> str:
    """What an entry is about: "Eq. 25" or its name."""
    number = r.entry.number
    return f"Eq. {number}" if equation(r.entry) and number[0].isdigit() else number


def part_of_paper(r: Recheck) -> str:
    """Where an entry stands: a section, an appendix, a table, or beyond the paper."""
    match = re.match(r"(?:Sections? \d+|Appendix \w+|Table \d+)", r.entry.source)
    return match.group() if match else "Beyond the paper"


def _entry(r: Recheck, form: str, whole: bool) -> str:
    """One entry: its statements, notes and witness, and its whole proof if asked for."""
    mark = "## " if form == "markdown" else ""
    lines = [f"{mark}{heading(r)}: {r.entry.title} [{word(r)}]", f"{r.entry.source}"]
    if not r.is_accepted:
        return "\n".join([*lines, f"refused by the kernel: {r.refusal}"])
    reading = read(r.entry)
    lines += [f"{name:10}{value}" for name, value in statements(r, reading) if value]
    if whole:
        lines += ["", *_proof(reading)]
    return "\n\n".join(lines) if form == "markdown" else "\n".join(lines)


def statements(r: Recheck, reading: Reading) -> list[tuple[str, str]]:
    """What was printed, what holds, where it fails, and notes, as text."""
    printed = text(reading.printed)
    if r.entry.as_printed and printed:
        printed = f"{r.entry.as_printed}; that is {printed}"
    given = text(reading.given or reading.printed_given)
    return [
        ("printed", printed or r.entry.as_printed),
        ("holds", text(reading.holds)),
        ("given", given),
        ("where", "; ".join(map(plain, reading.names))),
        ("witness", text(reading.witness)),
        ("note", r.entry.notes),
    ]


def _proof(reading: Reading) -> list[str]:
    lines, given, denies = ["Proof"], "", False
    lines += [f"  Write {plain(name)}" for name in reading.short_names]
    for p in reading.passages:
        if p.is_of_refutation and not denies:
            lines.append("Refutation of what was printed")
            denies, given = True, ""
        if text(p.given) != given:
            given = text(p.given)
            lines.append(f"  Given {given or 'the hypotheses of the statement'}:")
        lines.append(f"  {p.number:3d}. {text(p.claim)}")
        lines.append(f"       {text(p.reason)}")
    return lines


def document(found: Rechecks) -> dict[str, Any]:
    """The re-check as the JSON document of the command line.

    ``status`` is "refuted" where the printed statement is denied, also if a corrected one is
    proved in its place; "proved" where what holds is proved and nothing is denied.
    """
    proofs = [_record(r) for r in found.found]
    errata = [
        {k: p[k] for k in ("id", "equation", "printed", "holds", "witness", "notes")}
        for p in proofs
        if p["ledger_status"] in ("refuted", "corrected") and p["accepted"]
    ]
    counts = {s: sum(p["ledger_status"] == s and p["accepted"] for p in proofs) for s in STATUSES}
    return {
        "proofs": proofs,
        "errata": errata,
        "counts": {**counts, "rejected": sum(not p["accepted"] for p in proofs)},
        "axioms": [
            {"name": a.name, "source": a.source, "used_in": numbers} for a, numbers in cited(found)
        ],
        "interrupted": found.is_interrupted,
    }


def _record(r: Recheck) -> dict[str, Any]:
    reading = read(r.entry) if r.is_accepted else None
    said = dict(statements(r, reading)) if reading else {}
    names = (*reading.names, *reading.short_names) if reading else ()
    json_status = "proved" if r.entry.status == "corrected" else r.entry.status
    if r.entry.refutation is not None:
        json_status = "refuted"
    return {
        "id": identifier(r.entry),
        "equation": equation(r.entry),
        "number": r.entry.number,
        "title": r.entry.title,
        "source": r.entry.source,
        "statement": said.get("holds") or said.get("printed") or r.entry.title,
        "status": json_status if r.is_accepted else None,
        "ledger_status": r.entry.status,
        "accepted": r.is_accepted,
        "rejected": r.refusal,
        "printed": said.get("printed", r.entry.as_printed) or None,
        "holds": said.get("holds") or None,
        "given": said.get("given") or None,
        "where": "; ".join(map(plain, names)) or None,
        "witness": said.get("witness") or None,
        "notes": r.entry.notes,
        "axioms": sorted(a.name for a in r.axioms),
        "admitted": sorted(r.admitted),
        "steps": r.steps,
        "proof": [_step(p) for p in reading.passages] if reading else [],
        "seconds": round(r.seconds, 4),
    }


def _step(p: Passage) -> dict[str, Any]:
    return {
        "number": p.number,
        "claim": text(p.claim),
        "given": text(p.given) or None,
        "reason": text(p.reason),
        "refutes": p.is_of_refutation,
    }
