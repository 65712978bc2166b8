"""Exact variances of the randomly shifted estimator at finite N, their constants and crossovers."""
