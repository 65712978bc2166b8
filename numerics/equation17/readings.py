"""What Eq. 4 and Eq. 17 give as printed, and what is true: the tables of docs/equation17.md.

    python -m specrate.numerics.equation17.readings

As printed both integrate a spectrum over all real frequencies; on the torus the variance is a sum
over the integer frequencies but 0. By Poisson's formula the sum over the integers of the spectrum's
density S is its integral where nothing wraps round, so that

    N·Var = ∫ S |Ff|² dν − S(0) |Ff(0)|² + Σ_{m≠0} (N·P_S(m) − S(m)) |Ff(m)|²:

the integral counts S(0), which the sum leaves out, and misses the null sets of frequencies, axes
and teeth of combs, where N·P_S is not S.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import pi

import numpy as np

from ...theory.samplers import parse_sampler
from ..exact_variances.variances import exact_variance
from ..integrands.grammar import parse_integrand
from .axis_integrals import AxisProblem, solve_axis
from .densities import density_array, density_of, expanded
from .space_integrands import SpaceBall, SpaceGaussian, on_space
from .sphere_integrals import radial_nodes
from .whole_integrals import whole_integral

SAMPLERS = (
    "random",
    "jitter",
    "latin-hypercube",
    "multi-jitter",
    "correlated-multi-jitter",
    "regular",
)
INTEGRANDS = ("gaussian:sigma=1/10", "disk:radius=1/4")
COUNT = 16
DIRECTIONS = (4, 8, 16, 64, 256, 1024, 4096)
RADIUS = Fraction(1, 4)
STRATA = (4, 16, 1000, 10**6, 10**15)


@dataclass(frozen=True)
class Reading:
    """N·Var of one sampler and integrand: the integral, its two errors, the sum.

    Parameters
    ----------
    sampler, integrand : str
    integral : float
        N times that of Eq. 4, over all real frequencies.
    at_zero : float
        S(0) |Ff(0)|², in the integral and not in the sum.
    null_sets : float
        What the sum has beyond the integral but for that: axes and teeth, and what wraps round.
    total : float
        N times the variance on the torus.
    """

    sampler: str
    integrand: str
    integral: float
    at_zero: float
    null_sets: float
    total: float


def reading(sampler: str, integrand: str, n: int, dim: int = 2) -> Reading:
    """Both readings at the admissible N nearest to n, certified before they are rounded."""
    design, f = parse_sampler(sampler, dim), parse_integrand(integrand, dim)
    assert design.counts_at is not None
    counts = design.counts_at(n)
    density = density_of(design, counts)
    integral = counts["N"] * float(whole_integral(design, counts, on_space(f)).value)
    total = counts["N"] * float(exact_variance(design, counts, f).value)
    at_zero = float(expanded(density).total) * float(f.mean(17).mid()) ** 2
    return Reading(sampler, integrand, integral, at_zero, total - integral + at_zero, total)


def latin_hypercube_by_directions(integrand: SpaceGaussian, n: int, directions: int) -> float:
    """N·Var of a 2D Latin hypercube by the sum of Eq. 9 over equal angles, the axes among them.

    Parameters
    ----------
    integrand : SpaceGaussian
        In two dimensions.
    n : int
        N >= 2.
    directions : int
        m, a multiple of 4; on the four half-axes the spectrum is that of 1D jitter, as it is.
    """
    design, line = parse_sampler("latin-hypercube", 2), parse_sampler("jitter", 1)
    plane = expanded(density_of(design, {"N": n}))
    axis = expanded(density_of(line, {"N": n, "n": n}))
    sigmas = np.array([float(s) for s in integrand.sigmas])
    x, weights = radial_nodes(plane, sigmas, 40)
    quadrant = 2 * pi / directions * np.arange(directions // 4)
    total = 0.0
    for angle in quadrant.tolist():
        for e in ((np.cos(angle), np.sin(angle)), (-np.sin(angle), np.cos(angle))):
            direction = np.array(e)
            width = float(np.linalg.norm(direction * sigmas))
            rho = (x / (2 * pi * width))[:, None]
            on_axis = angle == 0
            spectrum = (
                density_array(axis, rho) if on_axis else density_array(plane, rho * direction)
            )
            total += 2 * float(weights @ (x * np.exp(-x * x) * spectrum)) / (2 * pi * width) ** 2
    return total * float(np.prod(2 * pi * sigmas**2)) * 2 * pi / directions


@dataclass(frozen=True)
class AxisRow:
    """Jitter with n × n strata against a disk: one direction, one line, and the whole.

    Parameters
    ----------
    strata : int
        n; N = n².
    direction : str
        N times the summand of Eq. 17 for the direction of an axis, with ρ^(d−1).
    line : str
        N times the sum of the torus over the frequencies of an axis, no Jacobian.
    whole : str
        N times the variance.
    """

    strata: int
    direction: str
    line: str
    whole: str


def axis_row(radius: Fraction, strata: int) -> AxisRow:
    """The three for one number of strata, certified to six digits.

    Where 2R + 1/n <= 1 the sum over the integers of an axis is twice the integral over 0 < ρ < ∞.
    """
    ball, n = SpaceBall(2, radius), Fraction(strata)
    jitter = parse_sampler("jitter", 2)
    direction = solve_axis(AxisProblem(ball, n, Fraction(1), 2), 6).value.value
    line = solve_axis(AxisProblem(ball, n, Fraction(1, 2), 1), 6, "quadrature").value.value
    counts = {"N": strata**2, "n": strata}
    whole = Fraction(whole_integral(jitter, counts, ball, digits=20).value) * strata**2
    return AxisRow(strata, f"{float(direction):.5e}", f"{float(line):.5e}", f"{float(whole):.5e}")


def markdown(heads: Sequence[str], rows: Iterator[Sequence[str]]) -> str:
    """A table in Markdown."""
    lines = [heads, ["---"] * len(heads), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def tables() -> Iterator[str]:
    """The tables of docs/equation17.md in their order."""
    found = [reading(s, f, COUNT) for f in INTEGRANDS for s in SAMPLERS]
    heads = ("sampler", "integrand", "integral", "− at 0", "+ null sets", "= torus sum")
    yield markdown(heads, (_reading_cells(r) for r in found))
    gaussian = SpaceGaussian((Fraction(1, 10),) * 2)
    sums = ((m, latin_hypercube_by_directions(gaussian, COUNT, m)) for m in DIRECTIONS)
    yield markdown(("directions m", "N·Var"), ((str(m), f"{v:.7f}") for m, v in sums))
    rows = (axis_row(RADIUS, n) for n in STRATA)
    heads = ("n", "one direction", "one axis", "whole", "one axis/whole")
    yield markdown(heads, (_axis_cells(r) for r in rows))


def _reading_cells(row: Reading) -> Sequence[str]:
    numbers = (row.integral, row.at_zero, row.null_sets, row.total)
    texts = (f"{x:.7f}" for x in numbers)
    return (row.sampler, row.integrand, *("0" if float(t) == 0 else t for t in texts))


def _axis_cells(row: AxisRow) -> Sequence[str]:
    share = float(row.line) / float(row.whole)
    return (f"{row.strata:,}", row.direction, row.line, row.whole, f"{share:.2e}")


if __name__ == "__main__":
    print(*tables(), sep="\n\n")
