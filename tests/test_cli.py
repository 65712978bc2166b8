"""The command line: exit codes, streams, lazy imports, replay, interrupts, closed pipes."""

import json
import os
import signal
import subprocess
import sys
import time
from importlib.metadata import version
from pathlib import Path
from typing import Any

import pytest
from specrate.report.cli import FORMATS, main

JITTER = ("check", "jitter", "--dim", "2", "--claim", "jitter", "--n", "16", "--n", "64")


def run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    """Exit code, stdout and stderr of a command, in this process."""
    capsys.readouterr()
    try:
        code = main(list(arguments))
    except SystemExit as stop:
        code = int(stop.code or 0)
    out, err = capsys.readouterr()
    return code, out, err


def launch(*arguments: str, **options: Any) -> "subprocess.Popen[str]":
    """A command in a process of its own."""
    command = [sys.executable, "-m", "specrate.report.cli", *arguments]
    pipes: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    return subprocess.Popen(command, **(pipes | options))


def timeless(document: Any) -> Any:
    """The document without the fields whose name speaks of seconds."""
    if isinstance(document, dict):
        return {k: timeless(v) for k, v in document.items() if "seconds" not in k}
    return [timeless(v) for v in document] if isinstance(document, list) else document


# Exit codes


def test_done_is_0(capsys: pytest.CaptureFixture[str]) -> None:
    for command in (["table"], ["derive", "jitter"], [*JITTER, "--budget", "20"]):
        code, out, err = run(capsys, *command)
        assert (code, err) == (0, "")
        assert out.endswith("\n")


