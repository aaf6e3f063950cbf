import math

import numpy as np
import pytest
from apparatus.grid import grid

from asperity.casefile import read_case
from asperity.errors import InputError
from asperity.friction.two_phase import phases
from asperity.slider import TABLES, Model, solve

STEP = 1e-6
STEPS = 2500


def body(*settings):
    case = read_case("table-4.4", TABLES, ["solve.scheme=two-phase", "solve.step=1 us", *settings])
    return Model.from_case(case)


def refusal(*settings):
    with pytest.raises(InputError) as raised:
        solve(body(*settings))
    assert len(str(raised.value).splitlines()) == 1
    return str(raised.value)


def increment(size, rate, limit, exponent):
    """Change of the deflection in a step, (17)."""
    return rate * (1.0 - size / limit * math.copysign(1.0, rate)) ** exponent


def table_4_2(model, start, exponent):
    """Equations (20) and (33)-(59) one after the other, carrying what Table 4.2 carries."""
    slider, limit = model.slider, model.friction.deflection_limit(model.slider.normal_force)
    stiffness = model.friction.stiffness(slider.normal_force)
    cos, sin, _ = model.unit_direction
    way_x = way_y = x = y = x_b = y_b = dx_b = m_x = m_y = s_1 = 0.0
    f_d = f_x = f_y = 0.0
    rows = []
    for n in range(1, STEPS + 1):
        t = n * STEP
        way_x += STEP**2 * (f_d - f_x) / slider.mass  # (41), integrated semi-implicitly
        x = way_x - dx_b + x  # (42)
        way_y += STEP**2 * f_y / slider.mass  # (43)
        y += way_y
        reach = math.hypot(x - m_x, m_y - y)  # (46)
        middle = s_1 + increment(s_1, reach - s_1, limit, exponent)  # (44), (45)
        vibrating = t > start + 1e-9 * STEP
        sin_a, cos_a = ((m_y - y) / reach, (x - m_x) / reach) if vibrating else (0.0, 1.0)
        u = model.amplitude * math.sin(2 * math.pi * model.frequency * (t - start))  # (49)
        u = u if vibrating else 0.0
        dx_b, dy_b = u * cos - x_b, u * sin - y_b  # (50)-(54)
        x_b, y_b = u * cos, u * sin
        up = middle * sin_a + model.friction.transfer * dy_b  # (55)
        reach = math.hypot(middle * cos_a, up)  # (57)
        s_1 = middle + increment(middle, reach - middle, limit, exponent)  # (33), (56)
        sin_b, cos_b = (up / reach, middle * cos_a / reach) if vibrating else (0.0, 1.0)
        m_x, m_y = x - s_1 * cos_b, y + s_1 * sin_b  # (34), (35)
        f_x, f_y = stiffness * s_1 * cos_b, stiffness * s_1 * sin_b  # (36), (37)
        f_d = slider.drive_stiffness * (slider.drive_velocity * t - x)  # (20)
        rows.append((f_d, f_x, -f_y))
    return np.array(rows)


def table_7_3(model, exponent):
    """Equations (77)-(91) with the stored y in (81), under a body with its drive and mass."""
    slider, limit = model.slider, model.friction.deflection_limit(model.slider.normal_force)
    stiffness = model.friction.stiffness(slider.normal_force)
    cos, sin, _ = model.unit_direction
    way_x = way_y = own_x = x = y = u = m_x = m_y = s_1 = 0.0
    f_d = f_x = f_y = 0.0
    rows = []
    for n in range(1, STEPS + 1):
        t = n * STEP
        way_x += STEP**2 * (f_d - f_x) / slider.mass
        way_y -= STEP**2 * f_y / slider.mass
        du = model.amplitude * math.sin(2 * math.pi * model.frequency * t) - u
        u += du
        own_x += way_x
        x, dy, last_y = x + way_x + du * cos, way_y + du * sin, y  # (77), (78)
        y = last_y + dy
        reach = math.hypot(x - m_x, last_y - m_y)  # (81)
        middle = s_1 + increment(s_1, reach - s_1, limit, exponent)  # (79), (80)
        sin_a, cos_a = 0.0, 1.0
        if reach > 0.0:
            sin_a, cos_a = (last_y - m_y) / reach, (x - m_x) / reach  # (82), (83)
        kept = 1.0 - model.friction.transfer  # (85)
        up = y - last_y + middle * sin_a - kept * dy
        reach = math.hypot(middle * cos_a, up)  # (88)
        s_1 = middle + increment(middle, reach - middle, limit, exponent)  # (86), (87)
        sin_b, cos_b = up / reach, middle * cos_a / reach  # (89), (90)
        m_x, m_y = x - s_1 * cos_b, y - s_1 * sin_b  # (34), (91)
        f_x, f_y = stiffness * s_1 * cos_b, stiffness * s_1 * sin_b
        f_d = slider.drive_stiffness * (slider.drive_velocity * t - own_x)
        rows.append((f_d, f_x, f_y))
    return np.array(rows)


