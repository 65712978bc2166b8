"""Multi-jitter: a jittered grid whose projections on the axes are 1D-stratified N-fold.

In 2D with m columns and n rows (Chiu, Shirley, Wang 1994), N = m n, A = sinc²(a/m),
A' = sinc²(a/N), B = sinc²(b/n), B' = sinc²(b/N), and with h_x = m² [a = 0] − m A,
k_x = (n A − A')/(n − 1) and likewise in y,

    N·P_S(a, b) = 1 + (h_x h_y + m k_x h_y + n k_y h_x)/N.

In d dimensions, d ≥ 2, an orthogonal array of strength d with s levels and 1D-stratified
substrata, N = s^d, r = N/s: two points that share a level on an axis have the characteristic
function K = (r A − A')/(r − 1) there, two that do not −A/(s − 1). Summing over pairs,

    N·P_S(m) = 1 + N ∏_i ([m_i = 0] + (K_i − A_i)/s) − ∏_i K_i,

which for d = 2 is the formula above with m = n. The paper's "multi-jitter in d dimensions"
(Eq. 25) is read as this; in one dimension it is jitter with N strata.
"""

from collections.abc import Mapping

from ..errors import InputError
from ..kernels import Alphabet, Factor
from ..layouts import Growth, Layout, grouped
from ..signs import Assumptions
from ..strata import Strata, nearest_root, parse_strata
from ..symbolic import Expr, FracElement, Integer
from .definition import Sampler
from .stratified import Counts

REFERENCE = "Chiu, Shirley, Wang 1994; Owen 1992, Tang 1993 (orthogonal arrays)"


def multi_jitter(argument: str, dim: Expr, assumptions: Assumptions) -> Sampler:
    """``multi-jitter``; in 2D also ``multi-jitter:8x16``."""
    if argument:
        if dim != 2:
            raise InputError(f"multi-jitter:{argument} is for --dim 2: got {dim}")
        return _rectangular(parse_strata(argument, 2), argument, assumptions)
    if dim == 1:
        return _one_dimensional(assumptions)
    alphabet = Alphabet(("N", "s"))
    n, s = alphabet.count("N"), alphabet.count("s")
    shared = shared_stratum(alphabet, s, n)
    differs = alphabet.zero() + (shared - alphabet.sinc2(s)).scaled(1 / s)
    kernel = alphabet.constant() + alphabet.over(0, differs).scaled(n) - alphabet.over(0, shared)
    growth = {"N": Growth(Integer(1)), "s": Growth(1 / dim)}
    layout = Layout(grouped((dim,)), growth, assumptions)
    counts = _equal_counts(int(dim)) if dim.is_Integer else None
    return Sampler("multi-jitter", "multi-jitter", layout, kernel, counts, REFERENCE)


def shared_stratum(alphabet: Alphabet, strata: FracElement, size: FracElement) -> Factor:
    """(r A − A')/(r − 1): two different ones of the r = size/strata substrata of one stratum."""
    substrata = size / strata
    coarse, fine = alphabet.sinc2(strata).scaled(substrata), alphabet.sinc2(size)
    return (coarse - fine).scaled(1 / (substrata - 1))


def _one_dimensional(assumptions: Assumptions) -> Sampler:
    alphabet = Alphabet(("N",))
    kernel = alphabet.constant() - alphabet.over(0, alphabet.sinc2(alphabet.count("N")))
    layout = Layout(grouped((Integer(1),)), assumptions=assumptions)
    return Sampler(
        "multi-jitter", "multi-jitter", layout, kernel, lambda n: {"N": max(1, n)}, REFERENCE
    )


def _equal_counts(dim: int) -> Counts:
    def counts(n: int) -> Mapping[str, int]:
        s = max(2, nearest_root(n, 1, dim))
        return {"N": s**dim, "s": s}

    return counts


def rectangle(strata: Strata) -> tuple[tuple[int, int], Counts]:
    """Factors of the two axes, and counts ``m`` columns × ``n`` rows near N, both at least 2."""

    def counts(n: int) -> Mapping[str, int]:
        columns, rows = (max(2, c) for c in strata.counts_near(n))
        return {"N": columns * rows, "m": columns, "n": rows}

    return (strata.factors[0], strata.factors[1]), counts


def _rectangular(strata: Strata, argument: str, assumptions: Assumptions) -> Sampler:
    alphabet = Alphabet(("m", "n"))
    columns, rows = alphabet.count("m"), alphabet.count("n")
    size = columns * rows

    def cells(count: FracElement) -> Factor:
        return alphabet.zero().scaled(count**2) - alphabet.sinc2(count).scaled(count)

    h_x, h_y = alphabet.single(0, cells(columns)), alphabet.single(1, cells(rows))
    k_x = alphabet.over(0, shared_stratum(alphabet, columns, size))
    k_y = alphabet.over(1, shared_stratum(alphabet, rows, size))
    pairs = h_x * h_y + (k_x * h_y).scaled(columns) + (k_y * h_x).scaled(rows)
    kernel = alphabet.constant() + pairs.scaled(1 / size)
    laws = strata.growth
    growth = {"N": Growth(Integer(1)), "m": laws[0], "n": laws[1]}
    layout = Layout(grouped((Integer(1), Integer(1))), growth, assumptions)
    name, counts = f"multi-jitter:{argument}", rectangle(strata)[1]
    return Sampler(name, "multi-jitter", layout, kernel, counts, REFERENCE)
