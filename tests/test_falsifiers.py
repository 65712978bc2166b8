"""Falsifiers: wrong samplers get the simplest witness, right ones none; exact ones need no noise.

False alarms: each search contradicts a correct sampler with a probability of at most 1e-5, and the
seeds are fixed. Power: jitter that forgets an axis has twice the claimed variance at least, where
1024 realisations leave an interval of level 6e-7 of about a quarter to either side.

A partial function has no name to import it by and is called in this process, which is quicker.
"""

import builtins
import os
import subprocess
import sys
import time
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.exact_variances.variances import exact_variance
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.falsification.exact_falsifiers import common_counts, falsify_exactly
from specrate.numerics.falsification.falsifiers import falsify
from specrate.numerics.falsification.low_frequencies import (
    canonical,
    low_frequencies,
    simplicity,
    worst_ridges,
)
from specrate.numerics.falsification.searches import CONFIRMATIONS, LEVEL
from specrate.theory.errors import InputError
from specrate.theory.samplers import parse_sampler


def jitter(n, dim, rng):
    side = round(n ** (1 / dim))
    if side**dim != n:
        raise ValueError(f"n must be a whole power {dim}: got {n}")
    return (np.indices((side,) * dim).reshape(dim, -1).T + rng.random((n, dim))) / side


def forgetful(n, dim, rng):
    """The second coordinate is not stratified; on the line nothing is wrong."""
    points = jitter(n, dim, rng)
    points[:, 1:2] = rng.random((n, dim))[:, 1:2]
    return points


def coupled(n, dim, rng):
    """Pairs of coordinates are independent, all three are not: x + y − z is 0 modulo 1."""
    points = rng.random((n, dim))
    if dim == 3:
        points[:, 2] = (points[:, 0] + points[:, 1]) % 1.0
    return points


def fifteenths(n, dim, rng):
    """Independent cells of 1/15, one offset for all points: wrong at multiples of 15 alone."""
    return (rng.integers(0, 15, (n, dim)) + rng.random(dim)) / 15


def hanging(n, dim, rng):
    while True:
        time.sleep(1)


def crashing(n, dim, rng):
    os.abort()


def leaving(n, dim, rng):
    raise SystemExit(0)


def undefined(n, dim, rng):
    return np.full((n, dim), np.nan)


def test_the_smallest_dimension_and_the_lowest_frequency_are_found():
    found = falsify(forgetful, "jitter", budget=60)
    assert found is not None
    assert (found.dim, found.frequency, found.integrand) == (2, (0, 1), "ridge:k=(0,1)")
    assert found.measured.low > found.predicted
    exact = exact_variance(parse_sampler("jitter", 2), {"N": found.n, "n": round(found.n**0.5)},
                           _ridge(found))  # fmt: skip
    assert found.predicted == pytest.approx(float(exact.value), rel=1e-12)
    assert found.false_alarm == 1e-5
    assert found.realisations >= 128
    assert "forgetful is not jitter: variance of ridge:k=(0,1) in 2D" in str(found)


def _ridge(found):
    from specrate.numerics.integrands.grammar import parse_integrand

    return parse_integrand(found.integrand, found.dim)


def test_a_coupling_of_three_coordinates_is_found_in_three_dimensions():
    found = falsify(partial(coupled), "random", dims=(1, 2, 3), seed=1, budget=60)
    assert found is not None
    assert (found.dim, found.frequency) == (3, (1, 1, -1))


def test_frequencies_beyond_the_low_ones_are_proposed():
    found = falsify(partial(fifteenths), "random", dims=(1,), budget=60)
    assert found is not None
    assert found.frequency == (15,)


def test_a_search_repeats_itself():
    first, again = (falsify(partial(forgetful), "jitter", (2,), 5, 60) for _ in range(2))
    assert first is not None
    assert replace(first, source="") == replace(again, source="")


def test_a_correct_sampler_has_no_witness():
    assert falsify(partial(jitter), "jitter", dims=(1,), budget=60) is None


