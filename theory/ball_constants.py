r"""Leading constants of the ball of radius R < 1/2: its edge, or its marginals' smooth energy.

On every support u of s axes the ball has, in the mean over a shell, |f^(m)|² ~ c |m|^-(D+1) with
c = R^(D−1)/(2π²), q = D + 1 − s (Bochner; D is the dimension of the ball: that of the samples, and
k more where they are k-flats). Against N·P_S ~ a(m/|m|) |m|^b N^-eb on a region, as N → ∞,

    q > b   N^(1+eb) Var → Σ_m a |m|^b |f^(m)|²                  moments of the marginals of f,
    q = b   N^(1+eb) Var / ln N → e c ∫ a dn                     over the sphere, per support,
    q < b   N^(1+eq) Var → c ∫ |x|^-(D+1) Σ(x) dx                Σ(x) = lim N·P_S(x N^e).

The marginal on u is κ_(D−s) (R² − |x|²)^((D−s)/2), κ_j the volume of the unit j-ball, and
Σ |m|² |f^(m)|² = ‖∇f‖²/4π²; frequencies with m_i = 0 are taken out by inclusion and exclusion.
In the last case all axes are in the support, D = s, q = 1. Σ is there a sum of c_j ∏ sinc²(x_i/κ_i)
with Σ c_j = 0, the characteristic functions of differences Δ_j of two points of a box of sides
1/κ_i, and ∫ (1 − cos 2πx·Δ) |x|^-(s+1) dx = (2π²κ_(s−1)) |Δ|, so that the limit is
−κ_(D−1) R^(D−1) Σ c_j E|Δ_j|: the measure of the edge's projection times a mean distance.
Combs have no limit there: their ridges make the variance oscillate with N.
"""

from math import comb, prod

from .combs import combs_of
from .expansions import FULL
from .kernels import Factor, Term
from .leading_powers import leading_power
from .mean_distances import mean_distance
from .monomials import Sum, collected, power_of, product_of, vanishes
from .profiles import SaturatingMonomial
from .radial import Leading
from .rates import RegionRate
from .regions import Region
from .samplers.definition import Sampler
from .symbolic import Expr, Integer, Rational, sympy


def ball_constant(sampler: Sampler, rate: RegionRate, radius: Expr, flat: int) -> Leading | None:
    """Leading term of the variance that a region of a sampler leaves to the ball.

    Parameters
    ----------
    sampler : Sampler
        With a kernel, in a dimension that is a number.
    rate : RegionRate
        The rate of the ball on the region.
    radius : sympy.Expr
        R, positive.
    flat : int
        Dimension of the flats that sample it, 0 for points.

    Returns
    -------
    Leading or None
        None where combs decide, two monomials compete, or counts stay fixed.
    """
    if sampler.kernel is None or not sampler.dim.is_Integer:
        return None
    if rate.q is None or rate.order is None:
        return None
    if len(rate.profile) != 1 or _is_decided_by_combs(sampler, rate):
        return None
    (monomial,) = rate.profile
    if monomial.degree is sympy.oo or (monomial.degree != 0 and monomial.effective == 0):
        return None
    full = int(sampler.dim) + flat
    supports = prod(
        comb(int(g.size), int(w))
        for g, w in zip(sampler.layout.groups, rate.region.counts, strict=True)
    )
    if rate.q > monomial.degree:
        constant = _smooth(monomial, rate.region, radius, full)
    elif rate.q == monomial.degree:
        constant = _tied(monomial, rate.region, radius, full)
    else:
        constant = _edge(sampler, rate.region, monomial.effective, radius)
    if constant is None:
        return None
    return Leading(rate.order, sympy.expand_mul(supports * constant, deep=False))


def _is_decided_by_combs(sampler: Sampler, rate: RegionRate) -> bool:
    """Whether the teeth of combs, above their first alias, are of the region's order."""
    assert sampler.kernel is not None
    assert rate.order is not None
    teeth = combs_of(sampler.kernel, sampler.layout, rate.region)
    return any(1 - t.height + t.threshold * rate.q <= rate.order.exponent for t in teeth)


def _smooth(monomial: SaturatingMonomial, region: Region, radius: Expr, full: int) -> Expr | None:
    """Σ a |m|^b |f^(m)|² on one support, for b = 0 and b = 2."""
    if monomial.degree not in (0, 2) or any(FULL in p.partitions for p, _ in monomial.form):
        return None
    s, total = int(region.dimension), Integer(0)
    if monomial.degree == 0:
        energies = [_energy(w, radius, full) for w in range(s + 1)]
        weight = sum((c for _, c in monomial.form), Integer(0))
    else:
        energies = [_gradient(w, radius, full) if w else Integer(0) for w in range(s + 1)]
        weight = Integer(0)
        for powers, c in monomial.form:  # of |m|² each axis has its share 1/s
            share = (w for p, w in zip(powers.partitions, region.counts, strict=True) if p)
            weight += c * Rational(sum(share, Integer(0)), s)
    for w, energy in enumerate(energies):
        total += (-1) ** (s - w) * comb(s, w) * energy
    return weight * total


