"""The kernel: the rules of proof, and the one function that makes theorems.

A step is a claim, a reason, and the steps that it uses. ``check`` makes a theorem of it only if the
rule of its reason allows: used theorems speak under hypotheses that hold here, and terms are
compared by their normal forms, by signs seen from the facts, or by balls. Whatever finds the steps
is outside: a mistake there can make a proof fail, and cannot make a theorem.
"""

from collections.abc import Callable
from dataclasses import InitVar, dataclass, replace
from weakref import WeakKeyDictionary

from ...theory.symbolic import Expr, Symbol, sympy
from . import reasons as by
from .claims import ASYMPTOTIC, Axiom, Claim, require_fixed, require_grammar
from .enclosures import above_on_box
from .facts import Facts, above, defined, different, range_defined, whole_number
from .grammar import (
    BINDERS,
    UNDEFINED_FUNCTION,
    Refused,
    opened,
    require,
    require_smooth,
    substituted,
)
from .growth import limit_of, term_at
from .hypotheses import applicable, applies, defined_at, facts_under, holds, said, same, states
from .normal_forms import zero

Step = by.Step
_SEAL = object()
_CHECKED: "WeakKeyDictionary[Step, Theorem]" = WeakKeyDictionary()


@dataclass(frozen=True)
class Theorem:
    """A checked claim, and what it rests on; only ``check`` makes one."""

    claim: Claim
    axioms: frozenset[Axiom]
    admitted: frozenset[str]
    seal: InitVar[object]

    def __post_init__(self, seal: object) -> None:
        require(seal is _SEAL, "only the kernel makes theorems")


def check(step: Step) -> Theorem:
    """The theorem of a step.

    Raises
    ------
    Refused
        If the step, or one that it uses, cannot be checked.
    """
    if step not in _CHECKED:
        require(type(step) is Step and type(step.uses) is tuple, "no step", step)
        require_fixed(tuple(vars(step.reason).values()))
        used, claim = [check(u) for u in step.uses], step.claim
        require_grammar(claim)
        require(not claim.over and not any(t.claim.false for t in used), "says nothing", claim)
        require(claim.false == isinstance(step.reason, by.Counterexample), "no counterexample")
        try:
            facts = _RULES[type(step.reason)](claim, step.reason, tuple(t.claim for t in used))
        except Exception as error:  # whatever stops a rule, the step is not checked
            raise Refused(f"{error} in {type(step.reason).__name__}: {claim}") from error
        if facts is not None:
            for side in (claim.left, claim.right):
                require(side == sympy.oo or defined(side, facts), "may be undefined", side)
        cited = [step.reason.axiom] if isinstance(step.reason, by.Cite) else []
        assumed = [step.reason.why] if isinstance(step.reason, by.Admit) else []
        axioms = frozenset(cited).union(*(t.axioms for t in used))
        admitted = frozenset(assumed).union(*(t.admitted for t in used))
        _CHECKED[step] = Theorem(claim, axioms, admitted, _SEAL)
    return _CHECKED[step]


def _given(c: Claim, _: by.Given, used: tuple[Claim, ...]) -> Facts:
    found = [h for h in c.given if replace(h, given=(), over=()) == replace(c, given=())]
    here = applicable(c.given, used)
    require(any(all(holds(g, c.given, here) for g in h.given) for h in found), "not a hypothesis")
    return said((*c.given, replace(c, given=())))


def _combine(c: Claim, r: by.Combine, used: tuple[Claim, ...]) -> Facts:
    facts = facts_under(c.given, used)
    require(len(r.coefficients) == len(used), "one coefficient for each step used")
    parts = [(k, u) for k, u in zip(r.coefficients, used, strict=True) if k != 0]
    require(all(u.relation in ("=", "<=", "<") for _, u in parts), "only = and <= are added")
    require(all(defined(k, facts) for k in (*r.coefficients, r.remainder)), "undefined coefficient")
    rest = c.gap - sum((k * u.gap for k, u in parts), r.remainder)
    require(zero(rest, facts), "not zero", rest)
    if c.relation in ("=", "!="):
        require(all(u.relation == "=" for _, u in parts), "an equation needs equations")
        is_equal = r.remainder == 0 if c.relation == "=" else different(r.remainder, facts)
        require(is_equal, "remainder", r.remainder)
        return facts
    require(c.relation in ("<=", "<"), "not a combination", c.relation)
    require(all(u.relation == "=" or above(k, facts) for k, u in parts), "a coefficient below 0")
    strict = [above(k, facts, True) for k, u in parts if u.relation == "<"]
    needs = c.relation == "<" and not any(strict)
    require(above(r.remainder, facts, needs), "sign not seen", r.remainder)
    return facts


