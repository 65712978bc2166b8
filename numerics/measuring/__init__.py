"""What is measured on point sets: moments, spectra, slopes."""
