"""Units at the edge: text with a unit comes in, floats in SI go on."""

from asperity.units.quantities import (
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
