"""What is exactly true: orders, regions, kernels, profiles, Eq. 17, rates, derivations."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .derivations import derive
    from .recommendations import recommend
    from .tables import table

__all__ = ["derive", "recommend", "table"]

_DOORS = {"derive": ".derivations", "recommend": ".recommendations", "table": ".tables"}


def __getattr__(name: str) -> Any:
    """Load a door's module when it is first used: a drawn realisation needs no symbols."""
    if name not in _DOORS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_DOORS[name], __name__), name)
