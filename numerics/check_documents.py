"""The document of a check: verdict, evidence and plan, as JSON-able values.

``check`` is the door from Python; the command line renders the same document.
"""

import json
from collections.abc import Callable, Collection, Sequence
from importlib.metadata import version
from math import isfinite, log
from pathlib import Path
from typing import Any, cast

from ..theory.claims import RateClaim, SamplerClaim
from ..theory.decays import parse_decay, shell_exponent
from ..theory.dominance import slowest
from ..theory.errors import InputError
from ..theory.orders import Order
from ..theory.rates import profile_of
from ..theory.regions import region_of_support, select
from ..theory.samplers import Sampler
from .checks import Judgement, State, judgements, matching, rate_points, run_check, seconds_needed
from .integrands.bernoulli import Bernoulli
from .integrands.protocol import Integrand
from .left_out import left_out
from .measurements import Measurement
from .moments import Interval, bias_interval, spread_interval, variance_interval
from .probes import Frequency, Support, probed_supports, support_of_frequency
from .slopes import fit_slope
from .variances import ExactVariance
from .verdicts import (
    EQUIVALENCE_LEVEL,
    FALSE_ALARM,
    MARGIN,
    Comparison,
    Outcome,
    exponent_margin,
    spectrum_predictions,
)

Document = dict[str, Any]

_REPORTED = 0.05
"""Level of the intervals that are only reported; decisions use far smaller ones."""


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
        ``module:callable``, ``path.py:callable``, a scipy QMC engine, a catalogue sampler, or
        point files.
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
    words = [sources] if isinstance(sources, str) else list(sources)
    if plan is None:
        state = run_check(words, dim, claims, integrands, counts, budget, seed, None, progress)
    else:
        old = read_plan(Path(plan))
        steps = [(s["n"], s["replicates"], s["attempted"]) for s in old["ladder"]]
        words = words or old["sources"]
        asked = old.get("asked", ())
        state = run_check(
            words, old["dim"], old["claims"], old["integrands"], asked, budget, old["seed"], steps
        )
    return document(state)


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
    wanted = {"sources", "dim", "claims", "integrands", "seed", "ladder"}
    if not isinstance(plan, dict) or not wanted <= set(cast("dict[str, Any]", plan)):
        raise InputError(f"{rule}: got another document in {path}")
    found_plan = cast(Document, plan)
    if found_plan.get("specrate") != version("specrate"):
        raise InputError(
            f"a plan must come from this version, {version('specrate')}: "
            f"got {found_plan.get('specrate')} in {path}"
        )
    return found_plan


