r"""Eigenvalues of random unitary matrices (Haar measure) as points of a circle, in O(N²).

A unitary matrix and a vector have a spectral measure with Verblunsky coefficients α_0, ...,
α_(N−1), and for the Haar measure these are independent: the phase of each is uniform, |α_k|² has
the distribution Beta(1, N − 1 − k) for k < N − 1 and |α_(N−1)| = 1 (Killip, Nenciu 2004). The
eigenvalues are the zeros of the last of the orthogonal polynomials. With e^(iψ_k) =
z Φ_k(z)/Φ_k*(z) at z = e^(iθ) Szegő's recursion reads

    ψ_0 = θ,      ψ_(k+1) = ψ_k + θ − 2 arg(1 − α_k e^(iψ_k)),

and Φ_N(z) = 0 where e^(iψ_(N−1)) = conj α_(N−1). Every ψ_k rises with θ, by 2π(k + 1) in a turn:
each target ψ has one root, found by Newton's steps inside a bracket that shrinks.
"""

import numpy as np
from numpy.typing import NDArray

_MOST_STEPS = 100  # bisection alone needs 60; Newton's steps mostly end after 8
_LAST_STEP = 1e-12  # Newton's errors are squared: after a step so small there is none

Complexes = NDArray[np.complex128]
Floats = NDArray[np.float64]
Rows = NDArray[np.intp]


def unitary_phases(n: int, replicates: int, rng: np.random.Generator) -> Floats:
    """Phases θ/2π of all N eigenvalues, in rising order, shape (replicates, N), in [0, 1].

    Parameters
    ----------
    n : int
        N, at least 1.
    """
    alphas = verblunsky(n, replicates, rng)
    rows = np.arange(replicates)
    grid = np.linspace(0, 2 * np.pi, 2 * n + 1)
    psi = _phase(alphas, np.repeat(rows, len(grid)), np.tile(grid, replicates))[0]
    psi = psi.reshape(replicates, len(grid))
    start = rng.random((replicates, 1))  # conj α_(N−1) is uniform on the circle
    targets = psi[:, :1] + 2 * np.pi * (start + np.arange(n))
    found = np.empty_like(targets)
    for row in range(replicates):
        found[row] = np.interp(targets[row], psi[row], grid)
    cell = np.minimum((found / grid[1]).astype(np.int64), 2 * n - 1)
    bracket = np.nextafter(grid[cell], -1).ravel(), np.nextafter(grid[cell + 1], 7).ravel()
    found = _roots(alphas, np.repeat(rows, n), targets.ravel(), found.ravel(), *bracket)
    return found.reshape(replicates, n) / (2 * np.pi)


def verblunsky(n: int, replicates: int, rng: np.random.Generator) -> Complexes:
    """α_0, ..., α_(N−2), shape (replicates, N − 1)."""
    # |α|² of distribution Beta(1, b) is 1 − U^(1/b).
    below = np.arange(n - 1, 0, -1)
    size = np.sqrt(-np.expm1(np.log(1 - rng.random((replicates, n - 1))) / below))
    return size * np.exp(2j * np.pi * rng.random((replicates, n - 1)))


def _phase(alphas: Complexes, rows: Rows, theta: Floats) -> tuple[Floats, Floats]:
    """ψ_(N−1)(θ) and its derivative, θ in the realisation of the same place in ``rows``.

    The wave e^(iψ) is carried along with ψ: e^(iψ_(k+1)) = z e^(iψ_k) conj(r)/r.
    """
    turn = np.exp(1j * theta)
    psi, wave, slope = theta.copy(), turn.copy(), np.ones_like(theta)
    for alpha in alphas.T:
        rest = 1 - alpha[rows] * wave
        square = rest.real**2 + rest.imag**2
        psi += theta - 2 * np.arctan2(rest.imag, rest.real)
        wave *= turn * rest.conj() ** 2 / square
        slope *= (1 - np.abs(alpha) ** 2)[rows] / square
        slope += 1
    return psi, slope


def _roots(
    alphas: Complexes, rows: Rows, targets: Floats, theta: Floats, lower: Floats, upper: Floats
) -> Floats:
    """θ with ψ(θ) = target, each in its bracket, to the rounding of ψ."""
    theta = theta.copy()
    active = np.arange(len(theta))
    for _ in range(_MOST_STEPS):
        before = theta[active]
        psi, slope = _phase(alphas, rows[active], before)
        gap = targets[active] - psi
        lower[active] = low = np.where(gap > 0, before, lower[active])
        upper[active] = high = np.where(gap < 0, before, upper[active])
        step = before + gap / slope
        inside = (step >= low) & (step <= high)
        theta[active] = moved = np.where(inside, step, (low + high) / 2)
        active = active[np.abs(moved - before) >= _LAST_STEP]
        if not active.size:
            break
    return theta
