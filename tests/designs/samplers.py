"""Samplers as users write them: correct ones first, then each with one defect."""

import os
import sys
import time

import numpy as np


def grid(n, dim):
    side = round(n ** (1 / dim))
    if side**dim != n:
        raise ValueError(f"n must be a whole power {dim}: got {n}")
    return np.indices((side,) * dim).reshape(dim, -1).T, side


def jitter(n, dim, rng):
    cells, side = grid(n, dim)
    return (cells + rng.random((n, dim))) / side


def rooks(n, dim, rng):
    cells = np.stack([rng.permutation(n) for _ in range(dim)], axis=1)
    return (cells + rng.random((n, dim))) / n


def shuffled_jitter(n, dim, rng):
    return rng.permutation(jitter(n, dim, rng))


def half_jitter(n, dim, rng):
    """The second coordinate forgets to be stratified."""
    points = jitter(n, dim, rng)
    points[:, 1] = rng.random(n)
    return points


def centred_rooks(n, dim, rng):
    """Points at stratum centres."""
    return np.stack([rng.permutation(n) + 0.5 for _ in range(dim)], axis=1) / n


def coupled(n, dim, rng):
    """Pairs of coordinates are independent, all three are not: x + y - z is 0 modulo 1."""
    points = rng.random((n, 3))
    points[:, 2] = (points[:, 0] + points[:, 1]) % 1.0
    return points


def wide_jitter(n, dim, rng):
    """Points stray into the neighbouring cells; the marginals stay uniform."""
    cells, side = grid(n, dim)
    return (cells + 0.5 + 2.0 * (rng.random((n, dim)) - 0.5)) / side % 1.0


def lumpy(n, dim, rng):
    """The density along the first axis is 1 + cos(10 pi x)/2."""
    points = rng.random((4 * n + 100, dim))
    dense = 1.5 * rng.random(len(points)) < 1 + 0.5 * np.cos(10 * np.pi * points[:, 0])
    return points[dense][:n]


def frozen(n, dim, rng):
    """The seed is ignored."""
    return np.random.Generator(np.random.PCG64(1)).random((n, dim))


def single(n, dim, rng):
    """Coordinates in single precision."""
    return rng.random((n, dim), dtype=np.float32)


def nan(n, dim, rng):
    points = rng.random((n, dim))
    points[3, 1] = np.nan
    return points


def outside(n, dim, rng):
    points = rng.random((n, dim))
    points[2, 0] = 1.0
    return points


def transposed(n, dim, rng):
    return rng.random((dim, n))


def raising(n, dim, rng):
    raise RuntimeError("no luck")


def raising_late(n, dim, rng):
    """Fails on about one realisation in 200."""
    points = rng.random((n, dim))
    if points[0, 0] < 0.005:
        raise RuntimeError("no luck today")
    return points


def fewer(n, dim, rng):
    """Only whole squares come out."""
    side = int(n**0.5)
    return rng.random((side * side, dim))


def slow(n, dim, rng):
    time.sleep(0.05)
    return rng.random((n, dim))


def fixed_rooks(n, dim, rng):
    """The permutations are the same every time; only the jitter is drawn."""
    cells = np.stack([np.random.Generator(np.random.PCG64(k)).permutation(n) for k in range(dim)])
    return (cells.T + rng.random((n, dim))) / n


def doubled(n, dim, rng):
    """Every point has a twin 1e-9 beside it."""
    points = rng.random((n // 2, dim))
    return np.concatenate([points, points + 1e-9])[rng.permutation(n)] % 1.0


def legacy(n, dim, rng):
    """Drawn from the global state."""
    return np.random.random((n, dim))


def hanging(n, dim, rng):
    time.sleep(1e9)


def hanging_from_100(n, dim, rng):
    return rng.random((n, dim)) if n < 100 else hanging(n, dim, rng)


def leaving(n, dim, rng):
    print("last words")
    os._exit(3)


def segfaulting(n, dim, rng):
    os.kill(os.getpid(), 11)


def enormous(n, dim, rng):
    return np.ones((1 << 40, dim))


def chattering(n, dim, rng):
    """Correct, though it prints more than a pipe holds at every call."""
    sys.stdout.write("x" * 100_000)
    return rng.random((n, dim))


def recursing(n, dim, rng):
    return recursing(n, dim, rng)


def refusing(n, dim, rng):
    raise ValueError(f"{n} is no prime number")
