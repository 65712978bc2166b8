"""Tables of how often fitted intervals hold the truth: ``python -m`` this module.

    python -m specrate.numerics.fitting.coverage_tables RUNS [--output docs/profile-fits.json]

RUNS is the file that `fit_coverage` writes. The runs are counted, straight lines are fitted to the
same spectra, and the counts are written; ``--page docs/profile-fits.md`` puts the tables into the
page, each behind its line ``<!-- title -->``.
"""

import argparse
import json
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, dataclass
from math import nan
from pathlib import Path
from statistics import median

from ..measuring.moments import Interval
from .coverage_truths import TRUTHS, Truth
from .fit_coverage import (
    LADDER,
    MEASURED,
    QUANTITIES,
    Budget,
    Outcome,
    held,
    label,
    rng_of,
    spectra,
)
from .log_log_lines import fit_line


@dataclass(frozen=True)
class Count:
    """Of the runs, how many state an interval, in how many it holds the truth; median width."""

    stated: int
    held: int
    width: float | None


@dataclass(frozen=True)
class Row:
    """One truth at one budget.

    Parameters
    ----------
    intervals : dict
        Counts for degree, effective, gamma and alpha.
    lines : dict
        Counts for degree and effective of straight lines; empty where b = 0.
    outside : int
        Runs that took the spectrum to be outside the model.
    seconds : float
        Median of one fit.
    """

    truth: str
    budget: str
    runs: int
    intervals: dict[str, Count]
    lines: dict[str, Count]
    outside: int
    seconds: float


def rows_of(path: Path, seed: int) -> Iterator[Row]:
    """Rows for all that a file of runs holds."""
    known = held(path, seed)
    for truth in TRUTHS:
        for budget in (*LADDER, *MEASURED):
            chunks = known.get((truth.name, label(budget)))
            if not chunks:
                continue
            outcomes = [o for first in sorted(chunks) for o in chunks[first]]
            counts = {
                name: _count([(o[2 * k], o[2 * k + 1]) for o in outcomes])
                for k, name in enumerate(QUANTITIES)
            }
            seconds = median(o[-1] or nan for o in outcomes)
            outside = sum(int(o[-2] or 0) for o in outcomes)
            lines = straight_lines(truth, budget, seed, len(outcomes))
            yield Row(truth.name, label(budget), len(outcomes), counts, lines, outside, seconds)


def straight_lines(truth: Truth, budget: Budget, seed: int, runs: int) -> dict[str, Count]:
    """Counts of straight lines through the spectra of the runs."""
    if truth.effective is None or budget.measured:
        return {}
    found: list[tuple[Outcome, Outcome]] = []
    for index in range(runs):
        values = spectra(truth, budget, rng_of(truth, budget, seed, index))
        b, e = fit_line(values, truth.effective)
        found.append((_against(b, truth.degree), _against(e, truth.effective)))
    return {
        name: _count([(f[k][0], f[k][1]) for f in found])
        for k, name in enumerate(("degree", "effective"))
    }


def _against(interval: Interval | None, true: float) -> Outcome:
    if interval is None:
        return [None, None]
    return [float(interval.low <= true <= interval.high), interval.high - interval.low]


def _count(outcomes: Sequence[tuple[float | None, float | None]]) -> Count:
    stated = [(h, w) for h, w in outcomes if h is not None and w is not None]
    width = float(f"{median(w for _, w in stated):.3g}") if stated else None
    return Count(len(stated), sum(int(h) for h, _ in stated), width)


def document(rows: Sequence[Row]) -> str:
    """Rows as JSON."""
    lines = ",\n".join("  " + json.dumps(asdict(r), ensure_ascii=False) for r in rows)
    return f'{{"rows": [\n{lines}\n]}}\n'


