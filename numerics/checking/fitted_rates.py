"""Rates that fitted profiles predict: b and e with their intervals, taken through Eq. 17's orders.

On a region with N·P_S = γ min(1, (ρ/(α N^e))^b) and shell energies ρ^-q of the integrand the
variance falls as N^-r, r = 1 + e min(b, q), which `theory.profiles` says. It rises with b and e:
the ends of their intervals give those of r. Where b = 0 is not excluded, e is anything in (0, 1]:
e cannot exceed 1, since by Fejér's kernel Σ_(0<|m|<=K) P_S(m) >= (K + 1)/N − 1 on every axis. Of
several regions the slowest decides.

Such a prediction rests on a fit and on no claim; it is an estimate, and contradicts nothing.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from ...theory.decays import Decay, parse_decay, shell_exponent
from ...theory.errors import InputError
from ...theory.profiles import SaturatingMonomial
from ...theory.regions import region_of_support
from ...theory.samplers import parse_sampler
from ...theory.symbolic import Expr, sympy
from ..measuring.moments import Interval
from ..measuring.probes import Support
from .fitted_profiles import FittedRegion, fitted_supports

CLASSES = ("worst", "best")
"""Classes of integrands of which the rate is predicted on every fitted region."""


@dataclass(frozen=True)
class FittedRate:
    """An exponent r of N^-r, and what it rests on.

    Parameters
    ----------
    exponent : Interval or None
    rests_on : str
        The fits, or why there is no prediction.
    """

    exponent: Interval | None
    rests_on: str


def fitted_rate(
    fitted: Sequence[FittedRegion], dim: int, name: str, support: Support | None = None
) -> FittedRate:
    """The exponent that fitted profiles give a class or an integrand.

    Parameters
    ----------
    fitted : sequence of FittedRegion
    name : str
        In the grammar of classes.
    support : tuple of int, optional
        The one region that counts; else all that a check fits, of which none may be missing.
    """
    known = {f.support: f for f in fitted}
    try:
        decay = parse_decay(name)
        powers = _powers(fitted_supports(dim) if support is None else [support], dim, decay)
    except InputError:
        return FittedRate(None, "the integrand is of no class of the theory")
    if not powers:
        return FittedRate(None, "no region that is fitted has power of the integrand")
    found: list[Interval] = []
    for where, q in powers:
        if where not in known:
            return FittedRate(None, f"no profile is fitted on the region {_named(where)}")
        fit, exponent = known[where].fit, region_exponent(known[where], q, decay.is_product)
        if exponent is None:
            why = fit.outside_model or fit.reason or "it is not determined"
            return FittedRate(None, f"no profile on the region {_named(where)}: {why}")
        found.append(exponent)
    slowest = Interval(*(min(ends) for ends in zip(*found, strict=True)))
    return FittedRate(slowest, _basis([known[where] for where, _ in powers], dim, support))


def _powers(supports: Iterable[Support], dim: int, decay: Decay) -> list[tuple[Support, Expr]]:
    """The regions in which the class has power, with its shell exponents q."""
    layout = parse_sampler("random", dim).layout
    pairs = ((s, shell_exponent(decay, layout, region_of_support(layout, s))) for s in supports)
    return [(s, q) for s, q in pairs if q is not None]


def region_exponent(region: FittedRegion, q: Expr, product: bool = False) -> Interval | None:
    """r = 1 + e min(b, q) on one region; None where b or e is not determined."""
    b, e = region.fit.degree, region.fit.effective
    if b is None or (e is None and b.low > 0):
        return None
    if e is None:
        e = Interval(1 / len(region.support), 0.0, 1.0)
        b = Interval(b.estimate, 0.0, b.high)
    ends = (_exponent(*pair, q, product) for pair in zip(b, e, strict=True))
    return Interval(*ends)


def _exponent(b: float, e: float, q: Expr, product: bool) -> float:
    exact = SaturatingMonomial(sympy.Rational(max(b, 0.0)), sympy.Rational(max(e, 0.0)))
    return float(exact.order_at(q, (), product).exponent)


def _basis(regions: Sequence[FittedRegion], dim: int, support: Support | None) -> str:
    names = "; ".join(_named(r.support) for r in regions)
    counts = sorted({s.n for r in regions for s in r.spectra})
    text = f"profiles fitted on {names} at N = {', '.join(map(str, counts))}"
    if support is None and dim > 3:
        text += f", of {2**dim - 1} regions; what the others have is not looked at"
    return text


def _named(support: Support) -> str:
    return ",".join(map(str, support))
