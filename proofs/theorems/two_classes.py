"""The unified rate of two classes of directions: 1 + min over classes of e min(b, q), with its log.

Each class k has its own γ, α, s, c, c₂, ρ0, degree b_k, decay q_k and N_k = N^(e_k), and as V_k
that of ``radial.py``, which falls as N^−(1 + r_k), r_k = e_k min(b_k, q_k), times log N where
b_k = q_k. If r_1 < r_2, then V_1 + V_2 has order and constant of V_1 alone, in all nine cases.
Where a class itself consists of finitely many, ``classes.py`` bounds their sum.
"""

from dataclasses import replace
from functools import cache

from ...theory.symbolic import Expr, Symbol, sympy
from ..trusted import reasons as by
from ..trusted.claims import Claim
from ..trusted.kernel import Step
from . import radial
from .jitter_bounds import said
from .radial import Case, N
from .tactics import ONE, ZERO, chain, combine, limit_of_powers, positive, real, transferred

OWN = (
    radial.b, radial.q, radial.s, radial.e, radial.alpha, radial.gamma, radial.rho0, radial.c,
    radial.c2,
)  # fmt: skip
_NAMES = ("b", "q", "s", "e", "alpha", "gamma", "rho", "f", "g")


@cache
def renamed(k: int) -> tuple[tuple[Symbol, Symbol], ...]:
    """The symbols of class k for those of ``radial.py``."""
    return tuple(zip(OWN, real(" ".join(f"{name}_{k}" for name in _NAMES)), strict=True))


def _of(k: int, term: Expr) -> Expr:
    return term.xreplace(dict(renamed(k)))


def rate(k: int, case: Case) -> Expr:
    """r_k."""
    return _of(k, radial.e * {"b>q": radial.q, "b=q": radial.b, "b<q": radial.b}[case])


def _moved(k: int, step: Step) -> Step:
    values = tuple(pair for pair in renamed(k) if pair[0] in step.claim.free)
    return Step(step.claim.at(*values), by.Instance(values), (step,))


def _hypotheses(k: int, case: Case) -> tuple[Claim, ...]:
    return tuple(h.at(*renamed(k)) for h in radial.hypotheses(case))


def _slower(first: Case, second: Case) -> Claim:
    return Claim(rate(1, first), "<", rate(2, second))


def hypotheses(first: Case, second: Case) -> tuple[Claim, ...]:
    """Of both classes, and r_1 < r_2."""
    both = (*_hypotheses(1, first), *_hypotheses(2, second))
    return (*both, _slower(first, second), radial.EVENTUALLY[0], *positive(N))


def variance(first: Case, second: Case) -> Expr:
    """V_1 + V_2."""
    return _of(1, radial.pieces(first).total) + _of(2, radial.pieces(second).total)


def _second_powers(first: Case, second: Case, given: tuple[Claim, ...]) -> tuple[Step, ...]:
    """0 < e_2 b_2 − r_1 and 0 < e_2 q_2 − r_1, also of the smaller part of V_2."""
    slower = said(given, _slower(first, second))
    steps = [combine(Claim(ZERO, "<", rate(2, second) - rate(1, first), given), (1, slower))]
    if second != "b=q":
        b, q, e = (_of(2, x) for x in (radial.b, radial.q, radial.e))
        apart = said(given, Claim(q, "<", b) if second == "b>q" else Claim(b, "<", q))
        other = e * (b if second == "b>q" else q)
        steps.append(
            combine(Claim(ZERO, "<", other - rate(1, first), given), (1, slower), (e, apart))
        )
    if first != "b=q":
        b, q, e = (_of(1, x) for x in (radial.b, radial.q, radial.e))
        gap = e * (b - q) if first == "b>q" else e * (q - b)
        apart = said(given, Claim(q, "<", b) if first == "b>q" else Claim(b, "<", q))
        steps.append(combine(Claim(ZERO, "<", sympy.expand(gap), given), (e, apart)))
    return tuple(steps)


@cache
def limit(first: Case, second: Case) -> Step:
    """N^(1 + r_1) (log N)^−j V → the constant of class 1, j = 1 where b_1 = q_1."""
    given = hypotheses(first, second)
    starts = tuple(radial.EVENTUALLY[1].at(*renamed(k)) for k in (1, 2))
    early = (*given, *starts)
    closed = (_moved(1, radial.closed_form(first)), _moved(2, radial.closed_form(second)))
    found = chain(
        Claim(variance(first, second), "=", sympy.Add(*(s.claim.right for s in closed)), early),
        *closed,
    )
    constant, _, log = (_of(1, sympy.S(u)) for u in radial.expansion(first)[0])
    power, log = 1 + rate(1, first), int(log)
    expansions = (radial.expansion(first), radial.expansion(second))
    terms = tuple(
        (_of(k, u), ZERO, sympy.expand(power + _of(k, p)), j - log)
        for k, expansion in zip((1, 2), expansions, strict=True)
        for u, p, j in expansion
    )
    factor = N**power * sympy.log(N) ** -log
    claim = Claim(factor * found.claim.right, "->", constant, early, N)
    reached = transferred(
        found, Step(claim, by.Limit(terms), _second_powers(first, second, early)), factor
    )
    for k, start in zip((1, 2), starts, strict=True):
        grows = _grows(k)
        kept = tuple(h for h in reached.claim.given if h != start)
        reached = Step(replace(reached.claim, given=kept), by.Eventually(), (reached, grows))
    return reached


@cache
def _grows(k: int) -> Step:
    alpha, e, rho0 = (_of(k, x) for x in (radial.alpha, radial.e, radial.rho0))
    given = (*positive(alpha, e, rho0), Claim(ONE, "<", N))
    return limit_of_powers(alpha * N**e - rho0, [(alpha, e), (-rho0, ZERO)], N, given, sympy.oo)


@cache
def order(first: Case, second: Case) -> Step:
    """V = Θ(N^−(1 + r_1) (log N)^j)."""
    found = limit(first, second)
    log = radial.expansion(first)[0][2]
    right = N ** (-1 - rate(1, first)) * sympy.log(N) ** log
    claim = Claim(variance(first, second), "Theta", right, found.claim.given, N)
    return Step(claim, by.Order(), (found,))
