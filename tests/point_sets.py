"""Correct samplers, and ones with fixed places, as arrays of realisations (R, N, d)."""

import json
from collections.abc import Callable

import numpy as np
import pytest
from specrate.numerics.checking.faults import Findings
from specrate.numerics.point_sources.fault_kinds import Fault
from specrate.numerics.point_sources.sources import EngineSource

Sampler = Callable[[int, int, int, np.random.Generator], np.ndarray]


def independent(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return rng.random((R, N, d))


def grid(N: int, d: int) -> np.ndarray:
    """Lower corners of the cells of a grid, shape (N, d)."""
    side = round(N ** (1 / d))
    assert side**d == N
    return np.stack(np.unravel_index(np.arange(N), (side,) * d), axis=1) / side


def jitter(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return grid(N, d) + rng.random((R, N, d)) / round(N ** (1 / d))


def shifted_grid(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return (grid(N, d) + rng.random((R, 1, d))) % 1.0


def ranks(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return rng.permuted(np.broadcast_to(np.arange(N)[None, :, None], (R, N, d)), axis=1)


def latin_hypercube(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return (ranks(R, N, d, rng) + rng.random((R, N, d))) / N


def centred_latin_hypercube(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    return (ranks(R, N, d, rng) + 0.5) / N


def shifted_lattice(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
    generator = np.array([pow(5, i, N) for i in range(d)])
    return (np.arange(N)[:, None] * generator / N + rng.random((R, 1, d))) % 1.0


def engine(name: str) -> Sampler:
    def draw(R: int, N: int, d: int, rng: np.random.Generator) -> np.ndarray:
        qmc = pytest.importorskip("scipy.stats.qmc")
        return EngineSource(name, getattr(qmc, name), d).realise(N, 3, range(R))

    return draw


CORRECT: dict[str, Sampler] = {
    "independent": independent,
    "jitter": jitter,
    "shifted grid": shifted_grid,
    "Latin hypercube": latin_hypercube,
    "shifted lattice": shifted_lattice,
    "Sobol": engine("Sobol"),
    "Halton": engine("Halton"),
    "LatinHypercube": engine("LatinHypercube"),
}


def of_kind(found: Findings, kind: str) -> list[Fault]:
    """The faults of a kind; all have evidence for JSON, one line and a remedy."""
    json.dumps([fault.evidence for fault in found.faults], allow_nan=False)
    assert all("\n" not in fault.detail + fault.remedy for fault in found.faults)
    return [fault for fault in found.faults if fault.kind == kind]
