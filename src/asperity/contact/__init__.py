"""Elastic bodies in contact: condensed to the nodes that touch, with friction of our own.

It knows nothing of blocks or teeth.

:Entry: `increment.solver` (one implicit step), `static` (a counter-surface pushed), `motion.march`
    (over time).
:Data: meshes of `asperity.mesh`, laws of `asperity.friction`.
:Where: `elastic` (bodies condensed, modes), `interface` (surfaces, tractions, normal laws),
    `candidates` (many bodies, compiled), `compliance`.
:Tests: `unit/test_contact_*`, `literature/test_contact_*`, `property/test_contact_march`.
"""