def _interval(c: Claim, r: by.Interval, used: tuple[Claim, ...]) -> Facts:
    require(c.relation in ("<=", "<", "!="), "balls decide inequalities")
    box: dict[Symbol, tuple[Expr, Expr]] = {}
    rising = [h for h in c.given if h.relation in ("<=", "<") and not (h.over or h.given)]
    for s in c.gap.free_symbols:
        low = [h.left for h in rising if h.right == s and h.left.is_Rational]
        high = [h.right for h in rising if h.left == s and h.right.is_Rational]
        require(bool(low and high), "not bounded by numbers", s)
        box[s] = max(low), min(high)
    above_on_box(c.gap, box, c.relation, r.depth)
    return facts_under(c.given, used)


def _monotone(c: Claim, r: by.Monotone, used: tuple[Claim, ...]) -> Facts:
    x, a, f = r.symbol, r.start, c.right
    require_smooth(f, x)
    outer = tuple(h for h in c.given if x not in h.free)
    caps = [h for h in c.given if h.left == x and h.relation in ("<", "<=") and not h.over]
    outer += tuple(h for h in caps if x not in h.right.free_symbols and not h.given)
    facts, inner = facts_under(c.given), facts_under((*outer, Claim(a, "<", x)), used)
    require(c.relation == "<=" and above(x - a, facts) and x not in a.free_symbols, "not rising")
    slope = used[0]
    require(slope.relation in ("<=", "<") and zero(slope.gap - f.diff(x), inner), "not f'")
    require(defined(f, said((*outer, Claim(a, "<=", x)))), "may be undefined", f)
    require(same(c.left, substituted(f, ((x, a),)), facts), "not f(start)")
    return facts


def _antiderivative(c: Claim, r: by.Antiderivative, used: tuple[Claim, ...]) -> Facts:
    require(c.relation == "=" and isinstance(c.left, sympy.Integral), "not an integral")
    facts, big = facts_under(c.given, used), r.antiderivative
    f, x, a, b = opened(c.left)
    require(not c.left.has(sympy.oo) and range_defined(c.left, facts), "no range", a, b)
    require_smooth(big, x)
    inner = facts.inside(c.left, closed=False)
    require(defined(big, facts.inside(c.left)) and defined(f, inner), "undefined")
    require(zero(big.diff(x) - f, inner), "not an antiderivative")
    ends = substituted(big, ((x, b),)) - substituted(big, ((x, a),))
    require(same(c.right, ends, facts), "not F(b) - F(a)", ends)
    return replace(facts, convergent=facts.convergent | {c.left})


def _range(c: Claim, r: by.Range, used: tuple[Claim, ...]) -> Facts:
    facts, e = facts_under(c.given, used), c.left
    require(c.relation == "=" and isinstance(e, BINDERS), "not a sum, product or integral")
    f, x, a, b = opened(e)
    is_integral, empty = isinstance(e, sympy.Integral), sympy.Integer(isinstance(e, sympy.Product))
    if r.at is None:
        none = zero(b - a, facts) if is_integral else zero(b - a + 1, facts)
        require(none or zero(b - a, facts), "more than one term")
        value = empty if none else substituted(f, ((x, a),))
        require(same(c.right, value, facts), "not", value)
        return facts
    after = r.at if is_integral else r.at + 1
    require(defined(r.at, facts) and (is_integral or whole_number(r.at, facts)), "not whole")
    require(above(after - a, facts) and (b == sympy.oo or above(b - r.at, facts)), "not between")
    parts = [e.func(f, (x, a, r.at)), e.func(f, (x, after, b))]
    whole = parts[0] * parts[1] if isinstance(e, sympy.Product) else parts[0] + parts[1]
    tail_too = isinstance(e, sympy.Product) and b == sympy.oo  # a product may be 0 by its head
    require(defined(whole, facts) or (defined(e, facts) and not tail_too), "may diverge")
    facts = replace(facts, convergent=facts.convergent | {e, *parts})
    require(zero(c.right - whole, facts), "not", whole)
    return facts


