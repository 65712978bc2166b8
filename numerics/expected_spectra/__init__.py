"""Expected power spectra as numbers: the kernels of the theory room, evaluated."""
