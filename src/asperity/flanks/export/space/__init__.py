"""Worm and wheel as they are seen in space."""
