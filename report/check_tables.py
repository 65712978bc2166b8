"""The figures of a check as tables: fitted profiles, spectra, slopes and variances."""

from math import hypot, log
from typing import Any

from ..numerics.measuring.spectrum_pictures import SpectrumPictures
from .check_figures import merged_profiles
from .check_fits import falling, fixed, is_class
from .check_formats import frequency_text, short
from .check_profiles import monomial_words
from .check_sections import code
from .markup import Content, Html, element, items, joined, prose, table
from .numerals import exponent, interval, number
from .variance_curves import curves_of

Document = dict[str, Any]


def tables_of(document: Document, pictures: SpectrumPictures, stem: str) -> Html:
    """The numbers of the figure of a stem, folded away; nothing for a figure that has none."""
    match stem:
        case "profiles":
            tables = [
                _fits(document, pictures), _class_table(document), _spectrum_table(document),
            ]  # fmt: skip
        case "convergence":
            tables = [_slope_table(document), _variance_table(document)]
        case _:
            tables = []
    shown = [t for t in tables if t.text]
    return element("details", element("summary", "Numbers"), *shown) if shown else Html("")


def _fits(document: Document, pictures: SpectrumPictures) -> Html:
    """Fitted profiles, and where none fits."""
    found: list[Content] = []
    for profile in merged_profiles(document, pictures):
        words = [monomial_words(m) for m in profile.monomials]
        words += [f"no profile fits: {profile.outside_model}"] * bool(profile.outside_model)
        words += [profile.reason] if profile.reason else []
        found += [joined(f"region {short(profile.region)}: ", w) for w in words]
    if not found:
        return Html("")
    about = "Fitted monomials γ min(1, (|m|/(α N^e))^b), their parameters with intervals:"
    return joined(element("p", prose(about)), items(found))


def _spectrum_table(document: Document) -> Html:
    """Per region and N the frequency nearest to disagreement, or the lowest one."""
    rows: list[list[Content]] = []
    for region in document["regions"]:
        counts = dict.fromkeys(r["n"] for r in region["spectrum"] if r["scaled_power"])
        for n in counts:
            told = max((r for r in region["spectrum"] if r["n"] == n), key=_distance)
            claimed = told["predicted"]
            outcome = {True: "yes", False: "no", None: ""}[told["agrees"]]
            rows.append([
                short(region["region"]), str(n), prose(frequency_text(told["frequency"])),
                interval(told["scaled_power"]), number(float(claimed)) if claimed else "–", outcome,
            ])  # fmt: skip
    caption = "N·P_S per region and N, at the frequency farthest from the claim or the lowest"
    head = ("region", prose("N"), "frequency", "measured, 95 %", "claimed", "agrees")
    return table(caption, head, rows) if rows else Html("")


def _distance(row: Document) -> tuple[bool, float]:
    """Disagreements first, then |log(measured/claimed)|; without a claim low frequencies."""
    power = row["scaled_power"]
    if not row["predicted"]:
        return False, -hypot(*row["frequency"])
    claimed = float(row["predicted"])
    near = power and power["estimate"] > 0 < claimed
    return row["agrees"] is False, abs(log(power["estimate"] / claimed)) if near else 0.0


def _class_table(document: Document) -> Html:
    """What the fitted profiles predict of classes of integrands."""
    shown = [r for r in document["rates"] if is_class(r) and r["fitted"]["exponent"] is not None]
    claimed = any(r["predicted"]["exponent"] for r in shown)
    rows: list[list[Content]] = []
    for r in shown:
        told = exponent(fixed(r["fitted"]["exponent"]))
        order = prose(exponent(r["predicted"]["exponent"]) + _logarithm(r["predicted"]))
        rows.append([r["integrand"], short(r["region"]), told, *([order] if claimed else [])])
    caption = "Exponents r of the variance N^-r that the fitted profiles predict"
    head = ("class", "region", "r, 95 %", *([prose("claimed, N → ∞")] if claimed else []))
    return table(caption, head, rows) if rows else Html("")


def _logarithm(predicted: Document) -> str:
    return "" if predicted["log_power"] in (None, "0") else ", log N"


def _slope_table(document: Document) -> Html:
    fitted = {r["integrand"]: r["fitted"]["exponent"] for r in document["rates"]}
    rows: list[list[Content]] = []
    for curve in curves_of(document):
        order = "–" if curve.exponent is None else exponent("-" + curve.exponent)
        logarithm = "" if curve.log_power in (None, "0") else ", log N"
        region, told = short(curve.region), fitted.get(curve.integrand)
        rows.append([code(short(curve.integrand)), region, interval(curve.slope),
                     "–" if told is None else exponent(falling(told)),
                     prose(order + logarithm)])  # fmt: skip
    head = ("integrand", "region", "slope, 95 %", "of the fitted profile, 95 %",
            prose("claimed, N → ∞"))  # fmt: skip
    return table("Slopes of the line through log variance", head, rows) if rows else Html("")


def _variance_table(document: Document) -> Html:
    rows: list[list[Content]] = [
        [
            code(short(p["integrand"])), str(p["n"]), str(p["replicates"]),
            interval(p["variance"]), number(float(p["exact"])) if p["exact"] else "–",
            interval(p["raw_mse"]), interval(p["bias"]), number(p["seconds"] / p["replicates"]),
        ]
        for p in document["points"]
    ]  # fmt: skip
    head = ("integrand", prose("N"), "estimates", "variance, 95 %", "claimed",
            "raw mean square error", "raw bias", "s / estimate")  # fmt: skip
    caption = "Variance on randomly shifted points, and the error on raw points"
    return table(caption, head, rows) if rows else Html("")
