"""The `[gearset]` table: the numbers that define a worm gearset, and what follows from them."""

import functools
import math
from collections.abc import Mapping
from types import MappingProxyType
from typing import Annotated, Any, ClassVar, Literal, Self

from pydantic import BeforeValidator, Field, ValidationInfo, model_validator

from asperity.casefile import Table
from asperity.errors import InputError
from asperity.gearset.geometry import Flank, Geometry, Rule
from asperity.gearset.macro import LARGEST_SHIFT, complete
from asperity.gearset.materials import WheelMaterial, WormMaterial, worm_material
from asperity.gearset.plastics import wheel_material
from asperity.gearset.relations import centre_distance
from asperity.units import Quantity

_MILLIMETRES = 1e3

_ASSUMED = {
    "pressure_angle": "20 deg, the guideline of BS 721",
    "flank": "ZI, the flank of BS 721",
    "hand": "right",
    "worm_roughness": "0.5 um, where the roughness factor of ISO/TR 14521 is 1",
    "tooth_proportions": "bs721",
    "wheel_face_width": "2 m sqrt(q + 1), all that the worm can reach",
    "worm_face_width": "all the length that the wheel can touch",
    "rim_thickness": "2 m, from where ISO/TR 14521 counts the rim as rigid",
}


def _whole(value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int | float) or value != value // 1:
        raise InputError("it must be a whole number")
    return int(value)


def _millimetres(length: float | None) -> float | None:
    # To 15 digits, so that "74.93 mm" comes back as 74.93 from metres.
    return None if length is None else float(f"{length * _MILLIMETRES:.15g}")


def _count(least: int) -> Any:
    def check(value: int) -> int:
        if value < least:
            raise InputError(f"it must be at least {least}")
        return value

    written = Annotated[int, Field(ge=least)]
    return BeforeValidator(lambda value: check(_whole(value)), json_schema_input_type=written)


def _length(example: str) -> Quantity:
    return Quantity("m", what="a length", example=example, gt=0)


Length = Annotated[float, _length("13.3 mm")]


