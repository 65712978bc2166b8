"""Section 5, Eqs. 10-15: line samples, their spectra and their variance."""

from functools import partial

from ...theory.symbolic import sympy
from ..entry import Entry
from ..theorems import deltas, line_estimators
from ..theorems.segments import line_of_a_wave
from ..theorems.stratified_spectra import d

EQ_10 = deltas.of_a_norm(d - 1)

ENTRIES = (
    Entry(
        number="10",
        title="the delta of a line is that of the d − 1 coordinates across it",
        source="Section 5, Eq. 10",
        status="corrected",
        holds=deltas.of_a_line().claim,
        proof=deltas.of_a_line,
        printed=EQ_10,
        as_printed="L(x) = (1/N) Σ_i δ(dist(x, l_j))",
        refutation=partial(
            deltas.norm_is_lost, EQ_10, ((d, sympy.Integer(3)), (deltas.sigma, 2 * sympy.pi))
        ),
        notes="Denied for d >= 3. The mass of δ(distance) tends to 0 where the distance is in more "
        "than one dimension; σ is the area of the unit sphere of d − 1 dimensions. The sum is "
        "over j, and offsets are uniform on a cross-section of area 1.",
    ),
    Entry(
        number="10, distance",
        title="‖(l − x) + (x·e) e‖² = ‖x − l‖² − (x·e)²",
        source="Section 5, after Eq. 10",
        status="proved",
        holds=line_estimators.distance().claim,
        proof=line_estimators.distance,
        notes="The line has the direction e, ‖e‖ = 1, and its point l that is closest to the "
        "origin, l·e = 0; with c = x·e the last three sums on the right are −c² together.",
    ),
    Entry(
        number="11",
        title="lines see of f what is on the plane q = 0, at their offsets",
        source="Section 5, Eq. 11",
        status="corrected",
        holds=line_estimators.estimator().claim,
        proof=line_estimators.estimator,
        as_printed="I_N = ∫ conj F_f(ν) F_L(ν) dν",
        notes="What is wrong is notation, and nothing is denied: on the torus ∫ is a sum over the "
        "whole frequencies (m_k, q_k) across and along; sinc² q is [q = 0]. p_kj is the phase of "
        "wave k at the offset j. Proved for trigonometric polynomials.",
    ),
    Entry(
        number="12",
        title="a line of length L sees at most 1/(πνL) of a wave of frequency ν along it",
        source="Section 5, Eq. 12",
        status="corrected",
        holds=line_estimators.long_line().claim,
        proof=line_estimators.long_line,
        printed=deltas.SQUARED,
        as_printed="F_L(ν) = (1/N) Σ_j δ(ν·l_j^∥) exp(−2πi ν·l_j^⊥), P_L = ‖F_L‖²",
        refutation=deltas.square_has_no_integral,
        notes="As L grows, what remains is on the plane where ν along the line is 0. The square "
        "of a delta has no integral: P_L is the power of the offsets on the plane ν·l^∥ = 0.",
    ),
    Entry(
        number="13",
        title="the prefiltered integrand has the spectrum of f on the plane, not its conjugate",
        source="Section 5, Eq. 13",
        status="corrected",
        holds=line_estimators.slice_of_the_spectrum().claim,
        proof=line_estimators.slice_of_the_spectrum,
        printed=line_estimators.CONJUGATE,
        as_printed="F_f~ = δ conj F_f",
        refutation=line_estimators.no_conjugate,
        notes="Proved for trigonometric polynomials. At an offset p wave k has the phase b_k = "
        "2πm_k·p + α_k: what is left of f has the frequencies m_k with q_k = 0, with their own "
        "phases α_k. Witness: sin 2πp, whose coefficient has the imaginary part −1/2.",
    ),
    Entry(
        number="13, text",
        title="prefiltering restricts the spectrum to the plane, and does not integrate it",
        source="Section 5, after Eq. 13",
        status="corrected",
        holds=line_estimators.restricted_not_integrated().claim,
        proof=line_estimators.restricted_not_integrated,
        printed=line_estimators.INTEGRATED,
        as_printed="collapsing (integrating) the original integrand's Fourier spectrum F_f along "
        "the direction l_j^∥",
        refutation=line_estimators.integrated_is_wrong,
        notes="cos 2πqt integrates to 0 along t; the sum of its spectrum along t is its value 1 "
        "at t = 0.",
    ),
    Entry(
        number="14",
        title="jittered lines: N P_L = [ν along is 0] (1 − ∏ sinc²(m_i/n_i))",
        source="Section 5, Eq. 14, second row",
        status="corrected",
        holds=line_estimators.jittered_lines().claim,
        proof=line_estimators.jittered_lines,
        printed=line_estimators.JITTERED_LINES,
        as_printed="⟨P_L(ν)⟩ = (1/N) [1 − ∏^(d−1) Sinc(πν_i l_i^⊥)²] for jittered",
        refutation=line_estimators.offsets_are_no_scale,
        notes="The delta is missing, and ν_i is multiplied by a position where it should be "
        "divided by n_i = N^(1/(d−1)); here d counts the coordinates across, and q is ν along. "
        "Denied at d = 2, N = 2, m = 1, q = 0 and a line at 1/4: 0.297... and not 0.094...",
    ),
    Entry(
        number="14, random",
        title="random lines: N P_L = [ν along is 0] at whole frequencies across that are not 0",
        source="Section 5, Eq. 14, first row",
        status="corrected",
        holds=line_estimators.random_lines().claim,
        proof=line_estimators.random_lines,
        printed=line_estimators.RANDOM_LINES,
        as_printed="⟨P_L(ν)⟩ = (1/N) δ(ν·l^⊥) for random",
        refutation=line_estimators.power_across_random_lines,
        notes="Printed, no power where ν·l^⊥ ≠ 0; it is where ν·l^∥ ≠ 0 that there is none. Denied "
        "at d = 2, ν = (1, 0), one line along the second axis: 1. Here d counts the coordinates "
        "across, and q is ν along.",
    ),
    Entry(
        number="15a",
        title="one delta in P_L takes the Jacobian down: ρ^(d−1) δ(ρc) has the mass ρ^(d−2)",
        source="Section 5.1, Eq. 15a",
        status="corrected",
        holds=line_estimators.one_delta().claim,
        proof=line_estimators.one_delta,
        printed=deltas.SQUARED,
        as_printed="Var I_N = lim_(m→∞) Σ_k ∫ ρ^(d−1) ⟨P_L(ρn_k)⟩ P_f(ρn_k) dρ Δn",
        refutation=deltas.square_has_no_integral,
        notes="Denied with the P_L of Eq. 12, the square of a delta. With one delta, "
        "δ(ρc) = δ(c)/ρ, c = n·l^∥, the mass is as of Eq. 15b, and no more is proved: as a "
        "variance and as a sum over directions it stands corrected with Eqs. 4 and 9.",
    ),
    Entry(
        number="15b",
        title="over directions of the plane the Jacobian is ρ^(d−2): it has λ^(d−1) frequencies "
        "below λ",
        source="Section 5.1, Eq. 15b",
        status="corrected",
        holds=line_estimators.volume_of_the_plane().claim,
        proof=line_estimators.volume_of_the_plane,
        printed=line_estimators.EQ_15B,
        as_printed="Var I_N = lim_(m→∞) Σ_k ∫ ρ^(d−1) ⟨P_S(ρn_k)⟩ P_f~(ρn_k) dρ Δn, n_k in S^(d−2)",
        refutation=line_estimators.volume_of_the_space,
        notes="A plane of d − 1 dimensions has λ^(d−1) times the frequencies below λ; ρ^(d−1) "
        "gives it λ^d. Denied at d = 2, λ = 2. As a variance it stands corrected with Eqs. 4 "
        "and 9.",
    ),
    Entry(
        number="Sec. 5, homogeneous",
        title="a random point has no mean wave of whole frequency, wherever the torus is cut",
        source="Section 5, homogenized line samples",
        status="proved",
        holds=line_of_a_wave().claim,
        proof=line_of_a_wave,
        as_printed="Samplers like white noise ... are homogeneous by construction",
        notes="Of one axis of random points, and, as they are independent, of all. Not proved of "
        "what the paper derives from them (Poisson disk, CCVT, BNOT): these are stationary if "
        "what makes them knows no edge of the torus, and not if it does.",
    ),
)
