"""Section 6.2, Eqs. 24-26 and Table 1: Latin hypercubes, multi-jitter, uncorrelated jitter."""

from collections.abc import Callable
from functools import partial

from ..entry import Entry
from ..model import IN_MODEL
from ..theorems import (
    classes,
    lattice_powers,
    lattice_rates,
    multi_jitter_bounds,
    multi_jitter_spectra,
    plateaus,
    point_rates,
)
from ..trusted.kernel import Step

_AXIS = "Section 6.2, Latin hypercube sampling"
_JITTERS = "Section 6.2, multi-jitter and uncorrelated jitter"
_MULTI = (
    "a, b are the frequencies, both above 0; the spectrum is that of Chiu, Shirley, Wang (1994)."
)
_NO_BALL = "No entry proves the decay d + 1 of a ball for d >= 2, which q = 1 stands for."
_ITSELF_24 = "Of the sampler itself: 24, a wave across axes, and 24, a wave along an axis."
_ITSELF_25 = (
    "Of the sampler itself, d = 2: 25, on the axes, from below, from above, a wave across axes. "
    "Multi-jitter is of d = 2 in the paper's sense; for d > 2 orthogonal arrays of strength d can "
    "stand for it (kernel, multi-jitter)."
)
_ITSELF_26 = (
    "Of the sampler itself: 26, between the blocks. k = d − 3 > 0: printed for d >= 4 alone; equal "
    "strata need N to be a square and a (d − 3)-th power at once."
)


