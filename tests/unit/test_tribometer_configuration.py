"""A rig's configuration: what ships, what follows from it, and what is refused in a line."""

import datetime
import tomllib

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.casefile.written import toml, written
from asperity.errors import InputError
from asperity.tribometer.calibration import fitted_line
from asperity.tribometer.options import Reduction, Twin
from asperity.tribometer.report.study import _cells
from asperity.tribometer.tables import TABLES


@pytest.mark.parametrize("name", ["rig-final", "rig-preliminary"])
def test_the_rigs_of_the_thesis_ship(name):
    case = read_case(name, TABLES)
    assert {"rig", "steel_disc", "bronze_disc", "drives", "channels"} <= case.tables.keys()


def test_a_velocity_is_known_between_the_frequencies_it_was_measured_at():
    sonotrode = read_case("rig-final", TABLES)["sonotrode"]
    assert sonotrode.velocity("transverse", 750.0) == pytest.approx(0.059)
    assert 0.030 < sonotrode.velocity("transverse", 900.0) < 0.059
    assert sonotrode.velocity("longitudinal", 3001.0) is None


@pytest.mark.parametrize(
    ("setting", "parts"),
    [
        ('channels.torque_steel={channel="b"}', ["torque_bronze.channel", "once"]),
        ('channels.torque_steel={channel="A", points=[["1 V","2 kg"]]}', ["2 kg", "N m"]),
        ('channels.torque_steel={channel="A", points=[1]}', ["list of pairs"]),
        ('channels.torque_steel={channel="A", points=[["1 V","1 N m"]]}', ["one voltage"]),
        ('channels.torque_steel={channel="A", poins=[]}', ["did you mean 'points'"]),
        ("channels.torque_steel=3", ["torque_steel"]),
        ("rig.normal_force=3 N", ["rig.platform_mass"]),
        ('sonotrode.frequencies=["2 kHz","1 kHz"]', ["rise"]),
        ('sonotrode.transverse_velocity=["2 mm/s"]', ["one for each of the 6"]),
        ("sonotrode.highest_voltage=-30 V", ["lowest_voltage"]),
        ("reduction.block=0.5 s", ["ten times"]),
    ],
)
def test_a_mistake_in_a_configuration_is_one_line(setting, parts):
    with pytest.raises(InputError) as refused:
        read_case("rig-final", TABLES, [setting])
    text = str(refused.value)
    assert "\n" not in text
    assert all(part in text for part in parts), text


def test_a_date_of_calibration_is_read():
    setting = 'channels.drive_voltage={channel="E", date=2026-01-31}'
    channel = read_case("rig-final", TABLES, [setting])["channels"].drive_voltage
    assert channel.date == datetime.date(2026, 1, 31)


def test_a_calibration_is_the_line_of_least_squares_with_its_covariance():
    rng = np.random.default_rng(1)
    volts = np.linspace(-5.0, 5.0, 11)
    found = []
    for _ in range(2000):
        line = fitted_line(np.column_stack((volts, 0.4 * volts + 0.01 + rng.normal(0, 0.02, 11))))
        low, high, mixed = line.covariance_of_pair(0.1, 1.9)
        found.append((line.of(np.array([0.225, 4.725])), low, high, mixed))
    values = np.array([one[0] for one in found])
    wanted = np.cov(values.T)
    assert np.mean([one[1] for one in found]) == pytest.approx(wanted[0, 0], rel=0.1)
    assert np.mean([one[2] for one in found]) == pytest.approx(wanted[1, 1], rel=0.1)
    assert np.mean([one[3] for one in found]) == pytest.approx(wanted[0, 1], rel=0.15)


def test_without_points_a_signal_is_in_its_own_unit():
    line = fitted_line([])
    assert (line.gain, line.offset, line.gain_deviation) == (1.0, 0.0, 0.0)


def test_a_case_that_does_not_say_it_waits_until_an_encoder_has_counted():
    # A count is right after two of its times at the latest, a filter behind it after five of its.
    gate, lag = (Twin.model_fields[f"encoder_{name}"].default for name in ("gate", "lag"))
    assert Reduction().speed_settling >= 2.0 * gate + 5.0 * lag


