"""Claims: every text is one of the two kinds, or one line of complaint."""

import pytest
from specrate.theory.claims import RateClaim, SamplerClaim, parse_claim, support_of
from specrate.theory.errors import InputError
from specrate.theory.samplers import FAMILIES
from specrate.theory.symbolic import Integer, Rational, sympy


@pytest.mark.parametrize(
    ("text", "dim", "name"),
    [
        ("random", 1, "random"),
        ("jitter", 2, "jitter"),
        (" jitter ", 2, "jitter"),
        ("jitter:25x40", 2, "jitter:25x40"),
        ("n-rooks", 2, "latin-hypercube"),
        ("latin-hypercube", 5, "latin-hypercube"),
        ("multi-jitter:8x16", 2, "multi-jitter:8x16"),
        ("correlated-multi-jitter", 2, "correlated-multi-jitter"),
        ("uncorrelated-jitter:1+2", 3, "uncorrelated-jitter:1+2"),
        ("regular", 3, "regular"),
    ],
)
def test_samplers(text, dim, name):
    claim = parse_claim(text, dim)
    assert isinstance(claim, SamplerClaim)
    assert (claim.text, claim.sampler.name) == (text.strip(), name)


def test_every_family_with_points_can_be_claimed():
    parameters = {"uncorrelated-jitter": ":1+1"}
    for family in FAMILIES:
        if family.name != "isotropic":
            text = family.name + parameters.get(family.name, "")
            assert isinstance(parse_claim(text, 2), SamplerClaim)


@pytest.mark.parametrize(
    ("text", "dim", "region", "family", "exponent", "log_power"),
    [
        ("axis/best ~ 3", 2, "axis", "best", 3, 0),
        ("generic/worst ~ 3/2", 2, "generic", "worst", Rational(3, 2), 0),
        ("overall/disk:radius=0.3 ~ 3/2 log 0", 2, "overall", "disk", Rational(3, 2), 0),
        ("overall/disk:radius=3/10~3/2", 2, "overall", "disk", Rational(3, 2), 0),
        ("overall/worst ~ 1 + 1/d", 4, "overall", "worst", Rational(5, 4), 0),
        ("overall/best ~ 1 + 2/d", 4, "overall", "best", Rational(3, 2), 0),
        ("overall/worst ~ 2 log 1", 2, "overall", "worst", 2, 1),
        ("overall/worst ~ 2 log d-1", 3, "overall", "worst", 2, 2),
        ("overall/worst ~ 2 log 1/2", 3, "overall", "worst", 2, Rational(1, 2)),
        ("1,3/best ~ 2", 3, "1,3", "best", 2, 0),
        ("w=2/p=5/2 ~ 1", 3, "w=2", "p", 1, 0),
        ("axis/best ~ oo", 2, "axis", "best", sympy.oo, 0),
        ("axis/additive ~ 3", 2, "axis", "additive", 3, 0),
        ("1/bernoulli:k=2 ~ 3", 2, "1", "bernoulli", 3, 0),
        (
            "overall/anisotropic-gaussian:sigma=(1/10,2/5) ~ 1",
            2,
            "overall",
            "anisotropic-gaussian",
            1,
            0,
        ),
    ],
)
def test_exponents(text, dim, region, family, exponent, log_power):
    claim = parse_claim(text, dim)
    assert isinstance(claim, RateClaim)
    assert (claim.text, claim.region, claim.decay.family) == (text, region, family)
    assert (claim.exponent, claim.log_power) == (exponent, log_power)


@pytest.mark.parametrize(
    ("text", "dim", "message"),
    [
        ("", 2, "a claim is .* got ''"),
        ("stratified", 2, "a claim is"),
        ("axis/best", 2, "a claim is"),
        ("axis ~ 3", 2, "a claim is"),
        ("/best ~ 3", 2, "a claim is"),
        ("axis/ ~ 3", 2, "a claim is"),
        ("~ 3", 2, "a claim is"),
        ("~", 2, "a claim is"),
        ("axis/best ~", 2, "got ''"),
        ("axis/best ~ three", 2, "got"),
        ("axis/best ~ 3 4", 2, "got"),
        ("axis/best ~ -1", 2, "must be positive"),
        ("axis/best ~ 0", 2, "must be positive"),
        ("axis/best ~ 1 log -1", 2, "not negative"),
        ("axis/best ~ -oo", 2, "got"),
        ("axis/best ~ 1 log x", 2, "got"),
        ("axis/best ~ 1 + b", 2, "got"),
        ("axis/best ~ 1/0", 2, "got"),
        ("axis/best ~ 2**3**9", 2, "got"),
        ("axis/best ~ __import__('os')", 2, "got"),
        ("axis/soft ~ 3", 2, "an integrand class is"),
        ("axis/p=1 ~ 3", 2, "must exceed 1"),
        ("axis/best:k=3 ~ 3", 2, "takes no parameter"),
        ("3/best ~ 3", 2, "got"),
        ("0/best ~ 3", 2, "got"),
        ("1,1/best ~ 3", 2, "got"),
        ("w=3/best ~ 3", 2, "got"),
        ("north/best ~ 3", 2, "got"),
        ("isotropic:2", 2, "must have a spectrum and points: got 'isotropic:2'"),
        ("jitter:3", 2, "got"),
        ("jitter:axb", 2, "got"),
        ("correlated-multi-jitter", 3, "got 3"),
        ("uncorrelated-jitter:1+2", 2, "got"),
    ],
)
def test_what_is_no_claim(text, dim, message):
    with pytest.raises(InputError, match=message) as caught:
        parse_claim(text, dim)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("region", "dim", "supports"),
    [
        ("overall", 1, {(1,)}),
        ("overall", 2, {(1,), (2,), (1, 2)}),
        ("overall", 4, {(1,), (4,), (1, 2, 3, 4)}),
        ("axis", 3, {(1,), (2,), (3,)}),
        ("w=1", 3, {(1,), (2,), (3,)}),
        ("w=2", 2, {(1, 2)}),
        ("w=2", 4, {(1, 2), (3, 4)}),
        ("generic", 3, {(1, 2, 3)}),
        ("generic", 1, {(1,)}),
        ("2", 3, {(2,)}),
        ("3,1", 3, {(1, 3)}),
    ],
)
def test_supports_of_a_region(region, dim, supports):
    found = support_of(region, dim)
    assert set(found) == supports
    assert len(found) == len(supports)


def test_a_number_is_exact():
    assert parse_claim("axis/best ~ 1.1", 2).exponent == Rational(11, 10)
    assert parse_claim("axis/best ~ 3", 2).exponent == Integer(3)
