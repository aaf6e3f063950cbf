r"""Worm and hob as helicoid solids with rounded tips.

In the frame of a right-handed helicoid (axis :math:`z`) the middle of a thread space is
:math:`\zeta = p\,\theta`; its flanks are :math:`\zeta = s\,w(\rho) + p\,\theta`, :math:`s = \pm 1`,
and the material lies beyond them. Lengths are in mm, angles in rad.
"""

import dataclasses
import functools
import math

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.parameters import HOB_TIP_RADIUS, Disc, Hob, Modification, size_in_mm
from asperity.flanks.worm import curve
from asperity.flanks.worm.profiles import AxialProfile
from asperity.flanks.worm.types import profile
from asperity.gearset.geometry import Flank, Geometry

_MILLIMETRES = 1e3
_LEAST_LAND = 0.01
_LEAST_SPACE = 0.02
# Of the root's radius: far enough below it to be no neighbour of the wheel.
_DEEP = 0.5


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Helicoid:
    r"""A worm, or the worm that a hob is.

    Attributes
    ----------
    starts : int
        :math:`z_1`.
    reduced_lead : float
        :math:`p`, mm/rad, positive: a left-handed one is computed as its mirror image.
    pitch_radius, tip_radius, root_radius : float
        :math:`r_1`, :math:`r_{a1}`, :math:`r_{f1}`, mm. The root is higher than the gearset's
        where the thread space would close above that.
    tip_rounding : float
        Radius of the arc between flank and tip land in the axial section, mm.
    profile : AxialProfile
        Shape of the flank.
    half_space : float
        :math:`w_{ref}`, half the axial width of the thread space at the pitch radius, mm.
    lead_angle, pressure_angle : float
        :math:`\gamma` at the pitch radius, :math:`\alpha_n`.
    tip_relief : float
        What is missing at the tip, axially, mm.
    relief_radius : float, optional
        Where the tip relief begins, mm.
    name : str
        ``worm`` or ``hob``, as it appears in messages.
    """

    starts: int
    reduced_lead: float
    pitch_radius: float
    tip_radius: float
    root_radius: float
    tip_rounding: float
    profile: AxialProfile
    half_space: float
    lead_angle: float
    pressure_angle: float
    tip_relief: float = 0.0
    relief_radius: float | None = None
    name: str = "worm"

    def __post_init__(self) -> None:
        # What cannot be a solid is refused before anything is cut with it.
        _ = self.params

    @classmethod
    def worm(
        cls,
        geometry: Geometry,
        flank: Flank,
        modification: Modification | None = None,
        half_space: float | None = None,
        disc: Disc | None = None,
    ) -> "Helicoid":
        r"""Return the worm of a gearset.

        Parameters
        ----------
        geometry : Geometry
            The gearset.
        flank : {'ZI', 'ZA', 'ZN', 'ZK', 'ZC'}
            Type of the flank.
        modification : Modification, optional
            Deviation from that type.
        half_space : float, optional
            :math:`w_{ref}`, mm; :math:`\pi m_{x1}/4` if left out.
        disc : Disc, optional
            What grinds ZK and ZC.

        Raises
        ------
        InputError
            The thread is pointed, or the disc cannot grind it.
        """
        given = modification or Modification()
        r = geometry.worm_pitch_diameter / 2.0
        gamma = geometry.lead_angle + given.lead_correction
        if not 0.0 < gamma < math.pi / 2.0:
            raise InputError(
                f"modification.lead_correction is {math.degrees(given.lead_correction):g} deg; "
                f"the worm's lead angle is {math.degrees(geometry.lead_angle):.4g} deg, and both "
                "together must lie between 0 and 90 deg"
            )
        tip = geometry.worm_tip_diameter / 2.0
        root = geometry.worm_root_diameter / 2.0
        start = r + given.tip_relief_start * (tip - r)
        normal = math.cos(gamma) * math.cos(geometry.pressure_angle)
        module = geometry.axial_module
        nominal = math.pi * module / 4.0
        shape = profile(
            flank,
            pitch_radius=r,
            lead_angle=gamma,
            pressure_angle=geometry.pressure_angle,
            half_space=nominal,
            reach=(root, r - geometry.wheel_addendum, tip),
            module=module,
            disc=disc,
        )
        draft = cls(
            starts=geometry.starts,
            reduced_lead=r * math.tan(gamma),
            pitch_radius=r,
            tip_radius=tip,
            root_radius=root,
            tip_rounding=0.0,
            profile=shape,
            half_space=nominal if half_space is None else half_space,
            lead_angle=gamma,
            pressure_angle=geometry.pressure_angle,
            tip_relief=given.tip_relief * _MILLIMETRES / normal,
            relief_radius=start if given.tip_relief else None,
        )
        draft = _opened(draft, r - geometry.wheel_addendum)
        rounding = size_in_mm(given.tip_rounding, module)
        most = draft.largest_rounding()
        if "tip_rounding" in given.model_fields_set and rounding > most:
            raise InputError(_too_round("modification.tip_rounding", rounding, most))
        return dataclasses.replace(draft, tip_rounding=min(rounding, most))

    @classmethod
    def hob(
        cls, geometry: Geometry, flank: Flank, hob: Hob | None = None, disc: Disc | None = None
    ) -> "Helicoid":
        r"""Return the hob that cuts the wheel of a gearset.

        Its pitch radius is that of the worm times the oversize. With the normal module of the worm
        its lead angle is :math:`\sin\gamma_0 = z_1 m_n/(2 r_0)`, with the axial module
        :math:`\tan\gamma_0 = z_1 m_{x1}/(2 r_0)`. Its tip reaches the wheel's root, its root has
        the depth of the worm's, and its threads are as thick as its spaces.

        Parameters
        ----------
        geometry : Geometry
            The gearset.
        flank : {'ZI', 'ZA', 'ZN', 'ZK', 'ZC'}
            Type of the flank.
        hob : Hob, optional
            Oversize, rule and tip; the worm's own size if left out.
        disc : Disc, optional
            What grinds ZK and ZC.

        Raises
        ------
        InputError
            The thread is pointed, the tip's rounding has no room, or the disc cannot grind it.
        """
        given = hob or Hob()
        r = given.oversize * geometry.worm_pitch_diameter / 2.0
        if given.oversize == 1.0:
            gamma = geometry.lead_angle
        elif given.rule == "normal-module":
            gamma = math.asin(geometry.starts * geometry.normal_module / (2.0 * r))
        else:
            gamma = math.atan(geometry.starts * geometry.axial_module / (2.0 * r))
        p = r * math.tan(gamma)
        half_space = math.pi * p / (2.0 * geometry.starts)
        tip = r + geometry.wheel_dedendum
        root = r - geometry.worm_dedendum
        module = geometry.axial_module
        draft = cls(
            starts=geometry.starts,
            reduced_lead=p,
            pitch_radius=r,
            tip_radius=tip,
            root_radius=root,
            tip_rounding=0.0,
            profile=profile(
                flank,
                pitch_radius=r,
                lead_angle=gamma,
                pressure_angle=geometry.pressure_angle,
                half_space=half_space,
                reach=(root, r - geometry.wheel_addendum, tip),
                module=module,
                disc=disc,
            ),
            half_space=half_space,
            lead_angle=gamma,
            pressure_angle=geometry.pressure_angle,
            name="hob",
        )
        draft = _opened(draft, r - geometry.wheel_addendum)
        most = draft.largest_rounding()
        if given.tip_radius is None:
            rounding = min(HOB_TIP_RADIUS * module, most)
        else:
            rounding = size_in_mm(given.tip_radius, module)
            if rounding > most:
                raise InputError(_too_round("hob.tip_radius", rounding, most))
        return dataclasses.replace(draft, tip_rounding=rounding)

    @property
    def half_pitch(self) -> float:
        r"""Half the axial pitch, :math:`\pi p/z_1`, mm: where the middle of a thread is."""
        return math.pi * self.reduced_lead / self.starts

    @property
    def flank_end(self) -> float:
        """Radius where the flank goes over into the tip's rounding, mm."""
        return float(self.params[curve.FLANK_END])

    def with_half_space(self, half_space: float) -> "Helicoid":
        """Return the same flanks with threads of another thickness; ``half_space`` in mm."""
        return dataclasses.replace(self, half_space=half_space)

    @functools.cached_property
    def params(self) -> FloatArray:
        """The numbers that the compiled functions of `asperity.flanks.worm.curve` take."""
        r1, p = self.pitch_radius, self.reduced_lead
        base = self.profile.base_radius
        amount, start = self._relief()
        numbers = np.zeros(curve.PROFILE + self.profile.params.size)
        numbers[curve.LEAD] = p
        numbers[curve.HALF_PITCH] = self.half_pitch
        numbers[curve.SHIFT] = self.half_space - float(self.profile(r1))
        numbers[curve.ROOT] = self.root_radius
        numbers[curve.TIP] = self.tip_radius
        numbers[curve.ROUNDING] = self.tip_rounding
        numbers[curve.RELIEF_FROM] = start
        numbers[curve.RELIEF] = amount / (self.tip_radius - start) ** 3 if amount else 0.0
        numbers[curve.PROFILE :] = self.profile.params
        end, middle, angle = self._tip_arc(numbers, self.tip_rounding)
        if middle >= self.half_pitch:
            raise InputError(_pointed(self))
        numbers[curve.FLANK_END] = end
        numbers[curve.ARC_RADIUS] = self.tip_radius - self.tip_rounding
        numbers[curve.ARC_Z] = middle
        numbers[curve.ARC_ANGLE] = angle
        if base is not None:
            numbers[curve.BASE] = base
            numbers[curve.COS_BASE] = base / math.hypot(base, p)
            numbers[curve.SIN_BASE] = p / math.hypot(base, p)
            last = min(end, start)
            numbers[curve.CLOSED_TO] = math.sqrt(max(last * last - base * base, 0.0))
        return numbers

    def _relief(self) -> tuple[float, float]:
        if self.relief_radius is None or self.tip_relief == 0.0:
            return 0.0, math.inf
        return self.tip_relief, self.relief_radius

    def _tip_arc(self, numbers: FloatArray, r: float) -> tuple[float, float, float]:
        """Radius at the flank's end, axial place of the arc's centre, angle of the arc."""
        low, tip = self.tip_radius - r, self.tip_radius

        def above(rho: float) -> float:
            _, slope, _ = curve.width(rho, numbers)
            return float(rho - r * slope / math.hypot(1.0, slope) - low)

        end = tip if r == 0.0 else float(brentq(above, low, tip, xtol=1e-14, rtol=1e-15))
        w, slope, _ = curve.width(end, numbers)
        middle = w + r / math.hypot(1.0, slope)
        return end, float(middle), math.pi / 2.0 - math.atan(slope)

    def largest_rounding(self) -> float:
        """Return the largest rounding that the tip has room for, mm, leaving a little land."""
        limit = self.half_pitch * (1.0 - _LEAST_LAND)
        numbers = self.params

        def over(r: float) -> float:
            return self._tip_arc(numbers, r)[1] - limit

        if over(0.0) >= 0.0:
            raise InputError(_pointed(self))
        most = self.tip_radius - self.root_radius
        return most if over(most) <= 0.0 else float(brentq(over, 0.0, most, xtol=1e-12))

    def curve(self, u: npt.ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        r"""Return the generating curve of one side.

        Parameters
        ----------
        u : array_like
            0 to 1 flank, from the root to its end; to 2 the rounding of the tip; to 3 the tip
            land, to the middle of the thread.

        Returns
        -------
        tuple of ndarray
            :math:`\rho`, :math:`z` (mm) and their derivatives by ``u``, shaped as ``u``.
        """
        places = np.asarray(u, dtype=np.float64)
        out = np.empty((6, places.size))
        curve.curve_each(np.ascontiguousarray(places).reshape(-1), self.params, out)
        rho, z, drho, dz, _, _ = out.reshape(6, *places.shape)
        return rho, z, drho, dz

    def width(self, radius: npt.ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
        r"""Return :math:`w` (mm), :math:`w'` and :math:`w''` (1/mm) of the flank at radii in mm."""
        rho = np.asarray(radius, dtype=np.float64)
        out = np.empty((3, rho.size))
        curve.width_each(np.ascontiguousarray(rho).reshape(-1), self.params, out)
        w, w1, w2 = out.reshape(3, *rho.shape)
        return w, w1, w2

    def distance_params(self, side: int = 0, *, core: bool = True) -> FloatArray:
        """Return the numbers of `~asperity.flanks.worm.distance`.

        Parameters
        ----------
        side : {0, 1, -1}
            The flank of the thread space that counts; 0: the nearest.
        core : bool
            Whether the core counts too; else the flanks go on below the root.
        """
        numbers = self.params.copy()
        numbers[curve.SIDE] = side
        if not core:
            numbers[curve.ROOT] *= _DEEP
        return numbers


def _too_round(key: str, given: float, most: float) -> str:
    return (
        f"{key} is {given:.4g} mm; the tip has room for at most {most:.4g} mm: take a smaller one"
    )


def _pointed(helicoid: Helicoid) -> str:
    until = f"before its tip radius of {helicoid.tip_radius:.5g} mm"
    if helicoid.half_space > 0.5 * helicoid.half_pitch * (1.0 + 1e-9):
        return (
            f"mount.backlash: with thread spaces of {2.0 * helicoid.half_space:.4g} mm in a pitch "
            f"of {2.0 * helicoid.half_pitch:.4g} mm the {helicoid.name}'s thread is pointed "
            f"{until}: take less backlash"
        )
    return (
        f"gearset.pressure_angle is {math.degrees(helicoid.pressure_angle):.4g} deg; with it the "
        f"{helicoid.name}'s thread is pointed {until}: take a smaller pressure angle or lower teeth"
    )


def _opened(draft: Helicoid, needed: float) -> Helicoid:
    """Lift the root to where the thread space has some width, if it closes above it."""
    least = _LEAST_SPACE * draft.half_pitch

    def room(radius: float) -> float:
        return float(draft.width(radius)[0]) - least

    if room(draft.root_radius) >= 0.0:
        return draft
    if room(needed) <= 0.0:
        raise InputError(
            f"gearset.pressure_angle is {math.degrees(draft.pressure_angle):.4g} deg; with it the "
            f"{draft.name}'s thread spaces close before the wheel's tip, at a radius of "
            f"{needed:.5g} mm: take a smaller pressure angle or lower teeth"
        )
    root = float(brentq(room, draft.root_radius, needed, xtol=1e-12))
    return dataclasses.replace(draft, root_radius=root)
