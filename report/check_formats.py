"""The document of a check, printed: verdict, claims and witnesses first, then the evidence."""

import json
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import floor, inf, log, log10
from typing import Any

from .check_fits import FIT_TITLE, PARAMETERS, RATE_TITLE, fit_remarks, fit_rows, rate_rows
from .grids import PREAMBLE, aligned, booktabs, comma_separated, escaped, markdown, without_repeats

Document = dict[str, Any]
Writer = Callable[[Document | None], str]

_MOST_ALIKE = 3  # supports of one size that are listed one by one though they agree
_FEW_OBLIQUE = 3
_FEW_AXES = 4  # coordinates up to which a frequency is written as a vector


@dataclass(frozen=True)
class Section:
    """A heading and a table under it; ``repeated`` leading columns are shown once per group."""

    title: str
    head: tuple[str, ...]
    rows: Sequence[Sequence[str]]
    repeated: int


def render(document: Document, form: str) -> str:
    """The document in one of the formats of the command line."""
    if form == "json":
        return json.dumps(document, indent=1)
    if form == "csv":
        return _csv(document)
    write = _math if form == "latex" else _plain
    every = (_spectrum(document, write), *_fits(document), _variances(document, write))
    sections = [s for s in every if s.rows]
    words, ends = list(_words(document)), list(_ends(document))
    if form == "latex":
        return _latex(words, sections, ends)
    if form == "markdown":
        return _markdown(words, sections, ends)
    tables = [
        f"{s.title}\n{aligned(s.head, without_repeats(s.rows, s.repeated))}" for s in sections
    ]
    return "\n\n".join(["\n".join(words), *tables, "\n".join(ends)])


def _markdown(words: Sequence[str], sections: Sequence[Section], ends: Sequence[str]) -> str:
    verdict, *others = words
    parts = [f"**{verdict}**", "\n".join(f"- {w.strip()}" for w in others)]
    for s in sections:
        parts += [s.title + ".", markdown(s.head, s.rows)]
    return "\n\n".join([*filter(None, parts), "\n".join(f"- {e}" for e in ends)])


def _latex(words: Sequence[str], sections: Sequence[Section], ends: Sequence[str]) -> str:
    parts = [PREAMBLE, *(rf"\par\noindent {_latex_prose(w.strip())}" for w in words)]
    for s in sections:
        body = [[_latex_cell(c) for c in r] for r in without_repeats(s.rows, s.repeated)]
        head = [_latex_prose(h) for h in s.head]
        parts.append(rf"\par\medskip\noindent {_latex_prose(s.title)}\par\noindent")
        parts.append(rf"{{\small {booktabs('l' * len(head), head, body)}}}")
    return "\n".join([*parts, *(rf"\par\noindent {_latex_prose(e)}" for e in ends)])


def _latex_cell(text: str) -> str:
    return text if text.startswith("$") else _latex_prose(text)


_FORMULA = re.compile(
    r"N·P_S|P_S|N\^e|α|γ|chi\^2|\bm_?i? = \([^)]*\)|\bm_\w+ = -?\d+|\bN = \d+|N -> oo|\boo\b"
)


def _latex_prose(text: str) -> str:
    """Text for LaTeX, the formulas in it as mathematics."""
    found, last = "", 0
    for match in _FORMULA.finditer(text):
        found += escaped(text[last : match.start()]) + f"${_set(match.group())}$"
        last = match.end()
    return found + escaped(text[last:]).replace("×", r"$\times$")


def _set(formula: str) -> str:
    formula = formula.replace("N·P_S", "NP_S").replace("chi", r"\chi").replace("->", r"\to")
    formula = formula.replace("α", r"\alpha").replace("γ", r"\gamma")
    return re.sub(r"\boo\b", r"\\infty", re.sub(r"_(\d+)", r"_{\1}", formula))


def _csv(document: Document) -> str:
    """The measured variances; the ends of an interval have columns of their own."""
    intervals = ("variance", "raw_variance", "raw_mse", "bias")
    head = ["integrand", "region", "n", "replicates", "realisations"]
    head += [f"{k}{end}" for k in intervals for end in ("", "_low", "_high")]
    regions = {r["integrand"]: r["region"] for r in document["rates"]}
    rows: list[list[str]] = []
    for p in document["points"]:
        cells: list[object] = [p["integrand"], regions.get(p["integrand"])]
        cells += [p[k] for k in ("n", "replicates", "realisations")]
        for k in intervals:
            interval: Document = p.get(k) or {}
            cells += [interval.get(end) for end in ("estimate", "low", "high")]
        rows.append(["" if c is None else str(c) for c in [*cells, p["exact"], p["seconds"]]])
    return comma_separated([*head, "exact", "seconds"], rows)


