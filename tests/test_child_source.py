"""Samplers in a child process: the same points and faults, and no harm whatever they do."""

import gc
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from specrate.numerics.point_sources import sampler_processes
from specrate.numerics.point_sources.child_processes import Failure, Limits, OutOfTime
from specrate.numerics.point_sources.child_source import (
    ChildSource,
    Repetition,
    global_state_fault,
    open_child_source,
    repetition,
)
from specrate.numerics.point_sources.realisations import SamplerFault
from specrate.numerics.point_sources.sources import load_source
from specrate.theory.errors import InputError

SAMPLERS = '''
import ctypes, os, random, subprocess, sys, threading, time
from pathlib import Path
import numpy as np

class Switch:
    """What a realisation does is written in a file, so that one child serves many tests."""
    def __call__(self, n, dim, rng):
        return globals()[Path("mode").read_text()](n, dim, rng)
    def admissible(self, n):
        return n // 10 * 10

switch = Switch()

class QMCEngine:
    """Engines are told by the name of this base: scipy itself would take seconds."""
    __module__ = "scipy.stats"

class Engine(QMCEngine):
    def __init__(self, d, rng):
        self.d, self.rng = d, rng
    def random(self, n):
        return self.rng.random((n, self.d))

def plain(n, dim, rng):
    return rng.random((n, dim))

def raises(n, dim, rng):
    raise RuntimeError("no\\nluck")

def leaves(n, dim, rng):
    sys.exit(0)

def too_wide(n, dim, rng):
    return rng.random((n, dim + 1))

def too_few(n, dim, rng):
    return rng.random((n - 1, dim))

def words(n, dim, rng):
    return "points"

def not_finite(n, dim, rng):
    return np.full((n, dim), np.nan)

def sleeps(n, dim, rng):
    sleeper = subprocess.Popen(["sleep", "1000"])
    Path("sleeper").write_text(str(sleeper.pid))
    time.sleep(1000)

def exits(n, dim, rng):
    print("good bye")
    os._exit(7)

def segfaults(n, dim, rng):
    ctypes.string_at(0)

def takes_too_much(n, dim, rng):
    taken = []
    while True:
        taken.append(bytearray(1 << 26))

def meddles(n, dim, rng):
    for descriptor in range(3, 64):
        if os.path.exists(f"/proc/self/fd/{descriptor}"):
            try:
                os.write(descriptor, b"5\\n")
            except OSError:
                pass
    return rng.random((n, dim))

def sleeps_at_the_third(n, dim, rng):
    points = rng.random((n, dim))
    if Path("third").read_text() == str(points[0, 0]):
        time.sleep(1000)
    return points

def prints(n, dim, rng):
    print("y" * 300_000, file=sys.stderr)
    return rng.random((n, dim))

def forks(n, dim, rng):
    os.fork()
    return rng.random((n, dim))

def global_numpy(n, dim, rng):
    return np.random.random((n, dim))

def global_random(n, dim, rng):
    return np.array([[random.random() for _ in range(dim)] for _ in range(n)])

def reseeds(n, dim, rng):
    np.random.seed(rng.integers(1 << 32))
    return np.random.random((n, dim))

COUNT = iter(range(1, 100))
def counts(n, dim, rng):
    return np.full((n, dim), 1 / next(COUNT) / 2)
'''

FILES = {
    "samplers.py": SAMPLERS,
    "random.py": "raise RuntimeError('hides the library')\n",
    "sleeping.py": "import time\ntime.sleep(1000)\n",
    "leaving.py": "import os\nos._exit(4)\n",
}


@pytest.fixture(scope="module", autouse=True)
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("children")
    for name, content in FILES.items():
        (folder / name).write_text(content)
    before = Path.cwd()
    os.chdir(folder)
    yield folder
    os.chdir(before)


@pytest.fixture(scope="module")
def switch(folder):
    """One source for all modes; a call may last half a second where it is to be cut short."""
    source = open_child_source("samplers.py:switch", 2, Limits(call=30.0, memory=256 << 20))
    yield source
    source.process.close()


def outcome(source, mode, n=16, replicates=range(1), call=30.0):
    Path("mode").write_text(mode)
    source.process.limits = Limits(call=call, memory=source.process.limits.memory)
    return source.outcome(n, 3, replicates)


@pytest.mark.parametrize("mode", ["plain", "prints", "forks"])
def test_the_points_are_those_of_this_process(switch, mode):
    inside = load_source(["samplers.py:plain"], 2)
    for n, replicates in ((16, range(2, 5)), (3000, range(2)), (7, range(0)), (16, range(2, 5))):
        points = outcome(switch, mode, n, replicates)
        np.testing.assert_array_equal(points, inside.realise(n, 3, replicates))
    assert (switch.kind, switch.dim, switch.name) == ("callable", 2, "samplers.py:switch")
    assert switch.admissible(47) == 40


