"""The `[operation]` and `[rating]` tables: how a worm gearset is run, and how it is to be rated."""

from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, model_validator

from asperity.casefile import Table
from asperity.errors import InputError
from asperity.units import Quantity

Torque = Annotated[float, Quantity("N m", what="a torque", example="366 N m", gt=0)]
Temperature = Annotated[
    float, Quantity("K", what="a temperature", example="20 degC", gt=173.15, lt=573.15)
]
Time = Annotated[float, Quantity("s", what="a time", example="25000 h", gt=0)]
Ratio = Annotated[float, Quantity("", what="a factor", example="1.0", gt=0)]


class Operation(Table):
    r"""How a worm gearset is run. The worm drives.

    Parameters
    ----------
    worm_speed : float or str
        :math:`n_1`, rad/s ("1440 rpm" in a file).
    output_torque : float or str
        Rated wheel torque :math:`T_R`, N m: strength is judged by it.
    through_travel_torque : float or str, optional
        Wheel torque through the travel :math:`T_2`, N m: wear is judged by it. Left out: a third
        of ``output_torque``, as the thesis has it (3.2.1).
    wheel_revolutions : float, optional
        Required life in turns of the wheel. Give this or ``life``; left out: ``life``.
    life : float or str, optional
        Required life, s ("25000 h" in a file). Left out: 25000 h.
    lubricant : str or table
        A name, or a table with ``base_oil``, ``viscosity_40``, ``viscosity_100``, ``density_15``.
    lubrication : {'bath', 'spray'}
        How it gets there.
    oil_temperature : float or str, optional
        Sump temperature, K. Left out: from the heat balance of the standard.
    ambient_temperature : float or str
        K; 20 degC if left out.
    bearings : {'fixed-floating', 'preloaded'}
        Arrangement of the worm's bearings.
    bearing_span : float or str, optional
        Between the worm's bearings, m. Left out: 1.5 centre distances.
    seals : int
        Lip seals on the worm shaft.
    fan : bool
        Whether a fan sits on the worm shaft.
    immersed : {'worm', 'wheel'}
        What dips into the oil.
    application_factor : float
        :math:`K_A`, multiplies the torque.
    starts_per_hour : float
        :math:`N_S`.
    """

    table: ClassVar[str] = "operation"
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (("wheel_revolutions", "life"),)

    worm_speed: Annotated[
        float, Quantity("rad/s", what="a speed of rotation", example="1440 rpm", gt=0)
    ]
    output_torque: Torque
    through_travel_torque: Torque | None = None
    wheel_revolutions: (
        Annotated[float, Quantity("", what="a number of turns", example="500000", gt=0)] | None
    ) = None
    life: Time | None = None
    lubricant: str | dict[str, Any]
    lubrication: Literal["bath", "spray"] = "bath"
    oil_temperature: Temperature | None = None
    ambient_temperature: Temperature = 293.15
    bearings: Literal["fixed-floating", "preloaded"] = "fixed-floating"
    bearing_span: (
        Annotated[float, Quantity("m", what="a length", example="110 mm", gt=0)] | None
    ) = None
    seals: Annotated[int, Field(ge=0, le=10)] = 2
    fan: bool = False
    immersed: Literal["worm", "wheel"] = "worm"
    application_factor: Ratio = 1.0
    starts_per_hour: Annotated[float, Quantity("", what="a number", example="0", ge=0)] = 0.0

    @model_validator(mode="after")
    def _consistent(self) -> "Operation":
        if (
            self.through_travel_torque is not None
            and self.through_travel_torque > self.output_torque
        ):
            raise InputError(
                f"operation.through_travel_torque is {self.through_travel_torque:g} N m; it must "
                f"not exceed operation.output_torque, {self.output_torque:g} N m"
            )
        return self


class RatingOptions(Table):
    r"""How a worm gearset is to be rated.

    Parameters
    ----------
    iso14521_edition : {'1998', '2010'}
        Family of formulas.
    base_friction : float, optional
        In place of :math:`\mu_{0T}`: the methods of the thesis's Table 3.3 act here.
    friction : float, optional
        In place of the mean tooth friction of every standard.
    friction_factor : float
        Multiplies the tooth friction of every standard: the way in for vibration.
    """

    table: ClassVar[str] = "rating"
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (("base_friction", "friction"),)

    iso14521_edition: Literal["1998", "2010"] = "2010"
    base_friction: (
        Annotated[
            float, Quantity("", what="a coefficient of friction", example="0.055", gt=0, lt=1)
        ]
        | None
    ) = None
    friction: (
        Annotated[float, Quantity("", what="a coefficient of friction", example="0.05", ge=0, lt=1)]
        | None
    ) = None
    friction_factor: Annotated[float, Quantity("", what="a factor", example="1.0", ge=0, le=10)] = (
        1.0
    )
