"""What a page says of a check in words and tables: verdict, claims, faults, neighbours, plan."""

import json
import shlex
from collections.abc import Sequence
from typing import Any

from ..theory.samplers import parse_sampler
from ..theory.tables import Row
from ..theory.tables import table as convergence_table
from .check_formats import blocks_text, frequency_text, short
from .markup import Content, Html, element, items, joined, prose, table, terms
from .numerals import exponent, interval, number

Document = dict[str, Any]

_STATES = {True: ("good", "✓ holds"), False: ("bad", "✗ fails"), None: ("", "? undecided")}
_SIGNS = {"consistent": "✓", "contradicted": "✗", "invalid": "✗", "inconclusive": "?"}
_ENDS = {
    "decided": "all is decided, or there is no more to measure",
    "fault": "a fault",
    "budget": "the budget is spent",
    "interrupted": "interrupted",
}
_TONES = {"consistent": "good", "contradicted": "bad", "invalid": "bad", "inconclusive": ""}


def code(text: str) -> Html:
    """Text as it is typed."""
    return element("code", text)


def listed(words: Sequence[str], most: int = 4) -> Html:
    """``a, b and c``, each as it is typed; of many the first few."""
    shown = [code(w) for w in words[:most]]
    if len(words) > most:
        return joined(joined(*shown, between=", "), f" and {len(words) - most} more")
    *first, last = shown
    return joined(joined(*first, between=", "), " and ", last) if first else last


def verdict(document: Document) -> Html:
    """One sentence: what was asked, what is found, at which N, and how often that is wrong."""
    word = document["verdict"]
    found = element("span", f"{_SIGNS[word]} {word}", class_="word")
    sentence = joined(
        _asked(document), ": ", found, " ", prose(_where(document)), _because(document),
        f"; {_error(document)} with a probability set to {number(document['false_alarm'], 1)}.",
    )  # fmt: skip
    return element("p", sentence, class_=f"verdict {_TONES[word]}".strip())


def _error(document: Document) -> str:
    if document["verdict"] == "invalid":
        return "a sound sampler is found at fault"
    if document["claims"]:
        return "a correct claim is contradicted"
    return "the catalogue sampler that it is, if it is one, is excluded"


def _asked(document: Document) -> Html:
    plan = document["plan"]
    source = joined(listed(plan["sources"]), f" in {plan['dim']}D")
    claims = [c["claim"] for c in document["claims"]]
    if not claims:
        return joined("Asked which catalogue sampler has the spectrum of ", source)
    noun = " meets the claim " if len(claims) == 1 else " meets the claims "
    return joined("Asked whether ", source, noun, listed(claims))


def _where(document: Document) -> str:
    reach = document["n_range"]
    if not reach:
        return "before any N was measured"
    stopped = ", interrupted," if document["interrupted"] else ""
    last = f" to {reach[1]}" if reach[1] != reach[0] else ""
    return f"at N\u00a0=\u00a0{reach[0]}{last}{stopped}"


def _because(document: Document) -> Html:
    claims, margin = document["claims"], f"{document['margin']:.0%}"
    match document["verdict"]:
        case "invalid":
            kinds = dict.fromkeys(f["kind"] for f in document["faults"])
            return joined(f", since a fault voids the question ({', '.join(kinds)})")
        case "contradicted":
            return joined(", since ", joined(*_failures(claims), between="; "))
        case "consistent" if not claims:
            names = document["matches"]
            return joined(", with ", listed(names)) if names else Html(", with none of them")
        case "consistent":
            exponents = [c for c in claims if c.get("exponents")]
            near = f"all measured values lie within {margin} of the claimed"
            if len(exponents) == len(claims):
                near = f"the exponent lies within {document['exponent_margin']:.2g} of the claimed"
            return joined(f", since {near}")
        case _:
            needed = document["budget_needed"]
            more = "" if needed is None else f"; a budget of {needed['seconds']:.0f} s may decide"
            return joined(f", since what was measured does not decide{more}")


