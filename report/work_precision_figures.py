"""The work-precision diagram, drawn: relative error against seconds, both logarithmic.

The axis of errors is broken at the rounding of doubles: above it, where most methods end, a decade
has more room than below, where the others go on to a hundred digits.
"""

import importlib.util
from collections.abc import Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

from ..theory.errors import InputError

Document = dict[str, Any]

# Colours of Okabe and Ito, apart for colour-blind readers, and markers that are apart in grey.
_STYLES: Mapping[str, tuple[str, str]] = {
    "closed form, balls": ("#0072B2", "o"),
    "covariogram, balls": ("#0072B2", "D"),
    "quadrature, balls": ("#009E73", "s"),
    "mpmath.quad": ("#E69F00", "^"),
    "scipy quad": ("#D55E00", "v"),
    "closed form, doubles": ("#000000", "*"),
    "lattice sum": ("#CC79A7", "P"),
    "Monte Carlo": ("#56B4E9", "X"),
}
_OTHER = ("#666666", ".")
_TITLES = {
    "b = 2, s = 2, p = 3, N = 1e6": r"$b = 2$, $s = 2$, $p = 3$, $N = 10^6$",
    "variance, R = 1/4, d = 2, N = 1e4": r"variance, $R = 1/4$, $d = 2$, $N = 10^4$",
}
_SETTINGS = {
    "font.family": "DejaVu Sans",
    "font.size": 8,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "svg.hashsalt": "work-precision",  # the same picture has the same bytes
}
_SIZE, _DOTS = (7.0, 4.8), 300  # inches, and dots per inch of the PNG
_ROUNDING = 2.0**-53
_BREAK, _MOST, _LEAST = 1e-17, 10.0, 1e-40  # errors: where the axis breaks, and its least reach
_NOTE = "thin bars: the error that a method reports; of Monte Carlo: 95 % interval"


def require_matplotlib() -> None:
    """Refuse in one line where there is nothing to draw with.

    Raises
    ------
    InputError
        If matplotlib is not installed.
    """
    if importlib.util.find_spec("matplotlib") is None:
        raise InputError('figures need matplotlib (pip install "specrate[figures]"): got none')


def draw(document: Document, paths: Sequence[Path]) -> None:
    """The diagram of a work-precision document, written to each path in the format of its suffix.

    Parameters
    ----------
    document : dict
        As ``numerics.work_precision`` gives it.
    paths : sequence of Path
        Ending in .png, .svg or .pdf.
    """
    import matplotlib
    from matplotlib.figure import Figure

    library: Any = matplotlib
    with library.rc_context(_SETTINGS):
        figure: Any = Figure(figsize=_SIZE, layout="constrained")
        figure.get_layout_engine().set(h_pad=0.02, hspace=0)
        shown = _panels(figure, document)
        ordered = [m for m in _STYLES if m in shown]
        figure.legend(
            [shown[m] for m in ordered], ordered, loc="outside lower center", ncols=4,
            frameon=False, title=_NOTE, title_fontsize=7,
        )  # fmt: skip
        figure.draw_without_rendering()
        figure.set_layout_engine("none")  # laid out once: every format is the same picture
        for path in paths:
            kept = {"Date": None} if path.suffix == ".svg" else {}
            figure.savefig(path, dpi=_DOTS, metadata=kept)


def _panels(figure: Any, document: Document) -> dict[str, Any]:
    """A column per problem, above and below the break; the handles of the legend."""
    problems = document["problems"]
    upper, lower = figure.subplots(2, len(problems), sharex="col", sharey="row", squeeze=False)
    shown: dict[str, Any] = {}
    for index, problem in enumerate(problems):
        points = [p for p in document["points"] if p["problem"] == problem["name"]]
        for ax in (upper[index], lower[index]):
            shown |= _curves(ax, points)
        _decorate(upper[index], lower[index])
        about = _TITLES.get(problem["about"], problem["about"])
        title = f"({'abcdef'[index]}) {problem['name']}: {about}"
        upper[index].set_title(title, loc="left", fontsize=8)
    _limit(upper[0], lower[0], document["points"])
    figure.supylabel("relative error", fontsize=8)
    return shown


def _curves(ax: Any, points: Sequence[Document]) -> dict[str, Any]:
    """A curve per method, with what it reports; the handles of the legend."""
    ax.set_xscale("log")
    ax.set_yscale("log")
    handles: dict[str, Any] = {}
    for method, group in groupby(sorted(points, key=_method), key=_method):
        colour, marker = _STYLES.get(method, _OTHER)
        curve = [p for p in group if p["relative_error"]]
        x, y = [p["seconds"] for p in curve], [p["relative_error"] for p in curve]
        handles[method] = ax.plot(
            x, y, color=colour, marker=marker, markersize=7 if marker == "*" else 4.5,
            linewidth=0.9, markeredgecolor="white", markeredgewidth=0.4, zorder=3,
        )[0]  # fmt: skip
        for p in curve:
            _bar(ax, p, colour)
    return handles


def _method(point: Document) -> str:
    return point["method"]


def _bar(ax: Any, p: Document, colour: str) -> None:
    """An interval where there is one; else a thin line up to the error that the method reports."""
    x, y = p["seconds"], p["relative_error"]
    if p["low"] is not None:
        ends = [[y - p["low"]], [p["high"] - y]]
        ax.errorbar([x], [y], yerr=ends, color=colour, linewidth=0.9, capsize=2.5, zorder=2)
    elif p["reported_error"]:
        ax.plot([x, x], [y, p["reported_error"]], color=colour, linewidth=0.5, zorder=1)
        ax.plot([x], [p["reported_error"]], color=colour, marker="_", markersize=5, zorder=1)


def _limit(upper: Any, lower: Any, points: Sequence[Document]) -> None:
    errors = [v for p in points for v in (p["relative_error"], p["high"], p["reported_error"]) if v]
    upper.set_ylim(_BREAK, 3 * max(_MOST, *errors))
    lower.set_ylim(min(_LEAST, *errors) / 1e4, _BREAK)


def _decorate(upper: Any, lower: Any) -> None:
    from matplotlib import ticker

    locators: Any = ticker
    for ax, spacing in ((upper, 4), (lower, 20)):
        powers = range(-16, 40, spacing) if ax is upper else range(-20, -400, -spacing)
        ax.yaxis.set_major_locator(locators.FixedLocator([10.0**k for k in powers if k > -308]))
        ax.yaxis.set_minor_locator(locators.NullLocator())
        ax.xaxis.set_major_locator(locators.LogLocator(numticks=12))
        ax.xaxis.set_minor_locator(locators.NullLocator())
        ax.grid(color="0.92", linewidth=0.5)
        ax.set_axisbelow(True)
    # Two slanted strokes on either side say that the axis is broken.
    strokes = {"marker": [(-1, -0.5), (1, 0.5)], "markersize": 6, "linestyle": "none",
               "color": "black", "markeredgewidth": 0.6, "clip_on": False}  # fmt: skip
    upper.plot([0], [0], transform=upper.transAxes, **strokes)
    lower.plot([0], [1], transform=lower.transAxes, **strokes)
    upper.spines["bottom"].set_visible(False)
    upper.tick_params(bottom=False)
    upper.axhline(_ROUNDING, color="0.6", linewidth=0.6, linestyle=(0, (4, 3)), zorder=0)
    upper.annotate(
        "double precision", (1, _ROUNDING), xycoords=("axes fraction", "data"), ha="right",
        va="bottom", color="0.45", fontsize=7,
    )  # fmt: skip
    lower.set_xlabel("time for one answer / s")
