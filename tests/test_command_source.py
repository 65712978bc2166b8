"""Commands as sources: what they print is read, and nothing they do harms the caller."""

import shlex
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from specrate.numerics.checking.faults import find_faults
from specrate.numerics.point_sources import command_source
from specrate.numerics.point_sources.child_processes import Failure, Limits, OutOfTime
from specrate.numerics.point_sources.command_source import (
    command_seed,
    open_command_source,
    seed_fault,
)
from specrate.numerics.point_sources.realisations import SamplerFault
from specrate.theory.errors import InputError

PROGRAM = """
import os, random, subprocess, sys, time
if sys.argv[4] == "ignores and differs":
    sys.argv[3] = "%d" % random.randrange(1 << 30)
n, dim, seed, mode = int(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]), sys.argv[4]
rng = random.Random(0 if mode == "ignores" else seed)
separator = {"commas": ", ", "tabs": "\\t"}.get(mode, " ")
if mode == "hangs":
    subprocess.Popen(["sleep", "1000"]).wait()
if mode == "exits":
    sys.exit("no such n")
if mode == "floods":
    while True:
        print("0.5 0.5")
if mode == "babbles":
    while True:
        print("0.5 0.5", file=sys.stderr)
if mode == "takes":
    bytearray(1 << 40)
if mode == "powers" and n & (n - 1):
    sys.exit(f"n must be a power of 2: got {n}")
if mode == "squares":
    n = int(n**0.5) ** 2
if mode == "silent":
    n = 0
if mode == "wide":
    dim += 1
if mode == "high":
    print(*[1.0] * dim)
    n -= 1
print("# header\\n")
for _ in range(n):
    print(separator.join(repr(rng.random()) for _ in range(dim)))
if mode == "tail":
    print("done")
if mode == "leaves a child":
    sys.stdout.flush()
    subprocess.Popen(["sleep", "1000"])
"""


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    path = tmp_path_factory.mktemp("two words") / "program.py"
    path.write_text(PROGRAM)
    return f"{sys.executable} -S -E -u {shlex.quote(str(path))} {{n}} {{dim}} {{seed}} "


def of(program, mode, call=30.0, dim=2):
    return open_command_source(f"cmd:{program}{shlex.quote(mode)}", dim, Limits(call=call))


@pytest.mark.parametrize("mode", ["plain", "commas", "tabs", "leaves a child"])
def test_points_are_read_to_the_last_digit(program, mode):
    import random

    source = of(program, mode, dim=3)
    assert (source.kind, source.dim, source.counts) == ("command", 3, None)
    found = source.realise(5, 7, range(2, 4))
    for points, replicate in zip(found, (2, 3), strict=True):
        rng = random.Random(command_seed(7, 5, replicate))
        np.testing.assert_array_equal(points, [[rng.random() for _ in range(3)] for _ in range(5)])
    assert source.realise(5, 7, range(0)).shape == (0, 5, 3)


def test_seeds_differ():
    seeds = {command_seed(1, 16, r) for r in range(30_000)}
    assert len(seeds) == 30_000
    assert all(0 <= seed < 1 << 31 for seed in seeds)
    assert command_seed(1, 16, 0) != command_seed(2, 16, 0) != command_seed(2, 17, 0)


def test_a_command_that_ignores_its_seed_is_seen(program):
    points = of(program, "ignores").realise(16, 0, range(3))
    kinds = [fault.kind for fault in find_faults(points).faults]
    assert kinds == ["duplicate realisations", "not homogenised"]


def test_a_command_that_differs_for_equal_seeds_is_seen(program):
    assert seed_fault(of(program, "plain"), 4, 0) is None
    fault = seed_fault(of(program, "ignores and differs"), 4, 0)
    assert fault.kind == "global random state"
    assert fault.detail == "equal seeds must give equal points: got others for n = 4"


