"""Which motor does, and what a shaken gearset's wear and heat come to."""

import math

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.friction import rating_inputs
from asperity.drive.life import life
from asperity.drive.motor import (
    PRICE_PER_MASS,
    Motor,
    Service,
    all_motors,
    exchange,
    lightest,
    of_another_speed,
    scaled,
)
from asperity.errors import InputError
from asperity.rating import rate_case

_OWN = """
[source.us]
name = "our price list"
confidence = "one source"

[motor.ours]
power = "6 kW"
speed = "1450 rpm"
breakdown = 3.5
mass = "9 kg"
diameter = "150 mm"
length = "200 mm"
price = 250
from = { "*" = "us" }
"""


def test_frames_grow_with_torque_and_every_number_has_a_source():
    motors = all_motors()
    assert len(motors) == 15
    for name in ("torque", "mass", "diameter", "length"):
        values = [getattr(motor, name) for motor in motors]
        assert values == sorted(values), name
    assert all(motor.source("mass").confidence == "one source" for motor in motors)
    for motor in motors:
        assert motor.cost == pytest.approx(PRICE_PER_MASS * motor.mass)


def test_a_continuous_torque_takes_the_smallest_rated_one_above_it():
    assert lightest(Service(((33.8, 60.0),))).name == "132S"
    assert lightest(Service(((7.4, 60.0),))).name == "90S"


def test_a_short_torque_is_carried_by_the_breakdown_torque_of_a_smaller_motor():
    service = Service(((30.0, 1.0), (2.0, 99.0)))
    assert service.effective_torque == pytest.approx(math.sqrt(9.0 + 4.0 * 0.99))
    small = lightest(service)
    assert small.torque < 30.0 <= small.greatest_torque()
    assert small.mass < lightest(Service(((30.0, 1.0),))).mass


def test_at_full_voltage_a_motor_stalls_later():
    motor = all_motors()[0]
    assert motor.greatest_torque(1.0) == pytest.approx(motor.breakdown * motor.torque)
    assert motor.greatest_torque() == pytest.approx(0.81 * motor.greatest_torque(1.0))


def test_your_own_motor_is_chosen_where_it_is_lighter(tmp_path, monkeypatch):
    (tmp_path / "ours.toml").write_text(_OWN)
    monkeypatch.setenv("ASPERITY_MATERIALS", str(tmp_path / "ours.toml"))
    motor = lightest(Service(((33.8, 60.0),)))
    assert (motor.name, motor.cost) == ("ours", 250.0)
    assert motor.source("price").name == "our price list"


def test_a_motor_that_turns_at_another_speed_than_the_worm_is_told():
    motor = lightest(Service(((33.8, 60.0),)))
    assert of_another_speed((motor,), 2.0 * math.pi * 24.0) == ()
    (line,) = of_another_speed((motor,), 2.0 * math.pi * 48.0)
    assert "the worm turns at 2880 rpm and the motors at 14" in line


def test_of_the_same_make_mass_goes_with_torque_and_size_with_its_cube_root():
    sizes = {"mass": 8.0, "diameter": 0.1, "length": 0.2}
    motor = Motor.model_validate({"power": 1.0, "speed": 1.0, "breakdown": 2.0, **sizes})
    small = scaled(motor, 0.125)
    assert (small.mass, small.diameter, small.length) == pytest.approx((7.0, 0.05, 0.1))
    with pytest.raises(InputError, match=r"share of the torque is 1\.2"):
        scaled(motor, 1.2)


def test_an_exchange_counts_the_actuator_against_the_motor():
    found = exchange(Service(((33.8, 9.0),)), Service(((25.0, 9.0),)), 500.0, 800.0)
    assert (found.before.name, found.after.name) == ("132S", "112M")
    assert found.saved_mass == pytest.approx(41.0 - 31.0 - 0.5 - 2.4)
    assert found.saved_cost == pytest.approx(10.0 * PRICE_PER_MASS)


@pytest.mark.parametrize("parts", [(), ((1.0, 0.0),), ((-1.0, 1.0),)])
def test_a_service_of_nothing_is_refused(parts):
    with pytest.raises(InputError, match="a service needs parts"):
        Service(parts)


def test_a_torque_that_no_motor_has_is_refused_in_one_line():
    with pytest.raises(InputError, match="no motor known does 500 N m all the time"):
        lightest(Service(((500.0, 1.0),)))


@pytest.fixture(scope="module")
def given():
    return rating_inputs(read_case("gearset-3b", case_tables()))


