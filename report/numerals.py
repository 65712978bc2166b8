"""Numbers and intervals in running text: 0.189, 1.23×10⁻⁴, 1.23 [1.10, 1.40]×10⁻⁴."""

from collections.abc import Mapping
from fractions import Fraction
from math import floor, isfinite, log10

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_PLAIN = (1e-3, 1e4)  # magnitudes between these are written without a power of ten


def raised(text: str) -> str:
    """A whole number as a superscript: ``-12`` gives ``⁻¹²``."""
    return text.translate(_RAISED)


def number(value: float | None, digits: int = 3) -> str:
    """A number with so many significant digits; ``∞`` for what is unbounded or None."""
    if value is None or not isfinite(value):
        return "−∞" if value is not None and value < 0 else "∞"
    power = _power(value, digits)
    if not power:
        return _mantissa(value, digits)
    lead = _mantissa(value / 10.0**power, digits)
    return ("" if lead == "1" else f"{lead}×") + f"10{raised(str(power))}"


def interval(found: Mapping[str, float | None] | None, digits: int = 3) -> str:
    """``1.23 [1.10, 1.40]×10⁻⁴`` of an interval of the document; ``–`` where nothing is known."""
    if found is None or found["estimate"] is None:
        return "–"
    values = [found["estimate"], found["low"], found["high"]]
    finite = [v for v in values if v is not None and isfinite(v) and v]
    power = _power(found["estimate"] or max(finite, key=abs, default=0.0), digits)
    scaled = [v if v is None else v / 10.0**power for v in values]
    if any(_power(v, digits) for v in scaled if v is not None and isfinite(v)):
        power, scaled = 0, values  # too far apart for one power of ten
    middle, low, high = (number(v, digits) for v in scaled)
    return f"{middle} [{low}, {high}]" + (f"×10{raised(str(power))}" if power else "")


def exponent(text: str | None) -> str:
    """An exponent of the grammar for running text: ``-3/2`` is ``−3/2``, ``oo`` is ``∞``."""
    return "–" if text is None else text.replace("--", "").replace("oo", "∞").replace("-", "−")


def slope_of(text: str | None) -> float | None:
    """The number of an exact exponent; None for ``oo``, for symbols and where there is none."""
    try:
        return None if text is None else float(Fraction(text))
    except ValueError:
        return None


def _power(value: float, digits: int) -> int:
    """The power of ten to be split off; 0 for magnitudes that read well without."""
    if value == 0:
        return 0
    rounded = float(f"{abs(value):.{digits - 1}e}")
    return 0 if _PLAIN[0] <= rounded < _PLAIN[1] else floor(log10(rounded))


def _mantissa(value: float, digits: int) -> str:
    if value == 0:
        return "0"
    size = floor(log10(float(f"{abs(value):.{digits - 1}e}")))
    return f"{value:.{max(digits - 1 - size, 0)}f}".replace("-", "−")