def test_contradicted_is_1(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(capsys, "check", "random", "--dim", "2", "--claim", "jitter", "--n", "64")
    assert code == 1
    first, claim, witness, *_ = out.splitlines()
    assert first.startswith("CONTRADICTED: random in 2D, N = 64")
    assert "claim jitter: FAILS in" in claim
    assert "witness on region 1: N·P_S at m = (1, 0), N = 64" in witness


def test_invalid_is_1(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    source = tmp_path / "source.py"
    source.write_text("def outside(n, dim, rng):\n    return rng.random((n, dim)) + 1\n")
    code, out, _ = run(capsys, "check", f"{source}:outside", "--dim", "2", "--n", "16")
    assert code == 1
    assert out.startswith("INVALID: ")
    assert out.splitlines()[1].startswith("  fault, ")


def test_inconclusive_is_3(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, _ = run(capsys, *JITTER, "--budget", "0.001")
    assert code == 3
    assert "Undecided claims need a budget of about" in out


DISK = ["variance", "jitter", "disk", "--dim", "2", "--n", "16"]

BAD = {
    "unknown sampler": ["table", "--sampler", "jitterbug"],
    "unknown sampler to derive": ["derive", "jitterbug"],
    "code as a sampler": ["table", "--sampler", "__import__('os').getcwd()"],
    "bad dimension": ["table", "--dim", "2.5"],
    "dimension 0": ["table", "--dim", "0"],
    "bad class": ["table", "--integrand", "worse"],
    "unknown proof": ["prove", "99"],
    "bad decay": ["table", "--integrand", "p=1"],
    "disk in 3D": ["table", "--dim", "3", "--integrand", "disk"],
    "bad primitive": ["table", "--primitive", "0-flat"],
    "nothing left to sample": ["table", "--dim", "1", "--primitive", "line"],
    "bad format": ["table", "--format", "yaml"],
    "bad region": ["derive", "jitter", "--region", "nowhere"],
    "csv of a derivation": ["derive", "jitter", "--format", "csv"],
    "no sampler": ["derive"],
    "no command": [],
    "unknown command": ["tables"],
    "unknown option": ["table", "--dimension", "2"],
    "output into a missing folder": ["table", "--output", "/nonexistent/table.txt"],
    "output onto a folder": ["table", "--output", "/"],
    "no source": ["check", "--dim", "2"],
    "no dimension": ["check", "jitter"],
    "dim 0": ["check", "jitter", "--dim", "0"],
    "dim -1": ["check", "jitter", "--dim", "-1"],
    "dim a word": ["check", "jitter", "--dim", "two"],
    "missing file": ["check", "no-such-points.txt", "--dim", "2"],
    "missing module": ["check", "no_such_module:points", "--dim", "2"],
    "bad claim": ["check", "jitter", "--dim", "2", "--claim", "overall ~ 2"],
    "bad exponent": ["check", "jitter", "--dim", "2", "--claim", "overall/worst ~ two"],
    "claim on no region": ["check", "jitter", "--dim", "2", "--claim", "w=3/worst ~ 2"],
    "bad integrand": ["check", "jitter", "--dim", "2", "--integrand", "discus"],
    "bad parameter": ["check", "jitter", "--dim", "2", "--integrand", "disk:radius=-1"],
    "N = 0": ["check", "jitter", "--dim", "2", "--n", "0"],
    "N a word": ["check", "jitter", "--dim", "2", "--n", "many"],
    "budget 0": ["check", "jitter", "--dim", "2", "--budget", "0"],
    "budget negative": ["check", "jitter", "--dim", "2", "--budget", "-1"],
    "budget nan": ["check", "jitter", "--dim", "2", "--budget", "nan"],
    "budget infinite": ["check", "jitter", "--dim", "2", "--budget", "inf"],
    "seed -1": ["check", "jitter", "--dim", "2", "--seed", "-1"],
    "missing plan": ["check", "--plan", "no-such-plan.json"],
    "variance of nothing": ["variance", "jitter"],
    "variance of an unknown sampler": ["variance", "jitterbug", "disk", "--dim", "2", "--n", "4"],
    "variance of an unknown integrand": ["variance", "jitter", "discus", "--dim", "2", "--n", "4"],
    "variance at half a point": ["variance", "jitter", "disk", "--dim", "2", "--n", "1/2"],
    "variance at N = 0": ["variance", "jitter", "disk", "--dim", "2", "--n", "0"],
    "variance at a logarithm": ["variance", "jitter", "disk", "--dim", "2", "--n", "log:5"],
    "variance in no dimension": ["variance", "jitter", "box", "--dim", "0", "--n", "4"],
    "variance to no digits": [*DISK, "--digits", "0"],
    "variance by an unknown method": [*DISK, "--method", "magic"],
    "variance by a method not for it": [*DISK, "--method", "ridge"],
    "variance of a free profile": ["variance", "isotropic:2", "disk", "--dim", "2", "--n", "4"],
    "radial without N": ["radial", "--degree", "2", "--dim", "2", "--decay", "3"],
    "budget without a diagram": ["stress", "--budget", "3"],
    "seed without a diagram": ["stress", "--seed", "3"],
    "diagram in a file": ["stress", "--diagram", __file__],
    "diagram where nobody may": ["stress", "--diagram", "/proc/nowhere"],
    "diagram with no budget": ["stress", "--diagram", "unused", "--budget", "0"],
    "diagram with a budget that is no number": ["stress", "--diagram", "unused", "--budget", "nan"],
    "diagram with a negative seed": ["stress", "--diagram", "unused", "--seed", "-1"],
}


@pytest.mark.parametrize("arguments", BAD.values(), ids=BAD.keys())
def test_unusable_input_is_2_with_one_line_on_stderr(
    capsys: pytest.CaptureFixture[str], arguments: list[str]
) -> None:
    code, out, err = run(capsys, *arguments)
    assert code == 2
    assert out == ""
    assert err.startswith("specrate")
    assert err.count("\n") == 1
    assert err.endswith("\n")


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "null", '{"plan": 1}', '{"plan": {"dim": 2}}', '{"rows": []}']
)
def test_broken_plans_are_refused(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, text: str
) -> None:
    plan = tmp_path / "plan.json"
    plan.write_text(text)
    code, out, err = run(capsys, "check", "--plan", str(plan))
    assert (code, out, err.count("\n")) == (2, "", 1)


# Formats and files


@pytest.mark.parametrize("command", [["table", "--dim", "2"], ["derive", "jitter"], [*JITTER]])
def test_json_is_one_document_on_stdout(
    capsys: pytest.CaptureFixture[str], command: list[str]
) -> None:
    _, out, err = run(capsys, *command, "--format", "json")
    assert isinstance(json.loads(out), dict)
    assert err == ""


@pytest.mark.parametrize("form", FORMATS)
def test_output_writes_what_would_be_printed(
    capsys: pytest.CaptureFixture[str], tmp_path: Path, form: str
) -> None:
    target = tmp_path / "table"
    arguments = ("table", "--dim", "2", "--format", form)
    _, printed, _ = run(capsys, *arguments)
    code, out, err = run(capsys, *arguments, "--output", str(target))
    assert (code, out, err) == (0, "", "")
    assert target.read_text("utf-8") == printed


def test_unwritable_output_is_refused_before_any_work(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("specrate.numerics.check", None)
    code, _, _ = run(capsys, *JITTER, "--output", "/nonexistent/document.json")
    assert code == 2


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(capsys, "--version") == (0, version("specrate") + "\n", "")


# Imports


def loaded_by(*arguments: str, refuse: str = "") -> set[str]:
    """Modules that a command has loaded when it ends."""
    program = f"""
import sys
{refuse}
from specrate.report.cli import main
try:
    assert main({list(arguments)!r}) == 0
except SystemExit as stop:
    assert not stop.code
print("\\n" + " ".join(sys.modules))
"""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return set(done.stdout.splitlines()[-1].split())


@pytest.mark.parametrize(
    "command", [[], ["table"], ["derive"], ["check"], ["variance"], ["radial"], ["stress"]]
)
def test_help_is_light(command: list[str]) -> None:
    assert not loaded_by(*command, "--help") & {"sympy", "numpy", "scipy", "mpmath", "flint"}


def test_tables_are_symbolic_and_never_simplify() -> None:
    refuse = """
import sympy
def refuse(*_, **__):
    raise AssertionError("simplify")
sympy.simplify = sympy.Basic.simplify = refuse
"""
    assert not loaded_by("table", refuse=refuse) & {"numpy", "scipy"}
    assert not loaded_by("table", "--dim", "3", "--format", "json", refuse=refuse) & {"numpy"}


# Plans


def test_a_plan_replays_its_document(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    plan = tmp_path / "document.json"
    arguments = ("--seed", "7", "--integrand", "disk", "--claim", "axis/worst ~ 3/2")
    code, out, _ = run(
        capsys, *JITTER, *arguments, "--n", "256", "--budget", "2", "--format", "json"
    )
    plan.write_text(out)
    again, replayed, _ = run(capsys, "check", "--plan", str(plan), "--format", "json")
    assert again == code
    assert timeless(json.loads(replayed)) == timeless(json.loads(out))
    plan.write_text(json.dumps(json.loads(out)["plan"]))
    _, replayed, _ = run(capsys, "check", "--plan", str(plan), "--format", "json")
    assert timeless(json.loads(replayed)) == timeless(json.loads(out))


def test_seeds_are_reproducible_and_matter(capsys: pytest.CaptureFixture[str]) -> None:
    plans = []
    for seed in ("1", "1", "2"):
        arguments = ("--budget", "0.001", "--seed", seed, "--format", "json")
        plans.append(timeless(json.loads(run(capsys, *JITTER, *arguments)[1])))
    assert plans[0] == plans[1]
    assert plans[0]["points"] != plans[2]["points"]


# Interrupts and pipes


def hears_interrupts() -> None:
    """In a child: a shell starts what runs in its background deaf to them."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


def test_interrupt_prints_what_was_found() -> None:
    sampler = "uncorrelated-jitter:1+2"
    options = ("--budget", "10000", "--n", "15625", "--format", "json")
    command = ("check", sampler, "--dim", "3", "--claim", sampler, *options)
    process = launch(*command, preexec_fn=hears_interrupts)
    time.sleep(5)
    assert process.poll() is None, "the check ended before it could be interrupted"
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130
    assert json.loads(out)["interrupted"] is True
    assert "Traceback" not in err


def test_interrupt_of_an_integral_in_compiled_code() -> None:
    command = ("variance", "box-dpp", "ball:radius=1/4", "--dim", "1", "--n", "1e300")
    process = launch(*command, preexec_fn=hears_interrupts)
    time.sleep(5)
    assert process.poll() is None, "the variance was there before it could be interrupted"
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert (process.returncode, out, err) == (130, "", "specrate: interrupted\n")


def test_closed_pipe_is_no_error() -> None:
    reader, writer = os.pipe()
    os.close(reader)
    process = launch("table", "--format", "json", stdout=writer)
    os.close(writer)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 0
    assert err == ""


def test_head_of_a_table() -> None:
    command = f"{sys.executable} -m specrate.report.cli table | head -1"
    done = subprocess.run(command, shell=True, capture_output=True, text=True)
    assert done.returncode == 0
    assert done.stderr == ""
    assert done.stdout.count("\n") == 1


def test_the_installed_script_runs_this_program() -> None:
    script = Path(sys.executable).parent / "specrate"
    done = subprocess.run([script, "table", "--dim", "zero"], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.count("\n") == 1


def test_what_a_sampler_prints_is_no_part_of_the_document(tmp_path, capsys):
    """It runs in a process of its own, where what it prints stays."""
    module = tmp_path / "loud.py"
    module.write_text(
        "def loud(n, dim, rng):\n    print('NOISE')\n    return rng.random((n, dim))\n"
    )
    words = ["check", f"{module}:loud", "--dim", "2", "--claim", "random", "--budget", "0.1"]
    main([*words, "--format", "json"])
    out, err = capsys.readouterr()
    assert json.loads(out)["plan"]["dim"] == 2
    assert "NOISE" not in out + err


@pytest.mark.parametrize("extra", [["--claim", "random"], ["--seed", "5"], ["--n", "16"]])
def test_a_plan_stands_alone(extra, capsys):
    assert main(["check", "--plan", "a.json", *extra]) == 2
    assert "--plan brings its own" in capsys.readouterr().err


@pytest.mark.parametrize(
    "integrand", ["disk:radius=2", "disk:radius=-1", "disk:foo=1", "box:size=3"]
)
def test_a_table_refuses_parameters_out_of_range(integrand, capsys):
    assert main(["table", "--dim", "2", "--sampler", "jitter", "--integrand", integrand]) == 2
    out, err = capsys.readouterr()
    assert not out
    assert err.count("\n") == 1


@pytest.mark.parametrize(
    ("command", "told"),
    [
        (["check", "jitter", "--claim", "jitter"], "got no --dim"),
        (["check", "--dim", "2"], "got no SOURCE"),
        (["check"], "got no SOURCE and no --dim"),
        (["recommend", "axis/best ~ 3", "--dim", "0"], "whole number of at least 1: got 0 "),
        (["recommend", "axis/best ~ 3", "--dim", "d"], "whole number of at least 1: got d "),
    ],
)
def test_what_is_missing_is_named(
    capsys: pytest.CaptureFixture[str], command: list[str], told: str
) -> None:
    code, out, err = run(capsys, *command)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert told in err.replace("\n", " ")
