"""A worm gearset under load and under vibration: teeth, shafts, march over time, protocols.

:Entry: `solve` (`asperity drive`), `directions`, `locking`, `studies`.
:Data: `[drive]`, `[shaft]`, `[actuator]` (`parameters`) beside `[gearset]`, `[operation]`,
    `[friction]`, `[vibration]`.
:Where: `static` (a pitch under load), `teeth` and `elastic` (bending teeth, at rest and in motion),
    `reduced` (one point a flank, `reduced.mesh`: its forces, damping), `motion` (the march),
    `protocols` (what is asked of it), `shafts` (bearings, bending, torsion), `motor`, `actuator`,
    `life`, `wear` (a wheel that beds in), `deck`.
:Tests: `unit/test_drive_*`, `literature/test_drive_*`, `literature/test_tooth_contact`,
    `property/test_drive`.
"""
