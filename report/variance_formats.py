"""An exact variance at one N, printed."""

import json
from fractions import Fraction
from typing import Any

from ..numerics.exact_variances.variances import VarianceResult
from .grids import PREAMBLE, booktabs, comma_separated, csv_cell, escaped, markdown

_HEAD = ("sampler", "integrand", "d", "N", "variance", "error at most", "method")
_LONGEST_N = 12  # digits up to which N is written out in a table
_APART = 20_000  # powers of ten: no mantissa has as many digits


def render(found: VarianceResult, form: str) -> str:
    """The variance in one of the formats of the command line."""
    document = _document(found)
    if form == "json":
        return json.dumps(document, indent=1)
    if form == "csv":
        left = "; ".join(f"{what}: {why}" for what, why in found.left_out)
        cells = [csv_cell(v) for v in (document | {"left_out": left}).values()]
        return comma_separated(list(document), [cells])
    notes = [f"left out: {what}: {why}" for what, why in found.left_out]
    if form == "markdown":
        return "\n\n".join([markdown(_HEAD, [_cells(found)]), *(f"- {note}" for note in notes)])
    if form == "latex":
        cells = [_latex_number(c) if i in (3, 4, 5) else escaped(c)
                 for i, c in enumerate(_cells(found))]  # fmt: skip
        head = [r"$d$" if h == "d" else r"$N$" if h == "N" else h for h in _HEAD]
        table = booktabs("llrllll", head, [cells])
        return "\n".join([PREAMBLE, table, *(rf"\par\noindent {escaped(n)}" for n in notes)])
    return "\n".join(
        [
            f"Var = {found.value.value}",
            f"error at most {found.value.error_bound} (certified, method {found.method})",
            f"{found.sampler} on {found.integrand} in {found.dim}D, N = {_count(found.n)}",
            *notes,
        ]
    )


def shortfall(found: VarianceResult, digits: int) -> str | None:
    """One line if fewer digits are certain than were asked for."""
    (bound, low), (value, high) = map(_scientific, (found.value.error_bound, found.value.value))
    apart = min(max(low - high, -_APART), _APART)
    if bound * Fraction(10) ** apart <= value * Fraction(10) ** (1 - digits):
        return None
    return (
        f"{digits} digits were asked for, the method {found.method} gives "
        f"{found.value.value} with an error of at most {found.value.error_bound}"
    )


def _scientific(text: str) -> tuple[Fraction, int]:
    """Mantissa and exponent apart: the exponent of a variance may have billions of digits."""
    mantissa, _, exponent = text.partition("e")
    return abs(Fraction(mantissa)), int(exponent or 0)


def _document(found: VarianceResult) -> dict[str, Any]:
    return {
        "sampler": found.sampler,
        "integrand": found.integrand,
        "dim": found.dim,
        "n": found.n,
        "n_asked": found.n_asked,
        "value": found.value.value,
        "error_bound": found.value.error_bound,
        "method": found.method,
        "left_out": [{"what": what, "why": why} for what, why in found.left_out],
        "seconds": found.seconds,
    }


def _cells(found: VarianceResult) -> list[str]:
    n, value = _count(found.n), found.value
    head = [found.sampler, found.integrand, str(found.dim), n]
    return [*head, value.value, value.error_bound, found.method]


def _count(n: int) -> str:
    """N written out, as a power of ten, or with its leading digits."""
    text = str(n)
    if len(text) <= _LONGEST_N:
        return text
    rest = text[1:].rstrip("0")
    return f"{text[0]}e{len(text) - 1}" if not rest else text


def _latex_number(text: str) -> str:
    mantissa, e, power = text.partition("e")
    return rf"${mantissa}\times10^{{{int(power)}}}$" if e else f"${mantissa}$"
