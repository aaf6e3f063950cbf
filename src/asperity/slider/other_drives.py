"""A body on another drive than its own: carried along, or damped; and in longer steps."""

import math

from asperity.kernels.compiled import kernel
from asperity.slider.scaled import NormalLoading, Parameters


@kernel
def _on_other_drive(p, rigid, damping, retained, mobility_x, mobility_y):
    """Return the body with another drive and other mobility."""
    return Parameters(
        p.drive, p.pull, p.stiffness, damping, retained, mobility_x, mobility_y,
        p.base_x, p.base_y, p.own_1, p.own_2, p.exponent, p.rate_damping, p.slip_damping,
        p.static_ratio, p.stribeck, rigid, p.smooth, p.model, p.law,
    )  # fmt: skip


@kernel
def carried(p):
    """Return the body carried along by its drive, guided."""
    return _on_other_drive(p, True, p.damping, p.retained, 0.0, 0.0)


@kernel
def damped(p):
    """Return the body on a drive damped critically."""
    if p.rigid:
        return p
    mobility = p.mobility_x * 2.0 / (1.0 + p.retained)
    damping = 2.0 * math.sqrt(p.stiffness / mobility)
    lost = 0.5 * mobility * damping
    return _on_other_drive(
        p, False, damping, (1.0 - lost) / (1.0 + lost), mobility / (1.0 + lost), p.mobility_y
    )


@kernel
def in_longer_steps(p, longer):
    """Return the body in steps that are longer, by the same unit of length."""
    mobility = longer * longer * p.mobility_x * 2.0 / (1.0 + p.retained)
    lost = 0.5 * mobility * p.damping / longer
    return Parameters(
        longer * p.drive, p.pull, p.stiffness, p.damping / longer, (1.0 - lost) / (1.0 + lost),
        mobility / (1.0 + lost), longer * longer * p.mobility_y, p.base_x, p.base_y, p.own_1,
        p.own_2, p.exponent, p.rate_damping / longer, p.slip_damping / longer, p.static_ratio,
        longer * p.stribeck, p.rigid, p.smooth, p.model, p.law,
    )  # fmt: skip


@kernel
def pressed_in_longer_steps(q, longer):
    """Return what is normal to the plane in steps that are longer; None where nothing is."""
    if q is None:
        return None
    return NormalLoading(
        q.law, q.reference, q.base, longer * longer * q.mobility, q.damping / longer,
        q.load_power, q.keeps, q.heights, q.weights,
    )  # fmt: skip
