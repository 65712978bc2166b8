"""Sections 6.3, 7.2 and 8, Eqs. 27-29: lines, several directions, and segments."""

from collections.abc import Callable
from functools import partial

from ...theory.symbolic import Expr, sympy
from ..entry import Entry, proved
from ..model import IN_MODEL
from ..theorems import best_case, directions, flats, point_rates, radial, segments, sphere_means
from ..theorems.flats import FLATS, SCALES, d, k
from ..theorems.radial import b
from ..theorems.segments import u
from ..theorems.tactics import ONE
from ..trusted.claims import Claim
from ..trusted.kernel import Step

_Proof = Callable[[], Step]
_TWO, _HALF = sympy.Integer(2), ONE / 2
_IN_SPACE = (Claim(_TWO, "<=", d),)
_LINES, _TEXT = "Section 6.3, Eq. 27, first row", "Section 7.2"
_ROW = "Var < O(N^(−d/(d−1)))"


def _corrected(
    number: str, title: str, source: str, proof: _Proof,
    refutation: _Proof, printed: Claim, as_printed: str, notes: str,
) -> Entry:  # fmt: skip
    holds = proof().claim
    return Entry(
        number, title, source, "corrected", holds, proof, printed, as_printed, refutation, notes
    )


def _lines(case: radial.Case, power: Expr) -> _Proof:
    return partial(flats.order, case, d - 1, ONE, _IN_SPACE, power)


def _flats(case: radial.Case, power: Expr) -> _Proof:
    return partial(flats.order, case, d - k, k + 1, FLATS, 1 + power / (d - k))


def _segments(case: radial.Case, power: Expr) -> _Proof:
    return partial(flats.order, case, d, _TWO, _IN_SPACE, 1 + power / d)


_SLOW = flats.worst_case("b<q", (*SCALES, *_IN_SPACE))
_TIE = flats.worst_case("b=q", (*SCALES[1:], *_IN_SPACE))
_THREE_HALVES, _SLOPE = -sympy.Rational(3, 2), -sympy.Rational(285, 100)
_DISK, _SPHERE = (
    flats.curved("Theta", power, body) for power, body in ((_SLOPE, 2), (_THREE_HALVES, 3))
)
_AT_HALF, _AT_1 = (flats.numbers(2, degree, ONE, d=3) for degree in (_HALF, ONE))
_ON_DISK, _ON_SPHERE = (flats.numbers(s, _TWO, _TWO) for s in (1, 2))
_SINC, _NORMALISED = sympy.sin(u) / u, sympy.sin(sympy.pi * u) / (sympy.pi * u)
_POINTS = tuple(c for c in SCALES if c.right != b)

