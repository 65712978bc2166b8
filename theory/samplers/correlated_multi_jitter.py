"""Correlated multi-jitter in 2D: m columns × n rows, the same shuffle in every column and row.

With D_m(a) = m² [m divides a] − m, D_n(b) likewise, A' = sinc²(a/N), B' = sinc²(b/N),
k_x = (n A − A')/(n − 1), A = sinc²(a/m), and likewise k_y with B = sinc²(b/n),

    N·P_S(a, b) = 1 + (D_m D_n k_x k_y + m k_x D_n B' + n k_y D_m A')/N.

Its low-frequency series has two vertices: |m|²/N² and a² b²/N² (Kensler 2013).
"""

from ..errors import InputError
from ..kernels import Alphabet, Factor
from ..layouts import Growth, Layout, grouped
from ..signs import Assumptions
from ..strata import equal_strata, parse_strata
from ..symbolic import Expr, FracElement, Integer
from .definition import Sampler
from .multi_jitter import rectangle, shared_stratum


def correlated_multi_jitter(argument: str, dim: Expr, assumptions: Assumptions) -> Sampler:
    """``correlated-multi-jitter``, ``correlated-multi-jitter:8x16``."""
    if dim != 2:
        raise InputError(f"correlated-multi-jitter is for --dim 2: got {dim}")
    strata = parse_strata(argument, 2) if argument else equal_strata(2)
    alphabet = Alphabet(("m", "n"))
    columns, rows = alphabet.count("m"), alphabet.count("n")
    size = columns * rows

    def teeth(count: FracElement) -> Factor:
        return alphabet.comb(count).scaled(count**2) - alphabet.one().scaled(count)

    shared_x = shared_stratum(alphabet, columns, size)
    shared_y = shared_stratum(alphabet, rows, size)
    fine = alphabet.sinc2(size)

    def both(x: Factor, y: Factor):
        return alphabet.single(0, x) * alphabet.single(1, y)

    pairs = both(teeth(columns) * shared_x, teeth(rows) * shared_y)
    pairs = pairs + both(shared_x, teeth(rows) * fine).scaled(columns)
    pairs = pairs + both(teeth(columns) * fine, shared_y).scaled(rows)
    laws = strata.growth
    growth = {"N": Growth(Integer(1)), "m": laws[0], "n": laws[1]}
    layout = Layout(grouped((Integer(1), Integer(1))), growth, assumptions)
    name = "correlated-multi-jitter" + (f":{argument}" if argument else "")
    kernel = alphabet.constant() + pairs.scaled(1 / size)
    family = "correlated-multi-jitter"
    return Sampler(name, family, layout, kernel, rectangle(strata)[1], "Kensler 2013")
