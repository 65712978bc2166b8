"""Appendix B, Eqs. 37-54: the rates of the worst and the best case, and one direction for all."""

from collections.abc import Callable
from functools import partial

from ...theory.symbolic import sympy
from ..entry import Entry, Status
from ..model import NOTE
from ..theorems import (
    best_case,
    cone_sums,
    radial,
    rays,
    readings,
    single_direction,
    worst_direction,
)
from ..theorems.radial import b, e, q
from ..theorems.tactics import ONE
from ..trusted.claims import Claim
from ..trusted.kernel import Step

_Proof = Callable[[], Step]
_SOURCE = "Appendix B, Eq"
_JUMP = Claim(q, "=", sympy.S.One)
"""q = 1, the worst case of Eq. 16: p = d + 1 on s = d."""
_TIE = Claim(b, "=", sympy.S.One)
_HALF = ONE / 2

EQ_50_FIRST = readings.order_claim("b<q", "Theta", -(1 + e) * b, 0, _JUMP)
EQ_48 = readings.order_claim("b>q", "Theta", -sympy.S.One, 0, _JUMP)
EQ_50 = readings.order_claim("b=q", "O", -1 - e, 0, _TIE)
EQ_50_RATE = readings.order_claim("b=q", "Theta", -1 - e, 0, _TIE)
_DENIED_48 = partial(readings.denial, EQ_48, "b>q", -sympy.S.One, 0, readings.numbers(b=2, q=1))
_DENIED_FIRST = partial(
    readings.denial, EQ_50_FIRST, "b<q", -(1 + e) * b, 0, readings.numbers(b=_HALF, q=1)
)
_DENIED_50 = partial(readings.denial, EQ_50, "b=q", -1 - e, 0, readings.numbers(b=1))
_DENIED_RATE = partial(readings.denial, EQ_50_RATE, "b=q", -1 - e, 0, readings.numbers(b=1))
_LEAST = {case: worst_direction.least_degree(case) for case in ("worst", "best")}
_DENIED_LEAST = {
    "worst": partial(
        worst_direction.least_degree_denied, "worst", (_HALF, 3 * _HALF / 2), (ONE, _HALF)
    ),
    "best": partial(worst_direction.least_degree_denied, "best", (_HALF, 2 * ONE), (ONE, ONE / 6)),
}


def _entry(
    number: str, title: str, source: str, status: Status, proof: _Proof | None,
    printed: Claim | None = None, as_printed: str = "", refutation: _Proof | None = None,
    notes: str = "",
) -> Entry:  # fmt: skip
    holds = proof().claim if proof else None
    return Entry(
        number, title, source, status, holds, proof, printed, as_printed, refutation, notes
    )


_SPLITTING = (
    _entry(
        "37-42", "one direction apart: Σ I_k Δn_k = Σ_{k≠r} I_k Δn_k + I_r Δn_r",
        f"{_SOURCE}s. 37-42", "corrected", cone_sums.one_direction_apart, cone_sums.WITHOUT_ANGLE,
        "Var < Σ_k^{m−1} I_k Δn_k + I_r", cone_sums.without_angle_denied,
        "Δn_r is lost, and denied where two cones make up the plane: the r-th term tends to 0 as "
        "the cones shrink. Sums lack k = 1, k ≠ r.",
    ),
    _entry(
        "43, 44", "a region of constant profile beside one of degree b_1 < 1: Θ(1/N)",
        f"{_SOURCE}s. 43, 44", "corrected", partial(worst_direction.with_constant_profile, "worst"),
        cone_sums.BOUNDED,
        "the integral over the r-th direction doesn't depend on N irrespective of what the "
        "function f is", cone_sums.bounded_denied,
        NOTE + "A region has a share in the integral, a direction has none (37-42). Denied where "
        "the integral is infinite: along an axis of the unit cube in three dimensions.",
    ),
    _entry(
        "45-47", "the worst case of a region without integrals, b_k < q",
        f"{_SOURCE}s. 45-47", "corrected", partial(radial.closed_form, "b<q"),
        cone_sums.FACTOR_OUTSIDE, "(γ_k/N) c_f Σ_k [...]", cone_sums.factor_outside_denied,
        NOTE + "γ_k belongs inside the sum over k; the upper limit ρ of the second integral is ν. "
        "For b_k > q and b_k = q: 17.",
    ),
)  # fmt: skip

