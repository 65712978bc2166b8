"""Panels of a check: N·P_S along each region, with intervals, fitted profile and claimed values."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import hypot, inf, log
from typing import Any

import numpy as np

from ..numerics.measuring.moments import Interval
from ..numerics.measuring.spectrum_pictures import (
    FittedMonomial,
    Reals,
    RegionProfile,
    RegionSpectrum,
    profile_at,
    profile_band,
)
from .check_formats import short
from .figure_panels import COLOURS, MARKERS, Panel, log_axis
from .numerals import interval, number
from .page_style import LIGHT

Document = dict[str, Any]

FLOOR = 1e-6
"""N·P_S below which a frequency is drawn on the lower edge."""

MOST_PANELS = 9
"""Regions that are drawn; of more, those that tell most."""

_MOST_POINTS = 40  # of one region and N
_FAR = 1.0  # widths of an interval
_REACH = 10.0  # factor by which intervals widen the vertical axis at most
_DOTTED = (0, (1, 2))  # the line of independent points
_REPORTED = 0.05  # level of the intervals in the document


def profiles_of(document: Document) -> tuple[RegionProfile, ...]:
    """The spectra in the document of a check, region by region, with what was fitted to them."""
    found: list[RegionProfile] = []
    for region in document["regions"]:
        rows = [r for r in region["spectrum"] if r["scaled_power"] is not None]
        counts = sorted({r["n"] for r in rows})
        held = {step["n"]: step["replicates"] for step in document["plan"]["ladder"]}
        spectra = tuple(_spectrum(n, held[n], [r for r in rows if r["n"] == n]) for n in counts)
        monomials = tuple(_monomial(m) for m in region["profile"])
        found.append(RegionProfile(region["region"], spectra, monomials, region["outside_model"]))
    return tuple(found)


def _spectrum(n: int, realisations: int, rows: Sequence[Document]) -> RegionSpectrum:
    rows = sorted(rows, key=lambda r: hypot(*r["frequency"]))
    powers = [r["scaled_power"] for r in rows]
    claimed = [r["predicted"] for r in rows]
    return RegionSpectrum(
        n,
        realisations,
        np.array([hypot(*r["frequency"]) for r in rows]),
        np.array([p["estimate"] for p in powers]),
        np.array([p["low"] for p in powers]),
        np.array([inf if p["high"] is None else p["high"] for p in powers]),
        _REPORTED,
        None if None in claimed else np.array([float(c) for c in claimed]),
    )


def _monomial(found: Document) -> FittedMonomial:
    return FittedMonomial(*(_interval(found[k]) for k in ("degree", "effective", "gamma", "alpha")))


def _interval(found: Document | None) -> Interval | None:
    if found is None:
        return None
    high = inf if found["high"] is None else found["high"]
    return Interval(found["estimate"], found["low"], high)


def chosen(profiles: Sequence[RegionProfile]) -> tuple[RegionProfile, ...]:
    """At most `MOST_PANELS` regions in their order.

    First those far from the claimed spectrum, then one of each size, then as they come.
    """
    shown = [p for p in profiles if p.spectra]
    sizes: set[int] = set()
    ranks: list[tuple[float, bool, int]] = []
    for index, profile in enumerate(shown):
        size, distance = len(profile.region.split(",")), _distance(profile)
        ranks.append((-distance if distance > _FAR else 0.0, size in sizes, index))
        sizes.add(size)
    kept = sorted(index for *_, index in sorted(ranks)[:MOST_PANELS])
    return tuple(shown[index] for index in kept)


def _distance(profile: RegionProfile) -> float:
    """Largest |log(measured/claimed)| in widths of the interval; 0 without a claim."""
    found = [0.0]
    for s in profile.spectra:
        claimed = np.zeros_like(s.power) if s.exact is None else s.exact
        for power, low, high, exact in zip(s.power, s.low, s.high, claimed, strict=True):
            if min(power, low, exact) > 0 and low < high < inf:
                found.append(abs(log(power / exact)) / log(high / low))
    return max(found)


def thinned(spectrum: RegionSpectrum, most: int = _MOST_POINTS) -> RegionSpectrum:
    """At most so many frequencies: those nearest to equal steps of log ρ."""
    if len(spectrum.radius) <= most:
        return spectrum
    logs: Reals = np.log(spectrum.radius)
    wanted: Reals = np.linspace(float(logs.min()), float(logs.max()), most)
    kept = np.unique(np.abs(logs[None, :] - wanted[:, None]).argmin(axis=1))
    exact = None if spectrum.exact is None else spectrum.exact[kept]
    arrays = (getattr(spectrum, k)[kept] for k in ("radius", "power", "low", "high"))
    names = ("radius", "power", "low", "high")
    return replace(spectrum, **dict(zip(names, arrays, strict=True)), exact=exact)


def profile_panel(profile: RegionProfile) -> Panel:
    """One region: every N a colour and a marker of its own."""
    spectra = [thinned(s) for s in _spread(profile.spectra)]
    height = 2.55 + 0.15 * (len(spectra) + 1) + (0.3 if is_drawn(profile) else 0)
    title = f"region {short(profile.region)}"
    return Panel(title, _about(profile), _drawing(profile, spectra, title), height)


def is_drawn(profile: RegionProfile) -> bool:
    """Whether a curve was fitted that can be drawn."""
    return profile_at(profile.monomials, 1, np.ones(1)) is not None


def _spread(spectra: Sequence[RegionSpectrum]) -> list[RegionSpectrum]:
    """As many N as there are colours, the smallest and the largest among them."""
    if len(spectra) <= len(COLOURS):
        return list(spectra)
    places = np.linspace(0, len(spectra) - 1, len(COLOURS)).round().astype(int)
    return [spectra[int(i)] for i in places]


def _drawing(
    profile: RegionProfile, spectra: Sequence[RegionSpectrum], title: str
) -> Callable[[Any], None]:
    def draw(figure: Any) -> None:
        ax = figure.subplots()
        for index, spectrum in enumerate(spectra):
            _measured(ax, spectrum, index)
            _fitted(ax, profile, spectrum, index)
        log_axis(ax, "x", [r for s in spectra for r in s.radius.tolist()])
        log_axis(ax, "y", _heights(spectra))
        ax.axhline(1.0, color=LIGHT["data5"], linewidth=0.6, linestyle=_DOTTED, zorder=0)
        ax.set_xlabel("frequency |m|")
        ax.set_ylabel(r"$N\cdot P_S$", parse_math=True)
        ax.set_title(title)
        columns = 2 if len(spectra) > 1 else 1
        figure.legend(*_legend(ax, profile, spectra), loc="outside lower left", ncols=columns)

    return draw


def _heights(spectra: Sequence[RegionSpectrum]) -> list[float]:
    """What the vertical axis must hold, cut off at `FLOOR`; intervals as far as `_REACH`."""
    values = [v for s in spectra for v in s.power.tolist()] + [1.0]
    values += [v for s in spectra if s.exact is not None for v in s.exact.tolist()]
    values = [max(v, FLOOR) for v in values]
    least, largest = min(values) / _REACH, max(values) * _REACH
    for s in spectra:
        bounded = np.isfinite(s.high)
        ends = [*s.low[bounded].tolist(), *s.high[bounded].tolist()]
        values += [max(min(max(v, least), largest), FLOOR) for v in ends]
    return values


def _measured(ax: Any, s: RegionSpectrum, index: int) -> None:
    colour, marker = COLOURS[index], MARKERS[index]
    power = np.maximum(s.power, FLOOR)
    bounded = np.isfinite(s.high)  # what one realisation gives has no interval to show
    low, high = (np.where(bounded, ends, s.power) for ends in (np.maximum(s.low, FLOOR), s.high))
    ax.errorbar(
        s.radius, power, yerr=[np.maximum(power - low, 0), np.maximum(high - power, 0)],
        color=colour, marker=marker, linestyle="none", elinewidth=0.8, capsize=1.5,
        markeredgewidth=0, zorder=3, label=f"N = {s.n}",
    )  # fmt: skip
    if s.exact is not None:
        drawn = np.maximum(s.exact, FLOOR)
        ax.plot(
            s.radius, drawn, color=LIGHT["ink"], marker="_", markersize=9, linestyle="none",
            markeredgewidth=0.8, zorder=2,
        )  # fmt: skip


def _fitted(ax: Any, profile: RegionProfile, s: RegionSpectrum, index: int) -> None:
    """The fitted profile at this N, and its band."""
    ends = float(s.radius.min()) / 1.1, float(s.radius.max()) * 1.1
    radius: Reals = np.geomspace(*ends, 80)
    curve, band = (f(profile.monomials, s.n, radius) for f in (profile_at, profile_band))
    if curve is None or band is None:
        return
    least, largest = (np.clip(b, FLOOR, 1e6) for b in band)
    ax.fill_between(radius, least, largest, color=COLOURS[index], alpha=0.18, linewidth=0)
    ax.plot(radius, np.maximum(curve, FLOOR), color=COLOURS[index], linestyle="-")


def _legend(
    ax: Any, profile: RegionProfile, spectra: Sequence[RegionSpectrum]
) -> tuple[list[Any], list[str]]:
    from matplotlib.lines import Line2D

    line: Any = Line2D
    handles, labels = ax.get_legend_handles_labels()
    if any(s.exact is not None for s in spectra):
        handles.append(line([], [], color=LIGHT["ink"], marker="_", markersize=9, linestyle="none"))
        labels.append("claimed, exact")
    if is_drawn(profile):
        handles.append(line([], [], color=LIGHT["ink"]))
        labels.append("fitted profile")
    handles.append(line([], [], color=LIGHT["data5"], linewidth=0.6, linestyle=_DOTTED))
    labels.append("independent points")
    return handles, labels


def _about(profile: RegionProfile) -> str:
    """The lowest frequency of every N, and what was fitted, in words."""
    parts: list[str] = []
    for s in profile.spectra:
        first = int(np.argmin(s.radius))
        shown = _text(Interval(s.power[first], s.low[first], s.high[first]))
        claimed = "" if s.exact is None else f", claimed {number(float(s.exact[first]))}"
        parts.append(f"N = {s.n}: N·P_S = {shown}{claimed} at |m| = {s.radius[first]:.4g}")
    parts += [f"fitted profile: {words}" for words in map(monomial_words, profile.monomials)]
    return "; ".join(parts) + "."


def monomial_words(m: FittedMonomial) -> str:
    """A fitted monomial: its degree b, exponent e of N_k = N^e, plateau γ and cut-off α."""
    parts = (("b", m.degree), ("e", m.effective), ("γ", m.gamma), ("α", m.alpha))
    return ", ".join(f"{name} = {_text(value)}" for name, value in parts if value is not None)


def _text(found: Interval) -> str:
    estimate, low, high = (float(v) for v in found)
    return interval({"estimate": estimate, "low": low, "high": high})
