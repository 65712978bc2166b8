"""How often `check` is wrong on designs of known truth: ``python -m`` this module.

    python -m specrate.numerics.checking.validation [--seeds 200] [--defect-seeds 20] [--budget 2]
                                                    [--jobs 2] [--output FILE.jsonl] [--only NAME]

First every design once, at the default budget of a check; then over many seeds at a smaller one,
those whose claims hold over more than the others. A check contradicts true claims with a
probability of 1e-5 at most, so that among thousands of checks none should. Every check is appended
to the file as it ends, and what the file holds of the same code is not run again: an interrupt
loses nothing.
"""

import argparse
import hashlib
import json
import os
import sys
import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from statistics import median
from time import monotonic

from ..interruptible_pools import results
from ..measuring.moments import interval_of_share
from .check_documents import check
from .known_truths import TRUTHS, KnownTruth, is_wrong, reasons_of

DEFAULT_BUDGET = 10.0
"""Seconds that a check has unless told."""

VERDICTS = ("consistent", "inconclusive", "contradicted", "invalid")


@dataclass(frozen=True)
class Task:
    """One check: a design, in the words of `title`, the budget and the seed."""

    design: str
    budget: float
    seed: int


@dataclass(frozen=True)
class Ended:
    """What came of one check."""

    verdict: str
    reasons: tuple[str, ...]
    seconds: float

    def is_wrong_on(self, truth: KnownTruth) -> bool:
        """Whether it is against the truth."""
        return is_wrong(truth, self.verdict, frozenset(self.reasons))


Results = dict[Task, Ended]


def title(truth: KnownTruth) -> str:
    """A design and its claims: no two have the same."""
    return f"{truth.name}, {truth.dim}D, claimed {'; '.join(truth.claims)}"


def run(task: Task) -> Ended:
    """Run one check."""
    truth = next(t for t in TRUTHS if title(t) == task.design)
    with tempfile.TemporaryDirectory() as folder:
        words = truth.words(Path(folder), task.seed)
        found = check(
            words, truth.dim, truth.claims, (), truth.counts, budget=task.budget, seed=task.seed
        )
    return Ended(found["verdict"], tuple(sorted(reasons_of(found))), round(found["seconds"], 3))


@cache
def code_digest() -> str:
    """Digest of the sources that a check rests on: results of other code do not count."""
    root = Path(__file__).parents[2]
    digest = hashlib.sha256()
    for room in ("theory", "numerics"):
        for path in sorted((root / room).rglob("*.py")):
            digest.update(str(path.relative_to(root)).encode() + b"\0" + path.read_bytes() + b"\0")
    return digest.hexdigest()[:16]


def held(path: Path | None) -> Results:
    """What the file holds of this code; a last line that an interrupt cut short is no result."""
    found: Results = {}
    if path is None or not path.exists():
        return found
    for line in path.read_text(encoding="utf-8").splitlines():
        try:
            row = json.loads(line)
        except ValueError:
            continue
        if row["code"] == code_digest():
            ended = Ended(row["verdict"], tuple(row["reasons"]), row["seconds"])
            found[Task(row["design"], row["budget"], row["seed"])] = ended
    return found


def append(path: Path | None, task: Task, ended: Ended) -> None:
    """Append one result, on a line of its own even after a line that was cut short."""
    if path is None:
        return
    row = {**asdict(task), **asdict(ended), "code": code_digest()}
    with path.open("ab+") as file:
        if file.tell():
            file.seek(-1, os.SEEK_END)
            if file.read(1) != b"\n":
                file.write(b"\n")
        file.write((json.dumps(row, ensure_ascii=False) + "\n").encode())


def table(truths: Sequence[KnownTruth], found: Results, budget: float) -> Iterator[str]:
    """Lines of a Markdown table: a row for each design, then all that hold and all that do not."""
    shares = ("right, % [95 %]", "wrong, % [95 %]")
    heads = ("design", "claimed", "truth", "checks", *VERDICTS, *shares, "median s")
    yield f"| {' | '.join(heads)} |"
    yield f"|{'---|' * len(heads)}"
    by_design: dict[str, list[Ended]] = {}
    for task, ended in found.items():
        if task.budget == budget:
            by_design.setdefault(task.design, []).append(ended)
    total: dict[bool, list[tuple[Ended, bool]]] = {True: [], False: []}
    for truth in truths:
        judged = [(e, e.is_wrong_on(truth)) for e in by_design.get(title(truth), [])]
        total[truth.holds] += judged
        known = "holds" if truth.holds else " or ".join(truth.reasons)
        yield _row((f"{truth.name}, {truth.dim}D", "; ".join(truth.claims), known), judged)
    yield _row(("all whose claims hold", "", "holds"), total[True])
    yield _row(("all others", "", "a defect or a false claim"), total[False])


