"""Efficiency and load capacity by ANSI/AGMA 6034-B92, one function for each formula.

The formulas stand in `mesh`, `capacity`, `forces` and `thermal`; `rating` calls them one after
another. Every one is written once, in the standard's inches, pounds and feet a minute. With
``units="si"``, the default, arguments and results are in mm, m/s, N, N m, W and MPa and are
converted exactly; with ``units="inch"`` they are taken as the standard has them. Angles are in
radians, speeds in rpm, see `asperity.formulas`.
"""
