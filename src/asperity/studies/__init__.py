"""Studies of a worm gearset: sensitivity, ways to less friction, optimum, trade-off, catalogue."""
