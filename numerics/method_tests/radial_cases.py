"""Stiff cases of Eq. 17: next to a tie, a step, ρ0 beyond ν, N that no double holds, d = 1000."""

from fractions import Fraction

from ..balls import certified
from ..equation17 import radial_estimates
from ..equation17.radial_estimates import Estimate
from ..equation17.radial_integrals import RadialProblem, prepared, solve
from ..integrands.protocol import mp
from .stress import DIGITS, Family, Method, Outcome, Reference

_SHOWN = 50  # digits asked of the certified methods
_WORKED = 30  # digits asked of mpmath


def _radial(
    degree: Fraction | int,
    dimension: int,
    decay: Fraction | int | None,
    n: int | None,
    *,
    log10_n: int | None = None,
    alpha: Fraction | int = 1,
    rho0: Fraction | int = 1,
) -> RadialProblem:
    return RadialProblem(
        Fraction(degree),
        dimension,
        None if decay is None else Fraction(decay),
        None if n is None else Fraction(n),
        None if log10_n is None else Fraction(log10_n),
        Fraction(1, dimension),
        alpha=Fraction(alpha),
        rho0=Fraction(rho0),
    )


_TINY, _SMALL = Fraction(1, 10**12), Fraction(1, 10**9)

RADIAL_PROBLEMS: tuple[tuple[str, RadialProblem], ...] = (
    ("b = 1 - 1e-12, d = 1", _radial(1 - _TINY, 1, 2, 10**6)),
    ("b = 1 + 1e-12, d = 2", _radial(1 + _TINY, 2, 3, 10**30)),
    ("b - q = -1e-9", _radial(Fraction(3, 2) - _SMALL, 2, Fraction(7, 2), 10**30)),
    ("b - q = 1e-9", _radial(Fraction(3, 2) + _SMALL, 2, Fraction(7, 2), 10**30)),
    ("b - q = 1e-9, q = 2, N = 1e6", _radial(2 + _SMALL, 3, 5, 10**6)),
    ("b = 1e6", _radial(10**6, 2, 3, 10**6)),
    ("b = 1e6, N = 1e300", _radial(10**6, 2, 3, 10**300)),
    ("b = 1e6, best case", _radial(10**6, 2, None, 16, rho0=3)),
    ("b = 1e6, rho0 = 1e12", _radial(10**6, 2, 3, 10**30, rho0=10**12)),
    ("rho0 = 1e12 nu", _radial(2, 2, 3, 10**6, rho0=10**15)),
    ("rho0 = 1e12 nu, best case", _radial(2, 2, None, 10**6, rho0=10**15)),
    ("rho0 = nu", _radial(2, 2, 3, 10**6, rho0=10**3)),
    ("rho0 = nu (1 - 1e-12)", _radial(2, 2, 3, 10**6, rho0=10**3 * (1 - _TINY))),
    ("alpha = 1e30", _radial(2, 2, 3, 10**6, alpha=10**30)),
    ("alpha = 1e-30", _radial(2, 2, 3, 10**6, alpha=Fraction(1, 10**30))),
    ("N = 1e300", _radial(2, 2, 3, 10**300)),
    ("N = 1e300, b = 0", _radial(0, 2, 3, 10**300)),
    ("log N = 5000", _radial(1, 1, 2, None, log10_n=5000)),
    ("log N = 5000, b = 1 + 1e-12", _radial(1 + _TINY, 1, 2, None, log10_n=5000)),
    ("d = 1000", _radial(2, 1000, 1001, 10**6)),
    ("d = 1000, b = 1, N = 1e300", _radial(1, 1000, 1001, 10**300)),
    ("d = 1000, b = 1e6, rho0 = 1e12", _radial(10**6, 1000, 1001, 10**30, rho0=10**12)),
)


def _certified_radial(route: str) -> Method[RadialProblem]:
    def evaluate(problem: RadialProblem) -> Outcome:
        found = solve(problem, _SHOWN, route).value
        with mp.workdps(_SHOWN + 10):
            return Outcome(mp.mpf(found.value), mp.mpf(found.error_bound), "bound")

    return Method(route, evaluate, route)


def _radial_reference(route: str) -> Reference[RadialProblem]:
    return Reference(route, lambda problem: certified(prepared(problem, route), DIGITS))


def _estimated(estimate: Estimate) -> Outcome:
    return Outcome(estimate.value, estimate.error, "estimate")


RADIAL: Family[RadialProblem] = Family(
    "Eq. 17",
    RADIAL_PROBLEMS,
    (
        _certified_radial("closed"),
        _certified_radial("quadrature"),
        Method("doubles", lambda p: _estimated(radial_estimates.by_doubles(p)), "closed"),
        Method("scipy", lambda p: _estimated(radial_estimates.by_scipy(p)), "quadrature"),
        Method(
            "mpmath", lambda p: _estimated(radial_estimates.by_mpmath(p, _WORKED)), "quadrature"
        ),
    ),
    (_radial_reference("closed"), _radial_reference("quadrature")),
)
