"""Normal forms: when two terms are equal, decided by expanding polynomials in free generators.

Generators are symbols, π, logarithms, exponentials, and whatever else a term has, left as it is:

    x^y = exp(y log x),    exp(c log x) = x^c for numbers c,    log xy = log x + log y  (x, y > 0),
    sin x = (exp(ix) − exp(−ix))/2i,    exp(iπk) of period 2 in its power for whole k.

Terms whose difference has the form 0 are equal wherever both are defined. Equal terms may have
forms that differ, and then a step is refused that is right.
"""

from ...theory.symbolic import Expr, sympy
from .facts import Facts, above, different
from .grammar import BINDERS, UNDEFINED_FUNCTION

_TURN = "(-1)^"


def zero(e: Expr, facts: Facts) -> bool:
    """Whether e = 0 is seen from its normal form; e must be defined where the facts hold."""
    top = _expanded(_form(e, facts))[0]
    turns = {p: p.base ** (p.exp % 2) for p in top.atoms(sympy.Pow) if _turns(p.base)}
    return bool(sympy.expand(top.xreplace(turns)) == 0)


def _turns(g: Expr) -> bool:
    """Whether a generator is a power of −1."""
    return bool(g.is_Symbol) and g.name.startswith(_TURN)


def _expanded(form: Expr) -> tuple[Expr, Expr]:
    """Numerator and denominator as sums of monomials."""
    top, bottom = sympy.fraction(sympy.together(form))
    return sympy.expand(top), sympy.expand(bottom)


def _generator(kind: str, *keys: Expr) -> Expr:
    return sympy.Symbol(kind + sympy.srepr(keys))


def _form(e: Expr, facts: Facts) -> Expr:
    """The term as a rational function of generators, which are symbols of no known sign."""
    if e.is_Rational or e == sympy.pi:
        return e
    if e.is_Symbol:
        return sympy.Symbol(e.name)
    if e.is_Add or e.is_Mul:
        return e.func(*(_form(a, facts) for a in e.args))
    if e.is_Pow and e.exp.is_Rational and (e.exp.is_Integer or e.base.is_Rational):
        return _form(e.base, facts) ** e.exp
    if e.is_Pow and (e.base == -1 or above(e.base, facts, True)):
        base = sympy.I * sympy.pi if e.base == -1 else _log(e.base, facts)
        return _exp(_form(e.exp, facts) * base, facts)
    if e.func is sympy.exp or e == sympy.E:
        return _exp(_form(sympy.log(e) if e == sympy.E else e.args[0], facts), facts)
    if isinstance(e, (sympy.sin, sympy.cos)):
        wave = _exp(sympy.I * _form(e.args[0], facts), facts)
        is_sine = isinstance(e, sympy.sin)
        return (wave - 1 / wave) / (2 * sympy.I) if is_sine else (wave + 1 / wave) / 2
    if isinstance(e, sympy.sinc) and different(e.args[0], facts):
        return _form(sympy.sin(e.args[0]) / e.args[0], facts)
    if isinstance(e, sympy.log):
        return _log(e.args[0], facts)
    keys = [] if isinstance(e, BINDERS) else [_expanded(_form(a, facts)) for a in e.args]
    kind = "any " if isinstance(e, UNDEFINED_FUNCTION) else ""  # one named gamma is not Γ
    return _generator(f"{kind}{e.func}", *(keys or [e]))


def _log(e: Expr, facts: Facts) -> Expr:
    """log e for e > 0, the logarithms of products, powers and numbers taken apart."""
    if e.is_Rational:
        primes = [
            *sympy.factorint(e.p).items(),
            *((p, -v) for p, v in sympy.factorint(e.q).items()),
        ]
        return sympy.Add(*(v * sympy.log(p) for p, v in primes))
    if e == sympy.E or e.func is sympy.exp:
        return sympy.S.One if e == sympy.E else _form(e.args[0], facts)
    if e.is_Mul and all(above(a, facts, True) for a in e.args):
        return sympy.Add(*(_log(a, facts) for a in e.args))
    if e.is_Pow and above(e.base, facts, True):
        return _form(e.exp, facts) * _log(e.base, facts)
    return sympy.log(_form(e, facts), evaluate=False)


def _exp(form: Expr, facts: Facts) -> Expr:
    """exp of a form, one generator for each of its monomials."""
    top, bottom = _expanded(form)
    is_over_terms = bool(bottom.free_symbols)
    quotient, rest = sympy.S.Zero, top
    if is_over_terms:
        (quotient,), rest = sympy.reduced(top, [bottom])
    elif bottom != 1:
        rest = sympy.expand(top / bottom)
    powers = [_power(t, facts) for t in sympy.Add.make_args(sympy.expand(quotient))]
    for t in sympy.Add.make_args(rest):
        c, m = t.as_coeff_Mul()
        powers += [_generator("exp", m, bottom) ** c] if is_over_terms else [_power(t, facts)]
    return sympy.Mul(*powers)


def _power(term: Expr, facts: Facts) -> Expr:
    """exp(c m) for a monomial m: a power of x for m = log x, of −1 for m = iπ × a whole number."""
    c, m = term.as_coeff_Mul()
    if c == 0:
        return sympy.S.One
    if isinstance(m, sympy.log) and (c.is_Integer or not any(map(_turns, m.free_symbols))):
        return m.args[0] ** c  # of (−1)^n the root is not exp(iπn/2)
    others = m / (sympy.I * sympy.pi)
    if others == 1:
        return sympy.S.NegativeOne**c
    wholes = {sympy.Symbol(w.name) for w in facts.whole if w.is_Symbol}
    factors = [p.as_base_exp() for p in sympy.Mul.make_args(others)]
    if all(b in wholes and k.is_Integer and k > 0 for b, k in factors):
        return _generator(_TURN, others) ** (c % 2)
    return _generator("exp", m, sympy.S.One) ** c
