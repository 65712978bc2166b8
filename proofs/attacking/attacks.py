"""Attacks on the ledger: every proved bound tried at random points, ``python -m`` this module.

    python -m specrate.proofs.attacking.attacks [--points 10000] [--steps 300] [--seconds 120]
                                                [--jobs 2] [--output FILE] [--only NAME]
                                                [--table docs/attacks.md]

A bound is a theorem of the ledger, or a step of a proof that says an inequality, a limit or an
order. Rounds of points are appended to the file as they end, and what the file holds is not run
again: an interrupt loses nothing. A round has its own seed, and a bound gets no more rounds when
it has its points or has taken its seconds.
"""

import argparse
import hashlib
import json
import sys
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from functools import cache
from pathlib import Path
from time import perf_counter
from typing import Any

from ...numerics.interruptible_pools import results
from .. import ledger
from ..trusted.claims import ASYMPTOTIC, Claim
from .mutations import steps_of
from .trials import trials

ROUND = 500
"""Points of a round."""

_SIGNS = {"<=": "≤", "<": "<", "->": "→", "Theta": "Θ", "=": "="}

_PAGE = """# Attacks on the ledger

Every bound that the ledger proves, evaluated in mpmath at random points at which its hypotheses
hold, without any of the kernel; written by `python -m specrate.proofs.attacking.attacks --table`. A
point refutes a claim if one side has no value there or the relation fails; a point that does not
tell is undecided, and counts for nothing.

Symbols are hundredths or whole numbers, mostly between 1/8 and 6, now and then from 0.01 to 64 or
within 0.01 of another symbol. Numbers are compared with 30 digits, with 100 where 30 do not tell or
say that the claim is false, and with 300 before it is said to fail; integrals by quadrature have
settled to 10^-20 (an estimate), and tell a relative difference of 10^-8. Limits and orders are read
off the first monomial c N^p (log N)^j of both sides, so that no N is too small for them.

| kind | claims | points that hold | undecided | refuted | never decided |
|---|---|---|---|---|---|
{totals}

A bound is a theorem of the ledger that says an inequality, a limit or an order; an equation is a
theorem that says one; a step is an inequality, a limit or an order in a proof. Undecided, by why:

| why | points |
|---|---|
{reasons}

An entry that says what one before it says has no row. A theorem is asked for 10 000 points, and has
fewer where its points are slow. Slack is (right − left) over the larger of their sizes, at the
point where it was least; 0 where the bound is attained. The last columns are about the steps of the
entry's proofs that no entry before it has.

| entry | claim | holds | undecided | refuted | least slack | ms a point | steps | hold | refuted |
|---|---|---|---|---|---|---|---|---|---|
{rows}
"""

_LONGEST_ROUND = 15.0
"""Seconds after which a round ends early."""


@dataclass(frozen=True)
class Bound:
    """What is attacked.

    Parameters
    ----------
    name : str
        The number of the entry.
    key : str
        What tells the claim from all others.
    claim : Claim
    is_theorem : bool
        Whether the ledger states it, and no step of a proof alone.
    """

    name: str
    key: str
    claim: Claim
    is_theorem: bool

    @property
    def kind(self) -> str:
        """A theorem that bounds, one that is an equation, or a step of a proof."""
        if not self.is_theorem:
            return "step"
        return "equation" if self.claim.relation == "=" else "bound"


@dataclass(frozen=True)
class Round:
    """What came of one round.

    Parameters
    ----------
    key : str
    round : int
        Its number, which is its seed.
    held, failed : int
        Decided points.
    undecided : dict
        How many points were not decided, by why.
    failures : tuple of str
        What was seen where the bound fails.
    slack : float, optional
        The least (right − left) over the larger of their sizes.
    seconds : float
    """

    key: str
    round: int
    held: int
    failed: int
    undecided: dict[str, int]
    failures: tuple[str, ...]
    slack: float | None
    seconds: float


