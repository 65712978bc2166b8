"""Kernels: exact expected power spectra as short sums of products over coordinates.

For every coordinate-stratified sampler N·P_S(m) is a sum of terms, each a coefficient times a
product over the coordinates of one-dimensional factors. A factor is a linear combination of
products of

    1,   sinc²(m_i/n),   [m_i = 0],   the comb [n divides m_i],       sinc(x) = sin(πx)/(πx),

and, in place of sinc², any other shape g(m_i/n) of ``shapes.py``; the count n belongs to the factor
and not to the coordinate (multi-jitter has n and N on one axis).
The axes of a group share their factor, so the product over a whole group of symbolic size is
written once. Kernels are closed under + and ×: a kernel is built as the formula is written.

    n = alphabet.count("n")
    K = alphabet.constant() - alphabet.over(0, alphabet.sinc2(n))    # jitter

Coefficients are elements of the field Q(π², counts), so that cancellations are exact.
"""

from dataclasses import dataclass
from functools import lru_cache

from .errors import InputError
from .shapes import SINC2, Shape
from .symbolic import Expr, FracElement, FracField, sympy


@lru_cache(maxsize=256)
def coefficient_field(counts: tuple[str, ...]) -> FracField:
    """Q(π², counts): ``pi2`` stands for π²."""
    return sympy.polys.fields.field(["pi2", *counts], sympy.QQ)[0]


@dataclass(frozen=True)
class Atom:
    """[m = 0]^zero · ∏ [comb divides m] · ∏ g(m/n) over shapes g; equals 1 at m = 0.

    The counts are elements of the coefficient field, so that N can be written as m·n where a
    cancellation needs it.
    """

    zero: bool = False
    combs: tuple[FracElement, ...] = ()
    shapes: tuple[tuple[Shape, FracElement], ...] = ()

    @property
    def sincs(self) -> tuple[FracElement, ...]:
        """The counts of its factors sinc²(m/n), where it has no other shapes.

        Raises
        ------
        InputError
            If it has: what knows sinc² alone must not pass over them.
        """
        for shape, _ in self.shapes:
            if shape != SINC2:
                rule = "this can be had for spectra made of sinc² and combs alone"
                raise InputError(f"{rule}: got the shape {shape.kind}")
        return tuple(n for _, n in self.shapes)

    def __mul__(self, other: "Atom") -> "Atom":
        combs = tuple(sorted({*self.combs, *other.combs}, key=str))
        shapes = tuple(sorted(self.shapes + other.shapes, key=str))
        return Atom(self.zero or other.zero, combs, shapes)


@dataclass(frozen=True)
class Factor:
    """A function of one coordinate: a linear combination of atoms with exact coefficients."""

    terms: tuple[tuple[FracElement, Atom], ...]

    def __add__(self, other: "Factor") -> "Factor":
        sums: dict[Atom, FracElement] = {}
        for coefficient, atom in self.terms + other.terms:
            sums[atom] = sums[atom] + coefficient if atom in sums else coefficient
        return Factor(tuple((c, a) for a, c in sums.items() if c != 0))

    def __sub__(self, other: "Factor") -> "Factor":
        return self + other.scaled(-1)

    def __mul__(self, other: "Factor") -> "Factor":
        pairs = [(c * k, a * b) for c, a in self.terms for k, b in other.terms]
        return Factor(tuple(pairs)) + Factor(())

    def scaled(self, coefficient: FracElement | int) -> "Factor":
        """The factor times a coefficient."""
        return Factor(tuple((c * coefficient, a) for c, a in self.terms if coefficient != 0))

    def at_zero(self) -> FracElement | int:
        """Value at m = 0, where every atom is 1."""
        return sum((c for c, _ in self.terms), start=0)

    def off_zero(self) -> "Factor":
        """The factor for m ≠ 0: gone are [m = 0] and sinc²(m/n) on its own comb's nonzero teeth."""
        return Factor(tuple((c, a) for c, a in self.terms if not _is_only_at_zero(a)))


def _is_only_at_zero(atom: Atom) -> bool:
    on_teeth = {n for shape, n in atom.shapes if shape.vanishes_on_integers}
    return atom.zero or not on_teeth.isdisjoint(atom.combs)


@dataclass(frozen=True)
class Term:
    """coefficient · ∏_groups ∏_{axes of the group} factor; groups not named have factor 1."""

    coefficient: FracElement
    factors: tuple[tuple[int, Factor], ...] = ()

    def __mul__(self, other: "Term") -> "Term":
        factors = dict(self.factors)
        for group, factor in other.factors:
            factors[group] = factors[group] * factor if group in factors else factor
        return Term(self.coefficient * other.coefficient, tuple(sorted(factors.items())))


