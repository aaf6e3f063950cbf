"""Loaded contact of worm and wheel over a pitch, without vibration."""
