"""What is exactly true: orders, regions, kernels, profiles, Eq. 17, rates, derivations."""

from .derivations import derive
from .tables import table

__all__ = ["derive", "table"]
