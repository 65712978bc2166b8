"""What a sampler places: points, parallel lines and k-flats, or parallel segments.

N parallel k-flats in d dimensions are N points in d − k dimensions that sample the integrand
averaged along the flat, whose spectrum is the slice m·l = 0 of the original (paper, Eq. 15b with
its Jacobian mended to ρ^(d−k−1)). A curved body keeps p = d + 1 on the slice and so gains
smoothness, q = k + 1; a body with faces along the flat does not: the worst class stays at q = 1.

Segments of length < 1 along the last axis sample in all d dimensions; supports that hold this
axis are multiplied by sinc², whose mean over a sphere falls as 1/ρ, the others are not. The
worst class again does not gain (faces along the segment).
"""

from dataclasses import dataclass

from .decays import Decay, shell_exponent
from .errors import InputError
from .expressions import is_whole
from .layouts import Layout
from .regions import Region
from .symbolic import Expr, Integer, sympy


@dataclass(frozen=True)
class Primitive:
    """``point``, ``line``, ``segment`` or ``K-flat``; ``flat`` is the dimension averaged away."""

    name: str
    flat: int


def parse_primitive(text: str) -> Primitive:
    """The primitive that the grammar names.

    Raises
    ------
    InputError
        If it names none.
    """
    word = text.strip()
    if word in ("point", "segment"):
        return Primitive(word, 0)
    if word == "line":
        return Primitive(word, 1)
    head, _, tail = word.partition("-")
    if tail == "flat" and is_whole(head) and int(head) >= 1:
        return Primitive("line" if int(head) == 1 else word, int(head))
    raise InputError(f"a primitive is point, line, segment or K-flat: got {text!r}")


def sampled_dimension(primitive: Primitive, dim: Expr) -> Expr:
    """The dimension in which the sampler places the primitive.

    Raises
    ------
    InputError
        If nothing is left to sample.
    """
    left = dim - primitive.flat
    if left.is_number and left < 1:
        raise InputError(f"{primitive.name} needs --dim above {primitive.flat}: got {dim}")
    return left


def shells(primitive: Primitive, decay: Decay, layout: Layout, region: Region) -> Expr | None:
    """q of an integrand class on a region of the sampled dimensions (see ``shell_exponent``)."""
    q = shell_exponent(decay, layout, region, primitive.flat)
    gains = primitive.name == "segment" and decay.family in ("ball", "disk")
    if q is None or q is sympy.oo or not gains:
        return q
    # Only a support that takes every axis of the last group must hold the segment's axis.
    holds = region.counts[-1] == layout.groups[-1].size
    return q + Integer(1) if holds else q