def test_a_case_with_a_date_is_written_as_it_was_read():
    given = 'channels.torque_steel={ channel = "A", date = 2019-05-01, "odd key" = 08:30:00 }'
    raw = tomllib.loads(given)
    assert tomllib.loads(written(raw)) == raw
    assert toml(raw["channels"]["torque_steel"]["date"]) == "2019-05-01"


def test_a_report_counts_the_cells_of_a_plan_within_the_cases_own_limits():
    settings = 'plan.frequencies=["500 Hz"]', 'plan.steel_supplies=["28 V"]'
    limits = 'limits.steel_supply="30 V"'
    assert _cells(read_case("rig-final", TABLES, (*settings, limits))) > 0


SHEET = 'channels.torque_steel={channel="A", points=[["0 V","0 N m"],["5 V","2 N m"]], '


@pytest.mark.parametrize(
    ("rest", "parts"),
    [
        ('creep="0.1 %"}', ("torque_steel.creep", "capacity")),
        ("accuracy_class=0.2}", ("torque_steel.accuracy_class", "capacity")),
        ('hysteresis="-1 mN m"}', ("torque_steel.hysteresis", "above zero")),
        ('capacity="0 N m"}', ("torque_steel.capacity", "above zero")),
        ("hysteresis=0.001}", ("torque_steel.hysteresis", "no unit")),
        ("date=2026-02-01, due=2026-01-01}", ("torque_steel.due", "before")),
        ('points_down=["1 V"]}', ("torque_steel.points_down", "pairs")),
    ],
)
def test_a_sheet_that_cannot_be_is_refused_in_a_line(rest, parts):
    with pytest.raises(InputError) as refused:
        read_case("rig-final", TABLES, [SHEET + rest])
    text = str(refused.value)
    assert "\n" not in text
    assert all(part in text for part in parts), text


def test_a_difference_of_temperatures_is_in_kelvin():
    given = 'channels.temperature={channel="T", points=[["0 V","0 degC"],["1 V","100 degC"]], '
    with pytest.raises(InputError, match="it is a difference: give it in K"):
        read_case("rig-final", TABLES, [given + 'uncertainty="0.5 degC"}'])
    channel = read_case("rig-final", TABLES, [given + 'uncertainty="0.5 K"}'])["channels"]
    assert channel.temperature.uncertainty == 0.5


def test_a_class_stands_where_nothing_else_is_told_of_a_sensor():
    def limits(rest):
        case = read_case("rig-final", TABLES, [SHEET + 'capacity="2 N m", ' + rest])
        return dict(case["channels"].torque_steel.line().limits)

    assert limits("accuracy_class=0.2}") == {"class of the sensor": pytest.approx(4e-3)}
    assert limits('accuracy_class=0.2, uncertainty="1 mN m"}') == {}
    assert limits('accuracy_class=0.2, hysteresis="0.1 %", creep="1 mN m"}') == {
        "hysteresis": pytest.approx(1e-3), "creep": pytest.approx(1e-3)
    }  # fmt: skip


def test_points_from_above_tell_the_hysteresis_of_a_sensor():
    # 0.4 N m a volt, and 10 mV more on the way back at 1 N m: 4 mN m.
    points = '[["0 V","0 N m"],["2.5 V","1 N m"],["5 V","2 N m"]]'
    setting = (
        f'channels.torque_steel={{channel="A", points={points}, points_down=[["2.51 V","1 N m"]]}}'
    )
    channel = read_case("rig-final", TABLES, [setting])["channels"].torque_steel
    assert channel.loop() == pytest.approx(4e-3, rel=0.01)
    assert channel.line().degrees_of_freedom == 2.0


def test_a_calibration_is_good_until_its_last_day():
    def last(rest):
        return read_case("rig-final", TABLES, [SHEET + rest])["channels"].torque_steel.last_day

    assert last("date=2026-01-01, valid_days=10}") == datetime.date(2026, 1, 11)
    assert last("date=2026-01-01, due=2026-03-01}") == datetime.date(2026, 3, 1)
    assert last("due=2026-03-01}") == datetime.date(2026, 3, 1)
    assert last('sensor="one"}') is None
