"""Cloaked lattice: the points (j + u + c S)/n, u uniform in a cell, S β-stable, 0 < β <= 2.

Each of the N = n^d points of a lattice is moved by independent u and S on every axis. The uniform
part hides the lattice: its characteristic function sinc(x) vanishes at all Bragg peaks (Klatt, Kim,
Torquato 2020). With E exp(−2πi x c S) = exp(−κ|x|^β), κ = 1/2,

    N·P_S(m) = 1 − ∏_i sinc²(m_i/n) exp(−|m_i/n|^β),

of degree β at low frequencies: any degree in (0, 2]. The displacements c S are narrower than a
cell, but for β < 2 with tails P(|c S| > t) ~ t^-β, so that their variance is infinite. (κ only
sets their width: c = κ^(1/β)/2π cells; 1/2 makes the coefficient of |m_i/n|^β one.)
"""

from fractions import Fraction

from ..errors import InputError
from ..expressions import parse_expression
from ..kernels import Alphabet
from ..layouts import Layout
from ..shapes import stretched
from ..signs import Assumptions
from ..symbolic import Expr, Integer
from .definition import Sampler
from .stratified import grid_of

_MOST_DIGITS = 6  # of the denominator: β is a power that series are expanded in


def cloaked(argument: str, dim: Expr, assumptions: Assumptions) -> Sampler:
    """``cloaked:1/2``, ``cloaked:3/2``, any rational 0 < β <= 2."""
    beta = parse_expression(argument) if argument else Integer(0)
    if not (beta.is_Rational and 0 < beta <= 2 and beta.q < 10**_MOST_DIGITS):
        rule = "cloaked:beta must satisfy 0 < beta <= 2, a fraction over less than 10^6"
        raise InputError(f"{rule}: got {argument!r}")
    groups, (count,), growth, counts_at = grid_of(None, dim)
    alphabet = Alphabet(("N", count))
    n = alphabet.count(count)
    power = stretched(Fraction(int(beta.p), int(beta.q)))
    moved = alphabet.over(0, alphabet.sinc2(n) * alphabet.shape(power, n))
    layout = Layout(groups, growth, assumptions)
    kernel = alphabet.constant() - moved
    reference = "Klatt, Kim, Torquato 2020"
    return Sampler(f"cloaked:{beta}", "cloaked", layout, kernel, counts_at, reference)
