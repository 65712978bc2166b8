"""Proved kernels against the catalogue's spectra, rules against point sets, and their mutants."""

import itertools
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mutant_trials import Cases, assert_refuted_mutants_are_rejected
from specrate.numerics.expected_spectra.spectra import scaled_power
from specrate.numerics.integrands.protocol import mp
from specrate.proofs.attacking.trials import Point, refuted, value
from specrate.proofs.entries import kernels
from specrate.proofs.entries import rules as rule_entries
from specrate.proofs.entry import Entry, recheck
from specrate.proofs.theorems import multi_jitter_spectra as multi_jitter
from specrate.proofs.theorems import rules, strata
from specrate.proofs.theorems import stratified_spectra as stratified
from specrate.proofs.trusted.claims import Claim
from specrate.proofs.trusted.grammar import Refused
from specrate.proofs.trusted.kernel import Step
from specrate.theory.samplers import parse_sampler

_FREQUENCY = st.integers(-9, 9)
_COUNT = st.integers(2, 5)


def _agree(
    claim: Claim, symbols: Mapping[str, float], functions: Mapping[str, Sequence[float]], exact: Any
) -> None:
    """What the claim is proved to be equal to has this value; functions are of 1, 2, ..."""
    named = {s.name: s for s in claim.free}
    values = {named[name]: mp.mpf(v) for name, v in symbols.items() if name in named}
    table = {
        (name, mp.mpf(place)): mp.mpf(v)
        for name, listed in functions.items()
        for place, v in enumerate(listed, 1)
    }
    with mp.workdps(30):
        proved = value(claim.right, Point(values, lambda: mp.mpf(0), table))
        assert abs(proved - exact) <= mp.mpf(10) ** -12 * (1 + abs(exact))


@given(st.tuples(_FREQUENCY, _FREQUENCY), st.tuples(_COUNT, _COUNT))
def test_jitter_and_grid(m: tuple[int, int], n: tuple[int, int]) -> None:
    size, strata_ = n[0] * n[1], f"{n[0]}x{n[1]}"
    counts = {"N": size, "n": n[0], "n1": n[0], "n2": n[1]}
    symbols, functions = {"N": size, "d": 2, "p": 1 if m[0] else 2}, {"nu": [*m], "n": [*n]}
    if any(m):
        exact = scaled_power(parse_sampler(f"jitter:{strata_}", 2), counts, m)
        for proof in (stratified.jitter, stratified.jitter_at_whole_frequencies):
            _agree(proof().claim, symbols, functions, exact)
        exact = scaled_power(parse_sampler(f"regular:{strata_}", 2), counts, m) / size
        off = [place for place in (1, 2) if m[place - 1] % n[place - 1]]
        if off:
            symbols["p"] = off[0]
            _agree(stratified.grid_between_teeth().claim, symbols, functions, exact)
        else:
            functions["nu"] = [a // b for a, b in zip(m, n, strict=True)]
            _agree(stratified.grid_on_teeth().claim, symbols, functions, exact)


@given(st.lists(_FREQUENCY, min_size=1, max_size=3), _COUNT)
def test_samplers_of_any_dimension(m: list[int], n: int) -> None:
    if not any(m):
        return
    d = len(m)
    symbols, functions = {"N": n, "d": d}, {"nu": m}
    for name, proof in (
        ("random", stratified.random), ("latin-hypercube", stratified.latin_hypercube),
    ):  # fmt: skip
        exact = scaled_power(parse_sampler(name, d), {"N": n}, m)
        _agree(proof().claim, symbols, functions, exact)
    if d > 1:
        exact = scaled_power(parse_sampler("multi-jitter", d), {"N": n**d, "s": n}, m)
        levels = {"s": n, "r": n ** (d - 1), "d": d}
        _agree(multi_jitter.in_d_dimensions().claim, levels, functions, exact)


@given(st.tuples(_FREQUENCY, _FREQUENCY, _FREQUENCY), st.integers(2, 3))
def test_blocks(m: tuple[int, int, int], n: int) -> None:
    if any(m):
        sampler = parse_sampler("uncorrelated-jitter:1+2", 3)
        exact = scaled_power(sampler, {"N": n**2, "n1_1": n**2, "n2_1": n}, m)
        functions = {"nu": [*m], "n": [n**2, n, n], "first": [0, 1], "size": [1, 2]}
        _agree(stratified.uncorrelated_jitter().claim, {"N": n**2, "R": 2}, functions, exact)


@given(_FREQUENCY, _FREQUENCY, _COUNT, _COUNT)
def test_columns_and_rows(f: int, g: int, m: int, n: int) -> None:
    if not (f or g):
        return
    counts = {"N": m * n, "m": m, "n": n}
    symbols = {"f": f, "g": g, "m": m, "n": n}
    for name, proof in (
        ("multi-jitter", multi_jitter.columns_and_rows),
        ("correlated-multi-jitter", multi_jitter.correlated),
    ):
        exact = scaled_power(parse_sampler(f"{name}:2x3", 2), counts, (f, g))
        _agree(proof().claim, symbols, {}, exact)
    if f % m and g % n:
        _agree(multi_jitter.correlated_between_teeth().claim, symbols, {}, exact)


def test_padding_is_the_mean_over_all_orders() -> None:
    rng = np.random.default_rng(7)
    for n in (2, 3, 4):
        alpha, beta = rng.uniform(0, 7, (2, n))
        orders = list(itertools.permutations(range(n)))
        powers = [abs(np.exp(1j * (alpha + beta[list(o)])).sum()) ** 2 / n**2 for o in orders]
        functions = {"alpha": [*alpha], "beta": [*beta]}
        _agree(rules.padding().claim, {"N": n}, functions, float(np.mean(powers)))


@given(st.integers(-6, 6), st.integers(-6, 6), st.integers(-3, 3), st.integers(0, 99))
def test_sheared_points_have_the_sheared_spectrum(a: int, b: int, c: int, seed: int) -> None:
    x, y = np.random.default_rng(seed).uniform(size=(2, 5))
    turns = np.floor(y + c * x)
    power = abs(np.exp(2j * np.pi * (a * x + b * ((y + c * x) % 1))).sum()) ** 2 / 25
    functions = {"x": [*x], "y": [*y], "w": [*turns], "r": [0.0] * 5}
    _agree(rules.shear().claim, {"N": 5, "m_1": a, "m_2": b, "c": c}, functions, float(power))


ENTRIES = (*kernels.ENTRIES, *rule_entries.ENTRIES)


@pytest.mark.parametrize("entry", ENTRIES, ids=lambda e: e.number)
def test_trials_of_a_kernel_have_points(entry: Entry) -> None:
    """A claim with nothing to try it at would pass every trial."""
    assert entry.holds is not None
    wrong = replace(entry.holds, right=entry.holds.right + 1)
    assert refuted(wrong, 0, trials=1)
    with pytest.raises(Refused):
        recheck(replace(entry, holds=wrong))


CASES: Cases = (
    ("strata", strata.substrata, 29, 14),
    ("jitter", stratified.jitter_at_whole_frequencies, 97, 4),
    ("hypercube", stratified.latin_hypercube, 97, 5),
    ("columns", multi_jitter.columns_and_rows, 601, 2),
    ("padding", rules.padding, 29, 10),
    ("shear", rules.shear, 19, 5),
)


@pytest.mark.parametrize(("name", "proof", "every", "least"), CASES, ids=[c[0] for c in CASES])
def test_no_refuted_mutant_is_accepted(
    name: str, proof: Callable[[], Step], every: int, least: int
) -> None:
    assert_refuted_mutants_are_rejected(name, proof, every, least, trials=2)
