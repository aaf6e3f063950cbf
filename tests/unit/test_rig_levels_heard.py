"""Levels that contradict one another or ``[twin]`` are told, and sound ones are not."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.errors import InputError
from asperity.tribometer.calibration import Line
from asperity.tribometer.options import Twin
from asperity.tribometer.pair import Pair
from asperity.tribometer.reduction import file
from asperity.tribometer.reduction.heard import level
from asperity.tribometer.reduction.heard.finding import Curve
from asperity.tribometer.reduction.heard.material import Level
from asperity.tribometer.tables import TABLES

CASE = read_case("rig-final", TABLES, [])
TWIN = CASE.require(Twin)
PAIR = Pair.from_case(CASE)
TORQUES = (0.36, 0.345), (0.36, 0.27), (0.36, 0.32)


class Rig:
    """Cells in which a motor drives its disc, as `level` looks at them."""

    def __init__(self, volts=3.0, torques=TORQUES, *, case=CASE, known=0.0007):
        self.case, self.pair = case, Pair.from_case(case)
        self.options = SimpleNamespace(speed_settling=3.0)
        lines = dict.fromkeys(("torque_steel", "torque_bronze"), Line(0.4, gain_deviation=known))
        self.blocks = SimpleNamespace(length=0.02, lines=lines)
        torque = np.array(torques)
        drives = PAIR.drives
        load = TWIN.motor_drag + torque / (drives.gear_ratio * TWIN.gear_efficiency)
        current = load / TWIN.motor_constant
        self.of = {
            "torque_steel": torque,
            "torque_bronze": -torque * PAIR.bronze.radius / PAIR.steel.radius,
            "current_steel": current,
            "speed_steel": (volts - TWIN.motor_resistance * current) / TWIN.motor_constant,
        }
        self.windows = [(n, _Window(450, n, 0), _Window(450, n, 1)) for n in range(len(torques))]

    def has(self, *names):
        return all(name in self.of for name in names)

    def level(self, name, window):
        return Level(float(self.of[name][window.cell, window.state]), 2e-4)

    def curve(self, name):
        return Curve(np.zeros(1), np.zeros(1), "time (s)", name)


class _Window(SimpleNamespace):
    def __init__(self, count, cell, state):
        super().__init__(count=count, cell=cell, state=state)


def told(rig):
    return {one.name for one in level.findings(rig)}


@pytest.mark.parametrize("volts", [1.0, 3.0, 5.5])
def test_levels_that_fit_are_not_told(volts):
    rng = np.random.default_rng(5)
    for _ in range(20):
        before = rng.uniform(0.3, 0.6)
        rig = Rig(volts, [(before, before * one) for one in rng.uniform(0.1, 0.95, 3)])
        # Bearings brake, each by up to a tenth of the torque.
        rig.of["torque_steel"] = rig.of["torque_steel"] + rng.uniform(0.0, 0.08) * before
        rig.of["torque_bronze"] = rig.of["torque_bronze"] + rng.uniform(0.0, 0.05) * before
        assert not told(rig)


@pytest.mark.parametrize(
    ("name", "shown", "finding"),
    [
        # a dead band
        ("torque_steel", lambda x: x - 0.11, "torques leave bearings what they cannot hold"),
        # what comes with the motor
        ("torque_steel", lambda x: x - 0.07, "torques leave bearings what they cannot hold"),
        ("torque_steel", lambda x: x + 0.2, "torques leave bearings what they cannot hold"),
        ("torque_bronze", lambda x: x - 0.08, "torques leave bearings what they cannot hold"),
        ("current_steel", lambda x: x + 0.5 * x[0, 0], "current_steel is not what drag"),
        ("current_steel", lambda x: x - 0.4 * x[0, 0], "current_steel is not what drag"),
        # an encoder that slips where it is shaken
        ("speed_steel", lambda x: x * [1.0, 0.8], "speed_steel does not answer as its motor"),
    ],
)
def test_a_level_that_is_off_is_told(name, shown, finding):
    rig = Rig()
    rig.of[name] = shown(rig.of[name])
    assert any(one.startswith(finding) for one in told(rig)), told(rig)


def test_an_encoder_that_slips_in_one_cell_spoils_that():
    rig = Rig()
    rig.of["speed_steel"][1, 1] *= 0.8
    (found,) = level.findings(rig)
    assert (found.index, found.spoils) == (1, True)


def test_a_bronze_torque_that_is_told_of_spoils_nothing_anew():
    rig = Rig()
    rig.of["torque_bronze"] = 0.0 * rig.of["torque_bronze"]
    assert told(rig)
    assert not [*level.findings(rig, {"torque_bronze"})]


@pytest.mark.parametrize(
    ("held", "before", "shaken", "turned"),
    [
        (0.0, 0.36, 0.01, False),
        (0.0, 0.36, -0.001, True),
        (0.03, 0.36, 0.02, True),
        (0.03, 0.36, 0.04, False),
        (0.0, -0.36, -0.01, False),
    ],
)
def test_a_torque_that_vibration_turns_is_told(held, before, shaken, turned):
    rig = SimpleNamespace(rig=SimpleNamespace(bearing_torque_steel=held))
    assert bool([*file._turned(rig, before, shaken)]) is turned


NAMES = "torque_steel", "torque_bronze"


@pytest.mark.parametrize("volts", [1.0, 3.0, 5.5])
def test_what_comes_with_the_motor_is_told_from_what_bearings_are_known_to_hold(volts):
    rig = Rig(volts)
    rig.of["torque_steel"] = rig.of["torque_steel"] + 0.06
    assert not told(rig)
    rig.case = CASE.replace(["rig.bearing_tolerance=0.02"])
    rig.pair = Pair.from_case(rig.case)
    assert told(rig) == {"torques leave bearings what they cannot hold"}


def test_torques_are_as_sure_of_each_other_as_their_calibrations():
    def off(known):
        rig = Rig(known=known)
        rig.of["torque_steel"] = rig.of["torque_steel"] * 0.85
        return told(rig)

    # 0.14 % are told; of nothing told, and of 2 %, less is known than 15 parts of a hundred.
    assert off(0.0007) == {"torques leave bearings what they cannot hold"}
    assert not off(0.0)
    assert not off(0.01)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_rig_that_knows_its_motor_tells_what_comes_into_both_torques(sign):
    rig = Rig()
    for name in NAMES:
        rig.of[name] = rig.of[name] * (1.0 + 0.25 * sign)
    assert not told(rig)
    shares = "motor_tolerance=0.01", "drag_tolerance=0.01", "gear_tolerance=0.02"
    rig.case = CASE.replace([f"twin.{one}" for one in shares])
    assert told(rig) == {"current_steel is not what drag and torque take"}


def test_a_supply_that_is_said_to_give_otherwise_explains_a_speed():
    rig = Rig(5.5)
    rig.of["speed_steel"] = rig.of["speed_steel"] * [1.0, 1.04]
    assert told(rig) == {"speed_steel does not answer as its motor"}
    rig.case = CASE.replace(["twin.supply_tolerance=0.05"])
    assert not told(rig)


@pytest.mark.parametrize("key", ["motor_tolerance", "drag_tolerance", "supply_tolerance"])
def test_a_share_that_is_none_is_refused(key):
    for value in ("1", "-0.1", "nan", "1 V"):
        with pytest.raises(InputError, match=key):
            CASE.replace([f"twin.{key}={value}"])


@pytest.mark.parametrize("shorter", [0, 1])
def test_what_a_pulse_is_worth_goes_by_the_shorter_of_both_windows(monkeypatch, shorter):
    # Windows of 5 s and 23 s, 2 s and 20 s of which the speed has settled; nothing else is unsure.
    rig, sure = Rig(), {"speed_steel": [40.0, 0.0, 40.0, 0.0], "current_steel": [0.5, 0.0] * 2}
    counts = (250, 1150) if shorter == 0 else (1150, 250)
    rig.windows = [(0, *(_Window(count, 0, n) for n, count in enumerate(counts)))]
    monkeypatch.setattr(level, "levels_of", lambda of, name: np.array([sure[name]]))
    exact = TWIN.model_copy(update={"supply_tolerance": 0.0, "motor_tolerance": 0.0})
    pulse = 2.0 * np.pi / PAIR.drives.encoder_pulses / 2.0
    for change, is_told in ((1.9, False), (2.1, True)):
        sure["speed_steel"][2] = 40.0 + change * pulse
        assert bool(list(level._runs(rig, exact))) is is_told
