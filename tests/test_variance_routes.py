"""Exact variances by every route that applies, on random layouts, integrands and N."""

import os

import pytest
from hypothesis import event, given, settings
from hypothesis import strategies as st
from specrate.numerics.exact_variances.variances import exact_variance
from specrate.numerics.integrands.grammar import parse_integrand
from specrate.numerics.point_sources.catalogue_source import counts_of
from specrate.numerics.testing import integrands, layouts
from specrate.theory.errors import InputError

ROUTES = ("parseval", "product", "ridge", "covariogram", "lattice")
CASES = 1000 if os.environ.get("HYPOTHESIS_PROFILE") == "fuzz" else 12  # some 0.2 s each


@pytest.mark.parametrize("dim", [1, 2, 3])
@settings(max_examples=CASES)
@given(data=st.data(), n=st.integers(1, 3000), digits=st.sampled_from([6, 15, 30]))
def test_all_routes_agree_inside_their_bounds(dim, data, n, digits):
    """The routes share no formula: power sums, waves on a line, distances in space, frequencies."""
    layout, text = data.draw(layouts(dim)), data.draw(integrands(dim))
    sampler, integrand = layout.sampler, parse_integrand(text, dim)
    counts = counts_of(sampler, n)
    found = {}
    for route in ROUTES:
        try:
            exact = exact_variance(sampler, counts, integrand, digits, route, box=1 << 12)
        except InputError:
            continue
        found[route] = exact.value, exact.error_bound
    event(f"{len(found)} routes")
    assert "lattice" in found or text.startswith("chord")
    for name, (value, bound) in found.items():
        for other, (value2, bound2) in found.items():
            assert abs(value - value2) <= bound + bound2, (name, other, layout.name, text, counts)
