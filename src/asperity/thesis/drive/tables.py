"""Tables 7.1 to 7.4, as far as the text has what they held."""

import math

from asperity.flanks.mesh.tooth import contact_counts, flank_height
from asperity.flanks.wheel.enveloped import Wheel
from asperity.thesis.drive.claims import GEAR
from asperity.thesis.drive.sets import conditions
from asperity.thesis.drive.simulations import BASE, MESHES
from asperity.thesis.exhibits import table
from asperity.thesis.flanks.meshing import pair_of
from asperity.thesis.products import Grid

_RPM = 30.0 / math.pi


@table("7.1")
def _steps() -> Grid:
    return Grid.listed("7.1", "asperity drive gearset-3b")


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


@table("7.3")
def _state() -> Grid:
    return Grid.listed(
        "7.3", "asperity.thesis.drive.appendix_e.advance",
        "asperity.friction.loaded.advance_loaded",
    )  # fmt: skip


@table("7.4")
def _sizes() -> Grid:
    wheel = Wheel.cut(pair_of(GEAR))
    height, face = flank_height(wheel), wheel.pair.geometry.wheel_face_width
    coarse = contact_counts(MESHES[0])
    return Grid.of(
        [(name, contact_counts(name)) for name in MESHES],
        {
            "mesh": lambda row: row[0],
            "thesis, % of the coarse one": lambda row: {"coarse": 100, "intermediate": 75}.get(
                row[0], 50
            ),
            "here over the height, % of the coarse one": lambda row: (
                100.0 * coarse.flank / row[1].flank
            ),
            "along the face, % of the coarse one": lambda row: 100.0 * coarse.face / row[1].face,
            "elements over the height": lambda row: row[1].flank,
            "along the face": lambda row: row[1].face,
            "over the height, mm": lambda row: height / row[1].flank,
            "along the face, mm": lambda row: face / row[1].face,
        },
        *(f"asperity drive {BASE} --static --set drive.density={name}" for name in MESHES),
    )
