"""What a gearset gains by vibration, at the limit at which it locks."""

import pytest
from apparatus.drives import problem

from asperity.drive.point import MeshPoint
from asperity.drive.studies.gains import gain


@pytest.mark.parametrize("over", [0.98, 1.02])
def test_it_locks_just_where_friction_holds_all_of_the_load(over):
    geometry = problem().geometry
    point = MeshPoint.of(geometry, 0.5e-3 * geometry.worm_pitch_diameter)
    # The share of friction that holds is as one over the friction there is.
    limit = 0.1 * point.holding_share(0.1)
    assert gain(geometry, over * limit).locks == (over > 1.0)
