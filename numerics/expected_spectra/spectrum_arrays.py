"""Expected power spectra on arrays of frequencies, from the forms that do not cancel.

``spectrum_forms`` writes N·P_S as interpolations in variables g(m/n) and [n divides m]. Here every
variable and its complement to 1 are evaluated side by side, each with a relative error of a few
units in the last place (``shape_arrays``), and put together.
"""

from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np

from ...theory.kernels import Kernel
from ..integrands.protocol import Floats, Ints
from .shape_arrays import shape_arrays
from .spectrum_forms import Interpolation, Multilinear, SpectrumForm, Variable, spectrum_form

_ROWS = 1 << 14  # handled at once, so that the arrays in work stay in the cache

_Value: TypeAlias = Floats | float
_Values: TypeAlias = Mapping[Variable, tuple[Floats, Floats]]
"""Every variable and 1 − variable, on the rows in work."""


def scaled_power_array(
    kernel: Kernel, taken: tuple[int, ...], counts: Mapping[str, int], m: Sequence[Ints]
) -> Floats:
    """N·P_S at whole frequencies on one support.

    Parameters
    ----------
    taken : tuple of int
        How many coordinates of the support lie in each group.
    counts : mapping of str to int
        Every count of the kernel.
    m : sequence of arrays of shape (k,)
        One for each coordinate of the support, in order; |m_i| from 1 to 2^62.

    Returns
    -------
    array of shape (k,)
    """
    form = spectrum_form(kernel, taken, tuple(sorted(counts.items())))
    sizes = [np.abs(column) for column in m]
    tops = [int(s.max(initial=1)) for s in sizes]
    # A box of frequencies holds few different ones per axis: they are looked up in a table.
    tables = {
        v: _with_complement(v, np.arange(1, tops[v.axis] + 1))
        for v in form.variables
        if 2 * tops[v.axis] < len(m[0])
    }
    result = np.empty(len(m[0]))
    for start in range(0, len(result), _ROWS):
        rows = slice(start, start + _ROWS)
        values: dict[Variable, tuple[Floats, Floats]] = {}
        for v in form.variables:
            size = sizes[v.axis][rows]
            if v in tables:
                one, zero = tables[v]
                values[v] = one.take(size - 1), zero.take(size - 1)
            else:
                values[v] = _with_complement(v, size)
        result[rows] = _form_value(form, values)
    return result


def _with_complement(variable: Variable, m: Ints) -> tuple[Floats, Floats]:
    """The variable and 1 − variable at frequencies from 1 to 2^62."""
    if not variable.comb:
        return shape_arrays(variable.shape, m, variable.count)
    n, largest = variable.count, int(m.max(initial=1))
    teeth = (m % n == 0).astype(np.float64) if n <= largest else np.zeros(len(m))
    return teeth, 1 - teeth


def _form_value(form: SpectrumForm, values: _Values) -> _Value:
    total: _Value = form.constant
    for product in form.products:
        joined = _value(product.factors[0], values)
        for factor in product.factors[1:]:
            value = _value(factor, values)
            joined = value + (1 - value) * joined if product.complement else value * joined
        total = total + product.coefficient * joined
    return total


def _value(polynomial: Multilinear, values: _Values) -> _Value:
    if not isinstance(polynomial, Interpolation):
        return polynomial
    variable, at_one, at_zero = polynomial.variable, polynomial.at_one, polynomial.at_zero
    one, zero = values[variable]
    if at_one == 0:
        return _times(zero, _value(at_zero, values))
    if at_zero == 0:
        return _times(one, _value(at_one, values))
    return _times(one, _value(at_one, values)) + _times(zero, _value(at_zero, values))


def _times(variable: Floats, value: _Value) -> Floats:
    return variable if isinstance(value, float) and value == 1.0 else variable * value
