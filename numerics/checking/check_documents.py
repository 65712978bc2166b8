"""The document of a check: verdict, evidence and plan, as JSON-able values.

``check`` is the door from Python; the command line renders the same document.
"""

import json
from collections.abc import Callable, Iterator, Sequence
from importlib.metadata import version
from itertools import groupby, repeat
from pathlib import Path
from typing import Any, cast

from ...theory.errors import InputError
from ...theory.samplers import Sampler
from ..measuring.measurements import Measurement
from ..measuring.spectrum_pictures import SpectrumPictures
from ..point_sources.fault_kinds import Fault
from .check_evidence import claim, points, rates, regions
from .check_pictures import pictures_of
from .checks import Execution, Step, run_check
from .designs import checked_claims
from .fit_evidence import with_fitted_rates, with_profiles
from .judgements import Judgement, State, judgements, matching, seconds_needed
from .left_out import left_out
from .structures import Structures, as_rows, structures_in
from .verdicts import EQUIVALENCE_LEVEL, FALSE_ALARM, MARGIN, Outcome, exponent_margin

Document = dict[str, Any]


def check(
    sources: Sequence[str] | str,
    dim: int,
    claims: Sequence[str] = (),
    integrands: Sequence[str] = (),
    counts: Sequence[int] = (),
    budget: float = 10.0,
    seed: int = 0,
    plan: str | Path | None = None,
    progress: Callable[[str], None] = lambda text: None,
) -> Document:
    """Test a sampler design against theory.

    Parameters
    ----------
    sources : str or sequence of str
        ``module:callable``, ``path.py:callable``, a scipy QMC engine, ``cmd:`` and a command, a
        catalogue sampler, or point files. Callables and commands run in processes of their own.
    dim : int
        Dimension of the points.
    claims : sequence of str
        Catalogue samplers, ``REGION/CLASS ~ EXPONENT [log Q]``, or JSON files with a list.
    integrands : sequence of str
        Integrands to measure besides the probes.
    counts : sequence of int
        N to measure at; empty: chosen from the claims and the source.
    budget : float
        Seconds at most.
    seed : int
        Of all random numbers.
    plan : path, optional
        A document of an earlier check (or its plan): what it executed is executed again.
    progress : callable
        Told in a line what is being done.

    Returns
    -------
    dict
        The document; its ``verdict`` is ``consistent``, ``contradicted``, ``inconclusive`` or
        ``invalid``.

    Raises
    ------
    InputError
        If anything asked for is unusable.
    """
    asked = (claims, integrands, counts, budget, seed, plan, progress)
    return document(_state(sources, dim, *asked))


def check_with_pictures(
    sources: Sequence[str] | str,
    dim: int,
    claims: Sequence[str] = (),
    integrands: Sequence[str] = (),
    counts: Sequence[int] = (),
    budget: float = 10.0,
    seed: int = 0,
    plan: str | Path | None = None,
    progress: Callable[[str], None] = lambda text: None,
) -> tuple[Document, SpectrumPictures]:
    """As `check`, with pictures of the spectrum for the page, a second or so beyond the budget."""
    asked = (claims, integrands, counts, budget, seed, plan, progress)
    state = _state(sources, dim, *asked)
    return document(state), pictures_of(state)


def _state(
    sources: Sequence[str] | str,
    dim: int,
    claims: Sequence[str],
    integrands: Sequence[str],
    counts: Sequence[int],
    budget: float,
    seed: int,
    plan: str | Path | None,
    progress: Callable[[str], None],
) -> State:
    """What was asked, measured, or a plan's measurements again."""
    words = [sources] if isinstance(sources, str) else list(sources)
    claims = checked_claims(claims)
    if plan is None:
        return run_check(words, dim, claims, integrands, counts, budget, seed, None, progress)
    old = read_plan(Path(plan))
    asked = (old["claims"], old["integrands"], old.get("asked", ()), budget, old["seed"])
    return run_check(words or old["sources"], old["dim"], *asked, _execution(old))


def read_plan(path: Path) -> Document:
    """The plan in a document or plan file.

    Raises
    ------
    InputError
        If the file holds none, or one of another version.
    """
    rule = "a plan file must hold a check document or its plan"
    try:
        found: Any = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(f"a plan file must be readable: got {error.strerror} for {path}") from None
    except ValueError as error:
        raise InputError(f"{rule}: got {error} in {path}") from None
    plan: Any = found.get("plan", found) if isinstance(found, dict) else None  # pyright: ignore[reportUnknownMemberType, reportUnknownVariableType]
    wanted = {"sources", "dim", "claims", "integrands", "seed", "ladder", "ended", "call_seconds"}
    wanted |= {"fitted"}
    if not isinstance(plan, dict) or not wanted <= set(cast("dict[str, Any]", plan)):
        raise InputError(f"{rule}: got another document in {path}")
    found_plan = cast(Document, plan)
    rows: Any = found_plan["ladder"]
    if not (isinstance(rows, list) and all(_is_step(row) for row in cast("list[Any]", rows))):
        raise InputError(f"{rule}: got steps that lack one of {', '.join(Step._fields)} in {path}")
    if found_plan.get("specrate") != version("specrate"):
        raise InputError(
            f"a plan must come from this version, {version('specrate')}: "
            f"got {found_plan.get('specrate')} in {path}"
        )
    return found_plan


