"""Efficiency and load capacity by ISO/TR 14521 (DIN 3996), one function for each formula.

The modules in the order of the standard: `forces`; `film` and `contact`, which are its physical
parameters; `friction`, `efficiency` and `losses`; `wear`; `pitting`; `strength`, which has the
worm's deflection and the root of the wheel's teeth; `thermal`. `calculation` calls all of them for
one gearset, `asperity.rating.variants` for many.

Arguments and results are in the standard's units, named with each: mm, um, N, N m, rpm, m/s, W,
MPa, degC; angles are in radians, see `asperity.formulas`. `film.film_parameter` raises
`film_failure.FilmParameterError` where the standard ends. ``edition`` chooses between the families
of 1998 and 2010.
"""