def _words(document: Document) -> Iterator[str]:
    """What a reader must know first: the verdict, the faults, each claim and its witness."""
    plan, reach = document["plan"], document["n_range"]
    where = "no N measured"
    if reach:
        where = f"N = {reach[0]}" + (f" to {reach[1]}" if reach[1] != reach[0] else "")
    stopped = ", interrupted" if document["interrupted"] else ""
    yield (
        f"{document['verdict'].upper()}: {' '.join(plan['sources'])} in {plan['dim']}D, {where}, "
        f"{document['seconds']:.1f} s{stopped}"
    )
    for f in document["faults"]:
        yield f"  fault, {f['kind']}: {f['detail']}"
        yield f"    remedy: {f['remedy']}"
    for c in document["claims"]:
        yield from _claim(c, document["level"])
    if not document["claims"] or any("~" not in c["claim"] for c in document["claims"]):
        matches = ", ".join(document["matches"]) or "none established"
        yield f"  catalogue samplers whose spectrum the points have: {matches}"
    yield from _structure(document)


def blocks_text(document: Document) -> str | None:
    """The blocks of jointly stratified coordinates in words; None where they are not known."""
    blocks, dim = document["blocks"], document["plan"]["dim"]
    if blocks is None or dim == 1:
        return None
    if len(blocks) == 1:
        return "all coordinates are stratified together"
    if len(blocks) == dim:
        return "no coordinates are stratified together"
    told = " ".join("{" + ",".join(map(str, b)) + "}" for b in blocks)
    return f"stratified together are {told}"


def _structure(document: Document) -> Iterator[str]:
    """Blocks, and the simplest of what does not lie along the axes."""
    blocks = blocks_text(document)
    if blocks is not None:
        yield f"  blocks: {blocks}"
    for row in document["oblique"][:_FEW_OBLIQUE]:
        p = row["scaled_power"]
        high = "oo" if p["high"] is None else format(p["high"], ".3g")
        yield (
            f"  off the axes: N·P_S at {frequency_text(row['frequency'])}, N = {row['n']}, is "
            f"{p['estimate']:.3g} in [{p['low']:.3g}, {high}]: {row['what']}"
        )


def _claim(c: Document, level: float) -> Iterator[str]:
    word = {True: "holds", False: "FAILS", None: "undecided"}[c["holds"]]
    line = f"  claim {c['claim']}: {word}"
    if c.get("failing"):
        line += f" in {c['failing']['tests']} of {c['failing']['of']} comparisons"
    if c.get("exponents") and c["exponents"][0] is not None:
        line += " (exponents not excluded: {:.3f} to {:.3f})".format(*c["exponents"])
    yield line
    if c["witness"]:
        yield "    witness" + _witness(c["witness"], level)


def _witness(w: Document, level: float) -> str:
    if w["what"] == "exponent":
        return (
            f": chi^2 of the claimed exponent is {w['chi2']:.3g}, excluded above "
            f"{w['threshold']:.3g}; drift at finite N is allowed for"
        )
    at = short(w["at"]) if isinstance(w["at"], str) else frequency_text(w["at"])
    place = f" on region {short(w['region'])}" if w["region"] else ""
    low, high = w["measured"]["low"], w["measured"]["high"]
    shown = f"{low:.3g}, {'oo' if high is None else format(high, '.3g')}"
    return (
        f"{place}: {w['what'].replace('N P_S(m)', 'N·P_S')} at {at}, N = {w['n']}: measured "
        f"{w['measured']['estimate']:.3g} in [{shown}] (level {level:.0e}), "
        f"claimed {w['predicted']:.3g}"
    )


def frequency_text(frequency: Sequence[int]) -> str:
    """``m = (1, 0)``; in many dimensions the nonzero coordinates alone, ``m_4 = 1, m_9 = 2``."""
    if len(frequency) <= _FEW_AXES:
        return "m = (" + ", ".join(map(str, frequency)) + ")"
    nonzero = [(i, k) for i, k in enumerate(frequency, 1) if k]
    if len(nonzero) == len(frequency) and len({k for _, k in nonzero}) == 1:
        return f"every m_i = {nonzero[0][1]}"
    return ", ".join(f"m_{i} = {k}" for i, k in nonzero)


