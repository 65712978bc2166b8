"""Expected power spectra on arrays of frequencies: sinc² and its deficit 1 − sinc², side by side.

At a whole frequency m with t = πm/n and r the residue of m of least size modulo n,

    sinc²(m/n) = (sin(πr/n)/t)²,      1 − sinc²(m/n) = Σ_{k≥1} (-1)^(k+1) 2^(2k+1) t^2k/(2k+2)!,

so that both have a relative error of a few units in the last place, the series at t < 1 and the
difference beyond. ``spectrum_forms`` tells how the spectrum comes out of them.
"""

from collections.abc import Mapping, Sequence
from math import factorial, pi
from typing import TypeAlias

import numpy as np

from ..theory.kernels import Kernel
from .integrands.protocol import Floats, Ints
from .spectrum_forms import Interpolation, Multilinear, SpectrumForm, Variable, spectrum_form

_ROWS = 1 << 14  # handled at once, so that the arrays in work stay in the cache

# With t < 1 the terms left out are below 3e-19 of the sum.
_DEFICIT = [(-1) ** (k + 1) * 2.0 ** (2 * k + 1) / factorial(2 * k + 2) for k in range(1, 12)]

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
    n, largest = variable.count, int(m.max(initial=1))
    if variable.comb:
        teeth = (m % n == 0).astype(np.float64) if n <= largest else np.zeros(len(m))
        return teeth, 1 - teeth
    step = pi / n
    t = m.astype(np.float64) * step
    # m + n//2 stays below 2^63: where n is not below 2 · largest <= 2^63, m is its own residue.
    residue = m - (m + n // 2) // n * n if n < 2 * largest else m
    sinc2 = (np.sin(residue * step) / t) ** 2
    deficit = 1 - sinc2
    low = np.flatnonzero(t < 1)
    if low.size:
        deficit[low] = _low_deficit(t[low])
    return sinc2, deficit


def _low_deficit(t: Floats) -> Floats:
    """1 − (sin(t)/t)² for 0 < t < 1."""
    square = t * t
    value = np.full(len(t), _DEFICIT[-1])
    for coefficient in reversed(_DEFICIT[:-1]):
        value *= square
        value += coefficient
    return value * square


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
