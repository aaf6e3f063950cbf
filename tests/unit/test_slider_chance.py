"""What never repeats itself has not settled where the halves of its window agree by chance.

A ball that a shaken table throws has such motions: P. J. Holmes, J. Sound Vib. 84 (1982) 173.
"""

import pytest

from asperity.casefile import read_case
from asperity.results.settled import Standing
from asperity.slider import TABLES, Model
from asperity.slider.chance import judged, scatter
from asperity.slider.march import March

BOUNCES = (
    "friction.model=coulomb", "friction.mu=0.221", "slider.normal_force=25 N",
    "slider.mass=0.671 kg", "slider.drive_velocity=8.03 mm/s", "slider.drive_stiffness=61 MN/m",
    "slider.drive_damping=1890 N s/m", "slider.lateral=guided", "normal.law=hertz",
    "normal.stiffness=53.3 MN/m", "normal.damping_ratio=0.28", "vibration.frequency=1881 Hz",
    "vibration.velocity_ratio=5", "vibration.direction=90 deg", "vibration.elevation=90 deg",
)  # fmt: skip


def at_the_end(duration, *settings):
    settings = (*settings, f"solve.duration={duration}")
    march = March(Model.from_case(read_case("normal-pin", TABLES, settings)))
    march.to(march.table.steps, 4096)
    return march


def test_windows_of_a_body_that_bounces_without_end_differ():
    march = at_the_end("0.4 s", *BOUNCES)
    ratio = float(march.sums["drive_force"] / march.sums["steps"])
    off = scatter(march._body, march.table, ratio)
    assert 2e-3 < off < 0.1
    standing, notes = judged(Standing(True, "halves"), march._body, march.table, march.sums)
    assert not standing.settled
    assert "do not repeat themselves" in standing.settled_by
    assert not notes
    # What has not settled by its halves stays as it is.
    lacks = Standing(False, "halves")
    assert judged(lacks, march._body, march.table, march.sums) == (lacks, ())


@pytest.mark.parametrize("k", [10.0, 20.0])
def test_those_of_a_body_that_repeats_itself_do_not(k):
    march = at_the_end("0.4 s", f"vibration.velocity_ratio={k}", "vibration.elevation=90 deg")
    kept = march.state.copy()
    assert scatter(march._body, march.table, 5.0) == 0.0
    assert march.state == kept
