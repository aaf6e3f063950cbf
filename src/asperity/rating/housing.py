"""The `[housing]` table: how the gearbox gets rid of its heat, and what was measured of it."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, ClassVar, Literal

from pydantic import model_validator

from asperity.casefile import Table
from asperity.errors import InputError
from asperity.rating.load_steps import Speed
from asperity.sources import Source
from asperity.units import Quantity

HEAT = {"iron": 460.0, "aluminium": 900.0, "bronze": 380.0, "oil": 1900.0}
"""Specific heat capacities, J/(kg K), from memory; iron stands for steel too."""


HEAT_SOURCE = Source("textbooks", "from memory", "heat capacities, typical")

Area = Annotated[float, Quantity("m**2", what="an area", example="0.4 m**2", gt=0, le=1e4)]
Transfer = Annotated[
    float,
    Quantity("W/m**2/K", what="a heat transfer", example="15 W/m**2/K", gt=0, le=1e4),
]
Loss = Annotated[float, Quantity("W", what="a power", example="30 W", ge=0)]
Mass = Annotated[float, Quantity("kg", what="a mass", example="12 kg", ge=0, le=1e6)]


class Housing(Table):
    """A gearbox's housing.

    Parameters
    ----------
    area : float or str, optional
        Surface that gives off heat, m2; by ``area_rule`` if left out.
    area_rule : {'half ribbed', 'well ribbed', 'AGMA minimum'}
        Rule of that surface, with a in mm: 20 (a/1000)^1.7 with half of its ribs, 9e-5 a^1.85 where
        it is well ribbed, or the least that AGMA 6034 asks for, 43.2 (a/25.4)^1.7 square inches.
    heat_transfer : float or str
        W/(m2 K): 11 to 13 in still air, 15 to 18 where it moves well, 20 to 30 blown upon; 15 if
        left out.
    at_rest : float or str, optional
        That while the worm stands, where a fan sits on its shaft.
    base : float
        What a bolted metal base adds to it, as a share: 0.25 to 0.30; 0 if left out.
    idle_loss, seal_loss : float or str, optional
        Measured loss without load and of the seals, W, in place of the formulas of ISO/TR 14521.
        Other speeds by (n/n_m)^(4/3) and n/n_m.
    measured_at : float or str, optional
        Speed of the worm at which they were measured, rad/s; that of the operation if left out.
    heat_capacity : float or str, optional
        J/K. Give this or the masses; without either no temperature below the steady one is known.
    iron, aluminium, bronze, oil : float or str, optional
        Masses, kg.
    """

    table: ClassVar[str] = "housing"

    area: Area | None = None
    area_rule: Literal["half ribbed", "well ribbed", "AGMA minimum"] = "half ribbed"
    heat_transfer: Transfer = 15.0
    at_rest: Transfer | None = None
    base: Annotated[float, Quantity("", what="a share", example="0.25", ge=0, le=1)] = 0.0
    idle_loss: Loss | None = None
    seal_loss: Loss | None = None
    measured_at: Speed | None = None
    heat_capacity: (
        Annotated[float, Quantity("J/K", what="a heat capacity", example="9500 J/K", gt=0)] | None
    ) = None
    iron: Mass | None = None
    aluminium: Mass | None = None
    bronze: Mass | None = None
    oil: Mass | None = None

    @model_validator(mode="after")
    def _one_capacity(self) -> "Housing":
        if self.area is not None and "area_rule" in self.model_fields_set:
            raise InputError(
                "housing.area and housing.area_rule are both given: give the area, or the rule "
                "that it follows from"
            )
        if self.measured_at is not None and self.idle_loss is None and self.seal_loss is None:
            raise InputError(
                "housing.measured_at is given without a loss that was measured there: give "
                "housing.idle_loss or housing.seal_loss, or leave it out"
            )
        given = [name for name in HEAT if getattr(self, name) is not None]
        if self.heat_capacity is not None and given:
            raise InputError(
                f"housing.heat_capacity and housing.{given[0]} are both given: give heat_capacity, "
                "or the masses that it follows from"
            )
        return self

    @property
    def capacity(self) -> float | None:
        """Heat capacity, J/K; None where nothing is known of it."""
        if self.heat_capacity is not None:
            return self.heat_capacity
        masses = {name: getattr(self, name) for name in HEAT}
        whole = sum(HEAT[name] * mass for name, mass in masses.items() if mass is not None)
        return whole or None

    @property
    def assumed(self) -> Mapping[str, str]:
        """Which keys were left out, and what was assumed for them."""
        left_out = {
            "area": "20 (a/1000)^1.7 m2, with half of the ribs",
            "heat_transfer": "15 W/(m2 K), of air that moves well",
        }
        named = self.model_fields_set
        return MappingProxyType(
            {key: said for key, said in left_out.items() if not named & {key, f"{key}_rule"}}
        )
