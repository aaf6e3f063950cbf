"""The geometry of a worm gearset, in millimetres and radians as rating and flanks use them."""

import dataclasses
import math
from typing import Any, Literal

from asperity.arrays import Real
from asperity.errors import InputError, one_of
from asperity.gearset import relations
from asperity.gearset.proportions import RULES, Heights

Flank = Literal["ZI", "ZA", "ZN", "ZK", "ZC"]
Rule = Literal["bs721", "iso"]


def _number(symbol: str, unit: str, meaning: str) -> Any:
    return dataclasses.field(metadata={"symbol": symbol, "unit": unit, "meaning": meaning})


@dataclasses.dataclass(frozen=True, kw_only=True, repr=False)
class Geometry:
    r"""What follows from the numbers that define a worm gearset.

    Lengths are in mm, angles in rad. :meth:`of` calculates it, :meth:`to_json` names the unit of
    each number. Diameters and heights of the wheel count from its mean diameter
    :math:`d_{m2} = 2a - d_{m1}`, which holds the profile shift.
    """

    starts: int = _number("z_1", "", "number of threads of the worm")
    wheel_teeth: int = _number("z_2", "", "number of teeth of the wheel")
    gear_ratio: float = _number("u", "", "gear ratio")
    centre_distance: float = _number("a", "mm", "centre distance")
    axial_module: float = _number("m_x1", "mm", "axial module")
    normal_module: float = _number("m_n", "mm", "normal module")
    diameter_factor: float = _number("q_1", "", "diameter factor")
    profile_shift: float = _number("x_2", "", "profile shift factor of the wheel")
    lead_angle: float = _number("gamma_m1", "rad", "lead angle")
    pressure_angle: float = _number("alpha_n", "rad", "normal pressure angle")
    axial_pressure_angle: float = _number("alpha_x", "rad", "pressure angle, axial section")
    transverse_pressure_angle: float = _number(
        "alpha_t", "rad", "pressure angle, transverse section of the worm"
    )
    base_radius: float | None = _number("r_b1", "mm", "base radius of the worm (ZI)")
    base_lead_angle: float | None = _number("gamma_b", "rad", "base lead angle (ZI)")
    reduced_lead: float = _number("p", "mm/rad", "reduced lead")
    lead: float = _number("p_z1", "mm", "lead")
    axial_pitch: float = _number("p_x", "mm", "axial pitch")
    normal_pitch: float = _number("p_n", "mm", "normal pitch")
    worm_pitch_diameter: float = _number("d_m1", "mm", "reference diameter of the worm")
    worm_tip_diameter: float = _number("d_a1", "mm", "tip diameter of the worm")
    worm_root_diameter: float = _number("d_f1", "mm", "root diameter of the worm")
    wheel_reference_diameter: float = _number("d_2", "mm", "reference diameter of the wheel")
    wheel_mean_diameter: float = _number("d_m2", "mm", "mean diameter of the wheel")
    wheel_throat_diameter: float = _number("d_a2", "mm", "throat (tip) diameter of the wheel")
    wheel_root_diameter: float = _number("d_f2", "mm", "root diameter of the wheel")
    wheel_outside_diameter: float = _number("d_e2", "mm", "outside diameter of the wheel")
    wheel_throat_radius: float = _number("r_k", "mm", "throat form radius of the wheel")
    worm_addendum: float = _number("h_a1", "mm", "addendum of the worm")
    worm_dedendum: float = _number("h_f1", "mm", "dedendum of the worm")
    wheel_addendum: float = _number("h_a2", "mm", "addendum of the wheel")
    wheel_dedendum: float = _number("h_f2", "mm", "dedendum of the wheel")
    clearance: float = _number("c", "mm", "clearance between tip and root")
    worm_face_width: float = _number("b_1", "mm", "length of the threaded worm")
    wheel_face_width: float = _number("b_2", "mm", "face width of the wheel")
    effective_face_width: float = _number("b_2H", "mm", "face width that carries")
    rim_width: float = _number("b_2R", "mm", "width of the wheel's rim")
    rim_thickness: float = _number("s_K", "mm", "thickness of the rim under the teeth")

    @classmethod
    def of(
        cls,
        *,
        starts: int,
        wheel_teeth: int,
        axial_module: float,
        diameter_factor: float,
        profile_shift: float = 0.0,
        pressure_angle: float = math.radians(20.0),
        flank: Flank = "ZI",
        tooth_proportions: Rule = "bs721",
        worm_face_width: float | None = None,
        wheel_face_width: float | None = None,
        rim_thickness: float | None = None,
    ) -> "Geometry":
        r"""Calculate the geometry from the numbers that define it.

        Parameters
        ----------
        starts, wheel_teeth : int
            :math:`z_1`, :math:`z_2`.
        axial_module : float
            :math:`m_{x1}`, mm.
        diameter_factor, profile_shift : float
            :math:`q_1`, :math:`x_2`.
        pressure_angle : float
            :math:`\alpha_n`, normal pressure angle, rad.
        flank : {'ZI', 'ZA', 'ZN', 'ZK', 'ZC'}
            Type of the worm's flank; ZI alone has a base cylinder.
        tooth_proportions : {'bs721', 'iso'}
            Rule of the tooth heights, see `asperity.gearset.proportions`.
        worm_face_width : float, optional
            mm. Left out: all the length that the wheel can touch.
        wheel_face_width : float, optional
            :math:`b_2`, mm. Left out: :math:`2 m_{x1} \sqrt{q_1 + 1}`, which is also the most
            that carries, whatever the wheel's width.
        rim_thickness : float, optional
            mm. Left out: :math:`2 m_{x1}`, from where ISO/TR 14521 counts the rim as rigid.

        Returns
        -------
        Geometry
            Lengths in mm, angles in rad.

        Raises
        ------
        InputError
            The teeth or the cores vanish.

        Notes
        -----
        The outside diameter is :math:`d_{e2} = d_{a2} + m_{x1}` (MITCalc, SDP/SI) in both rules.
        """
        if tooth_proportions not in RULES:
            raise InputError(
                f"tooth_proportions is {tooth_proportions!r}; {one_of(RULES, tooth_proportions)}"
            )
        m, q = float(axial_module), float(diameter_factor)
        gamma = relations.lead_angle(starts, q)
        heights = RULES[tooth_proportions](m, gamma)
        p = relations.reduced_lead(m, starts)
        a = relations.centre_distance(m, q, wheel_teeth, profile_shift)
        d = diameters(m, q, wheel_teeth, a, heights)
        roots = d["worm_root_diameter"], d["wheel_root_diameter"]
        _possible(gamma, q, wheel_teeth, *roots, heights.wheel_addendum)
        d_a2 = d["wheel_throat_diameter"]
        d_e2 = d_a2 + m
        widest = relations.widest_contact(m, q)
        b_2 = widest if wheel_face_width is None else float(wheel_face_width)
        if worm_face_width is None:
            worm_face_width = relations.worm_reach(d_e2, a, d["worm_tip_diameter"])
        gamma_b = relations.base_lead_angle(pressure_angle, gamma) if flank == "ZI" else None
        return cls(
            starts=int(starts),
            wheel_teeth=int(wheel_teeth),
            gear_ratio=relations.gear_ratio(starts, wheel_teeth),
            centre_distance=a,
            axial_module=m,
            normal_module=relations.normal_module(m, gamma),
            diameter_factor=q,
            profile_shift=float(profile_shift),
            lead_angle=gamma,
            pressure_angle=float(pressure_angle),
            axial_pressure_angle=relations.axial_pressure_angle(pressure_angle, gamma),
            transverse_pressure_angle=relations.transverse_pressure_angle(pressure_angle, gamma),
            base_radius=None if gamma_b is None else relations.base_radius(p, gamma_b),
            base_lead_angle=gamma_b,
            reduced_lead=p,
            lead=2.0 * math.pi * p,
            axial_pitch=math.pi * m,
            normal_pitch=math.pi * relations.normal_module(m, gamma),
            **d,
            wheel_outside_diameter=d_e2,
            wheel_throat_radius=a - d_a2 / 2.0,
            worm_addendum=heights.worm_addendum,
            worm_dedendum=heights.worm_dedendum,
            wheel_addendum=heights.wheel_addendum,
            wheel_dedendum=heights.wheel_dedendum,
            clearance=heights.clearance,
            worm_face_width=float(worm_face_width),
            wheel_face_width=b_2,
            effective_face_width=min(b_2, widest),
            rim_width=b_2,
            rim_thickness=2.0 * m if rim_thickness is None else float(rim_thickness),
        )

    def __repr__(self) -> str:
        macro = dataclasses.fields(self)[:8]
        shown = ", ".join(f"{field.name}={getattr(self, field.name):.6g}" for field in macro)
        return f"Geometry({shown}, ... {len(dataclasses.fields(self)) - len(macro)} more)"

    def to_json(self) -> dict[str, float | int | None]:
        """Return the numbers by name and unit, such as ``lead_angle_deg``; angles in degrees."""
        result: dict[str, float | int | None] = {}
        for field in dataclasses.fields(self):
            value, unit = getattr(self, field.name), field.metadata["unit"]
            if unit == "rad":
                value, unit = None if value is None else math.degrees(value), "deg"
            suffix = unit.replace("/", "_per_")
            result[f"{field.name}_{suffix}" if unit else field.name] = value
        return result


