"""The elastic block on a vibrating base: from case to pictures, and decks of other programs.

:Entry: `solve.prepare` and `solve.answer`, `asperity block`; `solution.march.solve_block` from
    Python.
:Data: `[block]` and `[contact]` (`parameters`) beside the tables of a sliding body.
:Where: `problem` (checked, made ready), `solution` (marched, settled, flutter), `series` (VTU),
    `deck` (Abaqus, CalculiX and the friction subroutine).
:Tests: `unit/test_block_*`, `unit/test_contact_block`, `literature/test_block_against_slider`.
"""
