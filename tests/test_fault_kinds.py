"""Kinds of faults: each has a remedy, which takes up what the evidence shows."""

import json
from importlib.resources import files

import pytest
from specrate.numerics.point_sources.fault_kinds import REMEDIES, Fault, fault_of
from specrate.numerics.point_sources.realisations import SamplerFault


def test_the_schema_lists_the_kinds() -> None:
    text = (files("specrate.report") / "schemas" / "check.json").read_text("utf-8")
    kind = json.loads(text)["properties"]["faults"]["items"]["properties"]["kind"]
    assert set(kind["enum"]) == set(REMEDIES)


@pytest.mark.parametrize(
    ("kind", "evidence", "text"),
    [
        ("exception", {"n": 50}, "run the sampler alone with n = 50"),
        ("shape", {"asked": [9, 2], "got": [2, 9]}, "return the transpose"),
        ("shape", {"asked": [9, 2], "got": [9]}, "return an array of shape (n, dim)"),
        ("count", {"asked": 50, "got": 49, "nearest": 49}, "ask for N = 49; else give n points"),
        ("count", {"asked": 50, "got": 49}, "give n points, or refuse n"),
        ("outside", {"value": 1.0}, "map the end 1 to 0"),
        ("outside", {"value": -3.0}, "reduce coordinates modulo 1"),
        ("hangs", {"n": 16, "seconds": 3.0}, "alone with n = 16; if it does end, give a larger"),
        ("hangs", {"seconds": 3.0}, "nothing long when it is imported"),
        ("crashes", {"n": 16}, "alone with n = 16, and mend what ends it"),
        ("crashes", {}, "import the module alone"),
        ("piled points", {"location": [0.0, 0.0]}, "rows were left at the origin"),
        ("piled points", {"location": [0.0, 0.1]}, "draw a new place for every point"),
        ("quantised coordinates", {"spacing": 2.0**-24, "strata": None}, "(dtype float64)"),
        ("quantised coordinates", {"spacing": 1e-6, "strata": None}, "17 significant digits"),
        ("quantised coordinates", {"spacing": 1 / 49, "strata": 49}, "jitter inside the strata"),
        ("duplicate realisations", {}, "point file"),
        ("global random state", {}, "from the generator (of a command: the seed)"),
    ],
)
def test_remedies(kind: str, evidence: dict[str, object], text: str) -> None:
    assert text in Fault(kind, "detail", evidence).remedy


@pytest.mark.parametrize("kind", [k for k, found in REMEDIES.items() if isinstance(found, str)])
def test_fixed_remedies_are_lines(kind: str) -> None:
    found = Fault(kind, "detail", {}).remedy
    assert found
    assert "\n" not in found


def test_what_a_source_raises_is_a_fault() -> None:
    found = fault_of(SamplerFault("memory", "too much", {"n": 16}))
    assert found == Fault("memory", "too much", {"n": 16})
    with pytest.raises(KeyError):
        _ = Fault("unheard of", "detail", {}).remedy
