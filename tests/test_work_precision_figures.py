"""The work-precision diagram: styles that stay apart, and files that are pictures."""

from pathlib import Path
from typing import Any

import pytest
from specrate.numerics.method_tests.work_precision_ladders import PROBLEMS, ladders
from specrate.report import work_precision_figures

Document = dict[str, Any]


@pytest.fixture(scope="module")
def document() -> Document:
    """Made-up points on the ladder of every method."""
    points = [
        {
            "problem": x.problem,
            "method": x.method,
            "relative_error": 10.0 ** (-3 - 12 * i),
            "low": 10.0 ** (-4 - 12 * i) if x.method == "Monte Carlo" else None,
            "high": 10.0 ** (-2 - 12 * i) if x.method == "Monte Carlo" else None,
            "reported_error": None if x.method == "Monte Carlo" else 10.0 ** (-1 - 12 * i),
            "seconds": 1e-5 * 4.0**i,
        }
        for x in ladders(0)
        for i, _ in enumerate(x.steps)
    ]
    return {"points": points, "problems": [{"name": p.name, "about": p.about} for p in PROBLEMS]}


def test_every_method_has_a_style_of_its_own() -> None:
    styles = work_precision_figures._STYLES
    assert set(styles) == {x.method for x in ladders(0)}
    assert len(set(styles.values())) == len(styles)
    assert len({marker for _, marker in styles.values()}) == len(styles)


def test_a_figure_is_drawn(document: Document, tmp_path: Path) -> None:
    paths = [tmp_path / name for name in ("a.png", "a.svg", "b.svg")]
    work_precision_figures.draw(document, paths[:2])
    work_precision_figures.draw(document, paths[2:])
    png, svg = (p.read_bytes() for p in paths[:2])
    assert png.startswith(b"\x89PNG")
    assert int.from_bytes(png[16:20], "big") == 2100  # 7 inches of 300 dots
    text = svg.decode()
    for method in {x.method for x in ladders(0)} | {"relative error", "time for one answer / s"}:
        assert f"<!-- {method} -->" in text
    assert svg == paths[2].read_bytes()


def test_few_points_are_drawn_too(document: Document, tmp_path: Path) -> None:
    few = document | {"points": document["points"][:1]}
    work_precision_figures.draw(few, [tmp_path / "few.png"])
    assert (tmp_path / "few.png").stat().st_size > 1000
