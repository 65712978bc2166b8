"""Fitted profiles in the document of a check, and the rates they predict, as rows of tables."""

from collections.abc import Iterator
from typing import Any

Document = dict[str, Any]
Rows = list[tuple[str, ...]]

PARAMETERS = {"degree": "b", "effective": "e", "gamma": "γ", "alpha": "α"}
"""Parameters of a fitted monomial, as they are written."""

FIT_TITLE = (
    "Profiles fitted to the spectra, N·P_S = γ min(1, (|m|/(α N^e))^b); estimates, on which no "
    "claim is judged"
)
RATE_TITLE = (
    "Exponents r of the variance ~ N^-r that the fitted profiles predict, of the integrands "
    "measured and of the classes worst and best"
)


def fixed(found: Document | None) -> str:
    """``2.03 [1.50, 2.62]``; ``-`` where nothing is known."""
    if found is None:
        return "-"
    high = "oo" if found["high"] is None else f"{found['high']:.2f}"
    return f"{found['estimate']:.2f} [{found['low']:.2f}, {high}]"


def falling(found: Document | None) -> str:
    """The slope of a variance ~ N^-r, for r as an interval: ``-1.49 [-1.54, -1.45]``."""
    if found is None:
        return "-"
    low = "-oo" if found["high"] is None else f"{-found['high']:.2f}"
    return f"{-found['estimate']:.2f} [{low}, {-found['low']:.2f}]"


def fit_rows(document: Document) -> Rows:
    """Per region its fitted monomials: region, b, e, γ, α; nothing of fits that tell nothing."""
    return [
        (g["region"], *(fixed(m[name]) for name in PARAMETERS))
        for g in document["regions"]
        for m in g["profile"]
        if any(m[name] for name in PARAMETERS)
    ]


def rate_rows(document: Document) -> Rows:
    """Integrand or class, region, exponent from the fits, claimed exponent."""
    return [
        (r["integrand"], r["region"], fixed(r["fitted"]["exponent"]), _claimed(r["predicted"]))
        for r in document["rates"]
        if r["fitted"]["exponent"] is not None
    ]


def is_class(rate: Document) -> bool:
    """Whether a row of the rates is of a class, of which nothing is measured."""
    return rate["integrand"] in ("worst", "best")


def _claimed(predicted: Document) -> str:
    exponent, power = predicted["exponent"], predicted["log_power"]
    if exponent is None:
        return "-"
    return exponent if power == "0" else f"{exponent}, (log N)^{power}"


def fit_remarks(document: Document) -> Iterator[str]:
    """Why profiles, or parameters of them, are missing; regions of one reason together."""
    reasons: dict[str, list[str]] = {}
    for g in document["regions"]:
        if g["outside_model"]:
            reasons.setdefault(f"no profile fits: {g['outside_model']}", []).append(g["region"])
        elif g["reason"]:
            reasons.setdefault(g["reason"], []).append(g["region"])
    for reason, names in reasons.items():
        yield f"Fit on {'; '.join(names)}: {reason}."
