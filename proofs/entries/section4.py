"""Section 4, Eqs. 7-9: the variance in polar coordinates, and direction by direction."""

from ..entry import Entry
from ..theorems import constant_integrand, point_readings, polar, single_direction

ENTRIES = (
    Entry(
        number="7",
        title="polar coordinates at d = 2 for the integrands xy exp(−αx² − (α + δ)y²)",
        source="Section 4, Eq. 7, at d = 2",
        status="corrected",
        holds=polar.cartesian_is_polar().claim,
        proof=polar.cartesian_is_polar,
        printed=constant_integrand.PRINTED,
        as_printed="Var I_N = ∫ ρ^(d−1) ∫ ⟨P_S(ρn)⟩ P_f(ρn) dn dρ",
        refutation=constant_integrand.refutation,
        notes="As a variance it is the integral of Eq. 4, and denied with it: f = 1 at d = 1, two "
        "directions. What is proved is the change of coordinates on a quarter of a disc, "
        "P_S P_f = xy exp(−αx² − (α + δ)y²) for all α, δ, R > 0; that these determine a measure, "
        "hence ρ dρ dφ is dx dy, is argued outside the kernel.",
    ),
    Entry(
        number="8",
        title="the order of the integrals over radius and direction: ρ^(p−1) exp(qφ) on a shell",
        source="Section 4, Eq. 8, at d = 2",
        status="corrected",
        holds=polar.order_of_integrals().claim,
        proof=polar.order_of_integrals,
        printed=constant_integrand.PRINTED,
        as_printed="Var I_N = ∫ ∫ ρ^(d−1) ⟨P_S(ρn)⟩ P_f(ρn) dρ dn",
        refutation=constant_integrand.refutation,
        notes="As a variance it is the integral of Eq. 4, and denied with it: f = 1 at d = 1. What "
        "is proved is the order of the integrals of all ρ^(p−1) exp(qφ) on a shell; that their "
        "sums come near every continuous spectrum is argued outside the kernel.",
    ),
    Entry(
        number="8, text",
        title="the variance is finite if P_S is bounded and P_f summable: f square integrable",
        source="Section 4, after Eq. 8",
        status="corrected",
        holds=point_readings.bounded_spectrum().claim,
        proof=point_readings.bounded_spectrum,
        printed=point_readings.SQUARE,
        as_printed="with f(·) Lebesgue integrable, which makes the integral bounded",
        refutation=point_readings.integrable_is_not_enough,
        notes="For every number K of frequencies, hence for all. x^(−1/2) is integrable on [0, 1] "
        "and its square is not: ∫ P_f = ∫ f² = ∞, the variance of one random point.",
    ),
    Entry(
        number="9",
        title="a sum over m directions, for trigonometric polynomials of the direction",
        source="Section 4, Eq. 9, at d = 2",
        status="corrected",
        holds=polar.directions().claim,
        proof=polar.directions,
        printed=point_readings.RIDGE,
        as_printed="Var I_N = lim_(m→∞) Σ_k ∫ ρ^(d−1) ⟨P_S(ρn_k)⟩ P_f(ρn_k) dρ Δn_k",
        refutation=point_readings.ridge_has_no_weight,
        notes="Reached at m > q for A + B cos of degree q of the direction, hence for their sums. "
        "A "
        "spectrum with ridges, as of a Latin hypercube on its axes, is no such function: each "
        "ridge has the weight Δn_k → 0, and on the torus it has the whole of the variance of "
        "cos 2πx. The decomposition that holds is by supports {i: m_i ≠ 0}. Δn_k is a solid "
        "angle, and not a volume.",
    ),
    Entry(
        number="Sec. 4, one direction",
        title="the rate of the whole is not the rate of one direction",
        source="Section 4, last paragraph",
        status="refuted",
        printed=single_direction.PRINTED,
        as_printed="the overall variance convergence rate ... can be deduced by studying the power "
        "spectrum along a single particular direction",
        refutation=single_direction.refutation,
        notes="Read as: every direction is O(N^−3), hence the whole is. It is the denial of 6.1, "
        "where each direction is proved to fall so; the whole is at least 7(N − 1)/(15N³).",
    ),
)
