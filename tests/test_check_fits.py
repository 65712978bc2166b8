"""Fitted profiles and predicted rates, printed: terminal, LaTeX and the tables of the page."""

import pytest
from check_examples import example
from specrate.numerics.measuring.spectrum_pictures import SpectrumPictures
from specrate.report.check_fits import falling, fit_remarks, fit_rows, fixed, rate_rows
from specrate.report.check_formats import render
from specrate.report.check_tables import tables_of

INTERVAL = {"estimate": 1.5, "low": 1.25, "high": 2.0}


def test_numbers():
    assert fixed(INTERVAL) == "1.50 [1.25, 2.00]"
    assert fixed({**INTERVAL, "high": None}) == "1.50 [1.25, oo]"
    assert falling(INTERVAL) == "-1.50 [-2.00, -1.25]"
    assert falling({**INTERVAL, "high": None}) == "-1.50 [-oo, -1.25]"
    assert fixed(None) == falling(None) == "-"


@pytest.fixture(scope="module")
def jitter():
    """Jitter in 1D, consistent with itself; profiles were fitted."""
    return example("consistent")


def test_rows_of_fits_and_classes(jitter):
    (row,) = fit_rows(jitter)
    assert row[0] == "1"
    assert row[1] == fixed(jitter["regions"][0]["profile"][0]["degree"])
    rates = rate_rows(jitter)
    assert [r[:2] for r in rates] == [
        *((name, "1") for name in ("bernoulli:k=1", "bernoulli:k=2")),
        *(("worst", region) for region in ("1", "overall")),
        *(("best", region) for region in ("1", "overall")),
    ]
    assert [r[3] for r in rates] == ["2", "3", "2", "2", "3", "3"]


def test_the_terminal_shows_them(jitter):
    text = render(jitter, "terminal")
    assert "Profiles fitted to the spectra" in text
    assert "e [95 %]" in text
    assert "Exponents r of the variance" in text
    assert fit_rows(jitter)[0][2] in text


def test_latex_sets_the_symbols(jitter):
    text = render(jitter, "latex")
    assert r"\gamma" in text
    assert r"\alpha" in text
    assert not set(text) & set("γα·")


def test_what_was_not_fitted_is_not_shown():
    text = render(example("inconclusive"), "terminal")
    assert "Profiles fitted" not in text
    assert "Exponents r" not in text
    assert "Left out, fitted profiles of" in text


def test_reasons_are_told_once():
    regions = [
        {"region": "1", "outside_model": None, "reason": "one N", "profile": []},
        {"region": "2", "outside_model": None, "reason": "one N", "profile": []},
        {"region": "1,2", "outside_model": "a lattice", "reason": None, "profile": []},
        {"region": "3", "outside_model": None, "reason": None, "profile": []},
    ]
    assert list(fit_remarks({"regions": regions})) == [
        "Fit on 1; 2: one N.",
        "Fit on 1,2: no profile fits: a lattice.",
    ]


def test_the_page_has_them_in_tables(jitter):
    profiles = tables_of(jitter, SpectrumPictures(), "profiles").text
    assert "that the fitted profiles predict" in profiles
    assert "claimed" in profiles
    assert (
        "of the fitted profile, 95 %" in tables_of(jitter, SpectrumPictures(), "convergence").text
    )
    exponent = tables_of(example("exponent"), SpectrumPictures(), "profiles").text
    assert "predict" not in exponent


def test_without_a_claimed_sampler_there_is_no_column_for_it(jitter):
    bare = {**jitter, "rates": [
        {**r, "predicted": {"exponent": None, "log_power": None}} for r in jitter["rates"]
    ]}  # fmt: skip
    table = tables_of(bare, SpectrumPictures(), "profiles").text.split("</table>")[0]
    assert "predict" in table
    assert "claimed" not in table
    heads = render(bare, "terminal").split("Exponents r of the variance")[1].splitlines()[1]
    assert heads.split() == ["integrand", "region", "r", "[95", "%]"]
