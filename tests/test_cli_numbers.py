"""The commands that give numbers: what ``variance`` and ``stress`` print, write and return."""

import json
from pathlib import Path
from typing import Any

import pytest
from specrate.numerics.method_tests import stress_cases
from specrate.numerics.method_tests.radial_cases import RADIAL
from specrate.numerics.method_tests.stress import Family, Method, Outcome
from specrate.report.cli import FORMATS
from test_cli import DISK, run

# Exact variances


def test_a_variance_has_the_digits_asked_for(capsys: pytest.CaptureFixture[str]) -> None:
    words = (
        "variance",
        "jitter",
        "disk:radius=0.25",
        "--dim",
        "2",
        "--n",
        "16",
        "--format",
        "json",
    )
    code, out, err = run(capsys, *words, "--digits", "40")
    document = json.loads(out)
    assert (code, err) == (0, "")
    assert document["value"].startswith("0.003993042189316217")
    assert len(document["value"]) == len("0.00") + 40
    assert float(document["error_bound"]) < 1e-41
    assert (document["n"], document["method"]) == (16, "covariogram")


def test_fewer_digits_than_asked_are_told(capsys: pytest.CaptureFixture[str]) -> None:
    code, out, err = run(capsys, *DISK, "--method", "lattice", "--format", "json")
    assert code == 0
    assert json.loads(out)["method"] == "lattice"
    assert err.startswith("specrate: 15 digits were asked for, the method lattice gives ")
    assert err.count("\n") == 1


def test_another_n_than_asked_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    _, out, _ = run(capsys, "variance", "jitter", "disk", "--dim", "2", "--n", "17")
    assert "N = 16\n" in out
    assert "left out: N = 17: " in out


# Stiff cases


def few_cases() -> tuple[Family[Any], ...]:
    """One kind of problem, by two methods."""
    return (Family(RADIAL.name, RADIAL.problems[:2], RADIAL.methods[:2], RADIAL.references),)


def test_stress_is_0_if_all_is_honest(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stress_cases, "FAMILIES", few_cases())
    for form in FORMATS:
        code, out, err = run(capsys, "stress", "--format", form)
        assert (code, err) == (0, "")
        assert out


def test_an_interrupted_stress_prints_what_it_has(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(_: Any) -> Outcome:
        raise KeyboardInterrupt

    (few,) = few_cases()
    stopped = Family(
        few.name, few.problems, (few.methods[0], Method("slow", interrupt)), few.references
    )
    monkeypatch.setattr(stress_cases, "FAMILIES", (stopped,))
    code, out, _ = run(capsys, "stress", "--format", "json")
    assert code == 130
    assert len(json.loads(out)["cases"]) == 1


def test_a_diagram_is_four_files(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    folder = tmp_path / "new" / "diagram"
    words = ("stress", "--diagram", str(folder), "--budget", "1e-9", "--seed", "5")
    code, out, err = run(capsys, *words, "--format", "json")
    assert code == 0
    assert err == f"written to {folder}: work_precision.json, .csv, .png, .svg\n"
    assert {p.name for p in folder.iterdir()} == {
        f"work_precision.{form}" for form in ("json", "csv", "png", "svg")
    }
    assert json.loads((folder / "work_precision.json").read_text()) == json.loads(out)
    assert json.loads(out)["plan"]["seed"] == 5


def test_a_diagram_needs_matplotlib(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    code, out, err = run(capsys, "stress", "--diagram", str(tmp_path / "diagram"))
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "matplotlib" in err
    assert not (tmp_path / "diagram").exists()