def short(text: str) -> str:
    """Four coordinates in a row and more as ``1..10``."""
    return re.sub(r"\d+(?:,\d+){3,}", _as_range, text)


def _as_range(match: "re.Match[str]") -> str:
    numbers = [int(i) for i in match.group().split(",")]
    in_a_row = numbers == list(range(numbers[0], numbers[-1] + 1))
    return f"{numbers[0]}..{numbers[-1]}" if in_a_row else match.group()


def _plain(interval: Document | None) -> str:
    """``1.23e-04 [1.10e-04, 1.40e-04]``; ``-`` where nothing is known."""
    if interval is None:
        return "-"
    high = "oo" if interval["high"] is None else _number(interval["high"])
    return f"{_number(interval['estimate'])} [{_number(interval['low'])}, {high}]"


def _number(value: float) -> str:
    return "0" if value == 0 else f"{value:.2e}"


def _math(interval: Document | None) -> str:
    r"""``$1.23\;[1.10,\,1.40]\times10^{-4}$``."""
    if interval is None:
        return "-"
    if interval["estimate"] == 0:
        return "$0$"
    power = floor(log10(abs(interval["estimate"])))
    values = [interval["estimate"], interval["low"], interval["high"]]
    shown = [r"\infty" if v is None else f"{v / 10.0**power:.2f}" for v in values]
    scale = rf"\times10^{{{power}}}" if power else ""
    return rf"${shown[0]}\;[{shown[1]},\,{shown[2]}]{scale}$"


def _exactly(value: str | None, like: str) -> str:
    """An exact value in the notation of its neighbours."""
    if value is None:
        return "-"
    number = float(value)
    if number == 0:
        return "0"
    if not like.startswith("$"):
        return f"{number:.3e}"
    power = floor(log10(abs(number)))
    return f"${number / 10.0**power:.3f}" + (rf"\times10^{{{power}}}$" if power else "$")


def _spectrum(document: Document, write: Writer) -> Section:
    """Per region and N the frequency that tells most; regions that agree, together."""
    claimed = any(r["predicted"] for g in document["regions"] for r in g["spectrum"])
    rows: list[tuple[str, ...]] = []
    for name, members in _grouped(document["regions"]):
        by_n: dict[int, list[Document]] = {}
        for region in members:
            for row in region["spectrum"]:
                by_n.setdefault(row["n"], []).append(row)
        for n, found in by_n.items():
            for label, told in _telling(name, found, len(members)):
                measured = write(told["scaled_power"])
                cells = [label, str(n), frequency_text(told["frequency"]), measured]
                if claimed:
                    outcome = {True: "yes", False: "NO", None: ""}[told["agrees"]]
                    cells += [_exactly(told["predicted"], measured), outcome]
                rows.append(tuple(cells))
    head = ("region", "N", "frequency", "N·P_S measured [95 %]")
    head += ("N·P_S claimed", "agrees") if claimed else ()
    which = "nearest to disagreement" if claimed else "that is lowest"
    title = (
        f"Power spectrum P_S of the raw points at frequencies m, per region and N the one {which}"
    )
    return Section(title + "; N·P_S = 1 for independent points", head, rows, 1)


def _grouped(regions: Sequence[Document]) -> Iterator[tuple[str, list[Document]]]:
    """Regions; those of one size on which nothing fails are joined where they are many."""
    alike: dict[int, list[Document]] = {}
    for g in regions:
        if g["spectrum"] and all(r["agrees"] is not False for r in g["spectrum"]):
            alike.setdefault(_size(g), []).append(g)
    for g in regions:
        members = alike.get(_size(g), [])
        if g not in members or len(members) <= _MOST_ALIKE:
            yield short(g["region"]), [g]
        elif g is members[0]:
            kind = {1: "axes", 2: "pairs", 3: "triples"}.get(_size(g), f"supports of {_size(g)}")
            yield f"{len(members)} {kind}", members


def _size(region: Document) -> int:
    return len(region["region"].split(","))


