"""Where raw points come from: a callable, a scipy QMC engine, or point files.

`load_source` reads the words that name a source in this process; every source then draws
realisations of N points by its `realise`. Unusable words are an `InputError`. A sampler that
misbehaves is a `SamplerFault`: not an unusable input but a finding about the sampler.
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

from ...theory.errors import InputError
from ..streams import stream
from .imports import RAISED, load_attribute, one_line
from .pointfiles import POINT_SUFFIXES, read_points
from .realisations import SamplerFault, checked, nearby_powers, not_honoured

Kind = Literal["callable", "engine", "file", "command"]


class Source(Protocol):
    """What all sources have in common."""

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
        """Raw realisations, shape (len(replicates), n, dim); only the first before a deadline."""
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
        tried = nearby_powers(n, self.dim)
        for power in tried:
            if self._refusal(power) is None:
                return power
        raise not_honoured(self.name, n, tried, refusal) from refusal

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
            points[index] = checked(raw, n, self.dim, replicate)
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
            points[index] = checked(raw, n, self.dim, replicate)
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
        chosen = [checked(stored[r], n, self.dim, r) for r in replicates]
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
    if all(is_file_word(word) for word in words):
        return _load_files(words, dim)
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


def is_file_word(word: str) -> bool:
    """Whether a word names a point file, by its suffix."""
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
