"""Worm and hob: profile of the flank, distance to it, how both stand to the wheel."""
