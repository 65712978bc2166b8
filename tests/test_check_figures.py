"""The figures of a check: which regions and integrands are drawn, and what is said of the rest."""

from dataclasses import replace
from math import inf

import numpy as np
import pytest
from check_examples import example, pictures, plane, profile

pytest.importorskip("matplotlib")

from matplotlib.figure import Figure
from matplotlib.text import Text
from specrate.numerics.measuring.spectrum_pictures import (
    RegionProfile,
    RegionSpectrum,
    SpectrumPictures,
)
from specrate.report import check_profiles
from specrate.report.check_convergence import convergence_panels, time_panels
from specrate.report.check_figures import figures, merged_profiles
from specrate.report.check_profiles import (
    MOST_PANELS,
    chosen,
    is_drawn,
    monomial_words,
    profile_panel,
    profiles_of,
    thinned,
)
from specrate.report.check_spectra import plane_panels
from specrate.report.figure_panels import inline
from specrate.report.numerals import number
from specrate.report.variance_curves import by_region, curves_of

NONE = SpectrumPictures()


def drawn(panel) -> str:
    """The panel as SVG; a warning of matplotlib, as of a missing glyph, is an error."""
    return inline(panel, "t").text


def texts(panel) -> list[str]:
    """What is written on the panel."""
    figure = Figure()
    panel.draw(figure)
    return [t.get_text() for t in figure.findobj(Text) if t.get_text()]


def flat(region, n=16, exact=None, power=1.0):
    """A spectrum of one frequency."""
    one = np.ones(1)
    claimed = None if exact is None else exact * one
    return RegionProfile(
        region, (RegionSpectrum(n, 9, one, power * one, 0.9 * power * one, 1.1 * power * one,
                                0.05, claimed),)
    )  # fmt: skip


def test_profiles_of_a_document_are_its_numbers():
    document = example("contradicted")
    found = profiles_of(document)
    assert [p.region for p in found] == ["1", "2", "1,2"]
    rows = [r for r in document["regions"][0]["spectrum"] if r["n"] == 64]
    spectrum = next(s for s in found[0].spectra if s.n == 64)
    assert spectrum.radius.tolist() == sorted(r["frequency"][0] for r in rows)
    first = next(r for r in rows if r["frequency"] == [1, 0])
    assert spectrum.power[0] == first["scaled_power"]["estimate"]
    assert spectrum.exact[0] == float(first["predicted"])
    assert spectrum.realisations == document["plan"]["ladder"][1]["replicates"]
    assert np.all(np.diff(spectrum.radius) > 0)


def test_unbounded_ends_and_fits_are_read():
    interval = {"estimate": 2.0, "low": 1.0, "high": None}
    row = {"n": 4, "frequency": [1], "scaled_power": interval, "predicted": None, "agrees": None}
    fit = {"degree": interval, "effective": None, "gamma": None, "alpha": None}
    region = {"region": "1", "profile": [fit], "outside_model": "why", "spectrum": [row]}
    plan = {"ladder": [{"n": 4, "replicates": 2}]}
    (found,) = profiles_of({"regions": [region], "plan": plan})
    assert found.spectra[0].high[0] == inf
    assert found.spectra[0].exact is None
    assert found.monomials[0].degree == (2.0, 1.0, inf)
    assert found.monomials[0].gamma is None
    assert monomial_words(found.monomials[0]) == "b = 2.00 [1.00, ∞]"
    assert not is_drawn(found)
    assert "N = 4" in texts(profile_panel(found))


def test_measured_profiles_come_before_those_of_the_document():
    merged = merged_profiles(example("contradicted"), pictures())
    assert [p.region for p in merged] == ["1", "2", "1,2"]
    assert merged[0].monomials
    assert merged[0].spectra[0].realisations == 400


def test_of_many_regions_those_far_from_the_claim_then_one_of_each_size():
    axes = [flat(str(i), exact=1.0) for i in range(1, 21)]
    far = flat("7,8", exact=30.0)
    whole = flat("1,2,3", exact=1.0)
    found = [p.region for p in chosen([*axes, flat("1,2", exact=1.0), far, whole])]
    assert found == ["1", "2", "3", "4", "5", "6", "1,2", "7,8", "1,2,3"]
    assert len(found) == MOST_PANELS
    assert chosen([RegionProfile("1", ())]) == ()


