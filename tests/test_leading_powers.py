"""The leading power of N of a kernel's coefficient."""

import pytest
from specrate.theory.errors import UndecidedSign
from specrate.theory.kernels import Alphabet
from specrate.theory.layouts import Growth
from specrate.theory.leading_powers import leading_power
from specrate.theory.signs import Range, symbol
from specrate.theory.symbolic import Integer, Rational

d = symbol("d")


def test_leading_power_is_the_limit():
    alphabet = Alphabet(("N", "n"))
    n_points, n = alphabet.count("N"), alphabet.count("n")
    growth = {"N": Growth(Integer(1)), "n": Growth(Rational(1, 2), Integer(3))}
    element = (2 * n_points * n - n_points) / (n**2 + 1)  # 2 N n / n² = (2/3) √N
    assert leading_power(element, growth) == (Rational(1, 2), Rational(2, 3))


def test_leading_power_adds_what_is_of_one_size():
    alphabet = Alphabet(("N", "n"))
    n_points, n = alphabet.count("N"), alphabet.count("n")
    growth = {"N": Growth(Integer(1)), "n": Growth(Rational(1, 2))}
    assert leading_power(n_points - n**2 + n, growth) == (Rational(1, 2), 1)


def test_leading_power_needs_comparable_powers():
    alphabet = Alphabet(("a", "b"))
    k = symbol("k")
    growth = {"a": Growth(1 / d), "b": Growth(1 / k)}
    both = (Range(d, Integer(2)), Range(k, Integer(2)))
    with pytest.raises(UndecidedSign, match="powers of N must be comparable"):
        leading_power(alphabet.count("a") + alphabet.count("b"), growth, both)