def read(text: str) -> list[Row]:
    """Rows from JSON."""

    def counts(of: dict[str, dict[str, int]]) -> dict[str, Count]:
        return {name: Count(**c) for name, c in of.items()}

    found = json.loads(text)["rows"]
    return [
        Row(**(r | {"intervals": counts(r["intervals"]), "lines": counts(r["lines"])}))
        for r in found
    ]


def tables(rows: Sequence[Row]) -> dict[str, str]:
    """What the page has behind ``<!-- title -->``, by title: tables, and how many runs."""
    law, points = [label(b) for b in LADDER], [label(b) for b in MEASURED]
    found = {name: _table(rows, law, _interval(name)) for name in QUANTITIES}
    for name in ("degree", "effective"):
        found[f"{name}, straight line"] = _table(rows, law, _line(name))
        found[f"{name}, points"] = _table(rows, points, _interval(name))
    return found | {"runs": _runs(rows)}


def _runs(rows: Sequence[Row]) -> str:
    law = [r for r in rows if r.budget.startswith("law")]
    points = [r.runs for r in rows if not r.budget.startswith("law")]
    low, high = min(r.runs for r in law), max(r.runs for r in law)
    each = f"{low}" if low == high else f"{low} to {high}"
    alarms, total = sum(r.outside for r in rows), sum(r.runs for r in rows)
    return (
        f"Each cell of the exact law has {each} runs, each cell of real points {min(points)}. "
        f"Of all {total} runs, {alarms} were taken to be outside the model."
    )


def filled(page: str, rows: Sequence[Row]) -> str:
    """A page with the tables of the rows, each from its marker to the next empty line."""
    for title, table in tables(rows).items():
        head, marker, rest = page.partition(f"<!-- {title} -->\n")
        if marker:
            kept = rest if rest.startswith("\n") else rest.partition("\n\n")[2]
            kept = kept.lstrip("\n")
            page = f"{head}{marker}{table}\n\n{kept}"
    return page


def _interval(name: str) -> Callable[[Row], str]:
    return lambda row: cell(row.intervals[name], row.runs)


def _line(name: str) -> Callable[[Row], str]:
    return lambda row: cell(row.lines[name], row.runs) if row.lines else ""


def cell(count: Count, runs: int) -> str:
    """Share of stated intervals that hold the truth, their median width, and how many are stated.

    Examples
    --------
    >>> cell(Count(2000, 1966, 0.578), 2000), cell(Count(100, 99, 3.1), 2000)
    ('98.3 % (0.578)', '99.0 % (3.1), in 5 %')
    """
    if not count.stated:
        return "none"
    text = f"{100 * count.held / count.stated:.1f} % ({count.width:g})"
    return text if count.stated == runs else f"{text}, in {100 * count.stated / runs:.3g} %"


def _table(rows: Sequence[Row], budgets: Sequence[str], text: Callable[[Row], str]) -> str:
    by_place = {(r.truth, r.budget): text(r) for r in rows}
    names = list(dict.fromkeys(r.truth for r in rows if by_place[r.truth, r.budget]))
    heads = [b.partition(": ")[2] for b in budgets]
    lines = [f"| truth | {' | '.join(heads)} |", f"| --- {'| --- ' * len(budgets)}|"]
    for name in names:
        cells = [by_place.get((name, b), "") for b in budgets]
        if any(cells):
            lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the tables, and write the counts."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("runs", type=Path, help="file that fit_coverage wrote")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--output", type=Path, help="file for the counts")
    parser.add_argument("--page", type=Path, help="page whose tables are renewed")
    asked = parser.parse_args(arguments)
    rows = list(rows_of(asked.runs, asked.seed))
    if asked.output is not None:
        asked.output.write_text(document(rows), encoding="utf-8")
    if asked.page is not None:
        page = asked.page.read_text(encoding="utf-8")
        asked.page.write_text(filled(page, rows), encoding="utf-8")
    for title, table in tables(rows).items():
        print(f"{title}\n\n{table}\n")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
