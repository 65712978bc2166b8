"""Witnesses: one integrand at one N that shows a claim on a sampler to be wrong."""

from dataclasses import dataclass

from ..measuring.moments import Interval
from ..measuring.probes import Frequency


@dataclass(frozen=True)
class Witness:
    """What contradicts a claim, as simple as it was found.

    Parameters
    ----------
    source : str
    claim : str
    dim : int
    n : int
        Number of points.
    frequency : tuple of int
        Lowest frequency at which the integrand has power; () where it has no single one.
    integrand : str
        In the grammar of integrands: ``ridge:k=(1,1)``.
    quantity : str
        What was measured: ``variance``, ``N P_S(k)`` or ``exponent``.
    measured : Interval
        On fresh realisations, at the level that ``false_alarm`` allows; a single number where
        it is exact.
    predicted : float
        What the claim says.
    false_alarm : float
        Bound on the probability that the whole search contradicts a correct claim, as far as
        the intervals keep their level; 0 where all is exact.
    realisations : int
        Fresh ones behind ``measured``, at each N; 0 where it is exact.
    detail : str
        How the prediction came about, or what excludes it.
    """

    source: str
    claim: str
    dim: int
    n: int
    frequency: Frequency
    integrand: str
    quantity: str
    measured: Interval
    predicted: float
    false_alarm: float
    realisations: int
    detail: str = ""

    @property
    def is_exact(self) -> bool:
        """Whether no random number was drawn."""
        return self.realisations == 0

    def __str__(self) -> str:
        value, low, high = self.measured
        shown = f"{value:.4g}" if self.is_exact else f"{value:.4g} in [{low:.4g}, {high:.4g}]"
        basis = (
            "exact"
            if self.is_exact
            else f"{self.realisations} fresh realisations, false alarm {self.false_alarm:.0e}"
        )
        words = (
            f"{self.source} is not {self.claim}: {self.quantity} of {self.integrand} "
            f"in {self.dim}D, N = {self.n}: {shown}, claimed {self.predicted:.4g} ({basis})"
        )
        return f"{words}; {self.detail}" if self.detail else words
