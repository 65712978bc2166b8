"""Panels of a check: variance against N, with exact values and slopes, and error against time."""

from collections.abc import Callable, Sequence
from itertools import pairwise
from math import isfinite, log, sqrt
from typing import Any

from .check_formats import short
from .figure_panels import COLOURS, MARKERS, Panel, log_axis, ticked, wrapped
from .numerals import exponent, interval, number, slope_of
from .page_style import LIGHT
from .variance_curves import ROUNDING, Curve, by_region, curves_of

Document = dict[str, Any]

_MOST_TICKS = 6
_NEAR = 2.0  # ratios of measured to exact up to which the margin gives the ticks


def convergence_panels(document: Document) -> tuple[Panel, ...]:
    """Variance against N, a panel for each region."""
    margin = document["margin"]
    return tuple(
        Panel(
            _title(region),
            " ".join(_about(c) for c in curves),
            _convergence(curves, _title(region), margin),
            _height(_legend_lines(curves)) + (0.75 if _is_claimed(curves) else 0.0),
        )
        for region, curves in by_region(curves_of(document), len(COLOURS))
    )


def time_panels(document: Document) -> tuple[Panel, ...]:
    """Error against the time of one estimate, a panel for each region."""
    found: list[Panel] = []
    for region, curves in by_region(curves_of(document), len(COLOURS)):
        timed = [c for c in curves if all(_seconds(p) > 0 for p in c.drawn)]
        if timed:
            about = " ".join(_time_about(c) for c in timed)
            height, draw = _height(_names(timed)), _error_time(timed, _title(region))
            found.append(Panel(_title(region), about, draw, height))
    return tuple(found)


def _height(labels: Sequence[str]) -> float:
    """Inches of axes and of a legend of these labels."""
    return 2.5 + 0.15 * sum(1 + label.count("\n") for label in labels)


def _names(curves: Sequence[Curve]) -> list[str]:
    return [wrapped(short(c.integrand)) for c in curves]


def _title(region: str) -> str:
    return "all regions together" if region == "overall" else f"region {short(region)}"


def _seconds(point: Document) -> float:
    """Of one randomly shifted estimate, all that was measured at its N counted."""
    return point["seconds"] / point["replicates"]


def _is_claimed(curves: Sequence[Curve]) -> bool:
    return any(_exact(p) > 0 for c in curves for p in c.drawn)


def _convergence(curves: Sequence[Curve], title: str, margin: float) -> Callable[[Any], None]:
    def draw(figure: Any) -> None:
        claimed = _is_claimed(curves)
        share = [3, 1] if claimed else [1]
        axes = figure.subplots(len(share), 1, sharex=True, squeeze=False, height_ratios=share)
        ax = axes[0][0]
        for index, curve in enumerate(curves):
            _variances(ax, curve, index)
            _slope(ax, curve, index)
        log_axis(ax, "y", [v for c in curves for p in c.drawn for v in _ends(p)])
        ax.set_ylabel("variance")
        ax.set_title(title)
        lowest = axes[-1][0]
        if claimed:
            ax.tick_params(labelbottom=False)
            _ratios(lowest, curves, margin)
        _count_axis(lowest, curves)
        figure.legend(*_legend(curves, claimed), loc="outside lower left")

    return draw


def _ends(p: Document) -> list[float]:
    v = p["variance"]
    found = [v["estimate"], v["low"], v["high"], _exact(p)]
    return [x for x in found if x is not None and x > ROUNDING]


def _bars(
    ax: Any, places: Sequence[float], found: Sequence[Document], index: int, size: float = 4.0
) -> None:
    """Estimates with their intervals, in the colour and marker of a curve."""
    middle = [v["estimate"] for v in found]
    below = [max(m - max(v["low"], 0.0), 0.0) for m, v in zip(middle, found, strict=True)]
    above = [
        0.0 if v["high"] is None else max(v["high"] - m, 0.0)
        for m, v in zip(middle, found, strict=True)
    ]
    ax.errorbar(
        places, middle, yerr=[below, above], color=COLOURS[index], marker=MARKERS[index],
        linestyle="none", elinewidth=0.9, capsize=2, markeredgewidth=0, markersize=size, zorder=3,
    )  # fmt: skip


def _changed(found: Document, change: Callable[[float], float]) -> Document:
    """An interval of the document with a monotone change of its ends."""
    return {k: None if v is None else change(max(v, 0.0)) for k, v in found.items()}


def _exact(p: Document) -> float:
    """The exact variance; 0 where there is none."""
    return float(p["exact"] or 0)


def _variances(ax: Any, curve: Curve, index: int) -> None:
    """Measured values with intervals, exact values as dashes of ink behind them."""
    _bars(ax, [p["n"] for p in curve.drawn], [p["variance"] for p in curve.drawn], index)
    exact = [(p["n"], _exact(p)) for p in curve.drawn if _exact(p) > 0]
    if exact:
        ax.plot(
            *zip(*exact, strict=True), color=LIGHT["ink"], marker="_", markersize=12,
            linestyle="none", markeredgewidth=0.8, zorder=2,
        )  # fmt: skip


