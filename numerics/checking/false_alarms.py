"""How often `check` contradicts correct designs, and wrong ones: ``python -m`` this module.

    python -m specrate.numerics.checking.false_alarms [--seeds 100] [--budget 2] [--jobs 2]

A correct design must never be contradicted: with at most 1e-5 a check, one contradiction in all
of these runs is of chance 1e-5 times their number. The wrong designs show that this is not bought
with silence.
"""

import argparse
import os
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from functools import partial
from statistics import median

import numpy as np
from numpy.typing import NDArray

from .check_documents import check

VERDICTS = ("contradicted", "consistent", "inconclusive", "invalid")


@dataclass(frozen=True)
class Case:
    """A design, what is claimed of it, and whether the claim is true."""

    source: str
    dim: int
    claim: str
    is_true: bool = True


def half_jitter(n: int, dim: int, rng: np.random.Generator) -> NDArray[np.float64]:
    """Jitter whose last coordinate forgets to be stratified."""
    side = round(n ** (1 / dim))
    if side**dim != n:
        raise ValueError(f"n must be a power of {dim}: got {n}")
    points = (np.indices((side,) * dim).reshape(dim, -1).T + rng.random((n, dim))) / side
    points[:, -1] = rng.random(n)
    return points


HALF_JITTER = "specrate.numerics.checking.false_alarms:half_jitter"
LATIN_HYPERCUBE = "scipy.stats.qmc:LatinHypercube"

CASES = (
    Case("random", 2, "random"),
    Case("jitter", 2, "jitter"),
    Case("jitter:2x8", 2, "jitter:2x8"),
    Case("latin-hypercube", 2, "latin-hypercube"),
    Case(LATIN_HYPERCUBE, 2, "latin-hypercube"),
    Case("multi-jitter", 2, "multi-jitter"),
    Case("correlated-multi-jitter", 2, "correlated-multi-jitter"),
    Case("uncorrelated-jitter:1+2", 3, "uncorrelated-jitter:1+2"),
    Case("multi-jitter", 2, "overall/disk ~ 3/2"),
    Case("n-rooks", 2, "overall/anisotropic-gaussian:sigma=(1/10,2/5) ~ 1"),
    Case("random", 2, "overall/disk:radius=0.02 ~ 1"),
    Case("jitter", 2, "overall/gaussian:sigma=0.03 ~ 2"),
    Case(HALF_JITTER, 2, "jitter", False),
    Case("random", 2, "latin-hypercube", False),
    Case("latin-hypercube", 2, "multi-jitter", False),
    Case("multi-jitter", 2, "correlated-multi-jitter", False),
    Case("random", 2, "overall/disk ~ 3/2", False),
    Case("jitter", 2, "axis/best ~ 3", False),
)


@dataclass(frozen=True)
class Row:
    """The verdicts on one case over all seeds, and the median time of a check."""

    case: Case
    verdicts: Counter[str]
    seconds: float


def verdict_on(case: Case, budget: float, seed: int) -> tuple[str, float]:
    """Verdict of one check, and its seconds."""
    found = check(case.source, case.dim, claims=[case.claim], budget=budget, seed=seed)
    return found["verdict"], found["seconds"]


def rows(cases: Sequence[Case], seeds: int, budget: float, jobs: int) -> Iterator[Row]:
    """The cases in turn, each over the seeds 0, 1, ..."""
    with ProcessPoolExecutor(jobs) as pool:
        for case in cases:
            found = list(pool.map(partial(verdict_on, case, budget), range(seeds)))
            yield Row(case, Counter(v for v, _ in found), median(s for _, s in found))


def line(row: Row) -> str:
    """A row of the table, in Markdown."""
    case, counts = row.case, (str(row.verdicts[v]) for v in VERDICTS)
    source = case.source.rpartition(":")[2] if "." in case.source else case.source
    cells = (
        f"{source}, {case.dim}D",
        case.claim,
        "true" if case.is_true else "wrong",
        str(row.verdicts.total()),
        *counts,
        f"{row.seconds:.2f}",
    )
    return f"| {' | '.join(cells)} |"


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; 1 if a true claim was contradicted or a wrong one found consistent."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=100, help="checks of each case")
    parser.add_argument("--budget", type=float, default=2.0, help="seconds of each check")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes")
    asked = parser.parse_args(arguments)
    heads = ("design", "claim", "is", "seeds", *VERDICTS, "median s")
    print(f"| {' | '.join(heads)} |\n|{'---|' * len(heads)}", flush=True)
    failed = False
    for done, row in enumerate(rows(CASES, asked.seeds, asked.budget, asked.jobs), 1):
        print(line(row), flush=True)
        print(f"{done} of {len(CASES)} cases", file=sys.stderr, flush=True)
        failed |= row.verdicts["contradicted" if row.case.is_true else "consistent"] > 0
    return int(failed)


if __name__ == "__main__":
    raise SystemExit(main())
