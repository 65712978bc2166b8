"""Strata of one block: how many cells along each axis, and how the numbers grow with N.

The counts along the axes are n_i = k_i t^p_i with whole k_i and p_i, so that the block has
N = ∏ n_i = K t^S cells, K = ∏ k_i, S = Σ p_i, and n_i = κ_i N^a_i with a_i = p_i/S and
κ_i = k_i / K^a_i. A constant count has p_i = 0.
"""

from dataclasses import dataclass
from math import lcm, prod

from .errors import InputError
from .expressions import is_whole, parse_expression
from .layouts import Growth
from .symbolic import Expr, Integer, Rational, sympy

_RULE = "strata are written as 25x40 (proportions kept as N grows), 4xN or N^1/3xN^2/3"


@dataclass(frozen=True)
class Strata:
    """Counts n_i = factors[i] · t^powers[i] along the axes of a block."""

    factors: tuple[int, ...]
    powers: tuple[int, ...]

    @property
    def growth(self) -> tuple[Growth, ...]:
        """The law κ N^a of each axis."""
        whole, total = prod(self.factors), sum(self.powers)
        laws: list[Growth] = []
        for k, p in zip(self.factors, self.powers, strict=True):
            a = Rational(p, total)
            laws.append(Growth(a, k / Integer(whole) ** a))
        return tuple(laws)

    @property
    def equal(self) -> bool:
        """Whether all axes are stratified alike."""
        return len(set(zip(self.factors, self.powers, strict=True))) == 1

    def counts_near(self, n: int) -> tuple[int, ...]:
        """Counts along the axes at the admissible N nearest to ``n``."""
        t = nearest_root(n, prod(self.factors), sum(self.powers))
        return tuple(k * t**p for k, p in zip(self.factors, self.powers, strict=True))


def nearest_root(n: int, factor: int, power: int) -> int:
    """The t >= 1 for which factor · t^power is nearest to n."""
    below = max(1, int(sympy.integer_nthroot(max(1, n // factor), power)[0]))
    return min((below, below + 1), key=lambda t: abs(factor * t**power - n))


def equal_strata(axes: int) -> Strata:
    """The same number of strata along each axis."""
    return Strata((1,) * axes, (1,) * axes)


def parse_strata(text: str, axes: int) -> Strata:
    """Strata written as ``25x40``, ``4xN`` or ``N^1/3xN^2/3``, one part per axis.

    Raises
    ------
    InputError
        If a part is not of this form, there are not as many parts as axes, or the powers of N
        do not sum to 1.
    """
    parts = text.split("x")
    if len(parts) != axes:
        raise InputError(f"{_RULE}, one part per axis: got {len(parts)} for {axes} axes")
    if all(is_whole(p) for p in parts):
        return Strata(tuple(_whole(p) for p in parts), (1,) * axes)
    exponents = [_exponent(p) for p in parts]
    given = sympy.Add(*[e for e in exponents if e is not None])
    bare = sum(e is None for e in exponents)
    powers = [(1 - given) / bare if e is None else e for e in exponents]
    if sum(powers) != 1 or any(p <= 0 for p, e in zip(powers, exponents, strict=True) if e != 0):
        raise InputError(f"{_RULE}, the powers of N being positive with sum 1: got {text!r}")
    scale = lcm(*[int(p.q) for p in powers])
    factors = tuple(_whole(p) if is_whole(p) else 1 for p in parts)
    return Strata(factors, tuple(int(p * scale) for p in powers))


def _whole(text: str) -> int:
    if not 1 <= int(text) <= 10**18:
        raise InputError(f"a number of strata must be in 1..10^18: got {text}")
    return int(text)


def _exponent(part: str) -> Expr | None:
    """The power of N of one part; 0 for a whole number, None for a bare N, which takes a share."""
    if is_whole(part):
        return Integer(0)
    if part == "N":
        return None
    if not part.startswith("N^"):
        raise InputError(f"{_RULE}: got {part!r}")
    power = parse_expression(part[2:].strip("()"))
    if not (power.is_Rational and 0 < power <= 1):
        raise InputError(f"{_RULE}, the powers of N being positive with sum 1: got {part!r}")
    return power
