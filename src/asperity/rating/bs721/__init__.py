"""Permissible torques by BS 721-2:1983, one function for each formula.

The formulas stand in `torque` and `life`; `rating` calls them one after another. In mm, m/s, rpm,
N m and MPa; angles are in radians, see `asperity.formulas`. The tables are data, almost all of it
from memory: a user's own file takes their place, see `tables.read_tables`. Where one ends,
`tables.TableRangeError` is raised.
"""