def _failures(claims: Sequence[Document]) -> list[Content]:
    found: list[Content] = []
    for c in claims:
        if c["holds"] is False and c.get("failing"):
            tests, total = c["failing"]["tests"], c["failing"]["of"]
            found.append(joined(code(c["claim"]), f" fails in {tests} of {total} comparisons"))
        elif c["holds"] is False:
            found.append(joined(code(c["claim"]), " is excluded by the fall of the variance"))
    return found


def claims(document: Document) -> Html:
    """Every claim, and the witness against it."""
    if not document["claims"]:
        return element("p", "Nothing was claimed.")
    found = [_claim(c, document["level"], document["margin"]) for c in document["claims"]]
    if document["faults"]:
        void = "A fault below voids the question; what the measurements say all the same:"
        found.insert(0, element("p", void))
    return joined(*found)


def _claim(c: Document, level: float, margin: float) -> Html:
    tone, words = _STATES[c["holds"]]
    parts = [
        element("h3", code(c["claim"]), " ", element("span", words, class_=f"word {tone}".strip()))
    ]
    if c.get("failing"):
        failing = f"{c['failing']['tests']} of {c['failing']['of']} comparisons fail."
        parts.append(element("p", failing + " The simplest of them:"))
    if c["holds"] and not c.get("exponents"):
        near = f"Every measured spectrum and variance lies within {margin:.0%} of the claimed one."
        parts.append(element("p", near))
    if c["witness"]:
        parts.append(terms(_witness(c["witness"], level)))
    elif c.get("exponents"):
        parts.append(terms([("Exponents not excluded", _reach(c["exponents"]))]))
    return element("article", *parts, class_="card")


def _reach(ends: Sequence[float | None]) -> str:
    low = "−∞" if ends[0] is None else number(ends[0])
    return f"{low} to {number(ends[1])}"


def _witness(w: Document, level: float) -> list[tuple[Content, Content]]:
    if w["what"] == "exponent":
        return [
            ("χ² of the claimed exponent", f"{number(w['chi2'])}, with the drift that suits it"),
            ("Excluded above", number(w["threshold"])),
            ("Exponents not excluded", _reach(w["exponents"])),
        ]
    spectrum = w["what"] == "N P_S(m)"
    name = "N·P_S" if spectrum else "variance"
    at = frequency_text(w["at"]) if spectrum else short(w["at"])
    found: list[tuple[Content, Content]] = [
        ("Frequency" if spectrum else "Integrand", prose(at) if spectrum else code(at)),
        (prose("N"), str(w["n"])),
        (prose(f"Measured {name}"), f"{interval(w['measured'])} (level {number(level, 1)})"),
        (prose(f"Claimed {name}"), number(w["predicted"])),
    ]
    if w["region"]:
        found.insert(0, ("Region", short(w["region"])))
    if w["ratio"] is not None:
        found.append(("Measured over claimed", number(w["ratio"])))
    return found


def faults(document: Document) -> Html:
    """Faults by their kinds with their evidence, and what to do about them."""
    if not document["faults"]:
        looked = "None was found." if document["n_range"] else "Nothing was looked at."
        return element("p", looked)
    kinds = dict.fromkeys(f["kind"] for f in document["faults"])
    return joined(*(_faults(k, [f for f in document["faults"] if f["kind"] == k]) for k in kinds))


def _faults(kind: str, found: Sequence[Document]) -> Html:
    remedies = dict.fromkeys(f["remedy"] for f in found)
    remedied = joined(element("strong", "Remedy: "), "; or ".join(remedies), ".")
    details = [f["detail"] for f in found]
    told = element("p", details[0]) if len(details) == 1 else items(details)
    evidence = joined(*(_evidence(f["evidence"]) for f in found))
    parts = [element("h3", kind), told, element("p", remedied)]
    if evidence.text:
        parts.append(element("details", element("summary", "Evidence"), evidence))
    return element("article", *parts, class_="card")


def _evidence(found: Document) -> Html:
    told: list[tuple[Content, Content]] = [
        (name.replace("_", " "), _value(value))
        for name, value in found.items()
        if value not in (None, "")
    ]
    return terms(told) if told else Html("")


def _value(value: Any) -> Content:
    if isinstance(value, float):
        return number(value)
    if isinstance(value, str):
        return element("pre", value) if "\n" in value else value
    return json.dumps(value, ensure_ascii=False)


