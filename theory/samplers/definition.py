"""What the catalogue knows of a sampler and its family: layout, exact spectrum, admissible N."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from ..kernels import Kernel
from ..layouts import Layout
from ..profiles import SaturatingMonomial
from ..signs import Assumptions
from ..symbolic import Expr


@dataclass(frozen=True)
class Sampler:
    """A catalogue sampler in a given dimension.

    Parameters
    ----------
    name : str
        Canonical text in the grammar of samplers, which reads back to the same sampler.
    family : str
        The part of the name before the colon.
    layout : Layout
        Groups of axes, blocks and growth laws.
    kernel : Kernel or None
        N·P_S, exact for the counts that ``counts_at`` gives; None for a free profile.
    counts_at : callable or None
        ``counts_at(N)`` gives the counts of the kernel at the admissible N nearest to the one
        asked for (they hold ``N``); None if there is nothing to sample or sizes are symbolic.
    free_profile : tuple of SaturatingMonomial
        Given instead of a kernel (``isotropic:b``).
    reference : str
        Where the sampler and its spectrum come from.
    """

    name: str
    family: str
    layout: Layout
    kernel: Kernel | None
    counts_at: Callable[[int], Mapping[str, int]] | None = field(compare=False, hash=False)
    reference: str
    free_profile: tuple[SaturatingMonomial, ...] = ()

    @property
    def dim(self) -> Expr:
        """The dimension d."""
        return self.layout.dim


@dataclass(frozen=True)
class Family:
    """A family of samplers: its name, how it is built, and an example of its parameter."""

    name: str
    build: Callable[[str, Expr, Assumptions], Sampler]
    example: str = ""
    smallest_dim: int = 1
    aliases: tuple[str, ...] = ()
