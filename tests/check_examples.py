"""Documents of real checks, one for each verdict, and pictures of spectra beside them."""

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from specrate.numerics import check
from specrate.numerics.expected_spectra.spectra import power_array
from specrate.numerics.generators import generate
from specrate.numerics.measuring.moments import Interval
from specrate.numerics.measuring.periodograms import Box, average_periodogram
from specrate.numerics.measuring.spectrum_pictures import (
    FittedMonomial,
    PlaneSpectrum,
    RegionProfile,
    RegionSpectrum,
    SpectrumPictures,
)
from specrate.numerics.streams import stream
from specrate.theory.samplers import parse_sampler

Document = dict[str, Any]

SAMPLERS = str(Path(__file__).parent / "designs" / "samplers.py")


@cache
def example(name: str) -> Document:
    """The document of a check; not to be changed."""
    match name:
        case "consistent":
            return check("jitter", 1, ["jitter"], counts=[16, 64], budget=20)
        case "contradicted":
            claims = ["jitter", "overall/disk:radius=0.3 ~ 3"]
            return check("random", 2, claims, ["disk:radius=0.3"], [16, 64, 256], 20)
        case "invalid":
            return check(f"{SAMPLERS}:centred_rooks", 2, ["n-rooks"], counts=[16], budget=20)
        case "raising":
            return check(f"{SAMPLERS}:raising", 2, ["random"], counts=[16], budget=20)
        case "inconclusive":
            return check("jitter", 2, ["jitter"], counts=[256], budget=1e-3)
        case "exponent":
            return check("random", 3, ["overall/ball:radius=0.3 ~ 1"], counts=[16, 64], budget=0.2)
        case "unclaimed":
            return check("random", 3, counts=[27], budget=1e-3)
        case "wide":
            return check("latin-hypercube", 10, ["latin-hypercube"], counts=[16], budget=0.2)
        case _:
            raise KeyError(name)


@cache
def plane() -> PlaneSpectrum:
    """Jitter with 64 points, measured and exact."""
    sampler = parse_sampler("jitter", 2)
    counts = sampler.counts_at(64)
    points = generate(sampler, counts, 60, stream(31))
    measured = average_periodogram([points], Box((12, 10)))
    where = measured.frequencies().reshape(-1, 2)
    exact = np.ones(len(where))
    exact[where.any(axis=1)] = power_array(sampler, counts, where[where.any(axis=1)])
    return PlaneSpectrum((1, 2), measured, exact.reshape(measured.mean.shape))


def profile(region: str = "1", counts: tuple[int, ...] = (64, 256)) -> RegionProfile:
    """1D jitter's spectrum with what a fit would say of it."""
    spectra: list[RegionSpectrum] = []
    for n in counts:
        radius = np.arange(1.0, 2 * n)
        power = 1 - np.sinc(radius / n) ** 2
        low, high = power / 1.2, power * 1.3
        spectra.append(RegionSpectrum(n, 400, radius, power, low, high, 0.01, power))
    fitted = FittedMonomial(
        Interval(2, 1.9, 2.1), Interval(1, 0.95, 1.05), Interval(1, 0.9, 1.1), Interval(0.6, 0.5, 1)
    )
    return RegionProfile(region, tuple(spectra), (fitted,))


def pictures() -> SpectrumPictures:
    """One plane, one region, and something left out."""
    return SpectrumPictures((plane(),), (profile(),), (("other planes", "one is enough"),))
