"""Bodies that are marched straight by symmetry, because nothing pushes them across their way."""

from asperity.slider.model import ASKEW, Model


def goes_straight(model: Model, within: float = ASKEW) -> bool:
    r"""Whether a body is marched straight, by symmetry or nearly so, and might leave its way.

    Coulomb's friction and that of springs that are cut off bring any two motions nearer: a push
    across fades. So it does with Dahl's exponent of 1, if the load is constant: across,
    :math:`\dot s = v - |v_x| s/s_{max}` damps what swings on the asperities, whatever
    :math:`v_x` does. ``within`` is what the contact sees of the vibration across, at most.
    """
    friction, slider = model.friction, model.slider
    seen = friction.transfer * abs(model.unit_direction[1])
    if not (model.vibrates and seen <= within and slider.free):
        return False
    if model.solve.scheme == "two-phase":
        return False
    fades = friction.exponent == 1.0 and model.normal is None
    return friction.model == "lugre" or (friction.model == "dahl" and not fades)
