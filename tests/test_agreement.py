"""Exact variances against Monte Carlo, in short; the long run is recorded in docs/validation.md."""

from dataclasses import replace

import pytest
from specrate.numerics.integrands import CATALOGUE
from specrate.numerics.method_tests.agreement import Pair, integrands, main, pairs, samplers
from specrate.theory.samplers import FAMILIES

_FAR = 8.0
"""Standard errors of 512 replicates: 1e-9 for the chi-square-like errors seen here, per pair."""

CASES = [(1, "jitter"), (2, "multi-jitter:2x8"), (2, "correlated-multi-jitter"), (3, "random")]


@pytest.fixture(scope="module", params=CASES, ids=str)
def measured(request: pytest.FixtureRequest) -> list[Pair]:
    dim, name = request.param
    return list(pairs(next(s for s in samplers(dim) if s.name == name), 16, 512, 7))


def test_exact_and_measured_agree(measured: list[Pair]) -> None:
    assert max(p.sigmas for p in measured) < _FAR


def test_a_wrong_variance_is_seen(measured: list[Pair]) -> None:
    """Power: twice the exact value is outside the band for every pair that has a variance."""
    for pair in measured:
        if pair.exact.value > 1e-20:
            wrong = replace(pair, exact=replace(pair.exact, value=2 * pair.exact.value))
            assert wrong.sigmas > _FAR, pair.integrand.name


def test_nothing_of_the_catalogue_is_missing() -> None:
    families = {s.family for dim in (1, 2, 3) for s in samplers(dim)}
    theory_only = {"isotropic"}
    assert families | theory_only >= {f.name for f in FAMILIES}
    names = {f.name.partition(":")[0] for dim in (1, 2, 3) for f in integrands(dim)}
    # half-spaces and equal widths are written as what they are: boxes and Gaussians
    assert names | {"half-space", "anisotropic-gaussian", "ball", "disk"} >= {
        e.name for e in CATALOGUE
    }


def test_the_command_prints_a_row_for_each_sampler(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    samplers = {1: ("random", "jitter")}
    monkeypatch.setattr("specrate.numerics.method_tests.agreement._SAMPLERS", samplers)
    assert main(["--replicates", "256", "--seed", "3"]) == 0
    out = capsys.readouterr().out
    assert out.count("\n| ") == 2
    assert "0 pairs outside 5 standard errors" in out
