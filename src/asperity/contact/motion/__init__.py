"""Condensed bodies in motion: time steps, the drive, rest under load, and the ledger of powers."""
