import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.errors import InputError
from asperity.slider import TABLES, Model, homogenise, solve
from asperity.slider import kernels as k
from asperity.slider.closed_forms import transverse_ratio
from asperity.slider.homogenised import interpolate
from asperity.slider.march import Timetable, Walk

LAWS = ["split", "unsplit", "vector"]


def body(name, *settings, **values):
    case = read_case(name, TABLES, settings)
    return Model.from_case(case.replace_values(values))


def both(name, *settings):
    return [
        solve(body(name, f"solve.method={method}", *settings), history=False)
        for method in ("march", "homogenised")
    ]


@pytest.fixture(scope="module")
def law():
    return homogenise(body("table-4.3"))


def cycle_mean_force(model, begin, end):
    """Middle of every cycle-long window and the mean drive force over it, from a march."""
    table = Timetable(model)
    walk = Walk(model, table, record=True)
    walk.to(round(begin / table.step), round(begin / table.step))
    walk.rows.clear()
    walk.at.clear()
    walk.to(round(end / table.step), 5 * model.substeps)
    time = np.concatenate(walk.at) * table.step
    force = np.concatenate(walk.rows)[:, k.FD] * model.full_friction
    cycle = round(1.0 / (model.frequency * 5 * model.substeps * table.step))
    total = np.append(0.0, np.cumsum(0.5 * (force[1:] + force[:-1])))
    return 0.5 * (time[cycle:] + time[:-cycle]), (total[cycle:] - total[:-cycle]) / cycle


@pytest.mark.parametrize(
    ("case", "speed", "allowed"),
    [
        ("table-4.3", 2, 5e-4),
        ("table-4.3", 6, 5e-4),
        # The transient of the contact itself, which the law leaves out, is larger here.
        ("table-4.3", 20, 2.5e-3),
        ("table-4.4", 6, 1.5e-3),
        ("table-4.4", 20, 5e-4),
    ],
)
def test_from_two_milliseconds_on_the_law_follows_the_cycle_mean_drive_force(case, speed, allowed):
    settings = f"vibration.velocity_ratio={speed}", "solve.duration=0.3 s"
    # A whole number of recorded rows in a cycle.
    step = "1 us" if case == "table-4.3" else f"{1 / 3000 / 350!r} s"
    model = body(case, *settings, f"solve.step={step}")
    time, marched = cycle_mean_force(model, 0.1415, 0.25)
    history = solve(body(case, *settings, "solve.method=homogenised")).history
    force = np.interp(time, history.time, history.drive_force)
    late = time >= 0.142
    assert np.abs(force - marched)[late].max() <= allowed * model.full_friction


@pytest.mark.parametrize("law_name", LAWS)
@pytest.mark.parametrize("speed", [0.5, 1, 2, 6, 20])
@pytest.mark.parametrize("case", ["table-4.3", "table-4.4"])
def test_its_ratio_is_the_marchs(case, speed, law_name):
    marched, homogenised = both(
        case, f"vibration.velocity_ratio={speed}", f"friction.law={law_name}"
    )
    assert homogenised.ratio == pytest.approx(marched.ratio, rel=1e-3)
    assert homogenised.breakaway_time == marched.breakaway_time


def test_its_friction_and_powers_are_those_of_a_cycle():
    marched, homogenised = both("table-4.3")
    force = marched.static_drive_force
    assert homogenised.friction_mean[0] == pytest.approx(marched.friction_mean[0], rel=1e-3)
    assert homogenised.friction_max[0] == pytest.approx(marched.friction_max[0], abs=2e-3 * force)
    assert homogenised.friction_min[0] == pytest.approx(marched.friction_min[0], abs=2e-3 * force)
    for power in ("drive", "vibration", "friction"):
        expected = getattr(marched.ledger, power)
        assert getattr(homogenised.ledger, power) == pytest.approx(expected, rel=2e-3)
    assert homogenised.ledger.residual < 2e-3


def test_the_law_is_odd_in_the_velocity(law):
    speeds = np.geomspace(1e-7, 1.0, 200)
    assert law(-speeds) == pytest.approx(-law(speeds), rel=1e-12)
    assert law(0.0) == pytest.approx(0.0, abs=1e-12)


def test_the_law_of_a_sampled_wave_turns_with_the_base(tmp_path):
    # F(-v) is -F(v) under a vibration turned by half a turn; this wave shows the difference.
    turn = np.linspace(0.0, 2.0 * math.pi, 61)
    wave = np.sin(turn) + 0.4 * np.sin(2.0 * turn + 1.0)
    rows = [
        f"{t!r},{u!r}"
        for t, u in zip((turn / turn[-1] * 2.5e-4).tolist(), wave.tolist(), strict=True)
    ]
    path = tmp_path / "wave.csv"
    path.write_text("\n".join(rows))
    settings = ["vibration.waveform=sampled", f"vibration.samples={path}"]
    here = homogenise(body("table-4.3", *settings))
    there = homogenise(body("table-4.3", *settings, "vibration.direction=180 deg"))
    speeds = np.linspace(1e-4, 5e-3, 30)
    assert there(-speeds) == pytest.approx(-here(speeds), rel=1e-9)
    assert np.abs(here(-speeds) + here(speeds)).max() > 1e-3


