"""Eq. 17 as a number: along a region, for true spectra, as a whole."""
