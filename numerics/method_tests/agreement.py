"""Exact variances against Monte Carlo: ``python -m`` this module.

    python -m specrate.numerics.method_tests.agreement [--replicates 100000] [--n 16] [--seed 0]

Every catalogue sampler that has a kernel and points, on every integrand of the catalogue, in one,
two and three dimensions. Replicates of the randomly shifted estimator are drawn until their number
is reached, and the mean squared error is compared with the exact variance in units of its standard
error. A correct pair is beyond five of them with a chance of 6e-7.
"""

import argparse
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf

from ...theory.samplers import Sampler, parse_sampler
from ..exact_variances.variances import ExactVariance, exact_variance
from ..integrands import CATALOGUE, Integrand, parse_integrand
from ..measuring.moments import Moments, estimates, shifted, update
from ..point_sources.catalogue_source import CatalogueSource, chunk_size
from ..streams import stream

SIGMAS = 5.0
"""Width of the band, in standard errors."""

_SAMPLERS = {
    1: ("random", "regular", "jitter", "latin-hypercube", "multi-jitter"),
    2: (
        *("random", "regular", "regular:2x8", "jitter", "jitter:2x8", "latin-hypercube"),
        *("multi-jitter", "multi-jitter:2x8", "correlated-multi-jitter"),
        *("correlated-multi-jitter:2x8", "uncorrelated-jitter:1+1"),
    ),
    3: (
        *("random", "regular", "jitter", "jitter:2x2x4", "latin-hypercube", "multi-jitter"),
        *("uncorrelated-jitter:1+2", "uncorrelated-jitter:2+1", "uncorrelated-jitter:1+1+1"),
    ),
}
_PARAMETERS = {
    1: ("ridge:k=3", "bernoulli:k=1"),
    2: ("ridge:k=(1,-2)", "bernoulli:k=1,axes=(1,2)", "box:side=(1/3,0.9)"),
    3: ("ridge:k=(1,1,-1)", "ridge:k=(0,2,1)", "bernoulli:k=1,axes=(1,3)"),
}
_SHIFT_KEY = 1 << 21  # keeps the shifts apart from the points
_ROUNDING = 1e-24  # mean squared error that is but rounding, for integrands of size one


@dataclass(frozen=True)
class Pair:
    """A sampler on an integrand: exact variance, measured moments, and their distance.

    Parameters
    ----------
    sampler : Sampler
    n : int
    integrand : Integrand
    exact : ExactVariance
    measured : Moments
        Of the errors I_N − I.
    """

    sampler: Sampler
    n: int
    integrand: Integrand
    exact: ExactVariance
    measured: Moments

    @property
    def sigmas(self) -> float:
        """Distance in standard errors, less what the exact value's bound allows."""
        gap = abs(self.measured.mse - float(self.exact.value)) - float(self.exact.error_bound)
        if gap <= _ROUNDING:
            return 0.0
        return gap / self.measured.mse_error if self.measured.mse_error > 0 else inf


def samplers(dim: int) -> tuple[Sampler, ...]:
    """Samplers with a kernel and points in a dimension."""
    return tuple(parse_sampler(name, dim) for name in _SAMPLERS[dim])


def integrands(dim: int) -> tuple[Integrand, ...]:
    """Every entry of the catalogue that exists in a dimension, and some with parameters."""
    names = [e.name for e in CATALOGUE]
    names = [n for n in names if (n != "disk" or dim == 2) and (n != "chord" or dim < 3)]
    found = [parse_integrand(n, dim) for n in (*names, *_PARAMETERS[dim]) if n != "ridge"]
    return tuple({f.name: f for f in found}.values())


def pairs(sampler: Sampler, n: int, replicates: int, seed: int) -> Iterator[Pair]:
    """The sampler at the admissible N nearest to n on every integrand, all on the same points."""
    source = CatalogueSource(sampler)
    assert sampler.counts_at is not None
    counts, asked = sampler.counts_at(n), integrands(int(sampler.dim))
    moments = {f.name: Moments() for f in asked}
    means = {f.name: float(f.mean(17).mid()) for f in asked}
    step = chunk_size(counts["N"])
    for start in range(0, replicates, step):
        points = source.realise(counts["N"], seed, range(start, start + step))
        shifts = stream(seed, _SHIFT_KEY, start).random((step, points.shape[2]))
        moved = shifted(points, shifts)
        for f in asked:
            moments[f.name] = update(moments[f.name], estimates(f, moved) - means[f.name])
    for f in asked:
        yield Pair(sampler, counts["N"], f, exact_variance(sampler, counts, f), moments[f.name])


def main(arguments: Sequence[str] | None = None) -> int:
    """Print a row for each sampler; 1 if a pair is outside its band."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--replicates", type=int, default=100_000)
    parser.add_argument("--n", type=int, default=16, help="the nearest admissible N is taken")
    parser.add_argument("--seed", type=int, default=0)
    asked = parser.parse_args(arguments)
    print(
        "| sampler | d | N | integrands | farthest | standard errors |\n|---|---|---|---|---|---|"
    )
    outside = 0
    for dim in _SAMPLERS:
        for sampler in samplers(dim):
            found = list(pairs(sampler, asked.n, asked.replicates, asked.seed))
            far = max(found, key=lambda p: p.sigmas)
            outside += sum(p.sigmas > SIGMAS for p in found)
            cells = (sampler.name, dim, far.n, len(found), far.integrand.name, f"{far.sigmas:.2f}")
            print(f"| {' | '.join(map(str, cells))} |", flush=True)
    print(f"\n{outside} pairs outside {SIGMAS:g} standard errors")
    return 1 if outside else 0


if __name__ == "__main__":
    sys.exit(main())
