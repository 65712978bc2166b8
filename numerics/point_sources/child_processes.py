"""Child processes that run foreign code: deadlines, a limit of memory, bounded output, no orphans.

A child leads a process group of its own. It answers on one file descriptor; whatever else it
prints is drained, and the last `OUTPUT_KEPT` characters are kept as evidence. `receive` waits for
the answer: until it is there, the child has exited, or it is late. `stop` kills the whole group.

What a child did instead of answering is a value, a `Failure`; `settled` makes an exception of it.
POSIX only. The limit is one of address space and of each process for itself; it needs Linux. A
grandchild that leads a group of its own is not killed.
"""

import contextlib
import os
import re
import resource
import selectors
import signal
import subprocess
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from math import inf
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from .realisations import SamplerFault

OUTPUT_KEPT = 2000
"""Characters kept of what a child prints beside its answer."""

_GLANCE = 0.05  # seconds after which a silent child is looked after
_BYTES_KEPT = 1 << 15
_EXTENSIONS = re.compile(r"^Extension modules: .*\n?", re.M)  # long, and no clue to a crash
_THREAD = re.compile(r"\b(thread|Thread) 0x[0-9a-f]+")  # differs from run to run
_FRAME = re.compile(r"^Current thread.*\n\s*(File .*)$", re.M)
_MEMORY_WORDS = ("MemoryError", "bad_alloc", "out of memory", "cannot allocate memory")

Points = NDArray[np.float64]


@dataclass(frozen=True)
class Limits:
    """What foreign code may use.

    Parameters
    ----------
    call : float
        Seconds for one realisation.
    memory : int
        Bytes of address space beyond those that the child holds when the foreign code begins.
    deadline : float
        A time of `time.perf_counter`, after which no answer is waited for.
    """

    call: float = 60.0
    memory: int = 2 << 30
    deadline: float = inf


@dataclass(frozen=True)
class Failure:
    """What came instead of points.

    Parameters
    ----------
    kind : str
        ``hangs`` no answer within the time of a call; ``crashes`` a signal or an exit code;
        ``raises`` an exception; ``memory`` more than the limit; ``garbage`` no (n, dim) array of
        finite floats in [0, 1); ``late`` the deadline came first, of which nothing follows.
    detail : str
        One line that gives the rule and then what was got.
    evidence : dict
        JSON-able. For ``raises`` and ``garbage``, ``fault`` is the kind of the `SamplerFault`.
    """

    kind: Literal["hangs", "crashes", "raises", "memory", "garbage", "late"]
    detail: str
    evidence: dict[str, Any]


class OutOfTime(Exception):
    """The deadline came before the answer.

    Parameters
    ----------
    detail : str
        One line that gives the rule and then what was got.
    evidence : dict
        JSON-able: ``seconds`` for which the sampler was waited for, and ``drawn``, the realisations
        that had come before, of which the last may have come at any time.
    """

    def __init__(self, detail: str, evidence: dict[str, Any]) -> None:
        super().__init__(detail, evidence)
        self.detail = detail
        self.evidence = evidence

    def __str__(self) -> str:
        return self.detail


class Overdue(Exception):
    """A child has not answered in time."""


def answer_due(limits: Limits) -> float:
    """The time of `time.perf_counter` until which a call that begins now may last."""
    return min(time.perf_counter() + limits.call, limits.deadline)


@dataclass(eq=False)
class Child:
    """A running child, and what it printed last."""

    process: subprocess.Popen[bytes]
    answers: int
    waiting: selectors.BaseSelector
    owner: int
    printed: bytearray = field(default_factory=bytearray)

    @property
    def output(self) -> str:
        """The last characters that it printed beside its answer."""
        text = self.printed.decode("utf-8", "replace")
        return _THREAD.sub(r"\1", _EXTENSIONS.sub("", text))[-OUTPUT_KEPT:]


def settled(outcome: Points | Failure) -> Points:
    """The points, if there are any.

    Raises
    ------
    SamplerFault, OutOfTime
        See `error_of`.
    """
    if isinstance(outcome, Failure):
        raise error_of(outcome)
    return outcome


def error_of(failure: Failure) -> SamplerFault | OutOfTime:
    """What a source raises for a failure.

    A `SamplerFault` of kind ``hangs``, ``crashes`` or ``memory``, or the one that the sampler
    shows in the caller's process; `OutOfTime` if the deadline came first.
    """
    if failure.kind == "late":
        return OutOfTime(failure.detail, failure.evidence)
    evidence = dict(failure.evidence)
    return SamplerFault(evidence.pop("fault", failure.kind), failure.detail, evidence)


def failure_of(fault: SamplerFault) -> Failure:
    """The fault of a realisation as a value."""
    kind = "raises" if fault.kind == "exception" else "garbage"
    return Failure(kind, fault.detail, {"fault": fault.kind, **fault.evidence})


def start(
    arguments: Sequence[str],
    channel: int | None = None,
    passed: Sequence[int] = (),
    folder: Path | None = None,
) -> Child:
    """Start a program, without a shell, as the leader of its own process group.

    Parameters
    ----------
    channel : int, optional
        Where its answers are read. Without one they are its standard output; with one, that is
        drained with standard error.
    passed : sequence of int
        File descriptors that it inherits.

    Raises
    ------
    OSError
        If the program cannot be started.
    """
    process = subprocess.Popen(
        arguments,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE if channel is None else subprocess.STDOUT,
        pass_fds=tuple(passed),
        cwd=folder,
        start_new_session=True,
    )
    assert process.stdout is not None
    answers = process.stdout.fileno() if channel is None else channel
    noise = process.stderr if channel is None else process.stdout
    assert noise is not None
    waiting = selectors.DefaultSelector()
    for descriptor in (answers, noise.fileno()):
        os.set_blocking(descriptor, False)
        waiting.register(descriptor, selectors.EVENT_READ)
    return Child(process, answers, waiting, os.getpid())