def test_a_gearset_that_is_never_shaken_keeps_its_rating(given):
    rated = rate_case(read_case("gearset-3b", case_tables()), ("iso14521",)).iso14521
    found = life(given)
    assert found.safety_wear == pytest.approx(rated["safety_wear"], rel=1e-9)
    assert found.sump_temperature == pytest.approx(rated["theta_S_degC"] + 273.15, rel=1e-9)
    assert found.bulk_temperature == pytest.approx(rated["theta_M_degC"] + 273.15, rel=1e-9)
    assert found.wear == pytest.approx(1e-3 * rated["delta_Wn_mm"], rel=1e-9)
    assert found.hours == pytest.approx(rated["life_h"] * rated["safety_wear"], rel=1e-9)


def test_the_path_slid_divides_the_safety_against_wear(given):
    # The wear intensity of this gearset stands at its cap, whatever the temperature.
    still, shaken = life(given), life(given, 0.1, path_ratio=3.0)
    assert shaken.safety_wear == pytest.approx(still.safety_wear / 1.2, rel=1e-9)
    assert shaken.wear == pytest.approx(1.2 * still.wear, rel=1e-9)


def test_heat_of_the_vibration_warms_the_sump_in_proportion_to_the_losses(given):
    rated = rate_case(read_case("gearset-3b", case_tables()), ("iso14521",)).iso14521
    loss = rated["loss_total_W"]
    found = life(given, 0.5, other_heat=0.2 * loss)
    rise = rated["theta_S_degC"] - given.ambient_temperature
    assert found.sump_temperature - life(given).sump_temperature == pytest.approx(
        0.1 * rise, rel=1e-6
    )
    # Less friction between the teeth cools both.
    cool = life(given, 1.0, path_ratio=0.5)
    assert cool.bulk_temperature < life(given).bulk_temperature - 20.0


@pytest.mark.parametrize(
    ("words", "says"),
    [
        ({"share": 1.5}, "the share of time is 1.5; it must be 0 or more and at most 1"),
        ({"path_ratio": -1.0}, "the path ratio is -1; it must be 0 or more"),
        ({"other_heat": math.nan}, "the other heat is nan"),
    ],
)
def test_an_impossible_share_or_path_is_refused(given, words, says):
    with pytest.raises(InputError, match=says):
        life(given, **words)


# Hours, torque and worm speed; the last one runs hottest.
PARTS = ((500.0, 250.0, 700.0), (1500.0, 150.0, 1400.0), (100.0, 240.0, 1400.0))


def of_parts(*settings):
    listed = ", ".join(
        f'{{duration = "{hours} h", output_torque = "{torque} N m", worm_speed = "{speed} rpm"}}'
        for hours, torque, speed in PARTS
    )
    return read_case("gearset-3b", case_tables(), [f"operation.duty_cycle=[{listed}]", *settings])


def alone(hours, torque, speed):
    return rating_inputs(
        read_case(
            "gearset-3b",
            case_tables(),
            [
                f"operation.output_torque={torque} N m",
                f"operation.through_travel_torque={torque} N m",
                f"operation.worm_speed={speed} rpm",
                f"operation.life={hours} h",
            ],
        )
    )


@pytest.mark.parametrize("shaken", [(), (0.2, 3.0, 40.0)])
def test_a_duty_cycle_wears_what_its_parts_wear_and_heats_as_the_hottest_of_them(shaken):
    found = life(rating_inputs(of_parts()), *shaken)
    parts = [life(alone(*part), *shaken) for part in PARTS]
    assert found.wear == pytest.approx(sum(part.wear for part in parts), rel=1e-9)
    # Miner's rule: what each part takes of the limit adds up to the inverse of the safety.
    used = sum(1.0 / part.safety_wear for part in parts)
    assert 1.0 / found.safety_wear == pytest.approx(used, rel=1e-9)
    assert found.hours == pytest.approx(2100.0 / used, rel=1e-9)
    sumps = [part.sump_temperature for part in parts]
    assert found.sump_temperature == pytest.approx(max(sumps), rel=1e-12)
    assert max(sumps) > min(sumps) + 5.0
    assert found.safety_temperature == min(part.safety_temperature for part in parts)


def test_a_duty_cycle_that_is_never_shaken_keeps_its_rating():
    rated = rate_case(of_parts(), ("iso14521",)).iso14521
    found = life(rating_inputs(of_parts()))
    assert found.safety_wear == pytest.approx(rated["safety_wear"], rel=1e-9)
    assert found.wear == pytest.approx(1e-3 * rated["delta_Wn_mm"], rel=1e-9)
    assert found.sump_temperature == pytest.approx(rated["theta_S_max_degC"] + 273.15, rel=1e-9)
    assert found.safety_temperature == pytest.approx(rated["safety_temperature"], rel=1e-9)
