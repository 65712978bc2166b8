"""How often the intervals of fitted profiles hold the truth: ``python -m`` this module.

    python -m specrate.numerics.fitting.fit_coverage [--runs 2000] [--output FILE] [--truth NAME]...

Spectra are drawn from the law of averaged periodograms, Y ~ μ Gamma(R)/R, or measured on points,
and fitted; a row of the table says how many of the intervals of one truth and budget hold what is
true. Every chunk of runs is appended to the file as one line of JSON, and what the file already
holds is not run again: an interrupt loses nothing.
"""

import argparse
import json
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import nan
from pathlib import Path
from statistics import median
from time import perf_counter
from zlib import crc32

import numpy as np

from ..integrands.protocol import Floats, Ints
from ..measuring.moments import Interval, interval_of_share
from ..measuring.probes import amplitudes
from ..streams import stream
from .coverage_truths import TRUTHS, Truth, generic
from .estimated_spectra import EstimatedSpectrum
from .profile_fits import ProfileFit, fit_profile

CHUNK = 100
"""Runs in one line of the file."""

QUANTITIES = ("degree", "effective", "gamma", "alpha")

Outcome = list[float | None]
"""Per quantity 1 if its interval holds the truth, 0 if not, None if there is none, and its width;
then 1 if the spectrum was taken to be outside the model, and seconds."""


@dataclass(frozen=True)
class Budget:
    """Realisations R, the sizes N, and frequencies per coordinate."""

    realisations: int
    sizes: tuple[int, ...]
    frequencies: int
    measured: bool = False


LADDER = (
    Budget(4, (16, 64), 6),
    Budget(16, (16, 64, 256), 8),
    Budget(64, (16, 64, 256, 1024), 12),
    Budget(512, (16, 64, 256, 1024, 4096), 16),
    Budget(4096, (16, 64, 256, 1024, 4096, 16384), 24),
)
"""From tiny to large; two coordinates have fewer frequencies on each."""

MEASURED = (Budget(16, (16, 64, 256), 8, True), Budget(256, (16, 64, 144), 10, True))
"""Budgets whose spectra are measured on points."""


def frequencies(truth: Truth, budget: Budget, n: int) -> Ints:
    """The frequencies at N: on two coordinates about half as many on each as on one."""
    several = truth.frequencies is generic
    count = max(4, round(0.45 * budget.frequencies)) if several else budget.frequencies
    return truth.frequencies(n, count)


def spectra(truth: Truth, budget: Budget, rng: np.random.Generator) -> list[EstimatedSpectrum]:
    """Estimated spectra of one run."""
    found: list[EstimatedSpectrum] = []
    for n in budget.sizes:
        m, r = frequencies(truth, budget, n), budget.realisations
        if budget.measured:
            assert truth.points is not None
            found.append(measured(truth.points(n, r, rng), m))
        else:
            power = truth.spectrum(n, m) * rng.gamma(r, 1 / r, len(m))
            found.append(EstimatedSpectrum(n, r, m, power))
    return found


def measured(points: Floats, m: Ints) -> EstimatedSpectrum:
    """Mean and dispersion of N|F_N(m)|² over realisations (R, N, d), at frequencies (k, d)."""
    n = points.shape[1]
    values = n * np.abs(amplitudes(points, [tuple(f) for f in m.tolist()])) ** 2
    power = values.mean(axis=1)
    dispersion = values.var(axis=1, ddof=1) / np.maximum(power, 1e-100) ** 2
    return EstimatedSpectrum(n, len(points), m, power, dispersion)


def outcome(truth: Truth, fitted: ProfileFit, seconds: float) -> Outcome:
    """What one fit says against the truth."""
    found: Outcome = []
    for name in QUANTITIES:
        interval: Interval | None = getattr(fitted, name)
        true: float | None = getattr(truth, name)
        holds = interval is not None and true is not None and interval.low <= true <= interval.high
        found += (
            [None, None]
            if interval is None
            else [float(holds), float(f"{interval.high - interval.low:.4g}")]
        )
    return [*found, float(fitted.outside_model is not None), round(seconds, 4)]


def run(truth: Truth, budget: Budget, seed: int, first: int, count: int) -> list[Outcome]:
    """Outcomes of the runs first, first + 1, ..., each with its own stream."""
    found: list[Outcome] = []
    for index in range(first, first + count):
        values = spectra(truth, budget, rng_of(truth, budget, seed, index))
        began = perf_counter()
        fitted = fit_profile(values)
        found.append(outcome(truth, fitted, perf_counter() - began))
    return found


def rng_of(truth: Truth, budget: Budget, seed: int, index: int) -> np.random.Generator:
    """Random numbers of one run, independent of all others."""
    key = (crc32(truth.name.encode()), budget.realisations, int(budget.measured), index)
    return stream(seed, *key)