def diameters(
    axial_module: Real,
    diameter_factor: Real,
    wheel_teeth: Real,
    centre_distance: Real,
    heights: Heights,
) -> dict[str, Real]:
    """Return the diameters of worm and wheel by their names in `Geometry`; numbers or arrays."""
    d_m1 = relations.worm_pitch_diameter(axial_module, diameter_factor)
    d_m2 = relations.wheel_mean_diameter(centre_distance, d_m1)
    return {
        "worm_pitch_diameter": d_m1,
        "worm_tip_diameter": d_m1 + 2.0 * heights.worm_addendum,
        "worm_root_diameter": d_m1 - 2.0 * heights.worm_dedendum,
        "wheel_reference_diameter": relations.wheel_reference_diameter(axial_module, wheel_teeth),
        "wheel_mean_diameter": d_m2,
        "wheel_throat_diameter": d_m2 + 2.0 * heights.wheel_addendum,
        "wheel_root_diameter": d_m2 - 2.0 * heights.wheel_dedendum,
    }


def _possible(
    lead_angle: float, q: float, z2: int, worm_root: float, wheel_root: float, addendum: float
) -> None:
    if addendum <= 0.0:
        raise InputError(
            f"gearset.diameter_factor is {q:g}; the lead angle is {math.degrees(lead_angle):.1f} "
            "deg, and BS 721's wheel teeth vanish at 60 deg: take a larger one, fewer starts or "
            "gearset.tooth_proportions = 'iso'"
        )
    if worm_root <= 0.0:
        raise InputError(
            f"gearset.diameter_factor is {q:g}; the worm's root diameter is {worm_root:.4g} mm and "
            "must be positive: take a larger one"
        )
    if wheel_root <= 0.0:
        raise InputError(
            f"gearset.wheel_teeth is {z2}; the wheel's root diameter is {wheel_root:.4g} mm and "
            "must be positive: take more teeth or a larger profile shift"
        )
