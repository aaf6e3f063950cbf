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
        "“Encourages” names no amount, and what contact in the middle is set against, line contact "
        "with “high contact stresses” at the edges of the threads and contact at an edge by "
        "misalignment, is what ours cannot have: its stiffness per length of line knows no "
        "stresses of edges, and no lubricant. By claim 2.1 the tilted hob alone bears in the "
        "middle: at the worst of three shaft angles it has "
        f"{middle:.0f} MPa for the identical hob's {edge:.0f} at an edge, "
        f"{1.0 - middle / edge:.0%} less; where the angle "
        f"is true {true[0]:.0f} for {true[1]:.0f}, and where it errs the other way {other[0]:.0f} "
        f"for {other[1]:.0f}, since what bears in the middle is shorter and pressed the harder. "
        "Greatest Hertz pressure on the lines of contact at rated torque.",
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


def _carrying(gear: Gear) -> tuple[float, float]:
    """Mean length of the lines of contact of a gearset that carry, mm, and teeth that do."""
    lines = meshing(gear).loaded(_ANGLES)
    length = np.mean([at.lines.length[at.carrying].sum() for at in lines])
    return float(length), float(np.mean([at.teeth for at in lines]))


def _unrelieved(gear: Gear) -> Gear:
    """The same gearset with threads as they are cut."""
    cut = (one for one in gear.settings if not one.startswith("modification."))
    return dataclasses.replace(gear, settings=tuple(cut))


@claim("2.10")
def _lines() -> Finding:
    plain = {name: _unrelieved(gear) for name, gear in LOADS.items()}
    (lengths, teeth), (bare, _) = (
        ({name: found[0] for name, found in both.items()},
         {name: found[1] for name, found in both.items()})
        for both in ({name: _carrying(gear) for name, gear in gears.items()}
                     for gears in (LOADS, plain))
    )  # fmt: skip
    cases = [gear.read() for gear in LOADS.values()]
    torques = " and ".join(f"{case.require(Operation).output_torque:g}" for case in cases)
    relief = cases[0].require(Modification).tip_relief
    return Finding.judged(
        {
            "the lines that carry grow with torque": lengths["high"] > lengths["low"],
            "without the relief as well": bare["high"] > bare["low"],
            "more teeth carry": teeth["high"] > teeth["low"],
        },
        f"{lengths['low']:.1f} mm on {teeth['low']:.1f} teeth at low torque, "
        f"{lengths['high']:.1f} mm on {teeth['high']:.1f} at high",
        "The steering gear, its wheel of polymer and its figure are lost, and the points that the "
        "thesis counts with them; of metal, it says itself, teeth would deflect less. What stands "
        "here is another gear and another quantity, which could hardly have come out otherwise: "
        "the mean length of the lines of contact that carry, and the teeth that they are on, with "
        "the relieved worm of figure 2.13, crowned by its hob; without the relief "
        f"{bare['low']:.1f} and {bare['high']:.1f} mm.",
        {f"length_{name}_mm": value for name, value in lengths.items()}
        | {f"teeth_{name}": value for name, value in teeth.items()}
        | {f"length_{name}_without_relief_mm": value for name, value in bare.items()},
        [*LOADS.values(), *plain.values()],
        verdict=NOT_TESTABLE,
        assumed="Gearset 3 of steel and bronze for the steering gear's of steel and polymer; "
        f"torques of {torques} N m, a relief of {1e6 * relief:g} um; one stiffness per length.",
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
        "The thesis gives no mass, and what decides is the wheel's hub and web, which are ours. "
        "Of the worm its shaft and half the wheel's diameter of threads full to their tips; of the "
        "wheel the ring of teeth, which is what the thesis meshed and by itself is the lighter, "
        "and a plain steel disc as thick as two shafts within. A hub and web of "
        f"{(worm - rim) / (whole - rim):.0%} of that disc would make the wheel the heavier.",
        {"worm_at_most_kg": worm, "rim_kg": rim, "wheel_kg": whole},
        ["volumes of the flanks of gearset-3b"],
        verdict=NOT_TESTABLE,
        assumed=f"Densities of {_STEEL:g} and {_BRONZE:g} kg/m3, and the disc.",
    )
