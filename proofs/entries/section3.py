"""Section 3, Eqs. 1-6: the integral, its estimators, the variance, and spectra of points."""

from dataclasses import replace
from functools import cache, partial

from ...theory.symbolic import sympy
from ..entry import Entry
from ..theorems import (
    constant_integrand,
    deltas,
    homogenisation,
    point_readings,
    polar,
    stratified_spectra,
    variance,
)
from ..theorems.exponential_sums import N, jitter_on_an_axis, m, strata
from ..theorems.stratified_spectra import d
from ..theorems.tactics import ZERO
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step

_UNSCALED = (sympy.sin(sympy.pi * m) / (sympy.pi * m)) ** 2
_GIVEN = (*strata(), Claim(m, "!=", ZERO))
_SCOPE = (
    "Proved for trigonometric polynomials, wave k of which a shift t/M turns by 2πkt/M, M > 2K; "
    "for the rest see 4."
)
EQ_2 = deltas.of_a_norm(d)
EQ_5 = Claim(jitter_on_an_axis().claim.left, "=", (1 - _UNSCALED) / N, _GIVEN)


@cache
def unscaled_jitter() -> Step:
    """At N = 2, m = 1 jitter has P_S = (1 − 4/π²)/2 = 0.297..., and not 1/2."""
    values = ((N, sympy.Integer(2)), (m, sympy.S.One))
    there, exact = EQ_5.at(*values), jitter_on_an_axis().claim.at(*values)
    true = Claim(there.left, "=", exact.right)
    known = Step(true, by.Instance(values), (jitter_on_an_axis(),))
    below = Step(Claim(true.right, "<", there.right), by.Interval())
    less = Step(
        Claim(there.left, "<", there.right), by.Combine((sympy.S.One, sympy.S.One)), (known, below)
    )
    return Step(replace(EQ_5, false=True), by.Counterexample(values), (less,))


