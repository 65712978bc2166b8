"""Entries of the ledger, a file for each section of the paper, and one for what lies beyond it."""
