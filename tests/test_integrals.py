"""The integrals of Eq. 17 as text and LaTeX."""

from latex import check_structure
from specrate.theory.integrals import integral_latex, integral_text, raised, raised_latex
from specrate.theory.radial import Radial
from specrate.theory.signs import symbol
from specrate.theory.symbolic import Integer, Rational, sympy

D = symbol("d")
WORST = Radial(Integer(2), D, D + 1, 1 / D)
BEST = Radial(Integer(2), Integer(1), sympy.oo, Integer(1))
FLAT = Radial(Integer(0), Integer(2), Integer(3), Integer(0))


def test_the_worst_case_has_three_pieces() -> None:
    assert integral_text(WORST, False) == (
        "V = (gamma/N) [int_0^rho_0 rho^(d - 1) (rho/nu)^2 c_f d rho + int_rho_0^nu rho^(d - 1) "
        "(rho/nu)^2 c_f rho^(-d - 1) d rho + int_nu^oo rho^(d - 1) c_f rho^(-d - 1) d rho]"
    )


def test_the_best_case_has_one_piece_as_in_eq_22() -> None:
    assert integral_text(BEST, True) == "V = (gamma/N) [int_0^rho_0 (rho/nu)^2 c_f d rho]"
    assert integral_latex(BEST, True) == (
        r"V = \frac{\gamma}{N}\int_{0}^{\rho_0}\left(\frac{\rho}{\nu}\right)^{2}\,c_f\,d\rho"
    )


def test_a_flat_spectrum_has_no_break_at_nu() -> None:
    text, latex = integral_text(FLAT, False), integral_latex(FLAT, False)
    assert text == ("V = (gamma/N) [int_0^rho_0 rho c_f d rho + int_rho_0^oo rho c_f rho^-3 d rho]")
    assert "nu" not in text
    assert r"\nu" not in latex


def test_latex_is_well_formed() -> None:
    for problem, best in ((WORST, False), (BEST, True), (FLAT, False)):
        check_structure(f"${integral_latex(problem, best)}$")


def test_powers() -> None:
    assert [raised("rho", Integer(p)) for p in (1, 2, -2)] == ["rho", "rho^2", "rho^-2"]
    assert raised("rho", Rational(-5, 2)) == "rho^(-5/2)"
    assert raised("rho", Rational(1, 2)) == "rho^(1/2)"
    assert raised("rho", D) == "rho^d"
    assert raised("rho", -D) == "rho^(-d)"
    assert [raised_latex(Integer(p)) for p in (0, 1, -2)] == ["", r"\rho", r"\rho^{-2}"]
