"""Whether steady sliding stays, or sticks and slips."""

import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model
from asperity.slider.steady import growth_rate


def falling(faster):
    """A body whose friction falls with its speed; everything so many times as fast."""
    return Model.from_case(
        read_case(
            "table-4.3", TABLES,
            ["friction.model=lugre", "friction.static_mu=0.15",
             f"friction.stribeck_velocity={1e-3 * faster} m/s",
             f"slider.drive_velocity={0.5e-3 * faster} m/s", f"slider.mass={0.5 / faster**2} kg",
             f"friction.contact_damping={300.0 / faster} N s/m", "vibration.velocity_ratio=0"],
        )
    )  # fmt: skip


def test_a_body_that_does_all_of_it_faster_leaves_steady_sliding_as_much_faster():
    rate = growth_rate(falling(1.0))
    assert rate > 1.0
    assert growth_rate(falling(1e8)) == pytest.approx(1e8 * rate, rel=1e-6)
