"""Strength of a shaft's section: DIN 743 and distortion energy with Goodman's or Gerber's line."""
