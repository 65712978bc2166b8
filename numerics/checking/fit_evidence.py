"""The evidence of fitted profiles as JSON-able rows: a monomial per region, and predicted rates."""

from collections.abc import Iterator, Sequence
from typing import Any

from ...theory.decays import parse_decay
from ...theory.rates import order_on
from ..integrands.protocol import Integrand
from ..measuring.moments import Interval
from ..measuring.probes import Support
from .check_evidence import interval_row
from .fitted_profiles import FittedRegion
from .fitted_rates import CLASSES, FittedRate, fitted_rate
from .judgements import State

Document = dict[str, Any]


def with_profiles(regions: Sequence[Document], fitted: Sequence[FittedRegion]) -> list[Document]:
    """The regions of a document with the profiles fitted to them; new rows where it has none."""
    fits = {_named(f.support): f for f in fitted}
    rows = [_filled(row, fits.pop(row["region"], None)) for row in regions]
    empty: Document = {"profile": [], "outside_model": None, "reason": None, "spectrum": []}
    return rows + [_filled({"region": name, **empty}, f) for name, f in fits.items()]


def _filled(row: Document, region: FittedRegion | None) -> Document:
    if region is None:
        return row
    fit = region.fit
    return {
        **row,
        "profile": [] if fit.outside_model else [_monomial(region)],
        "outside_model": fit.outside_model,
        "reason": fit.reason if fit.reason != fit.outside_model else None,
    }


def _monomial(region: FittedRegion) -> Document:
    fit = region.fit
    intervals = zip(
        ("degree", "effective", "gamma", "alpha"),
        (fit.degree, fit.effective, fit.gamma, fit.alpha),
        strict=True,
    )
    return {name: None if i is None else interval_row(i) for name, i in intervals}


def with_fitted_rates(state: State, rates: Sequence[Document]) -> list[Document]:
    """The rows of measured rates with what fitted profiles predict, and a row for each class."""
    measured = {f.name: f for f in _integrands(state)}
    rows = [
        {**row, "fitted": _row(_of_integrand(state, measured[row["integrand"]]))} for row in rates
    ]
    return [*rows, *_class_rows(state)]


def _integrands(state: State) -> tuple[Integrand, ...]:
    return state.measurements[0].integrands if state.measurements else ()


def _of_integrand(state: State, integrand: Integrand) -> FittedRate:
    if not state.fitted:
        return FittedRate(None, "no profile is fitted")
    return fitted_rate(state.fitted, state.design.dim, integrand.name, integrand.support)


def _row(rate: FittedRate) -> Document:
    exponent: Interval | None = rate.exponent
    return {
        "exponent": None if exponent is None else interval_row(exponent),
        "rests_on": rate.rests_on,
    }


def _class_rows(state: State) -> Iterator[Document]:
    """Worst and best class on every fitted region and overall; nothing of them is measured."""
    if not state.fitted:
        return
    claimed = state.design.claimed_samplers[0] if state.design.claimed_samplers else None
    for name in CLASSES:
        for support in (*(f.support for f in state.fitted), None):
            order = None if claimed is None else order_on(claimed, parse_decay(name), support)
            yield {
                "integrand": name,
                "region": "overall" if support is None else _named(support),
                "predicted": {
                    "exponent": None if order is None else str(order.exponent),
                    "log_power": None if order is None else str(order.log_power),
                },
                "measured": {"slope": None, "local_slopes": []},
                "fitted": _row(fitted_rate(state.fitted, state.design.dim, name, support)),
                "agrees": None,
            }


def _named(support: Support) -> str:
    return ",".join(map(str, support))
