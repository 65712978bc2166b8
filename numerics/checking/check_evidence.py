"""The evidence of a check as JSON-able rows: spectra, rates, variances, claims and witnesses."""

from collections.abc import Collection, Sequence
from math import inf, isfinite, log
from typing import Any

from ...theory.claims import RateClaim, SamplerClaim
from ...theory.decays import parse_decay
from ...theory.errors import InputError
from ...theory.orders import Order
from ...theory.rates import order_on
from ...theory.samplers import Sampler
from ..exact_variances.variances import ExactVariance
from ..integrands.protocol import Integrand
from ..measuring.measurements import Measurement, scaled
from ..measuring.moments import Interval, bias_interval, spread_interval, variance_interval
from ..measuring.probes import Frequency, Support, probed_supports, support_of_frequency
from ..measuring.slopes import fit_slope
from .judgements import Judgement, State, rate_points
from .verdicts import Comparison, spectrum_predictions

Document = dict[str, Any]

_REPORTED = 0.05
"""Level of the intervals that are only reported; decisions use far smaller ones."""


def interval_row(found: Interval) -> Document | None:
    """The interval as the document has it; None if nothing is known."""
    if not isfinite(found.estimate):
        return None
    high = found.high if isfinite(found.high) else None
    return {"estimate": found.estimate, "low": found.low, "high": high}


def _named(support: Support) -> str:
    return ",".join(str(i) for i in support)


def regions(state: State, found: Sequence[Judgement]) -> list[Document]:
    """N·P_S on each support, with the first claimed sampler's where there is one."""
    if not any(m.frequencies for m in state.measurements):
        return []
    first = next((j for j in found if isinstance(j.claim, SamplerClaim)), None)
    failing = {(c.n, c.at) for c in (first.found if first else ()) if c.outcome == "fails"}
    claimed = state.design.claimed_samplers[0] if first else None
    rows: dict[Support, list[Document]] = {s: [] for s in probed_supports(state.design.dim)}
    for m in state.measurements:
        exact = spectrum_predictions(claimed, m.n, m.frequencies) if claimed else None
        for k in m.frequencies if m.replicates else ():
            row = _spectrum_row(m, k, None if exact is None else exact[k], failing)
            rows[support_of_frequency(k)].append(row)
    return [
        {
            "region": _named(support),
            "profile": [],
            "outside_model": None,
            "reason": None,
            "spectrum": spectrum,
        }
        for support, spectrum in rows.items()
    ]


def _spectrum_row(
    m: Measurement,
    k: Frequency,
    exact: float | None,
    failing: Collection[tuple[int, Frequency | str]],
) -> Document:
    """One frequency at one N; one realisation has one |F_S(k)|², which excludes nothing.

    Of an N that was dropped nothing is compared.
    """
    if m.replicates >= 2 and not m.is_frozen:
        power = variance_interval(m.power[k], _REPORTED)
        agrees = None if exact is None or m.dropped is not None else (m.n, k) not in failing
    else:
        power, agrees = Interval(m.power[k].mse, 0.0, inf), None
    return {
        "n": m.n,
        "frequency": list(k),
        "scaled_power": interval_row(scaled(power, m.n)),
        "predicted": None if exact is None else f"{m.n * exact:.12g}",
        "agrees": agrees,
    }


def rates(state: State, found: Sequence[Judgement]) -> list[Document]:
    """Predicted and fitted exponents of the integrands; agreement is that of finite N."""
    claimed = state.design.claimed_samplers[0] if state.design.claimed_samplers else None
    rows = (_rate(state, f, claimed, found) for f in _integrands(state))
    return [row for row in rows if row is not None]


def points(state: State) -> list[Document]:
    """Measured and exact variances of each integrand at each N."""
    first = next((c.text for c in state.design.claims if isinstance(c, SamplerClaim)), "")
    exact = state.variances.get(first, {})
    return [
        _point(m, f, exact.get(m.n, {}).get(f.name))
        for f in _integrands(state)
        for m in state.measurements
        if m.shifts >= 2
    ]


def _integrands(state: State) -> tuple[Integrand, ...]:
    return state.measurements[0].integrands if state.measurements else ()


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
        "region": _named(integrand.support) if integrand.support else "overall",
        "predicted": {
            "exponent": None if order is None else str(order.exponent),
            "log_power": None if order is None else str(order.log_power),
        },
        "measured": {
            "slope": None if fit is None else interval_row(fit.slope),
            "local_slopes": [] if fit is None else [interval_row(s) for s in fit.local_slopes],
        },
        "agrees": agrees,
    }


def predicted_order(sampler: Sampler, integrand: Integrand) -> Order | None:
    """The order that theory gives an integrand under a catalogue sampler; None if it has none."""
    try:
        decay = parse_decay(integrand.name)
    except InputError:
        return None
    return order_on(sampler, decay, integrand.support or None)


def _point(m: Measurement, integrand: Integrand, exact: ExactVariance | None) -> Document:
    moved, raw = m.shifted[integrand.name], m.raw[integrand.name]
    is_repeated = raw.count >= 2
    return {
        "integrand": integrand.name,
        "n": m.n,
        "replicates": m.shifts,
        "realisations": 1 if m.is_frozen else m.replicates,
        "variance": interval_row(variance_interval(moved, _REPORTED)),
        "raw_variance": interval_row(spread_interval(raw, _REPORTED)) if is_repeated else None,
        "raw_mse": interval_row(variance_interval(raw, _REPORTED)) if is_repeated else None,
        "bias": interval_row(bias_interval(raw)) if is_repeated else None,
        "exact": None if exact is None else f"{float(exact.value):.15g}",
        "exact_error_bound": None if exact is None else _bound(exact),
        "seconds": m.seconds,
    }


def _bound(exact: ExactVariance) -> str:
    """The exact variance's error, and what 15 printed digits round away."""
    return f"{float(exact.error_bound) + 1e-15 * abs(float(exact.value)):.2g}"


def claim(judgement: Judgement) -> Document:
    """Whether a claim holds, and the simplest witness against it."""
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
    gap = c.measured.estimate / c.predicted if c.predicted else inf
    return {
        "what": "N P_S(m)" if spectrum else "variance",
        "region": _named(support_of_frequency(c.at)) if not isinstance(c.at, str) else None,
        "at": list(c.at) if spectrum else c.at,
        "n": c.n,
        "measured": interval_row(scaled(c.measured, factor)),
        "predicted": factor * c.predicted,
        "ratio": gap if isfinite(gap) else None,
        "decades": abs(log(gap)) / log(10) if gap > 0 and isfinite(gap) else None,
    }
