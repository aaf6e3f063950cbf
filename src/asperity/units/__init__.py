"""Units at the edge: text with a unit comes in, floats in SI go on.

:Entry: `to_si`; `Quantity` in the annotation of a field of a table.
:Data: `measures`: what each unit is worth; `standards`: those of gear standards.
:Where: `quantities` (reading, refusing, bounds).
:Tests: `unit/test_units`, `unit/test_python_units`, `property/test_units`.
"""

from asperity.units.quantities import (
    LARGEST,
    Held,
    Named,
    Quantity,
    bounds_of,
    is_quantity,
    quantity_of,
    registry,
    split_unit,
    to_si,
    unit_of,
)

__all__ = [
    "LARGEST",
    "Held",
    "Named",
    "Quantity",
    "bounds_of",
    "is_quantity",
    "quantity_of",
    "registry",
    "split_unit",
    "to_si",
    "unit_of",
]
