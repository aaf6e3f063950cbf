r"""Tooth friction of the local sliding speed and temperature, from the chain of ISO/TR 14521.

The standard's mean coefficient is a function of the sliding velocity at the worm's mean diameter,
:math:`\mu_{zm} = \mu_{0T}(v_{gm}) Y_S Y_G Y_W Y_R`, found from gearboxes that run steadily. Here it
is taken at the speed with which the flanks slide at an instant, which the standard does not say and
which no test of it under vibration confirms: the film is assumed to follow at once.

Nor does the standard let the coefficient depend on the temperature. What falls with the speed is
the share that asperities carry, as the film grows; and of the film, the standard's own formula
knows the product of viscosity and speed alone, :math:`h_{min} \sim (\eta n_1)^{0.7}`. So the
coefficient at another temperature is that of the speed with the same film,

.. math:: \mu(v, \theta) = \mu_{zm}\left(v\,\eta(\theta)/\eta(\theta_M)\right)

with the wheel's bulk temperature of the rating as :math:`\theta_M`: an inference, and exact where
the temperature is that of the rating.
"""

import math

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.casefile import Case, naming_source
from asperity.drive.friction_curve import FrictionCurve
from asperity.drive.lugre import static_ratio
from asperity.drive.parameters import Drive
from asperity.errors import InputError
from asperity.friction import Friction
from asperity.gearset import oil
from asperity.gearset.parameters import Gearset
from asperity.rating.driven import driven
from asperity.rating.inputs import Inputs, inputs
from asperity.rating.iso14521.calculation import rated_capacity, rated_efficiency
from asperity.rating.iso14521.friction import base_friction
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.tables import operation_of

_POINTS = 4097
_MM2 = 1e6
_ZERO_CELSIUS = 273.15


def rating_inputs(case: Case) -> Inputs:
    """Return what the standard's formulas take of a case.

    Raises
    ------
    InputError
        The case has no ``[gearset]`` or ``[operation]``, or prescribes the friction, which then
        does not depend on the speed.
    """
    with naming_source(case):
        options = case.get(RatingOptions, RatingOptions())
        gearset = case.require(Gearset)
        given = inputs(gearset, driven(gearset, operation_of(case), options), options)
        for key in ("friction", "base_friction"):
            value = getattr(options, key)
            if value is not None:
                raise InputError(
                    f"rating.{key} is {value:g}; friction of the sliding speed is the standard's "
                    "own: leave it out, or keep friction constant"
                )
    return given


def tooth_friction(
    inputs: Inputs, speed: npt.ArrayLike, temperature: float | None = None
) -> FloatArray:
    """Return the coefficient of tooth friction at sliding speeds.

    Parameters
    ----------
    inputs : Inputs
        Gearset and operation.
    speed : array_like
        Sliding speed of the flanks, m/s, from 0.
    temperature : float, optional
        Of the film, K; that of the rating if left out.

    Returns
    -------
    ndarray, shape of ``speed``
        At most the standard's cap, which holds at rest.
    """
    rated = rated_efficiency(inputs)
    factors = rated["Y_S"] * rated["Y_G"] * rated["Y_W"] * rated["Y_R"] * inputs.friction_factor
    thicker = 1.0 if temperature is None else viscosity_ratio(inputs, temperature)
    operation = inputs.operation
    base = base_friction(
        np.asarray(speed, float) * thicker,
        family=inputs.gearset.wheel_material.family,
        lubrication=operation.lubrication,
        base_oil=operation.lubricant.base_oil,
    )
    return np.asarray(factors * base, float)


def viscosity_ratio(inputs: Inputs, temperature: float) -> float:
    """Return the oil's dynamic viscosity at a temperature, K, over that at the rating's."""
    rated = rated_capacity(inputs, rated_efficiency(inputs))
    lubricant = inputs.operation.lubricant
    celsius = temperature - _ZERO_CELSIUS
    viscosity = oil.kinematic_viscosity(
        celsius, _MM2 * lubricant.viscosity_40, _MM2 * lubricant.viscosity_100
    )
    density = oil.density(celsius, inputs.density_15, lubricant.base.density_coefficient)
    return float(viscosity * density / _MM2 / rated["eta_0M_Pas"])


def friction_curve(inputs: Inputs, fastest: float) -> FrictionCurve:
    """Return the coefficient of tooth friction as a kernel looks it up.

    Parameters
    ----------
    inputs : Inputs
        Gearset and operation.
    fastest : float
        Sliding speed up to which it is to be right, m/s.
    """
    if not fastest > 0.0:
        raise InputError(f"the fastest sliding speed is {fastest:g} m/s; it must be positive")
    speeds = np.linspace(0.0, fastest, _POINTS)
    return FrictionCurve(float(speeds[1]), tooth_friction(inputs, speeds))


def mesh_friction(case: Case, gearset: Gearset, operation: Operation, drive: Drive) -> Friction:
    """Return a case's friction; by the standard its coefficient is that of steady sliding.

    That on the reference circle, rigid asperities where nothing is said of them.
    """
    if drive.friction == "constant":
        if Friction.table not in case:
            raise InputError(
                f"{case.source}: the table [friction] is missing; add it with model, 'coulomb' or "
                "'dahl', and mu, or set drive.friction = 'iso14521'"
            )
        return case.require(Friction)
    g = gearset.require_consistent().geometry
    circle = 0.5e-3 * g.worm_pitch_diameter / math.cos(g.lead_angle)
    mu = float(tooth_friction(rating_inputs(case), operation.worm_speed * circle))
    if Friction.table not in case:
        return Friction(model="coulomb", mu=mu)
    given = case.require(Friction)
    if static_ratio(given) > 1.0:
        raise InputError(
            f"friction.static_mu is {given.static_mu:g}, but with drive.friction 'iso14521' the "
            "standard says how friction falls with the speed: leave it out"
        )
    return given.model_copy(update={"mu": mu, "static_mu": None}, units="SI")


def check_friction(friction: Friction) -> None:
    """Refuse what a mesh's friction is not."""
    if friction.model not in ("coulomb", "dahl", "lugre"):
        raise InputError(
            f"friction.model is '{friction.model}', which is of a sliding body; between teeth it "
            "must be 'coulomb', 'dahl' or 'lugre'"
        )
    for key, only in (("law", "vector"), ("transfer", 1.0), ("load_exponent", 1.0)):
        value = getattr(friction, key)
        if value != only:
            raise InputError(
                f"friction.{key} is {value!r}, which is of a sliding body; between teeth it is "
                f"{only!r}: leave it out"
            )
    if friction.model != "coulomb" and friction.keeps != "stiffness":
        raise InputError(
            "friction.keeps is 'deflection', which makes energy where the force between teeth "
            "swings; it must be 'stiffness': leave it out"
        )
