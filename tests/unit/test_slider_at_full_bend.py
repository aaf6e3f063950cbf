"""States of asperities that come to their limit by a power of the time, friction turned aside.

At its limit a deflection of law ``unsplit`` keeps its size, and its direction follows the slip as a
trailer does its tractor: by a curve that is known, and whatever the exponent is.
"""

import math

import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve
from asperity.slider.continuation import follow

UNSPLIT = "friction.law=unsplit", "friction.transfer=1", "vibration.start=0 s"
RIGID = dict.fromkeys(("slider.drive_stiffness", "slider.drive_damping", "slider.mass"))
# Two bodies on drives that give, of which exponents of 4 were 2.0e-3 and 1.6e-3 from their limit.
ACROSS = (
    "slider.drive_velocity=1.32 mm/s", "slider.normal_force=12.6 N", "slider.mass=0.228 kg",
    "slider.drive_stiffness=161 kN/m", "slider.drive_damping=19.2 N s/m", "friction.mu=0.2",
    "friction.max_deflection=0.506 um", "vibration.waveform=triangle",
    "vibration.frequency=624.5 Hz", "vibration.velocity_ratio=0.4455", "vibration.direction=90 deg",
)  # fmt: skip
AT_AN_ANGLE = (
    "slider.drive_velocity=6.07 mm/s", "slider.normal_force=19 N", "slider.mass=0.12 kg",
    "slider.drive_stiffness=109 kN/m", "slider.drive_damping=59.4 N s/m", "friction.mu=0.2",
    "friction.max_deflection=0.633 um", "vibration.frequency=761 Hz",
    "vibration.velocity_ratio=0.815", "vibration.direction=39 deg",
)  # fmt: skip


def state(exponent, settings, left_out=None):
    given = *UNSPLIT, f"friction.exponent={exponent}", *settings, "solve.method=periodic"
    case = read_case("table-4.3", TABLES, given)
    left_out = {"solve.step": None, "solve.duration": None, **(left_out or {})}
    return solve(Model.from_case(case.replace_values(left_out)), history=False)


def trailing(drive, across, frequency, length, cycles=8, steps=400):
    """Return the mean cosine of a trailer's angle whose tractor goes to and fro across its way."""
    step, angle, total = 1.0 / (frequency * steps), 0.0, 0.0

    def turns(time, at):
        aside = across * math.cos(2.0 * math.pi * frequency * time)
        return (aside * math.cos(at) - drive * math.sin(at)) / length

    for n in range(cycles * steps):
        half = angle + 0.5 * step * turns(n * step, angle)
        angle += step * turns((n + 0.5) * step, half)
        total += math.cos(angle) if n >= (cycles - 1) * steps else 0.0
    return total / steps


@pytest.mark.parametrize(("exponent", "ratio"), [(4, 2.0), (3, 0.8)])
def test_asperities_at_their_limit_trail_behind_the_slip(exponent, ratio):
    """The faster one was told as one of many states, of which nothing damps a disturbance."""
    drawn = (
        "friction.max_deflection=0.5 um", "slider.drive_velocity=1 mm/s", "slider.lateral=guided",
        "vibration.frequency=500 Hz", f"vibration.velocity_ratio={ratio}",
        "vibration.direction=90 deg",
    )  # fmt: skip
    answer = state(exponent, drawn, RIGID)
    assert answer.settled
    assert answer.ratio == pytest.approx(trailing(1e-3, 1e-3 * ratio, 500.0, 5e-7), abs=1e-5)


@pytest.mark.parametrize("drawn", [ACROSS, AT_AN_ANGLE])
def test_asperities_of_any_exponent_come_to_the_same_state(drawn):
    """Those of an exponent of 1.5 soon, those of 4 not in days, and the answer says so."""
    soon, slowly = (state(exponent, drawn) for exponent in (1.5, 4))
    assert soon.settled
    assert slowly.settled
    assert slowly.ratio == pytest.approx(soon.ratio, abs=2e-5)
    assert "come to their limit by a power of the time" in slowly.notes[0]
    assert not soon.notes


def test_asperities_that_bend_back_in_a_cycle_are_not_put_to_their_limit():
    """A vibration across so fast that the slip turns round before they do."""
    fast = *ACROSS[:-2], "vibration.velocity_ratio=6", "vibration.direction=90 deg"
    answer = state(4, fast)
    assert answer.settled
    assert not answer.notes
    assert answer.ratio < 0.9


@pytest.mark.parametrize(("exponent", "there"), [(1.5, 0.81602), (3, 0.59506)])
def test_shaken_along_they_are_found_where_split_ones_are(exponent, there):
    """Friction at its limit repeats itself too, and a body from rest stays below it."""
    drawn = (
        "slider.drive_velocity=1 mm/s", "slider.drive_stiffness=4287 kN/m", "slider.mass=0.5 kg",
        "slider.drive_damping=29.3 N s/m", "slider.normal_force=37 N", "slider.lateral=guided",
        "friction.max_deflection=1 um", "vibration.frequency=1530 Hz",
        "vibration.velocity_ratio=0.91", "vibration.direction=0 deg",
    )  # fmt: skip
    ratios = [
        state(exponent, (*drawn, f"friction.law={law}")).ratio for law in ("unsplit", "split")
    ]
    assert ratios == pytest.approx([there] * 2, abs=1e-5)


def test_under_a_contact_that_nothing_swings_they_are_where_they_are_without_one():
    pressed = "normal.law=linear", "normal.stiffness=100 MN/m", "normal.damping_ratio=0.3"
    free = state(6, ACROSS).ratio
    assert free == pytest.approx(0.94409, abs=1e-5)
    assert state(6, (*ACROSS, *pressed)).ratio == pytest.approx(free, abs=1e-6)


def test_a_walk_comes_to_the_states_that_bodies_have_alone():
    given = *UNSPLIT, "friction.exponent=6", *ACROSS, "solve.method=periodic"
    case = read_case("table-4.3", TABLES, given)
    ratios = (8.0, 0.4455)
    models = [
        Model.from_case(
            case.replace_values(
                {"solve.step": None, "solve.duration": None, "vibration.velocity_ratio": ratio}
            )
        )
        for ratio in ratios
    ]
    walked = [answer.ratio for answer in follow(models)]
    assert walked == pytest.approx(
        [solve(model, history=False).ratio for model in models], abs=1e-8
    )


def test_next_to_an_exponent_of_1_a_duration_is_told():
    """A power of what is left overflows there."""
    drawn = (
        "slider.drive_velocity=1 mm/s", "slider.drive_stiffness=226 MN/m", "slider.mass=0.5 kg",
        "slider.drive_damping=32 kN s/m", "slider.normal_force=14 N", "slider.lateral=guided",
        "friction.max_deflection=1.17 um", "vibration.frequency=1760 Hz",
        "vibration.velocity_ratio=0.58", "vibration.direction=90 deg",
    )  # fmt: skip
    given = *UNSPLIT, "friction.exponent=1.0005", *drawn, "solve.duration=9 ms"
    case = read_case("table-4.3", TABLES, (*given, "solve.method=march"))
    answer = solve(Model.from_case(case.replace_values({"solve.step": None})), history=False)
    assert not answer.settled
    assert "a solve.duration of 0.035 s would do" in "\n".join(answer.notes)