@dataclass(frozen=True)
class Kernel:
    """N·P_S as a tree of sums and products of terms.

    ``restrict`` walks the tree for one support, so that a product over many blocks is never
    multiplied out where its factors vanish.
    """

    kind: str  # "term", "sum" or "product"
    term: Term | None = None
    parts: tuple["Kernel", ...] = ()

    def __add__(self, other: "Kernel") -> "Kernel":
        return Kernel("sum", parts=(self, other))

    def __sub__(self, other: "Kernel") -> "Kernel":
        return self + other.scaled(-1)

    def __mul__(self, other: "Kernel") -> "Kernel":
        return Kernel("product", parts=(self, other))

    def scaled(self, coefficient: FracElement | int) -> "Kernel":
        """The kernel times a coefficient."""
        if self.term is not None:
            return Kernel("term", Term(self.term.coefficient * coefficient, self.term.factors))
        if self.kind == "sum":
            return Kernel("sum", parts=tuple(p.scaled(coefficient) for p in self.parts))
        return Kernel("product", parts=(self.parts[0].scaled(coefficient), *self.parts[1:]))

    def at_zero(self) -> FracElement:
        """The formula's value at m = 0, which no variance uses (N·P_S(0) itself is N)."""
        if self.term is not None:
            value = self.term.coefficient
            for _, factor in self.term.factors:
                value *= factor.at_zero()
            return value
        total = self.parts[0].at_zero()
        for part in self.parts[1:]:
            total = total + part.at_zero() if self.kind == "sum" else total * part.at_zero()
        return total

    @property
    def shapes(self) -> frozenset[Shape]:
        """The shapes that occur in it."""
        if self.term is not None:
            atoms = (a for _, factor in self.term.factors for _, a in factor.terms)
            return frozenset(shape for a in atoms for shape, _ in a.shapes)
        return frozenset[Shape]().union(*(part.shapes for part in self.parts))

    def restrict(self, counts: tuple[Expr | int, ...]) -> tuple[Term, ...]:
        """Terms of the kernel on supports with ``counts[g]`` axes in group g.

        Axes outside the support have their factor's value at 0, which must be 1 wherever the
        group is not wholly inside the support; axes inside have lost their [m = 0] atoms.
        """
        return _restricted(self, tuple(bool(c != 0) for c in counts))


@lru_cache(maxsize=4096)
def _restricted(kernel: Kernel, touched: tuple[bool, ...]) -> tuple[Term, ...]:
    """Only which groups a support touches matters, so that many regions share one answer."""
    if kernel.term is not None:
        return _restricted_term(kernel.term, touched)
    if kernel.kind == "sum":
        return _collected([t for p in kernel.parts for t in _restricted(p, touched)])
    terms = _restricted(kernel.parts[0], touched)
    for part in kernel.parts[1:]:
        terms = _collected([a * b for a in terms for b in _restricted(part, touched)])
    return terms


def _restricted_term(term: Term, touched: tuple[bool, ...]) -> tuple[Term, ...]:
    kept: list[tuple[int, Factor]] = []
    for group, factor in term.factors:
        if not touched[group]:
            continue
        inside = factor.off_zero()
        if not inside.terms:
            return ()
        kept.append((group, inside))
    return (Term(term.coefficient, tuple(kept)),)


def _collected(terms: list[Term]) -> tuple[Term, ...]:
    """Like terms added, zero terms dropped."""
    sums: dict[tuple[tuple[int, Factor], ...], FracElement] = {}
    for t in terms:
        sums[t.factors] = sums[t.factors] + t.coefficient if t.factors in sums else t.coefficient
    return tuple(Term(c, f) for f, c in sums.items() if c != 0)


@dataclass(frozen=True)
class Alphabet:
    """The symbols of one kernel: its counts, and constructors for atoms over them.

    Parameters
    ----------
    counts : tuple of str
        Names of the counts, for example ``("N", "n")``.
    """

    counts: tuple[str, ...]

    def count(self, name: str) -> FracElement:
        """A count as a coefficient."""
        return coefficient_field(self.counts).gens[1 + self.counts.index(name)]

    def number(self, value: int) -> FracElement:
        """A whole number as a coefficient."""
        return coefficient_field(self.counts)(value)

    def constant(self, value: FracElement | int = 1) -> Kernel:
        """A kernel that does not depend on m."""
        return Kernel("term", Term(self.number(1) * value))

    def zero(self) -> Factor:
        """[m = 0]."""
        return Factor(((self.number(1), Atom(zero=True)),))

    def one(self) -> Factor:
        """The factor 1."""
        return Factor(((self.number(1), Atom()),))

    def comb(self, count: FracElement) -> Factor:
        """[count divides m]."""
        return Factor(((self.number(1), Atom(combs=(count,))),))

    def sinc2(self, count: FracElement) -> Factor:
        """sinc²(m/count)."""
        return self.shape(SINC2, count)

    def shape(self, shape: Shape, count: FracElement) -> Factor:
        """shape(m/count)."""
        return Factor(((self.number(1), Atom(shapes=((shape, count),))),))

    def over(self, group: int, factor: Factor) -> Kernel:
        """The product of a factor, equal to 1 at m = 0, over all axes of a group.

        Raises
        ------
        ValueError
            If the factor is not 1 at m = 0: its value there could not be raised to the power of
            a symbolic number of axes.
        """
        if factor.at_zero() != 1:
            raise ValueError(f"a factor must be 1 at m = 0: got {factor.at_zero()}")
        return Kernel("term", Term(self.number(1), ((group, factor),)))

    def single(self, group: int, factor: Factor) -> Kernel:
        """A factor on a group of one axis; its value at m = 0 goes into the coefficient."""
        at_zero = self.number(1) * factor.at_zero()
        return self.over(group, factor.scaled(1 / at_zero)).scaled(at_zero)
