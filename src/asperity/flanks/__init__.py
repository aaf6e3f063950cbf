"""Worm, hob and enveloped wheel from the equation of meshing."""
