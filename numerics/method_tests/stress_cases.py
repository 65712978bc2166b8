"""The stiff and extreme cases by kind: Eq. 17, spectra, exact variances."""

from typing import Any

from .radial_cases import RADIAL
from .spectrum_cases import SPECTRA
from .stress import Family
from .variance_cases import VARIANCES

FAMILIES: tuple[Family[Any], ...] = (RADIAL, SPECTRA, VARIANCES)
