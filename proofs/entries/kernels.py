"""Exact kernels: expected power spectra of coordinate-stratified samplers, for all N, n_i and d."""

from collections.abc import Callable

from ..entry import Entry, proved
from ..theorems import multi_jitter_spectra as multi_jitter
from ..theorems import stratified_spectra as stratified
from ..trusted.kernel import Step

_BRACKET = "ν is any real frequency; sinc² ν = sin²(πν)/(πν)² is [ν = 0] where ν is whole. "


def _kernel(sampler: str, title: str, proof: Callable[[], Step], source: str, notes: str) -> Entry:
    return proved(f"kernel, {sampler}", title, source, proof, notes)


ENTRIES = (
    _kernel(
        "random",
        "N P_S = 1 + (N − 1) ∏ sinc² ν_i",
        stratified.random,
        "Section 3, Eq. 5, first row",
        _BRACKET + "Left: 1, and N − 1 times the characteristic function of two points.",
    ),
    _kernel(
        "random, whole frequencies",
        "N P_S = 1 at whole m ≠ 0",
        stratified.random_at_whole_frequencies,
        "Section 3, Eq. 5, first row",
        "One coordinate p of m is not 0; the others are free.",
    ),
    _kernel(
        "regular grid, between teeth",
        "P_S = 0 where one n_p does not divide m_p",
        stratified.grid_between_teeth,
        "Appendix A",
        "Left: the mean of cos 2πm·(s_a − s_b) over all pairs of points, axis by axis; whatever "
        "shift all points have in common drops out of it.",
    ),
    _kernel(
        "regular grid, teeth",
        "P_S = 1 where every n_i divides m_i",
        stratified.grid_on_teeth,
        "Appendix A",
        "m_i = n_i ν_i with ν_i whole.",
    ),
    _kernel(
        "jitter",
        "N P_S = N ∏ sinc² ν_i + 1 − ∏ sinc²(ν_i/n_i)",
        stratified.jitter,
        "Section 3, Eq. 5, second row; Cook 1986",
        _BRACKET + "Left: N times the mean over pairs of cells, where two points of one cell are "
        "one point: 1 stands for the product of its places. N = ∏ n_i is not needed for it.",
    ),
    _kernel(
        "jitter, whole frequencies",
        "N P_S = 1 − ∏ sinc²(m_i/n_i) at whole m ≠ 0",
        stratified.jitter_at_whole_frequencies,
        "Section 3, Eq. 5, second row; Cook 1986",
        "One coordinate p of m is not 0; the others are free.",
    ),
    _kernel(
        "Latin hypercube",
        "N P_S = 1 + (N − 1) ∏ (N sinc² ν_i − sinc²(ν_i/N))/(N − 1)",
        stratified.latin_hypercube,
        "Section 6.2; McKay, Beckman, Conover 1979",
        _BRACKET + "Two points lie on each axis in two different strata, every two equally often.",
    ),
    _kernel(
        "uncorrelated jitter",
        "N P_S = 1 + (N − 1) ∏_B (N ∏_B sinc² ν_i − ∏_B sinc²(ν_i/n_i))/(N − 1)",
        stratified.uncorrelated_jitter,
        "Section 6.2; Cook 1986",
        _BRACKET + "Block B is the coordinates first(B) + 1, ..., first(B) + size(B), with N = "
        "∏_B n_i cells; two points lie in each block in two different cells.",
    ),
    _kernel(
        "Latin hypercube, as uncorrelated jitter",
        "blocks of one axis, n_i = N: N P_S = 1 + (N − 1) ∏_B (N sinc² ν_B − sinc²(ν_B/N))/(N − 1)",
        stratified.blocks_of_one_axis,
        "Section 6.2, uncorrelated jitter: a Latin hypercube as its special case",
        "The kernel of uncorrelated jitter at first(B) = B − 1, size(B) = 1, n_i = N.",
    ),
    _kernel(
        "multi-jitter",
        "N P_S = 1 + N ∏ (sinc² ν_i + (K_i − A_i)/s) − ∏ K_i, N = s^d",
        multi_jitter.in_d_dimensions,
        "Section 6.2; Owen 1992, Tang 1993",
        _BRACKET + "A = sinc²(ν/s), K = (r A − sinc²(ν/N))/(r − 1), r = N/s.",
    ),
    _kernel(
        "multi-jitter, columns and rows",
        "N P_S = 1 + (h_x h_y + m K_x h_y + n K_y h_x)/N, N = m n",
        multi_jitter.columns_and_rows,
        "Section 6.2; Chiu, Shirley, Wang 1994",
        _BRACKET + "h_x = m² sinc² f − m sinc²(f/m), K_x = (n sinc²(f/m) − sinc²(f/N))/(n − 1).",
    ),
    _kernel(
        "correlated multi-jitter",
        "N P_S = 1 + (D_m D_n K_x K_y + m K_x D_n B' + n K_y D_m A')/N, N = m n",
        multi_jitter.correlated,
        "Section 6.2; Kensler 2013",
        "D_m = ΣΣ cos 2πf (j − k)/m − m, which is m² [m divides f] − m at whole f.",
    ),
    _kernel(
        "correlated multi-jitter, between teeth",
        "N P_S = (1 − K_x)(1 − K_y) + K_x (1 − B') + K_y (1 − A')",
        multi_jitter.correlated_between_teeth,
        "Section 6.2; Kensler 2013",
        "Where m does not divide f and n does not divide g.",
    ),
    _kernel(
        "correlated multi-jitter, on a ridge",
        "N P_S = 1 + sinc²(j/n) [N sinc²(g/n)/(n − 1) − sinc²(g/N)] at f = mj, j ≠ 0",
        multi_jitter.correlated_on_a_ridge,
        "Section 6.2; Kensler 2013",
        "Where n does not divide g; h stands for j. About n at (n, 1) for m = n.",
    ),
)
