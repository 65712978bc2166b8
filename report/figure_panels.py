"""Panels of figures: each an SVG that takes the colours of its page, all of them a PNG and an SVG.

A panel is drawn with the colours on white of `page_style`. On a page it has no ground, and every
colour becomes the variable of its name, so that it follows the page into the dark. Text is drawn as
outlines, which look the same wherever they are read. Nothing depends on the clock or on chance.
"""

import io
import re
from collections.abc import Callable, Generator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from html import escape
from math import ceil, floor, log10
from pathlib import Path
from textwrap import fill
from typing import Any

from .markup import Html
from .numerals import raised
from .page_style import LIGHT, SERIES

WIDTH = 3.5
"""Inches of a panel."""

COLOURS = tuple(LIGHT[name] for name in SERIES)
MARKERS = ("o", "s", "^", "D", "v", "P")
"""Of the curves of one panel, as many as there are colours."""

_SETTINGS = {
    "font.family": "DejaVu Sans",
    "font.size": 8,
    "axes.titlesize": 8.5,
    "axes.titlelocation": "left",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "axes.edgecolor": LIGHT["ink"],
    "axes.labelcolor": LIGHT["ink"],
    "text.color": LIGHT["ink"],
    "xtick.color": LIGHT["ink"],
    "ytick.color": LIGHT["ink"],
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "grid.color": LIGHT["grid"],
    "grid.linewidth": 0.5,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "legend.fontsize": 7.5,
    "lines.linewidth": 1.0,
    "lines.markersize": 4.0,
    "text.parse_math": False,  # names of integrands may hold a dollar
    "svg.hashsalt": "panels",
    "svg.fonttype": "path",
}
_DOTS = 300  # per inch of the PNG
_LEADS = ((1,), (1, 3), (1, 2, 5), (1, 1.5, 2, 3, 5, 7))  # leading digits of ticks
_SLACK = 1e-9  # relative, for rounding
_ENOUGH = 3  # ticks of an axis
_LETTERS = 52  # on a line of a legend
_FEW = 4  # panels up to which two stand in a row of a file, then three


@dataclass(frozen=True)
class Panel:
    """One system of axes with its legend.

    Parameters
    ----------
    title : str
        One line.
    about : str
        What it shows, in numbers, for who cannot see it.
    draw : callable
        Draws it on an empty figure of matplotlib.
    height : float
        Inches.
    """

    title: str
    about: str
    draw: Callable[[Any], None]
    height: float = 3.0


def wrapped(label: str) -> str:
    """A label of a legend, on as many lines as it needs."""
    return fill(label, _LETTERS, subsequent_indent="   ", break_on_hyphens=False)


@contextmanager
def _settings() -> Generator[None]:
    import matplotlib

    library: Any = matplotlib
    with library.rc_context(_SETTINGS):
        yield


def inline(panel: Panel, prefix: str) -> Html:
    """The panel as an SVG element of a page; ``prefix`` makes its ids differ from all others."""
    from matplotlib.figure import Figure

    written = io.StringIO()
    with _settings():
        figure: Any = Figure(figsize=(WIDTH, panel.height), layout="constrained")
        panel.draw(figure)
        figure.savefig(written, format="svg", transparent=True, metadata={"Date": None})
    return Html(_on_page(written.getvalue(), panel, prefix))


def _on_page(svg: str, panel: Panel, prefix: str) -> str:
    """The SVG without what belongs to a file of its own, named, and in the colours of the page."""
    body = svg[svg.index("<svg") :]
    body = re.sub(r"\s*<(metadata|style)\b.*?</\1>|\s*<!--.*?-->", "", body, flags=re.S)
    body = re.sub(r'\bid="', f'id="{prefix}-', body)
    body = re.sub(r'((?:xlink:)?href="#|url\(#)', rf"\1{prefix}-", body)
    for name, value in LIGHT.items():
        body = body.replace(value, "currentColor" if name == "ink" else f"var(--{name})")
    box = re.search(r'viewBox="[^"]*"', body)
    head = (
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        f'{box.group() if box else ""} role="img" aria-labelledby="{prefix}-t {prefix}-d">'
        f'<title id="{prefix}-t">{escape(panel.title)}</title>'
        f'<desc id="{prefix}-d">{escape(panel.about)}</desc>'
    )
    return head + re.sub(r"\s*\n\s*", "\n", body[body.index(">") + 1 :]).strip()


def save(panels: Sequence[Panel], paths: Sequence[Path], paired: bool = False) -> None:
    """All panels in one picture on white, written to each path in the format of its suffix."""
    from matplotlib.figure import Figure

    columns = min(len(panels), 2 if paired or len(panels) <= _FEW else 3)
    rows = [panels[i : i + columns] for i in range(0, len(panels), columns)]
    heights = [max(p.height for p in row) for row in rows]
    with _settings():
        figure: Any = Figure(figsize=(WIDTH * columns, sum(heights)), layout="constrained")
        places = figure.subfigures(len(rows), columns, squeeze=False, height_ratios=heights)
        for place, panel in zip((p for row in places for p in row), panels, strict=False):
            panel.draw(place)
        for path in paths:
            kept = {"Date": None} if path.suffix == ".svg" else {}
            figure.savefig(path, dpi=_DOTS, metadata=kept, facecolor=LIGHT["paper"])
            figure.set_layout_engine("none")  # what is laid out stays for the next format


def log_axis(ax: Any, axis: str, values: Sequence[float], most: int = 6) -> None:
    """A logarithmic axis, ``x`` or ``y``, that holds the values with a margin; its ticks."""
    low, high = log10(min(values)), log10(max(values))
    margin = max(0.06 * (high - low), 0.08)
    ends = (10 ** (low - margin), 10 ** (high + margin))
    getattr(ax, f"set_{axis}scale")("log")
    getattr(ax, f"set_{axis}lim")(*ends)
    ticked(ax, axis, log_ticks(*ends, most))


def ticked(ax: Any, axis: str, places: Sequence[float]) -> None:
    """Ticks at these places only, written out."""
    from matplotlib import ticker

    kinds: Any = ticker
    line = getattr(ax, f"{axis}axis")
    line.set_major_locator(kinds.FixedLocator(list(places)))
    line.set_major_formatter(kinds.FixedFormatter([tick(v) for v in places]))
    line.set_minor_locator(kinds.NullLocator())
    ax.grid(visible=True, axis=axis)


def log_ticks(low: float, high: float, most: int = 6) -> list[float]:
    """At most so many places between two values: powers of ten, and between if few; 1 stays."""
    first, last = ceil(log10(low) - _SLACK), floor(log10(high) + _SLACK)
    found: list[float] = []
    for leads in _LEADS:
        every = [lead * 10.0**k for k in range(first - 1, last + 1) for lead in leads]
        found = [v for v in every if low * (1 - _SLACK) <= v <= high * (1 + _SLACK)]
        if len(found) >= _ENOUGH:
            break
    if not found:
        return [low, high]
    step = ceil(len(found) / most)
    kept = next((i for i, v in enumerate(found) if abs(v - 1) < _SLACK), len(found) - 1)
    return found[kept % step :: step]


def tick(value: float) -> str:
    """``0.01``, ``200``, ``10⁻⁵``, ``2×10⁶``."""
    if 1e-3 <= value < 1e4:
        return f"{value:.3g}" if value < 1000 else f"{value:.0f}"
    power = floor(log10(value) + 1e-9)
    lead = f"{value / 10.0**power:.2g}"
    return ("" if lead == "1" else f"{lead}×") + f"10{raised(str(power))}"
