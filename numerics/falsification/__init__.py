"""Searches for the simplest witness against a claim, and strategies of designs."""
