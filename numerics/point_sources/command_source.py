"""A command that prints points: ``cmd:prog {n} {dim} {seed}``, run anew for each realisation.

It is run without a shell, with the limits of `child_processes`. It prints text: one point a line,
dim numbers separated by blanks or commas; blank lines and lines that begin with # are skipped.
Binary output is not read.
"""

import contextlib
import shlex
import shutil
import time
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from ...theory.errors import InputError
from ..streams import stream
from .child_processes import (
    Child,
    Failure,
    Limits,
    Overdue,
    Points,
    answer_due,
    crash,
    error_of,
    exit_code,
    failure_of,
    limit_memory,
    overdue,
    receive,
    settled,
    start,
    stop,
)
from .fault_kinds import Fault
from .realisations import SamplerFault, checked, nearby_powers

_NUMBER_BYTES = 40  # of a printed coordinate with its separator, generously
_SLACK_BYTES = 1 << 16
_SEEDS = 1 << 31  # so many fit into a signed integer of 32 bits, which is all that some read
_SPREAD = 0x9E3779B1  # odd, so that different replicates have different seeds


@dataclass(eq=False)
class CommandSource:
    """A command as a source of realisations.

    Parameters
    ----------
    name : str
        The word that names it.
    template : tuple of str
        Its arguments, with ``{n}``, ``{dim}`` and ``{seed}`` in place of the values.
    dim : int
    limits : Limits
    drawn : int
        Realisations that it has printed.
    """

    name: str
    template: tuple[str, ...]
    dim: int
    limits: Limits = Limits()
    drawn: int = 0
    kind: Literal["command"] = "command"
    counts: None = None
    realisations: None = None

    def admissible(self, n: int) -> int:
        """n, or if the command prints other numbers of points or exits with a code, one near n.

        Raises
        ------
        SamplerFault, OutOfTime
            If it fails otherwise, or for every number of points that is tried.
        """
        outcome = self.outcome(n, 0, range(1))
        if not isinstance(outcome, Failure):
            return n
        evidence = outcome.evidence
        tried = [evidence["got"]] if evidence.get("fault") == "count" else []
        if tried or evidence.get("exit", 0) > 0:
            tried += nearby_powers(n, self.dim)
        for near in tried:
            other = self.outcome(near, 0, range(1))
            if not isinstance(other, Failure):
                return near
            if other.kind == "late":
                raise error_of(other)
        raise error_of(outcome)

    def outcome(self, n: int, seed: int, replicates: range) -> Points | Failure:
        """Raw realisations, shape (len(replicates), n, dim), or the first failure among them.

        If the deadline comes between them, those before it.
        """
        points = np.empty((len(replicates), n, self.dim))
        for index, replicate in enumerate(replicates):
            outcome = _one(self, n, seed, replicate)
            if isinstance(outcome, Failure):
                return points[:index] if outcome.kind == "late" and index else outcome
            points[index] = outcome
            self.drawn += 1
        return points

    def realise(self, n: int, seed: int, replicates: range) -> Points:
        """Raw realisations, shape (len(replicates), n, dim).

        Raises
        ------
        SamplerFault, OutOfTime
            See `error_of`.
        InputError
            If the program cannot be started.
        """
        return settled(self.outcome(n, seed, replicates))


def open_command_source(word: str, dim: int, limits: Limits | None = None) -> CommandSource:
    """The source that ``cmd:...`` names; nothing is run yet.

    Raises
    ------
    InputError
        If there is no such program, or the command does not take n and the seed.
    """
    text = word.removeprefix("cmd:")
    try:
        template = shlex.split(text)
        if len(template) == 1:  # the whole command within quotes
            template = shlex.split(template[0])
    except ValueError as error:
        raise InputError(f"a command must close its quotes: got '{word}'") from error
    for needed in ("{n}", "{seed}"):
        if not any(needed in argument for argument in template):
            raise InputError(f"a command must hold {{n}} and {{seed}}: got no {needed} in '{word}'")
    if shutil.which(template[0]) is None:
        raise InputError(f"a command must name a program: got '{template[0]}' in '{word}'")
    return CommandSource(word, tuple(template), dim, limits or Limits())


