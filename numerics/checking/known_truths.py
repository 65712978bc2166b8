"""Designs of known truth: claims that hold, and defects and false claims with what gives them away.

A verdict on a design whose claims hold is right unless it contradicts it or calls it invalid. A
verdict on any other is right if it does so for one of the reasons that are listed with it.
"""

import struct
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from shlex import quote
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...theory.samplers import parse_sampler
from ..point_sources.catalogue_source import CHUNK, CatalogueSource
from ..point_sources.pointfiles import write_text

Document = Mapping[str, Any]
FileWords = Callable[[Path, int], tuple[str, ...]]
"""Writes point files into a folder, from a seed, and names them."""

_DEFECTS = "specrate.numerics.checking.planted_defects"
_ENGINES = "scipy.stats.qmc"
_HELD = 1280  # realisations of each N in point files
_UTK_DOUBLES = 5  # type byte of a UTK .bin


@dataclass(frozen=True)
class KnownTruth:
    """A design, what is claimed of it, and what is true.

    Parameters
    ----------
    name : str
        In words.
    source : str or callable
        The word that names it, or what writes its point files.
    dim : int
    claims : tuple of str
    reasons : tuple of str
        Empty if all claims hold; else those that a verdict against them may give, as `reasons_of`
        writes them.
    counts : tuple of int
        N to measure at; empty: chosen by the check.
    """

    name: str
    source: str | FileWords
    dim: int
    claims: tuple[str, ...]
    reasons: tuple[str, ...] = ()
    counts: tuple[int, ...] = ()

    @property
    def holds(self) -> bool:
        """Whether all claims are true and the sampler has no defect."""
        return not self.reasons

    def words(self, folder: Path, seed: int) -> tuple[str, ...]:
        """The words that name the source; point files are written into the folder."""
        return (self.source,) if isinstance(self.source, str) else self.source(folder, seed)


def reasons_of(document: Document) -> frozenset[str]:
    """What a verdict rests on.

    Returns
    -------
    frozenset of str
        Kinds of faults, alone and as ``bias on axis 2``; of claims that fail ``region 1,2`` for the
        support on which the simplest witness lies, ``variance`` or ``exponent``.
    """
    found: set[str] = set()
    for fault in document["faults"]:
        axes: Sequence[int] = fault["evidence"].get("axes", ())
        found |= {fault["kind"], *(f"{fault['kind']} on axis {axis}" for axis in axes)}
    for witness in (c["witness"] for c in document["claims"] if c["holds"] is False):
        region: str | None = witness.get("region")
        found.add(witness["what"] if region is None else f"region {region}")
    return frozenset(found)


def is_wrong(truth: KnownTruth, verdict: str, reasons: frozenset[str]) -> bool:
    """Whether a verdict is against the truth; ``inconclusive`` never is."""
    is_against = verdict in ("contradicted", "invalid")
    if truth.holds:
        return is_against
    return verdict == "consistent" or (is_against and reasons.isdisjoint(truth.reasons))


def _realisations(name: str, dim: int, n: int, count: int, seed: int) -> NDArray[np.float64]:
    source = CatalogueSource(parse_sampler(name, dim))
    parts = [source.realise(n, seed, range(k, k + CHUNK)) for k in range(0, count, CHUNK)]
    return np.concatenate(parts)[:count]


def _utk_binary(path: Path, points: NDArray[np.float64]) -> None:
    header = struct.pack("<IB3xIII", 0x214B5455, _UTK_DOUBLES, *points.shape)
    path.write_bytes(header + points.astype("<f8").tobytes())


def _csv(path: Path, points: NDArray[np.float64]) -> None:
    labels = np.repeat(np.arange(len(points)), points.shape[1])
    rows = np.column_stack([labels, points.reshape(-1, points.shape[2])])
    names = ["realisation", *(f"x{i}" for i in range(1, points.shape[2] + 1))]
    formats = ["%d", *["%.17g"] * points.shape[2]]
    np.savetxt(path, rows, formats, delimiter=",", header=",".join(names), comments="")


def _files_of_every_format(folder: Path, seed: int) -> tuple[str, ...]:
    """Multi-jitter, each N in another format."""
    writers: Mapping[str, Callable[[Path, NDArray[np.float64]], None]] = {
        "16.txt": write_text,
        "25.csv": _csv,
        "64.npy": np.save,
        "144.bin": _utk_binary,
    }
    for name, write in writers.items():
        n = int(name.partition(".")[0])
        write(folder / name, _realisations("multi-jitter", 2, n, _HELD, seed))
    return tuple(str(folder / name) for name in writers)


def _files_of_one_set(folder: Path, seed: int) -> tuple[str, ...]:
    """UTK binary files whose realisations are all the same set of jittered points."""
    for n in (16, 64):
        one = _realisations("jitter", 2, n, 1, seed)
        _utk_binary(folder / f"{n}.bin", np.repeat(one, 256, axis=0))
    return tuple(str(folder / f"{n}.bin") for n in (16, 64))


def _command(seed: str) -> str:
    """A program that prints jitter in one dimension, from a seed."""
    lines = (
        "from _random import Random",
        f"u = Random({seed}).random",
        "for i in range({n}): print((i + u()) / {n})",
    )
    return f"cmd:{quote(sys.executable)} -I -S -c {quote(chr(10).join(lines))}"


def _true(source: str, dim: int, *claims: str) -> KnownTruth:
    """A catalogue sampler, claimed to be itself unless told."""
    return KnownTruth(source, source, dim, claims or (source,))


