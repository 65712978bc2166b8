"""One realisation: what a sampler returned, checked, or the fault that it shows.

The checks come in the order type, shape, count, not finite, outside. Here too are the numbers of
points that are tried where a sampler refuses the one asked for.

Evidence counts realisations and rows from 0, as arrays do, and axes from 1, as regions do.
"""

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray


class SamplerFault(Exception):
    """The sampler itself misbehaves.

    Parameters
    ----------
    kind : str
        ``exception``, ``type``, ``shape``, ``count``, ``not finite``, ``outside`` or ``not
        honoured``; of a child process also ``hangs``, ``crashes`` or ``memory``.
    detail : str
        One line that gives the rule and then what was got.
    evidence : dict
        JSON-able values from which the fault can be seen again.
    """

    def __init__(self, kind: str, detail: str, evidence: dict[str, Any]) -> None:
        super().__init__(kind, detail, evidence)
        self.kind = kind
        self.detail = detail
        self.evidence = evidence

    def __str__(self) -> str:
        return f"{self.kind}: {self.detail}"


def not_honoured(name: str, n: int, tried: list[int], refusal: SamplerFault) -> SamplerFault:
    """The fault of a sampler that refuses n and every number near it."""
    near = ", ".join(map(str, tried))
    _, _, got = refusal.detail.partition(": got ")
    detail = f"{name} must honour n = {n} or one near it ({near}): got {got}"
    return SamplerFault("not honoured", detail, {**refusal.evidence, "tried": tried})


def nearby_powers(n: int, dim: int) -> list[int]:
    """Squares, cubes, ... dim-th powers and powers of two near n, nearest first."""
    found: set[int] = {1 << (n.bit_length() - 1), 1 << n.bit_length()}
    for power in range(2, dim + 1):
        root = 1
        while (root + 1) ** power <= n:
            root += 1
        found |= {root**power, (root + 1) ** power}
    # One point tells nothing, and a far power of a high dimension would fill the memory.
    near = (c for c in found if c > 1 and c != n and c <= max(16 * n, 65536))
    return sorted(near, key=lambda c: (abs(c - n), c))


def checked(raw: object, n: int, dim: int, replicate: int) -> NDArray[np.float64]:
    """One realisation as float64, or the first fault: type, shape, count, not finite, outside."""
    points = _real_array(raw, replicate)
    if points.ndim != 2 or points.shape[1] != dim:
        raise SamplerFault(
            "shape",
            f"a realisation must have shape ({n}, {dim}): got {points.shape}",
            {"realisation": replicate, "asked": [n, dim], "got": list(points.shape)},
        )
    if len(points) != n:
        raise SamplerFault(
            "count",
            f"a realisation must have the {n} points asked for: got {len(points)}",
            {"realisation": replicate, "asked": n, "got": len(points)},
        )
    for kind, rule, bad in (
        ("not finite", "be finite", ~np.isfinite(points)),
        ("outside", "lie in [0, 1)", (points < 0) | (points >= 1)),
    ):
        if bad.any():
            row, axis = (int(i) for i in np.argwhere(bad)[0])
            value = float(points[row, axis])
            where = f"axis {axis + 1}, row {row} of realisation {replicate}"
            evidence = {"realisation": replicate, "row": row, "axis": axis + 1}
            shown = value if np.isfinite(value) else str(value)  # JSON has no nan
            evidence |= {"value": shown, "values": int(bad.sum())}
            raise SamplerFault(kind, f"coordinates must {rule}: got {value!r} on {where}", evidence)
    return points


def _real_array(raw: object, replicate: int) -> NDArray[np.float64]:
    """Array of real numbers. Masks and weights would be lost in silence: both are refused."""
    got = type(raw).__name__
    try:
        if isinstance(raw, np.ma.MaskedArray) or _is_weighted(raw):
            raise TypeError
        array = np.asarray(raw)
        got += f" of {array.dtype}"
        if array.dtype.kind not in "fiu":
            raise TypeError
    except Exception as error:  # a foreign array type may raise anything on its conversion
        raise SamplerFault(
            "type",
            f"a realisation must be an array of real numbers, without weights: got {got}",
            {"realisation": replicate, "got": got},
        ) from error
    return array.astype(np.float64)


def _is_weighted(raw: object) -> bool:
    """A tuple (points, weights)."""
    return isinstance(raw, tuple) and any(
        getattr(part, "ndim", 0) == 2 for part in cast("Any", raw)
    )