def marched(model):
    history = solve(model).history
    assert history.time == pytest.approx(STEP * np.arange(1, STEPS + 1), rel=1e-12)
    return np.column_stack([history.drive_force, history.friction])


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(("theta", "exponent"), grid([0, 30, 90, 200, 270], [1.0, 1.5, 2.0]))
def test_with_the_base_vibrated_it_is_table_4_2_as_printed(theta, exponent):
    model = body(
        f"vibration.direction={theta} deg", "vibration.start=1 ms", "solve.duration=2.5 ms",
        f"friction.exponent={exponent}", "vibration.velocity_ratio=10",
    )  # fmt: skip
    expected = table_4_2(model, 1e-3, exponent)
    assert np.hypot(*expected[:, 1:].T).max() > 0.3 * model.full_friction
    assert marched(model) == pytest.approx(expected, abs=1e-9 * model.full_friction)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize(("theta", "exponent"), grid([0, 30, 90, 200], [1.0, 2.0]))
def test_with_the_body_vibrated_it_is_table_7_3_with_the_stored_y(theta, exponent):
    model = body(
        f"vibration.direction={theta} deg", "vibration.start=0 s", "solve.duration=2.5 ms",
        f"friction.exponent={exponent}", "vibration.applied_to=body",
    )  # fmt: skip
    expected = table_7_3(model, exponent)
    assert np.hypot(*expected[:, 1:].T).max() > 0.3 * model.full_friction
    assert marched(model) == pytest.approx(expected, abs=1e-9 * model.full_friction)


@pytest.mark.usefixtures("plain_kernels")
def test_up_to_the_start_the_direction_is_the_drives():
    size, cos, sin = phases(0.5, 0.8, 0.6, 0.1, 0.3, 0.0, 0.2, 1.0, True)
    assert (cos, sin) == (1.0, 0.0)
    assert size > 0.5


@pytest.mark.usefixtures("plain_kernels")
def test_without_any_deflection_nothing_is_divided_by_zero():
    assert phases(0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, False) == (0.0, 1.0, 0.0)


@pytest.mark.usefixtures("plain_kernels")
def test_the_explicit_phases_overshoot_where_the_exponential_update_cannot():
    # Linearly unstable beyond twice the limit of slip in a step.
    def after_many(slip):
        size = 0.99
        for _ in range(200):
            size, _, _ = phases(size, 1.0, 0.0, slip, 0.0, 0.0, 0.0, 1.0, False)
        return size

    assert after_many(1.9) == pytest.approx(1.0, abs=1e-6)
    assert abs(after_many(2.1) - 1.0) > 0.05


def test_a_step_that_would_be_unstable_is_refused_with_the_largest_that_is_not():
    text = refusal("vibration.velocity_ratio=30", "solve.step=12 us")
    assert "unstable" in text
    # 2 s_max / (v_d + v_a)
    assert "at most 9.74e-06 s" in text
    assert solve(body("vibration.velocity_ratio=30", "solve.step=9.7 us")).ratio > 0.0


@pytest.mark.parametrize(
    "settings",
    [
        ["friction.law=vector"],
        ["friction.law=unsplit"],
        ["friction.model=lugre"],
        ["solve.method=periodic"],
        ["solve.method=homogenised"],
    ],
)
def test_it_exists_for_the_march_of_split_dahl_friction_only(settings):
    assert "solve.scheme is 'two-phase'" in refusal(*settings)


@pytest.mark.parametrize("exponent", [0.0, 0.5])
def test_exponents_that_never_saturate_or_overshoot_are_refused(exponent):
    assert "use solve.scheme 'exponential'" in refusal(f"friction.exponent={exponent}")


def test_vibration_from_the_first_step_works():
    answer = solve(body("vibration.start=0 s", "solve.duration=1.2 s"))
    assert answer.ratio == pytest.approx(0.40488, rel=1e-3)


def test_a_rigid_drive_and_a_guided_body_work_too():
    settings = ["slider.lateral=guided", "friction.transfer=1", "vibration.velocity_ratio=2"]
    case = read_case("table-4.4", TABLES, ["solve.scheme=two-phase", *settings])
    rigid = case.replace_values({"slider.drive_stiffness": None, "slider.drive_damping": None})
    exponential = rigid.replace(["solve.scheme=exponential"])
    ratios = [solve(Model.from_case(case)).ratio for case in (rigid, exponential)]
    assert ratios[0] == pytest.approx(ratios[1], rel=2e-3)
