"""Line samples as point samples of a prefiltered integrand (paper, Eqs. 10-15).

A point is x = (p, t), p in the d − 1 coordinates across the lines and t along them. For any unit
vector e and a line through l with l·e = 0,

    ‖l − x + (x·e) e‖² = ‖x − l‖² − (x·e)²,

the squared distance across. On the unit torus a wave of whole order q along the lines has

    ∫_0^1 cos(a + 2πqt) dt = [q = 0] cos a,     [q = 0] = sinc² q,

so that N lines at offsets p_j see Σ_k a_k [q_k = 0] (1/N) Σ_j cos 2πm_k·p_j of f: the points p_j,
and of f what is on the plane q = 0. On R a line of length L sees at most 1/(πνL) of a wave of
frequency ν along it. With the spectrum of jitter across,

    N P_L(m, q) = [q = 0] (1 − ∏ sinc²(m_i/n_i)),     i = 1, ..., d − 1,

and with that of independent points N P_L = [q = 0] at m ≠ 0.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from . import stratified_spectra as stratified
from .exponential_sums import N as count
from .exponential_sums import jitter_on_an_axis
from .exponential_sums import m as frequency
from .shifts import K, N, a, exchanged, j, k, phase
from .strata import blur, cos, half, pi, sin, sinc2, sizes, uniform_place
from .strata import n as width
from .strata import nu as nu_of_place
from .tactics import ONE, ZERO, chain, combine, positive, power_integral, real, whole

t, q, b, nu, L, m, n, i, d, c, rho, scale = real("t q b nu L m h i d c rho lambda")
at, foot, unit, order, offset = (sympy.Function(s) for s in ("x", "l", "e", "q", "b"))
TWO = sympy.Integer(2)


def axes(term: Expr) -> Expr:
    """Σ over the d coordinates."""
    return sympy.Sum(term, (i, 1, d))


@cache
def distance() -> Step:
    """Σ (l_i − x_i + c e_i)² = Σ (x_i − l_i)² − 2c Σ x_i e_i + 2c Σ l_i e_i + c² Σ e_i²."""
    given = sizes(d)
    across = foot(i) - at(i) + c * unit(i)
    parts = ((ONE, (at(i) - foot(i)) ** 2), (-2 * c, at(i) * unit(i)), (2 * c, foot(i) * unit(i)),
             (c**2, unit(i) ** 2))  # fmt: skip
    total = sympy.Add(*(s * axes(f) for s, f in parts))
    return Step(Claim(axes(across**2), "=", total, given), by.Linear(parts))


@cache
def along_a_line() -> Step:
    """∫_0^1 cos(b + 2πqt) dt = sinc² q cos b for whole q."""
    given, wave = whole(q), cos(b + 2 * pi * q * t)
    integral = sympy.Integral(wave, (t, 0, 1))
    claim = Claim(integral, "=", sinc2(q) * cos(b), given)
    still = sympy.Integral(cos(b), (t, 0, 1))
    there = Step(Claim(still, "=", cos(b)), by.Antiderivative(t * cos(b)))
    return Step(claim, by.Split(q, ZERO), (_full_turns(claim, -1), there, _full_turns(claim, 1)))


def _full_turns(claim: Claim, sign: int) -> Step:
    """The claim where 1 <= sign · q: both sides are 0."""
    ends = (q, -ONE) if sign < 0 else (ONE, q)
    given = (*claim.given, Claim(ends[0], "<=", ends[1]))
    bound = Step(Claim(ends[0], "<=", ends[1], given), by.Given())
    order_ = (q, ZERO) if sign < 0 else (ZERO, q)
    apart = combine(Claim(order_[0], "<", order_[1], given), (1, bound), remainder=1)
    primitive = sin(b + 2 * pi * q * t) / (2 * pi * q)
    none = Step(Claim(claim.left, "=", ZERO, given), by.Antiderivative(primitive), (apart,))
    return combine(Claim(claim.left, "=", claim.right, given), (1, none), (0, apart))


@cache
def estimator() -> Step:
    """(1/N) Σ_j Σ_k a_k ∫_0^1 cos(p_kj + 2πq_k t) dt = Σ_k a_k [q_k = 0] (1/N) Σ_j cos p_kj."""
    about = Claim(order(k), "whole", ZERO, (*whole(k), Claim(ONE, "<=", k)), over=(k,))
    given = (about, *sizes(N), *whole(K), Claim(ONE, "<=", K))
    modes = (*given, *whole(k), Claim(ONE, "<=", k), Claim(k, "<=", K))
    points = (*given, *whole(j), Claim(ONE, "<=", j), Claim(j, "<=", N))
    both = (*points, *modes[len(given) :])
    here = Step(Claim(order(k), "whole", ZERO, both), by.Given())
    values = ((b, phase(k, j)), (q, order(k)))
    moved = along_a_line().claim.at(*values)
    line = Step(
        Claim(moved.left, "=", moved.right, both), by.Instance(values), (along_a_line(), here)
    )
    cell = a(k) * moved.right
    wave = combine(Claim(a(k) * moved.left, "=", cell, both), (a(k), line))
    sums = [sympy.Sum(side, (k, 1, K)) for side in (wave.claim.left, cell)]
    row = Step(Claim(sums[0], "=", sums[1], points), by.Bind(), (wave,))
    totals = [sympy.Sum(side, (j, 1, N)) for side in sums]
    rows = Step(Claim(totals[0], "=", totals[1], given), by.Bind(), (row,))
    swapped = exchanged(cell, j, N, k, given)
    weight = a(k) * sinc2(order(k))
    column = Step(
        Claim(sympy.Sum(cell, (j, 1, N)), "=", weight * sympy.Sum(cos(phase(k, j)), (j, 1, N)),
              modes),
        by.Linear(((weight, cos(phase(k, j))),)),
    )  # fmt: skip
    value = sympy.Sum(column.claim.right, (k, 1, K))
    columns = Step(Claim(swapped.claim.right, "=", value, given), by.Bind(), (column,))
    large = combine(Claim(ZERO, "<", N, given),
                    (1, Step(Claim(ONE, "<=", N, given), by.Given())), remainder=1)  # fmt: skip
    uses = ((1 / N, s) for s in (rows, swapped, columns))
    return combine(Claim(totals[0] / N, "=", value / N, given), *uses, (0, large))


@cache
def long_line() -> Step:
    """((1/L) ∫_{−L/2}^{L/2} cos(b + 2πνt) dt)² <= 1/(πνL)²."""
    given = positive(nu, L)
    angle = b + 2 * pi * nu * t
    integral = sympy.Integral(cos(angle), (t, -L / 2, L / 2))
    wave = cos(b) * sin(pi * nu * L)
    value = wave / (pi * nu)
    size = Step(Claim(integral, "=", value, given), by.Antiderivative(sin(angle) / (2 * pi * nu)))
    cap = 1 / (pi * nu * L) ** 2
    rest = cos(pi * nu * L) ** 2 + (sin(b) * sin(pi * nu * L)) ** 2
    claim = Claim((integral / L) ** 2, "<=", cap, given)
    return combine(claim, ((integral + value) / L**2, size), remainder=cap * rest)


@cache
def jittered_lines() -> Step:
    """N P_L = [q = 0] (1 − ∏ sinc²(m_i/n_i)), offsets jittered in d dimensions across the lines."""
    return _of_lines(stratified.jitter_at_whole_frequencies())


@cache
def random_lines() -> Step:
    """N P_L = [q = 0] at whole m ≠ 0, offsets independent and uniform across the lines."""
    return _of_lines(stratified.random_at_whole_frequencies())


def _of_lines(known: Step) -> Step:
    """The spectrum of the offsets, times [q = 0]."""
    given = known.claim.given
    line = stratified.place(q, ONE, given)
    left, right = (
        line_ * across
        for line_, across in zip(_sides(line), _sides(known), strict=True)
    )  # fmt: skip
    claim = Claim(left, "=", right, given)
    return combine(claim, (line.claim.left, known), (known.claim.right, line))


def _sides(step: Step) -> tuple[Expr, Expr]:
    return step.claim.left, step.claim.right


RANDOM_LINES = Claim(
    blur(q, ONE) * (1 + (N - 1) * blur(m, ONE)) / N, "=", ZERO,
    (*sizes(N), *whole(m, q), Claim(m * c, "!=", ZERO)),
)  # fmt: skip
"""Random lines of the plane at (m, q) as printed: no power but where ν·l⊥ = m c is 0."""


@cache
def power_across_random_lines() -> Step:
    """One line at (1, 0): P_L = 1."""
    values = ((q, ZERO), (N, ONE), (m, ONE), (c, ONE))
    there = RANDOM_LINES.at(*values)
    still = uniform_place().claim.at((nu_of_place, ZERO), (width, ONE))
    known = Step(
        Claim(still.left, "=", still.right),
        by.Instance(((nu_of_place, ZERO), (width, ONE))), (uniform_place(),),
    )  # fmt: skip
    above = combine(Claim(ZERO, "<", there.left), (-1, known), remainder=1)
    return Step(replace(RANDOM_LINES, false=True), by.Counterexample(values), (above,))


def _jittered_as_printed() -> Claim:
    exact = jitter_on_an_axis().claim
    return Claim(exact.left, "=", (1 - sinc2(frequency * c)) / count, exact.given)


JITTERED_LINES = _jittered_as_printed()
"""Jittered lines of the plane at (m, 0) as printed, one of them at the offset c."""


@cache
def offsets_are_no_scale() -> Step:
    """At N = 2, m = 1 and a line at 1/4: P_L = (1 − 4/π²)/2 = 0.297..., and not 0.094..."""
    values = ((count, TWO), (frequency, ONE), (c, sympy.Rational(1, 4)))
    there, exact = JITTERED_LINES.at(*values), jitter_on_an_axis().claim.at(*values)
    true = Claim(there.left, "=", exact.right)
    known = Step(true, by.Instance(values[:2]), (jitter_on_an_axis(),))
    gap = Step(Claim(there.right, "<", exact.right), by.Interval())
    less = combine(Claim(there.right, "<", there.left), (-1, known), (1, gap))
    return Step(replace(JITTERED_LINES, false=True), by.Counterexample(values), (less,))


@cache
def slice_of_the_spectrum() -> Step:
    """Σ_k a_k ∫_0^1 cos(b_k + 2πq_k t) dt = Σ_k a_k [q_k = 0] cos b_k."""
    about = Claim(order(k), "whole", ZERO, (*whole(k), Claim(ONE, "<=", k)), over=(k,))
    given = (about, *whole(K), Claim(ONE, "<=", K))
    inside = (*given, *whole(k), Claim(ONE, "<=", k), Claim(k, "<=", K))
    here = Step(Claim(order(k), "whole", ZERO, inside), by.Given())
    values = ((b, offset(k)), (q, order(k)))
    moved = along_a_line().claim.at(*values)
    line = Step(
        Claim(moved.left, "=", moved.right, inside), by.Instance(values), (along_a_line(), here)
    )
    wave = combine(Claim(a(k) * moved.left, "=", a(k) * moved.right, inside), (a(k), line))
    sums = [sympy.Sum(side, (k, 1, K)) for side in _sides(wave)]
    return Step(Claim(sums[0], "=", sums[1], given), by.Bind(), (wave,))


_WAVE = sin(2 * pi * c)
CONJUGATE = Claim(
    -sympy.Integral(_WAVE * sympy.Integral(_WAVE, (t, 0, 1)), (c, 0, 1)), "=",
    sympy.Integral(_WAVE**2, (t, 0, 1), (c, 0, 1)),
)  # fmt: skip
"""Im F of the prefiltered sin 2πp at ν = 1, and Im of the conjugate of F of sin 2πp at (1, 0)."""


@cache
def no_conjugate() -> Step:
    """−1/2 and 1/2."""
    inside = (Claim(ZERO, "<", c), Claim(c, "<", ONE))
    sides: list[Step] = []
    square, half_ = sympy.Integral(_WAVE**2, (c, 0, 1)), sympy.Rational(1, 2)
    size = Step(Claim(square, "=", half_), by.Antiderivative(c / 2 - sin(4 * pi * c) / (8 * pi)))
    line = sympy.Integral(_WAVE, (t, 0, 1))
    flat = Step(Claim(line, "=", _WAVE, inside), by.Antiderivative(t * _WAVE))
    term = combine(Claim(_WAVE * line, "=", _WAVE**2, inside), (_WAVE, flat))
    level = sympy.Integral(_WAVE**2, (t, 0, 1))
    level_ = Step(Claim(level, "=", _WAVE**2, inside), by.Antiderivative(t * _WAVE**2))
    for step in (term, level_):
        whole_ = sympy.Integral(step.claim.left, (c, 0, 1))
        bound = Step(Claim(whole_, "=", square), by.Bind(), (step,))
        sides.append(chain(Claim(whole_, "=", half_), bound, size))
    less = combine(
        Claim(CONJUGATE.left, "<", CONJUGATE.right), (-1, sides[0]), (-1, sides[1]), remainder=1
    )
    return Step(replace(CONJUGATE, false=True), by.Counterexample(()), (less,))


INTEGRATED = Claim(
    sympy.Integral(cos(2 * pi * q * t), (t, 0, 1)), "=", ONE, (*whole(q), *positive(q))
)
"""The prefiltered cos 2πqt as the sum of its spectrum along t, 1/2 + 1/2."""


@cache
def restricted_not_integrated() -> Step:
    """The prefiltered wave is 0, as its spectrum on the plane q = 0."""
    return Step(
        Claim(INTEGRATED.left, "=", ZERO, INTEGRATED.given),
        by.Antiderivative(sin(2 * pi * q * t) / (2 * pi * q)),
    )


@cache
def integrated_is_wrong() -> Step:
    """At q = 1: 0 and 1."""
    values, none = ((q, ONE),), restricted_not_integrated()
    there = INTEGRATED.at(*values)
    known = Step(Claim(there.left, "=", ZERO), by.Instance(values), (none,))
    less = combine(Claim(there.left, "<", ONE), (1, known), remainder=1)
    return Step(replace(INTEGRATED, false=True), by.Counterexample(values), (less,))


@cache
def one_delta() -> Step:
    """ρ^(d−1) ∫ h dc over |ρc| < 1/(2h) is ρ^(d−2): δ(ρc) = δ(c)/ρ."""
    given = positive(rho, n)
    width_ = 1 / (2 * n * rho)
    mass = sympy.Integral(n, (c, -width_, width_))
    size = Step(Claim(mass, "=", 1 / rho, given), by.Antiderivative(n * c))
    shell = rho ** (d - 1)
    return combine(Claim(shell * mass, "=", rho ** (d - 2), given), (shell, size))


def shells(power: Expr) -> tuple[Expr, Expr]:
    """∫_0^λ ρ^power dρ, and λ^(d−1) times that to 1."""
    wide, one = (sympy.Integral(rho**power, (rho, 0, end)) for end in (scale, ONE))
    return wide, scale ** (d - 1) * one


_SCALED = (*positive(scale), Claim(ONE, "<", d))
EQ_15B = Claim(shells(d - 1)[0], "=", shells(d - 1)[1], _SCALED)


@cache
def volume_of_the_plane() -> Step:
    """With the Jacobian ρ^(d−2) the frequencies below λ grow as λ^(d−1)."""
    wide, _ = shells(d - 2)
    one = wide.xreplace({scale: ONE})
    known = power_integral(wide, [(ONE, d - 2)], _SCALED)
    unit_ = power_integral(one, [(ONE, d - 2)], _SCALED)
    power = scale ** (d - 1)
    return combine(Claim(wide, "=", power * one, _SCALED), (1, known), (-power, unit_))


@cache
def volume_of_the_space() -> Step:
    """With ρ^(d−1), at d = 2 and λ = 2: 2 and not 2 · 1/2."""
    values = ((d, TWO), (scale, TWO))
    there = EQ_15B.at(*values)
    wide, one = (sympy.Integral(rho, (rho, 0, end)) for end in (TWO, ONE))
    sizes_ = [Step(Claim(f, "=", v), by.Antiderivative(rho**2 / 2))
              for f, v in ((wide, TWO), (one, half))]  # fmt: skip
    less = combine(
        Claim(there.right, "<", there.left), (-1, sizes_[0]), (2, sizes_[1]), remainder=1
    )
    return Step(replace(EQ_15B, false=True), by.Counterexample(values), (less,))
