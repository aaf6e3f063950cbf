"""A gear goes the whole way: loaded teeth, flanks, roots, wear, misalignment, relief.

One that `asperity new drive --ratio 40` writes, and gearset 3 with each type of flank, by the
commands as Python has them. Coarse: one tooth, two phases.
"""

import subprocess
import sys

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import COMMANDS, case_tables
from asperity.drive.problem import DriveProblem
from asperity.runs import Run

COARSE = ("drive.teeth=1", "drive.phases=2")
TYPES = ("ZA", "ZN", "ZK", "ZC", "ZI")


def answered(name, case, **options):
    command = next(command for command in COMMANDS if command.name == name)
    return command.solved(command.prepared(case, **command.defaults | options), Run())


def goes_the_whole_way(case):
    static = answered("drive", case, static=True)
    problem = static.problem
    # Without friction the powers of worm and wheel are equal.
    assert static.input_torque_frictionless == pytest.approx(
        problem.load / problem.geometry.gear_ratio, rel=2e-3
    )
    assert static.input_torque_reversed < static.input_torque_frictionless < static.input_torque
    assert static.pressure_flank <= static.flow_pressure * (1.0 + 1e-9)
    assert static.flash_temperature > 0.0

    flank = answered("flank", case)
    pressures = [row["hertz_pressure_max_MPa"] for row in flank.to_json()["loaded"]]
    # The flanks' own number, over more phases, is that of the loaded teeth.
    assert max(pressures) == pytest.approx(static.hertz_pressure_max, rel=0.1)

    roots = answered("roots", case)
    # The loaded side is pulled, the other pushed; in bending no less than a third as much. A force
    # at the foot has hardly an arm: of ZN it is 94 % of all, and the answer says so.
    assert roots.compression < 0.0 < roots.tension
    assert roots.tension < -3.0 * roots.compression or roots.tension_foot > 0.5
    if roots.tension_foot > 0.5:
        assert any("on the lowest fifth of its flank" in note for note in roots.notes)
    assert roots.residual < 1e-8

    worn = answered("wear", case, depth="1 um")
    assert worn.depth_max == pytest.approx(1.0, rel=0.05)
    assert worn.volume > 0.0

    moved = answered("misalign", case, over=["mount.axial_offset=-20,20 um"])
    assert np.isfinite(moved.edge_force).all()
    # The worm is moved to either side, and the pattern with it.
    assert moved.shift_face[1] * moved.shift_face[2] < 0.0

    relief = answered("relief", case, over=["modification.tip_relief=0,20 um"])
    assert relief.value[:, 0].tolist() == [0.0, 20.0]
    # The worm's tip is out of the way by so much, and bears less; the wheel's tip bears for it.
    assert relief.worm_tip[1] < 0.7 * relief.worm_tip[0]
    assert relief.wheel_tip[1] > relief.wheel_tip[0]
    assert relief.best == "modification.tip_relief=20 um"


@pytest.mark.slow
def test_a_gear_of_new_drive_goes_the_whole_way(tmp_path):
    file = tmp_path / "drive.toml"
    words = [sys.executable, "-m", "asperity", "new", "drive", str(file), "--defaults"]
    subprocess.run([*words, "--ratio", "40"], check=True, capture_output=True, timeout=120)
    case = read_case(file, case_tables(), COARSE)
    assert DriveProblem.from_case(case, shaken=False).geometry.gear_ratio == pytest.approx(40.0)
    goes_the_whole_way(case)


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_gear_of_new_drive_goes_the_whole_way")
@pytest.mark.parametrize("flank", TYPES)
def test_a_gear_of_each_type_of_flank_goes_the_whole_way(flank):
    settings = (f"gearset.flank={flank}", *COARSE)
    goes_the_whole_way(read_case("drive-screw", case_tables(), settings))
