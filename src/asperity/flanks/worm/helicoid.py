r"""Worm and hob as helicoid solids with rounded tips.

In the frame of a right-handed helicoid (axis :math:`z`) the middle of a thread space is
:math:`\zeta = p\,\theta`; its flanks are :math:`\zeta = s\,w(\rho) + p\,\theta`, :math:`s = \pm 1`,
and the material lies beyond them. Lengths are in mm, angles in rad.
"""

import dataclasses
import functools
import math
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.parameters import HOB_TIP_RADIUS, Disc, Hob, Modification, size_in_mm
from asperity.flanks.worm import curve
from asperity.flanks.worm.curve import FORM, Thread
from asperity.flanks.worm.profiles import AxialProfile, record, sampled
from asperity.flanks.worm.types import profile
from asperity.gearset.geometry import Flank, Geometry
from asperity.gearset.threads import LEAST_LAND, LEAST_SPACE
from asperity.gearset.wheel_blank import Blank
from asperity.roots import root_between

_MILLIMETRES = 1e3
# Of the root's radius: far enough below it to be no neighbour of the wheel.
_DEEP = 0.5
# Of the dedendum, at which root relief begins at the latest where a case does not say it.
_RELIEVED_FROM = 0.5


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Helicoid:
    r"""A worm, or the worm that a hob is, in mm and rad; its name is that in messages.

    Attributes
    ----------
    reduced_lead : float
        :math:`p`, mm/rad, positive: a left-handed one is computed as its mirror image.
    pitch_radius, tip_radius, root_radius : float
        :math:`r_1`, :math:`r_{a1}`, :math:`r_{f1}`. The root is higher than the gearset's where
        the thread space would close above that.
    tip_rounding : float
        Radius of the arc between flank and tip land in the axial section.
    half_space : float
        :math:`w_{ref}`, half the axial width of the thread space at the pitch radius.
    lead_angle, pressure_angle : float
        :math:`\gamma` at the pitch radius, :math:`\alpha_n`.
    tip_relief, relief_radius : float
        What is missing at the tip, axially, and where that begins; infinite where nothing is.
    root_relief, root_relief_radius, root_relief_end : float
        Likewise at the root, where that begins and where it ends; 0 where nothing is.
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
    relief_radius: float = math.inf
    root_relief: float = 0.0
    root_relief_radius: float = 0.0
    root_relief_end: float = 0.0
    name: str = "worm"

    def __post_init__(self) -> None:
        # What cannot be a solid is refused before anything is cut with it.
        _ = self.thread
        if self.root_relief:
            radii = np.linspace(self.root_relief_end, self.root_relief_radius, 65)
            if self.width(radii)[1].min() < 0.0:
                raise InputError(
                    "modification.root_relief undercuts the worm's threads near the root: take "
                    "less, or begin it nearer to the pitch radius (root_relief_start)"
                )

    @classmethod
    def worm(
        cls,
        geometry: Geometry,
        flank: Flank,
        modification: Modification | None = None,
        disc: Disc | None = None,
    ) -> "Helicoid":
        r"""Return the worm of a gearset; its thread spaces are :math:`\pi m_{x1}/2` wide.

        Raises
        ------
        InputError
            The thread is pointed, or the disc cannot grind it.
        """
        given = modification or Modification()
        r, tip = geometry.worm_pitch_diameter / 2.0, geometry.worm_tip_diameter / 2.0
        gamma = geometry.lead_angle + given.lead_correction
        if not 0.0 < gamma < math.pi / 2.0:
            raise InputError(
                f"modification.lead_correction is {math.degrees(given.lead_correction):g} deg; "
                f"the worm's lead angle is {math.degrees(geometry.lead_angle):.4g} deg, and both "
                "together must lie between 0 and 90 deg"
            )
        start = r + given.tip_relief_start * (tip - r)
        root = geometry.worm_root_diameter / 2.0
        axial = _MILLIMETRES / (math.cos(gamma) * math.cos(geometry.pressure_angle))
        draft = _draft(
            geometry,
            flank,
            disc,
            pitch_radius=r,
            tip_radius=tip,
            root_radius=root,
            half_space=math.pi * geometry.axial_module / 4.0,
            lead_angle=gamma,
            tip_relief=given.tip_relief * axial,
            relief_radius=start if given.tip_relief else math.inf,
            root_relief=given.root_relief * axial,
            root_relief_radius=_relieved_from(geometry, given) if given.root_relief else 0.0,
            root_relief_end=root,
        )
        asked = "tip_rounding" in given.model_fields_set
        rounding = size_in_mm(given.tip_rounding, geometry.axial_module)
        return _rounded(draft, rounding, "modification.tip_rounding" if asked else None)

    @classmethod
    def hob(
        cls, geometry: Geometry, flank: Flank, hob: Hob | None = None, disc: Disc | None = None
    ) -> "Helicoid":
        r"""Return the hob that cuts the wheel of a gearset.

        Its pitch radius is that of the worm times the oversize. With the normal module of the worm
        its lead angle is :math:`\sin\gamma_0 = z_1 m_n/(2 r_0)`, with the axial module
        :math:`\tan\gamma_0 = z_1 m_{x1}/(2 r_0)`. Its tip reaches the wheel's root, its root has
        the depth of the worm's, and its threads are as thick as its spaces.

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
        draft = _draft(
            geometry,
            flank,
            disc,
            pitch_radius=r,
            tip_radius=r + geometry.wheel_dedendum,
            root_radius=r - geometry.worm_dedendum,
            half_space=math.pi * (r * math.tan(gamma)) / (2.0 * geometry.starts),
            lead_angle=gamma,
            name="hob",
        )
        if given.tip_radius is None:
            return _rounded(draft, HOB_TIP_RADIUS * geometry.axial_module, None)
        rounding = size_in_mm(given.tip_radius, geometry.axial_module)
        return _rounded(draft, rounding, "hob.tip_radius")

    @property
    def half_pitch(self) -> float:
        r"""Half the axial pitch, :math:`\pi p/z_1`, mm: where the middle of a thread is."""
        return math.pi * self.reduced_lead / self.starts

    @property
    def flank_end(self) -> float:
        """Radius where the flank goes over into the tip's rounding, mm."""
        return float(self.thread.form["flank_end"])

    def with_half_space(self, half_space: float) -> "Helicoid":
        """Return the same flanks with threads of another thickness; ``half_space`` in mm."""
        return dataclasses.replace(self, half_space=half_space)

    @functools.cached_property
    def thread(self) -> Thread:
        """The helicoid as the compiled functions take it."""
        p, base = self.reduced_lead, self.profile.base_radius
        form = record(
            FORM,
            lead=p,
            half_pitch=self.half_pitch,
            shift=self.half_space - float(self.profile(self.pitch_radius)),
            root=self.root_radius,
            tip=self.tip_radius,
            rounding=self.tip_rounding,
            relief_from=self.relief_radius,
            relief=self.tip_relief / (self.tip_radius - self.relief_radius) ** 3,
            root_relief_from=self.root_relief_radius,
            root_relief_to=self.root_relief_end,
            root_relief=self.root_relief,
            section=self.profile.section,
        )
        thread = Thread(form, self.profile.table)
        end, middle, angle = self._tip_arc(thread, self.tip_rounding)
        if middle >= self.half_pitch:
            raise InputError(_pointed(self, thread))
        form["flank_end"] = end
        form["arc_radius"] = self.tip_radius - self.tip_rounding
        form["arc_z"] = middle
        form["arc_angle"] = angle
        if base is not None:
            form["base"] = base
            form["cos_base"] = base / math.hypot(base, p)
            form["sin_base"] = p / math.hypot(base, p)
            last = min(end, self.relief_radius)
            form["closed_to"] = math.sqrt(max(last * last - base * base, 0.0))
            first = max(self.root_relief_radius, base)
            form["closed_from"] = math.sqrt(first * first - base * base)
        return thread

    def _tip_arc(self, thread: Thread, r: float) -> tuple[float, float, float]:
        """Radius at the flank's end, axial place of the arc's centre, angle of the arc."""
        low, tip = self.tip_radius - r, self.tip_radius

        def above(rho: float) -> float:
            _, slope, _ = curve.width(rho, thread)
            return float(rho - r * slope / math.hypot(1.0, slope) - low)

        end = tip if r == 0.0 else root_between(above, low, tip, within=1e-14, share=1e-15)
        w, slope, _ = curve.width(end, thread)
        middle = w + r / math.hypot(1.0, slope)
        return end, float(middle), math.pi / 2.0 - math.atan(slope)

    def largest_rounding(self) -> float:
        """Return the largest rounding that the tip has room for, mm, leaving a little land."""
        limit = self.half_pitch * (1.0 - LEAST_LAND)

        def over(r: float) -> float:
            return self._tip_arc(self.thread, r)[1] - limit

        if over(0.0) >= 0.0:
            raise InputError(_pointed(self, self.thread))
        most = self.tip_radius - self.root_radius
        return most if over(most) <= 0.0 else root_between(over, 0.0, most, within=1e-12)

    def curve(self, u: npt.ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        r"""Return :math:`\rho` and :math:`z` (mm) of one side's curve, and both by ``u``.

        ``u`` is 0 to 1 on the flank, from the root to its end; to 2 on the rounding of the tip; to
        3 on the tip land, to the middle of the thread.
        """
        rho, z, drho, dz, _, _ = sampled(curve.curve_each, u, 6, self.thread)
        return rho, z, drho, dz

    def width(self, radius: npt.ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
        r"""Return :math:`w` (mm), :math:`w'` and :math:`w''` (1/mm) of the flank at radii in mm."""
        w, w1, w2 = sampled(curve.width_each, radius, 3, self.thread)
        return w, w1, w2

    def facing(self, side: int = 0, *, core: bool = True) -> Thread:
        """Return what `~asperity.flanks.worm.distance` takes.

        ``side`` is the flank of the thread space that counts, 1 or -1, 0 for the nearest; without
        the ``core`` the flanks go on below the root.
        """
        form = self.thread.form.copy()
        form["side"] = side
        if not core:
            form["root"] *= _DEEP
        return Thread(form, self.profile.table)


def _relieved_from(geometry: Geometry, given: Modification) -> float:
    """Return the radius from which a root relief goes inwards, mm."""
    r, root = geometry.worm_pitch_diameter / 2.0, geometry.worm_root_diameter / 2.0
    start = given.root_relief_start
    if start is None:
        # It has to be there where the wheel's tips bear, off mid-face as well.
        start = min(max((r - Blank.of(geometry).reach) / (r - root), 0.0), _RELIEVED_FROM)
    return r - start * (r - root)


def _draft(geometry: Geometry, flank: Flank, disc: Disc | None, **numbers: Any) -> Helicoid:
    """A helicoid without rounding, its root where the thread space has some width."""
    r, gamma = numbers["pitch_radius"], numbers["lead_angle"]
    needed = r - geometry.wheel_addendum
    draft = Helicoid(
        starts=geometry.starts,
        reduced_lead=r * math.tan(gamma),
        tip_rounding=0.0,
        profile=profile(
            flank,
            pitch_radius=r,
            lead_angle=gamma,
            pressure_angle=geometry.pressure_angle,
            half_space=numbers["half_space"],
            reach=(numbers["root_radius"], needed, numbers["tip_radius"]),
            module=geometry.axial_module,
            disc=disc,
        ),
        pressure_angle=geometry.pressure_angle,
        **numbers,
    )
    return _opened(draft, needed)


def _rounded(draft: Helicoid, rounding: float, key: str | None) -> Helicoid:
    """Round the tip as far as there is room; refuse what was asked for by a key and has none."""
    most = draft.largest_rounding()
    if key is not None and rounding > most:
        raise InputError(
            f"{key} is {rounding:.4g} mm; the tip has room for at most {most:.4g} mm: take a "
            "smaller one"
        )
    return dataclasses.replace(draft, tip_rounding=min(rounding, most))


def _pointed(helicoid: Helicoid, thread: Thread) -> str:
    until = f"before its tip radius of {helicoid.tip_radius:.5g} mm"
    if helicoid.tip_relief:
        unrelieved = float(curve.width(helicoid.tip_radius, thread)[0]) - helicoid.tip_relief
        room = helicoid.half_pitch * (1.0 - LEAST_LAND) - unrelieved
        if room > 0.0:
            normal = math.cos(helicoid.lead_angle) * math.cos(helicoid.pressure_angle)
            most = _floored(room * normal)
            return (
                f"modification.tip_relief is {helicoid.tip_relief * normal:.4g} mm; with it the "
                f"{helicoid.name}'s thread is pointed {until}: take at most {most} mm"
            )
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


def _floored(value: float) -> str:
    """Return a positive number in four digits, none of them rounded up."""
    grain = 10.0 ** (math.floor(math.log10(value)) - 3)
    return f"{math.floor(value / grain) * grain:.4g}"


def _opened(draft: Helicoid, needed: float) -> Helicoid:
    """Lift the root to where the thread space has some width, if it closes above it."""
    least = LEAST_SPACE * draft.half_pitch

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
    root = root_between(room, draft.root_radius, needed, within=1e-12)
    return dataclasses.replace(draft, root_radius=root)