def _linear(c: Claim, r: by.Linear, used: tuple[Claim, ...]) -> Facts:
    facts, e = facts_under(c.given, used), c.left
    require(c.relation == "=" and isinstance(e, (sympy.Sum, sympy.Integral)), "not a sum")
    inner, (f, x, a, b) = facts.inside(e, closed=False), opened(e)
    require(all(x not in k.free_symbols for k, _ in r.parts), "coefficients free of", x)
    split = sum((k * g for k, g in r.parts), sympy.S.Zero)
    known = defined(f, inner) and defined(split, inner) and range_defined(e, facts)
    require(known and zero(f - split, inner), "not these parts")
    total = sum((k * e.func(g, (x, a, b)) for k, g in r.parts), sympy.S.Zero)
    require(defined(total, facts) and same(c.right, total, facts), "not", total)
    return replace(facts, convergent=facts.convergent | {e})


def _bind(c: Claim, _: by.Bind, used: tuple[Claim, ...]) -> Facts:
    e, bigger = c.left, c.right
    require(isinstance(e, BINDERS) and e.func is bigger.func, "not two sums")
    (f, x, a, b), (g, *range_) = opened(e), opened(bigger)
    require((x, a, b) == tuple(range_) and c.relation in ("=", "<="), "not sums of one range")
    is_integral = isinstance(e, sympy.Integral)
    pairs = [(u, v) for u, v in ((a, x), (x, b)) if sympy.oo not in (-u, v)]
    ends = [Claim(u, "<" if is_integral else "<=", v) for u, v in pairs]
    inside = (*c.given, *ends, *(() if is_integral else (Claim(x, "whole"),)))
    inner = facts_under(inside, used)
    outer = said((*c.given, *applicable(c.given, used)))
    require(states(used[0], Claim(f, c.relation, g), inner), "not the terms")
    require(not is_integral or not e.has(UNDEFINED_FUNCTION), "perhaps not integrable")
    both = [defined(u, outer) for u in (e, bigger)]
    positive = above(f, inner)
    proper = len(ends) == 2 and (not is_integral or all(both))
    converges = any(both) if c.relation == "=" else positive and both[1]
    require(range_defined(e, outer) and (proper or converges), "may diverge")
    require(positive or c.relation == "=" or not isinstance(e, sympy.Product), "factors below 0")
    return replace(outer, convergent=outer.convergent | {e, bigger})


def _improper(c: Claim, _: by.Improper, used: tuple[Claim, ...]) -> Facts:
    e, limit = c.left, used[0]
    require(c.relation == "=" and limit.relation == "->", "not a limit")
    require(isinstance(e, (sympy.Sum, sympy.Integral)), "not a sum")
    (f, x, a, b), n, facts = opened(e), sympy.S(limit.along), said(c.given)
    require(n not in c.free | e.free_symbols, "not free to grow", n)
    is_sum, to_infinity = isinstance(e, sympy.Sum), b == sympy.oo
    ends = (a, n) if to_infinity else (a + 1 / n, b)
    require(to_infinity or (not is_sum and above(b - a, facts, True)), "no sum ends so")
    grown = (Claim(ends[0], "<=", ends[1]), Claim(sympy.S.Zero, "<", n))
    inside = (*c.given, *grown, *((Claim(n, "whole"),) if is_sum else ()))
    facts_under(inside, used)
    require(limit.left == e.func(f, (x, *ends)), "not of this sum")
    require(limit.right != sympy.oo and same(limit.right, c.right, facts), "another limit")
    return replace(facts, convergent=facts.convergent | {e})


