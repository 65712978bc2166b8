"""Panels of a check: N·P_S on planes of two coordinates, measured and claimed, as pictures."""

from collections.abc import Callable, Sequence
from math import floor, log10
from typing import Any

import numpy as np

from ..numerics.measuring.periodograms import Box
from ..numerics.measuring.spectrum_pictures import PlaneSpectrum, Reals
from .figure_panels import Panel, log_ticks, ticked
from .numerals import number

LEAST = 1e-4
"""N·P_S below which the colours are clipped."""

COLOUR_MAP = "viridis"
"""Perceptually uniform, and read alike with any colour vision (van der Walt, Smith, 2015)."""

Scale = tuple[float, float]


def plane_panels(planes: Sequence[PlaneSpectrum]) -> tuple[Panel, ...]:
    """The measured spectrum of every plane, beside it the claimed one; one scale for both."""
    found: list[Panel] = []
    for plane in planes:
        n, spectra = plane.measured.n, _scaled(plane)
        scale = _scale(spectra)
        found.append(_panel(plane, spectra[0], scale, f"measured, N = {n}", True))
        for exact in spectra[1:]:
            found.append(_panel(plane, exact, scale, f"claimed, exact, N = {n}", False))
    return tuple(found)


def colours_told(planes: Sequence[PlaneSpectrum]) -> str:
    """Where the colours end, in words; a plane may have ends of its own."""
    ends = [_ends(plane) for plane in planes]
    lows, highs = ({number(scale[i]) for scale, _ in ends} for i in (0, 1))
    if len(lows) == len(highs) == 1:
        text = f"colours go from {lows.pop()} to {highs.pop()}"
    else:
        text = "colours end where the bar beside each picture does"
    return text + (", smaller values having the first" if any(c for _, c in ends) else "")


def _scaled(plane: PlaneSpectrum) -> list[Reals]:
    """N·P_S as measured, and as claimed if it is, without m = 0."""
    shown = [plane.measured.mean, *([] if plane.exact is None else [plane.exact])]
    return [_without_zero(plane.measured.n * s) for s in shown]


def _ends(plane: PlaneSpectrum) -> tuple[Scale, bool]:
    """The ends of the colours, and whether some value is smaller."""
    spectra = _scaled(plane)
    scale = _scale(spectra)
    return scale, any(float(np.nanmin(s)) < scale[0] for s in spectra)


def _without_zero(scaled: Reals) -> Reals:
    """The spectrum but for m = 0, where P_S = 1 whatever the points are."""
    found = scaled.copy()
    found[tuple(size // 2 for size in found.shape)] = np.nan
    return found


def _scale(spectra: Sequence[Reals]) -> Scale:
    """Ends of the colours: 1, 2 or 5 times a power of ten, around the values and 1."""
    low = min(float(np.nanmin(s)) for s in spectra)
    high = max(float(np.nanmax(s)) for s in spectra)
    return _rounded(min(max(low, LEAST), 0.1), down=True), _rounded(max(high, 2.0), down=False)


def _rounded(value: float, down: bool) -> float:
    power = 10.0 ** floor(log10(value))
    steps = [k * power for k in (1, 2, 5, 10)]
    slack = 1 + 1e-9
    if down:
        return max(s for s in steps if s <= value * slack)
    return min(s for s in steps if s * slack >= value)


def _panel(plane: PlaneSpectrum, scaled: Reals, scale: Scale, title: str, measured: bool) -> Panel:
    return Panel(title, _about(plane, scaled, measured), _drawing(plane, scaled, scale, title), 3.1)


def _drawing(
    plane: PlaneSpectrum, scaled: Reals, scale: Scale, title: str
) -> Callable[[Any], None]:
    def draw(figure: Any) -> None:
        from matplotlib.colors import LogNorm

        norm: Any = LogNorm
        ax = figure.subplots()
        k1, k2 = _half_widths(plane)
        image = ax.imshow(
            np.maximum(scaled.T, LEAST), norm=norm(*scale), cmap=COLOUR_MAP, origin="lower",
            extent=(-k1 - 0.5, k1 + 0.5, -k2 - 0.5, k2 + 0.5), interpolation="none", aspect="auto",
        )  # fmt: skip
        ax.set_box_aspect((2 * k2 + 1) / (2 * k1 + 1))
        first, second = plane.coordinates
        ax.set_xlabel(rf"$m_{{{first}}}$", parse_math=True)
        ax.set_ylabel(rf"$m_{{{second}}}$", parse_math=True)
        ax.set_title(title)
        clipped = float(np.nanmin(scaled)) < scale[0]
        side = ax.inset_axes([1.04, 0.0, 0.05, 1.0])
        bar = figure.colorbar(image, cax=side, extend="min" if clipped else "neither")
        ticked(bar.ax, "y", log_ticks(*scale))
        bar.ax.grid(visible=False)
        bar.set_label(r"$N\cdot P_S$  (logarithmic)", parse_math=True)

    return draw


def _half_widths(plane: PlaneSpectrum) -> tuple[int, int]:
    where = plane.measured.where
    assert isinstance(where, Box)
    first, second = where.half_widths
    return first, second


def _about(plane: PlaneSpectrum, scaled: Reals, measured: bool) -> str:
    """The three lowest frequencies, and the range."""
    k1, k2 = _half_widths(plane)
    low = [(1, 0), (0, 1), (1, 1)]
    parts = [f"N·P_S = {number(float(scaled[k1 + a, k2 + b]))} at m = ({a}, {b})" for a, b in low]
    least, largest = float(np.nanmin(scaled)), float(np.nanmax(scaled))
    first, second = plane.coordinates
    reach = (
        f"on |m_{first}| ≤ {k1}, |m_{second}| ≤ {k2} between {number(least)} and {number(largest)}"
    )
    mean = f"Mean of {plane.measured.realisations} realisations. " if measured else ""
    mean += f"Coordinates {first} and {second}: "
    return f"{mean}{', '.join(parts)}; {reach}. Independent points have N·P_S = 1 everywhere."
