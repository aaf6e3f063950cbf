"""A rolling bearing of a data file: its size, its ratings and what its table says of it."""

import math
from typing import Annotated, ClassVar, Literal

from pydantic import model_validator

from asperity.errors import InputError, choices
from asperity.gearset.library import Sourced
from asperity.shafts.rolling import equivalent
from asperity.shafts.rolling.equivalent import Factors
from asperity.shafts.rolling.life import EXPONENT, Kind, fatigue_load_limit
from asperity.units import Quantity

_Length = Annotated[float, Quantity("m", what="a length", example="40 mm", gt=0, le=10)]
_Force = Annotated[float, Quantity("N", what="a force", example="36 kN", gt=0, le=1e9)]
_Factor = Annotated[float, Quantity("", what="a factor", example="1.6", gt=0, le=100)]
_NEEDED = {
    "deep groove": ("f0",),
    "angular contact": ("contact_angle",),
    "four-point": (),
    "taper": ("e", "Y", "Y0"),
    "cylindrical": (),
}


class RollingBearing(Sourced):
    r"""A rolling bearing.

    Parameters
    ----------
    name : str
        As it appears in results.
    kind : {'deep groove', 'angular contact', 'four-point', 'taper', 'cylindrical'}
        Which formulas of equivalent loads are taken.
    bore, outside_diameter, width : float or str
        Boundary dimensions :math:`d`, :math:`D` and :math:`B`, m; drawn, and of the mean of the
        diameters the oil film is judged.
    dynamic_rating, static_rating : float or str
        :math:`C` and :math:`C_0` of one bearing, N, as its maker's table has them.
    fatigue_limit : float or str, optional
        :math:`C_u`, N. Left out: :math:`C_0/22` of balls, :math:`C_0/8.2` of rollers.
    contact_angle : float or str, optional
        Of an angular contact bearing: 25, 30 or 40 deg.
    f0 : float, optional
        Factor :math:`f_0` of a deep groove bearing.
    e, Y, Y0 : float, optional
        Of a taper roller bearing.
    sources : mapping of str to Source
        Where each value comes from, by key.
    """

    table: ClassVar[str] = "bearing"
    section: ClassVar[str] = "bearing"

    kind: Literal["deep groove", "angular contact", "four-point", "taper", "cylindrical"]
    bore: _Length
    outside_diameter: _Length
    width: _Length
    dynamic_rating: _Force
    static_rating: _Force
    fatigue_limit: _Force | None = None
    contact_angle: (
        Annotated[float, Quantity("rad", what="an angle", example="40 deg", gt=0, lt=1.6)] | None
    ) = None
    f0: _Factor | None = None
    e: _Factor | None = None
    Y: _Factor | None = None
    Y0: _Factor | None = None

    @model_validator(mode="after")
    def _complete(self) -> "RollingBearing":
        for key in _NEEDED[self.kind]:
            if getattr(self, key) is None:
                raise InputError(
                    f"{self.table}.{key} is missing; a {self.kind} bearing needs it, as its "
                    "maker's table has it"
                )
        if self.outside_diameter <= self.bore:
            raise InputError(
                f"{self.table}.outside_diameter is {1e3 * self.outside_diameter:g} mm; it must be "
                f"above bore, {1e3 * self.bore:g} mm"
            )
        if self.kind == "angular contact" and self.angle not in equivalent.ANGLES:
            known = choices([f"{each:g} deg" for each in equivalent.ANGLES])
            raise InputError(
                f"{self.table}.contact_angle is {self.angle:g} deg; factors are known for {known}"
            )
        return self

    @property
    def angle(self) -> float:
        """Contact angle, degrees."""
        return round(math.degrees(self.contact_angle or 0.0), 6)

    @property
    def elements(self) -> Kind:
        """Whether it rolls on balls or on rollers."""
        return "roller" if self.kind in ("taper", "cylindrical") else "ball"

    @property
    def exponent(self) -> float:
        """Of load in life."""
        return EXPONENT[self.elements]

    @property
    def pitch_diameter(self) -> float:
        """Mean of bore and outside diameter, mm."""
        return 500.0 * (self.bore + self.outside_diameter)

    @property
    def endless_below(self) -> float:
        """C_u, N."""
        if self.fatigue_limit is not None:
            return self.fatigue_limit
        return float(fatigue_load_limit(self.static_rating, self.elements))

    @property
    def carries_axial(self) -> bool:
        """Whether it takes a load along the shaft at all."""
        return self.kind != "cylindrical"

    def ratings(self, *, pair: bool) -> tuple[float, float]:
        """Return C and C_0 of one bearing or of two side by side, N."""
        c, c0 = self.dynamic_rating, self.static_rating
        if not pair:
            return c, c0
        return equivalent.PAIR_C * c, equivalent.PAIR_C0 * c0

    def factors(self, axial: float, *, opposed: bool) -> Factors:
        """Return the factors of its equivalent loads under an axial load, N.

        A pair that is ``opposed`` stands back to back or face to face.
        """
        if self.kind == "deep groove":
            return equivalent.deep_groove(self.f0 or 1.0, axial, self.static_rating)
        if self.kind == "angular contact":
            return equivalent.angular(self.angle, pair=opposed)
        if self.kind == "four-point":
            return equivalent.FOUR_POINT
        if self.kind == "taper":
            return equivalent.taper(self.e or 1.0, self.Y or 1.0, self.Y0 or 1.0)
        return equivalent.CYLINDRICAL

    def induced(self, radial: float) -> float:
        """Return the axial force that it makes of its radial load, N; adjusted bearings only."""
        if self.kind == "taper":
            return float(equivalent.induced_of_taper(radial, self.Y or 1.0))
        return equivalent.induced_of_angular(self.angle)(radial)
