"""The variances in the document of a check, curve by curve, with their slopes."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from ..numerics.checking.designs import rate_probes
from ..numerics.integrands.grammar import parse_integrand
from ..theory.claims import RateClaim, parse_claim

Document = dict[str, Any]

ROUNDING = 1e-26
"""Variances below this are rounding errors of zero and are not drawn."""


@dataclass(frozen=True)
class Curve:
    """The variance of one integrand at every N.

    Parameters
    ----------
    integrand, region : str
    points : tuple of dict
        Of the document, by increasing N.
    slope : dict or None
        Interval of the measured slope.
    exponent, log_power : str or None
        Of the variance ~ N^-exponent (log N)^log_power that is claimed, if one is.
    """

    integrand: str
    region: str
    points: tuple[Document, ...]
    slope: Document | None
    exponent: str | None
    log_power: str | None

    @property
    def drawn(self) -> tuple[Document, ...]:
        """The points that are more than rounding errors."""
        return tuple(p for p in self.points if p["variance"]["estimate"] > ROUNDING)


def curves_of(document: Document) -> tuple[Curve, ...]:
    """The measured variances of a document, integrand by integrand."""
    rates = {r["integrand"]: r for r in document["rates"]}
    claimed = dict(_claimed_rates(document))
    dim, found = document["plan"]["dim"], dict[str, list[Document]]()
    for p in document["points"]:
        if p["variance"] is not None:
            found.setdefault(p["integrand"], []).append(p)
    curves: list[Curve] = []
    for name, points in found.items():
        rate = rates.get(name)
        region = rate["region"] if rate else _region(name, dim)
        predicted = rate["predicted"] if rate else {"exponent": None, "log_power": None}
        orders = (predicted["exponent"], predicted["log_power"])
        slope = rate["measured"]["slope"] if rate else None
        order = orders if orders[0] is not None else claimed.get(name, orders)
        curves.append(Curve(name, region, tuple(points), slope, *order))
    return tuple(curves)


def _region(integrand: str, dim: int) -> str:
    support = parse_integrand(integrand, dim).support
    return ",".join(map(str, support)) if support else "overall"


def _claimed_rates(document: Document) -> Iterator[tuple[str, tuple[str, str]]]:
    """Integrands that probe a claimed exponent, and that exponent."""
    dim = document["plan"]["dim"]
    for found in document["claims"]:
        if "~" not in found["claim"]:
            continue
        claim = parse_claim(found["claim"], dim)
        if isinstance(claim, RateClaim):
            for integrand in rate_probes(claim, dim):
                yield integrand.name, (str(claim.exponent), str(claim.log_power))


def by_region(curves: Sequence[Curve], most: int) -> list[tuple[str, list[Curve]]]:
    """Curves with something to draw, region by region, at most so many together."""
    groups: dict[str, list[Curve]] = {}
    for curve in curves:
        if curve.drawn:
            groups.setdefault(curve.region, []).append(curve)
    return [
        (region, group[i : i + most])
        for region, group in groups.items()
        for i in range(0, len(group), most)
    ]
