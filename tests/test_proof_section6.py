"""Section 6 up to Table 1: proved bounds attacked by mpmath at random points.

The attacks use nothing of the kernel: spectra as products of sinc², sums over frequencies by zeta
and polylogarithm, radial integrals by quadrature. Power: a bound tightened by the factor named in a
test fails at a point named there.
"""

from typing import Any

import sympy
from hypothesis import given
from hypothesis import strategies as st
from specrate.numerics.integrands.protocol import mp
from specrate.proofs.theorems import axis_terms, integrand_rows, lattice_powers, multi_jitter_bounds

Number = Any
reals = st.floats(1e-3, 1e2)
SLACK = mp.mpf(10) ** -25


def sinc2(x: Number) -> Number:
    """sinc²(x) at 60 digits, where 1 − sinc² keeps 25."""
    return mp.sinc(mp.pi * mp.mpf(x)) ** 2


@given(st.lists(reals, min_size=1, max_size=5))
def test_jitter_lies_between_its_bounds(x: list[float]) -> None:
    with mp.workdps(60):
        power = 1 - mp.fprod(sinc2(u) for u in x)
        level = mp.pi**2 / 3 * mp.fsum(mp.mpf(u) ** 2 for u in x)
        assert level / (1 + level) <= power + SLACK
        assert power <= min(mp.mpf(1), level) + SLACK


def test_the_bounds_of_jitter_are_tight() -> None:
    """At x = 1/1000 a bound changed by 1 part in 10⁴ fails."""
    with mp.workdps(60):
        x = mp.mpf(1) / 1000
        power, level = 1 - sinc2(x), mp.pi**2 / 3 * x**2
        assert power > level * (1 - mp.mpf(10) ** -4)
        assert power < level / (1 + level) * (1 + mp.mpf(10) ** -4)


def multi_jitter_power(a: int, b: int, n: int) -> Number:
    """N P_S = 1 + N ∏ (K − A)/n − ∏ K, K = (nA − A')/(n − 1): by orthogonal arrays."""
    coarse = [sinc2(mp.mpf(m) / n) for m in (a, b)]
    shared = [
        (n * c - sinc2(mp.mpf(m) / n**2)) / (n - 1) for c, m in zip(coarse, (a, b), strict=True)
    ]
    apart = mp.fprod((k - c) / n for k, c in zip(shared, coarse, strict=True))
    return 1 + n**2 * apart - mp.fprod(shared)


frequencies = st.integers(1, 400)
strata = st.integers(2, 60)


@given(frequencies, frequencies, strata)
def test_multi_jitter_lies_between_its_bounds(a: int, b: int, n: int) -> None:
    with mp.workdps(60):
        power, level = multi_jitter_power(a, b, n), mp.pi**2 / 3 * mp.mpf(a * a + b * b) / n**2
        assert level / (8 * (1 + level)) <= power + SLACK
        assert power <= min(2 * level, mp.mpf(n) / (n - 1)) + SLACK


@given(frequencies, frequencies, strata)
def test_the_spectrum_of_multi_jitter_is_that_of_the_claim(a: int, b: int, n: int) -> None:
    own = {multi_jitter_bounds.a: a, multi_jitter_bounds.b: b, multi_jitter_bounds.n: n}
    claim = multi_jitter_bounds.multi_jitter_plateau().claim
    with mp.workdps(60):
        value = mp.mpf(
            sympy.N(claim.left.xreplace({k: sympy.Integer(v) for k, v in own.items()}), 60)
        )
        assert abs(value - multi_jitter_power(a, b, n)) < SLACK


@given(frequencies, frequencies, strata)
def test_correlated_multi_jitter_is_small_between_its_teeth(a: int, b: int, n: int) -> None:
    a, b = (m + (m % n == 0) for m in (a, b))
    with mp.workdps(60):
        coarse, fine = ([sinc2(mp.mpf(m) / k) for m in (a, b)] for k in (n, n**2))
        kx, ky = ((n * c - f) / (n - 1) for c, f in zip(coarse, fine, strict=True))
        power = 1 + (n * n * kx * ky - n * n * kx * fine[1] - n * n * ky * fine[0]) / n**2
        u, v = (mp.pi**2 / 3 * mp.mpf(m) ** 2 / n**2 for m in (a, b))
        assert abs(power) <= 4 * u * v + 2 * (u + v) / n**2 + SLACK


@given(st.lists(frequencies, min_size=1, max_size=5), st.integers(2, 10**6))
def test_latin_hypercubes_are_flat_across_axes(m: list[int], n: int) -> None:
    with mp.workdps(60):
        crossing = mp.fprod(-sinc2(mp.mpf(k) / n) / (n - 1) for k in m)
        assert abs((n - 1) * crossing) <= mp.mpf(n - 1) ** (1 - len(m)) * (1 + SLACK)