def seed_fault(source: CommandSource, n: int, seed: int) -> Fault | None:
    """Fault ``global random state``: equal seeds do not give equal points.

    Raises
    ------
    SamplerFault, OutOfTime
        See `error_of`.
    """
    first, second = (source.realise(n, seed, range(1)) for _ in range(2))
    if np.array_equal(first, second):
        return None
    detail = f"equal seeds must give equal points: got others for n = {n}"
    return Fault("global random state", detail, {"n": n, "realisation": 0})


def command_seed(seed: int, n: int, replicate: int) -> int:
    """Seed of one realisation, in [0, 2^31): different for different replicates below 2^31.

    The stream of (seed, n) sets where the seeds begin; independent draws would coincide now and
    then, and so would the points.
    """
    begin = int(stream(seed, n).integers(_SEEDS))
    return (begin + replicate * _SPREAD) % _SEEDS


def _one(source: CommandSource, n: int, seed: int, replicate: int) -> Points | Failure:
    """Run the command once."""
    values = {"{n}": n, "{dim}": source.dim, "{seed}": command_seed(seed, n, replicate)}
    arguments = [_filled(argument, values) for argument in source.template]
    evidence = {"n": n, "realisation": replicate, "command": shlex.join(arguments)}
    asked = time.perf_counter()
    try:
        child = start(arguments)
    except OSError as error:
        raise InputError(
            f"a command must start: got {error.strerror} for '{source.name}'"
        ) from None
    try:
        text = _printed(child, source, n, evidence)
    except Overdue:
        return overdue(child, source.limits, source.name, evidence, asked, source.drawn)
    finally:
        stop(child)
    if isinstance(text, Failure):
        return text
    try:
        return checked(_parsed(text, source.name, evidence), n, source.dim, replicate)
    except SamplerFault as fault:
        return failure_of(SamplerFault(fault.kind, fault.detail, evidence | fault.evidence))


def _filled(argument: str, values: dict[str, int]) -> str:
    for name, value in values.items():
        argument = argument.replace(name, str(value))
    return argument


def _printed(
    child: Child, source: CommandSource, n: int, evidence: dict[str, Any]
) -> bytes | Failure:
    """All that the command prints on standard output, if it ends well and prints no flood."""
    until = answer_due(source.limits)
    with contextlib.suppress(ProcessLookupError, FileNotFoundError):  # it may have ended already
        limit_memory(source.limits.memory, child.process.pid)
    most = _NUMBER_BYTES * n * source.dim + _SLACK_BYTES
    text, buffer = bytearray(), bytearray(1 << 16)
    while got := receive(child, memoryview(buffer), until):
        text += buffer[:got]
        if len(text) > most:
            detail = f"{source.name} must print at most {most} bytes for n = {n}: got more"
            return Failure("garbage", detail, {"fault": "type", **evidence, "start": _start(text)})
    code = exit_code(child, until)
    return crash(child, code, source.name, evidence) if code else bytes(text)


def _parsed(text: bytes, name: str, evidence: dict[str, Any]) -> Points:
    """Rows of numbers of one length, shape (rows, columns)."""
    rule = f"{name} must print one point a line, as numbers"
    lines = [line.strip() for line in text.decode("utf-8", "replace").split("\n")]
    rows = [line.replace(",", " ") for line in lines if line and line[0] != "#"]
    evidence = {**evidence, "start": _start(text)}
    if not rows:
        raise SamplerFault("type", f"{rule}: got none", evidence)
    try:
        return np.loadtxt(rows, dtype=np.float64, comments=None, ndmin=2)
    except ValueError as error:
        raise SamplerFault(
            "type", f"{rule}: got {' '.join(str(error).split())}", evidence
        ) from None


def _start(text: bytes | bytearray) -> str:
    return text[:200].decode("utf-8", "replace")
