"""Integrands with known Fourier coefficients, one file each."""

from .ball import Ball
from .chord import Chord
from .grammar import CATALOGUE, parse_integrand
from .protocol import Factor, Integrand
from .ridge import Ridge
from .separable import Separable

__all__ = [
    "CATALOGUE",
    "Ball",
    "Chord",
    "Factor",
    "Integrand",
    "Ridge",
    "Separable",
    "parse_integrand",
]
