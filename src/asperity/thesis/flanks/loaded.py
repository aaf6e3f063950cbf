"""Claims 2.7, 2.10 and 7.21: pressure and lines under load, and which of the two is lighter."""

import dataclasses
import math

import numpy as np

from asperity.flanks.mesh.tooth import tooth
from asperity.flanks.parameters import Modification
from asperity.flanks.wheel.enveloped import Wheel
from asperity.rating import Operation
from asperity.thesis.exhibits import claim
from asperity.thesis.flanks.claims import ASKEW, HOBS
from asperity.thesis.flanks.figures import LOADS
from asperity.thesis.flanks.meshing import Gear, meshing, pair_of
from asperity.thesis.products import NOT_TESTABLE, Finding

_CASE = "gearset-3b"
_ANGLES = 8
_MORE = 1.2
_STEEL, _BRONZE = 7850.0, 7600.0
_SHAFT_DIAMETER, _SHAFT_LENGTH = 17.0, 150.0
"""Of the worm's shaft (7.2.2), mm."""


@claim("2.7")
def _pressure() -> Finding:
    errors = (-ASKEW, 0.0, ASKEW)
    gears = {
        name: [Gear(_CASE, (*hob, f"mount.shaft_angle_error={error:g} deg")) for error in errors]
        for name, hob in HOBS.items()
    }
    pressures = {name: [_greatest(gear) for gear in each] for name, each in gears.items()}
    worst = {name: max(each) for name, each in pressures.items()}
    edge, middle = worst["identical"], worst["oversized, tilted"]
    true, other = (
        [pressures[name][place] for name in ("oversized, tilted", "identical")] for place in (1, 2)
    )
    return Finding.judged(
        {
            "in the middle less than at an edge, at the worst angle of each": middle < edge,
        },
        ", ".join(f"{pressure:.0f} MPa ({name})" for name, pressure in worst.items())
        + f" at most while the shaft angle errs by {ASKEW:g} deg",
        "“Encourages” names no amount and nothing it is set against. By claim 2.1 the tilted hob "
        "alone bears in the middle: at the worst of three shaft angles it has "
        f"{middle:.0f} MPa for the identical hob's {edge:.0f} at an edge, "
        f"{1.0 - middle / edge:.0%} less; where the angle "
        f"is true {true[0]:.0f} for {true[1]:.0f}, and where it errs the other way {other[0]:.0f} "
        f"for {other[1]:.0f}, since what bears in the middle is shorter and pressed the harder. "
        "Greatest Hertz pressure on the lines of contact at rated torque; lubrication is not in "
        "it.",
        {
            f"pressure_{name}_{where}_MPa": p
            for name, each in pressures.items()
            for where, p in zip(("askew", "true", "askew_the_other_way"), each, strict=True)
        },
        [gear for each in gears.values() for gear in each],
        verdict=NOT_TESTABLE,
        assumed="Gearset 3 as its flanks are checked, its hob borrowed; one stiffness per length "
        "of line.",
    )  # fmt: skip


def _greatest(gear: Gear) -> float:
    """The greatest pressure on the lines of contact of a gearset, MPa."""
    return max(
        float(lines.pressure[lines.carrying].max()) for lines in meshing(gear).loaded(_ANGLES)
    )


def _carrying(gear: Gear) -> float:
    """Mean length of the lines of contact of a gearset that carry, mm."""
    lines = meshing(gear).loaded(_ANGLES)
    return float(np.mean([at.lines.length[at.carrying].sum() for at in lines]))


def _unrelieved(gear: Gear) -> Gear:
    """The same gearset with threads as they are cut."""
    cut = (one for one in gear.settings if not one.startswith("modification."))
    return dataclasses.replace(gear, settings=tuple(cut))


@claim("2.10")
def _lines() -> Finding:
    plain = {name: _unrelieved(gear) for name, gear in LOADS.items()}
    lengths = {name: _carrying(gear) for name, gear in LOADS.items()}
    bare = {name: _carrying(gear) for name, gear in plain.items()}
    cases = [gear.read() for gear in LOADS.values()]
    torques = " and ".join(f"{case.require(Operation).output_torque:g}" for case in cases)
    relief = cases[0].require(Modification).tip_relief
    return Finding.judged(
        {
            "the lines that carry grow with torque": lengths["high"] > _MORE * lengths["low"],
            "without the relief as well": bare["high"] > _MORE * bare["low"],
        },
        f"{lengths['low']:.1f} mm at low torque, {lengths['high']:.1f} mm at high",
        "Mean length of the lines of contact that carry, with the relieved worm of figure 2.13; "
        f"without the relief {bare['low']:.1f} and {bare['high']:.1f} mm, so that it is not what "
        "makes them grow. Of metal, which gives way less than a wheel of polymer; the thesis "
        "counts points.",
        {f"length_{name}_mm": value for name, value in lengths.items()}
        | {f"length_{name}_without_relief_mm": value for name, value in bare.items()},
        [*LOADS.values(), *plain.values()],
        assumed="Gearset 3 of steel and bronze for the steering gear's of steel and polymer; "
        f"torques of {torques} N m, a relief of {1e6 * relief:g} um; one stiffness per length; "
        f"more is {_MORE - 1.0:.0%} more.",
    )


@claim("7.21")
def _lighter() -> Finding:
    pair = pair_of(Gear(_CASE))
    g = pair.geometry
    wheel = Wheel.cut(pair)
    ring = g.wheel_teeth * tooth(wheel, "coarse").volume()
    # At most: full to its tips along as much of it as faces the wheel's whole diameter.
    threads = 0.25 * math.pi * g.worm_tip_diameter**2 * 0.5 * g.wheel_throat_diameter
    shaft = 0.25 * math.pi * _SHAFT_DIAMETER**2 * _SHAFT_LENGTH
    worm, rim = 1e-9 * _STEEL * (threads + shaft), 1e-9 * _BRONZE * ring
    disc = 0.25 * math.pi * g.wheel_root_diameter**2 * 2.0 * _SHAFT_DIAMETER
    whole = rim + 1e-9 * _STEEL * disc
    return Finding.judged(
        {"the worm is lighter": worm < whole},
        f"worm {worm:.2f} kg at most, the wheel's teeth on their rim {rim:.2f} kg, with a disc "
        f"within them {whole:.2f} kg",
        "Of the worm its shaft and half the wheel's diameter of threads full to their tips; of the "
        "wheel the ring of teeth and a plain steel disc as thick as two shafts within. The thesis "
        "gives no mass, and the ring alone is the lighter; a hub and web of "
        f"{(worm - rim) / (whole - rim):.0%} of that disc would do.",
        {"worm_at_most_kg": worm, "rim_kg": rim, "wheel_kg": whole},
        ["volumes of the flanks of gearset-3b"],
        assumed=f"Densities of {_STEEL:g} and {_BRONZE:g} kg/m3, and the disc.",
    )