@pytest.mark.parametrize(
    ("mode", "kind", "fault", "detail"),
    [
        ("hangs", "hangs", "hangs", "must answer within 0.3 s for n = 16"),
        ("babbles", "hangs", "hangs", "must answer within 0.3 s for n = 16"),
        ("exits", "crashes", "crashes", "must not crash for n = 16: got exit code 1, after 'no s"),
        ("takes", "memory", "memory", "keep within its memory for n = 16: got exit code 1, after"),
        ("floods", "garbage", "type", "must print at most 66816 bytes for n = 16: got more"),
        ("tail", "garbage", "type", "must print one point a line, as numbers: "),
        ("silent", "garbage", "type", "must print one point a line, as numbers: got none"),
        ("wide", "garbage", "shape", "must have shape (16, 2): got (16, 3)"),
        ("squares", "garbage", "count", "must have the 15 points asked for: got 9"),
        ("high", "garbage", "outside", "must lie in [0, 1): got 1.0 on axis 1, row 0"),
    ],
)
def test_harm_is_a_value(program, mode, kind, fault, detail):
    source = of(program, mode, call=0.3 if kind == "hangs" else 30.0)
    n = 15 if mode == "squares" else 16
    found = source.outcome(n, 0, range(4, 6))
    assert isinstance(found, Failure)
    assert found.kind == kind
    assert detail in found.detail
    assert "\n" not in found.detail
    assert found.evidence["realisation"] == 4
    assert str(command_seed(0, n, 4)) in found.evidence["command"]
    with pytest.raises(SamplerFault) as caught:
        source.realise(n, 0, range(4, 6))
    assert caught.value.kind == fault


def test_the_nearest_n_is_found(program):
    assert of(program, "plain").admissible(50) == 50
    assert of(program, "squares").admissible(50) == 49
    assert of(program, "powers").admissible(50) == 64
    for mode, kind in (("exits", "crashes"), ("wide", "shape")):
        with pytest.raises(SamplerFault) as caught:
            of(program, mode).admissible(50)
        assert caught.value.kind == kind


def test_the_deadline_says_nothing_of_the_command(program):
    source = open_command_source(f"cmd:{program}plain", 2, Limits(deadline=0.0))
    for ask in (lambda: source.realise(16, 0, range(1)), lambda: source.admissible(16)):
        with pytest.raises(OutOfTime, match="before the deadline") as caught:
            ask()
        assert caught.value.evidence["drawn"] == 0


def test_what_came_before_the_deadline_is_kept(program, monkeypatch):
    due = iter([time.perf_counter() + 30.0, 0.0])
    monkeypatch.setattr(command_source, "answer_due", lambda limits: next(due))
    source = of(program, "plain")
    source.limits = Limits(deadline=0.0)
    assert source.realise(4, 0, range(3)).shape == (1, 4, 2)
    assert source.drawn == 1


def test_no_shell_reads_the_command(program, tmp_path):
    source = of(program, f"; touch {tmp_path}/harm $(touch {tmp_path}/harm)")
    assert source.realise(4, 0, range(1)).shape == (1, 4, 2)
    assert not (tmp_path / "harm").exists()


@pytest.mark.parametrize("quote", ["'", '"'])
def test_the_whole_command_may_be_quoted(quote):
    source = open_command_source(f"cmd:{quote}echo 0.{{n}} 0.{{seed}}{quote}", 2)
    assert source.template == ("echo", "0.{n}", "0.{seed}")
    assert source.realise(1, 0, range(1))[0, 0, 0] == 0.1


@pytest.mark.parametrize(
    ("word", "message"),
    [
        ("cmd:", r"must hold {n} and {seed}: got no {n} in 'cmd:'"),
        ("cmd:echo {seed}", r"got no {n} in 'cmd:echo {seed}'"),
        ("cmd:echo {n} {dim}", r"got no {seed} in"),
        ("cmd:echo {n} {seed} 'x", "must close its quotes"),
        ("cmd:an-absent-program {n} {seed}", "must name a program: got 'an-absent-program'"),
    ],
)
def test_unusable_commands(word, message):
    with pytest.raises(InputError, match=message) as caught:
        open_command_source(word, 2)
    assert "\n" not in str(caught.value)


def test_a_program_that_cannot_start_is_unusable(tmp_path):
    path = Path(tmp_path, "program")
    path.write_text("no program")
    path.chmod(0o755)
    source = open_command_source(f"cmd:{path} {{n}} {{seed}}", 2)
    with pytest.raises(InputError, match="must start: got Exec format error"):
        source.realise(4, 0, range(1))
