"""Random layouts, samplers, supports, frequencies, orders and radial problems for the tests."""

from fractions import Fraction

from hypothesis import strategies as st
from specrate.theory.orders import Order
from specrate.theory.samplers import FAMILIES, Sampler, parse_sampler
from specrate.theory.samplers.uncorrelated_jitter import padded
from specrate.theory.strata import Strata
from specrate.theory.symbolic import Integer, Rational, sympy

LARGEST_DIM = 12

dims = st.one_of(st.integers(1, LARGEST_DIM), st.just(2))
"""Dimensions; often 2, where the catalogue has most samplers."""


@st.composite
def strata(draw: st.DrawFn, axes: int, largest_factor: int = 5) -> Strata:
    """Counts k_i t^p_i, one per axis, of which at least one grows."""
    powers = draw(
        st.lists(st.integers(0, 3), min_size=axes, max_size=axes).filter(lambda p: sum(p) > 0)
    )
    factors = draw(st.lists(st.integers(1, largest_factor), min_size=axes, max_size=axes))
    return Strata(tuple(factors), tuple(powers))


@st.composite
def block_sizes(draw: st.DrawFn, dim: int) -> tuple[int, ...]:
    """A composition of the dimension: the sizes of its blocks in order."""
    sizes: list[int] = []
    while sum(sizes) < dim:
        sizes.append(draw(st.integers(1, dim - sum(sizes))))
    return tuple(sizes)


@st.composite
def block_samplers(draw: st.DrawFn, dim: int, largest_factor: int = 5) -> Sampler:
    """Uncorrelated jitter in random blocks, each with equal or with random strata."""
    blocks: list[object] = []
    for size in draw(block_sizes(dim)):
        equal = draw(st.booleans())
        blocks.append(Integer(size) if equal else draw(strata(size, largest_factor)))
    name = "uncorrelated-jitter:" + "+".join(str(b) for b in blocks)
    return padded(tuple(blocks), (), name)


@st.composite
def strata_texts(draw: st.DrawFn, axes: int) -> str:
    """Strata as the grammar writes them: proportions, or powers of N beside fixed numbers."""
    if draw(st.booleans()):
        counts = draw(st.lists(st.integers(2, 40), min_size=axes, max_size=axes))
        return "x".join(map(str, counts))
    weights = draw(
        st.lists(st.integers(0, 4), min_size=axes, max_size=axes).filter(lambda w: sum(w) > 0)
    )
    total = sum(weights)
    fixed = draw(st.integers(2, 9))
    parts = [str(fixed) if w == 0 else f"N^{Fraction(w, total)}" for w in weights]
    return "x".join(parts)


def catalogue_names(dim: int) -> list[str]:
    """Every family of the catalogue that has a kernel and no parameter, in a dimension."""
    plain = [f for f in FAMILIES if f.name not in ("uncorrelated-jitter", "isotropic")]
    fitting = [f.name for f in plain if f.smallest_dim <= dim]
    return fitting if dim == 2 else [n for n in fitting if n != "correlated-multi-jitter"]


@st.composite
def catalogue_samplers(draw: st.DrawFn, dim: int) -> Sampler:
    """A sampler of the catalogue with a kernel, with strata where the family takes them."""
    name = draw(st.sampled_from(catalogue_names(dim)))
    takes_strata = name in ("regular", "jitter") or (
        dim == 2 and name in ("multi-jitter", "correlated-multi-jitter")
    )
    if takes_strata and draw(st.booleans()):
        name += ":" + draw(strata_texts(dim))
    return parse_sampler(name, dim)


@st.composite
def samplers(draw: st.DrawFn) -> Sampler:
    """Any sampler with a kernel, in 1 to 12 dimensions."""
    dim = draw(dims)
    return draw(st.one_of(catalogue_samplers(dim), block_samplers(dim)))


@st.composite
def shaped_samplers(draw: st.DrawFn, dim: int) -> Sampler:
    """A sampler whose spectrum has other shapes than sinc²: degree 1, β in (0, 2], or 4."""
    families = ["box-dpp", "cloaked", *(["difference-jitter"] if dim == 1 else [])]
    name = draw(st.sampled_from(families))
    if name == "box-dpp" and draw(st.booleans()):
        name += ":" + draw(strata_texts(dim))
    if name == "cloaked":
        name += f":{draw(st.fractions(Fraction(1, 4), 2, max_denominator=6))}"
    return parse_sampler(name, dim)


@st.composite
def every_sampler(draw: st.DrawFn) -> Sampler:
    """Any sampler with a kernel, of the paper's kinds or with other shapes."""
    return draw(st.one_of(samplers(), dims.flatmap(shaped_samplers)))


@st.composite
def supports(draw: st.DrawFn, sampler: Sampler) -> tuple[int, ...]:
    """1-based coordinates of a support; half of them within one block."""
    layout = sampler.layout
    axes = list(range(1, int(layout.dim) + 1))
    if draw(st.booleans()):
        members = draw(st.sampled_from(layout.blocks))
        groups = [layout.groups[g] for g in members]
        axes = [int(g.first) + k for g in groups for k in range(int(g.size))]
    return tuple(sorted(draw(st.sets(st.sampled_from(axes), min_size=1))))


@st.composite
def frequencies(draw: st.DrawFn, dim: int, largest: int = 50) -> tuple[int, ...]:
    """A frequency vector m ≠ 0 with many zeros."""
    entry = st.one_of(st.just(0), st.integers(-largest, largest))
    return tuple(draw(st.lists(entry, min_size=dim, max_size=dim).filter(any)))


numeric_orders = st.one_of(
    st.builds(
        lambda a, q: Order(Rational(a.numerator, a.denominator), Integer(q)),
        st.fractions(-1, 4, max_denominator=6),
        st.integers(-2, 3),
    ),
    st.just(Order(sympy.oo)),
)
"""Orders with numbers as exponents, among them the order 0."""