_RATES = (
    proved(
        "27, worst case, b > 1", f"lines and a jump, {IN_MODEL}: V = Θ(N^(−d/(d−1)))", _LINES,
        _lines("b>q", d / (d - 1)),
        "As printed, and from below too, where b > 1. It is the rate of points in d − 1 "
        "dimensions, and not, as the text has it, in the d-dimensional domain. A jump that lines "
        "leave has q = 1: no entry proves a decay after lines.",
    ),
    _corrected(
        "27, worst case, b < 1", f"lines and a jump, {IN_MODEL}: V = Θ(N^(−1−b/(d−1)))", _LINES,
        _lines("b<q", 1 + b / (d - 1)),
        partial(flats.denied, _SLOW, "b<q", _THREE_HALVES, *_AT_HALF), _SLOW, _ROW,
        "0 < b < 1. The row ignores b: at d = 3, b = 1/2 the order is N^(−5/4), above N^(−3/2).",
    ),
    _corrected(
        "27, worst case, b = 0", f"lines of a flat profile, {IN_MODEL}: V = Θ(N^−1)", _LINES,
        point_rates.flat_order, point_rates.flat_lines_are_slower, point_rates.FLAT_LINES, _ROW,
        "Poisson disks have b = 0. At d = 2 the row says N^−2. The second row is right at b = 0.",
    ),
    _corrected(
        "27, worst case, b = 1", f"lines and a jump, {IN_MODEL}: V = Θ(N^(−d/(d−1)) log N)", _LINES,
        _lines("b=q", d / (d - 1)),
        partial(flats.denied, _TIE, "b=q", _THREE_HALVES, *_AT_1), _TIE, _ROW,
        "At b = q = 1 a logarithm appears.",
    ),
    proved(
        "27, best case",
        f"lines and a smooth integrand, {IN_MODEL}: V = Θ(N^(−(b+d−1)/(d−1)))",
        "Section 6.3, Eq. 27, second row", best_case.best_order_of_lines,
        "As printed, b > 0, and from below too.",
    ),
    _corrected(
        "7.2, disk", f"lines through a disk, b = 2, {IN_MODEL}: V = Θ(N^−3 log N)", _TEXT,
        partial(flats.order, "b=q", ONE, _TWO, _POINTS, sympy.Integer(3)),
        partial(flats.denied, _DISK, "b=q", _SLOPE, *_ON_DISK), _DISK,
        "multi-jitter line samples exhibit an improved convergence rate of O(N^−2.85)",
        "Read as a rate. On one dimension the disk keeps ρ^−3, which is not proved here: q = 2 = "
        "b; −2.85 is a local slope of N^−3 log N. Of jitter itself and |f^(m)|² = m^−3: Table 1, "
        "tie.",
    ),
    _corrected(
        "7.2, sphere", f"lines through a ball, b = 2, {IN_MODEL}: V = Θ(N^−2 log N)", _TEXT,
        partial(flats.order, "b=q", _TWO, _TWO, _POINTS, _TWO),
        partial(flats.denied, _SPHERE, "b=q", _THREE_HALVES, *_ON_SPHERE), _SPHERE,
        "a binary sphere function in 3D ... worst case; Var < O(N^(−d/(d−1))) worst-case",
        "Read as a rate, N^(−3/2). Lines integrate the jump away: on two dimensions the ball keeps "
        "ρ^−4, which is not proved here, q = 2; the ball is no worst case of lines.",
    ),
)  # fmt: skip

_DIRECTIONS = (
    proved(
        "7.2, n-rooks lines", "in the plane n-rooks offsets are jittered offsets",
        "Fig. 6, caption", directions.rooks_are_jitter,
    ),
    _corrected(
        "7.2, n-rooks", "n-rooks lines in the plane and a wave: V = Θ(N^−3)", _TEXT,
        directions.parallel_order, directions.rooks_denied, directions.ROOKS,
        "N-rooks, however, give a convergence rate of O(N^−1) in 2D and 3D",
        "Read as a rate. Of the sampler itself. Offsets of lines in the plane have one dimension; "
        "1/N holds for 2D points and 3D lines.",
    ),
    _corrected(
        "footnote 4", "two directions of fixed weights: the worse of the two rates",
        "Section 6.3, footnote 4", directions.fixed_weights, directions.better_of_two,
        directions.WORSE_OF_TWO,
        "their variance is additive, and therefore the convergence rate will be the worse of the "
        "two",
        "Read as a rate, of all weights. With weights by inverse variance, which depend on N, it "
        "is the better of the two.",
    ),
    proved(
        "weights", "no weights do better than V₁V₂/(V₁ + V₂)", "Section 6.3, footnote 4",
        directions.inverse_variance,
    ),
    proved(
        "equal shares", "two directions of one rate are not better than one",
        "Section 7.2, multi-directional line sampling", directions.equal_shares,
        "N/2 lines in each give 2^(a−1) times the variance of N in one direction.",
    ),
    proved(
        "random directions", "the spectrum of jittered lines of two random directions",
        "Section 7.2, footnote 5", directions.marks,
    ),
    _corrected(
        "footnote 5", "lines of random directions: Θ(1/N), whatever their offsets",
        "Section 7.2, footnote 5", directions.random_directions_order,
        directions.footnote_5_denied, directions.FOOTNOTE_5,
        "Our analysis is equally valid for randomly oriented line samples",
        "Directions drawn independently add their own variance over N.",
    ),
)  # fmt: skip