def _is_step(row: Any) -> bool:
    return isinstance(row, dict) and set(Step._fields) <= set(cast(Document, row))


def _execution(plan: Document) -> Execution:
    """What a plan says was executed."""
    steps = tuple(_step_of(row) for row in plan["ladder"])
    told = plan["ended"], plan["call_seconds"], plan.get("unanswered"), plan["fitted"]
    return Execution(steps, *told)


def _step_of(row: Document) -> Step:
    told: Document = {name: row[name] for name in Step._fields}
    told["chunks"] = tuple(_lengths(row["chunks"]))
    return Step(**told)


def _lengths(runs: Sequence[Sequence[int]]) -> Iterator[int]:
    """The lengths of chunks, from pairs of a length and how often it comes in a row."""
    for length, times in runs:
        yield from repeat(length, times)


def document(state: State) -> Document:
    """The JSON document of a check."""
    found, matched = judgements(state), matching(state)
    shown = structures_in(state.scans) if state.scans else None
    needed = seconds_needed(state, found)
    measured = [m.n for m in state.measurements if m.replicates and not m.dropped]
    return {
        "verdict": verdict(state, found, matched),
        "faults": [_fault(f) for f in state.faults],
        "regions": with_profiles(regions(state, found), state.fitted),
        "blocks": _blocks(shown),
        "oblique": [] if shown is None else as_rows(shown),
        "rates": with_fitted_rates(state, rates(state, found)),
        "points": points(state),
        "claims": [claim(j) for j in found],
        "matches": [s.name for s, outcome in matched if outcome == "holds"],
        "left_out": left_out(state, found, shown),
        "n_range": [measured[0], measured[-1]] if measured else None,
        "level": state.level,
        "false_alarm": FALSE_ALARM,
        "margin": MARGIN,
        "equivalence_level": EQUIVALENCE_LEVEL,
        "exponent_margin": exponent_margin(state.design.dim),
        "budget_needed": None if needed is None else {"seconds": needed},
        "interrupted": state.ended == "interrupted",
        "plan": _plan(state),
        "seconds": state.seconds,
    }


def _blocks(shown: Structures | None) -> list[list[int]] | None:
    return None if shown is None or shown.blocks is None else [list(b) for b in shown.blocks]


def _fault(fault: Fault) -> Document:
    return {
        "kind": fault.kind,
        "detail": fault.detail,
        "evidence": fault.evidence,
        "remedy": fault.remedy,
    }


def verdict(
    state: State, found: Sequence[Judgement], matched: Sequence[tuple[Sampler, Outcome]]
) -> str:
    """The verdict: faults void the question; one failed claim contradicts.

    Without claims nothing can be contradicted; it is consistent with what it matches once every
    catalogue sampler is decided.
    """
    if state.faults:
        return "invalid"
    outcomes = [j.outcome for j in found]
    if not state.design.claims:
        return "consistent" if matched and all(o != "open" for _, o in matched) else "inconclusive"
    if "fails" in outcomes:
        return "contradicted"
    enough = any(m.replicates >= 2 for m in state.measurements)
    return "consistent" if enough and all(o == "holds" for o in outcomes) else "inconclusive"


def _step(m: Measurement) -> Document:
    chunks = [[length, len(list(run))] for length, run in groupby(m.chunks)]
    return {
        "n": m.n,
        "replicates": m.replicates,
        "attempted": m.attempted,
        "shifts": m.shifts,
        "chunks": chunks,
        "dropped": m.dropped,
    }


def _plan(state: State) -> Document:
    asked = state.design
    return {
        "sources": list(asked.words),
        "asked": list(state.asked),
        "dim": asked.dim,
        "claims": [c.text for c in asked.claims],
        "integrands": [f.name for f in asked.integrands],
        "seed": asked.seed,
        "ladder": [_step(m) for m in state.measurements],
        "ended": state.ended,
        "fitted": len(state.fitted),
        "call_seconds": state.limits.call,
        "unanswered": state.unanswered,
        "frequencies": {str(m.n): [list(k) for k in m.frequencies] for m in state.measurements},
        "specrate": version("specrate"),
    }
