"""Machine-checked statements about the paper."""