def _telling(name: str, found: Sequence[Document], members: int) -> Iterator[tuple[str, Document]]:
    """The row nearest to disagreement; without a claim the lowest frequency, or the extremes."""
    if found[0]["predicted"] is not None:
        yield name, max(found, key=_distance)
        return
    lowest = min(sum(map(abs, r["frequency"])) for r in found)
    rows = [r for r in found if sum(map(abs, r["frequency"])) == lowest]
    if members == 1:
        yield name, rows[0]
        return
    rows.sort(key=lambda r: r["scaled_power"]["estimate"])
    yield f"{name}, least", rows[0]
    yield f"{name}, largest", rows[-1]


def _distance(row: Document) -> tuple[bool, float]:
    """Disagreements first; then the log of measured over claimed power, in interval widths."""
    fails, power, predicted = row["agrees"] is False, row["scaled_power"], float(row["predicted"])
    if not power or predicted <= 0 or power["low"] <= 0 or power["high"] is None:
        return fails, inf if fails else 0.0
    width = log(power["high"] / power["low"])
    gap = abs(log(power["estimate"] / predicted))
    return fails, gap / width if width else 0.0


def _fits(document: Document) -> tuple[Section, Section]:
    """Fitted profiles, and the rates that they predict."""
    profiles = [(short(r[0]), *r[1:]) for r in fit_rows(document)]
    rates = [(short(r[0]), short(r[1]), *r[2:]) for r in rate_rows(document)]
    is_claimed = any(r[3] != "-" for r in rates)
    shown = rates if is_claimed else [r[:3] for r in rates]
    claimed = ("claimed",) if is_claimed else ()
    head = tuple(f"{symbol} [95 %]" for symbol in PARAMETERS.values())
    return (
        Section(FIT_TITLE, ("region", *head), profiles, 0),
        Section(RATE_TITLE, ("integrand", "region", "r [95 %]", *claimed), shown, 1),
    )


def _variances(document: Document, write: Writer) -> Section:
    rates = {r["integrand"]: r for r in document["rates"]}
    claimed = any(p["exact"] for p in document["points"])
    rows: list[tuple[str, ...]] = []
    last = ""
    for p in document["points"]:
        name, rate = p["integrand"], rates.get(p["integrand"])
        first, last = name != last, name
        shown = rate if first else None
        variance = write(p["variance"])
        cells = [short(name), short(rate["region"]) if rate else "", str(p["n"]), variance]
        if claimed:
            cells.append(_exactly(p["exact"], variance))
        cells.append(_slope(shown["measured"]["slope"]) if shown else "")
        if claimed:
            cells.append(_asymptote(shown, write is _math) if shown else "")
        rows.append(tuple(cells))
    head = ["integrand", "region", "N", "variance [95 %]", *(["claimed"] if claimed else [])]
    head += ["slope [95 %]", *(["slope, N -> oo"] if claimed else [])]
    title = "Variance on randomly shifted points; slope: of the line through log variance by log N"
    return Section(title, tuple(head), rows, 2)


def _slope(slope: Document | None) -> str:
    if slope is None:
        return "-"
    high = "oo" if slope["high"] is None else f"{slope['high']:.2f}"
    return f"{slope['estimate']:.2f} [{slope['low']:.2f}, {high}]"


def _asymptote(rate: Document, latex: bool) -> str:
    exponent, power = rate["predicted"]["exponent"], rate["predicted"]["log_power"]
    if exponent is None:
        return "-"
    if exponent == "oo":
        return "no variance"
    text = exponent[1:] if exponent.startswith("-") else f"-{exponent}"
    logarithm = "" if power == "0" else ", log N" if power == "1" else f", (log N)^{power}"
    return f"${text}${escaped(logarithm)}" if latex else text + logarithm


def _ends(document: Document) -> Iterator[str]:
    needed = document["budget_needed"]
    if needed is not None:
        yield f"Undecided claims need a budget of about {needed['seconds']:.0f} s."
    yield from map(short, fit_remarks(document))
    for x in document["left_out"]:
        yield f"Left out, {x['what']}: {x['why']}"
    yield (
        f"A correct claim is contradicted with a probability set to {document['false_alarm']:.0e} "
        f"(level {document['level']:.0e} per comparison); it holds where the interval lies "
        f"within {document['margin']:.0%} of the claimed spectrum or variance, or, holding the "
        f"claimed exponent, within {document['exponent_margin']:.2g} of it."
    )
