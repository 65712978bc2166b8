"""Profiles fitted to measured spectra: degree, effective exponent, plateau, cut-off."""
