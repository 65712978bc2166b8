"""Integrands with known Fourier coefficients, one file each."""

from .ball import Ball
from .bernoulli import Bernoulli
from .box import Box
from .gaussian import Gaussian
from .grammar import CATALOGUE, parse_integrand
from .product import Product
from .protocol import Factor, Integrand

__all__ = [
    "CATALOGUE",
    "Ball",
    "Bernoulli",
    "Box",
    "Factor",
    "Gaussian",
    "Integrand",
    "Product",
    "parse_integrand",
]
