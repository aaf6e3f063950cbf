r"""What worm and wheel measure, from the thickest to the thinnest that is allowed.

The worm's threads are at most as thick as they were analysed, the wheel's teeth as the hob leaves
them; both may be thinner by a tolerance. Thinner threads turn out in the backlash exactly: the worm
can be turned further by the axial thickness that is missing over its reduced lead, the wheel by the
angle that is missing. Lengths are in mm, angles in rad; thicknesses are those on the worm's
reference cylinder and on the wheel's mean circle in mid-face.
"""

import math
from collections.abc import Callable, Mapping
from typing import Any

from asperity.errors import ConvergenceError, InputError
from asperity.flanks.measuring.wheel import Space
from asperity.flanks.measuring.worm import Groove, Rest
from asperity.flanks.meshing.backlash import Play
from asperity.flanks.parameters import MeasuringOptions
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.flank import RESOLVED
from asperity.gearset import Geometry
from asperity.gearset.tolerancing import thickness
from asperity.gearset.tolerancing.backlash import Backlash
from asperity.gearset.tolerancing.thickness import thickness_tolerance
from asperity.results import Quantities, quantity
from asperity.results.table import Column, Table
from asperity.results.words import Number
from asperity.sources import Source

_MILLIMETRES = 1e3
_TRIED = 12
# Of pins and balls, in modules.
_CUSTOMARY = 1.7

SIZES = (
    1.0, 1.1, 1.25, 1.4, 1.5, 1.75, 2.0, 2.25, 2.5, 2.75, 3.0, 3.25, 3.5,
    3.75, 4.0, 4.25, 4.5, 5.0, 5.25, 5.5, 6.0, 6.5, 7.0, 7.5, 8.0, 9.0, 10.0, 10.5, 11.0, 12.0,
    14.0, 15.0, 16.0, 18.0, 20.0, 22.0, 25.0, 28.0, 30.0, 35.0, 40.0, 45.0, 50.0,
)  # fmt: skip
"""Diameters of pins and balls for measuring, mm; below 1 mm DIN 3977 has wires of other sizes."""

SOURCES = {
    "measuring pins and balls": Source(
        "DIN 3977:1981, table 1", "one source", "as the tests of the program gearcore have it"
    ),
    "tolerance of the tooth thickness": thickness.SOURCE,
}
"""Where what is assumed of measuring comes from."""


_ASSUMED = {
    "pin_diameter": "the pin of a usual series next to the best",
    "ball_diameter": "the ball of a usual series next to the best",
    "thread_tolerance": "series 25, by the reference diameter",
    "tooth_tolerance": "series 25, by the mean diameter",
}


