"""Wear, heat and life of a gearset that is shaken for a share of its time, by ISO/TR 14521.

Wear of the standard goes with the path that the flanks slide. Under vibration they slide to and fro
on top of it, and the standard's path grows by the ratio of the two while it is shaken: friction
work over friction force, which a march or a closed form gives. That the wear for each metre stays
the same, at speeds and forces that swing, is an assumption.

The sump is heated by all losses. The standard's formula for its temperature is not a balance, but
it stands for one: its rise over the surroundings by its losses is what the housing lets through,
and the vibration's heat goes the same way. The teeth are hotter than the sump by what is lost
between them.
"""

import dataclasses
import math

from asperity.errors import InputError
from asperity.rating.inputs import Inputs, Values
from asperity.rating.iso14521.calculation import rated_capacity, rated_efficiency

_ZERO_CELSIUS = 273.15


@dataclasses.dataclass(frozen=True)
class Life:
    """What becomes of wear and heat.

    Attributes
    ----------
    safety_wear, safety_temperature : float
        Those of the standard.
    sump_temperature, bulk_temperature : float
        Of the oil and of the wheel's teeth, K; of a duty cycle in the hottest part.
    wear : float
        Depth worn off in the required life, m; of a duty cycle the sum over its parts.
    hours : float
        Running time in which the wear reaches its limit, h.
    """

    safety_wear: float
    safety_temperature: float
    sump_temperature: float
    bulk_temperature: float
    wear: float
    hours: float


def life(
    inputs: Inputs,
    share: float = 0.0,
    path_ratio: float = 1.0,
    other_heat: float = 0.0,
) -> Life:
    """Return wear, heat and life of a gearset that is shaken for a share of its time.

    Of a duty cycle each part wears and heats by its own torque and speed, as in the rating, and is
    shaken for the same share of its time, at the same ratio of paths.

    Parameters
    ----------
    inputs : Inputs
        Gearset and operation.
    share : float
        Of the time that it is shaken, 0..1.
    path_ratio : float
        Path that the flanks slide under vibration over that without, weighted by the normal force;
        with a constant coefficient of friction that is the ratio of the powers of friction as
        well. 0 or more.
    other_heat : float
        Of damping and of what the actuator loses within the housing while it shakes, W.

    Returns
    -------
    Life
        Wear, temperatures and hours, with the safeties of ISO/TR 14521.

    Raises
    ------
    InputError
        A number outside its range, or the standard has no answer.
    """
    for name, value, high in (
        ("share of time", share, 1.0),
        ("path ratio", path_ratio, math.inf),
        ("other heat", other_heat, math.inf),
    ):
        if not 0.0 <= value <= high:
            upper = "" if math.isinf(high) else f" and at most {high:g}"
            raise InputError(f"the {name} is {value:g}; it must be 0 or more{upper}")
    path = 1.0 - share + share * path_ratio
    parts = inputs.each() or (inputs,)
    found = [_worn(part, path, share * other_heat) for part in parts]
    wear = math.fsum(float(each["delta_Wn_mm"]) * path for each in found)
    safety = float(found[0]["delta_Wlim_mm"]) / wear if wear > 0.0 else math.inf
    return Life(
        safety_wear=safety,
        safety_temperature=min(float(each["safety_temperature"]) for each in found),
        sump_temperature=max(float(each["theta_S_degC"]) for each in found) + _ZERO_CELSIUS,
        bulk_temperature=max(float(each["theta_M_degC"]) for each in found) + _ZERO_CELSIUS,
        wear=1e-3 * wear,
        hours=math.fsum(float(part.life) for part in parts) * safety,
    )


def _worn(inputs: Inputs, path: float, other_heat: float) -> Values:
    """Rate one load with the heat of a path so many times as long, and other heat, W."""
    plain = rated_efficiency(inputs)
    between = plain["loss_meshing_W"]
    meshing = between * path
    operation = inputs.operation
    if operation.oil_temperature is None:
        still = rated_capacity(inputs, plain)
        total = plain["loss_total_W"] + meshing - between + other_heat
        rise = still["theta_S_degC"] - inputs.ambient_temperature
        sump = inputs.ambient_temperature + rise * total / plain["loss_total_W"]
        kelvin = sump + _ZERO_CELSIUS
        operation = operation.model_copy(update={"oil_temperature": kelvin}, units="SI")
    warmer = dataclasses.replace(inputs, operation=operation)
    return rated_capacity(warmer, plain | {"loss_meshing_W": meshing})
