import pytest
from apparatus.grid import slow

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve

SHAKEN = "waveform=square", "start=0.01 s", "ramp=0 s", "applied_to=body", "direction=0 deg"
# A drive so soft that the body comes to its mean within seconds.
SOFT = [
    "slider.drive_velocity=6.66 mm/s", "slider.normal_force=63.3 N",
    "slider.drive_stiffness=14.1 N/mm", "slider.drive_damping=4.45 N s/m", "slider.mass=0.646 kg",
    "slider.lateral=guided", "friction.mu=0.23", "friction.max_deflection=0.741 um",
    "vibration.frequency=404.6 Hz", "vibration.velocity_amplitude=41.5 mm/s",
    "vibration.rise_time=0.494 ms", "solve.duration=2.625 s",
]  # fmt: skip
# A free body that is shaken across, of which coarser steps make less than twice as much.
ACROSS = [
    "slider.drive_velocity=0.556 mm/s", "slider.normal_force=44.35 N",
    "slider.drive_stiffness=505 N/mm", "slider.drive_damping=137.6 N s/m", "slider.mass=0.713 kg",
    "slider.lateral=free", "friction.transfer=1", "friction.mu=0.2768",
    "friction.max_deflection=0.314 um",
    "vibration.frequency=569.9 Hz", "vibration.velocity_amplitude=3.075 mm/s",
    "vibration.rise_time=0.575 ms", "vibration.applied_to=base", "vibration.direction=90 deg",
]  # fmt: skip
PULLS = "the two-phase scheme lets its drive pull with the base's motion"


def answer(*settings):
    shaken = [f"vibration.{setting}" for setting in SHAKEN]
    case = read_case("table-4.3", TABLES, [*shaken, "solve.method=march", *settings])
    return solve(Model.from_case(case), history=False)


@pytest.mark.parametrize(
    ("body", "step"),
    [
        slow(SOFT, "2.4715 us"), slow(SOFT, "1.2 us"), slow(SOFT, "0.3 us"), (ACROSS, "3.25 us"),
    ],
)  # fmt: skip
def test_the_error_that_is_told_is_not_below_half_of_what_is_made(body, step):
    fine = answer(*body)
    told = answer(*body, "solve.scheme=two-phase", f"solve.step={step}")
    made = abs(told.ratio - fine.ratio)
    assert 0.5 * made < told.step_error < 3.0 * made


@pytest.mark.slow
def test_what_the_drive_adds_to_a_vibration_of_the_base_is_noted():
    along = "vibration.applied_to=base", "solve.scheme=two-phase", "solve.step=2.4715 us"
    shaken = answer(*SOFT, *along)
    (note,) = (note for note in shaken.notes if PULLS in note)
    assert "by 0.0034 of the vibration more" in note
    across = answer(*SOFT, *along, "vibration.direction=90 deg")
    of_the_body = answer(*SOFT, *along, "vibration.applied_to=body")
    stiff = answer(*SOFT, "vibration.applied_to=base")
    for other in (across, of_the_body, stiff):
        assert not any(PULLS in note for note in other.notes)


SHAKEN_ACROSS = "table-4.3", 4e3, "vibration.direction=90 deg"
AS_IT_SHIPS = "table-4.4", 3e3, "vibration.direction=270 deg"


@pytest.mark.parametrize(
    ("body", "steps", "off"),
    [
        (SHAKEN_ACROSS, 33, 2.14e-2), (SHAKEN_ACROSS, 333, 2.13e-3),
        slow(SHAKEN_ACROSS, 3333, 2.6e-4), slow(AS_IT_SHIPS, 33, 6.8e-3),
        slow(AS_IT_SHIPS, 333, 7.2e-4), slow(AS_IT_SHIPS, 3333, 1.0e-4),
    ],
)  # fmt: skip
def test_so_many_steps_a_cycle_are_off_by_what_the_docs_say_of_bodies_shaken_across(
    body, steps, off
):
    case, frequency, direction = body

    def ratio(*settings):
        model = Model.from_case(read_case(case, TABLES, [direction, *settings]))
        return solve(model, history=False).ratio

    step = f"solve.step={1e6 / (frequency * steps)!r} us"
    explicit = ratio("solve.method=march", "solve.scheme=two-phase", step)
    assert explicit / ratio("solve.method=periodic") - 1.0 == pytest.approx(off, rel=0.05)
