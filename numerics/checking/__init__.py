"""The verdict on a design: faults, claims, evidence, and what was left out."""
