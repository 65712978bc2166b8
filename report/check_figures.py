"""The figures of a check: spectrum, profiles, convergence and error against time."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import log10
from typing import Any

import numpy as np

from ..numerics.measuring.spectrum_pictures import RegionProfile, SpectrumPictures
from .check_convergence import convergence_panels, time_panels
from .check_profiles import FLOOR, MOST_PANELS, chosen, is_drawn, profile_panel, profiles_of
from .check_spectra import colours_told, plane_panels
from .figure_panels import Panel
from .variance_curves import ROUNDING, curves_of

Document = dict[str, Any]


@dataclass(frozen=True)
class CheckFigure:
    """One figure, or why it is missing.

    Parameters
    ----------
    stem : str
        Of the names of its files.
    heading, caption : str
    panels : tuple of Panel
    missing : tuple of str
        What is left out of it, and why.
    paired : bool
        Whether the panels go two by two, measured and claimed.
    """

    stem: str
    heading: str
    caption: str
    panels: tuple[Panel, ...]
    missing: tuple[str, ...] = ()
    paired: bool = False


def figures(document: Document, pictures: SpectrumPictures) -> tuple[CheckFigure, ...]:
    """The four figures of a check, drawn or not.

    Parameters
    ----------
    document : dict
        As ``numerics.check`` gives it.
    pictures : SpectrumPictures
        What was measured of the spectrum beside it. Regions that have no profile there are drawn
        from the frequencies in the document.
    """
    return (
        _spectrum(document, pictures),
        _profiles(document, pictures),
        _convergence(document),
        _error_time(document),
    )


def _spectrum(document: Document, pictures: SpectrumPictures) -> CheckFigure:
    missing: tuple[str, ...] = ()
    if document["plan"]["dim"] == 1:
        missing = ("In one dimension frequencies fill no plane; the profile shows them all.",)
    elif not pictures.planes:
        missing = ("This check averaged no periodogram on a plane of frequencies.",)
    panels = plane_panels(pictures.planes)
    paired = any(p.exact is not None for p in pictures.planes)
    beside = ", beside it the exact spectrum of a claimed sampler" if paired else ""
    caption = (
        "N·P_S at the frequencies m, on logarithmic colours: the mean of N|F|² over realisations "
        f"of the raw points{beside}. Independent points "
        f"have N·P_S = 1 everywhere; m = 0 is left blank"
        f"{'; ' + colours_told(pictures.planes) if pictures.planes else ''}."
    )
    return CheckFigure("spectrum", "Power spectrum", caption, panels, missing, paired)


def merged_profiles(document: Document, pictures: SpectrumPictures) -> tuple[RegionProfile, ...]:
    """The profiles of the pictures, then those of the document's regions that have none there."""
    shown = {p.region for p in pictures.profiles}
    return (
        *pictures.profiles,
        *(p for p in profiles_of(document) if p.region not in shown and p.spectra),
    )


def _profiles(document: Document, pictures: SpectrumPictures) -> CheckFigure:
    every = merged_profiles(document, pictures)
    shown = chosen(every)
    missing: list[str] = []
    if not shown:
        missing.append(_no_spectrum(document))
    elif len(shown) < len(every):
        missing.append(
            f"{len(every) - len(shown)} more regions have a spectrum in check.json; drawn are "
            f"{MOST_PANELS}: those far from the claim, then one of each size, then the first."
        )
    return CheckFigure(
        "profiles",
        "Spectrum along regions",
        _profile_caption(shown),
        tuple(map(profile_panel, shown)),
        tuple(missing),
    )


def _no_spectrum(document: Document) -> str:
    if not document["points"]:
        return "Nothing was measured."
    why = [x["why"] for x in document["left_out"] if x["what"].startswith("spectrum")]
    return f"No spectrum was measured{': ' if why else ''}{'; '.join(why)}."


def _profile_caption(shown: Sequence[RegionProfile]) -> str:
    spectra = [s for p in shown for s in p.spectra]
    levels = sorted({f"{1 - s.level:.6g}" for s in spectra})
    bars = " and ".join(f"{float(level) * 100:.6g} %" for level in levels)
    text = (
        f"N·P_S against the frequency |m|, at frequencies whose nonzero coordinates are those of "
        f"the region: measured on raw points, with intervals of {bars or '95 %'}"
    )
    if any(s.exact is not None for s in spectra):
        text += "; short strokes: exact, of the claimed sampler"
    text += "; dotted line: independent points."
    if any(is_drawn(p) for p in shown):
        text += (
            " Solid curves, in the colour of their N: the fitted profile, the largest of its "
            "monomials γ min(1, (|m|/(α N^e))^b); "
            "shaded: b, about the middle of the rise, and the plateau γ within their intervals."
        )
    if any(np.isinf(s.high).any() for s in spectra):
        text += " A single realisation has no interval."
    if any((s.power < FLOOR).any() for s in spectra):
        text += f" Values below 10^{log10(FLOOR):.0f} are drawn on the lower edge."
    return text


def _convergence(document: Document) -> CheckFigure:
    panels = convergence_panels(document)
    caption = (
        "Variance of the estimator on randomly shifted points, with intervals of 95 %, against N."
    )
    if any(p["exact"] for p in document["points"]):
        caption += (
            " Horizontal dashes: the exact variance of the claimed sampler; below, measured over "
            f"exact, shaded within {document['margin']:.0%} of it."
        )
    if any(c.exponent not in (None, "oo") for c in curves_of(document)):
        caption += (
            " Broken lines: the claimed exponent, drawn through the value at the largest N; it is "
            "that of N → ∞, from which values at small N may depart."
        )
    return CheckFigure("convergence", "Convergence", caption, panels, _undrawn(document, panels))


def _undrawn(document: Document, panels: Sequence[Panel]) -> tuple[str, ...]:
    if not document["points"]:
        return ("No variance was measured.",)
    gone = [c.integrand for c in curves_of(document) if len(c.drawn) < len(c.points)]
    if not gone:
        return () if panels else ("No variance has an interval.",)
    rounding = f"10^{log10(ROUNDING):.0f}"
    return (
        f"Variances below {rounding} are rounding errors of zero and not drawn: {', '.join(gone)}.",
    )


def _error_time(document: Document) -> CheckFigure:
    panels = time_panels(document)
    caption = (
        "Error, the root of the variance on randomly shifted points, against the time of one "
        "estimate: what was spent at an N, on points, integrands and frequencies together, over "
        "the number of randomly shifted point sets. Intervals of 95 % are drawn; where none is "
        "seen it is smaller than the mark."
    )
    missing = () if panels else ("No variance and no time were measured.",)
    return CheckFigure("error_time", "Error against run time", caption, panels, missing)
