"""The Hertzian pressure of a drive's contact lines is the number that `flank` has."""

import pytest
from apparatus.drives import case, problem

from asperity.drive.static.pressure import hertz_pressure
from asperity.drive.static.solve import wheel_of
from asperity.flanks.study import flank
from asperity.runs import Run

SETTINGS = (
    "gearset.hand=left", "mount.shaft_angle_error=0.05 deg", "mount.backlash=0.1 mm",
    "operation.output_torque=100 N m",
)  # fmt: skip


@pytest.mark.slow
def test_flank_and_drive_print_one_hertzian_pressure():
    found = flank.answer(flank.prepare(case(*SETTINGS), density="coarse"), Run()).to_json()
    worst = max(row["hertz_pressure_max_MPa"] for row in found["flanks"]["+1"]["loaded"])
    own = problem(*SETTINGS)
    assert hertz_pressure(own, wheel_of(own)) == worst


def test_a_worm_that_touches_nothing_has_none():
    own = problem("mount.centre_distance_error=5 mm")
    assert hertz_pressure(own, wheel_of(own)) is None
