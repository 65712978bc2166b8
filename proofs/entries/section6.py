"""Section 6, Eqs. 16-27: profiles, and convergence of points and lines."""

from ..entry import Entry
from ..theorems import exponential_sums, products, profile_limits

ENTRIES = (
    Entry(
        number="18",
        title="for jitter the profile is a bound: γ = 1, α = √3/π, b = 2, in any dimension",
        source="Section 6.1, Eq. 18, at jitter",
        status="corrected",
        holds=products.jitter_envelope_in_d().claim,
        proof=products.jitter_envelope_in_d,
        printed=profile_limits.AS_EQUALITY,
        as_printed="⟨P_S(ρn_k)⟩ = (γ_k/N) (ρ/(α_k N_k))^b_k for ρ < α_k N_k",
        refutation=profile_limits.below_its_monomial,
        notes="Jitter on an axis is strictly below its monomial, at N = 4, m = 1. From a bound "
        "only O(·) follows; rates need a bound from below too. x_i = m_i/n_i > 0; a coordinate 0 "
        "has sinc² = 1 and drops out.",
    ),
    Entry(
        number="LHS",
        title="the exact spectrum of a Latin hypercube, for every N and dimension",
        source="Section 6.2, Latin hypercube sampling",
        status="proved",
        holds=exponential_sums.latin_hypercube().claim,
        proof=exponential_sums.latin_hypercube,
        notes="On the frequencies none of whose coordinates is a multiple of N; on all others: "
        "kernel, Latin hypercube.",
    ),
)
