"""Time and memory of an estimated spectrum, beside a bare transform: ``python -m`` this module.

    python -m specrate.numerics.method_tests.spectrum_costs [--rounds 15]

At 16 384 points and 513² frequencies the step of a spectrum (transform, powers, sums and sums of
squares, per realisation) is timed in turn with one bare call of finufft at the same tolerance, with
one thread and with as many as it chooses; ratios are of medians. The memory is the largest of a
process of its own that takes two realisations of a million points on 2049² frequencies.
"""

import argparse
import resource
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from importlib import import_module
from statistics import median
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..measuring.periodograms import ACCURACY, Box, PeriodogramSums, absorb
from ..streams import stream

_POINTS, _HALF_WIDTH, _SETS = 16_384, 256, 4
_MANY, _WIDE = 1_000_000, 1024
_MEMORY = "--memory"  # the argument of the process whose memory is taken


def seconds(rounds: int) -> dict[str, float]:
    """Median seconds per realisation of the step and of each bare call, by name."""
    sets = stream(0).random((_SETS, _POINTS, 2))
    sums = PeriodogramSums(Box((_HALF_WIDTH, _HALF_WIDTH)))
    methods: dict[str, Callable[[], object]] = {
        "step": lambda: absorb(sums, sets),
        "bare call, one thread": lambda: [_bare(points, 1) for points in sets],
        "bare call, threads by default": lambda: [_bare(points, 0) for points in sets],
    }
    times: dict[str, list[float]] = {name: [] for name in methods}
    for method in methods.values():
        method()
    for _ in range(rounds):
        for name, method in methods.items():
            began = time.perf_counter()
            method()
            times[name].append((time.perf_counter() - began) / _SETS)
    return {name: median(found) for name, found in times.items()}


def _bare(points: NDArray[np.float64], threads: int) -> Any:
    """F_S of one realisation, by one call; 0 threads are finufft's own choice."""
    strengths = np.full(_POINTS, 1 / _POINTS, dtype=np.complex128)
    x, y = np.ascontiguousarray(2 * np.pi * points.T)
    modes = (2 * _HALF_WIDTH + 1,) * 2
    call: Any = import_module("finufft").nufft2d1  # without types
    return call(x, y, strengths, modes, eps=ACCURACY / 2, nthreads=threads, isign=-1)


def _largest_memory() -> int:
    """MiB that this process held at most, after two realisations of a million points."""
    sets = stream(0).random((2, _MANY, 2))
    absorb(PeriodogramSums(Box((_WIDE - 1, _WIDE - 1))), sets)
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024


def main(arguments: Sequence[str] | None = None) -> int:
    """Print the table; exit code 1 if the step takes more than 0.8 of a bare call, or 1 GiB."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument(_MEMORY, action="store_true", help=argparse.SUPPRESS)
    asked = parser.parse_args(arguments)
    if asked.memory:
        print(_largest_memory())
        return 0
    found = seconds(max(1, asked.rounds))
    print("| | ms per realisation | of a bare call |\n|---|---|---|")
    least = min(t for name, t in found.items() if name != "step")
    for name, t in found.items():
        print(f"| {name} | {1e3 * t:.2f} | {t / least:.2f} |")
    own = [sys.executable, "-m", __spec__.name if __spec__ else __name__, _MEMORY]
    memory = int(subprocess.run(own, check=True, capture_output=True, text=True).stdout)
    print(f"\n{_MANY} points on {2 * _WIDE - 1}² frequencies: {memory} MiB")
    return int(found["step"] > 0.8 * least or memory > 1024)


if __name__ == "__main__":
    sys.exit(main())
