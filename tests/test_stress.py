"""The stiff cases: every answer is honest, the judge sees what is not, no entry is stale."""

import json
from math import inf, nan, pi, prod, sin
from typing import Any

import pytest
from specrate.numerics.balls import flint
from specrate.numerics.exact_variances import variances
from specrate.numerics.exact_variances.crossovers import crossovers
from specrate.numerics.integrands.protocol import mp
from specrate.numerics.method_tests import stress_cases
from specrate.numerics.method_tests.radial_cases import RADIAL
from specrate.numerics.method_tests.spectrum_cases import SPECTRA
from specrate.numerics.method_tests.stress import (
    Family,
    Method,
    Outcome,
    Reference,
    is_honest,
    relative_errors,
    stress,
)
from specrate.numerics.method_tests.variance_cases import VARIANCES
from specrate.report.cli import main
from specrate.theory.errors import InputError

FAMILIES = stress_cases.FAMILIES


# The table of problems and methods


@pytest.fixture(scope="module")
def document() -> dict[str, Any]:
    """Every case, once."""
    return stress(FAMILIES)


def test_every_case_is_honest(document):
    assert [c for c in document["cases"] if not c["honest"]] == []
    assert document["honest"] is True
    assert document["interrupted"] is False


def test_bounds_and_estimates_are_worth_something(document):
    """Not only honest: certified methods have their digits, all but lattice sums have ten."""
    for c in document["cases"]:
        if c["refused"] or c["method"] == "lattice" or "b = 1e6, best" in c["name"]:
            continue
        assert c["error_bound"] <= 1e-10, c
        if c["method"] in ("closed", "quadrature"):
            assert c["error_bound"] <= 1e-48, c


def test_names_are_unique():
    names = [f"{f.name}: {name}" for f in FAMILIES for name, _ in f.problems]
    assert len(set(names)) == len(names)
    assert len({f.name for f in FAMILIES}) == len(FAMILIES)
    for family in FAMILIES:
        for table in (family.methods, family.references):
            keys = [getattr(x, "name", None) or x.route for x in table]
            assert len(set(keys)) == len(keys)


def test_no_entry_is_stale(document):
    """Every method answers somewhere, every problem is attempted, every reference is one."""
    cases = document["cases"]
    for family in FAMILIES:
        mine = [c for c in cases if c["name"].startswith(f"{family.name}: ")]
        answered = {c["method"] for c in mine if not c["refused"]}
        assert answered == {m.name for m in family.methods}
        assert {c["name"] for c in mine} == {
            f"{family.name}: {name}" for name, _ in family.problems
        }
        routes = {r.route for r in family.references}
        assert {c["reference"] for c in mine} <= routes
        assert {m.route for m in family.methods} - {""} <= routes | {"lattice"}


def test_every_route_to_a_variance_has_a_case():
    routes = set(variances._ROUTES)
    assert routes <= {m.name for m in VARIANCES.methods}


def test_where_two_routes_are_certified_a_method_meets_the_other(document):
    for c in document["cases"]:
        if c["name"].startswith("Eq. 17") and c["method"] in ("closed", "quadrature"):
            assert {c["method"], c["reference"]} == {"closed", "quadrature"}


def test_the_crossovers_lie_between_the_cases():
    pairs: dict[tuple[str, str], list[int]] = {}
    problems: dict[tuple[str, str], Any] = {}
    for _, p in VARIANCES.problems:
        if p.integrand.name.startswith("anisotropic"):
            key = (p.sampler.name, p.integrand.name)
            pairs.setdefault(key, []).append(p.counts["N"])
            problems[key] = p
    assert len(pairs) == 3
    for key, (below, above) in pairs.items():
        (meeting,) = crossovers(problems[key].sampler, problems[key].integrand)
        assert below < meeting.count < above


# The judge


