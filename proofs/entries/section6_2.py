"""Section 6.2, Eqs. 19-26 and Table 1: Latin hypercubes, multi-jitter, uncorrelated jitter."""

from collections.abc import Callable
from functools import partial

from ...theory.symbolic import sympy
from .. import (
    axis_terms,
    classes,
    lattice_powers,
    lattice_rates,
    multi_jitter_bounds,
    plateaus,
    point_rates,
    regional_sums,
)
from ..entry import Entry
from ..kernel import Step

_AXIS = "Section 6.2, Latin hypercube sampling"
_WORST, _BEST = (axis_terms.axis_worst(),), (axis_terms.axis_best(),)
_THREE = sympy.Integer(3)

_JITTERS = "Section 6.2, multi-jitter and uncorrelated jitter"
_MULTI = (
    "a, b are the frequencies, both above 0; the spectrum is that of Chiu, Shirley, Wang (1994)."
)


def _rate(
    number: str, title: str, proof: Callable[[], Step], as_printed: str, notes: str = ""
) -> Entry:
    """A rate in the model of Eqs. 16-18, printed as a bound, proved two-sided."""
    source = f"Section 6.2, {number.partition(',')[0]}, in Eq. 17"
    return _true(number, title, proof, as_printed, notes, source)


def _true(
    number: str,
    title: str,
    proof: Callable[[], Step],
    as_printed: str = "",
    notes: str = "",
    source: str = _JITTERS,
) -> Entry:
    """What holds as printed."""
    return Entry(
        number=number,
        title=title,
        source=source,
        status="proved",
        holds=proof().claim,
        proof=proof,
        as_printed=as_printed,
        notes=notes,
    )


