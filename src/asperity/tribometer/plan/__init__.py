"""The plan of a series of tests: which cells, in which order, and what they will not tell."""
