"""Documents match their published JSON Schemas; with a field missing or wrong they do not."""

import copy
import json
from importlib.resources import files
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from specrate.numerics import check
from specrate.numerics.integrands.protocol import mp
from specrate.numerics.method_tests.radial_cases import RADIAL
from specrate.numerics.method_tests.stress import Family, Method, Outcome, stress
from specrate.numerics.method_tests.work_precision import work_precision
from specrate.report.cli import main
from specrate.theory.errors import InputError

COMMANDS = (
    *("table", "derive", "check", "variance", "radial", "stress", "work_precision"),
    *("recommend", "prove"),
)

CROSSING = ("table", "--dim", "2", "--sampler", "n-rooks", "--integrand", "anisotropic-gaussian")

# A point set that is no sampler: every coordinate is a multiple of 1/4, in every realisation.
QUANTISED = """
import numpy as np

def lattice(n, dim, rng):
    return rng.integers(0, 4, (n, dim)) / 4
"""


def schema(name: str) -> dict[str, Any]:
    """The schema that ships with the package."""
    return json.loads((files("specrate.report") / "schemas" / f"{name}.json").read_text("utf-8"))


def validate(name: str, document: Any) -> None:
    """Raise unless the document is strict JSON and matches its schema."""
    text = json.dumps(document, allow_nan=False)
    jsonschema.Draft202012Validator(schema(name)).validate(json.loads(text))


def printed(capsys: pytest.CaptureFixture[str], *arguments: str) -> Any:
    """The JSON document that a command prints."""
    main([*arguments, "--format", "json"])
    return json.loads(capsys.readouterr().out)


@pytest.fixture(scope="module")
def documents(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """Checks with each verdict."""
    source = tmp_path_factory.mktemp("designs") / "quantised.py"
    source.write_text(QUANTISED)
    rate = "axis/worst ~ 3"
    return {
        "consistent": check("jitter", 2, ["jitter"], counts=[16, 64], budget=20),
        "contradicted": check("random", 2, ["jitter"], counts=[16, 64], budget=20),
        "exponent": check("random", 1, [rate], budget=20),
        "invalid": check(f"{source}:lattice", 2, counts=[64], budget=20),
        "inconclusive": check("jitter", 2, ["jitter"], counts=[256], budget=1e-3),
    }


@pytest.mark.parametrize("name", COMMANDS)
def test_schemas_are_schemas(name: str) -> None:
    found = schema(name)
    jsonschema.Draft202012Validator.check_schema(found)
    assert found["$schema"].endswith("2020-12/schema")
    assert found["title"]
    assert found["description"]
    assert "$id" not in found


def test_every_schema_has_a_command() -> None:
    folder = files("specrate.report") / "schemas"
    assert {Path(str(f)).stem for f in folder.iterdir()} >= set(COMMANDS)


@pytest.mark.parametrize(
    "arguments",
    [
        (),
        ("--dim", "1", "--dim", "2", "--dim", "3"),
        ("--sampler", "uncorrelated-jitter:2+(d-2)", "--integrand", "additive"),
        ("--dim", "2", "--integrand", "anisotropic-gaussian"),
        ("--dim", "3", "--primitive", "segment", "--integrand", "ball"),
    ],
)
def test_tables(capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...]) -> None:
    validate("table", printed(capsys, "table", *arguments))


def test_tables_hold_what_their_schema_is_for(capsys: pytest.CaptureFixture[str]) -> None:
    split = printed(
        capsys, "table", "--sampler", "uncorrelated-jitter:2+(d-2)", "--integrand", "additive"
    )
    assert [r["condition"] for r in split["rows"] if r["overall"]] == ["d <= 4", "d >= 4"]
    assert split["left_out"]
    meeting = printed(capsys, *CROSSING)
    assert [float(x["n"]) for x in meeting["crossovers"]] == [pytest.approx(42.293, rel=1e-4)]


@pytest.mark.parametrize(
    "arguments",
    [
        ("multi-jitter",),
        ("regular", "--integrand", "best"),
        ("isotropic:b",),
        ("uncorrelated-jitter:1+2+(d-3)", "--region", "within"),
        ("correlated-multi-jitter", "--dim", "2", "--integrand", "p=5/2"),
        ("jitter", "--primitive", "line", "--integrand", "ball"),
    ],
)
def test_derivations(capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...]) -> None:
    validate("derive", printed(capsys, "derive", *arguments))


def test_checks_match_their_schema_whatever_the_verdict(documents: dict[str, Any]) -> None:
    for document in documents.values():
        validate("check", document)


def test_checks_have_the_verdicts_that_they_were_made_for(documents: dict[str, Any]) -> None:
    verdicts = {name: d["verdict"] for name, d in documents.items()}
    assert verdicts == {
        "consistent": "consistent",
        "contradicted": "contradicted",
        "exponent": "contradicted",
        "invalid": "invalid",
        "inconclusive": "inconclusive",
    }
    assert documents["contradicted"]["claims"][0]["witness"]["what"] == "N P_S(m)"
    assert documents["exponent"]["claims"][0]["witness"]["what"] == "exponent"
    assert documents["invalid"]["faults"]