class Measuring(Quantities):
    """What to measure on worm and wheel.

    What cannot be measured is None: where no pin rests on the flanks and stands out of them. Upper
    and lower are the thickest and the thinnest that is allowed; allowances count from half a pitch
    on the worm, and on the wheel from what the hob leaves.

    Attributes
    ----------
    missing : tuple of str
        Why something cannot be measured.
    assumed : mapping of str to str
        What was not given of ``[measuring]``, and what was assumed for it.
    """

    thread_thickness_axial: float = quantity("s_x1", "mm", "axial thickness of the thread, upper")
    thread_thickness: float = quantity("s_n1", "mm", "normal thickness of the thread, upper")
    thread_allowance_upper: float = quantity("E_sn1,s", "mm", "upper allowance of the thread")
    thread_allowance_lower: float = quantity("E_sn1,i", "mm", "lower allowance of the thread")
    pin_diameter_optimum: float | None = quantity(
        "", "mm", "pin that touches at the reference diameter"
    )
    pin_diameter: float | None = quantity("D_M1", "mm", "diameter of the pins")
    over_pins_upper: float | None = quantity("M_dR1,s", "mm", "worm over three pins, upper")
    over_pins_lower: float | None = quantity("M_dR1,i", "mm", "worm over three pins, lower")
    pin_contact_diameter: float | None = quantity("", "mm", "diameter where the pins touch")
    tooth_thickness: float = quantity("s_m2", "mm", "thickness of the wheel's tooth, upper")
    tooth_thickness_normal: float = quantity(
        "s_mn2", "mm", "normal thickness of the wheel's tooth, upper"
    )
    tooth_allowance_upper: float | None = quantity(
        "E_sn2,s", "mm", "upper allowance of the tooth", default=None, optional=True
    )
    tooth_allowance_lower: float = quantity("E_sn2,i", "mm", "lower allowance of the tooth")
    ball_diameter_optimum: float | None = quantity("", "mm", "ball that touches at the mean circle")
    ball_diameter: float | None = quantity("D_M2", "mm", "diameter of the balls")
    over_balls_upper: float | None = quantity("M_dK2,s", "mm", "wheel over two balls, upper")
    over_balls_lower: float | None = quantity("M_dK2,i", "mm", "wheel over two balls, lower")
    ball_contact_diameter: float | None = quantity("", "mm", "diameter where the balls touch")
    backlash_normal_min: float = quantity("j_n,min", "mm", "normal backlash, least")
    backlash_normal_max: float = quantity("j_n,max", "mm", "normal backlash, greatest, nearly")
    backlash_circumferential_min: float = quantity(
        "j_t,min", "mm", "backlash on the wheel's mean circle, least"
    )
    backlash_circumferential_max: float = quantity(
        "j_t,max", "mm", "backlash on the wheel's mean circle, greatest"
    )
    missing: tuple[str, ...] = ()

    assumed: Mapping[str, str]

    def resolution(self, name: str) -> float:
        """Return the size below which a length is rounding, mm."""
        return RESOLVED

    def to_json(self) -> dict[str, Any]:
        """Return the lengths by name, what cannot be measured and what was assumed."""
        return super().to_json() | {
            "missing": list(self.missing),
            "assumed": dict(self.assumed),
            "from_memory": {key: f"{each.name}; {each.note}" for key, each in SOURCES.items()},
        }

    def table(self) -> Table:
        """Return a table in thousandths of a mm, as they are measured."""
        rows = [
            (
                entry.label.meaning,
                entry.label.symbol,
                Number(f"{round(entry.value, 3) + 0.0:.3f}", entry.value, f"measuring.{entry.key}"),
                entry.label.unit,
            )
            for entry in self.entries()
            if entry.value is not None
        ]
        remarks = (*self.missing, *(f"{key}: {each}" for key, each in SOURCES.items()))
        headings = "measuring", "symbol", "value", "unit"
        return Table(
            tuple(Column(text, text == "value") for text in headings), tuple(rows), "", remarks
        )


