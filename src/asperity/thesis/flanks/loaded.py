"""Claims 2.7, 2.10 and 7.21: pressure and lines under load, and which of the two is lighter."""

import math

import numpy as np

from asperity.flanks.mesh.tooth import tooth
from asperity.flanks.wheel.enveloped import Wheel
from asperity.thesis.exhibits import claim
from asperity.thesis.flanks.claims import ASKEW, HOBS
from asperity.thesis.flanks.figures import LOADS
from asperity.thesis.flanks.meshing import Gear, meshing, pair_of
from asperity.thesis.products import Finding

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
    true = ", ".join(f"{each[1]:.0f} ({name})" for name, each in pressures.items())
    return Finding.judged(
        {
            "“Centre contact also encourages reduced contact pressure”, against contact at an edge":
            worst["identical"] > max(p for name, p in worst.items() if name != "identical"),
        },
        ", ".join(f"{pressure:.0f} MPa ({name})" for name, pressure in worst.items())
        + f" at most while the shaft angle errs by {ASKEW:g} deg",
        "An identical hob bears at an edge where the shaft angle errs one way, and is pressed "
        "harder there than an oversized one in the middle. Where the angle is true it is the other "
        f"way round, {true} MPa: of long lines of contact an oversized hob makes shorter ones, and "
        "what is shorter is pressed harder. Where it errs the other way the identical hob has "
        f"{pressures['identical'][2]:.0f} MPa. Greatest Hertz pressure on the lines of contact at "
        "rated torque; lubrication is not in it.",
        {
            f"pressure_{name}_{where}_MPa": p
            for name, each in pressures.items()
            for where, p in zip(("askew", "true", "askew_the_other_way"), each, strict=True)
        },
        [gear for each in gears.values() for gear in each],
        assumed="Gearset 3 as its flanks are checked; one stiffness per length of line.",
    )  # fmt: skip


def _greatest(gear: Gear) -> float:
    """The greatest pressure on the lines of contact of a gearset, MPa."""
    return max(
        float(lines.pressure[lines.carrying].max()) for lines in meshing(gear).loaded(_ANGLES)
    )


@claim("2.10")
def _lines() -> Finding:
    lengths = {
        name: float(
            np.mean([at.lines.length[at.carrying].sum() for at in meshing(gear).loaded(_ANGLES)])
        )
        for name, gear in LOADS.items()
    }
    return Finding.judged(
        {"the lines that carry grow with torque": lengths["high"] > 1.2 * lengths["low"]},
        f"{lengths['low']:.1f} mm at low torque, {lengths['high']:.1f} mm at high",
        "Mean length of the lines of contact that carry. Of metal, with the relieved worm of "
        "figure 2.13: a wheel of polymer gives way more, and the thesis counts points.",
        {f"length_{name}_mm": value for name, value in lengths.items()},
        LOADS.values(),
        assumed="Gearset 3 of steel and bronze for the steering gear's; one stiffness per length.",
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