def document(state: State) -> Document:
    """The JSON document of a check."""
    asked, found, matched = state.design, judgements(state), matching(state)
    measured = [m for m in state.measurements if m.replicates]
    claimed = asked.claimed_samplers[0] if asked.claimed_samplers else None
    first = next((j for j in found if isinstance(j.claim, SamplerClaim)), None)
    failing = {(c.n, c.at) for c in (first.found if first else ()) if c.outcome == "fails"}
    return {
        "verdict": verdict(state, found, matched),
        "faults": [
            {"kind": f.kind, "detail": f.detail, "evidence": f.evidence} for f in state.faults
        ],
        "regions": [_region(s, measured, claimed, failing) for s in _supports(state)],
        "blocks": None,
        "rates": [r for f in _integrands(state) for r in [_rate(state, f, claimed, found)] if r],
        "points": [p for f in _integrands(state) for p in _points(state, f, measured)],
        "claims": [_claim(j) for j in found],
        "matches": [s.name for s, outcome in matched if outcome == "holds"],
        "left_out": left_out(state, found),
        "n_range": [measured[0].n, measured[-1].n] if measured else None,
        "level": state.level,
        "false_alarm": FALSE_ALARM,
        "margin": MARGIN,
        "equivalence_level": EQUIVALENCE_LEVEL,
        "exponent_margin": exponent_margin(asked.dim),
        "budget_needed_seconds": seconds_needed(state, found),
        "interrupted": state.interrupted,
        "plan": _plan(state),
        "seconds": state.seconds,
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


def _plan(state: State) -> Document:
    asked = state.design
    return {
        "sources": list(asked.words),
        "asked": list(state.asked),
        "dim": asked.dim,
        "claims": [c.text for c in asked.claims],
        "integrands": [f.name for f in asked.integrands],
        "seed": asked.seed,
        "ladder": [
            {"n": m.n, "replicates": m.replicates, "attempted": m.attempted}
            for m in state.measurements
        ],
        "frequencies": {str(m.n): [list(k) for k in m.frequencies] for m in state.measurements},
        "specrate": version("specrate"),
    }


def _interval(found: Interval) -> Document | None:
    if not isfinite(found.estimate):
        return None
    high = found.high if isfinite(found.high) else None
    return {"estimate": found.estimate, "low": found.low, "high": high}


def _named(support: Support) -> str:
    return ",".join(str(i) for i in support)


def _supports(state: State) -> tuple[Support, ...]:
    measured = any(m.frequencies for m in state.measurements)
    return probed_supports(state.design.dim) if measured else ()


def _integrands(state: State) -> tuple[Integrand, ...]:
    return state.measurements[0].integrands if state.measurements else ()


def _region(
    support: Support,
    measured: Sequence[Measurement],
    claimed: Sampler | None,
    failing: Collection[tuple[int, Frequency | str]],
) -> Document:
    """N·P_S on one support, with the claimed sampler's where there is one."""
    rows: list[Document] = []
    for m in measured:
        wanted = [k for k in m.frequencies if support_of_frequency(k) == support]
        exact = spectrum_predictions(claimed, m.n, wanted) if claimed and wanted else None
        for k in wanted if m.replicates >= 2 else []:
            measured_power = variance_interval(m.power[k], _REPORTED)
            scaled = Interval(*(m.n * v for v in measured_power))
            predicted = None if exact is None else m.n * exact[k]
            rows.append(
                {
                    "n": m.n,
                    "frequency": list(k),
                    "scaled_power": _interval(scaled),
                    "predicted": None if predicted is None else f"{predicted:.12g}",
                    "agrees": None if predicted is None else (m.n, k) not in failing,
                }
            )
    return {"region": _named(support), "profile": [], "outside_model": None, "spectrum": rows}


def _rate(
    state: State, integrand: Integrand, claimed: Sampler | None, found: Sequence[Judgement]
) -> Document | None:
    """Predicted and fitted exponent of one integrand; agreement is that of finite N."""
    order = predicted_order(claimed, integrand) if claimed else None
    points = rate_points(state, (integrand,), _REPORTED)
    if not points:
        return None
    log_power = order.log_power if order is not None and order.log_power.is_Integer else 0
    fit = fit_slope(points, int(log_power), _REPORTED) if len(points) >= 2 else None
    outcomes = [c.outcome for j in found for c in j.found if c.at == integrand.name]
    agrees = (
        False if "fails" in outcomes else True if outcomes and set(outcomes) == {"holds"} else None
    )
    return {
        "integrand": integrand.name,
        "region": _named(integrand.axes) if isinstance(integrand, Bernoulli) else "overall",
        "predicted": {
            "exponent": None if order is None else str(order.exponent),
            "log_power": None if order is None else str(order.log_power),
        },
        "measured": {
            "slope": None if fit is None else _interval(fit.slope),
            "local_slopes": [] if fit is None else [_interval(s) for s in fit.local_slopes],
        },
        "agrees": agrees,
    }


def predicted_order(sampler: Sampler, integrand: Integrand) -> Order:
    """The order that theory gives an integrand under a catalogue sampler."""
    decay, layout = parse_decay(integrand.name), sampler.layout
    if isinstance(integrand, Bernoulli):
        supports = [region_of_support(layout, integrand.axes)]
    else:
        supports = list(select(layout, "overall"))
    orders: list[Order] = []
    for region in supports:
        q = shell_exponent(decay, layout, region)
        if q is not None:
            orders += [m.order_at(q, (), decay.is_product) for m in profile_of(sampler, region)]
    return slowest(orders)


def _points(state: State, integrand: Integrand, measured: Sequence[Measurement]) -> list[Document]:
    first = next((c.text for c in state.design.claims if isinstance(c, SamplerClaim)), "")
    exact = {n: v.get(integrand.name) for n, v in state.variances.get(first, {}).items()}
    found: list[Document] = []
    for m in measured:
        if m.replicates < 2:
            continue
        moved, raw = m.shifted[integrand.name], m.raw[integrand.name]
        told = exact.get(m.n)
        found.append(
            {
                "integrand": integrand.name,
                "n": m.n,
                "replicates": m.replicates,
                "variance": _interval(variance_interval(moved, _REPORTED)),
                "raw_variance": _interval(spread_interval(raw, _REPORTED)),
                "raw_mse": _interval(variance_interval(raw, _REPORTED)),
                "bias": _interval(bias_interval(raw)),
                "exact": None if told is None else f"{float(told.value):.15g}",
                "exact_error_bound": None if told is None else _bound(told),
                "seconds": m.seconds,
            }
        )
    return found


def _bound(exact: ExactVariance) -> str:
    """The exact variance's error, and what 15 printed digits round away."""
    return f"{float(exact.error_bound) + 1e-15 * abs(float(exact.value)):.2g}"


def _claim(judgement: Judgement) -> Document:
    holds = {"fails": False, "holds": True, "open": None}[judgement.outcome]
    found: Document = {"claim": judgement.claim.text, "holds": holds, "witness": None}
    if isinstance(judgement.claim, RateClaim):
        drift = judgement.drift
        found["exponents"] = None if drift is None else [drift.low, drift.high]
        if holds is False and drift is not None:
            found["witness"] = {
                "what": "exponent",
                "chi2": drift.chi2,
                "threshold": drift.threshold,
                "exponents": [drift.low, drift.high],
            }
        return found
    failing = [c for c in judgement.found if c.outcome == "fails"]
    if failing:
        found["witness"] = _witness(min(failing, key=_simplicity))
        found["failing"] = {"tests": len(failing), "of": len(judgement.found)}
    return found


def _simplicity(c: Comparison) -> tuple[int, int, int, int]:
    """Spectra before variances, small supports, low frequencies, small N first."""
    if isinstance(c.at, str):
        return (1, 0, 0, c.n)
    return (0, len(support_of_frequency(c.at)), sum(abs(k) for k in c.at), c.n)


def _witness(c: Comparison) -> Document:
    spectrum = not isinstance(c.at, str)
    factor = c.n if spectrum else 1
    gap = c.measured.estimate / c.predicted if c.predicted else float("inf")
    return {
        "what": "N P_S(m)" if spectrum else "variance",
        "region": _named(support_of_frequency(c.at)) if not isinstance(c.at, str) else None,
        "at": list(c.at) if spectrum else c.at,
        "n": c.n,
        "measured": _interval(Interval(*(factor * v for v in c.measured))),
        "predicted": factor * c.predicted,
        "ratio": gap if isfinite(gap) else None,
        "decades": abs(log(gap)) / log(10) if gap > 0 and isfinite(gap) else None,
    }
