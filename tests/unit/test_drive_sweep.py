"""Drives over a grid: what stands beside the ratio, and what is refused."""

import pytest
from apparatus.drives import GIVEN, solved

from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.sweep import read_grid, run


def test_a_drive_is_swept_over_its_own_keys_with_balance_and_settled_beside_the_ratio():
    over = ["vibration.velocity_ratio=1,1.5"]
    case, axes = read_grid("drive-screw", case_tables(), GIVEN, over)
    swept = run(case, axes, cache=False)
    found = swept.to_json()
    assert found["torque_ratio"][0] == pytest.approx(1.0, abs=1e-6)
    assert found["torque_ratio"][1] == solved().torque_ratio
    assert found["settled"] == [1.0, 1.0]
    assert max(map(abs, found["torque_balance"])) < 5e-3
    assert "ratio" not in found
    text = swept.tables()[0]
    assert [column.heading for column in text.columns[1:4]] == ["ratio", "balance", "settled"]
    title = swept.figure().axes[0].get_title(loc="left")
    assert "in balance to" in title


def test_a_key_of_a_sliding_body_is_no_axis_of_a_drive():
    with pytest.raises(InputError, match=r"\[slider\] has no part in a drive"):
        read_grid("drive-screw", case_tables(), GIVEN, ["slider.mass=1 kg"])
