"""Where raw points come from: a callable, a scipy QMC engine, or point files.

`load_source` reads the words that name a source; every source then draws realisations of N points
by its `realise`, which checks each one in the order type, shape, count, not finite, outside.
Unusable words are an `InputError`. A sampler that misbehaves is a `SamplerFault`: not an unusable
input but a finding about the sampler.

Evidence counts realisations and rows from 0, as arrays do, and axes from 1, as regions do.
"""

import contextlib
import inspect
import operator
import traceback
from collections.abc import Callable, Generator, Mapping
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Literal, Protocol, cast

import numpy as np
from numpy.typing import NDArray

from ..theory.errors import InputError
from .imports import RAISED, load_attribute, one_line
from .pointfiles import POINT_SUFFIXES, read_points
from .streams import stream

Kind = Literal["callable", "engine", "file"]


class SamplerFault(Exception):
    """The sampler itself misbehaves.

    Parameters
    ----------
    kind : str
        ``exception``, ``type``, ``shape``, ``count``, ``not finite`` or ``outside``.
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


class Source(Protocol):
    """What the three kinds of source have in common."""

    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> Kind: ...
    @property
    def dim(self) -> int: ...
    @property
    def counts(self) -> tuple[int, ...] | None:
        """The only N there are, in increasing order; None for any N."""
        ...

    @property
    def realisations(self) -> Mapping[int, int] | None:
        """How many realisations there are of each N; None for any number."""
        ...

    def admissible(self, n: int) -> int:
        """Nearest number of points that the source honours, for n >= 1."""
        ...

    def realise(self, n: int, seed: int, replicates: range) -> NDArray[np.float64]:
        """Raw realisations, shape (len(replicates), n, dim)."""
        ...


@dataclass(frozen=True)
class CallableSource:
    """A callable of (n, dim, rng), with rng = stream(seed, n, replicate)."""

    name: str
    function: Callable[[int, int, np.random.Generator], object]
    dim: int
    kind: Kind = "callable"
    counts: None = None
    realisations: None = None

    def admissible(self, n: int) -> int:
        """By the callable's own ``admissible``; else n, or the nearest power that it accepts."""
        own = getattr(self.function, "admissible", None)
        if own is not None:
            with _sampler_call(self.name, n):
                answer = own(n)
            return _point_count(answer, n)
        refusal = self._refusal(n)
        if refusal is None:
            return n
        for power in _nearby_powers(n, self.dim):
            if self._refusal(power) is None:
                return power
        raise refusal

    def _refusal(self, n: int) -> SamplerFault | None:
        """The fault, if a trial call raises ValueError; any other exception is raised."""
        try:
            with _sampler_call(self.name, n):
                self.function(n, self.dim, stream(0, n, 0))
        except SamplerFault as fault:
            if isinstance(fault.__cause__, ValueError):
                return fault
            raise
        return None

    def realise(self, n: int, seed: int, replicates: range) -> NDArray[np.float64]:
        """One call for each replicate; results are copied, for a callable may reuse its buffer."""
        points = np.empty((len(replicates), n, self.dim))
        for index, replicate in enumerate(replicates):
            with _sampler_call(self.name, n, replicate):
                raw = self.function(n, self.dim, stream(seed, n, replicate))
            points[index] = _checked(raw, n, self.dim, replicate)
        return points


@dataclass(frozen=True)
class EngineSource:
    """A scipy QMC engine class, built afresh for each realisation from its own stream."""

    name: str
    engine: type[Any]
    dim: int
    kind: Kind = "engine"
    counts: None = None
    realisations: None = None

    def admissible(self, n: int) -> int:
        """Nearest power of two for Sobol', whose balance needs it; else n."""
        if not _derives_from_scipy(self.engine, "Sobol"):
            return n
        below = 1 << (n.bit_length() - 1)
        return below if n - below <= 2 * below - n else 2 * below

    def realise(self, n: int, seed: int, replicates: range) -> NDArray[np.float64]:
        """One engine and one call of its ``random(n)`` for each replicate."""
        keyword = _random_keyword(self.name, self.engine)
        points = np.empty((len(replicates), n, self.dim))
        for index, replicate in enumerate(replicates):
            rng = {keyword: stream(seed, n, replicate)}
            with _sampler_call(self.name, n, replicate):
                raw = self.engine(d=self.dim, **rng).random(n)
            points[index] = _checked(raw, n, self.dim, replicate)
        return points


@dataclass(frozen=True, eq=False)
class FileSource:
    """Points read from files: for each N an array (m, N, dim) of all its realisations."""

    name: str
    points: Mapping[int, NDArray[np.float64]]
    dim: int
    kind: Kind = "file"

    @property
    def counts(self) -> tuple[int, ...]:
        return tuple(sorted(self.points))

    @property
    def realisations(self) -> dict[int, int]:
        return {n: len(self.points[n]) for n in self.counts}

    def admissible(self, n: int) -> int:
        """Nearest N in the files, the smaller of two."""
        return min(self.counts, key=lambda count: (abs(count - n), count))

    def realise(self, n: int, seed: int, replicates: range) -> NDArray[np.float64]:
        """The realisations that `replicates` counts from 0; the seed has no say."""
        if n not in self.points:
            held = ", ".join(map(str, self.counts))
            raise InputError(f"point files must hold the N asked for ({held}): got {n}")
        stored = self.points[n]
        beyond = [replicate for replicate in replicates if not 0 <= replicate < len(stored)]
        if beyond:
            raise InputError(
                f"a replicate of a point file must be one of its {len(stored)} realisations "
                f"of {n} points, counted from 0: got {beyond[0]}"
            )
        chosen = [_checked(stored[r], n, self.dim, r) for r in replicates]
        return np.array(chosen).reshape(len(replicates), n, self.dim)