def test_the_law_at_the_drive_velocity_is_the_periodic_state(law):
    periodic = solve(body("table-4.3", "solve.method=periodic"), history=False)
    assert law(0.5e-3) == pytest.approx(periodic.drive_force, rel=2e-4)


def test_far_beyond_the_vibration_friction_is_full(law):
    full = law.full_friction
    assert law(10.0) == pytest.approx(full, rel=1e-6)
    assert law(-10.0) == pytest.approx(-full, rel=1e-6)
    speeds = np.geomspace(1e-2, 1e3, 400)
    assert np.all(law(speeds) <= full)
    end = law.velocity[-1]
    assert law(end * (1.0 + 1e-9)) == pytest.approx(law(end * (1.0 - 1e-9)), rel=1e-8)


def test_beyond_the_table_what_is_missing_of_full_friction_falls_with_the_square_of_the_speed():
    across = homogenise(body("table-4.4", "slider.lateral=guided"))
    peak, full = 3e-3, across.full_friction
    end = across.velocity[-1]
    assert across(end * (1.0 + 1e-9)) == pytest.approx(across(end * (1.0 - 1e-9)), abs=1e-9)
    for speed in (1.5 * end, 4.0 * end, -2.0 * end):
        missing = 1.0 - abs(across(speed)) / full
        exact = 1.0 - transverse_ratio(0.71 * peak / abs(speed))
        assert missing == pytest.approx(exact, rel=2e-2)


def test_more_speed_never_means_less_friction(law):
    speeds = np.linspace(-0.2, 0.2, 4001)
    assert np.all(np.diff(law(speeds)) >= 0.0)


def test_the_law_takes_numbers_and_arrays(law):
    speeds = np.array([[1e-4, 5e-4], [-1e-3, 0.02]])
    forces = law(speeds)
    assert forces.shape == speeds.shape
    assert isinstance(law(5e-4), float)
    assert law(5e-4) == forces[0, 1]
    assert interpolate(5e-4, *law.arguments) * law.full_friction == forces[0, 1]


@pytest.mark.parametrize("velocity", [math.nan, math.inf, np.array([1e-3, np.nan])])
def test_a_velocity_that_is_not_finite_is_refused(law, velocity):
    with pytest.raises(InputError, match="give finite velocities"):
        law(velocity)


def test_a_larger_model_can_march_with_the_law(law):
    # m X'' = k_d (v_d t - X) - F(X'), by hand: the body of Table 4.3 long after the start.
    stretch, velocity, h = 5.5 / 96068.0, 0.5e-3, 2e-5
    total = 0.0
    for n in range(20000):
        force = 96068.0 * stretch
        velocity += h * (force - law.full_friction * interpolate(velocity, *law.arguments)) / 0.5
        stretch += h * (0.5e-3 - velocity)
        total += force if n >= 15000 else 0.0
    assert total / 5000 / 5.5 == pytest.approx(0.13700, rel=1e-3)


def test_on_a_rigid_drive_the_answer_is_the_law_at_the_drive_velocity():
    settings = ["slider.lateral=guided"]
    values = {"slider.drive_stiffness": None, "slider.drive_damping": None}
    homogenised = solve(
        body("table-4.4", *settings, "solve.method=homogenised", **values), history=False
    )
    periodic = solve(body("table-4.4", *settings, "solve.method=periodic", **values), history=False)
    assert homogenised.ratio == pytest.approx(periodic.ratio, rel=2e-4)
    assert homogenised.breakaway_time is None


def test_the_law_of_rigid_friction_is_its_closed_form():
    settings = "friction.model=coulomb", "slider.lateral=guided"
    values = {
        "slider.drive_stiffness": None, "slider.drive_damping": None, "solve.step": 1e-7,
        "friction.max_deflection": None,
    }  # fmt: skip
    rigid = homogenise(body("table-4.3", *settings, **values))
    speeds = np.array([0.1, 0.3, 0.7, 0.95]) * 3e-3
    exact = 5.5 * 2.0 / math.pi * np.arcsin(speeds / 3e-3)
    assert rigid(speeds) == pytest.approx(exact, rel=3e-4)
    assert rigid(4e-3) == pytest.approx(5.5, rel=1e-9)


def test_the_residual_is_the_largest_of_the_table(law):
    assert 0.0 <= law.residual <= 1e-9


def test_nothing_to_homogenise_is_refused():
    still = body("table-4.3", "vibration.velocity_ratio=0")
    with pytest.raises(InputError, match="needs a vibration"):
        homogenise(still)
