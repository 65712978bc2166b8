"""Attacks on claims by numbers, without any of the kernel: trials, mutants, the ledger."""
