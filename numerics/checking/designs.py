"""The plan of a check: the source, its claims, the N at which it is measured, and with what.

Every claim becomes a *subject* with predictions per N. A claimed sampler brings its exact spectrum
and variances; a bare exponent brings integrands that probe its region and is judged later on
the ladder of N as a whole.
"""

import json
import operator
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from math import ceil
from pathlib import Path
from typing import Any, cast

from ...theory.claims import Claim, RateClaim, SamplerClaim, parse_claim, support_of
from ...theory.errors import InputError
from ...theory.samplers import Sampler, parse_sampler
from ...theory.symbolic import Expr, Integer, sympy
from ...theory.tables import default_samplers
from ..integrands.grammar import parse_integrand
from ..integrands.protocol import Integrand
from ..measuring.probes import (
    JUMP,
    KINK,
    SMOOTH,
    Frequency,
    frequencies,
    integrand_supports,
    probe,
    strata_of_claim,
)
from ..measuring.tails import resolution
from ..point_sources.catalogue_source import CatalogueSource, counts_of, open_source
from ..point_sources.child_processes import Limits, OutOfTime
from ..point_sources.realisations import SamplerFault
from ..point_sources.sources import Source

_RATE_LADDER = (16, 64, 256, 1024, 4096)
_MOST_POINTS = 1 << 22
_MOST_COUNTS = 100  # each has its share of the false alarms
_MOST_AXES = 16  # 2^d strata are drawn up to here
_LARGEST_RATE = 1 << 16  # the ladder of a bare exponent is not moved beyond


@dataclass(frozen=True)
class Design:
    """What is checked, parsed and validated.

    Parameters
    ----------
    words : tuple of str
        The source as written.
    source : Source or CatalogueSource
    dim : int
    claims : tuple of Claim
    integrands : tuple of Integrand
        Those that the user asked for.
    seed : int
    """

    words: tuple[str, ...]
    source: Source | CatalogueSource
    dim: int
    claims: tuple[Claim, ...]
    integrands: tuple[Integrand, ...]
    seed: int

    @property
    def claimed_samplers(self) -> tuple[Sampler, ...]:
        """Samplers among the claims."""
        return tuple(c.sampler for c in self.claims if isinstance(c, SamplerClaim))

    @property
    def rate_claims(self) -> tuple[RateClaim, ...]:
        """Bare exponents among the claims."""
        return tuple(c for c in self.claims if isinstance(c, RateClaim))


def design(
    words: Sequence[str],
    dim: int,
    claims: Sequence[str],
    integrands: Sequence[str],
    seed: int,
    limits: Limits | None = None,
) -> Design:
    """Parse everything that a check is asked for.

    Parameters
    ----------
    limits : Limits, optional
        What a command or a callable may use; whether it is usable shows when it is first asked.

    Raises
    ------
    InputError
        If any of it is outside its grammar, or a claim cannot be probed.
    """
    dim = whole_dim(dim)
    if seed < 0:
        raise InputError(f"a seed must be at least 0: got {seed}")
    texts = [t for word in claims for t in claim_texts(word)]
    parsed = tuple(parse_claim(t, dim) for t in texts)
    for claim in parsed:
        if isinstance(claim, RateClaim):
            rate_probes(claim, dim)
    wanted = tuple(parse_integrand(t, dim) for t in integrands)
    source = open_source(list(words), dim, limits)
    return Design(tuple(words), source, dim, parsed, wanted, seed)


def whole_dim(dim: Any) -> int:
    """A dimension, a whole number of at least 1.

    Raises
    ------
    InputError
        If it is none, as a text is.
    """
    try:
        found = operator.index(dim)
    except TypeError:
        raise InputError(f"the dimension must be a whole number: got {dim!r}") from None
    if isinstance(dim, bool) or found < 1:
        raise InputError(f"the dimension must be at least 1: got {dim}")
    return found


def checked_claims(claims: Any) -> tuple[str, ...]:
    """Claims as they were given, a sequence of texts.

    Raises
    ------
    InputError
        If they are none: a single text is a sequence of letters.
    """
    is_list = isinstance(claims, Sequence) and not isinstance(claims, str)
    if not is_list or not all(isinstance(text, str) for text in cast("list[object]", claims)):
        raise InputError(f"claims must be a list of texts: got {claims!r}")
    return tuple(cast("Sequence[str]", claims))


