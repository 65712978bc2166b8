"""The caller's side of the child process that holds a sampler: started, asked, heard, killed.

The child is a fresh interpreter (`sampler_child`) that serves many calls. Each realisation has its
own answer, and so its own time. After a time-out, a crash or a breach of its memory, or when it
has not been heard out, it is killed, and the next call starts another.
"""

import fcntl
import json
import mmap
import os
import socket
import sys
import tempfile
import time
import weakref
from collections.abc import Callable
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from typing import Any, TypeVar, cast

import numpy as np

from ...theory.errors import InputError
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
    overdue,
    receive,
    start,
    stop,
)
from .realisations import SamplerFault
from .sources import Kind

_PROGRAM = (
    "import json, sys; sys.path[:] = json.loads(sys.argv[1]); "
    f"from {__package__}.sampler_child import main; main(*map(int, sys.argv[2:]))"
)
_START = 120.0  # seconds for the interpreter and our own imports, on a machine that is busy
_EXIT = 5.0  # seconds for a child that has closed its socket to be gone
_LONGEST_LINE = 1 << 20
_MOST_VALUES = 1 << 20  # coordinates asked for at once: 8 MiB, or one realisation

serving = False
"""Whether this process is itself the child of a sampler."""

Value = dict[str, Any]
T = TypeVar("T")


class _Garbled(EOFError):
    """What was read is no answer: something else was written into the socket."""


@dataclass(eq=False)
class _Running:
    """A child with the socket and the shared memory that lead to it, and when it was asked."""

    child: Child
    channel: socket.socket
    slots: int
    memory: mmap.mmap | None = None
    unread: bytearray = field(default_factory=bytearray)
    asked: float = inf


@dataclass(eq=False)
class SamplerProcess:
    """What is needed to start the child of a sampler, and the child, if it runs.

    Parameters
    ----------
    kind : str
        Of the sampler, once it has been loaded.
    drawn : int
        Realisations that it has drawn.
    """

    word: str
    dim: int
    limits: Limits
    folder: Path = field(default_factory=Path.cwd)
    kind: Kind = "callable"
    drawn: int = 0
    running: _Running | None = None
    finalizer: Callable[[], object] | None = None

    def close(self) -> None:
        """Kill the child with its group; the next call starts another."""
        if self.finalizer is not None:
            self.finalizer()
        self.running = self.finalizer = None


def ask(process: SamplerProcess, request: Value) -> Value:
    """The value that the child answers to one request.

    Raises
    ------
    SamplerFault, OutOfTime
        See `error_of`.
    InputError
        If the child cannot be started, or the word names nothing usable.
    """
    evidence = {"n": request["n"]}

    def exchange() -> Value | Failure:
        _request(process, request)
        return _answer(process, evidence)

    answer = _guarded(process, evidence, exchange)
    if isinstance(answer, Failure):
        raise error_of(answer)
    process.drawn += answer["drawn"]
    return answer


def draw(process: SamplerProcess, n: int, seed: int, replicates: range) -> Points | Failure:
    """Raw realisations, shape (len(replicates), n, dim), or the first failure among them.

    If the deadline comes between them, those before it.

    Raises
    ------
    InputError
        If the child cannot be started, or the word names nothing usable.
    """
    evidence = {"n": n, "realisation": replicates.start}
    points = np.empty((len(replicates), n, process.dim))
    failure = _guarded(process, evidence, lambda: _fill(process, points, seed, evidence))
    if failure is None:
        return points
    before = evidence["realisation"] - replicates.start
    return points[:before] if failure.kind == "late" and before else failure


