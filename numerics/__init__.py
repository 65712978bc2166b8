"""What is computed or measured: spectra, variances, point sets, campaigns, verdicts."""

from .check_documents import check

__all__ = ["check"]
