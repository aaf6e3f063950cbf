"""Permissible torques by BS 721-2:1983, one function for each formula.

In mm, m/s, rpm, N m and MPa; angles are in radians, see `asperity.formulas`. The tables are data,
almost all of it from memory: a user's own file takes their place, see `read_tables`. Where one
ends, `TableRangeError` is raised.
"""
