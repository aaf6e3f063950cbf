"""Marches of asperities next to their limit against the plain way of `apparatus.plain_body`.

Law ``unsplit`` with an exponent of 3 or 4, shaken across the drive or at an angle by less than its
velocity: the slip keeps its direction, and asperities come to their limit as t^(-1/(i - 1)) only.
A march is that of its time, whether it has settled there or not.
"""

import math

import numpy as np
import pytest
from apparatus.bodies import Lot
from apparatus.plain_body import solved

from asperity.slider import solve
from asperity.slider.longer import lasting

BAR = 1e-3
LOT = 11


def body(member, folder):
    """Return a body by lot, with the duration of its march in cycles."""
    rng = np.random.default_rng((LOT, member))

    def log(low, high):
        return math.exp(rng.uniform(math.log(low), math.log(high)))

    drive, frequency, cycles = log(1e-3, 1e-2), log(300.0, 900.0), int(rng.integers(150, 300))
    stiffness, mass = log(2e4, 2e5), log(0.1, 1.0)
    damping = 2.0 * math.sqrt(stiffness * mass) * log(0.05, 0.3)
    tables = {
        "slider": {
            "drive_velocity": f"{drive!r} m/s",
            "normal_force": f"{log(10.0, 60.0)!r} N",
            "drive_stiffness": f"{stiffness!r} N/m",
            "drive_damping": f"{damping!r} N s/m",
            "mass": f"{mass!r} kg",
            "lateral": rng.choice(["free", "guided"]).item(),
        },
        "friction": {
            "model": "dahl",
            "law": "unsplit",
            "mu": 0.2,
            "max_deflection": f"{log(3e-7, 2e-6)!r} m",
            "exponent": rng.choice([3.0, 4.0]).item(),
        },
        "vibration": {
            "waveform": rng.choice(["sine", "triangle"]).item(),
            "frequency": f"{frequency!r} Hz",
            "velocity_ratio": log(0.2, 0.9),
            "direction": f"{rng.choice([0.5 * math.pi, rng.uniform(0.5, 1.5)]).item()!r} rad",
        },
        "solve": {"method": "march", "duration": f"{cycles / frequency!r} s"},
    }
    return Lot(tables, cycles)


def off(member, folder):
    """Return how far a march is from the plain way, and what either tells of its own error."""
    lot = body(member, folder)
    answer = solve(lot.model(folder), history=False)
    own = solved(answer.model, lot.cycles, answer.cycles)
    return answer.ratio - own.ratio, own.error + 2.0 * (answer.step_error or 0.0)


@pytest.mark.parametrize("member", [9, 36])
def test_asperities_near_their_limit_are_where_the_plain_way_has_them(tmp_path, member):
    apart, told = off(member, tmp_path)
    assert abs(apart) <= BAR + told


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_asperities_near_their_limit_are_where_the_plain_way_has_them")
def test_nearly_all_asperities_near_their_limit_are_where_the_plain_way_has_them(tmp_path):
    """What is not rings as chance has it, in other steps otherwise, and has not settled."""
    found = {member: off(member, tmp_path) for member in range(40)}
    apart = {member: each for member, each in found.items() if abs(each[0]) > BAR + each[1]}
    assert len(apart) <= 0.1 * len(found), apart


def shaken_across(folder):
    """Return a body whose asperities come to a mean below their limit, a ratio of 0.9672."""
    tables = {
        "slider": {
            "drive_velocity": "7.32 mm/s", "normal_force": "11.9 N", "mass": "0.605 kg",
            "drive_stiffness": "15300 N/m", "lateral": "guided",
        },
        "friction": {
            "model": "dahl", "law": "unsplit", "mu": 0.286, "max_deflection": "0.7 um",
            "exponent": 3.0,
        },
        "vibration": {
            "waveform": "triangle", "frequency": "763 Hz", "velocity_amplitude": "2.29 mm/s",
            "direction": "90 deg",
        },
        "solve": {"method": "march", "duration": "2.5 s"},
    }  # fmt: skip
    return Lot(tables, 0).model(folder)


@pytest.mark.slow
def test_a_duration_is_told_by_the_power_of_time_in_which_they_come_to_their_limit(tmp_path):
    """By the modes of the state, which next to the limit hardly fade, it was 1600 s."""
    model = shaken_across(tmp_path)
    (note,) = solve(model, history=False).notes
    longer = float(note.split()[3])
    assert 20.0 < longer < 60.0
    assert solve(lasting(model, longer), history=False).settled