_SEGMENTS = (
    _corrected(
        "28", "the Fourier transform of a segment is sin(πlu)/(πu), u = ν·l^∥", "Section 8, Eq. 28",
        segments.segment_transform,
        partial(segments.unscaled_is_wrong, segments.segment_transform(), _SINC),
        segments.unscaled(segments.segment_transform().claim, _SINC), "l Sinc(ν·l^∥)",
        "The argument lacks π and the length; 1/l normalises; l^⊥ must be the midpoint.",
    ),
    _corrected(
        "28, normalised", "the same where Sinc(x) is read as sin(πx)/(πx)", "Section 8, Eq. 28",
        segments.segment_transform,
        partial(segments.unscaled_is_wrong, segments.segment_transform(), _NORMALISED),
        segments.unscaled(segments.segment_transform().claim, _NORMALISED), "l Sinc(ν·l^∥)",
        "The argument lacks the length.",
    ),
    _corrected(
        "29", "a segment samples the wave times l sinc(lu) at its midpoint", "Section 8, Eq. 29",
        segments.segment_of_a_wave,
        partial(segments.unscaled_is_wrong, segments.segment_of_a_wave(), _SINC),
        segments.unscaled(segments.segment_of_a_wave().claim, _SINC), "f̃ = l Sinc(ν·l^∥) F_f",
        "As for Eq. 28.",
    ),
    _corrected(
        "segments of length 1", "on the torus they reduce the dimension, as lines", "Section 8",
        segments.unit_segment, segments.unit_segment_reduces, segments.KEEPS_SOMETHING,
        "there is no dimensionality reduction on integration along the line segments",
        "At l = 1 nothing is kept of waves along the segment; shorter ones keep sinc(lu).",
    ),
    proved(
        "line", "a closed line keeps nothing of the waves along itself", "Section 5, Eq. 12",
        segments.line_of_a_wave,
    ),
    proved(
        "segments, mean", "the mean of sinc²(lρt) over the sphere, d = 3: at most 2/(πlρ)",
        "Section 8", segments.sphere_mean,
        "t, the cosine to the segment, is uniform for d = 3 alone. One power of ρ more: a decay "
        "ρ^(−d−1) becomes ρ^(−d−2), q = 2.",
    ),
    proved(
        "segments, mean in d dimensions",
        "the mean over the sphere: ∫ cos^(d−2) θ sinc²(lρ sin θ) dθ <= 4/(πlρ), θ < π/2, d >= 2",
        "Section 8", sphere_means.in_every_dimension,
        "cos^(d−2) θ is in proportion to the density of the latitude θ over the plane across the "
        "segment; its integral is free of ρ. One power of ρ more for isotropic spectra, q = 2.",
    ),
)  # fmt: skip

ENTRIES = (*_RATES, *_DIRECTIONS, *_SEGMENTS)


def _beyond(
    what: str, section: str, notes: str, *proofs: tuple[radial.Case, str, _Proof]
) -> tuple[Entry, ...]:
    return tuple(
        proved(
            f"{what}, {case}",
            f"{what} of a curved body, {IN_MODEL}: V = Θ({order})",
            section,
            proof,
            notes,
        )
        for case, order, proof in proofs
    )


BEYOND = (
    *_beyond(
        "flats", "beyond Section 6.3",
        "q = k + 1 on d − k dimensions, if the body decays as ρ^(−d−1), which is not proved here; "
        "k = 0 are points.",
        ("b>q", "N^(−1−(k+1)/(d−k))", _flats("b>q", k + 1)),
        ("b=q", "N^(−1−(k+1)/(d−k)) log N", _flats("b=q", k + 1)),
        ("b<q", "N^(−1−b/(d−k))", _flats("b<q", b)),
    ),
    *_beyond(
        "segments", "beyond Section 8",
        "q = 2 on d >= 2 dimensions, against 1 of points: by the mean of sinc² (segments, mean in "
        "d dimensions), if the body decays as ρ^(−d−1), which is not proved here.",
        ("b>q", "N^(−1−2/d)", _segments("b>q", _TWO)),
        ("b=q", "N^(−1−2/d) log N", _segments("b=q", _TWO)),
        ("b<q", "N^(−1−b/d)", _segments("b<q", b)),
    ),
)  # fmt: skip