VARIANCES = (
    ("jitter", "disk:radius=0.3", "--dim", "2", "--n", "1e6"),
    ("jitter", "disk:radius=0.3", "--dim", "2", "--n", "1000", "--method", "lattice"),
    ("random", "product:k=2", "--dim", "1000", "--n", "1e300", "--digits", "40"),
    ("latin-hypercube", "box:side=(1/3,1)", "--dim", "2", "--n", "1e30"),
    ("regular", "ridge:k=(1,-1)", "--dim", "2", "--n", "101"),
)


@pytest.mark.parametrize("arguments", VARIANCES)
def test_variances(capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...]) -> None:
    validate("variance", printed(capsys, "variance", *arguments))


RADIALS = (
    ("--degree", "2", "--dim", "2", "--decay", "3", "--n", "1e6"),
    ("--degree", "1e6", "--dim", "1", "--decay", "oo", "--n", "log:5000"),
    ("--degree", "1", "--dim", "1", "--decay", "2", "--n", "1e30", "--rho0", "1e12"),
    ("--degree", "1e6", "--dim", "2", "--decay", "3", "--n", "4", "--rho0", "1e12"),
)


@pytest.mark.parametrize("arguments", RADIALS)
def test_radials(capsys: pytest.CaptureFixture[str], arguments: tuple[str, ...]) -> None:
    validate("radial", printed(capsys, "radial", *arguments))


@pytest.fixture(scope="module")
def stressed() -> Any:
    """Answers of every kind: right, wrong, refused, failed."""

    def refuse(_: Any) -> Outcome:
        raise InputError("N must be at most 10: got 11")

    wrong = Method[Any]("wrong", lambda _: Outcome(mp.mpf(3), mp.mpf(0), "bound"))
    failing = Method[Any]("failing", lambda _: Outcome(mp.nan, mp.mpf(0), "estimate"))
    methods = (*RADIAL.methods[:3], wrong, failing, Method[Any]("none", refuse))
    return stress([Family(RADIAL.name, RADIAL.problems[:2], methods, RADIAL.references)])


def test_stress_matches_its_schema(stressed: Any) -> None:
    validate("stress", stressed)
    assert [c["honest"] for c in stressed["cases"][:6]] == [True, True, True, False, False, True]


def test_work_precision_matches_its_schema() -> None:
    validate("work_precision", work_precision(1e-9))


def _paths(value: Any, schema_: dict[str, Any], root: dict[str, Any]) -> list[tuple[Any, ...]]:
    """Paths of all required fields of a document, by its schema; of a list the first element."""
    schema_ = root["$defs"][schema_["$ref"].split("/")[-1]] if "$ref" in schema_ else schema_
    if isinstance(value, list) and value and "items" in schema_:
        return [(0, *p) for p in _paths(value[0], schema_["items"], root)]
    if not isinstance(value, dict) or "properties" not in schema_:
        return []
    found: list[tuple[Any, ...]] = []
    for key in schema_["required"]:
        found.append((key,))
        found += [(key, *p) for p in _paths(value[key], schema_["properties"][key], root)]
    return found


def _mutants(name: str, document: Any) -> list[Any]:
    """The document without each required field in turn, and with an object in its place."""
    root = schema(name)
    found: list[Any] = []
    for *path, last in _paths(document, root, root):
        for change in ("missing", "wrong"):
            mutant = copy.deepcopy(document)
            place = mutant
            for key in path:
                place = place[key]
            if change == "missing":
                del place[last]
            else:
                place[last] = {"surprise": 1}
            found.append(mutant)
    return found


def test_mutated_documents_are_rejected(
    capsys: pytest.CaptureFixture[str], documents: dict[str, Any], stressed: Any
) -> None:
    whole = {
        "table": printed(capsys, *CROSSING),
        "derive": printed(capsys, "derive", "jitter"),
        "check": documents["contradicted"],
        "variance": printed(capsys, "variance", *VARIANCES[3]),
        "radial": printed(capsys, "radial", *RADIALS[0]),
        "stress": stressed,
        "work_precision": work_precision(1e-9),
    }
    for name, document in whole.items():
        mutants = _mutants(name, document)
        assert len(mutants) > 2 * len(schema(name)["required"])
        for mutant in mutants:
            if mutant.get("plan", {}).get("frequencies") == {"surprise": 1}:
                continue  # an object it is
            with pytest.raises(jsonschema.ValidationError):
                validate(name, mutant)


@pytest.mark.parametrize("name", ["table", "derive"])
def test_unknown_fields_are_rejected(capsys: pytest.CaptureFixture[str], name: str) -> None:
    document = printed(capsys, name, *(["jitter"] if name == "derive" else []))
    document["surprise"] = 1
    with pytest.raises(jsonschema.ValidationError):
        validate(name, document)