def _both(
    name: str, p: int, order: str, proof: Callable[[], tuple[Step, Step]], as_printed: str
) -> tuple[Entry, Entry]:
    """Table 1 at d = 1 of jitter itself, from both sides and for every N."""
    sides = ((0, "from below"), (1, "from above"))
    low, high = (
        _true(
            f"Table 1, {name}, {side}",
            f"|f^(m)|² = m^−{p} under jitter in 1D: {order}",
            lambda place=place: proof()[place],
            as_printed,
            "Of jitter itself, for every N >= 1.",
            "Table 1",
        )
        for place, side in sides
    )
    return low, high


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
        notes="The second integral begins at αN; from 0 it diverges.",
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
        notes="With c_f on both rows and ρ0 = 3, d = 1, N = 4 it is 14/64, the bound 8/64.",
    ),
    Entry(
        number="21",
        title="worst case along an axis, with the Jacobian ρ^(d−1): Θ(N^−2)",
        source=f"{_AXIS}, Eq. 21",
        status="proved",
        holds=regional_sums.order(_WORST, regional_sums.TWO).claim,
        proof=partial(regional_sums.order, _WORST, regional_sums.TWO),
        as_printed="Var < O(N^−2)",
        notes="O is an equality of orders, and no inequality stands before it.",
    ),
    Entry(
        number="21, of a disk",
        title="on a true axis a disk gives Θ(N^−3 log N)",
        source=f"{_AXIS}, Eqs. 19-21 and 24",
        status="corrected",
        holds=axis_terms.disk_on_an_axis().claim,
        proof=axis_terms.disk_on_an_axis,
        printed=axis_terms.EQ_21_DISK,
        as_printed="the worst case along an axis is of order N^−2",
        refutation=axis_terms.not_the_rate_of_a_disk,
        notes="An axis has no Jacobian: s = 1, q = 2 for a disk. N^−2 needs a jump across it.",
    ),
    Entry(
        number="22",
        title="best case along an axis in closed form",
        source=f"{_AXIS}, Eq. 22",
        status="proved",
        holds=axis_terms.axis_best().closed.claim,
        proof=lambda: axis_terms.axis_best().closed,
        as_printed="∫_0^ρ0 ρ^(d−1) (γ/N) (ρ/(αN))² c_f dρ",
        notes="Equal to the variance where ρ0 <= αN, and above it before.",
    ),
    Entry(
        number="23",
        title="best case along an axis: Θ(N^−3)",
        source=f"{_AXIS}, Eq. 23",
        status="proved",
        holds=regional_sums.order(_BEST, _THREE).claim,
        proof=partial(regional_sums.order, _BEST, _THREE),
        as_printed="Var < O(N^−3)",
    ),
    _rate(
        "24, worst case",
        "Latin hypercube: Θ(N^−1), the flat rest decides",
        partial(point_rates.eq_24, True),
        "O(N^−2) + O(N^−1)",
        "The fast class are the d axes, that is all additive functions; not d − 1 hyper-planes.",
    ),
    _rate(
        "24, best case",
        "Latin hypercube: Θ(N^−1), the flat rest decides",
        partial(point_rates.eq_24, False),
        "O(N^−3) + O(N^−1)",
    ),
    Entry(
        number="24, the flat rest",
        title="Latin hypercube on w axes at once: |N P_S − 1| <= (N − 1)^(1 − w)",
        source=_AXIS,
        status="corrected",
        holds=plateaus.lhs_flat_across().claim,
        proof=plateaus.lhs_flat_across,
        printed=plateaus.FLAT,
        as_printed="the rest of the power spectrum exhibits flat radial behaviour",
        refutation=plateaus.not_flat,
        notes="Flat in the limit; in 2D it lies above random sampling, 1 + 16/π⁴ at N = 2, (1, 1).",
    ),
    _true(
        "24, a wave across axes",
        "cos 2πx cos 2πy under a Latin hypercube: 1/(4N) <= Var <= 1/(2N)",
        plateaus.wave_across,
        "in general not better than O(N^−1)",
    ),
    _true(
        "24, a wave along an axis",
        "cos 2πmx under a Latin hypercube: Θ(N^−3)",
        plateaus.wave_along,
        "integrands that vary only along one of the dimensions converge much faster",
        "By addition the same holds of every sum of such waves on several axes.",
    ),
    _true(
        "24, the faster slope first",
        "A/N³ + B/N <= 2A/N³ while B N² <= A",
        partial(classes.two_slopes, True),
        "the estimator may initially follow the slope of the faster convergence rate",
    ),
    _true(
        "24, the slower slope last",
        "A/N³ + B/N <= 2B/N once A <= B N²",
        partial(classes.two_slopes, False),
        "with increasing samples the slower convergence rate will dominate",
    ),
    _rate(
        "25, worst case",
        "multi-jitter: Θ(N^(−1−1/d)), d > 1",
        partial(point_rates.eq_25, True),
        "O(N^−2) + O(N^(−1−1/d))",
    ),
    _rate(
        "25, best case",
        "multi-jitter: Θ(N^(−1−2/d)), d > 1",
        partial(point_rates.eq_25, False),
        "O(N^−3) + O(N^(−1−2/d))",
    ),
    _true(
        "25, from below",
        "multi-jitter off its axes is at least Y/(8 (1 + Y)), Y = (π²/3)|m|²/N, d = 2",
        multi_jitter_bounds.multi_jitter_from_below,
        "radial behaviour of jittered samples in all directions",
        _MULTI,
    ),
    _true(
        "25, from above",
        "multi-jitter off its axes is at most 2Y, N_k = √N, d = 2",
        multi_jitter_bounds.multi_jitter_from_above,
        "across all other directions N_k = N^(1/d)",
        _MULTI,
    ),
    _true(
        "25, plateau",
        "multi-jitter is at most n/(n − 1) times random sampling, N = n²",
        multi_jitter_bounds.multi_jitter_plateau,
        "P_S = γ/N",
        _MULTI,
    ),
    _true(
        "25, a wave across axes",
        "cos 2πx cos 2πy under multi-jitter: Θ(N^−2), N = n²",
        multi_jitter_bounds.wave_order,
        "O(N^(−1−2/d)) in the best case",
        _MULTI,
    ),
    Entry(
        number="25, correlated multi-jitter",
        title="with shuffles in common the same wave has O(N^−3), not Θ(N^−2), N = n²",
        source=_JITTERS,
        status="corrected",
        holds=multi_jitter_bounds.correlated_wave().claim,
        proof=multi_jitter_bounds.correlated_wave,
        printed=multi_jitter_bounds.CORRELATED_AS_A_RATE,
        as_printed="the best case of multi-jitter is of order N^(−1−2/d)",
        refutation=multi_jitter_bounds.not_the_rate_of_the_correlated,
        notes="True of Chiu, Shirley, Wang (1994); not of Kensler (2013), whose off-axis power is "
        "O(N^−2) at fixed frequencies.",
    ),
    _rate(
        "26, worst case",
        "uncorrelated jitter: Θ(N^−1), what lies between the blocks decides",
        partial(point_rates.eq_26, True),
        "O(N^−2) + O(N^−1.5) + O(N^(−1−1/(d−3))) + O(N^−1)",
        "k = d − 3 > 0: printed for d >= 4 alone.",
    ),
    _rate(
        "26, best case",
        "uncorrelated jitter: Θ(N^−1), what lies between the blocks decides",
        partial(point_rates.eq_26, False),
        "O(N^−3) + O(N^−2) + O(N^(−1−2/(d−3))) + O(N^−1)",
        "k = d − 3 > 0: printed for d >= 4 alone.",
    ),
    _rate(
        "26, one block in the worst case",
        "a block of k axes by itself: Θ(N^(−1−1/k))",
        partial(point_rates.block, True, point_rates.k),
        "O(N^−2), O(N^−1.5), O(N^(−1−1/(d−3)))",
        "For a block whose function jumps. A ball in d dimensions has q = d + 1 − k on the block.",
    ),
    _rate(
        "26, one block in the best case",
        "a block of k axes by itself: Θ(N^(−1−2/k))",
        partial(point_rates.block, False, point_rates.k),
        "O(N^−3), O(N^−2), O(N^(−1−2/(d−3)))",
    ),
    _true(
        "26, between the blocks",
        "on w blocks at once |N P_S − 1| <= (N − 1)^(1 − w), a(i) = ∏ sinc² of block i",
        plateaus.flat_across,
        "in-between these subspaces we will fall back to O(N^−1)",
    ),
    _rate(
        "6.2, an ellipse, worst case",
        "two values of α: the constant changes, the rate does not",
        partial(point_rates.ellipse, True),
        "would not affect the asymptotic convergence rate in any direction",
    ),
    _rate(
        "6.2, an ellipse, best case",
        "two values of α: the constant changes, the rate does not",
        partial(point_rates.ellipse, False),
        "would not affect the asymptotic convergence rate in any direction",
    ),
    Entry(
        number="6.2, projective blue noise",
        title="a flat profile has the rate 1 however large N_k is",
        source="Section 6.2, anisotropic blue noise samplers",
        status="corrected",
        holds=point_rates.flat_order().claim,
        proof=point_rates.flat_order,
        printed=point_rates.PROJECTIVE,
        as_printed="denser projections highly improve the convergence rate",
        refutation=point_rates.no_faster,
        notes="Poisson disks have b = 0, and N_k^0 = 1: denser projections change constants only.",
    ),
    _rate(
        "Table 1, worst case",
        "jitter: Θ(N^(−1−1/d))",
        partial(point_rates.table_1, True),
        "O(N^(−1−1/d)): N^−2, N^−1.5, N^(−4/3)",
    ),
    _rate(
        "Table 1, best case",
        "jitter: Θ(N^(−1−2/d))",
        partial(point_rates.table_1, False),
        "N^−3, N^−2, N^(−5/3)",
        "The label O(N^(−1−2/d)) of this row is missing.",
    ),
    _true(
        "Table 1, a wave",
        "cos 2πm·x under jitter in n dimensions: Θ(N^(−1−2/n)), N = s^n",
        lattice_rates.wave,
        "best case",
        "Of jitter itself, with bounds for every s >= 1; m_i > 0, a coordinate 0 drops out.",
    ),
    *_both("jump", 2, "Θ(N^−2)", lattice_powers.jump, "worst case, d = 1"),
    *_both("kink", 4, "Θ(N^−3)", lattice_powers.kink, "best case, d = 1"),
    *_both("tie, b = q = 2", 3, "Θ(N^−3 log N)", lattice_powers.tie, ""),
)