def test_many_frequencies_are_thinned_evenly_in_their_logarithm():
    (spectrum,) = profile(counts=(2048,)).spectra
    few = thinned(spectrum, 20)
    assert 10 <= len(few.radius) <= 20
    assert (few.radius[0], few.radius[-1]) == (1, 4095)
    assert np.array_equal(few.exact, few.power)
    assert np.diff(np.log(few.radius)).max() < 2.1 * np.log(4095) / 19
    assert thinned(few, 20) is few


def test_a_profile_panel_names_every_n_and_the_curves():
    panel = profile_panel(profile())
    assert panel.title == "region 1"
    assert "N = 64: N·P_S = 8.03 [6.69, 10.4]×10⁻⁴, claimed 8.03×10⁻⁴ at |m| = 1" in panel.about
    assert "b = 2.00 [1.90, 2.10]" in panel.about
    assert drawn(panel).count("stroke-dasharray") > 1


def test_fitted_curves_are_solid_as_their_sample_in_the_legend():
    """Broken is the line of independent points alone, so that a caption can tell them apart."""
    figure = Figure()
    profile_panel(profile(counts=(16, 64, 256))).draw(figure)
    lines = [x for x in figure.axes[0].get_lines() if x.get_linestyle() != "None"]
    assert sum(x.get_linestyle() == "-" for x in lines) == 3
    assert [set(x.get_ydata()) for x in lines if x.get_linestyle() != "-"] == [{1.0}]
    (legend,) = figure.legends
    styles = {
        t.get_text(): x for t, x in zip(legend.get_texts(), legend.legend_handles, strict=True)
    }
    assert styles["fitted profile"].get_linestyle() == "-"
    assert styles["independent points"].get_linestyle() not in ("-", "None")
    assert styles["claimed, exact"].get_marker() == "_"
    caption = figures(example("contradicted"), pictures())[1].caption
    assert "short strokes: exact" in caption
    assert "Solid curves" in caption
    assert "dotted line: independent points" in caption


@pytest.mark.parametrize("factor", [1.0, 1e-3])
def test_the_caption_tells_where_the_drawn_colours_end(factor):
    one = plane()
    measured = replace(one.measured, mean=one.measured.mean * factor)
    shown = SpectrumPictures((replace(one, measured=measured, exact=one.exact * factor),))
    figure = Figure()
    plane_panels(shown.planes)[0].draw(figure)
    norm = figure.axes[0].images[0].norm
    assert (norm.vmin < 1e-3) == (factor < 1)
    told = figures(example("consistent"), shown)[0].caption
    assert f"colours go from {number(norm.vmin)} to {number(norm.vmax)}" in told
    assert ("smaller values having the first" in told) == (factor < 1)
    nothing = figures(example("consistent"), NONE)[0].caption
    assert "colours go" not in nothing


def test_intervals_that_are_not_seen_are_explained():
    assert (
        "none is seen it is smaller than the mark"
        in figures(example("consistent"), NONE)[3].caption
    )


def test_more_n_than_colours_keep_the_ends():
    counts = tuple(2**k for k in range(2, 12))
    shown = [t for t in texts(profile_panel(profile(counts=counts))) if t.startswith("N = ")]
    assert (shown[0], shown[-1], len(shown)) == ("N = 4", "N = 2048", 6)


def test_powers_of_zero_are_drawn_on_the_edge():
    text = drawn(profile_panel(flat("1", exact=0.0, power=0.0)))
    assert "nan" not in text.lower()


def test_a_plane_is_drawn_beside_its_claim():
    measured, claimed = plane_panels(pictures().planes)
    assert measured.title == "measured, N = 64"
    assert claimed.title == "claimed, exact, N = 64"
    scaled = 64 * pictures().planes[0].exact[13, 10]
    assert scaled == pytest.approx(1 - np.sinc(1 / 8) ** 2, rel=1e-12)
    assert "N·P_S = 0.0504 at m = (1, 0)" in claimed.about
    assert measured.about.startswith("Mean of 60 realisations. Coordinates 1 and 2: N·P_S = ")
    text = drawn(measured)
    assert "data:image/png;base64," in text
    assert "var(--ink)" not in text