def _slope(ax: Any, curve: Curve, index: int) -> None:
    """N^-r (log N)^q through the value at the largest N."""
    r, q = slope_of(curve.exponent), slope_of(curve.log_power or "0")
    if r is None or q is None or len(curve.drawn) < 2:
        return
    last = curve.drawn[-1]
    n0, v0 = last["n"], _exact(last) or last["variance"]["estimate"]
    first = max(curve.drawn[0]["n"], 2)
    places = [first * (n0 / first) ** (i / 40) for i in range(41)]
    values = [v0 * (n / n0) ** -r * (log(n) / log(n0)) ** q for n in places]
    ax.plot(places, values, color=COLOURS[index], linestyle=(0, (4, 2)), linewidth=0.8, zorder=2)


def _ratios(ax: Any, curves: Sequence[Curve], margin: float) -> None:
    """Measured over exact, and the margin within which a claim holds."""
    ends = [1 / (1 + margin), 1 + margin]
    values = [ends[0] / 1.1, ends[1] * 1.1]
    for index, curve in enumerate(curves):
        points = [p for p in curve.drawn if _exact(p) > 0]
        ratios = [_changed(p["variance"], lambda v, p=p: v / _exact(p)) for p in points]
        _bars(ax, [p["n"] for p in points], ratios, index, size=3.0)
        values += [x for v in ratios for x in v.values() if x is not None and x > ROUNDING]
    ax.axhspan(*ends, color=LIGHT["data5"], alpha=0.2, linewidth=0)
    ax.axhline(1.0, color=LIGHT["ink"], linewidth=0.6)
    log_axis(ax, "y", values, most=3)
    if max(values) < _NEAR and min(values) > 1 / _NEAR:
        ticked(ax, "y", [ends[0], 1.0, ends[1]])
    ax.set_ylabel("measured /\nexact")


def _count_axis(ax: Any, curves: Sequence[Curve]) -> None:
    """The measured N as ticks, where they are few and far enough apart."""
    counts = sorted({p["n"] for c in curves for p in c.drawn})
    log_axis(ax, "x", counts)
    gap = log(counts[-1] / counts[0]) / 8 if len(counts) > 1 else 0.0
    if len(counts) <= _MOST_TICKS and all(log(b / a) >= gap for a, b in pairwise(counts)):
        ticked(ax, "x", counts)
    ax.set_xlabel(r"$N$", parse_math=True)


def _legend_lines(curves: Sequence[Curve]) -> list[str]:
    claimed = ["claimed, exact"] if _is_claimed(curves) else []
    return [wrapped(_words(c)) for c in curves] + claimed


def _words(curve: Curve) -> str:
    """The integrand with its measured slope and the claimed one."""
    text = short(curve.integrand)
    if curve.slope is not None:
        text += f": slope {_fixed(curve.slope['estimate'])}"
    if slope_of(curve.exponent) is not None:
        text += f", claimed {exponent('-' + str(curve.exponent))}"
        text += "" if curve.log_power in (None, "0") else ", log N"
    return text


def _fixed(value: float) -> str:
    return f"{value:.2f}".replace("-", "−")


def _legend(curves: Sequence[Curve], claimed: bool) -> tuple[list[Any], list[str]]:
    lines = ["none" if slope_of(c.exponent) is None else (0, (4, 2)) for c in curves]
    handles = _samples(lines)
    if claimed:
        handles += _samples(["none"], LIGHT["ink"], "_", 9)
    return handles, _legend_lines(curves)


def _samples(lines: Sequence[Any], colour: str = "", marker: str = "", size: int = 4) -> list[Any]:
    """Samples of curves for a legend, in the colours and markers of their order or in others."""
    from matplotlib.lines import Line2D

    line: Any = Line2D
    return [
        line([], [], color=colour or COLOURS[i], marker=marker or MARKERS[i], markersize=size,
             markeredgewidth=0.8 if marker else 0, linestyle=style, linewidth=0.8)
        for i, style in enumerate(lines)
    ]  # fmt: skip


def _error_time(curves: Sequence[Curve], title: str) -> Callable[[Any], None]:
    def draw(figure: Any) -> None:
        ax = figure.subplots()
        for index, curve in enumerate(curves):
            places = [_seconds(p) for p in curve.drawn]
            errors = [_changed(p["variance"], sqrt) for p in curve.drawn]
            _bars(ax, places, errors, index)
            ax.plot(places, [e["estimate"] for e in errors], color=COLOURS[index], linewidth=0.7)
        log_axis(ax, "x", [_seconds(p) for c in curves for p in c.drawn], most=4)
        log_axis(ax, "y", [sqrt(v) for c in curves for p in c.drawn for v in _ends(p)])
        ax.set_xlabel("seconds per estimate")
        ax.set_ylabel("error (root of the variance)")
        ax.set_title(title)
        figure.legend(_samples(["-"] * len(curves)), _names(curves), loc="outside lower left")

    return draw


def _about(curve: Curve) -> str:
    """Every value of a curve in words."""
    parts = [
        f"N = {p['n']}: variance {interval(p['variance'])}"
        + ("" if p["exact"] is None else f", claimed {number(float(p['exact']))}")
        for p in curve.drawn
    ]
    slope = "" if curve.slope is None else f"; slope {interval(curve.slope)}"
    claimed = "" if curve.exponent is None else f", claimed exponent {exponent(curve.exponent)}"
    return f"{short(curve.integrand)}: {'; '.join(parts)}{slope}{claimed}."


def _time_about(curve: Curve) -> str:
    parts = [
        f"N = {p['n']}: error {number(sqrt(p['variance']['estimate']))} in {number(_seconds(p))} s"
        for p in curve.drawn
        if isfinite(_seconds(p))
    ]
    return f"{short(curve.integrand)}: {'; '.join(parts)}."
