"""Integrands on all of R^d, not made periodic: the ball and the Gaussian, by |Ff(ν)|².

Eq. 4 and Eq. 17 integrate over all real frequencies, where the torus sums over integers. On R^d

    ball |x| <= R:                     |Ff(ν)|² = (R/ρ)^d J_{d/2}(2πRρ)²,  ρ = |ν|  (Bochner);
    Gaussian exp(−Σ_i x_i²/(2σ_i²)):   |Ff(ν)|² = ∏_i 2πσ_i² exp(−4π²σ_i²ν_i²).

At integer frequencies both are the powers of their periodic sums.
"""

from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from ...theory.errors import InputError
from ..integrands.ball import Ball as TorusBall
from ..integrands.gaussian import GaussianFactor
from ..integrands.protocol import Integrand


@dataclass(frozen=True)
class SpaceBall:
    """Indicator of the ball |x| <= R.

    Parameters
    ----------
    dim : int
        d >= 1.
    radius : Fraction
        R > 0.
    """

    dim: int
    radius: Fraction

    def __post_init__(self) -> None:
        if self.dim < 1:
            raise InputError(f"a ball must satisfy 1 <= dim: got {self.dim}")
        if not self.radius > 0:
            raise InputError(f"a ball must satisfy 0 < radius: got {self.radius}")


@dataclass(frozen=True)
class SpaceGaussian:
    """exp(−Σ_i x_i²/(2σ_i²)).

    Parameters
    ----------
    sigmas : tuple of Fraction, length d
        Widths σ_i > 0.
    """

    sigmas: tuple[Fraction, ...]

    def __post_init__(self) -> None:
        if not self.sigmas:
            raise InputError("a gaussian must satisfy 1 <= dim: got 0")
        for sigma in self.sigmas:
            if not sigma > 0:
                raise InputError(f"a gaussian must satisfy 0 < sigma: got {sigma}")

    @property
    def dim(self) -> int:
        """The dimension d."""
        return len(self.sigmas)

    @property
    def is_isotropic(self) -> bool:
        """Whether all widths agree."""
        return len(set(self.sigmas)) == 1


SpaceIntegrand: TypeAlias = SpaceBall | SpaceGaussian


def on_space(integrand: Integrand) -> SpaceIntegrand:
    """The function on R^d of which a torus integrand is the sum over integer translates.

    Raises
    ------
    InputError
        If it is neither a ball nor a Gaussian.
    """
    if isinstance(integrand, TorusBall):
        return SpaceBall(integrand.dim, integrand.radius)
    part = integrand.parts[0] if len(integrand.parts) == 1 else ()
    sigmas = tuple(f.sigma for _, f in part if isinstance(f, GaussianFactor))
    if len(sigmas) < integrand.dim:
        raise InputError(f"an integrand on R^d must be a ball or a gaussian: got {integrand.name}")
    return SpaceGaussian(sigmas)