def load_source(words: list[str], dim: int) -> Source:
    """Source named by words of the command line; catalogue names are the caller's.

    Parameters
    ----------
    words : list of str
        ``module:callable`` or ``path.py:callable``, with or without ``py:`` in front, where the
        callable may be a scipy QMC engine class; or one or several point files.
    dim : int
        Dimension of the points, at least 1.

    Returns
    -------
    Source
        Nothing is drawn yet, but point files are read.

    Raises
    ------
    InputError
        If the words name nothing usable.
    """
    if dim < 1:
        raise InputError(f"the dimension must be at least 1: got {dim}")
    if not words:
        raise InputError("a source must be named: got no word")
    if all(_is_file_word(word) for word in words):
        return _load_files(words, dim)
    if any(word.startswith("cmd:") for word in words):
        raise InputError(f"commands are not supported yet as sources: got '{' '.join(words)}'")
    if len(words) > 1:
        raise InputError(f"several words must all be point files: got '{' '.join(words)}'")
    return _sampler_source(words[0], dim)


def _sampler_source(word: str, dim: int) -> CallableSource | EngineSource:
    """Source of one Python object, told apart by its type."""
    target = load_attribute(word)
    if isinstance(target, type) and _derives_from_scipy(target, "QMCEngine"):
        if inspect.isabstract(target):
            raise InputError(f"a QMC engine class must not be abstract: got '{word}'")
        _random_keyword(word, target)
        return EngineSource(word, target, dim)
    engine = cast("type[Any]", type(target))
    if _derives_from_scipy(engine, "QMCEngine"):
        raise InputError(
            f"a QMC engine must be given as its class, {engine.__name__}, from which each "
            f"realisation builds its own: got an instance for '{word}'"
        )
    if not callable(target):
        raise InputError(f"a sampler must be callable: got {engine.__name__} for '{word}'")
    own = getattr(target, "admissible", None)
    if own is not None and not callable(own):
        raise InputError(
            f"a sampler's 'admissible' must be callable: got {type(own).__name__} for '{word}'"
        )
    return CallableSource(word, target, dim)


def _is_file_word(word: str) -> bool:
    return not word.startswith(("py:", "cmd:")) and Path(word).suffix.lower() in POINT_SUFFIXES


def _load_files(words: list[str], dim: int) -> FileSource:
    """Files of one N are joined, in the order of the words."""
    parts: dict[int, list[NDArray[np.float64]]] = {}
    for word in words:
        points = read_points(word)
        _, n, columns = points.shape
        if columns != dim:
            raise InputError(f"a point file must have {dim} columns: got {columns} in {word}")
        parts.setdefault(n, []).append(points)
    return FileSource(" ".join(words), {n: np.concatenate(parts[n]) for n in parts}, dim)


def _derives_from_scipy(target: type[Any], name: str) -> bool:
    # By name: whoever uses an engine has imported scipy.stats already, nobody else should pay.
    return any(
        c.__name__ == name and c.__module__.startswith("scipy.stats") for c in target.__mro__
    )


@lru_cache(maxsize=64)
def _random_keyword(name: str, engine: type[Any]) -> str:
    """``rng`` (scipy 1.15 on) or ``seed``, as the signature of the engine has it."""
    for cls in engine.__mro__:
        if "__init__" not in vars(cls):
            continue
        parameters = inspect.signature(cls.__init__).parameters
        for keyword in ("rng", "seed"):
            if keyword in parameters:
                return keyword
        if not any(p.kind is inspect.Parameter.VAR_KEYWORD for p in parameters.values()):
            break
    raise InputError(f"a QMC engine class must take rng= or seed=: got '{name}'")


@contextlib.contextmanager
def _sampler_call(name: str, n: int, replicate: int | None = None) -> Generator[None]:
    """Turn what the sampler raises into a fault with the place where it was raised."""
    try:
        yield
    except RAISED as error:
        frames = traceback.extract_tb(error.__traceback__)
        place = f"{frames[-1].filename}:{frames[-1].lineno}"
        detail = f"{name} must not raise for n = {n}: got {one_line(error)} at {place}"
        evidence = {
            "type": type(error).__name__,
            "message": " ".join(str(error).split()),
            "place": place,
            "n": n,
            "realisation": replicate,
        }
        raise SamplerFault("exception", detail, evidence) from error


def _point_count(answer: Any, n: int) -> int:
    """What a sampler's ``admissible(n)`` gave, if it is a number of points."""
    try:
        nearest = operator.index(answer)
    except TypeError:
        nearest = 0
    if nearest < 1:
        detail = f"admissible({n}) must give a positive whole number: got {str(answer)[:80]}"
        raise SamplerFault("type", detail, {"n": n, "got": str(answer)[:80]})
    return nearest


def _nearby_powers(n: int, dim: int) -> list[int]:
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


def _checked(raw: object, n: int, dim: int, replicate: int) -> NDArray[np.float64]:
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