def _rate(
    number: str, title: str, proof: Callable[[], Step], as_printed: str, notes: str = ""
) -> Entry:
    """A rate in the model of Eqs. 16-18, printed as a bound, proved two-sided."""
    source = f"Section 6.2, {number.partition(',')[0]}, in Eq. 17"
    subject, what = title.split(":", 1)
    return _true(number, f"{subject}, {IN_MODEL}:{what}", proof, as_printed, notes, source)


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
    _rate(
        "24, worst case",
        "Latin hypercube: Θ(N^−1), the flat rest decides",
        partial(point_rates.eq_24, True),
        "O(N^−2) + O(N^−1)",
        "The fast class are the d axes, that is all additive functions; not d − 1 hyper-planes. "
        + _ITSELF_24,
    ),
    _rate(
        "24, best case",
        "Latin hypercube: Θ(N^−1), the flat rest decides",
        partial(point_rates.eq_24, False),
        "O(N^−3) + O(N^−1)",
        _ITSELF_24,
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
        "cos 2πx cos 2πy under a Latin hypercube: Θ(1/N)",
        plateaus.wave_across,
        "for most of the integrands ... would not be better than O(N^−1)",
        "Of the sampler itself, for every N >= 2; the proof passes through 1/(4N) <= Var <= "
        "1/(2N).",
    ),
    _true(
        "24, a wave along an axis",
        "cos 2πmx under a Latin hypercube: Θ(N^−3)",
        plateaus.wave_along,
        "Integrands that vary only along one of the dimensions ... converge much faster",
        "Of the sampler itself, for every N > 1. By addition the same holds of every sum of such "
        "waves on several axes.",
    ),
    _true(
        "24, the faster slope first",
        "A/N³ + B/N <= 2A/N³ while B N² <= A",
        partial(classes.two_slopes, True),
        "may initially follow the slope of the faster convergence rate",
    ),
    _true(
        "24, the slower slope last",
        "A/N³ + B/N <= 2B/N once A <= B N²",
        partial(classes.two_slopes, False),
        "with increasing samples the slower convergence rate will dominate any constant factors",
    ),
    _rate(
        "25, worst case",
        "multi-jitter: Θ(N^(−1−1/d)), d > 1",
        partial(point_rates.eq_25, True),
        "O(N^−2) + O(N^(−1−1/d))",
        _ITSELF_25,
    ),
    _rate(
        "25, best case",
        "multi-jitter: Θ(N^(−1−2/d)), d > 1",
        partial(point_rates.eq_25, False),
        "O(N^−3) + O(N^(−1−2/d))",
        _ITSELF_25,
    ),
    _true(
        "25, on the axes",
        "multi-jitter on an axis: N P_S = 1 − sinc²(m/N), as of a Latin hypercube, d = 2",
        multi_jitter_spectra.on_an_axis,
        "the effective number of samples along each dimension would be N_k = N",
        "Of m columns and n rows, N = m n, at (f, 0), f whole and not 0: the first terms of Eq. "
        "25.",
    ),
    _true(
        "25, from below",
        "multi-jitter off its axes is at least Y/(8 (1 + Y)), Y = (π²/3)|m|²/N, d = 2",
        multi_jitter_bounds.multi_jitter_from_below,
        "exhibits radial behaviour of jittered samples in all the directions",
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
        "γ_k/N otherwise",
        _MULTI,
    ),
    _true(
        "25, a wave across axes",
        "cos 2πx cos 2πy under multi-jitter: Θ(N^−2), N = n²",
        multi_jitter_bounds.wave_order,
        "O(N^−3) + O(N^(−1−2/d)) best-case",
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
        as_printed="O(N^−3) + O(N^(−1−2/d)) best-case",
        refutation=multi_jitter_bounds.not_the_rate_of_the_correlated,
        notes="Read as a rate. True of Chiu, Shirley, Wang (1994); not of Kensler (2013), whose "
        "power at fixed frequencies off the axes is O(N^−2).",
    ),
    Entry(
        number="25, a ridge of correlated multi-jitter",
        title="with shuffles in common N P_S >= n − 2π²/(3n) at (n, 1), N = n²: no plateau",
        source=_JITTERS,
        status="corrected",
        holds=multi_jitter_bounds.on_a_ridge().claim,
        proof=multi_jitter_bounds.on_a_ridge,
        printed=multi_jitter_bounds.BOUNDED_RIDGE,
        as_printed="exhibits radial behaviour of jittered samples in all the directions",
        refutation=multi_jitter_bounds.ridge_is_not_bounded,
        notes="True of Chiu, Shirley, Wang (1994): 25, plateau. Of Kensler (2013) no γ/N, γ free "
        "of N, is a bound off the axes: the power at (n, 1) is that of kernel, correlated "
        "multi-jitter, on a ridge.",
    ),
    _rate(
        "26, worst case",
        "uncorrelated jitter: Θ(N^−1), what lies between the blocks decides",
        partial(point_rates.eq_26, True),
        "O(N^−2) + O(N^−1.5) + O(N^(−1−1/(d−3))) + O(N^−1)",
        _ITSELF_26,
    ),
    _rate(
        "26, best case",
        "uncorrelated jitter: Θ(N^−1), what lies between the blocks decides",
        partial(point_rates.eq_26, False),
        "O(N^−3) + O(N^−2) + O(N^(−1−2/(d−3))) + O(N^−1)",
        _ITSELF_26,
    ),
    _rate(
        "26, one block in the worst case",
        "a block of k axes by itself: Θ(N^(−1−1/k))",
        partial(point_rates.block, True, point_rates.k),
        "1D O(N^−2), 2D O(N^−1.5), (d−3)D O(N^(−1−1/(d−3)))",
        "For a block whose function jumps. A ball that decays as ρ^(−d−1) has q = d + 1 − k on "
        "the block.",
    ),
    _rate(
        "26, one block in the best case",
        "a block of k axes by itself: Θ(N^(−1−2/k))",
        partial(point_rates.block, False, point_rates.k),
        "1D O(N^−3), 2D O(N^−2), (d−3)D O(N^(−1−2/(d−3)))",
        "Of jitter itself: Table 1, a wave.",
    ),
    _true(
        "26, between the blocks",
        "on w blocks at once |N P_S − 1| <= (N − 1)^(1 − w), a(i) = ∏ sinc² of block i",
        plateaus.flat_across,
        "varying in-between these subspaces, we will fall back to ... O(N^−1)",
        "Of the sampler itself, for every N >= 2.",
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
        title=f"a flat profile, {IN_MODEL}: the rate is 1 however large N_k is",
        source="Section 6.2, anisotropic blue noise samplers",
        status="corrected",
        holds=point_rates.flat_order().claim,
        proof=point_rates.flat_order,
        printed=point_rates.PROJECTIVE,
        as_printed="the convergence rate along that set of directions could be highly improved",
        refutation=point_rates.no_faster,
        notes="Poisson disks have b = 0, and N_k^0 = 1: denser projections change constants only.",
    ),
    _rate(
        "Table 1, worst case",
        "jitter: Θ(N^(−1−1/d))",
        partial(point_rates.table_1, True),
        "O(N^(−1−1/d)): O(N^−2), O(N^−1.5), O(N^(−4/3))",
        "Of jitter itself, d = 1: Table 1, jump. " + _NO_BALL,
    ),
    _rate(
        "Table 1, best case",
        "jitter: Θ(N^(−1−2/d))",
        partial(point_rates.table_1, False),
        "O(N^−3), O(N^−2), O(N^(−5/3))",
        "The label O(N^(−1−2/d)) of this row is missing. Of jitter itself: Table 1, a wave, kink.",
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
