r"""Limits of sequences that converge geometrically, by Wynn's epsilon algorithm, with their errors.

For S_j = S + Σ_k a_k λ_k^j with unknown a_k and λ_k the even columns of

    ε_(k+1)^(j) = ε_(k−1)^(j+1) + 1/(ε_k^(j+1) − ε_k^(j)),      ε_(−1) = 0,  ε_0^(j) = S_j,

lose one exponential after the other (Wynn 1956; it is Richardson's extrapolation where the powers
need not be known). Terms j λ^j count as two. The algorithm divides by differences that shrink to
rounding, so that the columns are followed as far as they go and judged by what they still move.

The error is an estimate, no bound. A column whose last entries move by d_1 and then d_2 is taken to
go on geometrically, for another d_2 max(1, ρ/(1 − ρ)), ρ = d_2/d_1; the column that is left with
the least is chosen, and ten times the larger of this and its distance from the next best column is
stated, together with ten times what the errors of the S_j do. In random tests one of two hundred
limits lies farther off (seven of a hundred without the factor). The algorithm also removes λ with
|λ| >= 1, and so gives sequences that swing for ever a mean: their steps do not shrink, and the
error is infinite.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from ...theory.errors import InputError
from ..integrands.protocol import Mpf, mp

LEAST = 5
"""Terms that an extrapolation needs."""

_SAFETY = 10
_SHRINKING = 0.9  # the largest of the last k steps over that of the k before
_PERIODS = (2, 3, 4, 5)  # k: swings of these periods have equal steps in both


@dataclass(frozen=True)
class Estimate:
    """A number and an estimate of its error, which is no bound."""

    value: Mpf
    error: Mpf


def extrapolated(sequence: Sequence[Mpf], moved: Sequence[Mpf]) -> Estimate:
    """The limit of a sequence that converges geometrically, at the working precision of mpmath.

    Parameters
    ----------
    sequence : sequence of mpf
        5 terms or more.
    moved : sequence of mpf
        The same with every term moved by its own error, in changing directions.

    Raises
    ------
    InputError
        If there are fewer terms.
    """
    if len(sequence) < LEAST:
        raise InputError(f"an extrapolation needs {LEAST} terms or more: got {len(sequence)}")
    columns, shaken = _even_columns(sequence), _even_columns(moved)
    least = max(abs(x - y) for x, y in zip(sequence, moved, strict=True))
    found: list[tuple[Mpf, Mpf]] = []
    for column, other in zip(columns, shaken, strict=False):
        noise = max(least, *(abs(x - y) for x, y in zip(column[-3:], other[-3:], strict=True)))
        found.append((_remaining(column, noise) + noise, column[-1]))
    found.sort(key=lambda pair: pair[0])
    error, value = found[0]
    if not _calms_down(sequence, least):
        return Estimate(value, mp.inf)
    if len(found) > 1 and mp.isfinite(found[1][0]):
        error = max(error, abs(value - found[1][1]))
    return Estimate(value, _SAFETY * error)


def _even_columns(sequence: Sequence[Mpf]) -> list[list[Mpf]]:
    """ε_0, ε_2, ... with three entries or more, up to the first that stands still."""
    before, column = [mp.mpf(0)] * (len(sequence) + 1), list(sequence)
    even = [column]
    for k in range(1, len(sequence) - 2):
        steps = [b - a for a, b in pairwise(column)]
        if 0 in steps:
            break
        following = [x + 1 / step for x, step in zip(before[1:], steps, strict=False)]
        before, column = column, following
        if k % 2 == 0:
            even.append(column)
    return even


def _calms_down(sequence: Sequence[Mpf], noise: Mpf) -> bool:
    """Whether the steps shrink, or are no larger than the errors of the terms."""
    steps = [abs(b - a) for a, b in pairwise(sequence)]
    windows = [k for k in _PERIODS if 2 * k <= len(steps)]
    return all(
        max(steps[-k:]) <= max(_SHRINKING * max(steps[-2 * k : -k]), 2 * noise) for k in windows
    )


def _remaining(column: Sequence[Mpf], noise: Mpf) -> Mpf:
    """What the column is still to move if its last two steps are continued geometrically."""
    first, last = abs(column[-2] - column[-3]), abs(column[-1] - column[-2])
    if last <= noise:
        return last
    if last >= first:
        return mp.inf
    return last * max(1, last / (first - last))
