"""Eq. 17 for one direction in closed form: products of sinc² against a ball.

For a direction e, strata n_i on the axes and R the radius, with w_i = |e_i|/(2Rn_i),

    ∫_0^∞ ρ^(d−1) (1 − ∏_i sinc²(ρe_i/n_i)) |Ff(ρe)|² dρ = R^d E G(|Σ_i w_i τ_i|),

τ_i independent of density 1 − |τ| on (−1, 1), and G(z) = ∫_0^∞ (1 − cos 2zt) J_{d/2}(t)² dt/t =
∫_0^z P_{(d−1)/2}(1 − 2u²) du for 0 <= z <= 1. A mean over τ_i is the second difference of the
second integral, so that over the j axes with w_i ≠ 0 E G is the product of their second differences
of the 2j-th integral

    Φ(x) = |x|^(2j+1)/(2j+1)! 3F2(1/2 − d/2, 1/2 + d/2, 1/2; j + 1, j + 3/2; x²)

at 0, over ∏ w_i². On an axis, j = 1, it is (w/3) 3F2(..; 2, 5/2; w²).
"""

from collections.abc import Sequence
from itertools import product
from math import factorial, prod

from ..balls import Ball, flint


def direction_deficit(dim: int, widths: Sequence[Ball]) -> Ball:
    """E G(|Σ w_i τ_i|), at the precision in force; cancels where some w_i are much smaller.

    Parameters
    ----------
    dim : int
        d >= 1, of the ball.
    widths : sequence of Ball
        w_i > 0 of the axes that are stratified, with Σ w_i < 1: elsewhere the ball is not finite.
    """
    j, half = len(widths), flint.fmpq(1, 2)
    if j == 0:
        return flint.arb(0)
    upper = [half - flint.fmpq(dim, 2), half + flint.fmpq(dim, 2), half]
    lower = [j + 1, flint.fmpq(2 * j + 3, 2)]
    total, volume = flint.arb(0), flint.arb(1)
    for signs in product((-1, 0, 1), repeat=j):
        if signs <= (0,) * j:  # Φ is even, and 0 at 0
            continue
        x = abs(sum((s * w for s, w in zip(signs, widths, strict=True)), flint.arb(0)))
        weight = 2 * prod(1 if s else -2 for s in signs)
        power = prod([x] * (2 * j + 1), start=flint.arb(1))  # x**k is nan where x may be 0
        total += weight * power * flint.acb(x * x).hypgeom(upper, lower).real
    for w in widths:
        volume *= w * w
    return total / (factorial(2 * j + 1) * volume)