@dataclass
class Tally:
    """All rounds of one bound together."""

    held: int = 0
    failed: int = 0
    undecided: Counter[str] = field(default_factory=Counter[str])
    slack: float | None = None
    seconds: float = 0.0

    @property
    def points(self) -> int:
        """Points that were drawn."""
        return self.held + self.failed + self.undecided.total()

    def add(self, r: Round) -> None:
        """Count one more round."""
        self.held += r.held
        self.failed += r.failed
        self.undecided.update(r.undecided)
        self.seconds += r.seconds
        if r.slack is not None:
            self.slack = r.slack if self.slack is None else min(self.slack, r.slack)


@cache
def bounds() -> tuple[Bound, ...]:
    """All bounds: theorems of the ledger in its order, and then steps, each claim once."""
    found: dict[Claim, Bound] = {}
    for entry in ledger.ENTRIES:
        if entry.holds is not None and entry.holds not in found:
            found[entry.holds] = Bound(entry.number, _key(entry.holds), entry.holds, True)
    for entry in ledger.ENTRIES:
        for build in (entry.proof, entry.refutation):
            for step in steps_of(build()) if build else ():
                c = step.claim
                is_bound = c.relation in ("<", "<=", "!=", *ASYMPTOTIC) and not c.false
                if is_bound and c not in found:
                    found[c] = Bound(entry.number, _key(c), c, False)
    return tuple(found.values())


def _key(claim: Claim) -> str:
    return hashlib.sha256(str(claim).encode()).hexdigest()[:16]


def attack(claim: Claim, seed: int, count: int, longest: float = _LONGEST_ROUND) -> Round:
    """Points until there are enough, or the time is over."""
    began, tally, undecided = perf_counter(), Counter[str](), Counter[str]()
    failures: list[str] = []
    slack: float | None = None
    for t in trials(claim, seed, count):
        tally[t.verdict] += 1
        if t.verdict == "undecided":
            undecided[t.why] += 1
        elif t.verdict == "fails":
            failures.append(t.why)
        if t.slack is not None:
            slack = t.slack if slack is None else min(slack, t.slack)
        if perf_counter() - began > longest:
            break
    seconds = round(perf_counter() - began, 3)
    shown = tuple(failures[:5])
    return Round(
        _key(claim), seed, tally["holds"], tally["fails"], dict(undecided), shown, slack, seconds
    )


def _run(task: tuple[int, int, int]) -> Round:
    place, number, count = task
    return attack(bounds()[place].claim, number, count)


def run(
    wanted: Sequence[int], points: int, seconds: float, jobs: int, output: Path
) -> Iterator[tuple[Bound, Round]]:
    """Rounds of the bounds at some places, one of each in turn, as they end.

    Parameters
    ----------
    wanted : sequence of int
        Places in `bounds`.
    points, seconds : int, float
        Of each bound; no more rounds begin when it has either, so that one that was cut short may
        be left with fewer points until the next run.
    jobs : int
        Processes; with one, it is this.
    output : Path
        Read first, and appended to.
    """
    known, last, under_way = tallies(output), last_rounds(output), Counter[str]()

    def missing(key: str) -> int:
        tally = known.setdefault(key, Tally())
        is_over = tally.seconds >= seconds
        return 0 if is_over else max(0, points - tally.points - under_way[key])

    def tasks() -> Iterator[tuple[int, int, int]]:
        while any(missing(bounds()[place].key) for place in wanted):
            for place in wanted:
                key = bounds()[place].key
                if count := min(ROUND, missing(key)):
                    last[key] = last.get(key, -1) + 1
                    under_way[key] += count
                    asked[key, last[key]] = count
                    yield place, last[key], count

    asked: dict[tuple[str, int], int] = {}
    here = ((task, _run(task)) for task in tasks())
    with output.open("a") as file:
        for (place, _, _), found in results(_run, tasks(), jobs) if jobs > 1 else here:
            known[found.key].add(found)
            under_way[found.key] -= asked[found.key, found.round]
            file.write(json.dumps(asdict(found)) + "\n")
            file.flush()
            yield bounds()[place], found