def _energy(w: int, radius: Expr, full: int) -> Expr:
    """Σ over m in Z^w of |f^(m)|², the integral of the squared marginal on w axes."""
    return _marginal_integral(w, radius, full, 0, full - w)


def _gradient(w: int, radius: Expr, full: int) -> Expr:
    """Σ over m in Z^w of |m|² |f^(m)|², the integral of the marginal's squared gradient/4π²."""
    slope = (Integer(full - w) / (2 * sympy.pi)) ** 2
    return slope * _marginal_integral(w, radius, full, 2, full - w - 2)


def _marginal_integral(w: int, radius: Expr, full: int, even: int, power: int) -> Expr:
    """κ_(D−w)² ∫ |x|^even (R² − |x|²)^power dx over the w-ball of radius R; a value for w = 0."""
    front = volume(full - w) ** 2
    if w == 0:
        return front * radius ** (2 * power)
    beta = sympy.beta(Rational(w + even, 2), power + 1).rewrite(sympy.gamma)
    return front * _sphere(w) * beta / 2 * radius ** (w + even + 2 * power)


def _tied(monomial: SaturatingMonomial, region: Region, radius: Expr, full: int) -> Expr:
    """e c ∫ a dn over the sphere of one support."""
    density = radius ** (full - 1) / (2 * sympy.pi**2)
    return monomial.effective * density * _sphere(int(region.dimension)) * monomial.coefficient


def _edge(sampler: Sampler, region: Region, effective: Expr, radius: Expr) -> Expr | None:
    """−κ_(D−1) R^(D−1) Σ c_j E|Δ_j|."""
    limit = scaling_limit(sampler, region, effective)
    if limit is None:
        return None
    distances = sum((c * mean_distance(sides) for sides, c in limit.items()), Integer(0))
    s = int(region.dimension)
    return -volume(s - 1) * radius ** (s - 1) * distances


def scaling_limit(
    sampler: Sampler, region: Region, effective: Expr
) -> dict[tuple[Expr, ...], Expr] | None:
    """Σ(x) = lim N·P_S(x N^e) off its combs, as Σ_j c_j ∏ sinc²(a_i x_i) by the sides (a_i).

    Returns
    -------
    dict or None
        None if a term of the sum has no limit.
    """
    assert sampler.kernel is not None
    growth = sampler.layout.growth
    total: Sum[Expr] = collected(
        pair
        for term in sampler.kernel.restrict(region.counts)
        for pair in _scaled_term(term, sampler, region, effective).items()
    )
    found: dict[tuple[Expr, ...], Expr] = {}
    for sides, coefficient in total.items():
        if vanishes(coefficient, growth):
            continue
        exponent, constant = leading_power(coefficient, growth)
        if exponent > 0:
            return None
        if exponent == 0:
            listed = sorted((a for a, k in sides for _ in range(k)), key=str)
            found[tuple(listed)] = constant
    return found


def _scaled_term(term: Term, sampler: Sampler, region: Region, effective: Expr) -> Sum[Expr]:
    """A term at frequencies of size N^e: sinc² of a faster count is 1, of a slower one 0."""
    total: Sum[Expr] = {frozenset(): term.coefficient}
    for group, factor in term.factors:
        on_axis = _scaled_factor(factor, sampler, effective)
        total = product_of(total, power_of(on_axis, int(region.counts[group])))
    return total


def _scaled_factor(factor: Factor, sampler: Sampler, effective: Expr) -> Sum[Expr]:
    found: Sum[Expr] = {}
    for coefficient, atom in factor.terms:
        laws = [leading_power(n, sampler.layout.growth) for n in atom.sincs]
        if atom.combs or any(rise < effective for rise, _ in laws):
            continue
        sides = frozenset((1 / scale, 1) for rise, scale in laws if rise == effective)
        found[sides] = found.get(sides, coefficient * 0) + coefficient
    return found


def volume(d: int) -> Expr:
    """κ_d, the volume of the unit d-ball."""
    return sympy.pi ** Rational(d, 2) / sympy.gamma(Rational(d, 2) + 1)


def _sphere(d: int) -> Expr:
    """The area of the unit sphere in d dimensions; 2 for d = 1."""
    return d * volume(d)
