"""Leading constants of named integrands: V ~ constant · N^-exponent (log N)^log_power, exactly.

The constants of the classes worst and best are those of the monomial model of Eq. 17, in c_f and ρ0
(``rates.leading_constant``). A named integrand has its own Fourier power, so that with a sampler's
exact spectrum the constant is exact too: ``product_constants.py``, ``ball_constants.py``.
"""

from collections.abc import Iterable
from dataclasses import replace

from .axis_powers import parameters, product_power
from .ball_constants import ball_constant
from .decays import Decay
from .orders import Order
from .primitives import Primitive
from .product_constants import product_constant
from .radial import Leading
from .rates import RegionRate, leading_constant
from .samplers.definition import Sampler
from .shapes import SINC2
from .symbolic import Expr, Integer, sympy

MODELS = ("worst", "best")
"""Classes whose constants are those of a model, in the symbols c_f and rho_0."""


def region_constant(
    sampler: Sampler, rate: RegionRate, decay: Decay, primitive: Primitive
) -> Leading | None:
    """Leading term of the variance on all supports of a region.

    Parameters
    ----------
    sampler : Sampler
    rate : RegionRate
        Of this sampler, class and primitive.
    decay : Decay
        A class or a named integrand. A radius, side or width that its name does not give stays the
        symbol R, a or sigma.
    primitive : Primitive

    Returns
    -------
    Leading or None
        None where no constant is known: symbolic dimensions, segments, integrands that are classes
        only, combs that oscillate with N, counts that do not grow.

    Raises
    ------
    InputError
        If a parameter of a named integrand is no exact number.
    """
    if rate.order is None:
        return None
    if decay.family in MODELS:
        return leading_constant(sampler, rate, decay)
    if not sampler.dim.is_Integer or primitive.name == "segment":
        return None
    if sampler.kernel is not None and not sampler.kernel.shapes <= {SINC2}:
        return None
    if decay.family in ("ball", "disk", "chord"):
        radius = parameters(decay.name).get("radius", (sympy.Symbol("R", positive=True),))[0]
        projected = 1 if decay.family == "chord" else 0  # a chord is the ball seen by lines
        return ball_constant(sampler, rate, radius, primitive.flat + projected)
    return _product(sampler, rate, decay, primitive.flat)


def _product(sampler: Sampler, rate: RegionRate, decay: Decay, flat: int) -> Leading | None:
    """A product integrand, averaged along its last axes where flats sample it."""
    dim = int(sampler.dim)
    power = product_power(decay, dim + flat)
    if power is None:
        return None
    found = product_constant(sampler, rate.region, replace(power, axes=power.axes[:dim]))
    along = sympy.prod([axis.mean_square for axis in power.axes[dim:]])
    if found is None or found.order != rate.order or along == 0:
        return None
    return Leading(found.order, found.constant * along)


def summed_constant(parts: Iterable[Leading | None], order: Order) -> Expr | None:
    """Sum of the constants of terms that are all of one order; None if one is not known."""
    total = Integer(0)
    for part in parts:
        if part is None or part.order != order:
            return None
        total = total + part.constant
    return total
