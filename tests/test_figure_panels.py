"""Panels: ticks, SVG that takes the colours of its page, files that are the same each time."""

import re
from math import log10
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from hypothesis import given
from hypothesis import strategies as st

pytest.importorskip("matplotlib")

from matplotlib.figure import Figure
from specrate.report.figure_panels import (
    COLOURS,
    MARKERS,
    Panel,
    inline,
    log_axis,
    log_ticks,
    save,
    tick,
    wrapped,
)
from specrate.report.page_style import LIGHT

SVG = "{http://www.w3.org/2000/svg}"


def curve(figure: Any) -> None:
    """Text that mathematics would choke on, a curve, and a picture."""
    ax = figure.subplots()
    ax.plot([1, 10, 100], [1, 1e-3, 1e-5], color=COLOURS[0], marker=MARKERS[0], label="a $ b_")
    log_axis(ax, "x", [1, 100])
    log_axis(ax, "y", [1, 1e-5])
    ax.set_title("<title> & $more$")
    figure.legend(loc="outside lower left")


AXES: Any = Figure().subplots()
PANEL = Panel("<title> & $more$", 'N = 16: "1" < 2', curve, 2.5)


@given(st.floats(-30, 10), st.floats(0.02, 25), st.integers(3, 8))
def test_ticks_lie_on_the_axis_and_are_few_but_not_too_few(
    start: float, span: float, most: int
) -> None:
    low, high = 10.0**start, 10.0 ** (start + span)
    found = log_ticks(low, high, most)
    assert 1 <= len(found) <= most
    assert 1.0 in found or not low <= 1 <= high
    assert found == sorted(set(found))
    assert all(low * (1 - 1e-6) <= v <= high * (1 + 1e-6) for v in found)
    if span > 0.8:
        assert len(found) >= 2


@pytest.mark.parametrize(
    ("low", "high", "ticks"),
    [
        (1, 1000, ["1", "10", "100", "1000"]),
        (0.02, 2, ["0.03", "0.1", "0.3", "1"]),
        (3, 9, ["3", "5", "7"]),
        (1e-9, 1, ["10⁻⁸", "10⁻⁶", "10⁻⁴", "0.01", "1"]),
        (2e5, 3e6, ["3×10⁵", "10⁶", "3×10⁶"]),
    ],
)
def test_ticks_as_written(low: float, high: float, ticks: list[str]) -> None:
    assert [tick(v) for v in log_ticks(low, high)] == ticks


@given(st.floats(1e-12, 1e-2), st.floats(1.0, 1e6))
def test_an_axis_holds_its_values(low: float, factor: float) -> None:
    ax = AXES
    log_axis(ax, "y", [low, low * factor])
    bottom, top = ax.get_ylim()
    assert bottom < low <= low * factor < top
    assert log10(top / bottom) < 1.2 * log10(factor) + 0.2


def test_long_labels_are_wrapped() -> None:
    first, second = wrapped("anisotropic-gaussian:sigma=(0.1,0.5): slope −1.23, claimed −2").split(
        "\n"
    )
    assert first == "anisotropic-gaussian:sigma=(0.1,0.5): slope −1.23,"
    assert second.strip() == "claimed −2"
    assert max(map(len, wrapped("x" * 100).split("\n"))) <= 52


def test_curves_of_one_panel_differ_in_colour_and_marker() -> None:
    for styles in (COLOURS, MARKERS):
        assert len(set(styles)) == len(COLOURS) == 6


@pytest.fixture(scope="module")
def drawn() -> str:
    return inline(PANEL, "x1").text


def test_an_inline_panel_is_well_formed_and_says_what_it_shows(drawn: str) -> None:
    root = ElementTree.fromstring(drawn)
    assert root.get("role") == "img"
    assert root.find(f"{SVG}title").text == PANEL.title
    assert root.find(f"{SVG}desc").text == PANEL.about
    names = (root.get("aria-labelledby") or "").split()
    assert names == [root.find(f"{SVG}title").get("id"), root.find(f"{SVG}desc").get("id")]
    assert float((root.get("viewBox") or "").split()[2]) == pytest.approx(3.5 * 72)
    assert root.get("width") is None


def test_an_inline_panel_takes_all_colours_from_its_page(drawn: str) -> None:
    found = set(re.findall(r"#[0-9a-fA-F]{6}\b", drawn))
    assert not found & set(LIGHT.values())
    assert found <= {"#ffffff", "#000000"}
    assert "currentColor" in drawn
    assert "var(--data1)" in drawn
    assert "<style" not in drawn
    assert "<metadata" not in drawn
    assert "<!--" not in drawn


def test_ids_of_panels_differ_and_their_references_hold(drawn: str) -> None:
    ids = re.findall(r'\bid="([^"]+)"', drawn)
    assert len(set(ids)) == len(ids)
    assert all(i.startswith("x1-") for i in ids)
    used = re.findall(r'(?:href="#|url\(#)([^")]+)', drawn)
    assert used
    assert set(used) <= set(ids)
    assert not set(ids) & set(re.findall(r'\bid="([^"]+)"', inline(PANEL, "x2").text))


def test_files_are_the_same_each_time(tmp_path: Path) -> None:
    for name in ("one", "two"):
        save([PANEL, PANEL, PANEL], [tmp_path / f"{name}.{f}" for f in ("png", "svg")])
    for form in ("png", "svg"):
        first = (tmp_path / f"one.{form}").read_bytes()
        assert first == (tmp_path / f"two.{form}").read_bytes()
    assert b"<dc:date>" not in first
    root = ElementTree.fromstring(first)
    assert root.get("width") == "504pt"  # two columns of 3.5 inches
    assert inline(PANEL, "x1") == inline(PANEL, "x1")
