"""Which bodies can be marched in a batch, in vector instructions."""

from asperity.friction.dahl import VECTOR
from asperity.friction.loaded import STIFFNESS
from asperity.normal import HERTZ, LINEAR
from asperity.slider.model import Model

FORCES = {LINEAR: (1.0, 0.0), HERTZ: (0.0, 1.5**-1.5)}
"""Elastic force over the penetration, by contact law: a number, and one times its root."""


def fits_batch(model: Model) -> bool:
    """Whether the model can be marched in a batch, in vector instructions."""
    return (
        model.solve.method == "march"
        and model.solve.scheme == "exponential"
        and model.friction.model == "dahl"
        and model.friction.exponent == 1.0
        and model.slider.drive_damping == 0.0
        and (model.normal is None or _fits_pressed(model))
    )


def _fits_pressed(model: Model) -> bool:
    return (
        model.normal is not None
        and model.normal.code in FORCES
        and model.friction.law_code == VECTOR
        and model.friction.keeps_code == STIFFNESS
        and model.friction.load_exponent == 1.0
    )
