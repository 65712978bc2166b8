"""Profiles, Eq. 18 made right: a region's low-frequency behaviour as saturating monomials.

The paper bounds the spectrum along a direction by one monomial that saturates,
P_S = (γ/N) min(1, (ρ/(α N_k))^b). Here a profile is a finite set of such monomials with
N_k = N^e, and N·P_S is, up to constants, their maximum (in the mean over the shell |m| = ρ of
the region; from above also pointwise, combs excepted). They are the vertices of the Newton
polygon of the kernel in (power of |m|, power of N): a term C |m|^b N^-λ of the low-frequency
series is a line b x − λ at |m| = N^x, and the terms that reach the upper envelope before it
saturates are kept. One monomial is the paper's case; correlated multi-jitter needs two.

A comb has no monomial: it is zero below the first alias and then, in the mean, constant. It is
kept as a step, degree oo at N_k = N^e, whose plateau N^g may grow with N on small supports.
"""

from dataclasses import dataclass, field

from .combs import Comb
from .expansions import Powers, Series
from .orders import Order
from .signs import Assumptions, nonnegative, sign_of
from .symbolic import Expr, Integer, sympy


@dataclass(frozen=True)
class SaturatingMonomial:
    """N·P_S = γ N^g min(1, (ρ/(α N^e))^b), the γ/α^b being ``coefficient``.

    Parameters
    ----------
    degree : sympy.Expr
        b; ``oo`` for a step.
    effective : sympy.Expr
        e in N_k = N^e.
    coefficient : sympy.Expr or None
        γ/α^b, the mean over directions of the region as N → ∞; None if not known.
    plateau_exponent : sympy.Expr
        g; 0 but for combs.
    plateau : sympy.Expr
        γ. Of a step the mean height of the comb; of a monomial 1 until ``rates.saturated`` has
        asked for the supremum, which no exponent depends on.
    scale : sympy.Expr
        α of a step, whose first alias is at α N^e; 1 otherwise.
    spread : sympy.Expr
        Of a step: its teeth have ∏ |m_i| >= N^spread over the axes of the comb; 0 otherwise.
    form : tuple
        The angular form behind the coefficient, as powers per group with their constants.
    """

    degree: Expr
    effective: Expr
    coefficient: Expr | None = None
    plateau_exponent: Expr = Integer(0)
    plateau: Expr = Integer(1)
    scale: Expr = Integer(1)
    spread: Expr = Integer(0)
    form: tuple[tuple[Powers, Expr], ...] = field(default=(), compare=False)

    @property
    def alpha(self) -> Expr | None:
        """α, from γ and γ/α^b."""
        if self.coefficient is None or self.degree in (0, sympy.oo):
            return None
        return (self.plateau / self.coefficient) ** (1 / self.degree)

    def order_at(self, q: Expr, assumptions: Assumptions = (), product: bool = False) -> Order:
        """Order of the variance against an integrand whose shell energies fall as ρ^-q.

        Parameters
        ----------
        product : bool
            Whether the power falls as a product ∏ |m_i|^-(q+1) and not with the length of m. The
            teeth of a comb are then in the thinnest part of the shell, and the exponent is
            1 − g + q · spread.
        """
        if product and self.degree is sympy.oo and q is not sympy.oo:
            return Order(1 - self.plateau_exponent + q * self.spread)
        return saturated_order(self, q, assumptions)


def saturated_order(monomial: SaturatingMonomial, q: Expr, assumptions: Assumptions) -> Order:
    """N^-(1 − g + e·min(b, q)), with a logarithm exactly at the tie b = q, e > 0.

    Source: the shell-energy form of Eq. 17; each power of two of ρ holds the energy ρ^-q.
    """
    b, e, base = monomial.degree, monomial.effective, 1 - monomial.plateau_exponent
    if e == 0:
        return Order(base)
    if b is sympy.oo and q is sympy.oo:
        return Order(sympy.oo)
    if q is sympy.oo or b is sympy.oo:
        return Order(base + e * (b if q is sympy.oo else q))
    return Order(base + e * least(b, q, assumptions), tie(b, q, assumptions))