def test_many_realisations_are_asked_for_in_parts(switch, monkeypatch):
    monkeypatch.setattr(sampler_processes, "_MOST_VALUES", 100)
    inside = load_source(["samplers.py:plain"], 2)
    for n in (16, 51):  # three to a request, and one
        points = outcome(switch, "plain", n, range(7))
        np.testing.assert_array_equal(points, inside.realise(n, 3, range(7)))


@pytest.mark.parametrize(
    ("mode", "kind"),
    [
        ("raises", "raises"),
        ("leaves", "raises"),
        ("too_wide", "garbage"),
        ("too_few", "garbage"),
        ("words", "garbage"),
        ("not_finite", "garbage"),
    ],
)
def test_faults_are_those_of_this_process(switch, mode, kind):
    child = switch.process.running
    found = outcome(switch, mode, 16, range(4, 6))
    assert isinstance(found, Failure)
    assert found.kind == kind
    with pytest.raises(SamplerFault) as inside:
        load_source([f"samplers.py:{mode}"], 2).realise(16, 3, range(4, 6))
    with pytest.raises(SamplerFault) as outside:
        switch.realise(16, 3, range(4, 6))
    assert outside.value.kind == inside.value.kind
    assert outside.value.evidence == inside.value.evidence
    assert outside.value.detail.split(":")[-1] == inside.value.detail.split(":")[-1]
    assert switch.process.running is child  # it has not been started anew


def exists(process):
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def is_gone(process):
    for _ in range(200):
        if not exists(process):
            return True
        time.sleep(0.05)
    return False


@pytest.mark.parametrize(
    ("mode", "call", "kind", "detail"),
    [
        ("sleeps", 1.0, "hangs", "must answer within 1 s for n = 16: got no answer"),
        ("exits", 30.0, "crashes", "must not crash for n = 16: got exit code 7, after 'good bye'"),
        (
            "segfaults",
            30.0,
            "crashes",
            "must not crash for n = 16: got signal SIGSEGV, after 'File",
        ),
        (
            "takes_too_much",
            30.0,
            "memory",
            "keep within 256 MiB of memory for n = 16: got MemoryError",
        ),
    ],
)
def test_harm_is_a_value(switch, mode, call, kind, detail):
    assert isinstance(outcome(switch, "plain"), np.ndarray)  # it runs, or is started anew
    child = switch.process.running.child.process.pid
    found = outcome(switch, mode, replicates=range(5, 7), call=call)
    assert (found.kind, detail in found.detail) == (kind, True), found.detail
    assert (found.evidence["n"], found.evidence["realisation"]) == (16, 5)
    assert "\n" not in found.detail
    assert len(found.evidence.get("output", "")) <= 2000
    assert switch.process.running is None
    assert is_gone(child)
    if mode == "sleeps":
        assert is_gone(int(Path("sleeper").read_text()))


def test_the_deadline_says_nothing_of_the_sampler(switch):
    assert isinstance(outcome(switch, "plain"), np.ndarray)
    Path("mode").write_text("sleeps")
    switch.process.limits = Limits(deadline=time.perf_counter() + 0.3)
    with pytest.raises(OutOfTime, match="must answer before the deadline for n = 16"):
        switch.realise(16, 0, range(1))


def test_what_came_before_the_deadline_is_kept(switch, monkeypatch):
    """The sampler sleeps at the third of four realisations; the first two are not lost."""
    points = outcome(switch, "plain", 16, range(4))
    Path("third").write_text(str(points[2, 0, 0]))
    Path("mode").write_text("sleeps_at_the_third")
    drawn = switch.process.drawn
    due = iter([time.perf_counter() + 30.0] * 2 + [0.0])
    monkeypatch.setattr(sampler_processes, "answer_due", lambda limits: next(due))
    switch.process.limits = Limits(deadline=0.0)
    np.testing.assert_array_equal(switch.realise(16, 3, range(4)), points[:2])
    assert switch.process.drawn == drawn + 2


def test_time_is_counted_from_the_question(switch):
    """Not from the start of the interpreter, which is not the sampler's."""
    switch.process.close()
    Path("mode").write_text("sleeps")
    switch.process.limits = Limits(deadline=time.perf_counter())
    with pytest.raises(OutOfTime) as caught:
        switch.realise(16, 0, range(1))
    assert caught.value.evidence["seconds"] == 0
    assert isinstance(outcome(switch, "plain"), np.ndarray)
    drawn = switch.process.drawn
    Path("mode").write_text("sleeps")
    switch.process.limits = Limits(deadline=time.perf_counter() + 0.3)
    with pytest.raises(OutOfTime) as caught:
        switch.realise(16, 0, range(1))
    assert 0 < caught.value.evidence["seconds"] <= 30
    assert caught.value.evidence["drawn"] == drawn