def row(truth: str, budget: Budget, outcomes: Sequence[Outcome]) -> str:
    """A row of the table, in Markdown."""
    cells = [truth, label(budget), str(len(outcomes))]
    for place in range(len(QUANTITIES)):
        stated = [(o[2 * place], o[2 * place + 1]) for o in outcomes if o[2 * place] is not None]
        hits = sum(int(h or 0) for h, _ in stated)
        if stated:
            low, high = interval_of_share(hits, len(stated))
            width = median(w if w is not None else nan for _, w in stated)
            cells.append(
                f"{100 * hits / len(stated):.1f} [{100 * low:.1f}, {100 * high:.1f}]"
                f" of {len(stated)}, {width:.3g}"
            )
        else:
            cells.append("none stated")
    cells.append(str(sum(int(o[-2] or 0) for o in outcomes)))
    cells.append(f"{1e3 * median(o[-1] or 0.0 for o in outcomes):.0f}")
    return f"| {' | '.join(cells)} |"


def label(budget: Budget) -> str:
    """A budget in a few words."""
    of = "points" if budget.measured else "law"
    return f"{of}: R = {budget.realisations}, N = {budget.sizes[0]}-{budget.sizes[-1]}"


def held(path: Path | None, seed: int) -> dict[tuple[str, str], dict[int, list[Outcome]]]:
    """What the file holds of a seed: chunks by truth, budget and first run."""
    found: dict[tuple[str, str], dict[int, list[Outcome]]] = {}
    if path is not None and path.exists():
        for line in path.read_text(encoding="utf-8").splitlines():
            chunk = json.loads(line)
            if chunk["seed"] == seed:
                key = (chunk["truth"], chunk["budget"])
                found.setdefault(key, {})[chunk["first"]] = chunk["outcomes"]
    return found


def rows(
    truths: Iterable[Truth], budgets: Sequence[Budget], runs: int, seed: int, path: Path | None
) -> Iterator[tuple[str, Budget, list[Outcome]]]:
    """Outcomes of every truth at every budget, run or read from the file."""
    known = held(path, seed)
    for truth in truths:
        for budget in budgets:
            if budget.measured and truth.points is None:
                continue
            chunks, found = known.get((truth.name, label(budget)), {}), list[Outcome]()
            for first in range(0, runs, CHUNK):
                count = min(CHUNK, runs - first)
                part = chunks.get(first, [])
                if len(part) < count:
                    part = run(truth, budget, seed, first, count)
                    _append(path, truth, budget, seed, first, part)
                found += part[:count]
            yield truth.name, budget, found


def _append(
    path: Path | None, truth: Truth, budget: Budget, seed: int, first: int, part: list[Outcome]
) -> None:
    if path is None:
        return
    line = {"truth": truth.name, "budget": label(budget), "seed": seed, "first": first}
    with path.open("a", encoding="utf-8") as file:
        file.write(json.dumps(line | {"outcomes": part}, ensure_ascii=False) + "\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; 1 if an interval of b or e surely holds the truth in less than 93 %."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--runs", type=int, default=2000, help="fits of each truth and budget")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--output", type=Path, help="file to which runs are appended")
    parser.add_argument("--truth", action="append", help="part of the name of a truth; repeats")
    parser.add_argument("--points", action="store_true", help="measure spectra on points")
    asked = parser.parse_args(arguments)
    truths = [t for t in TRUTHS if not asked.truth or any(w in t.name for w in asked.truth)]
    heads = ("truth", "budget", "runs", *QUANTITIES, "outside", "median ms")
    print("held % [95 %] of stated, median width")
    print(f"| {' | '.join(heads)} |\n|{'---|' * len(heads)}", flush=True)
    budgets, failed = MEASURED if asked.points else LADDER, False
    for name, budget, found in rows(truths, budgets, asked.runs, asked.seed, asked.output):
        print(row(name, budget, found), flush=True)
        print(f"{name}, {label(budget)}: done", file=sys.stderr, flush=True)
        truth = next(t for t in truths if t.name == name)
        failed |= surely_low(found, 0) or surely_low(found, 1, truth.effective is None)
    return int(failed)


def surely_low(
    outcomes: Sequence[Outcome], place: int, absent: bool = False, least: float = 0.93
) -> bool:
    """Whether less than ``least`` of all cases are right, at level 1e-3.

    Right is a stated interval that holds the truth or, where there is no true value, none.
    """
    stated = [int(o[2 * place] or 0) for o in outcomes if o[2 * place] is not None]
    hits, cases = sum(stated), len(stated)
    if absent:
        hits, cases = len(outcomes) - cases, len(outcomes)
    return cases > 0 and interval_of_share(hits, cases, 1e-3)[1] < least


if __name__ == "__main__":
    raise SystemExit(main())
