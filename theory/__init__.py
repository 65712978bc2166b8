"""What is exactly true: orders, regions, kernels, profiles, Eq. 17, rates, derivations."""