class Gearset(Table):
    r"""A worm gearset.

    Of ``centre_distance``, ``axial_module``, ``diameter_factor`` (or ``worm_pitch_diameter``) and
    ``profile_shift`` any three define it, or any two of the first three with the profile shift
    assumed zero. All four must agree within half a thousandth of the centre distance; the profile
    shift is then calculated from the others.

    A profile shift that follows from the others may have any size, because the thesis varies ratio
    and module at a fixed centre distance (3.2.3). Outside -1 to 1 it is no gearset that could be
    made: call `require_consistent` before using it for anything but such a study.

    Parameters
    ----------
    name : str
        As it appears in results.
    starts : int
        Number of threads of the worm :math:`z_1`.
    wheel_teeth : int
        Number of teeth of the wheel :math:`z_2`.
    centre_distance : float or str, optional
        Centre distance :math:`a`, m.
    axial_module : float or str, optional
        Axial module :math:`m_{x1}`, m.
    diameter_factor : float, optional
        Diameter factor :math:`q_1 = d_{m1}/m_{x1}`. Give this or ``worm_pitch_diameter``.
    worm_pitch_diameter : float or str, optional
        Reference diameter of the worm :math:`d_{m1}`, m.
    profile_shift : float, optional
        Profile shift of the wheel :math:`x_2`.
    pressure_angle : float or str
        Normal pressure angle :math:`\alpha_n`, rad; 20 deg if left out.
    flank : {'ZI', 'ZA', 'ZN', 'ZK', 'ZC'}
        Type of the worm's flank: involute, straight in the axial section, straight in the normal
        section, cone or torus ground; ISO's A, I, N, K and C.
    hand : {'right', 'left'}
        Hand of the worm's thread.
    worm_roughness : float or str
        Mean roughness of the worm's flanks :math:`Ra_1`, m; 0.5 um if left out.
    worm_material, wheel_material : str or table
        A name that ``asperity materials`` lists, or a table with its keys; for the worm a steel's
        name or number as well.
    worm_face_width : float or str, optional
        Length of the threaded worm :math:`b_1`, m. Left out: all that the wheel can touch.
    wheel_face_width : float or str, optional
        Face width of the wheel :math:`b_2`, m. Left out: :math:`2 m_{x1} \sqrt{q_1 + 1}`.
    rim_thickness : float or str, optional
        Thickness of the wheel's rim :math:`s_K`, m. Left out: :math:`2 m_{x1}`.
    tooth_proportions : {'bs721', 'iso'}
        Rule of the tooth heights.
    """

    table: ClassVar[str] = "gearset"
    alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("diameter_factor", "worm_pitch_diameter"),
    )

    name: str = ""
    starts: Annotated[int, _count(1)]
    wheel_teeth: Annotated[int, _count(3)]
    centre_distance: Annotated[float, _length("75 mm")] | None = None
    axial_module: Annotated[float, _length("2.2 mm")] | None = None
    diameter_factor: Annotated[float, Quantity("", what="a factor", example="8.2", gt=0)] | None = (
        None
    )
    worm_pitch_diameter: Annotated[float, _length("18 mm")] | None = None
    profile_shift: (
        Annotated[
            float,
            Quantity("", what="a factor", example="0.02", ge=-LARGEST_SHIFT, le=LARGEST_SHIFT),
        ]
        | None
    ) = None
    pressure_angle: Annotated[
        float,
        Quantity("rad", what="an angle", example="20 deg", gt=0, lt=math.pi / 4),
    ] = math.radians(20.0)
    flank: Flank = "ZI"
    hand: Literal["right", "left"] = "right"
    worm_roughness: Annotated[
        float, Quantity("m", what="a roughness", example="1.6 um", gt=0, le=1e-4)
    ] = 0.5e-6
    worm_material: WormMaterial
    wheel_material: WheelMaterial
    worm_face_width: Length | None = None
    wheel_face_width: Length | None = None
    rim_thickness: Length | None = None
    tooth_proportions: Rule = "bs721"

    @model_validator(mode="before")
    @classmethod
    def _materials(cls, data: Any, info: ValidationInfo[Any]) -> Any:
        if not isinstance(data, Mapping):
            return data
        named = dict(data)
        if "worm_material" in named:
            named["worm_material"] = worm_material(named["worm_material"], info.context)
        if "wheel_material" in named:
            named["wheel_material"] = wheel_material(named["wheel_material"], info.context)
        return named

    @model_validator(mode="after")
    def _possible(self) -> Self:
        # The geometry refuses numbers that make no gearset, so that none is ever held.
        _ = self.geometry
        return self

    @functools.cached_property
    def geometry(self) -> Geometry:
        """What follows from the numbers, in mm and rad."""
        macro = complete(
            self.wheel_teeth,
            centre_distance=_millimetres(self.centre_distance),
            axial_module=_millimetres(self.axial_module),
            diameter_factor=self.diameter_factor,
            worm_pitch_diameter=_millimetres(self.worm_pitch_diameter),
            profile_shift=self.profile_shift,
        )
        return Geometry.of(
            starts=self.starts,
            wheel_teeth=self.wheel_teeth,
            **macro._asdict(),
            pressure_angle=self.pressure_angle,
            flank=self.flank,
            tooth_proportions=self.tooth_proportions,
            worm_face_width=_millimetres(self.worm_face_width),
            wheel_face_width=_millimetres(self.wheel_face_width),
            rim_thickness=_millimetres(self.rim_thickness),
        )

    def require_consistent(self) -> Self:
        """Return the gearset; raises InputError if its numbers do not belong together."""
        g = self.geometry
        if abs(g.profile_shift) > LARGEST_SHIFT:
            without = centre_distance(g.axial_module, g.diameter_factor, g.wheel_teeth)
            raise InputError(
                f"gearset.centre_distance is {g.centre_distance:g} mm; with {g.wheel_teeth} teeth, "
                f"an axial module of {g.axial_module:g} mm and a diameter factor of "
                f"{g.diameter_factor:g} the profile shift is {g.profile_shift:.3g}, and it must "
                f"lie within -{LARGEST_SHIFT:g} and {LARGEST_SHIFT:g}: these give {without:.6g} mm "
                "without one"
            )
        return self

    @property
    def hand_sign(self) -> int:
        """1 for a right-handed worm, -1 for a left-handed one."""
        return 1 if self.hand == "right" else -1

    @property
    def assumed(self) -> Mapping[str, str]:
        """Which keys were left out, and what was assumed for them."""
        left_out = {
            key: reason for key, reason in _ASSUMED.items() if key not in self.model_fields_set
        }
        if self.profile_shift is None and None in (
            self.centre_distance,
            self.axial_module,
            self._worm_size,
        ):
            left_out["profile_shift"] = "0"
        return MappingProxyType(left_out)

    @property
    def _worm_size(self) -> float | None:
        given = (self.diameter_factor, self.worm_pitch_diameter)
        return next((value for value in given if value is not None), None)
