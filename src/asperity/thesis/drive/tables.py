"""Tables 7.1 to 7.4, as far as the text has what they held."""

import math

from asperity.flanks.mesh.tooth import DENSITIES, element_size
from asperity.flanks.wheel.enveloped import Wheel
from asperity.thesis.drive.claims import GEAR
from asperity.thesis.drive.sets import conditions
from asperity.thesis.exhibits import table
from asperity.thesis.flanks.meshing import pair_of
from asperity.thesis.products import Grid

_RPM = 30.0 / math.pi

_STEPS = (
    ("1 to 3", "contact, load and rotation are brought on; their order is lost",
     "the worm turns from the start; the load is in balance with it"),
    ("4", "vibration of the worm along X is switched on (7.4.1)",
     "the march begins here, in steady sliding; the amplitude grows over vibration.ramp"),
    ("all", "bore of the wheel on its centre point, free about its axis, with a constant torque "
     "(7.2.2, 7.2.4)", "the wheel with drive.load_inertia, which the thesis does not state"),
    ("all", "the shaft's far end B turns steadily; a torsional spring to A (7.2.2)",
     "operation.worm_speed behind shaft.torsional_stiffness"),
    ("all", "the worm held across its axis (7.2.4)", "rigid where [shaft] has no bearings"),
)  # fmt: skip


@table("7.1")
def _steps() -> Grid:
    return Grid.of(
        _STEPS,
        {
            "step": lambda row: row[0],
            "thesis": lambda row: row[1],
            "here": lambda row: row[2],
        },
        "asperity drive gearset-3b",
    )


@table("7.2")
def _conditions() -> Grid:
    rows = [condition for number in (1, 2, 3) for condition in conditions(number)]
    return Grid.of(
        list(enumerate(rows, 1)),
        {
            "simulation": lambda row: row[0],
            "set": lambda row: row[1].number,
            "k_w": lambda row: row[1].ratio,
            "f, Hz": lambda row: row[1].frequency,
            "v_a, mm/s": lambda row: 1e3 * row[1].velocity,
            "u_a, um": lambda row: 1e6 * row[1].amplitude,
            "v_g, mm/s": lambda row: 1e3 * row[1].sliding_speed,
            "n_1, rpm": lambda row: _RPM * row[1].worm_speed,
            "T_R, N m": lambda row: row[1].torque,
        },
        "asperity.thesis.drive.sets.conditions(number)",
    )


_VARIABLES = (
    ("x", "(77)", "STATEV(1)", "way slid along the first axis"),
    ("y", "(78)", "STATEV(2)", "way slid along the second axis"),
    ("M_1x", "(34)", "STATEV(3)", "root of the asperity, first axis"),
    ("M_1y", "(91)", "STATEV(4)", "root of the asperity, second axis"),
    ("s_1", "(86)", "STATEV(5)", "deflection"),
)


@table("7.3")
def _state() -> Grid:
    return Grid.of(
        _VARIABLES,
        {
            "variable": lambda row: row[0],
            "by": lambda row: row[1],
            "Appendix E": lambda row: row[2],
            "what it is": lambda row: row[3],
            "here": lambda row: (
                "its vector: both parts of the deflection" if row[0] == "s_1" else "follows"
            ),
        },
        "asperity.thesis.drive.appendix_e.advance",
        "asperity.friction.loaded.advance_loaded",
    )


@table("7.4")
def _sizes() -> Grid:
    wheel = Wheel.cut(pair_of(GEAR))
    coarse = element_size(wheel, "coarse")
    return Grid.of(
        list(DENSITIES),
        {
            "mesh": str,
            "thesis, % of the coarse one": lambda name: {"coarse": 100, "intermediate": 75}.get(
                name, 50
            ),
            "here, % of the coarse one": lambda name: 100.0 * element_size(wheel, name) / coarse,
            "wheel, mm": lambda name: element_size(wheel, name),
        },
        *(f"{GEAR.command()} --density {name}" for name in DENSITIES),
    )
