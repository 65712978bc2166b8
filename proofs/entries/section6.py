"""Section 6, Eqs. 16-27: profiles, and convergence of points and lines."""

from .. import exponential_sums, products
from ..entry import Entry

ENTRIES = (
    Entry(
        number="18",
        title="for jitter the profile is a bound: γ = 1, α = √3/π, b = 2, in any dimension",
        source="Section 6.1, Eq. 18, at jitter",
        status="proved",
        holds=products.jitter_envelope_in_d().claim,
        proof=products.jitter_envelope_in_d,
        as_printed="P_S <= (γ/N) (ρ/(α N_k))^b below α N_k",
        notes="x_i = m_i/n_i > 0; a coordinate 0 has sinc² = 1 and drops out.",
    ),
    Entry(
        number="LHS",
        title="the exact spectrum of a Latin hypercube, for every N and dimension",
        source="Section 6.2, Latin hypercube sampling",
        status="proved",
        holds=exponential_sums.latin_hypercube().claim,
        proof=exponential_sums.latin_hypercube,
        notes="On the frequencies none of whose coordinates is a multiple of N.",
    ),
)
