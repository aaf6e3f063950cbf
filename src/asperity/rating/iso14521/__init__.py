"""Efficiency and load capacity by ISO/TR 14521 (DIN 3996), one function for each formula.

Arguments and results are in the standard's units, named with each: mm, um, N, N m, rpm, m/s, W,
MPa, degC; angles are in radians, see `asperity.formulas`. `film_parameter` raises
`FilmParameterError` where the standard ends. ``edition`` chooses between the families of 1998 and
2010. `asperity.rating.variants` goes all the way from geometries to efficiencies.
"""
