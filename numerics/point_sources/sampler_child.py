"""The program of a child process that holds a foreign sampler and answers requests for points.

Requests and answers are lines of JSON on one socket; points are left in a file of shared memory,
one slot a realisation. The sampler is loaded and called as a source in the caller's process would
be, so that its points and its faults are the same. Its memory is limited before it is loaded. When
the caller dies, so does the whole group.
"""

import json
import mmap
import os
import pickle
import random
import select
import signal
import socket
import sys
import threading
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...theory.errors import InputError
from . import sampler_processes
from .child_processes import limit_memory
from .realisations import SamplerFault
from .sources import CallableSource, Source, load_source

Request = dict[str, Any]


@dataclass(eq=False)
class _Slots:
    """Shared memory in which the caller reads realisations."""

    descriptor: int
    memory: mmap.mmap | None = None

    def leave(self, slot: int, points: NDArray[np.float64], size: int) -> None:
        """Copy a realisation into its slot; the caller has made the file ``size`` bytes long."""
        if self.memory is None or len(self.memory) < size:
            self.memory = mmap.mmap(self.descriptor, size)
        place = np.ndarray(points.shape, np.float64, self.memory, slot * points.nbytes)
        place[...] = points


def main(channel_descriptor: int, slots_descriptor: int) -> None:
    """Load the sampler of the first request, then answer until the caller closes the socket."""
    sys.argv = [""]
    sampler_processes.serving = True
    for descriptor in (channel_descriptor, slots_descriptor):
        os.set_inheritable(descriptor, False)
    threading.Thread(target=_end_with_caller, args=(channel_descriptor,), daemon=True).start()
    slots = _Slots(slots_descriptor)
    with socket.socket(fileno=channel_descriptor) as channel, channel.makefile("rb") as requests:
        # A fork that the sampler lets return must not answer too.
        os.register_at_fork(after_in_child=lambda: os.close(channel.detach()))
        order = json.loads(requests.readline())
        limit_memory(order["memory"])
        _answer(channel, {"ready": True})
        try:
            source = load_source([order["word"]], order["dim"])
        except InputError as error:
            _answer(channel, {"unusable": str(error)})
            return
        _answer(channel, {"kind": source.kind})
        for line in requests:
            _obey(channel, slots, source, json.loads(line))


def _end_with_caller(descriptor: int) -> None:
    """Wait for the other end to be closed, and end with everything the sampler started."""
    hung_up = select.poll()
    hung_up.register(descriptor, 0)
    hung_up.poll()
    os.killpg(os.getpid(), signal.SIGKILL)


def _obey(channel: socket.socket, slots: _Slots, source: Source, request: Request) -> None:
    """Carry out one request; its first fault ends it."""
    try:
        match request["do"]:
            case "realise":
                for slot in range(request["count"]):
                    slots.leave(slot, _drawn(source, request, slot), request["size"])
                    _answer(channel, {"slot": slot})
            case "repeat":
                _answer(channel, _repeated(source, request))
            case _:
                nearest = source.admissible(request["n"])
                _answer(channel, {"admissible": nearest, "drawn": int(_is_tried(source))})
    except SamplerFault as fault:
        if isinstance(fault.__cause__, MemoryError):
            _answer(channel, {"memory": str(fault.__cause__)})
        else:
            _answer(channel, {"fault": [fault.kind, fault.detail, fault.evidence]})
    except MemoryError as error:  # met where the points are copied
        _answer(channel, {"memory": str(error)})


def _is_tried(source: Source) -> bool:
    """Whether a realisation must be drawn to see if a number of points is honoured."""
    return isinstance(source, CallableSource) and not hasattr(source.function, "admissible")


def _drawn(source: Source, request: Request, index: int = 0) -> NDArray[np.float64]:
    replicate = request["start"] + index
    return source.realise(request["n"], request["seed"], range(replicate, replicate + 1))


def _repeated(source: Source, request: Request) -> dict[str, Any]:
    """One realisation drawn twice: whether it is the same, and which global states moved."""
    before = _global_states()
    first = _drawn(source, request)
    after = _global_states()
    second = _drawn(source, request)
    moved = [name for name in before if before[name] != after[name]]
    same = bool(np.array_equal(first, second))
    return {"repeats": same, "moved": moved, "drawn": 2}


def _global_states() -> dict[str, bytes]:
    return {
        "numpy.random": pickle.dumps(np.random.get_state(legacy=False)),
        "random": pickle.dumps(random.getstate()),
    }


def _answer(channel: socket.socket, value: dict[str, Any]) -> None:
    channel.sendall(json.dumps(value, default=str).encode() + b"\n")
