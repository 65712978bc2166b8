"""Section 6.2, Eqs. 19-23: the worst and the best case of a Latin hypercube along an axis."""

from functools import partial

from ...theory.symbolic import sympy
from ..entry import Entry
from ..model import IN_MODEL, NOTE
from ..theorems import axis_terms, regional_sums

_AXIS = "Section 6.2, Latin hypercube sampling"
_WORST, _BEST = (axis_terms.axis_worst(),), (axis_terms.axis_best(),)
_THREE = sympy.Integer(3)

ENTRIES = (
    Entry(
        number="19",
        title="worst case along an axis, N_k = N: the integrals with their right ends",
        source=f"{_AXIS}, Eq. 19",
        status="corrected",
        holds=axis_terms.axis_worst().closed.claim,
        proof=lambda: axis_terms.axis_worst().closed,
        printed=axis_terms.FROM_0,
        as_printed="... + ∫_0^∞ ρ^(d−1) (γ/N) c_f ρ^(−d−1) dρ",
        refutation=axis_terms.diverges_from_0,
        notes=NOTE + "The second integral begins at αN; from 0 it diverges.",
    ),
    Entry(
        number="20",
        title="worst case along an axis: a bound where the rows of Eq. 16 meet",
        source=f"{_AXIS}, Eq. 20",
        status="corrected",
        holds=axis_terms.bound_where_rows_meet().claim,
        proof=axis_terms.bound_where_rows_meet,
        printed=axis_terms.EQ_20,
        as_printed="< c_f γ/(α²N³) ∫_0^(αN) dρ + (c_f γ/N) ∫_(αN)^∞ ρ^−2 dρ",
        refutation=axis_terms.exceeds_20,
        notes=NOTE + "With c_f on both rows and ρ0 = 3, d = 1, N = 4 it is 14/64, the bound 8/64.",
    ),
    Entry(
        number="21",
        title="worst case along an axis, with the Jacobian ρ^(d−1): Θ(N^−2)",
        source=f"{_AXIS}, Eq. 21",
        status="proved",
        holds=regional_sums.order(_WORST, regional_sums.TWO).claim,
        proof=partial(regional_sums.order, _WORST, regional_sums.TWO),
        as_printed="Var < O(N^−2)",
        notes=NOTE + "O is an equality of orders, and no inequality stands before it. Of jitter "
        "itself, d = 1: Table 1, jump.",
    ),
    Entry(
        number="21, of a disk",
        title=f"a disk on a true axis, {IN_MODEL}: Θ(N^−3 log N)",
        source=f"{_AXIS}, Eqs. 19-21 and 24",
        status="corrected",
        holds=axis_terms.disk_on_an_axis().claim,
        proof=axis_terms.disk_on_an_axis,
        printed=axis_terms.EQ_21_DISK,
        as_printed="Worst case along the canonical axes: ... < O(N^−2)",
        refutation=axis_terms.not_the_rate_of_a_disk,
        notes="Read as a rate of the disk, the worst case of Section 7. An axis has no Jacobian: "
        "s = 1, and the decay ρ^−3, which is not proved here, is q = 2. N^−2 needs a jump across "
        "it. Of jitter itself: Table 1, tie.",
    ),
    Entry(
        number="21, of a ball",
        title=f"a ball in d >= 3 dimensions on a true axis, {IN_MODEL}: Θ(N^−3)",
        source=f"{_AXIS}, Eqs. 19-21 and 24",
        status="corrected",
        holds=axis_terms.ball_on_an_axis().claim,
        proof=axis_terms.ball_on_an_axis,
        printed=axis_terms.EQ_21_BALL,
        as_printed="Worst case along the canonical axes: ... < O(N^−2)",
        refutation=axis_terms.not_the_rate_of_a_ball,
        notes="Read as a rate of the ball. Its decay ρ^(−d−1), which is not proved here, is "
        "ρ^(−1−q) with q = d > 2 on an axis, s = 1: the axis falls as in the best case.",
    ),
    Entry(
        number="22",
        title="best case along an axis in closed form",
        source=f"{_AXIS}, Eq. 22",
        status="proved",
        holds=axis_terms.axis_best().closed.claim,
        proof=lambda: axis_terms.axis_best().closed,
        as_printed="∫_0^ρ0 ρ^(d−1) (γ/N) (ρ/(αN))² c_f dρ",
        notes=NOTE + "Equal to the integral of Eq. 18 where ρ0 <= αN, and above it before.",
    ),
    Entry(
        number="23",
        title="best case along an axis: Θ(N^−3)",
        source=f"{_AXIS}, Eq. 23",
        status="proved",
        holds=regional_sums.order(_BEST, _THREE).claim,
        proof=partial(regional_sums.order, _BEST, _THREE),
        as_printed="Var < O(N^−3)",
        notes=NOTE + "Of a Latin hypercube itself: 24, a wave along an axis.",
    ),
)