def naive_eq_17(problem: Any) -> Outcome:
    """The textbook closed form in doubles, without expm1, which claims 13 digits."""
    b, s, p = float(problem.degree), problem.dimension, float(problem.decay)
    q, n = p - s, float(problem.count)
    nu, rho0 = float(problem.alpha) * n ** float(problem.effective), float(problem.rho0)
    c2 = rho0**p
    inner = rho0 ** (s + b) / (s + b) - c2 * rho0 ** (b - q) / (b - q)
    value = (nu**-q * c2 * b / (q * (b - q)) + nu**-b * inner) / n
    return Outcome(mp.mpf(value), mp.mpf(abs(value) * 1e-13), "estimate")


def naive_spectrum(problem: Any) -> Outcome:
    """1 − ∏ sinc² in doubles, which claims 13 digits."""
    x = [pi * k / problem.counts["n"] for k in problem.m]
    value = 1 - prod((sin(v) / v) ** 2 if v else 1.0 for v in x)
    return Outcome(mp.mpf(value), mp.mpf(abs(value) * 1e-13), "estimate")


def only(family: Family[Any], method: Method[Any], *names: str) -> Family[Any]:
    problems = tuple((n, p) for n, p in family.problems if not names or n in names)
    return Family(family.name, problems, (method,), family.references)


NAIVE_RADIAL = only(RADIAL, Method("naive", naive_eq_17), "b - q = 1e-9", "alpha = 1e30", "b = 1e6")
JITTER = [n for n, _ in SPECTRA.problems if n.startswith("jitter, N = 1e12")]
NAIVE_SPECTRA = only(SPECTRA, Method("naive", naive_spectrum), *JITTER)


def test_the_judge_sees_naive_formulas():
    cases = {c["name"]: c for c in stress([NAIVE_RADIAL, NAIVE_SPECTRA])["cases"]}
    tie = cases["Eq. 17: b - q = 1e-9"]
    assert not tie["honest"]
    assert tie["relative_error"] > 1e-10 > tie["error_bound"]
    assert tie["why"] == "its estimate of the error is below the error"
    low = cases["N P_S: jitter, N = 1e12, m = (1, 1)"]
    assert not low["honest"]
    assert low["relative_error"] > 1e-9
    # and where they are right they are not accused
    assert cases["Eq. 17: alpha = 1e30"]["honest"]
    assert cases["N P_S: jitter, N = 1e12, m = (1000000, 1000000)"]["honest"]


@pytest.mark.parametrize("family", [NAIVE_RADIAL, NAIVE_SPECTRA])
def test_the_command_calls_them_dishonest(monkeypatch, capsys, family):
    monkeypatch.setattr(stress_cases, "FAMILIES", (family,))
    assert main(["stress", "--format", "json"]) == 1
    document = json.loads(capsys.readouterr().out)
    assert document["honest"] is False
    accused = [c for c in document["cases"] if not c["honest"]]
    assert accused
    assert main(["stress"]) == 1
    first, line, *_ = capsys.readouterr().out.splitlines()
    assert first.startswith(f"DISHONEST: {len(accused)} of {len(document['cases'])} answers")
    assert line == f"  {accused[0]['name']}, naive: {accused[0]['why']}"


def judge(evaluate: Any, truth: Any = 1, route: str = "") -> dict[str, Any]:
    """The one case of a method on a problem with a known value."""
    reference = Reference[None]("known", lambda _: flint.arb(truth))
    family = Family[None](
        "test", (("case", None),), (Method("method", evaluate, route),), (reference,)
    )
    return stress([family])["cases"][0]


def test_there_is_no_slack():
    gap = mp.mpf(2) ** -20
    assert judge(lambda _: Outcome(1 + gap, gap, "estimate"))["honest"]
    with mp.workdps(40):
        short = gap * (1 - mp.mpf(10) ** -12)
    for kind in ("bound", "estimate"):
        found = judge(lambda _, kind=kind: Outcome(1 + gap, short, kind))
        assert not found["honest"]
        assert found["error_kind"] == kind


