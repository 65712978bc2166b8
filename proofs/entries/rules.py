"""Rules for spectra: padding, shear, averages over designs."""

from collections.abc import Callable

from ..entry import Entry, proved
from ..theorems import rules
from ..trusted.kernel import Step


def _rule(name: str, title: str, proof: Callable[[], Step], source: str, notes: str) -> Entry:
    return proved(f"rule, {name}", title, source, proof, notes)


ENTRIES = (
    _rule(
        "padding",
        "blocks joined in random order: P_S = 1/N + (1 − 1/N) ∏ q_B, q = (N P − 1)/(N − 1)",
        rules.padding,
        "Section 6.2, uncorrelated jitter",
        "For any two sets of N points, N² P = (Σ cos)² + (Σ sin)²; more blocks by repetition. "
        "Left: 1/N, and the mean over the pairs of different points of either set.",
    ),
    _rule(
        "shear",
        "P(m_1, m_2) of the points (x, y + c x mod 1) is P(m_1 + c m_2, m_2) of the points (x, y)",
        rules.shear,
        "beyond the paper",
        "c whole, w the whole turns that mod 1 takes away, r the phase in the other coordinates. "
        "Every integer matrix of determinant 1 is a product of shears.",
    ),
    _rule(
        "linearity",
        "the variance is linear in the spectrum: designs drawn with weights w_ω",
        rules.average,
        "Section 3, Eq. 4",
        "s_k is the power of f at m_k and −m_k.",
    ),
)
