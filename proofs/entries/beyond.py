"""Beyond the paper: the rate of a region, two-sided, with its logarithm, and its constant."""

from functools import partial

from ..entry import Entry
from ..model import NOTE
from ..theorems import radial

_SOURCE = "Eqs. 16-18, one region, s for d"


def _rate(case: radial.Case, title: str) -> Entry:
    return Entry(
        number=f"rate, {case}",
        title=title,
        source=_SOURCE,
        status="proved",
        holds=radial.rate(case).claim,
        proof=partial(radial.rate, case),
        notes=NOTE.strip(),
    )


def _order(case: radial.Case, title: str) -> Entry:
    return Entry(
        number=f"order, {case}",
        title=title,
        source=_SOURCE,
        status="proved",
        holds=radial.order(case).claim,
        proof=partial(radial.order, case),
        notes=NOTE.strip(),
    )


ENTRIES = (
    _rate("b>q", "V N^(1+eq) → γ α^−q c₂ b/(q (b − q))"),
    _rate("b=q", "V N^(1+eb)/log N → γ α^−b c₂ e"),
    _rate("b<q", "V N^(1+eb) → γ α^−b [c ρ0^(s+b)/(s+b) + c₂ ρ0^(b−q)/(q − b)]"),
    _order("b>q", "V = Θ(N^−(1+eq))"),
    _order("b=q", "V = Θ(N^−(1+eb) log N)"),
    _order("b<q", "V = Θ(N^−(1+eb))"),
)