def test_a_clear_refusal_is_honest_and_a_failure_is_not():
    def refuse(_: None) -> Outcome:
        raise InputError("N must be at most 10: got " + "1" * 1000)

    def fail(_: None) -> Outcome:
        raise ZeroDivisionError("float division by zero")

    refused, failed = judge(refuse), judge(fail)
    assert (refused["honest"], refused["refused"]) == (True, True)
    assert refused["relative_error"] is refused["value"] is None
    assert refused["why"].startswith("refused: N must be at most 10")
    assert len(refused["why"]) < 200
    assert (failed["honest"], failed["refused"]) == (False, False)
    assert failed["why"] == "failed: ZeroDivisionError: float division by zero"


@pytest.mark.parametrize(("value", "error"), [(nan, 1.0), (1.0, nan), (inf, 1.0), (1.0, inf)])
def test_what_is_not_a_number_is_no_answer(value, error):
    found = judge(lambda _: Outcome(mp.mpf(value), mp.mpf(error), "estimate"))
    assert not found["honest"]
    assert found["why"].startswith("not a number")
    json.dumps(found, allow_nan=False)


def test_a_true_zero_is_judged_absolutely():
    assert judge(lambda _: Outcome(mp.mpf(0), mp.mpf(0), "bound"), 0)["honest"]
    found = judge(lambda _: Outcome(mp.mpf("1e-20"), mp.mpf("1e-30"), "bound"), 0)
    assert not found["honest"]
    assert found["relative_error"] == pytest.approx(1e-20)


def test_a_reference_of_too_few_digits_is_none():
    few = Reference[None]("few", lambda _: flint.arb(1, 1e-20))
    exact = Reference[None]("exact", lambda _: flint.arb(1))
    method = Method[None]("method", lambda _: Outcome(mp.mpf(1), mp.mpf(0), "bound"))
    family = Family("test", (("case", None),), (method,), (few, exact))
    assert stress([family])["cases"][0]["reference"] == "exact"
    with pytest.raises(AssertionError, match="reference"):
        stress([Family("test", (("case", None),), (method,), (few,))])


def test_a_reference_is_computed_once_and_avoids_the_methods_own_route():
    calls: list[str] = []

    def route(name: str) -> Reference[None]:
        return Reference(name, lambda _: (calls.append(name), flint.arb(2))[1])

    def method(name: str, of: str) -> Method[None]:
        return Method(name, lambda _: Outcome(mp.mpf(2), mp.mpf(0), "bound"), of)

    methods = (method("a", "first"), method("b", "second"), method("c", ""), method("d", "first"))
    family = Family("test", (("case", None),), methods, (route("first"), route("second")))
    assert [c["reference"] for c in stress([family])["cases"]] == [
        *("second", "first"),
        *("first", "second"),
    ]
    assert sorted(calls) == ["first", "second"]


def test_an_interrupt_keeps_what_was_finished():
    def interrupt(_: None) -> Outcome:
        raise KeyboardInterrupt

    good = Method[None]("good", lambda _: Outcome(mp.mpf(1), mp.mpf(0), "bound"))
    reference = Reference[None]("known", lambda _: flint.arb(1))
    family = Family("test", (("case", None),), (good, Method("bad", interrupt)), (reference,))
    found = stress([family])
    assert found["interrupted"] is True
    assert [c["method"] for c in found["cases"]] == ["good"]


def test_errors_keep_their_digits():
    """Errors far below double precision, of values far beyond its range."""
    with mp.workdps(200):
        value, error = mp.mpf(10) ** -5000 * (1 + mp.mpf(10) ** -90), mp.mpf(10) ** -5089
    with flint.ctx.workprec(800):
        truth = flint.arb(10) ** -5000
    true_error, reported = relative_errors(Outcome(value, error, "bound"), truth)
    assert true_error == pytest.approx(1e-90, rel=1e-6)
    assert reported == pytest.approx(1e-89, rel=1e-6)
    assert is_honest(Outcome(value, error, "bound"), truth)
