"""Numbers as they are read."""

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from specrate.report.numerals import exponent, interval, number, raised, slope_of

LOWERED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")


def read(text: str) -> float:
    """The number that a text shows."""
    lead, _, power = text.translate(LOWERED).partition("×10")
    if not power and text.startswith("10") and text[2:3] in "⁻⁰¹²³⁴⁵⁶⁷⁸⁹" and text[2:]:
        lead, power = "1", text[2:].translate(LOWERED)
    return float(f"{lead}e{power or 0}")


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (0.18943, "0.189"),
        (0.001, "0.00100"),
        (0.00099999, "0.00100"),
        (1.234e-4, "1.23×10⁻⁴"),
        (9999.0, "1.00×10⁴"),
        (1234.5, "1234"),
        (12.3456, "12.3"),
        (-1.507, "−1.51"),
        (-3e-7, "−3.00×10⁻⁷"),
        (0.0, "0"),
        (None, "∞"),
        (float("inf"), "∞"),
        (float("-inf"), "−∞"),
    ],
)
def test_numbers(value: float | None, text: str) -> None:
    assert number(value) == text


def test_a_power_of_ten_alone() -> None:
    assert number(1e-5, 1) == "10⁻⁵"
    assert number(4e-9, 1) == "4×10⁻⁹"


@given(st.floats(-1e300, 1e300), st.integers(2, 6))
def test_numbers_read_back_to_their_digits(value: float, digits: int) -> None:
    assume(abs(value) > 1e-300)
    assert abs(read(number(value, digits)) - value) <= 0.501 * 10.0 ** (1 - digits) * abs(value)


@pytest.mark.parametrize(
    ("found", "text"),
    [
        ({"estimate": 1.23e-4, "low": 1.1e-4, "high": 1.4e-4}, "1.23 [1.10, 1.40]×10⁻⁴"),
        ({"estimate": 0.908, "low": 0.376, "high": 3.25}, "0.908 [0.376, 3.25]"),
        ({"estimate": 0.9, "low": 0.37, "high": None}, "0.900 [0.370, ∞]"),
        ({"estimate": 0.0, "low": -2e-5, "high": 1e-5}, "0 [−2.00, 1.00]×10⁻⁵"),
        ({"estimate": 8.03e-4, "low": 6.7e-4, "high": 1.04e-3}, "8.03 [6.70, 10.4]×10⁻⁴"),
        ({"estimate": 0.5, "low": 1e-7, "high": 0.9}, "0.500 [1.00×10⁻⁷, 0.900]"),
        ({"estimate": 5e-5, "low": 0.0, "high": 3.0}, "5.00×10⁻⁵ [0, 3.00]"),
        ({"estimate": 0.0, "low": 0.0, "high": 0.0}, "0 [0, 0]"),
        (None, "–"),
    ],
)
def test_intervals(found: dict[str, float | None] | None, text: str) -> None:
    assert interval(found) == text


def test_exponents() -> None:
    assert [exponent(t) for t in ("3/2", "-3/2", "--1/2", "-oo", None)] == [
        "3/2", "−3/2", "1/2", "−∞", "–"
    ]  # fmt: skip
    assert [slope_of(t) for t in ("3/2", "2", "oo", "1 + 1/d", None)] == [
        1.5,
        2.0,
        None,
        None,
        None,
    ]
    assert raised("-12") == "⁻¹²"