def _planted(
    function: str, dim: int, claim: str, *reasons: str, counts: tuple[int, ...] = ()
) -> KnownTruth:
    source = f"{_DEFECTS}:{function}"
    return KnownTruth(function.replace("_", " "), source, dim, (claim,), reasons, counts)


def _false(source: str, dim: int, claim: str, *reasons: str) -> KnownTruth:
    """A sampler without a defect, of which something else is claimed."""
    return KnownTruth(source.rpartition(":")[2] if "." in source else source, source, dim,
                      (claim,), reasons)  # fmt: skip


HOLDING = (
    _true("random", 2),
    _true("jitter", 1),
    _true("jitter", 2),
    _true("jitter", 3),
    _true("jitter:2x8", 2),
    _true("latin-hypercube", 2),
    _true("latin-hypercube", 10),
    KnownTruth("scipy's LatinHypercube", f"{_ENGINES}:LatinHypercube", 2, ("latin-hypercube",)),
    _true("multi-jitter", 2),
    _true("correlated-multi-jitter", 2),
    _true("uncorrelated-jitter:1+2", 3),
    _true("cloaked:1/2", 1),
    _true("cloaked:3/2", 2),
    _true("box-dpp", 1),
    _true("difference-jitter", 1),
    KnownTruth("multi-jitter, files of all formats", _files_of_every_format, 2, ("multi-jitter",)),
    KnownTruth("jitter, a command", _command("{seed}"), 1, ("jitter",), counts=(16,)),
    KnownTruth("scipy's Sobol", f"{_ENGINES}:Sobol", 2, ("axis/worst ~ 2", "overall/disk ~ 3/2")),
    _true("random", 2, "overall/disk:radius=0.02 ~ 1"),
    _true("jitter", 2, "overall/gaussian:sigma=0.03 ~ 2"),
    _true("multi-jitter", 2, "overall/disk ~ 3/2"),
    _true("latin-hypercube", 2, "overall/anisotropic-gaussian:sigma=(1/10,2/5) ~ 1"),
)
"""Designs whose claims are true.

On an axis two points of a scrambled Sobol' net lie as two of 1D jitter do. The disk has in the
Haar wavelets of cells 2^-j x 2^-k, j >= k, the energy 2^(k - 2j), of which a net leaves those with
2^(j + k) > N: in all N^(-1/2), so that the variance falls as N^(-3/2).
"""

FAILING = (
    _planted("half_jitter", 2, "jitter", "region 2"),
    _planted("halved_jitter", 2, "jitter", "bias on axis 2"),
    _planted("halved_jitter_shifted", 2, "jitter", "region 2"),
    _planted("wide_jitter", 2, "jitter", "region 1", "region 2"),
    _planted("sheared_jitter", 2, "jitter", "region 2", "region 1,2"),
    _planted("shared_permutation", 4, "uncorrelated-jitter:2+2", "region 1,3", "region 2,4"),
    _planted("diagonal_rooks", 2, "latin-hypercube", "region 1,2", "not homogenised"),
    _planted("centred_rooks", 2, "latin-hypercube", "bias on axis 1"),
    _planted("rooks_between_ends", 2, "latin-hypercube", "bias on axis 1", "region 1", "region 2"),
    _planted("rooks_short_of_one", 2, "latin-hypercube", "region 1", "region 2"),
    _planted("unshuffled_multi_jitter", 2, "multi-jitter", "region 1,2", "not homogenised"),
    _planted("stratified_sum", 3, "random", "region 1,2,3"),
    _planted("stratified_sum", 10, "random", "region 1,2,3"),
    _planted("lattice_without_seed", 2, "latin-hypercube", "duplicate realisations"),
    _planted("few_seeds", 2, "latin-hypercube", "duplicate realisations"),
    _planted("single_precision", 2, "random", "quantised coordinates on axis 1"),
    _planted("rows_at_the_origin", 2, "random", "piled points", counts=(60,)),
    KnownTruth("jitter, files of one set", _files_of_one_set, 2, ("jitter",),
               ("duplicate realisations",)),
    KnownTruth("jitter, a command with one seed", _command("7 or {seed}"), 1, ("jitter",),
               ("duplicate realisations",), counts=(16,)),
    _false(f"{_ENGINES}:Sobol", 2, "jitter", "region 1", "region 2", "variance"),
    _false(f"{_ENGINES}:Sobol", 2, "overall/disk ~ 2", "exponent"),
    _false("random", 2, "latin-hypercube", "region 1"),
    _false("latin-hypercube", 2, "multi-jitter", "region 1,2"),
    _false("multi-jitter", 2, "correlated-multi-jitter", "region 1,2"),
    _false("uncorrelated-jitter:1+2", 3, "uncorrelated-jitter:2+1", "region 1", "region 3"),
    _false("cloaked:1/2", 1, "cloaked:3/2", "region 1"),
    _false("random", 2, "overall/disk ~ 3/2", "exponent"),
    _false("jitter", 2, "axis/best ~ 3", "exponent"),
)  # fmt: skip
"""Planted defects and false claims. That a scrambled net were isotropic: its spectrum of jitter,
which is so at low frequencies, or the disk at the rate that its axes alone would give. (The net's
|F|² on an axis has heavy tails: with few realisations only a variance is decided.)"""

TRUTHS = (*HOLDING, *FAILING)