def _row(first: Sequence[str], judged: Sequence[tuple[Ended, bool]]) -> str:
    counts = Counter(e.verdict for e, _ in judged)
    wrong, size = sum(w for _, w in judged), len(judged)
    right = size - wrong - counts["inconclusive"]
    seconds = f"{median(e.seconds for e, _ in judged):.2f}" if size else "-"
    shares = (_share(right, size), _share(wrong, size))
    cells = (*first, str(size), *(str(counts[v]) for v in VERDICTS), *shares, seconds)
    return f"| {' | '.join(cells)} |"


def _share(count: int, size: int) -> str:
    """A percentage with its exact binomial interval."""
    if not size:
        return "-"
    low, high = interval_of_share(count, size)
    return f"{100 * count / size:.3g} [{100 * low:.3g}, {100 * high:.3g}]"


def wrong_ones(truths: Sequence[KnownTruth], found: Mapping[Task, Ended]) -> Iterator[str]:
    """A line for each check whose verdict is against the truth."""
    for truth in truths:
        for task, ended in found.items():
            if task.design == title(truth) and ended.is_wrong_on(truth):
                why = ", ".join(ended.reasons) or "nothing"
                yield (
                    f"wrong: {task.design}, budget {task.budget:g} s, seed {task.seed}: "
                    f"{ended.verdict} for {why}"
                )


def missed_ones(truths: Sequence[KnownTruth], found: Mapping[Task, Ended]) -> Iterator[str]:
    """A line for each defect or false claim that the default budget has left open."""
    for truth in (t for t in truths if not t.holds):
        ended = found.get(Task(title(truth), DEFAULT_BUDGET, 0))
        if ended is not None and ended.verdict == "inconclusive":
            yield f"missed: {title(truth)}, budget {DEFAULT_BUDGET:g} s"


def tasks_of(
    truths: Sequence[KnownTruth], budget: float, seeds: int, defect_seeds: int
) -> list[Task]:
    """Every design once at the default budget, then the seeds in turn at the smaller one."""
    found = [Task(title(t), DEFAULT_BUDGET, 0) for t in truths]
    for seed in range(max(seeds, defect_seeds)):
        wanted = (t for t in truths if seed < (seeds if t.holds else defect_seeds))
        found += [Task(title(t), budget, seed) for t in wanted]
    return list(dict.fromkeys(found))


def main(arguments: Sequence[str] | None = None) -> int:
    """Print both tables; 1 if a verdict is wrong, or a defect not found at the default budget."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--seeds", type=int, default=200, help="of each design whose claims hold")
    parser.add_argument("--defect-seeds", type=int, default=20, help="of each other design")
    parser.add_argument("--budget", type=float, default=2.0, help="seconds of each, part two")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="processes")
    parser.add_argument("--output", type=Path, help="file to which results are appended")
    parser.add_argument("--only", action="append", help="part of a design and its claims; repeats")
    asked = parser.parse_args(arguments)
    truths = [t for t in TRUTHS if not asked.only or any(w in title(t) for w in asked.only)]
    tasks = tasks_of(truths, asked.budget, asked.seeds, asked.defect_seeds)
    known = held(asked.output)
    found = {task: known[task] for task in tasks if task in known}
    is_whole = _run_all([t for t in tasks if t not in found], found, asked.output, asked.jobs)
    for budget in dict.fromkeys(t.budget for t in tasks):
        print(f"\nBudget {budget:g} s, code {code_digest()}\n")
        print("\n".join(table(truths, found, budget)), flush=True)
    told = [*wrong_ones(truths, found), *missed_ones(truths, found)]
    print("\n".join(["", *(told or [f"no verdict is wrong{'' if is_whole else ' so far'}"])]))
    return int(bool(told)) if is_whole else 130


def _run_all(tasks: Sequence[Task], found: Results, path: Path | None, jobs: int) -> bool:
    """Run and record the tasks; False if interrupted."""
    began = monotonic()
    try:
        for done, (task, ended) in enumerate(results(run, tasks, jobs), 1):
            append(path, task, ended)
            found[task] = ended
            left = (monotonic() - began) / done * (len(tasks) - done)
            text = f"{done} of {len(tasks)}, {left / 60:.0f} min left: {task.design}"
            print(f"{text}, {task.budget:g} s, seed {task.seed}: {ended.verdict}, "
                  f"{ended.seconds:.2f} s", file=sys.stderr, flush=True)  # fmt: skip
    except KeyboardInterrupt:
        print("interrupted; the same command continues", file=sys.stderr)
        return False
    return True


if __name__ == "__main__":
    raise SystemExit(main())