def _fill(process: SamplerProcess, points: Points, seed: int, evidence: Value) -> Failure | None:
    """Ask for several realisations at once, take the answers one by one."""
    n, first = points.shape[1], evidence["realisation"]
    step = max(1, _MOST_VALUES // (n * process.dim))
    for begin in range(0, len(points), step):
        part = points[begin : begin + step]
        memory = _slots(process, part.nbytes)
        request = {"do": "realise", "n": n, "seed": seed, "start": first + begin}
        _request(process, {**request, "count": len(part), "size": len(memory)})
        for slot, realisation in enumerate(part):
            evidence["realisation"] = first + begin + slot
            answer = _answer(process, evidence)
            if isinstance(answer, Failure):
                return answer
            if answer.get("slot") != slot:
                raise _Garbled
            offset = slot * realisation.nbytes
            realisation[...] = np.ndarray(realisation.shape, np.float64, memory, offset)
            process.drawn += 1
    return None


def _guarded(process: SamplerProcess, evidence: Value, exchange: Callable[[], T]) -> T | Failure:
    """Talk to the child, started if need be; one that fails, or is not heard out, is killed."""
    heard_out = False
    known: Value = {}  # while the sampler is loaded it has not been asked for points
    try:
        if process.running is None:
            process.running = _start(process)
            process.finalizer = weakref.finalize(process, _end, process.running)
            _load(process)
        known = evidence
        answer = exchange()
        heard_out = not (isinstance(answer, Failure) and answer.kind == "memory")
        return answer
    except Overdue:
        assert process.running is not None
        child, asked = process.running.child, process.running.asked
        return overdue(child, process.limits, process.word, known, asked, process.drawn)
    except _Garbled:
        return _ended(process, known, 0.0)
    except (EOFError, BrokenPipeError):
        return _ended(process, known, _EXIT)
    finally:
        if not heard_out:
            process.close()


def _start(process: SamplerProcess) -> _Running:
    """Start the interpreter.

    Raises
    ------
    InputError
        If it cannot be started, as when its folder is gone, or in a child, whose script calls it
        without a guard and would start children without end.
    """
    if serving:
        rule = "a script must guard what it runs by if __name__ == '__main__'"
        raise InputError(f"{rule}: got a call while its sampler was imported")
    ours, theirs = socket.socketpair()
    slots = _shared_file()
    # Not the empty path: a random.py of the current folder would hide the library's.
    paths = json.dumps([path for path in sys.path if path])
    program = [sys.executable, "-P", "-u", "-X", "faulthandler", "-c", _PROGRAM]
    passed = [theirs.fileno(), slots]
    arguments = [*program, paths, *map(str, passed)]
    try:
        child = start(arguments, ours.fileno(), passed, process.folder)
    except OSError as error:
        ours.close()
        os.close(slots)
        raise InputError(f"a child must start: got {error.strerror} in {process.folder}") from error
    finally:
        theirs.close()
    return _Running(child, ours, slots)


def _load(process: SamplerProcess) -> None:
    """Let the child load the sampler.

    Raises
    ------
    InputError
        If the word names nothing usable.
    """
    limits = process.limits
    _request(process, {"word": process.word, "dim": process.dim, "memory": limits.memory})
    _line(process, min(time.perf_counter() + _START, limits.deadline))
    answer = _heard(process)
    if "unusable" in answer:
        raise InputError(answer["unusable"])
    process.kind = answer["kind"]


def _end(running: _Running) -> None:
    """Kill the child with its group, and release what was shared with it."""
    stop(running.child)
    running.channel.close()
    os.close(running.slots)


def _shared_file() -> int:
    """Descriptor of a file in memory that nobody can shorten, or of a temporary file."""
    if not hasattr(os, "memfd_create"):
        with tempfile.TemporaryFile() as file:
            return os.dup(file.fileno())
    descriptor = os.memfd_create("points", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
    # To read beyond the end of a shortened file would kill this process.
    fcntl.fcntl(descriptor, fcntl.F_ADD_SEALS, fcntl.F_SEAL_SHRINK)
    return descriptor


def _slots(process: SamplerProcess, size: int) -> mmap.mmap:
    """Shared memory of at least so many bytes."""
    running = process.running
    assert running is not None
    if running.memory is None or len(running.memory) < size:
        os.ftruncate(running.slots, size)
        running.memory = mmap.mmap(running.slots, size)
    return running.memory


def _request(process: SamplerProcess, request: Value) -> None:
    """Send a line; a child that awaits it has room for it."""
    assert process.running is not None
    line = memoryview(json.dumps(request).encode() + b"\n")
    while line:
        line = line[os.write(process.running.child.answers, line) :]


def _answer(process: SamplerProcess, evidence: Value) -> Value | Failure:
    """The next answer."""
    answer = _heard(process)
    if "fault" in answer:
        return failure_of(SamplerFault(*answer["fault"]))
    if "memory" in answer:
        most = f"{process.limits.memory / (1 << 20):.6g} MiB of memory"
        got = answer["memory"] or "MemoryError"
        detail = f"{process.word} must keep within {most} for n = {evidence['n']}: got {got}"
        return Failure("memory", detail, {**evidence, "limit": process.limits.memory})
    return answer


def _heard(process: SamplerProcess) -> Value:
    """The next line from the sampler, which has the time of a call."""
    assert process.running is not None
    process.running.asked = time.perf_counter()
    return _line(process, answer_due(process.limits))


def _line(process: SamplerProcess, until: float) -> Value:
    """The next line of JSON; EOFError if there is none."""
    running = process.running
    assert running is not None
    buffer = bytearray(1 << 12)
    while b"\n" not in running.unread:
        got = receive(running.child, memoryview(buffer), until)
        if not got:
            raise EOFError
        if len(running.unread) > _LONGEST_LINE:
            raise _Garbled
        running.unread += buffer[:got]
    line, _, rest = running.unread.partition(b"\n")
    running.unread = rest
    try:
        value = json.loads(line)
    except ValueError:
        raise _Garbled from None
    if not isinstance(value, dict):
        raise _Garbled
    return cast("Value", value)


def _ended(process: SamplerProcess, evidence: Value, seconds: float) -> Failure:
    """The failure of a child that ended its answer: that of its exit, if it exits in time."""
    assert process.running is not None
    child = process.running.child
    try:
        code = exit_code(child, time.perf_counter() + seconds)
    except Overdue:
        rule = "must leave descriptors alone that it has not opened: got a broken answer"
        evidence = {**evidence, "output": child.output}
        return Failure("crashes", f"{process.word} {rule}", evidence)
    return crash(child, code, process.word, evidence)
