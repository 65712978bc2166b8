"""Generators of the catalogue samplers, one file each."""