ENTRIES = (
    Entry(
        number="1",
        title="the domain must have a volume: a unit cube for the d-dimensional Euclidean space",
        source="Section 3, Eq. 1, and the uniform samples of Eq. 2",
        status="corrected",
        holds=deltas.unit_cube().claim,
        proof=deltas.unit_cube,
        printed=deltas.UNIFORM_ON_THE_LINE,
        as_printed="samples uniformly distributed over D, the d-dimensional Euclidean space",
        refutation=deltas.no_uniform_law,
        notes="No constant density has the integral 1 over R. D is the unit cube, as a torus where "
        "points are shifted; or the points are a stationary process of intensity N.",
    ),
    Entry(
        number="2",
        title="the delta of a sample is δ(x − s_j) in d dimensions, not δ of a distance",
        source="Section 3, Eq. 2",
        status="corrected",
        holds=deltas.of_a_point().claim,
        proof=deltas.of_a_point,
        printed=EQ_2,
        as_printed="S(x) = (1/N) Σ δ(‖x − s_j‖)",
        refutation=partial(
            deltas.norm_is_lost, EQ_2, ((d, sympy.Integer(2)), (deltas.sigma, 2 * sympy.pi))
        ),
        notes="Denied for d >= 2. "
        "The mass of a one-dimensional delta of ‖x‖ tends to 0 for d > 1, as polar "
        "coordinates bring ρ^(d−1); σ is the area of the unit sphere. The height that has mass 1 "
        "on a ball of radius 1/h is d h^d/σ.",
    ),
    Entry(
        number="2, unbiased",
        title="the shifted estimator has the mean I, whatever the points: f of K waves, M shifts",
        source="Section 3, Eq. 2 and footnote 1",
        status="proved",
        holds=variance.unbiased().claim,
        proof=variance.unbiased,
        as_printed="Homogenization of sampling patterns ... resulting in an unbiased estimator",
        notes="I_N − I has the mean 0 over the shifts. " + _SCOPE,
    ),
    Entry(
        number="3",
        title="the estimator in the frequency domain: a sum over the frequencies of f",
        source="Section 3, Eq. 3",
        status="corrected",
        holds=variance.frequency_domain().claim,
        proof=variance.frequency_domain,
        as_printed="I_N = ∫ F_S(ν) conj F_f(ν) dν, F_S(ν) = (1/N) Σ_i exp(−2πi ν·s_j)",
        notes="What is wrong is notation, and nothing is denied: the sum is over j, and on the "
        "torus Φ is the whole frequencies and ∫ a sum. "
        "a_k cos(2πm_k·x + α_k) has the phases p_kj = 2πm_k·s_j + α_k at the points; the right "
        "side is Re F_S(m_k) conj F_f(m_k) of the points shifted by t/M, summed over m_k and −m_k. "
        + _SCOPE,
    ),
    Entry(
        number="footnote 1",
        title="homogenization turns F_S(m) and keeps its modulus",
        source="Section 3, footnote 1",
        status="corrected",
        holds=point_readings.shift_keeps_power().claim,
        proof=point_readings.shift_keeps_power,
        printed=point_readings.IN_THE_DISC,
        as_printed="the sampling Fourier coefficients are uniformly distributed in the complex "
        "plane",
        refutation=point_readings.on_the_circle,
        notes="Only the phase becomes uniform; |F_S(m)|² is that of the unshifted points. Read as "
        "uniform in the unit disc, where the mean of |F|² is 1/2 (no law is uniform in the whole "
        "plane): one point has |F_S| = 1 at every shift.",
    ),
    Entry(
        number="footnote 2",
        title="an unnormalised sampling function needs 1/N² in the variance: f of K waves, "
        "M shifts",
        source="Section 3, footnote 2",
        status="corrected",
        holds=variance.over_shifts().claim,
        proof=variance.over_shifts,
        printed=point_readings.UNNORMALISED,
        as_printed="an additional 1/N normalization factor",
        refutation=point_readings.one_over_n_twice,
        notes="With U = |Σ_j exp(−2πi m·s_j)|² the variance is (1/N²) Σ U P_f; 1/N belongs to the "
        "periodogram U/N. Witness: two points at 0, f = cos 2πx: 1/2 and not 1. " + _SCOPE,
    ),
    Entry(
        number="4",
        title="Var I_N = Σ_{m ≠ 0} E P_S(m) P_f(m), points shifted at random: f of K waves, "
        "M shifts, W realisations",
        source="Section 3, Eq. 4",
        status="corrected",
        holds=variance.variance().claim,
        proof=variance.variance,
        printed=constant_integrand.PRINTED,
        as_printed="Var I_N = ∫ ⟨P_S(ν)⟩ P_f(ν) dν, where Θ includes all frequencies except DC",
        refutation=constant_integrand.refutation,
        notes="All frequencies but one are all frequencies to an integral: a constant on the unit "
        "cube would have the variance (2/N) ∫_0^∞ sinc² ν dν, denied at P_S = 1/N. On the torus "
        "the sum over whole m stands for it; the integral holds for a stationary process on R^d, "
        "whose random number of points it counts. a_k²/2 is |f^|² at m_k and −m_k, ω a "
        "realisation of weight w_ω. Proved for trigonometric polynomials, wave k of which a shift "
        "t/M turns by 2πkt/M, M > 2K. That the frequencies of any such f in d dimensions can be "
        "listed so, with distinct whole k, by a shift along one generic direction, and that "
        "square-integrable f, and laws of infinitely many realisations, are limits of such, is "
        "argued outside the kernel.",
    ),
    Entry(
        number="homogenisation",
        title="a random shift costs an integrand that is not periodic its rate: N^−3 and N^−2",
        source="Section 3, Eq. 4: the homogenized sampling pattern",
        status="corrected",
        holds=homogenisation.shifted().claim,
        proof=homogenisation.shifted,
        printed=homogenisation.PRINTED,
        as_printed="the variance of I_N depends on the ... expected power spectrum of the "
        "homogenized sampling pattern",
        refutation=homogenisation.refutation,
        notes="Read as: the variance of the pattern, N^−3 at f = x, is that of the homogenized "
        "one. f = x on [0, 1], 1D jitter: (2N − 1)/(12 N³) with the shift. Eq. 4 needs f to be "
        "periodic, or 0 near the ends of the cube.",
    ),
    Entry(
        number="homogenisation, without",
        title="f = x under 1D jitter that is not shifted: 1/(12 N³)",
        source="Section 3, Eq. 4: the homogenized sampling pattern",
        status="proved",
        holds=homogenisation.unshifted().claim,
        proof=homogenisation.unshifted,
    ),
    Entry(
        number="5",
        title="expected power spectrum of jitter, N P_S = 1 − ∏ sinc²(m_i/n_i) at whole m ≠ 0",
        source="Section 3, Eq. 5, second row",
        status="corrected",
        holds=stratified_spectra.jitter_at_whole_frequencies().claim,
        proof=stratified_spectra.jitter_at_whole_frequencies,
        printed=EQ_5,
        as_printed="⟨P_S(ν)⟩ = (1/N) (1 − ∏ Sinc(πν_i)²) for jittered",
        refutation=unscaled_jitter,
        notes="The argument must be ν_i/n_i, ν_i/N^(1/d) for equal strata: at whole frequencies "
        "the printed row is 1/N. Denied at d = 1, N = 2, m = 1: 0.297... and not 1/2.",
    ),
    Entry(
        number="5, random",
        title="independent points: N P_S = 1 + (N − 1) ∏ sinc² ν_i, which is 1 at whole ν ≠ 0",
        source="Section 3, Eq. 5, first row",
        status="corrected",
        holds=stratified_spectra.random().claim,
        proof=stratified_spectra.random,
        printed=point_readings.EVERYWHERE,
        as_printed="⟨P_S(ν)⟩ = 1/N for random",
        refutation=point_readings.not_between_whole_frequencies,
        notes="1/N at the frequencies that a sum needs, whole ones; at all of R^d only for a "
        "Poisson process. Denied at d = 1, N = 2, ν = 1/2: N P_S = 1 + 4/π².",
    ),
    Entry(
        number="6",
        title="radial averages: the sphere's area is missing, and either spectrum may be isotropic",
        source="Section 3, Eq. 6, at d = 2",
        status="corrected",
        holds=polar.radial_averages().claim,
        proof=polar.radial_averages,
        printed=polar.EQ_6,
        as_printed="Var I_N = ∫ ρ^(d−1) P̆_S(ρ) P̆_f(ρ) dρ",
        refutation=polar.no_circle,
        notes="P_S = ρ^b (1 + s cos 2πφ)/N, P_f = ρ^p (1 + t cos 2πφ) on a shell: the averages "
        "give the integral, times 2π, if and only if st = 0. Isotropic sampling is not needed "
        "where the integrand is isotropic. Witness: s = t = b = p = 0 on 1 < ρ < 2: 3π and not "
        "3/2.",
    ),
)