@given(st.integers(2, 10**6), st.floats(0.01, 50))
def test_waves_under_latin_hypercubes(n: int, m: float) -> None:
    with mp.workdps(60):
        across = (1 + sinc2(mp.mpf(1) / n) ** 2 / (n - 1)) / (4 * n)
        assert mp.mpf(1) / (4 * n) <= across <= mp.mpf(1) / (2 * n)
        along, full = (1 - sinc2(mp.mpf(m) / n)) / (2 * n), mp.pi**2 / 3 * mp.mpf(m) ** 2
        scaled = along * mp.mpf(n) ** 3
        assert full / (2 * (1 + full)) <= scaled + SLACK
        assert scaled <= full / 2 + SLACK


def power_law_variance(p: int, n: int) -> Number:
    """(2/N) Σ (1 − sinc²(m/N)) m^−p by zeta and polylogarithm."""
    turn = mp.expjpi(mp.mpf(2) / n)
    wave = mp.zeta(p + 2) - mp.re(mp.polylog(p + 2, turn))
    return 2 / mp.mpf(n) * (mp.zeta(p) - n**2 / (2 * mp.pi**2) * wave)


POWERS = {2: lattice_powers.jump, 3: lattice_powers.tie, 4: lattice_powers.kink}


@given(st.sampled_from(sorted(POWERS)), st.integers(1, 2000))
def test_power_laws_under_jitter_lie_between_their_bounds(p: int, n: int) -> None:
    low, high = (step.claim for step in POWERS[p]())
    there = {lattice_powers.N: sympy.Integer(n)}
    with mp.workdps(40):
        variance = power_law_variance(p, n)
        below, above = (mp.mpf(sympy.N(e.xreplace(there), 40)) for e in (low.left, high.right))
        assert below <= variance + mp.mpf(10) ** -30
        assert variance <= above


def test_the_power_laws_have_the_orders_of_their_bounds() -> None:
    """At N = 10⁶ neither bound is farther than a factor 10 from the variance."""
    for p, proof in POWERS.items():
        low, high = (step.claim for step in proof())
        there = {lattice_powers.N: sympy.Integer(10**6)}
        with mp.workdps(60):
            variance = power_law_variance(p, 10**6)
            assert variance < 10 * mp.mpf(sympy.N(low.left.xreplace(there), 40))
            assert 10 * variance > mp.mpf(sympy.N(high.right.xreplace(there), 40))


@given(st.lists(st.integers(1, 9), min_size=1, max_size=4), st.integers(1, 10**4))
def test_a_wave_under_jitter_lies_between_its_bounds(m: list[int], s: int) -> None:
    with mp.workdps(60):
        scaled = (1 - mp.fprod(sinc2(mp.mpf(k) / s) for k in m)) * mp.mpf(s) ** 2 / 2
        full = mp.pi**2 / 3 * sum(k * k for k in m)
        assert full / (2 * (1 + full)) <= scaled + SLACK
        assert scaled <= full / 2 + SLACK


@given(st.integers(1, 6), st.floats(0.1, 3), st.floats(0.1, 3), st.integers(2, 10**4))
def test_the_bound_of_eq_20_where_rows_meet(s: int, rho0: float, alpha: float, n: int) -> None:
    rho0 = min(rho0, alpha * n)
    tail = rho0 ** (s + 1)
    low = rho0 ** (s + 2) / (s + 2) / (alpha**2 * n**3)
    middle = tail * (alpha * n - rho0) / (alpha**2 * n**3)
    high = tail / (alpha * n**2)
    assert low + middle + high <= 2 * tail / (alpha * n**2) * (1 + 1e-12)


@given(st.floats(0.3, 4), st.floats(0.3, 4), st.floats(1, 5), st.floats(0.1, 1), st.floats(1, 3))
def test_the_radial_integral_before_rho0(
    b: float, q: float, s: float, nu: float, rho0: float
) -> None:
    c, c2 = 1.5, 0.7
    parts = (
        mp.quad(lambda t: t ** (s - 1) * (t / nu) ** b * c, [0, nu]),
        mp.quad(lambda t: t ** (s - 1) * c, [nu, rho0]),
        c2 * mp.quad(lambda t: rho0**-q * mp.exp(-q * t), [0, mp.inf]),
    )
    right = axis_terms.before_rho0().claim.right
    values = {
        "b": b,
        "q": q,
        "s": s,
        "nu": nu,
        "rho_0": rho0,
        "c": c,
        "c_2": c2,
        "gamma": 1,
        "N": 1,
    }
    value = right.subs({sympy.Symbol(k, real=True): v for k, v in values.items()})
    assert abs(mp.fsum(parts) - mp.mpf(sympy.N(value))) < 1e-8 * abs(mp.fsum(parts))


@given(st.floats(0, 3), st.integers(1, 8))
def test_intervals_decay_as_they_must(a: float, m: int) -> None:
    claim = integrand_rows.interval_decay().claim
    waves = (mp.quad(lambda x, f=f: f(2 * mp.pi * m * x), mp.linspace(0, a, 2 * m + 1))
             for f in (mp.cos, mp.sin))  # fmt: skip
    right = mp.mpf(sympy.N(claim.right.subs(integrand_rows.m, m)))
    assert mp.fsum(w**2 for w in waves) <= right * (1 + 1e-10)
