"""What is computed or measured: spectra, variances, point sets, campaigns, verdicts."""
