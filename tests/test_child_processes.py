"""Child processes: what they use is limited, what they print is kept in part, none is left over."""

import os
import sys
import time
from math import inf

import pytest
from specrate.numerics.point_sources.child_processes import (
    OUTPUT_KEPT,
    Failure,
    Limits,
    OutOfTime,
    Overdue,
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
    unanswered,
)
from specrate.numerics.point_sources.realisations import SamplerFault

LONG = 60.0  # seconds that are never waited for


def python(code):
    return start([sys.executable, "-S", "-E", "-u", "-c", code])


@pytest.fixture
def run():
    """Start children that are stopped in any case."""
    children = []

    def begin(code):
        children.append(python(code))
        return children[-1]

    yield begin
    for child in children:
        stop(child)


def everything(child, seconds=LONG):
    """All that a child answers, and its exit code."""
    until, answer, buffer = time.perf_counter() + seconds, b"", bytearray(1000)
    while got := receive(child, memoryview(buffer), until):
        answer += buffer[:got]
    return answer, exit_code(child, until)


def exists(process):
    """Whether a process runs; one that waits to be collected does not."""
    try:
        with open(f"/proc/{process}/stat") as file:
            return file.read().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def is_gone(process):
    for _ in range(200):
        if not exists(process):
            return True
        time.sleep(0.05)
    return False


def test_an_answer_and_an_exit_code(run):
    child = run("import sys; print('x' * 5000); print('noise', file=sys.stderr); sys.exit(3)")
    assert everything(child) == (b"x" * 5000 + b"\n", 3)
    assert child.output == "noise\n"


def test_the_last_of_a_flood_is_kept_and_the_rest_drained(run):
    code = "import os, sys; os.write(1, b'a'); [os.write(2, b'%07d\\n' % i) for i in range(50000)]"
    child = run(code + "; os.write(1, b'b')")
    assert everything(child)[0] == b"ab"
    assert len(child.output) == OUTPUT_KEPT
    assert child.output.endswith("0049999\n")
    assert len(child.printed) < 1 << 16


@pytest.mark.parametrize(
    "code",
    ["import time; time.sleep(1000)", "while True: print('x', file=__import__('sys').stderr)"],
)
def test_a_silent_or_babbling_child_is_overdue(run, code):
    child = run(code)
    with pytest.raises(Overdue):
        everything(child, 0.3)
    began = time.perf_counter() - 5.0
    found = overdue(child, Limits(call=0.3), "it", {"n": 5}, began, 2)
    rule = "it must answer within 0.3 s for n = 5: got no answer"
    assert (found.kind, found.detail) == ("hangs", rule)
    assert 5.0 <= found.evidence["seconds"] < LONG
    late = overdue(child, Limits(0.3, deadline=began), "it", {}, inf, 2)
    before = "it must answer before the deadline when it is loaded: got no answer"
    assert (late.kind, late.detail) == ("late", before)
    assert (late.evidence["seconds"], late.evidence["drawn"]) == (0.0, 2)
    error = error_of(late)
    assert isinstance(error, OutOfTime)
    assert str(error) == before
    hanging = unanswered(error, "it", Limits(call=7.0))
    assert str(hanging) == "hangs: it must answer within 7 s when it is loaded: got no answer"
    assert hanging.evidence.keys() == {"seconds", "output"}
    stop(child)
    assert is_gone(child.process.pid)
    stop(child)  # a second time does nothing


def test_a_child_that_closes_its_output_and_stays_is_overdue(run):
    child = run("import os, time; os.close(1); os.close(2); time.sleep(1000)")
    with pytest.raises(Overdue):
        everything(child, 0.5)


def test_grandchildren_are_killed_and_do_not_hold_the_answer_open(run):
    """The grandchild inherits the pipe: without a look at the child there is no end."""
    sleeper = "['sleep', '1000']"
    child = run(f"import subprocess as s, os; print(s.Popen({sleeper}).pid); os._exit(0)")
    answer, code = everything(child)
    assert code == 0
    assert exists(int(answer))
    stop(child)
    assert is_gone(int(answer))


def test_memory_is_limited():
    """The child waits until its limit is set; what it takes first is within the limit."""
    ours, theirs = os.pipe()
    code = f"import os; os.read({ours}, 1); bytearray(100 << 20); bytearray(300 << 20)"
    child = start([sys.executable, "-S", "-E", "-c", code], passed=[ours])
    try:
        limit_memory(256 << 20, child.process.pid)
        os.write(theirs, b"!")
        _, exited = everything(child)
        failure = crash(child, exited, "it", {"n": 4})
    finally:
        stop(child)
        os.close(ours)
        os.close(theirs)
    wanted = "it must keep within its memory for n = 4: got exit code 1, after 'MemoryError'"
    assert (failure.kind, failure.detail) == ("memory", wanted)


@pytest.mark.parametrize(
    ("code", "detail"),
    [
        ("import sys; sys.exit('bad n')", "got exit code 1, after 'bad n'"),
        ("import os; os._exit(9)", "got exit code 9"),
        ("import os; os.kill(os.getpid(), 11)", "got signal SIGSEGV"),
        ("import os; os.kill(os.getpid(), 40)", "got signal 40"),
    ],
)
def test_crashes(run, code, detail):
    child = run(code)
    failure = crash(child, everything(child)[1], "it", {"n": 4})
    assert (failure.kind, failure.detail) == ("crashes", f"it must not crash for n = 4: {detail}")


def test_the_place_of_a_fatal_signal_is_told(run):
    child = run("import faulthandler, ctypes\nfaulthandler.enable()\nctypes.string_at(0)")
    failure = crash(child, everything(child)[1], "it", {})
    assert "got signal SIGSEGV, after 'File \"" in failure.detail
    output = failure.evidence["output"]
    assert "Extension modules" not in output
    assert "Current thread (most recent call first)" in output  # no address, which changes


def test_failures_become_faults():
    with pytest.raises(SamplerFault) as caught:
        settled(Failure("hangs", "too long", {"n": 4}))
    assert (caught.value.kind, caught.value.evidence) == ("hangs", {"n": 4})
    for kind, value in (("exception", "raises"), ("count", "garbage")):
        fault = SamplerFault(kind, "detail", {"n": 4})
        failure = failure_of(fault)
        assert failure.kind == value
        again = error_of(failure)
        assert isinstance(again, SamplerFault)
        assert (again.kind, again.detail, again.evidence) == (kind, "detail", {"n": 4})


def test_the_nearer_end_counts():
    now = time.perf_counter()
    assert answer_due(Limits(call=LONG, deadline=now)) == now
    assert answer_due(Limits(call=LONG)) >= now + LONG
