"""Stiff cases of exact variances: widths 1e8 : 1, disks of radius 1e-9 or at the edge, d = 1000."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction

from ...theory.samplers import Sampler, parse_sampler
from ..balls import Ball, flint
from ..equation17.radial_estimates import Estimate
from ..exact_variances.crossovers import region_constants
from ..exact_variances.variances import exact_variance
from ..integrands.ball import Ball as BallIntegrand
from ..integrands.chord import Chord
from ..integrands.grammar import parse_integrand
from ..integrands.protocol import Integrand, mp
from ..integrands.ridge import Ridge
from . import disk_estimates
from .stress import DIGITS, Family, Method, Outcome, Reference, as_ball, number_text

_WORKED = 30  # digits asked of the methods


@dataclass(frozen=True)
class VarianceProblem:
    """A sampler with the admissible N nearest to n, on an integrand."""

    sampler: Sampler
    counts: Mapping[str, int]
    integrand: Integrand


def _variance(
    sampler: str, dim: int, n: int, integrand: str, shown: str = ""
) -> tuple[str, VarianceProblem]:
    found, f = parse_sampler(sampler, dim), parse_integrand(integrand, dim)
    assert found.counts_at is not None
    name = f"{sampler} in {dim}D, {integrand}, N = {shown or number_text(n)}"
    return name, VarianceProblem(found, found.counts_at(n), f)


_NARROW, _EDGE = "radius=1e-9", "radius=0.499999999999"
_PAIRS = (  # an anisotropic Gaussian of widths 1e8 : 1, below and above its crossover
    ("latin-hypercube", "0.00000002,2", 10**38, 10**44),
    ("multi-jitter", "0.00000002,2", 10**64, 10**72),
    ("latin-hypercube", "0.00000005,5", 10**218, 10**224),
)

VARIANCE_PROBLEMS: tuple[tuple[str, VarianceProblem], ...] = (
    *(
        _variance(sampler, 2, n, f"anisotropic-gaussian:sigma=({sigmas})")
        for sampler, sigmas, *sides in _PAIRS
        for n in sides
    ),
    *(_variance("jitter", 2, n, f"disk:{_NARROW}") for n in (10**4, 10**30)),
    *(_variance("jitter", 2, n, f"disk:{_EDGE}") for n in (1, 10**4, 10**30)),
    *(_variance("multi-jitter", 2, 10**4, f"disk:{r}") for r in (_NARROW, _EDGE)),
    *(_variance("jitter", 1, 10**6, f"ball:{r}") for r in (_NARROW, _EDGE)),
    _variance("latin-hypercube", 2, 10**6, f"disk:{_EDGE}"),
    _variance("regular", 2, 10**4, "disk:radius=1/4"),
    _variance("jitter:1x1000000000", 2, 10**9, "disk:radius=1/4"),
    _variance("jitter:1x1000000000", 2, 10**9, "box:side=1/3"),
    _variance("jitter", 2, 10**300, "disk:radius=1/4"),
    _variance("jitter", 3, 10**300, "ball:radius=1/4"),
    _variance("correlated-multi-jitter", 2, 10**300, "product:k=2"),
    _variance("multi-jitter", 2, 10**300, "gaussian:sigma=1/10"),
    _variance("jitter", 2, 10**300, "box:side=1/3"),
    _variance("jitter", 1, 10**300, "polylog:p=5/2"),
    _variance("jitter", 1, 10**30, "chord:radius=1/4"),
    _variance("multi-jitter", 2, 10**300, "ridge:k=(3,-2)"),
    _variance("correlated-multi-jitter", 2, 10**300, "ridge:k=(1,1)"),
    _variance("random", 1000, 10**300, "product:k=2"),
    _variance("latin-hypercube", 1000, 10**300, "product:k=2"),
    _variance("jitter", 1000, 2**1000, "product:k=2", "2^1000"),
    _variance("multi-jitter", 1000, 2**1000, "product:k=2", "2^1000"),
    _variance("uncorrelated-jitter:500+500", 1000, 2**500, "product:k=2", "2^500"),
    _variance("jitter", 1000, 2**1000, "additive:k=2", "2^1000"),
)

_BOX = 250_000  # frequencies of a lattice sum: more digits would need more of them than there are


def _exact(problem: VarianceProblem, digits: int, route: str) -> Outcome:
    found = exact_variance(problem.sampler, problem.counts, problem.integrand, digits, route, _BOX)
    return Outcome(found.value, found.error_bound, "bound")


def _variance_reference(route: str) -> Reference[VarianceProblem]:
    def evaluate(problem: VarianceProblem) -> Ball:
        found = _exact(problem, DIGITS, route)
        return flint.arb(as_ball(found.value), as_ball(found.error))

    return Reference(route, evaluate)


def _certified(route: str) -> Method[VarianceProblem]:
    return Method(route, lambda p: _exact(p, _WORKED, route), route, _ATTEMPTS[route])


def _is_ball(problem: VarianceProblem) -> bool:
    return isinstance(problem.integrand, BallIntegrand)


def _has_covariogram(problem: VarianceProblem) -> bool:
    return isinstance(problem.integrand, BallIntegrand | Chord)


def _is_anisotropic(problem: VarianceProblem) -> bool:
    return problem.integrand.name.startswith("anisotropic-gaussian")


def _is_jitter_on_a_disk(problem: VarianceProblem) -> bool:
    is_square = problem.sampler.family == "jitter" and "n" in problem.counts
    return is_square and _is_ball(problem) and problem.integrand.dim == 2


_ATTEMPTS: dict[str, Callable[[VarianceProblem], bool]] = {
    "parseval": lambda p: p.sampler.family == "random",
    "product": lambda p: bool(p.integrand.parts),
    "ridge": lambda p: isinstance(p.integrand, Ridge),
    "covariogram": _has_covariogram,
    "lattice": lambda p: _is_ball(p) and p.integrand.dim <= 2,
}


def _by_scipy(problem: VarianceProblem) -> Outcome:
    return _estimated(disk_estimates.by_scipy(problem.counts["n"], _radius(problem)))


def _by_mpmath(problem: VarianceProblem) -> Outcome:
    return _estimated(disk_estimates.by_mpmath(problem.counts["n"], _radius(problem), _WORKED))


def _radius(problem: VarianceProblem) -> Fraction:
    assert isinstance(problem.integrand, BallIntegrand)
    return problem.integrand.radius


def _estimated(estimate: Estimate) -> Outcome:
    return Outcome(estimate.value, estimate.error, "estimate")


def _by_leading_terms(problem: VarianceProblem) -> Outcome:
    """The regions' leading terms; their constants claim 30 digits, the next terms are tiny."""
    n = problem.counts["N"]
    with mp.workdps(_WORKED + 10):
        terms = [
            c.constant * mp.mpf(n) ** (-mp.mpf(c.order.exponent.p) / c.order.exponent.q)
            for c in region_constants(problem.sampler, problem.integrand)
        ]
        value = mp.fsum(terms)
        return Outcome(value, value * mp.mpf(10) ** (2 - _WORKED), "estimate")


VARIANCES: Family[VarianceProblem] = Family(
    "Var",
    VARIANCE_PROBLEMS,
    (
        *(_certified(route) for route in _ATTEMPTS),
        Method("scipy", _by_scipy, attempts=_is_jitter_on_a_disk),
        Method("mpmath", _by_mpmath, attempts=_is_jitter_on_a_disk),
        Method("leading terms", _by_leading_terms, attempts=_is_anisotropic),
    ),
    tuple(_variance_reference(route) for route in ("product", "covariogram", "ridge", "parseval")),
)
