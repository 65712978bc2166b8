"""The document of a check, printed: verdict, faults, regions, variances, claims."""

import json
from collections.abc import Iterator
from typing import Any

from .grids import aligned, booktabs, comma_separated, escaped, markdown

Document = dict[str, Any]

_REGION_HEAD = ("region", "N", "frequency", "N·P measured [95 %]", "N·P of the claim", "")
_RATE_HEAD = ("integrand", "region", "N", "variance [95 %]", "exact", "slope [95 %]", "theory")


def render(document: Document, form: str) -> str:
    """The document in one of the formats of the command line."""
    if form == "json":
        return json.dumps(document, indent=1)
    rows = list(_variance_rows(document))
    if form == "csv":
        return comma_separated(_RATE_HEAD, rows)
    if form == "latex":
        head = [escaped(h) for h in _RATE_HEAD]
        return booktabs("lllrrrl", head, [[escaped(c) for c in r] for r in rows])
    if form == "markdown":
        return "\n\n".join([_summary(document), markdown(_RATE_HEAD, rows)])
    parts = [_summary(document), *_faults(document)]
    spectrum = list(_spectrum_rows(document))
    if spectrum:
        parts.append("Spectrum on raw points, the most telling frequency per region and N\n")
        parts[-1] += aligned(_REGION_HEAD, spectrum)
    if rows:
        parts.append("Variance on shifted points\n" + aligned(_RATE_HEAD, rows))
    parts += [*_claims(document), *_ends(document)]
    return "\n\n".join(parts)


def _summary(document: Document) -> str:
    plan = document["plan"]
    source = " ".join(plan["sources"])
    reach = document["n_range"]
    where = f"N = {reach[0]} to {reach[1]}" if reach else "no N"
    stopped = " (interrupted)" if document["interrupted"] else ""
    return (
        f"{document['verdict'].upper()}: {source} in {plan['dim']}D, {where}, "
        f"{document['seconds']:.1f} s{stopped}"
    )


def _faults(document: Document) -> Iterator[str]:
    if document["faults"]:
        lines = [f"  {f['kind']}: {f['detail']}" for f in document["faults"]]
        yield "Faults\n" + "\n".join(lines)


def number(interval: Document | None, digits: int = 4) -> str:
    """``estimate [low, high]``."""
    if interval is None:
        return "-"
    high = "oo" if interval["high"] is None else f"{interval['high']:.{digits}g}"
    return f"{interval['estimate']:.{digits}g} [{interval['low']:.{digits}g}, {high}]"


def _spectrum_rows(document: Document) -> Iterator[tuple[str, ...]]:
    """For each region and N the frequency that disagrees, or the lowest one."""
    for region in document["regions"]:
        by_n: dict[int, list[Document]] = {}
        for row in region["spectrum"]:
            by_n.setdefault(row["n"], []).append(row)
        for n, rows in by_n.items():
            told = next((r for r in rows if r["agrees"] is False), rows[0])
            outcome = {True: "agrees", False: "DISAGREES", None: ""}[told["agrees"]]
            frequency = "(" + ", ".join(map(str, told["frequency"])) + ")"
            predicted = "-" if told["predicted"] is None else f"{float(told['predicted']):.4g}"
            yield (
                region["region"],
                str(n),
                frequency,
                number(told["scaled_power"]),
                predicted,
                outcome,
            )


def _variance_rows(document: Document) -> Iterator[tuple[str, ...]]:
    rates = {r["integrand"]: r for r in document["rates"]}
    last = ""
    for p in document["points"]:
        name = p["integrand"]
        rate = rates.get(name)
        first = name != last
        last = name
        slope = number(rate["measured"]["slope"]) if rate and first else ""
        yield (
            name if first else "",
            rate["region"] if rate and first else "",
            str(p["n"]),
            number(p["variance"]),
            "-" if p["exact"] is None else f"{float(p['exact']):.5g}",
            slope,
            _theory(rate) if rate and first else "",
        )


def _theory(rate: Document) -> str:
    exponent, power = rate["predicted"]["exponent"], rate["predicted"]["log_power"]
    if exponent is None:
        return "-"
    if exponent == "oo":
        return "0"
    log = "" if power == "0" else " log N" if power == "1" else f" (log N)^{power}"
    return f"N^-{exponent}{log}" if "/" not in exponent else f"N^(-{exponent}){log}"


def _claims(document: Document) -> Iterator[str]:
    if not document["claims"]:
        return
    lines = ["Claims"]
    for c in document["claims"]:
        word = {True: "holds", False: "FAILS", None: "open"}[c["holds"]]
        line = f"  {c['claim']}: {word}"
        if c.get("exponents") and c["exponents"][0] is not None:
            line += " (exponent in [{:.3f}, {:.3f}])".format(*c["exponents"])
        lines.append(line)
        if c["witness"]:
            lines.append("    " + _witness(c["witness"]))
    yield "\n".join(lines)


def _witness(w: Document) -> str:
    if w["what"] == "exponent":
        return f"witness: chi² = {w['chi2']:.4g} beyond {w['threshold']:.4g}, drift allowed for"
    at = w["at"] if isinstance(w["at"], str) else "m = (" + ", ".join(map(str, w["at"])) + ")"
    place = f" on region {w['region']}" if w["region"] else ""
    return (
        f"witness{place}: {w['what']} at {at}, N = {w['n']}: measured {number(w['measured'])} at "
        f"the decision level, the claim has {w['predicted']:.5g}"
    )


def _ends(document: Document) -> Iterator[str]:
    matches = document["matches"]
    if not (document["claims"] and all("~" in c["claim"] for c in document["claims"])):
        yield "Agrees with: " + (", ".join(matches) if matches else "no catalogue entry")
    budget = document["budget_needed_seconds"]
    if budget is not None:
        yield f"Open claims would be decided with a budget of about {budget:.0f} s."
    left = [f"  {x['what']}: {x['why']}" for x in document["left_out"]]
    yield "Left out\n" + "\n".join(left)
    yield (
        f"False alarms: at most {document['false_alarm']:.0e} for the whole check "
        f"(level {document['level']:.1e} per test); equivalence margin {document['margin']:.0%}."
    )
