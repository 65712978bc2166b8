"""Proofs of the entries, and the tactics that find their steps; none of it is trusted."""
