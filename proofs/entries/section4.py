"""Section 4, Eqs. 7-9: the variance in polar coordinates, and direction by direction."""

from .. import point_readings, polar, single_direction
from ..entry import Entry

ENTRIES = (
    Entry(
        number="7",
        title="polar coordinates: ∫∫ dx dy = ∫∫ ρ dρ dφ",
        source="Section 4, Eq. 7, at d = 2",
        status="proved",
        holds=polar.cartesian_is_polar().claim,
        proof=polar.cartesian_is_polar,
        as_printed="Var I_N = ∫ ρ^(d−1) ∫ E P_S(ρn) P_f(ρn) dn dρ",
        notes="At P_S P_f = xy exp(−αx² − (α + δ)y²) on a quarter of a disc for all α, δ, R > 0, "
        "which determine a measure. It says what Eq. 4 says: on the torus a sum takes its place.",
    ),
    Entry(
        number="8",
        title="the order of the integrals over radius and direction is free",
        source="Section 4, Eq. 8, at d = 2",
        status="proved",
        holds=polar.order_of_integrals().claim,
        proof=polar.order_of_integrals,
        as_printed="Var I_N = ∫ ∫ ρ^(d−1) E P_S(ρn) P_f(ρn) dρ dn",
        notes="For all ρ^(p−1) exp(qφ) on a shell, whose sums come near every continuous spectrum.",
    ),
    Entry(
        number="8, text",
        title="the variance is finite if P_S is bounded and P_f summable: f square integrable",
        source="Section 4, after Eq. 8",
        status="corrected",
        holds=point_readings.bounded_spectrum().claim,
        proof=point_readings.bounded_spectrum,
        printed=point_readings.SQUARE,
        as_printed="f Lebesgue integrable, which makes the integral bounded",
        refutation=point_readings.integrable_is_not_enough,
        notes="x^(−1/2) is integrable on [0, 1] and its square is not: ∫ P_f = ∫ f² = ∞, the "
        "variance of one random point.",
    ),
    Entry(
        number="9",
        title="a sum over m directions, where the spectra are smooth functions of the direction",
        source="Section 4, Eq. 9, at d = 2",
        status="corrected",
        holds=polar.directions().claim,
        proof=polar.directions,
        printed=point_readings.RIDGE,
        as_printed="Var I_N = lim_m Σ_k ∫ ρ^(d−1) E P_S(ρn_k) P_f(ρn_k) dρ Δn_k, on the axes",
        refutation=point_readings.ridge_has_no_weight,
        notes="Reached at m > q for a trigonometric polynomial of degree q of the direction. A "
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
        as_printed="every direction O(N^-3), hence the whole O(N^-3)",
        refutation=single_direction.refutation,
        notes="Each direction falls as N^−3 and the whole is at least 7(N − 1)/(15N³): constants "
        "must be uniform over the directions.",
    ),
)