def measure(
    wheel: Wheel,
    play: Play,
    options: MeasuringOptions | None = None,
    backlash: Backlash | None = None,
) -> Measuring:
    """Return what to measure on a pair whose play is known.

    Parameters
    ----------
    wheel : Wheel
        With the pair.
    play : Play
        Of the pair, with nothing off.
    options : MeasuringOptions, optional
        The ``[measuring]`` table.
    backlash : Backlash, optional
        By the exact flanks, with what is allowed of both thicknesses.

    Raises
    ------
    InputError
        A pin or ball that is asked for does not rest on the flanks.
    """
    pair, geometry = wheel.pair, wheel.pair.geometry
    given = (options or MeasuringOptions()).model_dump(exclude_none=True)
    given = {key: value * _MILLIMETRES for key, value in given.items()}
    worm, slant = pair.worm, math.cos(pair.worm.lead_angle)
    mean = 0.5 * geometry.wheel_mean_diameter
    limits = _limits(geometry, slant, given, backlash)
    axial = 2.0 * (worm.half_pitch - worm.half_space)
    allowance = (axial - worm.half_pitch) * slant
    missing: list[str] = []

    def rests(
        key: str, what: str, thick: Groove | Space, thin: Groove | Space, contact: float
    ) -> tuple[float | None, Rest | None, Rest | None]:
        asked = given.get(key)
        best = _tried(thick.optimum, contact)
        if asked is not None:
            return best.diameter if best else None, thick.over(asked), thin.over(asked)
        near = best.diameter if best else _CUSTOMARY * geometry.axial_module
        for size in sorted(SIZES, key=lambda size: abs(size - near))[:_TRIED]:
            thickest, thinnest = _tried(thick.over, size), _tried(thin.over, size)
            if thickest is not None and thinnest is not None:
                return best.diameter if best else None, thickest, thinnest
        missing.append(f"{what}: none rests on the flanks and stands out of them")
        return best.diameter if best else None, None, None

    def groove(thinner: float) -> Groove:
        return Groove(worm.with_half_space(worm.half_space + 0.5 * thinner / slant))

    (thread, thin_thread), (tooth, thin_tooth) = limits
    pin, over, under = rests(
        "pin_diameter", "pins on the worm", groove(thread), groove(thin_thread),
        0.5 * geometry.worm_pitch_diameter,
    )  # fmt: skip
    ball, above, below = rests(
        "ball_diameter", "balls on the wheel", Space(wheel, tooth / slant / mean),
        Space(wheel, thin_tooth / slant / mean), mean,
    )  # fmt: skip
    thickness = _thickness(wheel, mean)
    turn = play.wheel_angle + thin_thread / slant / (worm.reduced_lead * pair.ratio)
    turn += thin_tooth / slant / mean
    least = min(play.normal.values())
    more = (thin_thread + thin_tooth) * math.cos(geometry.pressure_angle)
    normal, around = (least, least + more), (play.wheel_angle * mean, turn * mean)
    if backlash is not None:
        new, factor = backlash.states["new"], backlash.measures[1].factor
        around = new.least / _MILLIMETRES, new.greatest / _MILLIMETRES
        normal = around[0] * factor, around[1] * factor
    return Measuring(
        thread_thickness_axial=axial - thread / slant,
        thread_thickness=axial * slant - thread,
        thread_allowance_upper=allowance - thread,
        thread_allowance_lower=allowance - thin_thread,
        pin_diameter_optimum=pin,
        pin_diameter=over.diameter if over else None,
        over_pins_upper=over.dimension if over else None,
        over_pins_lower=under.dimension if under else None,
        pin_contact_diameter=2.0 * over.contact if over else None,
        tooth_thickness=thickness - tooth / slant,
        tooth_thickness_normal=thickness * slant - tooth,
        tooth_allowance_upper=None if backlash is None else 0.0 - tooth,
        tooth_allowance_lower=-thin_tooth,
        ball_diameter_optimum=ball,
        ball_diameter=above.diameter if above else None,
        over_balls_upper=above.dimension if above else None,
        over_balls_lower=below.dimension if below else None,
        ball_contact_diameter=2.0 * above.contact if above else None,
        backlash_normal_min=normal[0],
        backlash_normal_max=normal[1],
        backlash_circumferential_min=around[0],
        backlash_circumferential_max=around[1],
        missing=tuple(missing),
        assumed={
            key: text
            for key, text in _ASSUMED.items()
            if key not in given and not (backlash is not None and key.endswith("tolerance"))
        },
    )


_Limits = tuple[tuple[float, float], tuple[float, float]]


def _limits(
    geometry: Geometry, slant: float, given: dict[str, float], backlash: Backlash | None
) -> _Limits:
    """By how much thread and tooth are thinner, normal to them: at least and at most, mm."""
    if backlash is not None:
        off = backlash.allowances
        thread = (0.0 - off.thread[0], 0.0 - off.thread[1])
        return thread, (0.0 - off.tooth[0] * slant, 0.0 - off.tooth[1] * slant)
    own = thickness_tolerance(geometry.worm_pitch_diameter)
    wheel = thickness_tolerance(geometry.wheel_mean_diameter)
    thread = (0.0, given.get("thread_tolerance", own))
    return thread, (0.0, given.get("tooth_tolerance", wheel))


def _thickness(wheel: Wheel, radius: float) -> float:
    """Arc between both flanks of a tooth in mid-face, mm."""
    plus, minus = (float(wheel.flank(side).at(radius, 0.0).angle) for side in (1, -1))
    return radius * (plus - minus)


def _tried(find: Callable[[float], Rest], size: float) -> Rest | None:
    """How a pin or ball rests, None where none does."""
    try:
        return find(size)
    except (InputError, ConvergenceError):
        return None
