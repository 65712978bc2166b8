"""Section 6 up to 6.1, Eqs. 16-18: cases of the integrand, the radial integral, profiles."""

from functools import partial

from ..entry import Entry
from ..model import NOTE
from ..theorems import axis_terms, classes, integrand_rows, jitter_bounds, profile_limits, radial


def _closed(case: radial.Case, form: str) -> Entry:
    return Entry(
        number=f"17, {case}",
        title=f"the radial integral in closed form, {form}",
        source="Section 6.1, Eq. 17 with Eqs. 16 and 18",
        status="corrected",
        holds=radial.closed_form(case).claim,
        proof=partial(radial.closed_form, case),
        as_printed="Σ_k [∫_0^ν ... + ∫_ν^∞ ... dρ",
        notes=NOTE + "One region, s for d, ρ0 <= ν. What is wrong is notation, and nothing is "
        "denied: the closing bracket and Δn_k are not printed.",
    )


ENTRIES = (
    Entry(
        number="16",
        title="worst case with rows that meet: its energy is c ρ0^d (d + 1)/d",
        source="Section 6, Eq. 16",
        status="corrected",
        holds=integrand_rows.energy().claim,
        proof=integrand_rows.energy,
        printed=integrand_rows.ROWS,
        as_printed="P_f = c_f below ρ0, c_f ρ^(−d−1) beyond",
        refutation=integrand_rows.rows_do_not_meet,
        notes="The second row is c_f (ρ/ρ0)^(−d−1): both sides then scale alike with ρ and ρ0. "
        "That a body decays so is proved of an interval; no entry proves it of a ball for d >= 2.",
    ),
    Entry(
        number="16, an interval",
        title="d = 1: an interval has |f^(m)|² = sin²(πam)/(πm)² <= 1/(πm)²",
        source="Section 6, the worst case of the class",
        status="proved",
        holds=integrand_rows.interval_decay().claim,
        proof=integrand_rows.interval_decay,
        as_printed="the power fall-off of the order O(ρ^−(d+1))",
    ),
    Entry(
        number="16, along each direction",
        title="a square falls off as ρ^−2 along its axes, not as ρ^−3",
        source="Section 6, Eq. 16",
        status="corrected",
        holds=integrand_rows.square_along_an_axis().claim,
        proof=integrand_rows.square_along_an_axis,
        printed=integrand_rows.SQUARE_ALONG_AN_AXIS,
        as_printed="power spectra P_f(ρn_k), along each direction n_k, to have the form ... "
        "c_f ρ^(−d−1)",
        refutation=integrand_rows.square_decays_slower,
        notes="The decay d + 1 is that of the mean over a sphere of directions (Brandolini, "
        "Hofmann, Iosevich 2003), which is not proved here.",
    ),
    _closed("b>q", "b > q"),
    _closed("b=q", "b = q"),
    _closed("b<q", "b < q"),
    Entry(
        number="17, small N",
        title="while αN_k <= ρ0: (γ/N) {c [ρ0^s/s − bν^s/(s(s + b))] + c₂ρ0^−q/q}",
        source="Section 6.1, Eq. 17 with Eqs. 16 and 18",
        status="proved",
        holds=axis_terms.before_rho0().claim,
        proof=axis_terms.before_rho0,
        notes=NOTE + "The paper's rates begin where ρ0 <= αN_k; before, there is no decay beyond "
        "1/N.",
    ),
    Entry(
        number="18, from below",
        title="jitter in any dimension is at least Y/(1 + Y), Y = (π²/3)|x|²",
        source="Section 6.1, Eq. 18, at jitter",
        status="proved",
        holds=jitter_bounds.jitter_from_below().claim,
        proof=jitter_bounds.jitter_from_below,
        notes="With the bound from above the profile holds on both sides within a factor 2.",
    ),
    Entry(
        number="18, plateau",
        title="jitter never exceeds its plateau: γ = 1",
        source="Section 6.1, Eq. 18, at jitter",
        status="proved",
        holds=jitter_bounds.jitter_at_most_one().claim,
        proof=jitter_bounds.jitter_at_most_one,
    ),
    Entry(
        number="18, any spectrum",
        title="the profile does not bound a regular grid: power 1 at m = N",
        source="Section 6.1, after Eq. 18",
        status="corrected",
        holds=profile_limits.comb().claim,
        proof=profile_limits.comb,
        printed=profile_limits.COMB,
        as_printed="applicable to both the point and line samples with arbitrary power spectra",
        refutation=profile_limits.comb_is_not_bounded,
        notes="γ is free of N; the peaks of grids and lattices are not below any γ/N.",
    ),
    Entry(
        number="6.1, classes from above",
        title="finitely many classes, each at most C(k) g: the whole is at most (Σ C(k)) g",
        source="Section 6.1 and Appendix B, what holds",
        status="proved",
        holds=classes.from_above().claim,
        proof=classes.from_above,
        as_printed="the summand ... showing the worst convergence rate among all would dominate "
        "the overall convergence rate",
        notes="Finitely many classes, with constants free of N; not infinitely many directions.",
    ),
    Entry(
        number="6.1, classes from below",
        title="one class at least κ g: the whole is at least κ g",
        source="Section 6.1 and Appendix B, what holds",
        status="proved",
        holds=classes.from_below().claim,
        proof=classes.from_below,
        as_printed="the convergence rate would be decided by the direction n_k that would exhibit "
        "the worst convergence behaviour",
        notes="A single direction of a continuum has no share in the integral, one of finitely "
        "many classes has.",
    ),
)