def limit_memory(memory: int, process: int = 0) -> None:
    """Let a process, by default this one, take so many bytes more; none of them dumps its core."""
    # Elsewhere than on Linux the address space cannot be limited; deadlines and groups still hold.
    if not hasattr(resource, "prlimit"):
        return
    pages = int(Path(f"/proc/{process or 'self'}/statm").read_text().split()[0])
    size = pages * resource.getpagesize() + memory
    hard = resource.prlimit(process, resource.RLIMIT_AS)[1]
    if hard == resource.RLIM_INFINITY or size < hard:
        resource.prlimit(process, resource.RLIMIT_AS, (size, size))
    resource.prlimit(process, resource.RLIMIT_CORE, (0, 0))


def receive(child: Child, view: memoryview, until: float) -> int:
    """Read some bytes of the answer into the view; 0 at its end.

    Raises
    ------
    Overdue
        If there is none until that time of `time.perf_counter`.
    """
    while True:
        # Asked before reading: what a child wrote before its exit is still read.
        over = child.process.poll() is not None
        try:
            return os.readv(child.answers, [view])
        except BlockingIOError:
            # A grandchild may hold the pipe of a child that is gone: there is no end to wait for.
            if over:
                return 0
        except ConnectionResetError:
            return 0
        _wait(child, until)


def exit_code(child: Child, until: float) -> int:
    """The exit code of a child that has ended its answer, negative for a signal.

    Raises
    ------
    Overdue
        If it does not exit.
    """
    if child.answers in child.waiting.get_map():
        child.waiting.unregister(child.answers)  # at its end it is always ready
    while (code := child.process.poll()) is None:
        _wait(child, until)
    _drain(child)
    return code


def _wait(child: Child, until: float) -> None:
    """Sleep until there is something to read, at most for a glance; drain what is printed."""
    left = until - time.perf_counter()
    if left <= 0:
        raise Overdue
    for key, _ in child.waiting.select(min(left, _GLANCE)):
        if key.fd != child.answers:
            _drain(child)


def _drain(child: Child) -> None:
    """Read one pipeful of what was printed; the rest, if any, the next time."""
    noise = child.process.stderr or child.process.stdout
    assert noise is not None
    try:
        data = os.read(noise.fileno(), 1 << 16)
    except BlockingIOError:
        return
    child.printed += data
    del child.printed[:-_BYTES_KEPT]
    if not data and noise.fileno() in child.waiting.get_map():
        child.waiting.unregister(noise.fileno())


def stop(child: Child) -> None:
    """Kill a child and its group, and release what it held; a second call does nothing."""
    if os.getpid() != child.owner or child.process.stdout is None or child.process.stdout.closed:
        return  # a fork of this process must not kill its parent's children
    with contextlib.suppress(ProcessLookupError):  # the whole group may be gone
        os.killpg(child.process.pid, signal.SIGKILL)
    child.process.wait()
    child.waiting.close()
    for pipe in (child.process.stdout, child.process.stderr):
        if pipe is not None:
            pipe.close()


def crash(child: Child, code: int, name: str, evidence: dict[str, Any]) -> Failure:
    """The failure of a child that exited with a code; of kind ``memory`` if its words say so."""
    cause = f"exit code {code}"
    if code < 0:
        known = {s.value for s in signal.Signals}
        cause = f"signal {signal.Signals(-code).name if -code in known else -code}"
    output = child.output
    words = _last_words(output)
    said = f", after '{words[:200]}'" if words else ""
    evidence = {"exit": code, **evidence, "output": output}
    if any(word in output or word in output.lower() for word in _MEMORY_WORDS):
        detail = f"{name} must keep within its memory{_for(evidence)}: got {cause}{said}"
        return Failure("memory", detail, evidence)
    return Failure("crashes", f"{name} must not crash{_for(evidence)}: got {cause}{said}", evidence)


def _last_words(output: str) -> str:
    """The last line; if Python has told where it was at a fatal signal, the innermost place."""
    lines = [line.strip() for line in output.splitlines() if line.strip()]
    frame = _FRAME.search(output)
    return frame[1] if frame else lines[-1] if lines else ""


def overdue(
    child: Child, limits: Limits, name: str, evidence: dict[str, Any], asked: float, drawn: int
) -> Failure:
    """The failure of a child that has not answered: it hangs, or the deadline came first.

    Parameters
    ----------
    asked : float
        The time of `time.perf_counter` at which the sampler was asked; infinite before that.
    drawn : int
        Realisations that have come from it so far.
    """
    now = time.perf_counter()
    evidence = {**evidence, "seconds": max(now - asked, 0.0), "output": child.output}
    if now >= limits.deadline:
        detail = f"{name} must answer before the deadline{_for(evidence)}: got no answer"
        return Failure("late", detail, {**evidence, "drawn": drawn})
    return Failure("hangs", _unanswered(name, limits, evidence), evidence)


def unanswered(late: OutOfTime, name: str, limits: Limits) -> SamplerFault:
    """The fault of a sampler that had the time of a call, though the deadline ended it."""
    evidence = {key: value for key, value in late.evidence.items() if key != "drawn"}
    return SamplerFault("hangs", _unanswered(name, limits, evidence), evidence)


def _unanswered(name: str, limits: Limits, evidence: dict[str, Any]) -> str:
    return f"{name} must answer within {limits.call:g} s{_for(evidence)}: got no answer"


def _for(evidence: dict[str, Any]) -> str:
    return f" for n = {evidence['n']}" if "n" in evidence else " when it is loaded"
