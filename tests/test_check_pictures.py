"""Pictures of a check: planes against direct sums and exact spectra, radii against the fits."""

import numpy as np
import pytest
from specrate.numerics.checking.check_documents import check_with_pictures
from specrate.numerics.checking.check_pictures import pictures_of
from specrate.numerics.checking.checks import Execution, Step, run_check
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.measuring.measurements import kept_points
from specrate.theory.samplers import parse_sampler


def executed(word, dim, claims, counts, replicates=64, fitted=3):
    steps = tuple(Step(n, replicates, replicates, replicates) for n in counts)
    return run_check([word], dim, claims, again=Execution(steps, fitted=fitted))


def test_the_plane_is_that_of_the_largest_n():
    state = executed("jitter", 2, ["jitter"], [16, 64])
    (plane,) = pictures_of(state).planes
    assert plane.coordinates == (1, 2)
    assert (plane.measured.n, plane.measured.realisations) == (64, 64)
    assert plane.measured.mean.shape == (49, 49)  # 3 sqrt(64) to each side
    points = kept_points(state.measurements[-1])
    for m in ((1, 0), (-3, 5), (24, -24)):
        power = abs(np.exp(-2j * np.pi * points @ np.array(m)).mean(axis=1)) ** 2
        assert plane.measured.mean[24 + m[0], 24 + m[1]] == pytest.approx(power.mean(), abs=1e-8)
        sampler = parse_sampler("jitter", 2)
        exact = power_array(sampler, sampler.counts_at(64), np.array([m]))[0]
        assert plane.exact[24 + m[0], 24 + m[1]] == pytest.approx(exact, rel=1e-12)
    assert plane.exact[24, 24] == 1


def test_no_plane_is_shown_of_a_dropped_n():
    state = executed("jitter", 2, ["jitter"], [16, 64], fitted=0)
    state.measurements[-1].dropped = "too costly"
    assert [p.measured.n for p in pictures_of(state).planes] == [16]


def test_planes_of_a_space_are_those_of_its_pairs():
    state = executed("latin-hypercube", 3, ["jitter"], [27], 8, 0)
    found = pictures_of(state)
    assert [p.coordinates for p in found.planes] == [(1, 2), (1, 3), (2, 3)]
    assert found.left_out == ()
    points = kept_points(state.measurements[0])
    last = found.planes[-1]
    power = abs(np.exp(-2j * np.pi * points @ np.array([0, 2, -1])).mean(axis=1)) ** 2
    assert last.measured.mean[16 + 2, 16 - 1] == pytest.approx(power.mean(), abs=1e-8)
    sampler = parse_sampler("jitter", 3)
    exact = power_array(sampler, sampler.counts_at(27), np.array([[0, 2, -1]]))[0]
    assert last.exact[16 + 2, 16 - 1] == pytest.approx(exact, rel=1e-12)


def test_in_many_dimensions_a_few_planes_are_shown_and_the_rest_is_said():
    found = pictures_of(executed("random", 5, [], [16], 4, 0))
    assert [p.coordinates for p in found.planes] == [(1, 2), (1, 5), (4, 5)]
    assert all(p.exact is None for p in found.planes)
    ((what, why),) = found.left_out
    assert (what, why) == (
        "other planes of frequencies",
        "7 more pairs of coordinates have one; shown are those of 1,2, 1,5, 4,5",
    )


def test_profiles_are_those_that_were_fitted():
    state = executed("jitter", 2, ["jitter"], [16, 64])
    found = pictures_of(state).profiles
    assert [p.region for p in found] == ["1", "2", "1,2"]
    for shown, region in zip(found, state.fitted, strict=True):
        assert shown.monomials[0].degree == region.fit.degree
        assert shown.monomials[0].effective == region.fit.effective
        assert shown.reason == region.fit.reason
        for spectrum, held in zip(shown.spectra, region.spectra, strict=True):
            assert (spectrum.n, spectrum.realisations) == (held.n, 64)
            assert sorted(spectrum.power) == sorted(held.power)
            assert (np.diff(spectrum.radius) >= 0).all()
            assert (spectrum.low < spectrum.power).all()
            assert (spectrum.power < spectrum.high).all()
    axis = found[0].spectra[0]
    sampler = parse_sampler("jitter", 2)
    exact = 16 * power_array(sampler, sampler.counts_at(16), np.array([[1, 0], [2, 0]]))
    np.testing.assert_allclose(axis.exact[:2], exact, rtol=1e-12)


def test_intervals_of_one_frequency_hold_its_power():
    """In 95 % of cases by the gamma law; of 200 independent ones, fewer than 160 with 4e-12."""
    state = executed("random", 2, ["random"], [64], 128)
    spectra = [s for p in pictures_of(state).profiles for s in p.spectra]
    held = [(s.low < s.exact) & (s.exact < s.high) for s in spectra]
    assert np.concatenate(held).mean() > 0.8


@pytest.mark.parametrize("replicates", [0, 1])
def test_nothing_is_shown_of_less_than_two_realisations(replicates):
    found = pictures_of(executed("random", 2, [], [16], replicates))
    assert found.planes == found.profiles == ()


def test_a_claim_without_such_an_n_has_no_exact_plane():
    state = executed("random", 2, ["jitter"], [16, 50])
    (plane,) = pictures_of(state).planes
    assert (plane.measured.n, plane.exact) == (50, None)
    small, large = pictures_of(state).profiles[0].spectra
    assert small.exact is not None
    assert large.exact is None


def test_the_document_is_that_of_the_check():
    found, pictures = check_with_pictures("jitter", 1, ["jitter"], counts=[16, 64], budget=20)
    assert found["verdict"] == "consistent"
    assert pictures.planes == ()  # a line has none
    assert [p.region for p in pictures.profiles] == ["1"]
    assert found["regions"][0]["profile"][0]["degree"]["estimate"] == (
        pictures.profiles[0].monomials[0].degree.estimate
    )
