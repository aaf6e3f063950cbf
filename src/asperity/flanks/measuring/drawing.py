"""The data of worm and wheel that stand on their drawings, by the names of ISO 1122-2 and DIN 3974.

Which data belong on a drawing is from memory of DIN 3966-3.
"""

import math
from collections.abc import Sequence
from typing import NamedTuple

from asperity.flanks.measuring.measures import Measuring
from asperity.flanks.worm.setting import Pair
from asperity.gearset.tolerancing.backlash import Backlash
from asperity.gearset.tolerancing.grades import Allowed
from asperity.results.files import csv_text
from asperity.results.quantity import plain
from asperity.results.unit_systems import converted
from asperity.results.words import text_of

_MICROMETRES = 1e3
_Line = tuple[str, str, object, str]


class Datum(NamedTuple):
    """A line of a drawing's data: of the worm, the wheel or both; limits are upper and lower."""

    part: str
    name: str
    symbol: str
    value: object
    unit: str = ""


def drawing_data(
    pair: Pair,
    measuring: Measuring,
    graded: Sequence[Allowed] = (),
    backlash: Backlash | None = None,
) -> list[Datum]:
    """Return the lines for worm and wheel, then those of both, lengths in mm.

    Parameters
    ----------
    pair : Pair
        Worm and wheel.
    measuring : Measuring
        What they measure.
    graded : sequence of Allowed, optional
        Deviations that a grade of accuracy allows.
    backlash : Backlash, optional
        What the tolerances leave of it.
    """
    g, worm = pair.geometry, pair.worm
    of_worm: list[_Line] = [
        ("number of threads", "z_1", g.starts, ""),
        ("axial module", "m_x1", g.axial_module, "mm"),
        ("flank form", "", pair.flank, ""),
        ("hand of the thread", "", pair.hand, ""),
        ("reference diameter", "d_m1", g.worm_pitch_diameter, "mm"),
        ("diameter factor", "q_1", g.diameter_factor, ""),
        ("reference lead angle", "gamma_m1", math.degrees(worm.lead_angle), "deg"),
        ("lead", "p_z1", 2.0 * math.pi * worm.reduced_lead, "mm"),
        ("axial pitch", "p_x1", 2.0 * worm.half_pitch, "mm"),
        ("normal pressure angle", "alpha_n", math.degrees(g.pressure_angle), "deg"),
        ("base diameter", "d_b1", worm.profile.base_radius and 2 * worm.profile.base_radius, "mm"),
        ("tip diameter", "d_a1", 2.0 * worm.tip_radius, "mm"),
        ("root diameter", "d_f1", 2.0 * worm.root_radius, "mm"),
        ("length of the threaded worm", "b_1", g.worm_face_width, "mm"),
        ("tip rounding", "", worm.tip_rounding, "mm"),
        ("axial thread thickness", "s_x1", measuring.thread_thickness_axial, "mm"),
        ("normal thread thickness", "s_n1", measuring.thread_thickness, "mm"),
        ("upper allowance", "E_sn1,s", measuring.thread_allowance_upper, "mm"),
        ("lower allowance", "E_sn1,i", measuring.thread_allowance_lower, "mm"),
        ("measuring pin diameter", "D_M1", measuring.pin_diameter, "mm"),
        ("dimension over three pins, upper", "M_dR1,s", measuring.over_pins_upper, "mm"),
        ("dimension over three pins, lower", "M_dR1,i", measuring.over_pins_lower, "mm"),
    ]
    of_wheel: list[_Line] = [
        ("number of teeth", "z_2", g.wheel_teeth, ""),
        ("axial module of the worm", "m_x1", g.axial_module, "mm"),
        ("profile shift coefficient", "x_2", g.profile_shift, ""),
        ("reference diameter", "d_2", g.wheel_reference_diameter, "mm"),
        ("mean diameter", "d_m2", g.wheel_mean_diameter, "mm"),
        ("throat diameter", "d_a2", g.wheel_throat_diameter, "mm"),
        ("root diameter", "d_f2", g.wheel_root_diameter, "mm"),
        ("outside diameter", "d_e2", g.wheel_outside_diameter, "mm"),
        ("throat form radius", "r_k", g.wheel_throat_radius, "mm"),
        ("face width", "b_2", g.wheel_face_width, "mm"),
        ("tooth thickness on the mean circle", "s_m2", measuring.tooth_thickness, "mm"),
        ("upper allowance, normal", "E_sn2,s", measuring.tooth_allowance_upper, "mm"),
        ("lower allowance, normal", "E_sn2,i", measuring.tooth_allowance_lower, "mm"),
        ("measuring ball diameter", "D_M2", measuring.ball_diameter, "mm"),
        ("dimension over two balls, upper", "M_dK2,s", measuring.over_balls_upper, "mm"),
        ("dimension over two balls, lower", "M_dK2,i", measuring.over_balls_lower, "mm"),
        ("hob: reference diameter", "", 2.0 * pair.hob.pitch_radius, "mm"),
        ("hob: centre distance", "", pair.cutting.centre_distance, "mm"),
        ("hob: tilt", "", math.degrees(pair.cutting.tilt), "deg"),
    ]
    of_both: list[_Line] = [
        ("centre distance", "a", g.centre_distance, "mm"),
        ("shaft angle", "Sigma", 90.0, "deg"),
        ("gear ratio", "u", g.gear_ratio, ""),
        ("normal backlash, least", "j_n,min", measuring.backlash_normal_min, "mm"),
        (
            "circumferential backlash, least",
            "j_t,min",
            measuring.backlash_circumferential_min,
            "mm",
        ),
        (
            "circumferential backlash, greatest",
            "j_t,max",
            measuring.backlash_circumferential_max,
            "mm",
        ),
    ]
    for one in graded:
        line = (f"{one.name} ({_short(one)})", one.symbol, one.value / _MICROMETRES, "mm")
        (of_worm if one.part == "worm" else of_wheel).append(line)
    if backlash is not None and backlash.allowances.centre_distance:
        off = backlash.allowances.centre_distance
        of_both.append(("deviation of the centre distance, to either side", "f_a", off, "mm"))
    parts: dict[str, list[_Line]] = {"worm": of_worm, "wheel": of_wheel, "both": of_both}
    return [
        Datum(part, name, symbol, plain(value), unit)
        for part, lines in parts.items()
        for name, symbol, value, unit in lines
        if value is not None
    ]


def _short(allowed: Allowed) -> str:
    return f"grade {allowed.grade}, {allowed.source.name.partition(' after ')[0]}"


def csv_of(data: list[Datum]) -> str:
    """Return the lines as CSV, with full digits and, beside them, as a drawing has them."""
    rows: list[Sequence[object]] = [("part", "name", "symbol", "value", "unit", "on the drawing")]
    for datum in data:
        if isinstance(datum.value, float):
            value, unit = converted(datum.value, datum.unit)
            datum = datum._replace(value=value, unit=unit)
        rows.append([*datum, on_drawing(datum)])
    return csv_text(rows)


def on_drawing(datum: Datum) -> str:
    """Thousandths of a mm and of a degree, ten thousandths of an inch."""
    digits = 4 if datum.unit == "in" else 3
    return (
        f"{round(datum.value, digits) + 0.0:.{digits}f}"
        if isinstance(datum.value, float)
        else text_of(datum.value)
    )