def test_trial_calls_are_realisations():
    """A sampler that tells what it honours without drawing has drawn nothing."""
    for word, drawn in (("plain", 1), ("switch", 0), ("Engine", 0)):
        source = open_child_source(f"samplers.py:{word}", 2)
        source.admissible(50)
        assert source.process.drawn == drawn
        source.process.close()


def test_global_states(switch):
    expected = {
        "plain": Repetition(True, ()),
        "global_numpy": Repetition(False, ("numpy.random",)),
        "global_random": Repetition(False, ("random",)),
        "reseeds": Repetition(True, ("numpy.random",)),
        "counts": Repetition(False, ()),
    }
    for mode, wanted in expected.items():
        assert isinstance(outcome(switch, "plain"), np.ndarray)
        Path("mode").write_text(mode)
        assert repetition(switch, 16, 0) == wanted
        fault = global_state_fault(switch, 16, 0)
        assert (fault is None) == wanted.repeats
        if fault is not None:
            assert fault.kind == "global random state"
            assert fault.evidence["moved"] == list(wanted.moved)
            assert all(name in fault.detail for name in wanted.moved)
    Path("mode").write_text("raises")
    with pytest.raises(SamplerFault, match="no luck"):
        repetition(switch, 16, 0)


def test_engines():
    inside = load_source(["samplers.py:Engine"], 3)
    source = open_child_source("samplers.py:Engine", 3)
    assert source.admissible(50) == 50
    assert source.kind == inside.kind == "engine"
    np.testing.assert_array_equal(source.realise(8, 1, range(2)), inside.realise(8, 1, range(2)))
    source.process.close()


@pytest.mark.parametrize("ask", [lambda s: s.admissible(4), lambda s: s.realise(4, 0, range(1))])
def test_a_word_that_names_nothing_is_unusable(ask):
    message = "must name an attribute of samplers.py: got 'absent'"
    with pytest.raises(InputError, match=message) as caught:
        ask(open_child_source("samplers.py:absent", 2))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("word", "call", "kind", "detail"),
    [
        ("sleeping", 0.3, "hangs", "must answer within 0.3 s when it is loaded: got no answer"),
        ("leaving", 30.0, "crashes", "must not crash when it is loaded: got exit code 4"),
    ],
)
def test_harm_on_loading_is_the_samplers(word, call, kind, detail):
    source = open_child_source(f"{word}.py:points", 2, Limits(call=call))
    with pytest.raises(SamplerFault, match=detail) as caught:
        source.admissible(16)
    assert caught.value.kind == kind
    assert "n" not in caught.value.evidence


def test_nothing_is_started_before_the_first_question():
    source = open_child_source("samplers.py:plain", 2)
    assert source.process.running is None
    assert (source.name, source.dim) == ("samplers.py:plain", 2)


def test_a_source_that_is_dropped_leaves_no_child():
    source = open_child_source("samplers.py:plain", 2)
    source.realise(4, 0, range(1))
    child = source.process.running.child.process.pid
    assert exists(child)
    del source
    gc.collect()
    assert is_gone(child)


def test_a_folder_that_is_gone_is_unusable(tmp_path):
    process = sampler_processes.SamplerProcess(
        "samplers.py:plain", 2, Limits(), tmp_path / "absent"
    )
    with pytest.raises(InputError, match="a child must start: got No such file"):
        ChildSource(process).realise(4, 0, range(1))


def test_the_child_dies_with_its_caller():
    """Also in the middle of a call, and with what the sampler has started."""
    Path("mode").write_text("sleeps")
    Path("sleeper").unlink(missing_ok=True)
    code = (
        "from specrate.numerics.point_sources.child_source import open_child_source; "
        "source = open_child_source('samplers.py:switch', 2); source.admissible(10); "
        "print(source.process.running.child.process.pid, flush=True); "
        "source.realise(16, 0, range(1))"
    )
    caller = subprocess.Popen([sys.executable, "-P", "-c", code], stdout=subprocess.PIPE)
    child = int(caller.stdout.readline())
    for _ in range(3000):
        if Path("sleeper").exists() and Path("sleeper").read_text():
            break
        time.sleep(0.02)
    caller.kill()
    caller.wait()
    caller.stdout.close()
    assert is_gone(child)
    assert is_gone(int(Path("sleeper").read_text()))