def _induction(c: Claim, r: by.Induction, used: tuple[Claim, ...]) -> Facts:
    n, outer = r.symbol, tuple(h for h in c.given if r.symbol not in h.free)
    facts = facts_under(c.given)
    require(whole_number(n, facts) and above(n - r.start, facts), "may be smaller", n)
    require(whole_number(r.start, said(outer)) and c.relation in ("=", "<=", "<"), "no induction")
    own = (Claim(n, "whole"), Claim(r.start, "<=", n), replace(c, given=()))
    cases = ((outer, r.start), ((*outer, *own), n + 1))
    for u, (given, value) in zip(used, cases, strict=True):
        here = facts_under(given, (u,))
        require(states(u, replace(c, given=()).at((n, value)), here), "not at", value)
    return facts


def _split(c: Claim, r: by.Split, used: tuple[Claim, ...]) -> None:
    x, a = r.symbol, r.at
    step, there = int(whole_number(x - a, said(c.given))), c.at((x, a))
    require_grammar(there)
    require(defined(a, said(c.given)), "may be undefined", a)
    rel = "<=" if step else "<"
    cases = (Claim(x, rel, a - step), Claim(a + step, rel, x))
    for u, case in zip((used[0], used[2]), cases, strict=True):
        require(states(u, c, facts_under((*c.given, case), (u,))), "another claim for", case)
    here = facts_under(there.given, (used[1],))
    require(states(used[1], there, here), "another claim at", a)
    require(all(defined_at(e, ((x, a),), here) for e in (c.left, c.right)), "undefined at", a)


def _instance(c: Claim, r: by.Instance, used: tuple[Claim, ...]) -> Facts | None:
    moved, here = used[0].at(*r.values), applicable(c.given, used[1:])
    require(applies(r.values, used[0], c.given, used[1:]), "may be undefined", r.values)
    for h in moved.given:
        require(holds(h, c.given, used[1:] if h.over else here), "not given", h)
    facts = said((*c.given, *here, replace(moved, given=())))
    require(states(moved, c, facts), "not an instance", moved)
    return None if c.relation in ASYMPTOTIC else facts


def _limit(c: Claim, r: by.Limit, used: tuple[Claim, ...]) -> Facts:
    n, facts = c.along, facts_under(c.given, used)
    require(c.relation == "->" and n is not None and bool(r.terms), "not a limit")
    require(all(type(t[3]) is int for t in r.terms), "no whole power of a logarithm", r.terms)
    require(not any(n in u.free_symbols for t in r.terms for u in t[:3]), "terms free of", n)
    total = sum((term_at(t, n) for t in r.terms), sympy.S.Zero)
    require(defined(total, facts) and zero(c.left - total, facts), "not zero", c.left - total)
    require(same(c.right, limit_of(r.terms, c.right == sympy.oo, facts), facts), "another limit")
    return facts


def _squeeze(c: Claim, _: by.Squeeze, used: tuple[Claim, ...]) -> Facts:
    facts, low, high = facts_under(c.given, used), False, c.right == sympy.oo
    require(c.relation == "->", "not a limit")
    for side, limit in zip(used[::2], used[1::2], strict=True):
        reached = limit.along == c.along and same(limit.right, c.right, facts)
        require(limit.relation == "->" and reached, "another limit")
        require(side.relation in ("=", "<=", "<"), "not a bound")
        ends = [(side.left, side.right)] + [(side.right, side.left)] * (side.relation == "=")
        below = any(same(u, limit.left, facts) and same(v, c.left, facts) for u, v in ends)
        over = any(same(v, limit.left, facts) and same(u, c.left, facts) for u, v in ends)
        low, high = low or below, high or over
    require(low and high, "not bounded on both sides")
    return facts


def _eventually(c: Claim, _: by.Eventually, used: tuple[Claim, ...]) -> None:
    main, grows = used
    require(c.relation in ASYMPTOTIC and grows.relation == "->", "not a limit")
    facts = facts_under(c.given, (grows,))
    far = grows.right == sympy.oo or above(grows.right, facts, True)
    require(far and grows.along == c.along, "does not stay above 0")
    for h in main.given:
        known = not h.over and defined(h.left, facts) and defined(h.right, facts)
        dropped = known and h.relation in ("<", "<=") and same(h.gap, grows.left, facts)
        require(dropped or holds(h, c.given, ()), "not given", h)
    require(states(main, c, facts), "another claim")


