"""Worm, hob and enveloped wheel from the equation of meshing.

:Entry: `study.flank`, `asperity flank`.
:Data: `[hob]`, `[disc]`, `[modification]`, `[mount]` (`parameters`) beside `[gearset]`.
:Where: `worm` (profiles, distance, `worm.helicoid` of worm and hob), `wheel` (cut by its hob),
    `meshing` (contact lines, pattern, transmission error, backlash), `measuring` (pins, thickness,
    drawing), `mesh` (hexahedra), `export` (STEP, STL, GLB).
:Tests: `unit/test_flanks_*`, `literature/test_worm_flanks`, `literature/test_enveloped_wheel`,
    `literature/test_wheel_mesh`.
"""