def test_a_slow_variance_contradicts_a_rate():
    found = falsify(partial(coupled), "axis/best ~ 2", dims=(1, 2), budget=60)
    assert found is not None
    assert (found.dim, found.frequency, found.quantity) == (1, (1,), "variance")
    assert found.measured.low > found.predicted
    assert "drift at finite N" in found.detail


def test_a_faster_variance_is_no_witness():
    assert falsify(partial(jitter), "axis/best ~ 2", dims=(1,), budget=60) is None


def test_confirmations_share_the_false_alarms():
    assert CONFIRMATIONS * LEVEL <= 1e-5


@pytest.mark.parametrize(
    ("source", "claim", "dim", "frequency"),
    [
        ("random", "jitter", 1, (1,)),
        ("latin-hypercube", "jitter", 2, (1, 0)),
        ("multi-jitter", "jitter", 2, (1, 0)),
        ("uncorrelated-jitter:1+2", "jitter", 3, (1, 0, 0)),
        ("multi-jitter", "correlated-multi-jitter", 2, (1, 1)),
    ],
)
def test_exact_spectra_differ_at_the_lowest_frequency(source, claim, dim, frequency):
    found = falsify(source, claim)
    assert found is not None
    assert (found.dim, found.frequency, found.realisations) == (dim, frequency, 0)
    own, other = (parse_sampler(s, dim) for s in (source, claim))
    simpler = [m for m in low_frequencies(dim) if simplicity(m) < simplicity(frequency)]
    for n in common_counts(own, other):
        for m in simpler:
            a, b = (float(power_array(s, s.counts_at(n), np.array(m))) for s in (own, other))
            assert max(a, b) <= 1.25 * min(a, b) + 1e-20


@pytest.mark.parametrize(
    ("source", "claim"),
    [
        ("jitter", "jitter"),
        ("jitter", "uncorrelated-jitter:2"),
        ("uncorrelated-jitter:1+1", "latin-hypercube"),
        ("jitter", "overall/disk ~ 3/2"),
        ("multi-jitter", "axis/best ~ 3"),
        ("jitter", "axis/worst ~ 1"),
    ],
)
def test_what_is_true_has_no_exact_witness(source, claim):
    assert falsify_exactly(source, claim, (1, 2, 3)) is None


@pytest.mark.parametrize(
    ("source", "claim", "dim", "integrand"),
    [
        ("jitter", "axis/best ~ 3", 2, "ridge:k=(1,0),b=6"),
        ("latin-hypercube", "generic/worst ~ 3/2", 2, "ridge:k=(1,1),b=1"),
        ("jitter", "overall/disk ~ 2", 2, "disk:radius=0.3"),
        ("jitter", "1,2/best ~ 5/2", 2, "ridge:k=(1,1),b=6"),
    ],
)
def test_a_derived_order_that_is_slower_has_an_exact_witness(source, claim, dim, integrand):
    found = falsify(source, claim)
    assert found is not None
    assert (found.dim, found.integrand) == (dim, integrand)
    assert found.measured.estimate > 1.25 * found.predicted
    assert found.is_exact
    assert "continued from N = 64" in str(found)


def test_a_vanishing_variance_can_be_claimed_of_the_grid_alone():
    assert falsify("regular", "axis/best ~ oo", (1,)) is None
    found = falsify("jitter", "axis/best ~ oo", (1,))
    assert found is not None
    assert (found.quantity, found.measured.estimate) == ("exponent", 3.0)


@given(st.integers(1, 5), st.integers(1, 4))
def test_low_frequencies_are_one_of_each_pair_in_order(dim, radius):
    found = low_frequencies(dim, radius)
    assert len(set(found)) == len(found)
    assert all(canonical(m) == m and any(m) for m in found)
    assert list(found) == sorted(found, key=simplicity)
    inside = sum(sum(map(abs, m)) <= radius for m in found)
    box = np.indices((2 * radius + 1,) * dim).reshape(dim, -1) - radius
    assert 2 * inside + 1 == int((np.abs(box).sum(axis=0) <= radius).sum())


