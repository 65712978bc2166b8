"""Checks of samplers with a fault: it is named, with its evidence and a remedy, and harms nobody.

The statistical faults are of a size that 128 realisations show with a probability above 1 - 1e-6.
"""

import json
from importlib.resources import files
from pathlib import Path

import jsonschema
import pytest
from specrate.numerics.checking.check_documents import check

SAMPLERS = str(Path(__file__).parent / "designs" / "samplers.py")


def own(name):
    return f"{SAMPLERS}:{name}"


def validate(found):
    """Raise unless the document is strict JSON and matches its schema."""
    text = (files("specrate.report") / "schemas" / "check.json").read_text("utf-8")
    document = json.loads(json.dumps(found, allow_nan=False))
    jsonschema.Draft202012Validator(json.loads(text)).validate(document)


def kinds(found):
    return [f["kind"] for f in found["faults"]]


FAULTY = (
    ("centred_rooks", ["n-rooks"], "bias", "fixed places"),
    ("centred_rooks", ["n-rooks"], "quantised coordinates", "the centres of 16 strata"),
    ("centred_rooks", ["n-rooks"], "not homogenised", "measured spectra hold"),
    ("fixed_rooks", ["n-rooks"], "not homogenised", "variances are judged on shifted points"),
    ("lumpy", ["random"], "bias", "E exp(-2 pi i 5 x)"),
    ("frozen", ["random"], "duplicate realisations", "1 distinct of 128"),
    ("frozen", ["random"], "not homogenised", "that of one realisation"),
    ("doubled", ["random"], "piled points", "within 2^-"),
    ("single", [], "quantised coordinates", "float32"),
    ("legacy", ["random"], "global random state", "moved the state of numpy.random"),
    ("nan", [], "not finite", "got nan on axis 2, row 3"),
    ("outside", ["random"], "outside", r"got 1.0 on axis 1, row 2"),
    ("transposed", [], "shape", "must have shape (16, 2): got (2, 16)"),
    ("raising", ["random"], "exception", "RuntimeError: no luck at"),
    ("raising_late", ["random"], "exception", "no luck today"),
    ("recursing", ["random"], "exception", "RecursionError"),
    ("refusing", ["random"], "not honoured", "or one near it (25, 32): got ValueError: 16 is no"),
    ("fewer", ["latin-hypercube"], "count", "nearest N found that it honours is 49"),
    ("leaving", ["random"], "crashes", "got exit code 3, after 'last words'"),
    ("segfaulting", ["random"], "crashes", "got signal SIGSEGV, after 'File"),
    ("enormous", ["random"], "memory", "must keep within 2048 MiB of memory for n = 16"),
)


@pytest.mark.parametrize(("name", "claims", "kind", "text"), FAULTY)
def test_faults_are_named(name, claims, kind, text):
    counts = [50] if kind == "count" else ()
    found = check(own(name), 2, claims, (), counts, budget=60)
    validate(found)
    assert found["verdict"] == "invalid"
    assert kind in kinds(found)
    assert any(text in f["detail"] for f in found["faults"] if f["kind"] == kind)
    assert all(f["remedy"] for f in found["faults"])
    assert all("\n" not in f["detail"] + f["remedy"] for f in found["faults"])


def test_a_fault_is_told_once_with_its_n():
    """The doubled points show at all three N."""
    found = check(own("doubled"), 2, ["random"], budget=60)
    assert kinds(found) == ["piled points"]
    assert found["faults"][0]["evidence"]["n"] == 16
    assert [s["replicates"] for s in found["plan"]["ladder"]] == [128] * 3


@pytest.mark.parametrize("source", [own("hanging"), "cmd:sh -c 'sleep 1000 {n} {seed}'"])
def test_a_sampler_that_never_answers_hangs(source):
    found = check(source, 2, ["random"], budget=4)
    validate(found)
    assert found["verdict"] == "invalid"
    assert kinds(found) == ["hangs"]
    fault = found["faults"][0]
    assert fault["detail"].endswith("must answer within 4 s for n = 16: got no answer")
    assert 1.0 <= fault["evidence"]["seconds"] <= found["seconds"]
    assert found["claims"][0]["holds"] is None
