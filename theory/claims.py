"""Claims about a sampler: a catalogue sampler whose whole spectrum it has, or a bare exponent.

    REGION/CLASS ~ EXPONENT [log Q]        axis/best ~ 3,  overall/disk:radius=0.3 ~ 3/2 log 0

The region ends at the first slash, so that a class may hold fractions. Without ``log Q`` the
claim is Q = 0. The dimension d may stand in the exponent.
"""

from dataclasses import dataclass

from .decays import Decay, parse_decay
from .errors import InputError
from .expressions import is_whole, parse_expression
from .regions import select
from .samplers import Sampler, family_of, parse_sampler
from .symbolic import Expr, Integer, sympy

_RULE = "a claim is a catalogue sampler or REGION/CLASS ~ EXPONENT [log Q]"


@dataclass(frozen=True)
class SamplerClaim:
    """The sampler has the whole expected spectrum of a catalogue sampler."""

    text: str
    sampler: Sampler


@dataclass(frozen=True)
class RateClaim:
    """Variance ~ N^-exponent (log N)^log_power for a class of integrands on a region."""

    text: str
    region: str
    decay: Decay
    exponent: Expr
    log_power: Expr


Claim = SamplerClaim | RateClaim


def parse_claim(text: str, dim: int) -> Claim:
    """The claim written in the grammar, for a sampler in ``dim`` dimensions.

    Raises
    ------
    InputError
        If the text is outside the grammar, names no sampler with a spectrum, or a region that
        does not exist.
    """
    words = text.strip()
    if "~" not in words:
        if family_of(words) is None:
            raise InputError(f"{_RULE}: got {text!r}")
        sampler = parse_sampler(words, dim)
        if sampler.kernel is None or sampler.counts_at is None:
            raise InputError(f"a claimed sampler must have a spectrum and points: got {text!r}")
        return SamplerClaim(words, sampler)
    left, _, right = words.partition("~")
    region, slash, decay = left.partition("/")
    if not slash or not region.strip() or not decay.strip():
        raise InputError(f"{_RULE}: got {text!r}")
    exponent, log, power = right.strip().partition("log")
    if log and not power.strip():
        raise InputError(f"{_RULE}: got no Q in {text!r}")
    found = RateClaim(
        words,
        region.strip(),
        parse_decay(decay),
        _number(exponent, dim, text),
        _number(power, dim, text) if power.strip() else Integer(0),
    )
    if (found.exponent is not sympy.oo and found.exponent <= 0) or found.log_power < 0:
        raise InputError(
            f"a claimed exponent must be positive, its log power not negative: got {text!r}"
        )
    support_of(found.region, dim)
    return found


def _number(text: str, dim: int, claim: str) -> Expr:
    value = parse_expression(text, {"d": Integer(dim)})
    if not (value.is_Rational or value is sympy.oo):
        raise InputError(f"a claimed exponent must be rational or oo: got {claim!r}")
    return value


def support_of(region: str, dim: int) -> tuple[tuple[int, ...], ...]:
    """Supports, as 1-based coordinates, that stand for a region of an unknown sampler.

    Without blocks known, a region is a support by its coordinates, or all supports of one size;
    of these the axes and the full support are taken whole and others by their first and last.

    Raises
    ------
    InputError
        If the region is none of these.
    """
    whole = parse_sampler("random", dim).layout
    if region == "overall":
        return tuple(sorted({(1,), (dim,), tuple(range(1, dim + 1))}))
    if is_whole(region.replace(",", "").replace(" ", "")):
        select(whole, region)
        return (tuple(sorted(int(p) for p in region.split(","))),)
    (found,) = select(whole, region)
    size = int(found.dimension)
    if size == 1:
        return tuple((i,) for i in range(1, dim + 1))
    return tuple(sorted({tuple(range(1, size + 1)), tuple(range(dim - size + 1, dim + 1))}))
