"""What a fault of a sampler is: its kind, one line, the evidence, and the nearest remedy."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from .realisations import SamplerFault

Evidence = Mapping[str, Any]

_DRAW = "draw every number from the generator (of a command: the seed) that comes with the call"
_SHIFT = "jitter inside the strata, or shift each realisation by one uniform random vector modulo 1"


@dataclass(frozen=True)
class Fault:
    """One fault: its kind, one line for the reader, and JSON-able evidence.

    Evidence counts realisations from 0 and axes from 1.
    """

    kind: str
    detail: str
    evidence: dict[str, Any]

    @property
    def remedy(self) -> str:
        """The nearest change that mends it.

        Raises
        ------
        KeyError
            If the kind is unknown.
        """
        found = REMEDIES[self.kind]
        return found if isinstance(found, str) else found(self.evidence)


def fault_of(raised: SamplerFault) -> Fault:
    """The fault that a source has raised."""
    return Fault(raised.kind, raised.detail, raised.evidence)


def _shape(evidence: Evidence) -> str:
    if evidence["got"] == evidence["asked"][::-1]:
        return "return the transpose: one point a row, one coordinate a column"
    return "return an array of shape (n, dim): one point a row, one coordinate a column"


def _count(evidence: Evidence) -> str:
    other = "give n points, or refuse n: by ValueError or admissible(n), a command by an exit code"
    return f"ask for N = {evidence['nearest']}; else {other}" if "nearest" in evidence else other


def _outside(evidence: Evidence) -> str:
    if evidence["value"] == 1.0:
        return "map the end 1 to 0, for [0, 1) is a torus; rounding up makes such a 1 too"
    return "reduce coordinates modulo 1, or scale them to [0, 1)"


def _piled(evidence: Evidence) -> str:
    if not any(evidence["location"]):
        return "fill every row of the array that is returned: rows were left at the origin"
    return "draw a new place for every point, or jitter each point inside its own stratum"


def _repeated(evidence: Mapping[str, Any]) -> str:
    if evidence["value"] == 0:
        return "fill every row of the array that is returned: coordinates were left at 0"
    return "reduce coordinates modulo 1 instead of clamping them"


def _quantised(evidence: Evidence) -> str:
    spacing = evidence["spacing"]
    if evidence["strata"] is not None:
        return _SHIFT
    if spacing in (2.0**-24, 2.0**-23):
        return "draw in double precision (dtype float64)"
    return "draw in double precision, and write files with 17 significant digits"


def _hangs(evidence: Evidence) -> str:
    if "n" not in evidence:
        return "let the module do nothing long when it is imported"
    return f"run the sampler alone with n = {evidence['n']}; if it does end, give a larger --budget"


def _alone(evidence: Evidence) -> str:
    if "n" not in evidence:
        return "import the module alone, and mend what ends it"
    return f"run the sampler alone with n = {evidence['n']}, and mend what ends it"


REMEDIES: Mapping[str, str | Callable[[Evidence], str]] = {
    "exception": lambda e: (
        f"run the sampler alone with n = {e['n']}, and mend what it raises; for an n that cannot "
        "be honoured raise ValueError, or carry admissible(n)"
    ),
    "type": "return one array of real numbers of shape (n, dim), without weights or masks; a "
    "command prints one point a line, and nothing else",
    "shape": _shape,
    "count": _count,
    "not honoured": "ask for an N that the sampler honours, or let it carry admissible(n)",
    "not finite": "look for a division by zero or the logarithm of zero where this row is made",
    "outside": _outside,
    "hangs": _hangs,
    "crashes": _alone,
    "memory": "hold fewer or smaller arrays at once, or ask for a smaller N",
    "global random state": _DRAW,
    "duplicate realisations": f"{_DRAW}; a fixed point set goes into a point file, one for each N, "
    "and is then homogenised by random shifts",
    "piled points": _piled,
    "repeated values": _repeated,
    "quantised coordinates": _quantised,
    "bias": _SHIFT,
    "not homogenised": "shift each realisation by one uniform random vector modulo 1",
}
"""By kind: the remedy, or what tells it from the evidence."""