def claim_texts(word: str) -> list[str]:
    """A claim, or the claims listed in a JSON file.

    Raises
    ------
    InputError
        If the file cannot be read or holds no list of texts.
    """
    if not word.endswith(".json"):
        return [word]
    rule = "a claims file must hold a JSON list of texts"
    try:
        found: Any = json.loads(Path(word).read_text(encoding="utf-8"))
    except OSError as error:
        raise InputError(
            f"a claims file must be readable: got {error.strerror} for {word}"
        ) from None
    except ValueError as error:
        raise InputError(f"{rule}: got {error} in {word}") from None
    if not isinstance(found, list):
        raise InputError(f"{rule}: got another document in {word}")
    for place, text in enumerate(cast("list[Any]", found), 1):
        if not isinstance(text, str):
            raise InputError(f"{rule}: got {json.dumps(text)} as entry {place} in {word}")
    return cast("list[str]", found)


def rate_probes(claim: RateClaim, dim: int) -> tuple[Integrand, ...]:
    """Integrands whose variances add up to one of the claimed class on the claimed region.

    Raises
    ------
    InputError
        If no integrand here belongs to the class.
    """
    if claim.exponent is sympy.oo:
        raise InputError(f"a measured exponent must be finite: got the claim {claim.text!r}")
    family = claim.decay.family
    if family == "additive":
        return _additive_probes(claim, dim)
    if family in ("worst", "best", "p"):
        supports = support_of(claim.region, dim)
        return tuple(probe(dim, _degree(claim, len(s)), s) for s in supports)
    integrand = parse_integrand(claim.decay.name, dim)
    is_inside = integrand.support is not None and claim.region != "overall"
    if is_inside and integrand.support not in support_of(claim.region, dim):
        raise InputError(f"an integrand must have power on the claimed region: got {claim.text!r}")
    if not is_inside and claim.region != "overall":
        raise InputError(
            "a claim on an integrand with power on several supports must be on the region overall: "
            f"got {claim.text!r}"
        )
    return (integrand,)


def _additive_probes(claim: RateClaim, dim: int) -> tuple[Integrand, ...]:
    """The additive integrand itself, or its part on the one axis that is claimed.

    The class without a degree is that of jumps, k = 1.
    """
    degree = int(claim.decay.number or Integer(JUMP))
    if claim.region in ("overall", "axis", "w=1"):
        return (parse_integrand(f"additive:k={degree}", dim),)
    supports = support_of(claim.region, dim)
    if any(len(s) > 1 for s in supports):
        raise InputError(
            "an additive integrand has power on the axes alone, so that a claim on it must be on "
            f"the region overall, axis or one coordinate: got {claim.text!r}"
        )
    parse_integrand(f"additive:k={degree}", dim)  # refuses a degree out of range
    return tuple(probe(dim, degree, s) for s in supports)


def _degree(claim: RateClaim, size: int) -> int:
    """Degree of the Bernoulli polynomial of the claimed class on a support of a size."""
    match claim.decay.family:
        case "worst":
            return JUMP
        case "best":
            return SMOOTH
        case _:
            number: Expr = claim.decay.number or Integer(1)
            degree: Expr = (number - size + 1) / Integer(2)
            if not (degree.is_Integer and 1 <= degree <= 12):
                raise InputError(
                    "a decay p can be probed where p - s is 1, 3, 5, ..., s being the size of the "
                    f"support: got {claim.text!r} with s = {size}"
                )
            return int(degree)


def all_integrands(found: Design) -> tuple[Integrand, ...]:
    """Integrands to measure: probes of each support, of each rate claim, and those asked for."""
    probes: list[Integrand] = []
    if found.claimed_samplers or not found.claims:
        for support in integrand_supports(found.dim):
            probes += [probe(found.dim, k, support) for k in (JUMP, KINK)]
    for claim in found.rate_claims:
        probes += rate_probes(claim, found.dim)
    named = {f.name: f for f in (*probes, *found.integrands)}
    return tuple(named.values())


@lru_cache(maxsize=16)
def candidates(dim: int) -> tuple[Sampler, ...]:
    """Catalogue samplers with points in a dimension, for the search of what agrees."""
    names = [n for n in default_samplers(Integer(dim)) if not n.startswith("isotropic")]
    if dim == 3:
        names += ["uncorrelated-jitter:1+2", "uncorrelated-jitter:2+1"]
    return tuple(parse_sampler(n, dim) for n in names)