def least(b: Expr, q: Expr, assumptions: Assumptions) -> Expr:
    """min(b, q), decided where the assumptions decide it."""
    larger = nonnegative(b - q, assumptions)
    if larger is None:
        return b if nonnegative(q - b, assumptions) else sympy.Min(b, q)
    return q if larger else b


def tie(b: Expr, q: Expr, assumptions: Assumptions) -> Expr:
    """1 where b = q for all symbols, 0 where never, else a Kronecker delta."""
    sign = sign_of(b - q, assumptions)
    if sign == "0":
        return Integer(1)
    if sign in ("+", "-"):
        return Integer(0)
    gap = sympy.expand(b - q)
    for free in sorted(gap.free_symbols, key=str, reverse=True):
        if gap.coeff(free).is_number and gap.coeff(free) != 0:
            rest = sympy.expand(free - gap / gap.coeff(free))
            return sympy.KroneckerDelta(rest, free)
    return sympy.KroneckerDelta(b, q)


def newton_polygon(
    series: Series, combs: tuple[Comb, ...], assumptions: Assumptions
) -> tuple[SaturatingMonomial, ...]:
    """The saturating monomials of a region from the low-frequency series of its kernel.

    Parameters
    ----------
    series : Series
        Terms C |m|^b N^-λ with their angular forms.
    combs : tuple of Comb
        What the kernel's combs add in the mean.
    assumptions : Assumptions
        Those of the region.
    """
    lines: dict[tuple[Expr, Expr], list[tuple[Powers, Expr]]] = {}
    for t in series.terms:
        lines.setdefault((t.degree, t.decay), []).append((t.powers, t.constant))
    edge = _saturation(list(lines), assumptions)
    kept = [p for p in lines if not any(_hides(o, p, edge, assumptions) for o in lines if o != p)]
    found = [_monomial(p, lines[p], series) for p in kept]
    steps = [_step(c) for c in combs]
    return tuple(found) + tuple(
        s
        for i, s in enumerate(steps)
        if not _is_covered(s, found, assumptions) and s not in steps[:i]
    )


def _saturation(lines: list[tuple[Expr, Expr]], assumptions: Assumptions) -> Expr:
    """The x at which the first line reaches 0, where N·P saturates."""
    reached = [
        Integer(0) if decay == 0 else decay / degree
        for degree, decay in lines
        if degree != 0 or decay == 0
    ]
    edge = reached[0] if reached else Integer(0)
    for x in reached[1:]:
        edge = least(edge, x, assumptions)
    return edge


def _hides(
    other: tuple[Expr, Expr], line: tuple[Expr, Expr], edge: Expr, assumptions: Assumptions
) -> bool:
    """Whether ``other`` is above ``line`` for all 0 <= x < edge.

    A tie at x = 0 hides nothing, since there both terms are of one size (correlated
    multi-jitter); a tie all along hides the higher degree.
    """
    at_zero = sign_of(line[1] - other[1], assumptions)
    gap = (other[0] - line[0]) * edge + line[1] - other[1]
    if edge == 0 and at_zero == "0":
        return bool(nonnegative(line[0] - other[0], assumptions))
    return at_zero == "+" and bool(nonnegative(sympy.expand(gap), assumptions))


def _monomial(
    line: tuple[Expr, Expr], forms: list[tuple[Powers, Expr]], series: Series
) -> SaturatingMonomial:
    degree, decay = line
    effective = sympy.expand(decay / degree) if degree != 0 else Integer(0)
    mean = sympy.Add(*[c * p.angular_mean(series.counts) for p, c in forms])
    return SaturatingMonomial(
        degree, effective, sympy.nsimplify(mean) if mean.is_Rational else mean, form=tuple(forms)
    )


def _step(comb: Comb) -> SaturatingMonomial:
    return SaturatingMonomial(
        sympy.oo, comb.threshold, None, comb.height, comb.constant, comb.scale, comb.spread
    )


def _is_covered(
    step: SaturatingMonomial, monomials: list[SaturatingMonomial], assumptions: Assumptions
) -> bool:
    """A step below a saturated monomial adds nothing to the order."""
    low = nonnegative(-step.plateau_exponent, assumptions)
    return bool(low) and any(
        nonnegative(step.effective - m.effective, assumptions) for m in monomials
    )
