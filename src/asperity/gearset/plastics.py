"""Wheels of plastic: a table of what its owner found that it bears, which no standard covers."""

import itertools
import math
from collections.abc import Sequence
from typing import Annotated, Any, ClassVar

from pydantic import model_validator

from asperity.errors import InputError
from asperity.gearset.library import every, resolve
from asperity.gearset.materials import Material, WheelMaterial
from asperity.units import Quantity

_Celsius = Annotated[float, Quantity("K", what="a temperature", example="60 degC", gt=173, le=573)]
_Count = Annotated[float, Quantity("", what="a number of cycles", example="1e6", ge=1, le=1e12)]
_Stress = Annotated[float, Quantity("Pa", what="a stress", example="25 MPa", gt=0, le=1e10)]
_Stresses = tuple[tuple[_Stress, ...], ...]
_ZERO_CELSIUS = 273.15


class Plastic(Material):
    r"""A plastic of wheels, with its owner's own strength table.

    Stresses are nominal ones by the formulas of ISO/TR 14521 (shear at the root, mean pressure on
    the flank), which is what tests on gears are to be turned into.

    Parameters
    ----------
    friction : float
        Mean coefficient of friction of the teeth.
    temperatures : list of float or str
        Of the teeth, rising, K.
    cycles : list of float
        Of load on a tooth, rising.
    root : list of list of float or str, optional
        Shear stress that the root bears, Pa: a row for each temperature, a number for each number
        of cycles.
    flank : list of list of float or str, optional
        Mean pressure that the flank bears, likewise.
    wear_coefficient : float or str, optional
        Volume that is worn off by a load over a way, m^3/(N m).
    wear_depth : float or str, optional
        Depth that may be worn off a flank, m. Belongs to ``wear_coefficient``.
    """

    section: ClassVar[str] = "plastic"
    table: ClassVar[str] = "plastic"

    friction: Annotated[
        float, Quantity("", what="a coefficient of friction", example="0.12", gt=0, le=1)
    ]
    temperatures: tuple[_Celsius, ...]
    cycles: tuple[_Count, ...]
    root: _Stresses | None = None
    flank: _Stresses | None = None
    wear_coefficient: (
        Annotated[
            float,
            Quantity("m^3/(N*m)", what="a wear coefficient", example="1e-6 mm^3/(N*m)", gt=0,
                     le=1e-6),
        ]
        | None
    ) = None  # fmt: skip
    wear_depth: (
        Annotated[float, Quantity("m", what="a depth", example="0.3 mm", gt=0, le=0.1)] | None
    ) = None

    @model_validator(mode="after")
    def _complete(self) -> "Plastic":
        for key in ("temperatures", "cycles"):
            values = getattr(self, key)
            if not values or any(b <= a for a, b in itertools.pairwise(values)):
                raise InputError(f"plastic.{key} must be rising values, one at least")
        for key in ("root", "flank"):
            rows = getattr(self, key)
            if rows is not None and (
                len(rows) != len(self.temperatures)
                or any(len(row) != len(self.cycles) for row in rows)
            ):
                raise InputError(
                    f"plastic.{key} has rows of {', '.join(str(len(row)) for row in rows)} values; "
                    f"it must have {len(self.temperatures)}, one for each of temperatures, of "
                    f"{len(self.cycles)} values each, one for each of cycles"
                )
        if (self.wear_coefficient is None) != (self.wear_depth is None):
            raise InputError(
                "plastic.wear_coefficient and plastic.wear_depth belong together: give both or "
                "neither"
            )
        if self.root is None and self.flank is None and self.wear_depth is None:
            raise InputError(
                "plastic says nothing of strength; give root, flank, or wear_coefficient and "
                "wear_depth"
            )
        return self

    def bears(self, what: str, celsius: float, cycles: float) -> float | None:
        """Return the stress that ``root`` or ``flank`` bears, Pa; None where there is no table.

        Between temperatures it is straight, between numbers of cycles straight in their
        logarithms. Below the first number of cycles it is as at that.

        Parameters
        ----------
        what : {'root', 'flank'}
            Which.
        celsius : float
            Temperature of the teeth, degC.
        cycles : float
            Of load on a tooth.

        Returns
        -------
        float or None
            Pa.

        Raises
        ------
        InputError
            The table does not reach so far.
        """
        rows = self.root if what == "root" else self.flank
        if rows is None:
            return None
        kelvin, least = celsius + _ZERO_CELSIUS, self.temperatures[0]
        most = self.temperatures[-1]
        if not least - 1e-9 <= kelvin <= most + 1e-9:
            raise InputError(
                f"the teeth have {celsius:.4g} degC; plastic.{what} of {self.name!r} goes from "
                f"{least - _ZERO_CELSIUS:.4g} to {most - _ZERO_CELSIUS:.4g} degC: add to the table"
            )
        if cycles > self.cycles[-1] * (1.0 + 1e-9):
            raise InputError(
                f"a tooth has {cycles:.4g} cycles of load; plastic.{what} of {self.name!r} ends at "
                f"{self.cycles[-1]:.4g}: add to the table, or ask for a shorter life"
            )
        logs = [math.log(each) for each in self.cycles]
        at = math.log(max(cycles, self.cycles[0]))
        by_row = [math.exp(_between(at, logs, [math.log(v) for v in row])) for row in rows]
        return _between(kelvin, self.temperatures, by_row)

    def as_wheel(self) -> WheelMaterial:
        """Return the material of a wheel; its strengths are the least of the table, for lists."""
        held = {key: [v for row in getattr(self, key) or () for v in row] for key in _TABLES}
        some = min([*held["root"], *held["flank"], self.youngs_modulus])
        return WheelMaterial.model_validate(
            {
                "name": self.name,
                "family": "plastic",
                "youngs_modulus": self.youngs_modulus,
                "poisson_ratio": self.poisson_ratio,
                "material_factor": 1.0,
                "pitting_strength": min(held["flank"], default=some),
                "shear_strength": min(held["root"], default=some),
                "own": self,
                "sources": self.sources,
            }
        )


_TABLES = "root", "flank"


def _between(at: float, places: Sequence[float], values: Sequence[float]) -> float:
    for (x0, x1), (y0, y1) in zip(
        itertools.pairwise(places), itertools.pairwise(values), strict=True
    ):
        if at <= x1:
            return y0 + (y1 - y0) * (at - x0) / (x1 - x0)
    return values[-1]


def wheel_material(value: object, context: Any = None) -> WheelMaterial:
    """Return what a name, a plastic's name, or an inline table of a case stands for."""
    if isinstance(value, str):
        plastic = next((one for one in every(Plastic) if one.name == value), None)
        if plastic is not None:
            return plastic.as_wheel()
    return resolve(WheelMaterial, value, context)
