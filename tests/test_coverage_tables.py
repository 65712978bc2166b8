"""docs/profile-fits.md: its tables are those of docs/profile-fits.json, and say what they must."""

from pathlib import Path

import numpy as np
import pytest
from specrate.numerics.fitting.coverage_tables import (
    Count,
    cell,
    document,
    filled,
    read,
    rows_of,
    straight_lines,
    tables,
)
from specrate.numerics.fitting.coverage_truths import TRUTHS
from specrate.numerics.fitting.fit_coverage import (
    LADDER,
    MEASURED,
    interval_of_share,
    label,
    main,
    surely_low,
)
from specrate.numerics.fitting.log_log_lines import fit_line
from specrate.numerics.fitting.profile_fits import EstimatedSpectrum

DOCS = Path(__file__).parents[1] / "docs"
ROWS = read((DOCS / "profile-fits.json").read_text(encoding="utf-8"))
LAW = [r for r in ROWS if r.budget in {label(b) for b in LADDER}]
TRUE = {t.name: t for t in TRUTHS}


def test_the_page_has_the_tables_of_the_counts():
    page = (DOCS / "profile-fits.md").read_text(encoding="utf-8")
    assert filled(page, ROWS) == page
    for title, table in tables(ROWS).items():
        assert f"<!-- {title} -->\n{table}\n\n" in page


def test_tables_replace_older_ones_and_nothing_else():
    empty = "A\n\n<!-- degree -->\n\nB\n\nC\n\n<!-- gamma -->\n\n"
    page = filled(empty, ROWS)
    assert page.startswith("A\n\n<!-- degree -->\n| truth |")
    assert "\n\nB\n\nC\n\n<!-- gamma -->\n| truth |" in page
    assert filled(page, ROWS) == page
    assert filled(page, ROWS[5:]) != page
    assert "\n\nB\n\nC\n\n<!-- gamma -->\n| truth |" in filled(page, ROWS[5:])


def test_the_counts_read_back():
    assert read(document(ROWS)) == ROWS


def test_every_truth_has_every_budget():
    assert {(r.truth, r.budget) for r in LAW} == {(t, label(b)) for t in TRUE for b in LADDER}
    assert min(r.runs for r in LAW) >= 200


@pytest.mark.parametrize("row", [pytest.param(r, id=f"{r.truth}, {r.budget}") for r in LAW])
def test_intervals_of_b_and_e_hold_the_truth_in_93_per_cent(row):
    b, e = row.intervals["degree"], row.intervals["effective"]
    assert b.held >= 0.93 * b.stated > 0
    if TRUE[row.truth].effective is None:
        assert e.stated <= 0.07 * row.runs
    else:
        assert e.held >= 0.93 * e.stated > 0


@pytest.mark.parametrize("name", TRUE)
def test_intervals_become_shorter_from_budget_to_budget(name):
    for what in ("degree", "effective"):
        if what == "degree" or TRUE[name].effective is not None:
            ladder = [r.intervals[what] for r in LAW if r.truth == name]
            widths = [c.width for c in ladder if c.stated > 100]
            assert widths == sorted(widths, reverse=True)
            assert widths[-1] < widths[0] / 2


def test_straight_lines_become_sure_of_a_wrong_degree():
    for name in ("jitter 1D", "difference jitter 1D", "cloaked lattice, β = 0.5, c = 0.25"):
        held = [r.lines["degree"].held / r.lines["degree"].stated for r in LAW if r.truth == name]
        assert held[-1] < 0.05
        assert held[-1] <= held[0]


def test_no_spectrum_was_taken_to_be_outside_the_model():
    assert sum(r.outside for r in ROWS) == 0


def test_a_cell_says_in_how_many_runs_there_was_an_interval():
    assert cell(Count(200, 190, 0.5), 200) == "95.0 % (0.5)"
    assert cell(Count(50, 49, 0.5), 200) == "98.0 % (0.5), in 25 %"
    assert cell(Count(0, 0, None), 200) == "none"


def test_runs_are_kept_and_counted(tmp_path, capsys):
    """A file of runs is gone on with, not begun again, and its counts are those printed."""
    path = tmp_path / "runs.jsonl"
    asked = ["--output", str(path), "--truth", "difference", "--seed", "3"]
    assert main([*asked, "--runs", "2"]) == 0
    first = path.read_text(encoding="utf-8")
    assert main([*asked, "--runs", "2"]) == 0
    assert path.read_text(encoding="utf-8") == first
    rows = list(rows_of(path, 3))
    assert [r.runs for r in rows] == [2] * len(LADDER)
    assert "of 2, " in capsys.readouterr().out
    assert rows[3].intervals["degree"].width == pytest.approx(
        next(r for r in LAW if r.budget == rows[3].budget and "difference" in r.truth)
        .intervals["degree"]
        .width,
        rel=0.3,
    )


def test_low_coverage_is_told_from_chance():
    right, wrong, none = [1.0, 0.1], [0.0, 0.1], [None, None]
    assert not surely_low([right] * 93 + [wrong] * 7, 0)
    assert surely_low([right] * 60 + [wrong] * 40, 0)
    assert not surely_low([none] * 10, 0)
    assert not surely_low([none] * 99 + [wrong], 0, absent=True)
    assert surely_low([none] * 60 + [wrong] * 40, 0, absent=True)


def test_the_interval_of_a_share_is_that_of_clopper_and_pearson():
    assert interval_of_share(0, 10) == (0.0, pytest.approx(1 - 0.025 ** (1 / 10)))
    assert interval_of_share(10, 10) == (pytest.approx(0.025 ** (1 / 10)), 1.0)
    low, high = interval_of_share(50, 100)
    assert (low, high) == pytest.approx((0.3983, 0.6017), abs=1e-4)


def test_a_straight_line_through_a_power_is_exact():
    m = np.arange(1, 9)[:, None]
    values = [EstimatedSpectrum(n, 1, m, 3 * (m[:, 0] / n**0.8) ** 1.5) for n in (64, 256)]
    b, e = fit_line(values, 0.8)
    assert b.estimate == pytest.approx(1.5, abs=1e-9)
    assert e.estimate == pytest.approx(0.8, abs=1e-9)
    assert fit_line(values[:1], 0.8) == (None, None)


def test_straight_lines_hold_an_exact_power_in_95_per_cent():
    """The box process in 1D is one, and 300 runs at 95 %: fewer than 260 have probability 5e-9."""
    found = straight_lines(TRUE["box process 1D"], LADDER[4], 1, 300)
    assert found["degree"].held >= 260
    assert straight_lines(TRUE["random 1D"], LADDER[0], 1, 2) == {}
    assert straight_lines(TRUE["jitter 1D"], MEASURED[0], 1, 2) == {}
