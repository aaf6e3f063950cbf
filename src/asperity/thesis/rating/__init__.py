"""Worm gearsets rated: chapter 3, and what of chapter 7 is a rating."""
