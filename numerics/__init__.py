"""What is computed or measured: spectra, variances, point sets, moments, verdicts."""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .checking.check_documents import check
    from .equation17.radial_integrals import radial
    from .exact_variances.variances import variance
    from .falsification.falsifiers import falsify

__all__ = ["check", "falsify", "radial", "variance"]

_DOORS = {
    "check": ".checking.check_documents",
    "falsify": ".falsification.falsifiers",
    "radial": ".equation17.radial_integrals",
    "variance": ".exact_variances.variances",
}


def __getattr__(name: str) -> Any:
    """Load a door's module when it is first used: ball arithmetic costs nothing to a check."""
    if name not in _DOORS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module(_DOORS[name], __name__), name)