def _read(output: Path) -> Iterator[Round]:
    lines = output.read_text().splitlines() if output.exists() else []
    for line in lines:
        parts: dict[str, Any] = json.loads(line)
        parts["failures"] = tuple(parts["failures"])
        yield Round(**parts)


def tallies(output: Path) -> dict[str, Tally]:
    """What a file holds, by the key of the bound."""
    found: dict[str, Tally] = {}
    for r in _read(output):
        found.setdefault(r.key, Tally()).add(r)
    return found


def last_rounds(output: Path) -> dict[str, int]:
    """The last round that a file holds of each bound."""
    found: dict[str, int] = {}
    for r in _read(output):
        found[r.key] = max(r.round, found.get(r.key, 0))
    return found


def table(known: Mapping[str, Tally]) -> str:
    """The page of what a file holds: a row for each entry, and why points were not decided."""
    theorems = [b for b in bounds() if b.is_theorem and b.key in known]
    rows = "\n".join(_row(b, known) for b in theorems)
    all_ = [(b, known[b.key]) for b in bounds() if b.key in known]
    why = Counter[str]()
    for _, tally in all_:
        why.update(tally.undecided)
    reasons = "\n".join(f"| {text} | {count:,} |" for text, count in why.most_common())
    totals = "\n".join(
        f"| {kind} | {len(found)} | {sum(t.held for t in found):,} "
        f"| {sum(t.undecided.total() for t in found):,} | {sum(t.failed for t in found):,} "
        f"| {sum(t.held + t.failed == 0 for t in found)} |"
        for kind in ("bound", "equation", "step")
        for found in [[t for b, t in all_ if b.kind == kind]]
    )
    return _PAGE.format(totals=totals, reasons=reasons, rows=rows)


def _row(bound: Bound, known: Mapping[str, Tally]) -> str:
    tally = known[bound.key]
    steps = [known[b.key] for b in bounds() if b.name == bound.name and b.key in known]
    steps = [t for t in steps if t is not tally]
    slack = "" if tally.slack is None else f"{tally.slack:.1e}"
    cells = (
        bound.name, _SIGNS.get(bound.claim.relation, bound.claim.relation), f"{tally.held:,}",
        f"{tally.undecided.total():,}", f"{tally.failed:,}", slack,
        f"{1000 * tally.seconds / max(1, tally.points):.1f}", str(len(steps)),
        f"{sum(t.held for t in steps):,}", f"{sum(t.failed for t in steps):,}",
    )  # fmt: skip
    return f"| {' | '.join(cells)} |"


def main(arguments: Sequence[str] | None = None) -> int:
    """Attack, or print what a file holds; 1 if a bound failed anywhere."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--points", type=int, default=10_000, help="of each theorem")
    parser.add_argument("--steps", type=int, default=300, help="points of each step of a proof")
    parser.add_argument("--seconds", type=float, default=120.0, help="that a bound may take")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--output", type=Path, default=Path("scratch/attacks.json"))
    parser.add_argument("--only", help="part of the number of an entry")
    parser.add_argument("--table", type=Path, help="write the table there")
    asked = parser.parse_args(arguments)
    chosen = [k for k, b in enumerate(bounds()) if not asked.only or asked.only in b.name]
    for kind, points in (
        ("bound", asked.points),
        ("equation", asked.points),
        ("step", asked.steps),
    ):
        wanted = [k for k in chosen if bounds()[k].kind == kind] if points else []
        for bound, found in run(wanted, points, asked.seconds, asked.jobs, asked.output):
            if found.failed:
                print(f"{bound.name}: {bound.claim}: {found.failures}", flush=True)
    known = tallies(asked.output)
    if asked.table is not None:
        asked.table.write_text(table(known))
    failed = sum(t.failed > 0 for t in known.values())
    print(f"{len(known)} bounds attacked, {failed} failed somewhere", file=sys.stderr)
    return int(failed > 0)


if __name__ == "__main__":
    raise SystemExit(main())