def test_worst_ridges_are_the_largest_of_the_exact_spectrum():
    sampler = parse_sampler("latin-hypercube", 2)
    found = worst_ridges(sampler, 64, 4)
    counts = sampler.counts_at(64)
    powers = 64 * power_array(sampler, counts, np.array(low_frequencies(2)))
    assert found[0].integrand == "ridge:k=(1,1)"
    assert found[0].scaled_power == pytest.approx(float(powers.max()), rel=1e-9)
    assert [f.scaled_power for f in found] == sorted((f.scaled_power for f in found), reverse=True)
    assert worst_ridges(parse_sampler("jitter", 2), 16)[0].frequency == (4, 0)


@pytest.mark.parametrize(
    ("arguments", "rule"),
    [
        ((jitter, "no such claim"), "must be usable in one of the dimensions 1, 2, 3"),
        ((jitter, "jitter", ()), "a search needs dims"),
        ((jitter, "jitter", (1,), 0, 0.0), "a search needs dims"),
        (("difference-jitter", "jitter", (2,)), "difference-jitter is for --dim 1"),
        (("isotropic:b", "jitter"), "must have points"),
        ((jitter, "jitter", "2"), "dims being a list of whole numbers: got '2'"),
        ((jitter, "jitter", 2), "dims being a list of whole numbers: got 2"),
        ((jitter, "jitter", ("2",)), "the dimension must be a whole number: got '2'"),
        ((jitter, "jitter", (0,)), "the dimension must be at least 1: got 0"),
        ((jitter, None), "a claim must be a text: got None"),
        ((None, "jitter"), "a sampler must be a function, a word or a list of words: got None"),
    ],
)
def test_what_cannot_be_searched_is_refused(arguments, rule):
    with pytest.raises(InputError, match=rule):
        falsify(*arguments)


@pytest.mark.parametrize(
    ("sampler", "told"),
    [
        (crashing, "crashing must not crash for n = .*: got signal SIGABRT"),
        (leaving, "leaving must not raise for n = .*: got SystemExit"),
        (undefined, "coordinates must be finite: got nan"),
    ],
)
def test_a_fault_of_a_sampler_is_told_and_harms_nobody(sampler, told):
    with pytest.raises(InputError, match=told) as raised:
        falsify(sampler, "random", (1, 2), budget=60)
    assert "must be usable" not in str(raised.value)


def test_a_sampler_that_hangs_is_told_at_the_end_of_the_budget():
    """On a busy machine it may still be loaded then; that it does not answer is told as well."""
    with pytest.raises(InputError, match=r"hanging must answer .*: got no answer"):
        falsify(hanging, "random", budget=3)


def test_a_function_without_a_name_is_called_here():
    own = []

    def local(n, dim, rng):
        own.append(os.getpid())
        return jitter(n, dim, rng)

    assert falsify(local, "jitter", dims=(1,), budget=60) is None
    assert set(own) == {os.getpid()}


def test_a_sampler_that_fails_everywhere_is_refused():
    def failing(n, dim, rng):
        raise KeyError("seed")

    with pytest.raises(InputError, match="KeyError"):
        falsify(failing, "random", budget=60)


def test_a_missing_hypothesis_is_told_in_one_line(monkeypatch):
    real = builtins.__import__

    def without(name, *rest):
        if name == "hypothesis":
            raise ModuleNotFoundError(name)
        return real(name, *rest)

    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(InputError, match="hypothesis must be installed"):
        falsify(jitter, "jitter", (1,))


def test_a_script_without_a_guard_is_told_so(tmp_path):
    """Its child imports the script and comes to the same call."""
    script = tmp_path / "unguarded.py"
    script.write_text(
        "from specrate.numerics import falsify\n"
        "def white(n, dim, rng):\n    return rng.random((n, dim))\n"
        "falsify(white, 'random', (1,), budget=60)\n"
    )
    command = [sys.executable, str(script)]
    found = subprocess.run(command, capture_output=True, text=True, check=False)
    assert found.returncode == 1
    assert "a script must guard what it runs by if __name__ == '__main__'" in found.stderr