_WORST = (
    _entry(
        "48, first row", "worst case, 0 < b_k < q: Θ(1/(N N_k^b_k))",
        f"{_SOURCE}. 48, first row", "proved", partial(radial.order, "b<q"),
        as_printed="Var < Σ_k 1/(N N_k^b_k) + O(1/N), 0 < b_k < 1",
        notes=NOTE + "Constants are left out in print.",
    ),
    _entry(
        "48", "worst case, b_k > q: Θ(1/(N N_k^q)), for a jump 1/(N N_k)",
        f"{_SOURCE}. 48, second row", "corrected", partial(radial.order, "b>q"), EQ_48,
        "Var < Σ_k 1/N + O(1/N), b_k >= 1", _DENIED_48,
        NOTE + "Read as the rate of one region, b_k > 1, q = 1. N_k is lost: the second row is "
        "1/(N N_k) for b_k > 1.",
    ),
    _entry(
        "49", "worst case, a region of constant profile beside one of degree b_1 < 1: Θ(1/N)",
        f"{_SOURCE}. 49", "proved", partial(worst_direction.with_constant_profile, "worst"),
        as_printed="Var < O(1/N)",
        notes=NOTE + "A bound as printed; with such a region of its own share of directions, a "
        "rate.",
    ),
    _entry(
        "50, first row", "worst case, 0 < b_k < q: Θ(1/(N N_k^b_k)), and not (1/(N N_k))^b_k",
        f"{_SOURCE}. 50, first row", "corrected", partial(radial.order, "b<q"), EQ_50_FIRST,
        "Var < O((1/(N N_k))^b_k), 0 < b_k < 1", _DENIED_FIRST,
        NOTE + "The exponent stands outside the bracket, and in Eq. 48 on N_k alone. As a bound "
        "the row holds, and is weaker; read as a rate it is denied at b = 1/2, N_k = N: N^−1 for "
        "N^(−3/2).",
    ),
    _entry(
        "50", "worst case, b_k = q: Θ(log(N_k)/(N N_k^b_k))", f"{_SOURCE}. 50, second row",
        "corrected", partial(radial.order, "b=q"), EQ_50, "Var < O(1/(N N_k)), b_k >= 1",
        _DENIED_50, NOTE + "At b = q = 1 a logarithm appears: log(N_k)/(N N_k).",
    ),
    _entry(
        "50, as a rate", "not: at b_k = 1 the worst case is Θ(1/(N N_k))",
        f"{_SOURCE}. 50, second row", "refuted", None, EQ_50_RATE, "Var < O(1/(N N_k)), b_k >= 1",
        _DENIED_RATE, NOTE + "Read as a rate at b_k = q = 1.",
    ),
    _entry(
        "50, infimum", "worst case, b_k < 1: the region of the least e_k b_k decides",
        f"{_SOURCE}. 50, first row", "corrected", partial(worst_direction.order_of_two, "worst"),
        _LEAST["worst"],
        "dominated by the k-th direction having the minimum value of b_k, for b_k in (0, 1)",
        _DENIED_LEAST["worst"],
        NOTE + "b = 1/2, N_k = N gives N^(−3/2); b = 3/4, N_k = N^(1/2) beside it decides: "
        "N^(−11/8).",
    ),
)  # fmt: skip

_BEST = (
    _entry(
        "51", "the best case of a region without integrals", f"{_SOURCE}. 51", "corrected",
        best_case.best_closed_form, cone_sums.FACTOR_OUTSIDE, "(γ_k c_f/N) Σ_k [...]",
        cone_sums.factor_outside_denied,
        NOTE + "γ_k belongs inside the sum over k, as in 45-47; ρ0 <= α_k N_k.",
    ),
    _entry(
        "52", "best case of a region, b_k > 0: Θ(1/(N N_k^b_k))", f"{_SOURCE}. 52", "proved",
        best_case.best_order, as_printed="Var < Σ_k O(1/(N N_k^b_k)) + O(1/N)", notes=NOTE.strip(),
    ),
    _entry(
        "53", "best case, a region of constant profile beside one of degree b_1 > 0: Θ(1/N)",
        f"{_SOURCE}. 53", "proved", partial(worst_direction.with_constant_profile, "best"),
        as_printed="Var < O(1/N)", notes=NOTE.strip(),
    ),
    _entry(
        "54", "best case: the region of the least e_k b_k decides", f"{_SOURCE}. 54", "corrected",
        partial(worst_direction.order_of_two, "best"), _LEAST["best"],
        "dominated by the k-th direction having the minimum value of b_k", _DENIED_LEAST["best"],
        NOTE + "b = 1/2, N_k = N gives N^(−3/2); b = 2, N_k = N^(1/6) beside it decides, N^(−4/3).",
    ),
)  # fmt: skip

_ONE_FOR_ALL = (
    _entry(
        "6.1", "a spectrum in Eq. 17 of which every direction falls as N^−3, the whole does not",
        "Section 6.1 and Appendix B", "corrected", single_direction.each_direction,
        single_direction.PRINTED,
        "the convergence rate would be decided by the direction n_k that would exhibit the worst "
        "convergence behaviour", single_direction.refutation,
        "Read as: every direction is O(N^−3), hence the whole is. The spectrum has degree 2 and "
        "N_k = N in every direction, and is no sampler's: constants must be uniform.",
    ),
    _entry(
        "6.1, rays", "jitter in 3D: every ray of frequencies falls as N^(−5/3), the whole does not",
        "Section 6.1 and Appendix B, on the torus", "corrected", rays.each_ray, rays.WHOLE,
        "the convergence rate would be decided by the direction n_k that would exhibit the worst "
        "convergence behaviour", rays.refutation,
        "Read as: every ray is O(N^(−5/3)), hence the whole is. Of jitter itself with n³ points "
        "and |f^|² = |m|^−4, the decay of a ball: 2π²/(3|m|² n^5) on the ray of m. Rays with a "
        "coordinate 0 are not covered.",
    ),
    _entry(
        "6.1, from below", "jitter in 3D and |f^|² = |m|^−4: the variance is at least N^(−4/3)/288",
        "against Section 6.1", "proved", rays.lower_bound,
    ),
)  # fmt: skip

ENTRIES = (*_SPLITTING, *_WORST, *_BEST, *_ONE_FOR_ALL)
