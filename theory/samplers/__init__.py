"""The sampler catalogue: an explicit list of families, and the grammar of their names."""

from ..errors import InputError
from ..signs import Assumptions, at_least
from ..symbolic import Expr, Integer
from .box_dpp import box_dpp
from .cloaked import cloaked
from .correlated_multi_jitter import correlated_multi_jitter
from .definition import Family, Sampler
from .difference_jitter import difference_jitter
from .isotropic import isotropic
from .jitter import jitter
from .latin_hypercube import latin_hypercube
from .multi_jitter import multi_jitter
from .random import random
from .regular import regular
from .uncorrelated_jitter import uncorrelated_jitter

__all__ = ["FAMILIES", "FURTHER_FAMILIES", "Family", "Sampler", "parse_sampler"]


FAMILIES = (
    Family("random", random),
    Family("regular", regular, "25x40"),
    Family("jitter", jitter, "25x40"),
    Family("latin-hypercube", latin_hypercube, aliases=("n-rooks",)),
    Family("multi-jitter", multi_jitter, "8x16"),
    Family("correlated-multi-jitter", correlated_multi_jitter, "8x16", smallest_dim=2),
    Family("uncorrelated-jitter", uncorrelated_jitter, "1+2+3"),
    Family("isotropic", isotropic, "b"),
)
"""Those of the default tables: spectra made of sinc² and combs, as the paper's are."""

FURTHER_FAMILIES = (
    Family("box-dpp", box_dpp, "25x40"),
    Family("cloaked", cloaked, "1/2"),
    Family("difference-jitter", difference_jitter),
)
"""Spectra of other shapes, with degrees other than 0 and 2: 1, any in (0, 2], and 4."""


def family_of(text: str) -> Family | None:
    """The family that a sampler's text names, if any."""
    name = text.partition(":")[0].strip()
    everything = (*FAMILIES, *FURTHER_FAMILIES)
    return next((f for f in everything if name == f.name or name in f.aliases), None)


def parse_sampler(text: str, dim: Expr | int) -> Sampler:
    """The sampler written as ``family`` or ``family:parameter``.

    Parameters
    ----------
    text : str
        Grammar: ``random``, ``regular``, ``jitter``, ``jitter:25x40``, ``latin-hypercube``,
        ``n-rooks``, ``multi-jitter:8x16``, ``correlated-multi-jitter``,
        ``uncorrelated-jitter:1+2+3``, ``isotropic:b``, ``box-dpp``, ``cloaked:1/2``, ...
    dim : int or sympy.Expr
        Dimension, a number or an expression in one symbol such as d or d - 1.

    Raises
    ------
    InputError
        If there is no such family, or the parameter does not fit the dimension.
    """
    family = family_of(text)
    if family is None:
        names = ", ".join(f.name for f in (*FAMILIES, *FURTHER_FAMILIES))
        raise InputError(f"a catalogue sampler is one of {names}: got {text!r}")
    size = Integer(dim) if isinstance(dim, int) else dim
    if size.is_number and (not size.is_Integer or size < family.smallest_dim):
        raise InputError(f"{family.name} needs --dim of at least {family.smallest_dim}: got {size}")
    assumptions: Assumptions = ()
    if not size.is_number:
        assumptions = (at_least(size, max(2, family.smallest_dim)),)
    return family.build(text.partition(":")[2].strip(), size, assumptions)