def _order(c: Claim, r: by.Order, used: tuple[Claim, ...]) -> None:
    facts = facts_under(c.given, used)
    require(c.relation in ("O", "Theta") and defined(c.right, facts), "no order")
    require(above(c.right, facts, True), "not above 0", c.right)
    if not r.constants:
        (limit,) = used
        alike = limit.relation == "->" and limit.along == c.along and limit.right != sympy.oo
        sure = said((*c.given, Claim(limit.left, "=", limit.left)))
        require(alike and defined(c.left, sure), "another limit")
        require(zero(limit.left - c.left / c.right, facts), "not the limit of the ratio")
        require(c.relation == "O" or above(limit.right, facts, True), "the limit may be 0")
        return
    steady = all(c.along not in k.free_symbols and defined(k, facts) for k in r.constants)
    require(steady and defined(c.left, facts), "no constants", r.constants)
    low, high = (r.constants[0], r.constants[-1]) if c.relation == "Theta" else (0, r.constants[0])
    require(c.relation == "O" or above(low, facts, True), "the constant may be 0")
    for bound_ in (Claim(low * c.right, "<=", c.left), Claim(c.left, "<=", high * c.right)):
        seen = above(bound_.gap, facts) or any(states(u, bound_, facts) for u in used)
        require(seen, "not bounded", bound_)


def _counterexample(c: Claim, r: by.Counterexample, used: tuple[Claim, ...]) -> None:
    there = replace(c, false=False).at(*r.values)
    large = tuple(h for h in there.given if c.along is not None and c.along in h.free)
    for h in large:
        grows = h.relation == "whole" or (h.relation in ("<", "<=") and h.left.is_Rational)
        rises = c.along == (h.left if h.relation == "whole" else h.right)
        require(grows and rises and not h.over, "a bound", h)
    require(all(holds(h, large, used) for h in there.given), "hypotheses fail at these values")
    require(applies(r.values, replace(c, false=False), large, used), "undefined", r.values)
    facts = facts_under(large, used)
    if c.relation in ("O", "Theta", "->"):
        (limit,) = [u for u in used if u.relation == "->" and u.along == c.along]
        left = there.left if c.relation == "->" else there.left / there.right
        bad = limit.right == sympy.oo and there.right != sympy.oo
        bad |= c.relation == "Theta" and limit.right == 0
        if c.relation == "->" and sympy.oo not in (limit.right, there.right):
            bad = different(limit.right - there.right, facts)
        require(bool(bad) and same(limit.left, left, facts), "no contradiction")
        return
    strict: dict[str, tuple[str, ...]] = {"<=": ("<",), "<": ("<", "<=", "="), "=": ("<", "!=")}
    denials = [Claim(u, rel, v) for rel in strict[c.relation]  # pyright: ignore
               for u, v in ((there.right, there.left), (there.left, there.right))
               if c.relation == "=" or u == there.right]  # fmt: skip
    require(any(states(u, d, facts) for u in used for d in denials), "not contradicted")


def _cite(c: Claim, r: by.Cite, used: tuple[Claim, ...]) -> None:
    require_grammar(r.axiom.claim)
    require(c == r.axiom.claim and not used, "not the cited theorem")


def _admit(c: Claim, r: by.Admit, used: tuple[Claim, ...]) -> None:
    require(bool(r.why) and not used, "say why")


_RULES: dict[type, Callable[..., Facts | None]] = {
    by.Given: _given, by.Combine: _combine, by.Interval: _interval, by.Monotone: _monotone,
    by.Antiderivative: _antiderivative, by.Range: _range, by.Linear: _linear, by.Bind: _bind,
    by.Improper: _improper, by.Induction: _induction, by.Split: _split,
    by.Instance: _instance, by.Limit: _limit, by.Squeeze: _squeeze,
    by.Eventually: _eventually, by.Order: _order,
    by.Counterexample: _counterexample, by.Cite: _cite, by.Admit: _admit,
}  # fmt: skip
