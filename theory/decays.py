"""Integrand classes: how the energy of an integrand falls on each region (Eq. 16 and beyond).

On a region of dimension s a spectrum that falls in the mean as ρ^-p leaves in the shell
[ρ, 2ρ) the energy ρ^-q, q = p − s. The paper's worst case p = d + 1 is a spherical mean over all
d dimensions; on a support of s < d coordinates a function of those coordinates alone may have a
jump, so the worst case of a region is p = s + 1, q = 1, everywhere. The ball is better than that:
its spectrum falls as ρ^-(d+1) on every support, q = d + 1 − s.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass

from .errors import InputError
from .expressions import is_whole, parse_expression
from .layouts import Layout
from .regions import Region, region_of_support, select
from .signs import nonnegative
from .symbolic import Expr, Integer, sympy

_RULE = (
    "an integrand class is worst, best, p=NUMBER, ball, disk, box, gaussian, anisotropic-gaussian, "
    "product:k=K, bernoulli:k=K, half-space, additive, polylog:p=P, ridge:k=(1,1) or chord"
)
_SMOOTH = ("best", "gaussian", "anisotropic-gaussian")
_JUMPS = ("worst", "box")


@dataclass(frozen=True)
class Decay:
    """A class of integrands.

    Parameters
    ----------
    name : str
        As in the grammar: ``worst``, ``p=5/2``, ``disk:radius=0.3``.
    family : str
        The name without parameters.
    number : sympy.Expr or None
        p of ``p=...`` and ``polylog``, the degree of the Bernoulli polynomials.
    axes : tuple of int
        The one support that carries the power of ``bernoulli``, ``half-space``, ``polylog`` and
        ``ridge``; of ``box`` the coordinates with sides below 1, empty if all are alike.
    powers : tuple of (str, sympy.Expr)
        For ``per_region``: regions with their p.
    """

    name: str
    family: str
    number: Expr | None = None
    axes: tuple[int, ...] = ()
    powers: tuple[tuple[str, Expr], ...] = ()

    @property
    def is_product(self) -> bool:
        """Whether the power on a support falls as a product over its coordinates."""
        return self.family in ("box", "product", "bernoulli")

    @property
    def is_on_line(self) -> bool:
        """Whether its power lies on the multiples of one frequency, off the axes."""
        return self.family == "ridge" and len(self.axes) > 1


def per_region(powers: Mapping[str, Expr | int]) -> Decay:
    """A class with its own decay p on each named region, and no power on any other.

    Parameters
    ----------
    powers : mapping of str to sympy.Expr
        Region, in its grammar, to p; ``oo`` for no power beyond ρ0. Where two names hold one
        region the first counts.

    Raises
    ------
    InputError
        If no region is named.
    """
    if not powers:
        raise InputError("a class per region must name a region: got none")
    listed = tuple((region, sympy.sympify(p, strict=True)) for region, p in powers.items())
    name = ", ".join(f"p={p} on {region}" for region, p in listed)
    return Decay(name, "per region", powers=listed)


def parse_decay(text: str) -> Decay:
    """The class that a CLASS of the grammar names.

    Raises
    ------
    InputError
        If there is no such class, or its number is out of range.
    """
    name = text.strip()
    head, _, parameters = name.partition(":")
    if head.startswith("p="):
        decay = parse_expression(head[2:])
        if not (decay.is_Rational and decay > 1) and decay is not sympy.oo:
            raise InputError(f"the decay in p=NUMBER must exceed 1: got {text!r}")
        return Decay("best", "best") if decay is sympy.oo else Decay(name, "p", decay)
    if head in ("product", "bernoulli") or (head == "additive" and parameters):
        axes = _axes_of(parameters, text) if head == "bernoulli" else ()
        return Decay(name, head, Integer(_order_of(parameters, text)), axes)
    if head == "polylog":
        return Decay(name, head, _power_of(parameters, text), (1,))
    if head == "ridge":
        return Decay(
            name, head, Integer(_order_of(parameters, text, "b")), _ridge_of(parameters, text)
        )
    if head == "half-space":
        return Decay(name, head, axes=(1,))
    if head not in (*_SMOOTH, *_JUMPS, "ball", "disk", "chord", "additive"):
        raise InputError(f"{_RULE}: got {text!r}")
    if parameters and head in ("worst", "best"):
        raise InputError(f"{head} takes no parameter: got {text!r}")
    return Decay(name, head, axes=_short_sides(parameters, text) if head == "box" else ())


def _order_of(parameters: str, text: str, name: str = "k") -> int:
    """Degree of the Bernoulli polynomial, 2 unless told."""
    for part in parameters.split(","):
        key, _, value = part.partition("=")
        if key.strip() == name:
            if not is_whole(value.strip()) or int(value) < 1:
                raise InputError(f"{name} must be a whole number of at least 1: got {text!r}")
            return int(value)
    return 2


def _power_of(parameters: str, text: str) -> Expr:
    """p of a polylog, 5/2 unless told."""
    key, _, value = parameters.partition("=")
    power = parse_expression(value) if key.strip() == "p" else parse_expression("5/2")
    if (parameters and key.strip() != "p") or not (power.is_Rational and power > 1):
        raise InputError(f"a polylog is written polylog:p=5/2 with p > 1: got {text!r}")
    return power


def _ridge_of(parameters: str, text: str) -> tuple[int, ...]:
    """The support of the direction k of a ridge, 1-based; all of (1,1) unless told."""
    numbers = _values(parameters, "k", ["1", "1"])
    entries = [n.removeprefix("-") for n in numbers]
    support = tuple(i + 1 for i, n in enumerate(entries) if is_whole(n) and int(n))
    if not support or not all(is_whole(n) for n in entries):
        raise InputError(f"a direction is written as k=(1,-2): got {text!r}")
    return support


def _axes_of(parameters: str, text: str) -> tuple[int, ...]:
    """The axes of a Bernoulli integrand, 1-based; the first alone unless told."""
    axes = _values(parameters, "axes", ["1"])
    if not axes or not all(is_whole(n) and int(n) >= 1 for n in axes):
        raise InputError(f"axes are written as axes=(1,3): got {text!r}")
    return tuple(int(n) for n in axes)


def _short_sides(parameters: str, text: str) -> tuple[int, ...]:
    """The 1-based coordinates in which a box with a side for each does not fill the torus."""
    sides = [parse_expression(v) for v in _values(parameters, "side", [])]
    short = tuple(i + 1 for i, side in enumerate(sides) if side != 1)
    if sides and not short:
        raise InputError(f"some side of a box must be below 1: got {text!r}")
    return short if len(sides) > 1 else ()


def _values(parameters: str, key: str, default: list[str]) -> list[str]:
    """The values of ``key=(value,value)`` or ``key=value``."""
    found = re.search(rf"(?:^|,)\s*{key}\s*=\s*(?:\(([^)]*)\)|([^,]*))", parameters)
    if found is None:
        return default
    listed = found[1] or found[2] or ""
    return [v.strip() for v in listed.split(",") if v.strip()]


def shell_exponent(decay: Decay, layout: Layout, region: Region, flat: int = 0) -> Expr | None:
    """q on a region: oo where nothing lies beyond ρ0, None where the class has no power at all.

    Parameters
    ----------
    flat : int
        Dimension of the flats that sample the integrand: 0 for points, 1 for lines. The
        spectrum is then the slice of one of ``flat`` more dimensions (ball: p = d + flat + 1).

    Raises
    ------
    InputError
        If p does not exceed the region's dimension (the integrand would not be in L²), or a
        disk is asked for outside two dimensions.
    """
    s, number = region.dimension, decay.number or Integer(1)  # a jump is k = 1
    if decay.family in _SMOOTH:
        return sympy.oo
    if decay.family in _JUMPS:
        return Integer(1) if _lies_in(layout, region, decay.axes) else None
    if decay.family in ("ball", "disk", "chord"):
        full = layout.dim + flat + (1 if decay.family == "chord" else 0)
        if decay.family == "disk" and full != 2:
            raise InputError(f"a disk needs --dim 2 (use ball): got {full}")
        return sympy.expand(full + 1 - s)
    if decay.family in ("p", "per region"):
        p = number if decay.family == "p" else _named_power(decay, layout, region)
        if p is None or p is sympy.oo:
            return p
        if not nonnegative(p - s, region.assumptions) or p == s:
            raise InputError(f"p must exceed the support size s: got p = {p}, s = {s}")
        return p - s
    if decay.family == "product":
        return 2 * number - 1
    if decay.family == "additive":
        return 2 * number - 1 if s == 1 else None
    if not _holds_support(layout, region, decay.axes):
        return None
    return number - 1 if decay.family == "polylog" else 2 * number - 1


def _named_power(decay: Decay, layout: Layout, region: Region) -> Expr | None:
    """p of the first name that holds the region; None if none does."""
    for name, p in decay.powers:
        if any(r.counts == region.counts for r in select(layout, name)):
            return p
    return None


def _lies_in(layout: Layout, region: Region, axes: tuple[int, ...]) -> bool:
    """Whether some support of the region has coordinates among these alone; none: all.

    Flats average over the coordinates beyond the layout's.
    """
    if not axes:
        return True
    sampled = tuple(a for a in axes if not layout.dim.is_Integer or a <= layout.dim)
    if not sampled:
        return False
    held = region_of_support(layout, sampled).counts
    return all(
        nonnegative(h - c, region.assumptions) for h, c in zip(held, region.counts, strict=True)
    )


def _holds_support(layout: Layout, region: Region, axes: tuple[int, ...]) -> bool:
    """Whether the one support that carries power lies in the region."""
    if layout.dim.is_Integer:
        return region_of_support(layout, axes).counts == region.counts
    if axes != (1,):
        raise InputError(f"axes other than 1 need a number as dimension: got {axes}")
    return region.counts[0] == 1 and region.dimension == 1