def test_regions_are_panels_and_their_integrands_curves():
    curves = curves_of(example("contradicted"))
    found = by_region(curves, 6)
    assert [region for region, _ in found] == ["1", "2", "1,2", "overall"]
    assert [len(group) for _, group in found] == [2, 2, 2, 1]
    assert [len(g) for _, g in by_region(curves, 1)] == [1] * 7


def test_claimed_exponents_are_those_of_the_sampler_else_of_the_claim():
    (disk,) = [c for c in curves_of(example("contradicted")) if c.region == "overall"]
    assert (disk.exponent, disk.log_power) == ("3/2", "0")  # jitter is claimed as well
    (ball,) = curves_of(example("exponent"))
    assert (ball.exponent, ball.log_power) == ("1", "0")
    assert "claimed exponent 1." in convergence_panels(example("exponent"))[0].about


def test_convergence_says_every_value():
    document = example("consistent")
    (panel,) = convergence_panels(document)
    for p in document["points"]:
        assert f"N = {p['n']}: variance " in panel.about
    assert "claimed exponent 2" in panel.about
    assert "measured /\nexact" in texts(panel)
    assert "var(--data2)" in drawn(panel)


def test_error_against_time_is_per_realisation():
    document = example("consistent")
    p = document["points"][0]
    changed = {**document, "points": [{**p, "seconds": 3.0 * p["replicates"]}]}
    (panel,) = time_panels(changed)
    assert "in 3.00 s" in panel.about
    assert time_panels({**document, "points": [{**p, "seconds": 0.0}]}) == ()


def test_variances_that_are_rounding_errors_are_named():
    document = example("consistent")
    zero = {"estimate": 1e-33, "low": 0.0, "high": None}
    points = [{**p, "variance": zero} for p in document["points"]]
    figure = figures({**document, "points": points}, NONE)[2]
    assert figure.panels == ()
    assert figure.missing[0].startswith("Variances below 10^-26 are rounding errors")
    assert "bernoulli:k=1, bernoulli:k=2" in figure.missing[0]


@pytest.mark.parametrize(
    ("name", "panels", "missing"),
    [
        ("consistent", [0, 1, 1, 1], "In one dimension frequencies fill no plane"),
        ("contradicted", [0, 3, 4, 4], "averaged no periodogram on a plane"),
        ("raising", [0, 0, 0, 0], "Nothing was measured. No variance was measured."),
        ("exponent", [0, 0, 1, 1], "No spectrum was measured: only exponents are claimed."),
        ("wide", [0, 9, 5, 5], "167 more regions have a spectrum in check.json"),
    ],
)
def test_what_is_missing_is_named(name, panels, missing):
    found = figures(example(name), NONE)
    assert [f.stem for f in found] == ["spectrum", "profiles", "convergence", "error_time"]
    assert [len(f.panels) for f in found] == panels
    assert missing in " ".join(m for f in found for m in f.missing)
    assert all(f.panels or f.missing for f in found)


def test_captions_tell_what_is_there_and_no_more():
    plain, told = figures(example("unclaimed"), NONE), figures(example("contradicted"), pictures())
    assert "claimed" not in plain[1].caption + plain[2].caption
    assert "fitted" not in plain[1].caption
    assert "intervals of 95 % and 99 %" in told[1].caption
    assert "fitted profile" in told[1].caption
    assert told[0].paired
    assert "shaded within 25% of it" in told[2].caption


def test_intervals_widen_the_axis_by_ten_at_most():
    """An interval up to 10^9 would flatten everything else."""
    wide = RegionSpectrum(16, 2, np.array([1.0, 2.0]), np.array([0.1, 1.0]),
                          np.array([1e-9, 0.9]), np.array([1e9, 1.1]))  # fmt: skip
    heights = check_profiles._heights([wide])
    assert (min(heights), max(heights)) == (pytest.approx(0.01), pytest.approx(10.0))


def test_the_caption_names_an_exact_spectrum_only_where_there_is_one():
    claimed, bare = pictures(), SpectrumPictures((replace(plane(), exact=None),))
    captions = [figures(example("consistent"), p)[0].caption for p in (claimed, bare)]
    assert ["exact spectrum" in c for c in captions] == [True, False]
