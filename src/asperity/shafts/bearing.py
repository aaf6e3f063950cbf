"""A rolling bearing of a data file: its size, its ratings and what its table says of it."""

import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal

from pydantic import ValidationInfo, model_validator

from asperity.errors import InputError, choices, shown
from asperity.formulas.traced import number
from asperity.gearset.library import Sourced
from asperity.shafts.dimensions import DIMENSIONS
from asperity.shafts.rolling import equivalent
from asperity.shafts.rolling.equivalent import Factors
from asperity.shafts.rolling.life import EXPONENT, Kind, fatigue_load_limit
from asperity.units import Quantity, to_si

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
    bore : float or str
        :math:`d`, m.
    series : {'10', '02', '03'}, optional
        Dimension series of ISO 15, of which diameter and width follow by the bore: 60, 62 and 63 of
        deep groove, 70, 72 and 73 of angular contact bearings.
    outside_diameter : float or str, optional
        :math:`D`, m; of its mean with the bore the oil film is judged. Left out: by the series.
    width : float or str, optional
        :math:`B`, m, which is drawn. Left out: by the series.
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
    series: Literal["10", "02", "03"] | None = None
    # Which are never missing: see _of_series.
    outside_diameter: _Length = None  # type: ignore[assignment]
    width: _Length = None  # type: ignore[assignment]
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

    @model_validator(mode="before")
    @classmethod
    def _of_series(cls, data: Any, info: ValidationInfo[Any]) -> Any:
        if not isinstance(data, Mapping):
            return data
        lacking = [key for key in ("outside_diameter", "width") if data.get(key) is None]
        if not lacking:
            return data
        series, bore = data.get("series"), data.get("bore")
        if series is None:
            raise InputError(f"{cls.table}.{lacking[0]} is missing; give it, or {cls.table}.series")
        if series not in DIMENSIONS or not isinstance(bore, str | float | int):
            return {
                key: value for key, value in data.items() if key not in lacking
            } | dict.fromkeys(lacking, "1 mm")
        size = _millimetres(bore)
        known = DIMENSIONS[series]
        if size not in known:
            bores = ", ".join(f"{each:g}" for each in known)
            raise InputError(
                f"{cls.table}.bore is {shown(bore)}; the dimensions of series {series} are known "
                f"for {bores} mm: give {' and '.join(lacking)}"
            )
        found = dict(zip(("outside_diameter", "width"), known[size], strict=True))
        return {**data, **{key: f"{found[key]:g} mm" for key in lacking}}

    @model_validator(mode="after")
    def _complete(self) -> "RollingBearing":
        for key in _NEEDED[self.kind]:
            if getattr(self, key) is None:
                raise InputError(
                    f"{self.table}.{key} is missing; a {self.kind} bearing needs it, as its "
                    "maker's table has it"
                )
        for key in dict.fromkeys(key for keys in _NEEDED.values() for key in keys):
            if key not in _NEEDED[self.kind] and getattr(self, key) is not None:
                raise InputError(
                    f"{self.table}.{key} is given, which does not count with kind = "
                    f"'{self.kind}': leave it out, or give another kind"
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
    def endless_below(self) -> Any:
        """C_u, N."""
        if self.fatigue_limit is not None:
            return self.fatigue_limit
        return number(fatigue_load_limit(self.static_rating, self.elements))

    @property
    def carries_axial(self) -> bool:
        """Whether it takes a load along the shaft at all."""
        return self.kind != "cylindrical"

    def ratings(self, *, pair: bool) -> tuple[float, float]:
        """Return C and C_0 of one bearing or of two side by side, N.

        Parameters
        ----------
        pair : bool
            Whether two stand side by side.

        Returns
        -------
        dynamic, static : float
            C and C_0, N.
        """
        c, c0 = self.dynamic_rating, self.static_rating
        if not pair:
            return c, c0
        return equivalent.PAIR_C * c, equivalent.PAIR_C0 * c0

    def factors(self, axial: float, *, opposed: bool) -> Factors:
        """Return the factors of its equivalent loads under an axial load, N.

        A pair that is ``opposed`` stands back to back or face to face.

        Parameters
        ----------
        axial : float
            Axial load, N, on which those of a deep groove ball bearing depend.
        opposed : bool
            Whether a pair stands back to back or face to face.

        Returns
        -------
        Factors
            e, X and Y, X_0 and Y_0.
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

    def induced(self, radial: Any) -> Any:
        """Return the axial force that it makes of its radial load, N; adjusted bearings only.

        Parameters
        ----------
        radial : array_like
            F_r, N.

        Returns
        -------
        float or ndarray, shape of ``radial``
            N.
        """
        if self.kind == "taper":
            return number(equivalent.induced_of_taper(radial, self.Y or 1.0))
        return equivalent.induced_of_angular(self.angle)(radial)


def _millimetres(bore: str | float) -> float:
    """Return a bore in mm; one that cannot be read is refused where it stands."""
    try:
        metres = to_si(bore, "m") if isinstance(bore, str) else float(bore)
    except InputError as error:
        raise InputError(f"bearing.bore is {shown(bore)}; {error}") from None
    return round(1e3 * metres, 6)
