import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve

# Of a friction that rises with less velocity where the body is driven, shaken obliquely.
FALLS = {
    "slider.drive_velocity": "5.74 mm/s", "slider.normal_force": "35.45 N",
    "slider.drive_stiffness": "290.6 N/mm", "slider.drive_damping": "15.2 N s/m",
    "slider.mass": "0.727 kg", "slider.lateral": "free",
    "friction.model": "lugre", "friction.law": "vector", "friction.mu": "0.208",
    "friction.max_deflection": "1.748 um", "friction.static_mu": "0.3328",
    "friction.stribeck_velocity": "8.88 mm/s", "friction.contact_damping": "216.8 N s/m",
    "friction.viscous_damping": "0 N s/m",
    "vibration.waveform": "triangle", "vibration.frequency": "327.8 Hz",
    "vibration.velocity_amplitude": "23.24 mm/s", "vibration.velocity_ratio": "",
    "vibration.direction": "0.976 rad", "vibration.start": "0.01 s", "vibration.ramp": "0 s",
    "solve.step": "7.6 us",
}  # fmt: skip
ALONE = "on the law alone the body rings on its drive"


def answers(*settings):
    changed = [f"{key}={value}" for key, value in FALLS.items() if value]
    case = read_case("table-4.3", TABLES, [*changed, *settings])
    return [
        solve(Model.from_case(case.replace([f"solve.method={method}"])))
        for method in ("homogenised", "periodic")
    ]


@pytest.mark.slow
def test_a_body_rings_on_its_drive_by_the_law_no_more_than_it_does_shaken():
    by_the_law, state = answers()
    assert state.settled
    assert by_the_law.settled
    assert by_the_law.ratio == pytest.approx(state.ratio, abs=1e-9)
    assert by_the_law.friction_max == pytest.approx(state.friction_max, rel=1e-9)
    assert by_the_law.ledger.residual < 1e-9
    assert any(ALONE in note for note in by_the_law.notes)
    # The law's own ring, which the note tells of.
    late = by_the_law.history.velocity[-1000:, 0]
    assert np.ptp(late) > 0.5 * 5.74e-3


@pytest.mark.slow
def test_a_ring_that_the_drive_damps_is_not_told_of():
    by_the_law, state = answers("slider.drive_damping=400 N s/m")
    assert by_the_law.ratio == pytest.approx(state.ratio, abs=1e-6)
    assert not any(ALONE in note for note in by_the_law.notes)