def structure(document: Document) -> Html:
    """Blocks of coordinates, and strata or lattices off the axes."""
    blocks = blocks_text(document)
    told = "Which are stratified together is not known." if blocks is None else f"{blocks}."
    first = element("p", told[0].upper() + told[1:])
    rows = [
        (
            frequency_text(r["frequency"]), str(r["n"]), interval(r["scaled_power"]),
            prose(r["what"]),
        )
        for r in document["oblique"]
    ]  # fmt: skip
    if not rows:
        return first
    head = ("frequency", "N", prose("N·P_S"), "what it shows")
    return joined(first, table("Strata or lattices that do not lie along the axes", head, rows))


def neighbours(document: Document) -> Html:
    """Catalogue samplers whose exact spectrum the points have, and their rates."""
    names, dim = document["matches"], document["plan"]["dim"]
    if not names:
        asked = document["claims"]
        only = asked and all("~" in c["claim"] for c in asked)
        return element("p", "Not looked for." if only else "None is established.")
    found = convergence_table(names, [dim], ["worst", "best"], constants=False).rows
    claimed = {
        parse_sampler(c["claim"], dim).name for c in document["claims"] if "~" not in c["claim"]
    }
    rows = [
        (code(n), "yes" if n in claimed else "", *(_order(found, n, c) for c in ("worst", "best")))
        for n in names
    ]
    caption = (
        f"Samplers with every measured N·P_S within {document['margin']:.0%} of their exact one; "
        "the order of their variance"
    )
    return table(caption, ("sampler", "claimed", "worst class", "best class"), rows)


def _order(rows: Sequence[Row], name: str, family: str) -> Html:
    """``N^-3/2 log N`` of the whole spectrum."""
    found: list[Content] = []
    for r in rows:
        if r.is_overall and (r.sampler, r.integrand) == (name, family):
            power = str(r.order.log_power)
            if str(r.order.exponent) == "oo":
                found.append("no variance")
                continue
            logarithm = {"0": "", "1": " log N"}.get(power, f" (log N)^{power}")
            raised = element("sup", exponent("-" + str(r.order.exponent)))
            found.append(joined(element("i", "N"), raised, logarithm))
    return joined(*found, between=" or ")


def left_out(document: Document, others: Sequence[tuple[str, str]]) -> Html:
    """What the check and the page leave out, and why."""
    entries = [(x["what"], x["why"]) for x in document["left_out"]] + list(others)
    if not entries:
        return element("p", "Nothing.")
    return items([joined(element("strong", prose(w)), ": ", prose(why)) for w, why in entries])


def plan(document: Document) -> Html:
    """What was executed, and how to do it again."""
    found = document["plan"]
    rows = [
        tuple(str(s[k]) for k in ("n", "replicates", "attempted", "shifts"))
        for s in found["ladder"]
    ]
    facts: list[tuple[Content, Content]] = [
        ("Source", listed(found["sources"])),
        ("Dimension", str(found["dim"])),
        ("Seed", str(found["seed"])),
        ("Level", f"{number(document['level'], 1)} for each comparison"),
        ("Time", f"{document['seconds']:.1f} s"),
        ("Ended", _ENDS[found["ended"]]),
        ("Version", f"specrate {found['specrate']}"),
    ]
    head = (prose("N"), "realisations", "asked for", "random shifts")
    replay = "The same check again, where check.json and the source are; all but its times recurs:"
    again = "A new one, as far as its budget reaches:"
    return joined(
        terms(facts),
        table("What was drawn", head, rows) if rows else Html(""),
        element("p", replay),
        element("pre", "specrate check --plan check.json"),
        element("p", again),
        element("pre", shlex.join(_command(document))),
    )


def _command(document: Document) -> list[str]:
    found = document["plan"]
    words = ["specrate", "check", *found["sources"], "--dim", str(found["dim"])]
    for option, values in (("claim", found["claims"]), ("integrand", found["integrands"])):
        words += [w for v in values for w in (f"--{option}", v)]
    words += [w for n in found["asked"] for w in ("--n", str(n))]
    return [*words, "--seed", str(found["seed"])]