def ladder(found: Design, asked: Sequence[int]) -> tuple[int, ...]:
    """The N at which to measure, ascending.

    Those asked for, else three N that the claimed samplers (without any: many catalogue samplers)
    honour, five for a bare exponent; each moved to the nearest N that the source honours.

    Raises
    ------
    InputError
        If an N is out of range, they are too many, or no N suits both the source and a claimed
        sampler.
    SamplerFault, OutOfTime
        If the source fails on a trial call.
    """
    if len(set(asked)) > _MOST_COUNTS:
        raise InputError(f"at most {_MOST_COUNTS} N can be asked for: got {len(set(asked))}")
    for n in asked:
        if not 2 <= n <= _MOST_POINTS:
            raise InputError(f"--n must be in 2..{_MOST_POINTS}: got {n}")
    targets = list(asked) or _targets(found)
    if found.source.counts is not None and not asked:
        targets = list(found.source.counts)
    counts: set[int] = set()
    for target in targets:
        wanted = {target}
        if not asked and found.source.counts is None and found.claimed_samplers:
            wanted = {_several(_honoured(s), target, found.dim) for s in found.claimed_samplers}
        counts |= {_several(found.source.admissible, n, found.dim) for n in wanted}
    for sampler in found.claimed_samplers:
        if not any(counts_of(sampler, n)["N"] == n for n in counts):
            near = sorted({counts_of(sampler, n)["N"] for n in counts})
            raise InputError(
                f"the claim {sampler.name} must have realisations of the N checked (such as "
                f"{', '.join(map(str, near))}): got N = {', '.join(map(str, sorted(counts)))}"
            )
    if 1 in counts:
        raise InputError(f"the source must honour some N of at least 2: got 1 for {targets}")
    return tuple(sorted(counts))


def _honoured(sampler: Sampler) -> Callable[[int], int]:
    return lambda n: counts_of(sampler, n)["N"]


def _several(admissible: Callable[[int], int], target: int, dim: int) -> int:
    """The admissible N near the target; where that is one point, the one near 2^d."""
    n = admissible(target)
    return n if n > 1 or dim > _MOST_AXES else admissible(2**dim)


def _targets(found: Design) -> list[int]:
    targets = _spectrum_targets(found.dim) if found.claimed_samplers or not found.claims else []
    return sorted({*targets, *(n for c in found.rate_claims for n in _rate_targets(c, found.dim))})


def _rate_targets(claim: RateClaim, dim: int) -> tuple[int, ...]:
    """Five N, from the first that resolves the integrands of the claim; fewer if these are fine.

    Twice the least such N is taken, since the source may honour only a smaller one.
    """
    least = ceil(2 * max(resolution(f) for f in rate_probes(claim, dim)))
    if least <= _RATE_LADDER[0]:
        return _RATE_LADDER
    return tuple(n for k in range(5) if (n := least << 2 * k) <= _LARGEST_RATE) or (least,)


def _spectrum_targets(dim: int) -> list[int]:
    """Perfect powers, so that grids, pairs of axes and blocks all have their strata.

    Not all are powers of two: a sampler may be right at these alone.
    """
    if dim <= 2 or dim > 6:
        return [16, 100, 256] if dim <= 2 else [16, 64, 256]
    return {3: [27, 64, 729], 4: [16, 81, 256], 5: [32, 243, 1024], 6: [64, 729]}[dim]


def all_frequencies(found: Design, n: int) -> tuple[Frequency, ...]:
    """Frequencies to measure at N = n; none where only bare exponents are claimed."""
    if found.claims and not found.claimed_samplers:
        return ()
    strata = [c for s in found.claimed_samplers for c in strata_of_claim(s, n)]
    return frequencies(n, found.dim, strata)


def fault_of_count(source: Source | CatalogueSource, fault: SamplerFault) -> SamplerFault:
    """A fault of a wrong number of points, with the nearest N that the source honours."""
    asked = fault.evidence.get("asked")
    if fault.kind != "count" or not isinstance(asked, int):
        return fault
    powers = {r**p for p in range(2, source.dim + 2) for r in range(2, 65) if r**p <= 4 * asked}
    powers |= {1 << k for k in range(1, asked.bit_length() + 1)}
    for n in sorted(powers - {asked}, key=lambda c: (abs(c - asked), c))[:12]:
        try:
            source.realise(n, 0, range(1))
        except SamplerFault:
            continue
        except OutOfTime:
            break
        detail = f"{fault.detail}; the nearest N found that it honours is {n}"
        return SamplerFault(fault.kind, detail, {**fault.evidence, "nearest": n})
    return fault
