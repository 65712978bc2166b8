"""Appendix A, Eqs. 30-36: jittered points and lines, normalised, and the monomial below them."""

from functools import partial

from ...theory.symbolic import Expr
from ..entry import Entry, proved
from ..theorems import appendix_spectra as spectra
from ..theorems.appendix_spectra import N, d
from ..theorems.tactics import ONE

_SCALE = (
    "The argument must be m_i/n_i, m_i/N^(1/d) for equal strata: at whole frequencies the printed "
    "row is white noise. Denied as 5, on an axis, at N = 2, m = 1. Appendix A normalises the "
    "frequencies ν_i with N^(1/d) just before; with ν_i read so, the row holds for equal strata."
)
_BOUND = (
    "A bound, and no equality, denied alike in 33, 34 and 36; γ = 1, α = √3/π, b = 2. The range is "
    "one of ρ."
)
_LOW = "A rate needs the bound from below."


def _spectrum(number: str, title: str, scale: Expr, as_printed: str) -> Entry:
    """N P_S times ``scale``."""
    proof, whole = partial(spectra.jitter, scale), scale * N
    return Entry(
        number=number,
        title=title,
        source=f"Appendix A.1, Eq. {number}",
        status="corrected",
        holds=proof().claim,
        proof=proof,
        printed=spectra.unscaled(whole),
        as_printed=as_printed,
        refutation=partial(spectra.unscaled_denied, whole),
        notes=_SCALE,
    )


def _profile(
    number: str, title: str, section: str, dimension: Expr, scale: Expr, as_printed: str
) -> Entry:
    proof = partial(spectra.monomial, dimension, scale)
    return Entry(
        number=number,
        title=title,
        source=f"Appendix {section}, Eq. {number}",
        status="corrected",
        holds=proof().claim,
        proof=proof,
        printed=spectra.equality(scale),
        as_printed=as_printed,
        refutation=partial(spectra.equality_denied, scale),
        notes=_BOUND,
    )


ENTRIES = (
    _spectrum(
        "30", "jitter, unnormalised: N (1 − ∏ sinc²(m_i/n_i))", N,
        "⟨P_S⟩ = N (1 − ∏ Sinc(πν_i)²)",
    ),
    proved(
        "30, DC component", "at frequency 0 it is N²", "Appendix A.1, Eq. 30",
        partial(spectra.all_points_at_0, ONE),
    ),
    _spectrum(
        "31", "jitter, normalised: (1/N) (1 − ∏ sinc²(m_i/n_i))", 1 / N,
        "⟨P_S⟩ = (1/N) (1 − ∏ Sinc(πν_i)²)",
    ),
    proved(
        "31, DC component", "at frequency 0 it is 1", "Appendix A.1, Eq. 31",
        partial(spectra.all_points_at_0, N**-2),
    ),
    _spectrum(
        "32", "jitter off frequency 0: N P_S = 1 − ∏ sinc²(m_i/n_i)", ONE,
        "⟨P_S⟩ = (1/N) (1 − ∏ Sinc(πν_i)²)",
    ),
    _profile(
        "33", "1 − ∏ sinc²(m_i/N^(1/d)) <= (π²/3) |m|²/N^(2/d)", "A.1", d, ONE,
        "= γ ρ^b/(α^b N^(b/d)) for ν < α N^(1/d)",
    ),
    _profile(
        "34", "the same over N, for points", "A.1", d, 1 / N,
        "P̆_S(ρ) = γ ρ^b/(α^b N^(b/d) N) for ν < α N^(1/d)",
    ),
    proved(
        "34, from below", "points: at least (1/N) Y/(1 + Y), Y = (π²/3) |m|²/N^(2/d)",
        "beyond Appendix A.1", partial(spectra.from_below, d, 1 / N), _LOW,
    ),
    Entry(
        number="35",
        title="jittered lines in the plane: (1/N) (1 − sinc²(m/N)), times 0 where ν·l^∥ ≠ 0",
        source="Appendix A.2, Eq. 35",
        status="corrected",
        holds=spectra.lines_in_the_plane().claim,
        proof=spectra.lines_in_the_plane,
        printed=spectra.WITHOUT_DELTA,
        as_printed="⟨P_L⟩ = (1/N) [1 − ∏^(d−1) Sinc(πν_i l_i^⊥)²]",
        refutation=spectra.without_delta_denied,
        notes="δ(ν·l^∥) is missing, and ν_i l_i^⊥ multiplies by a position: it is ν_i/N^(1/(d−1)).",
    ),
    proved(
        "35, off the hyperplane", "jittered lines have no power where ν·l^∥ ≠ 0",
        "Appendix A.2, Eq. 35", spectra.no_power_along_lines,
    ),
    _profile(
        "36", "the same over N, for lines: d − 1 for d", "A.2", d - 1, 1 / N,
        "P̆_L(ρ) = γ ρ^b/(α^b N^(b/(d−1)) N) for ρ < α N^(1/(d−1))",
    ),
    proved(
        "36, from below", "lines: at least (1/N) Y/(1 + Y), Y = (π²/3) |m|²/N^(2/(d−1))",
        "beyond Appendix A.2", partial(spectra.from_below, d - 1, 1 / N), _LOW,
    ),
)  # fmt: skip
