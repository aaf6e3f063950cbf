"""Steps that an encoder's counter makes tell the scale of a speed, and noise tells none."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.tribometer.pair import Pair
from asperity.tribometer.reduction.drive_signal import Stretch
from asperity.tribometer.reduction.heard import pulses
from asperity.tribometer.reduction.heard.finding import Curve
from asperity.tribometer.tables import TABLES

LENGTH, LAG = 0.02, 0.2


def rig(shown, *settings):
    """What `pulses` looks at: two cells of one signal, in blocks."""
    case = read_case("rig-final", TABLES, settings)
    blocks = SimpleNamespace(
        means={"speed_bronze": shown}, lost={"speed_bronze": np.zeros(shown.size, bool)},
        length=LENGTH, count=shown.size,
        at_least=lambda seconds: int(np.ceil(seconds / LENGTH - 1e-9)),
    )  # fmt: skip
    part = shown.size // 4
    stretches = [Stretch(n * part + 5, (n + 1) * part) for n in range(4)]
    return SimpleNamespace(
        case=case, pair=Pair.from_case(case), blocks=blocks,
        options=SimpleNamespace(speed_settling=3.0, settling=1.0),
        windows=[(0, *stretches[:2]), (1, *stretches[2:])],
        has=lambda name: name in blocks.means,
        curve=lambda name: Curve(np.zeros(1), np.zeros(1), "time (s)", name),
    )  # fmt: skip


def shown_by(each_turn, gate, seed, *, noise=0.02, counts=True):
    """A motor's speed of some 7 rad/s that wanders, as its counter and a filter show it."""
    rng = np.random.default_rng(seed)
    seconds, fine = 60.0, 2e-3
    time = np.arange(0.0, seconds, fine)
    speed = 7.1 + 0.05 * np.sin(0.7 * time) + 0.03 * rng.standard_normal(time.size)
    if counts:
        each = round(gate / fine)
        turns = np.floor(np.cumsum(speed)[each - 1 :: each] * fine * each_turn / (2.0 * np.pi))
        speed = np.repeat(np.diff(turns, prepend=0.0) * 2.0 * np.pi / each_turn / gate, each)
    keep = np.exp(-fine / LAG)
    late = np.empty(speed.size)
    last = speed[0]
    for n, value in enumerate(speed):
        late[n] = last = keep * last + (1.0 - keep) * value
    part = round(LENGTH / fine)
    means = late[: late.size // part * part].reshape(-1, part).mean(axis=1)
    return means + noise * rng.standard_normal(means.size)


@pytest.mark.parametrize("seed", range(4))
def test_a_count_of_its_own_pulses_is_not_told(seed):
    assert [*pulses.findings(rig(shown_by(32, 1.0, seed)))] == []
    told = "drives.encoder_pulses=100", "twin.encoder_gate=0.8 s"
    assert [*pulses.findings(rig(shown_by(100, 0.8, seed, noise=5e-3), *told))] == []


@pytest.mark.ordinary(9)
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("gain", [0.5, 0.7, 0.8, 1.3, 1.5, 1.7])
def test_another_scale_is_told_by_its_steps(gain, seed):
    (found,) = pulses.findings(rig(gain * shown_by(32, 1.0, seed)))
    assert found.spoils
    step = float(found.evidence.split("steps of ")[1].split()[0])
    assert step == pytest.approx(gain * 2.0 * np.pi / 32.0, rel=0.08)


@pytest.mark.parametrize("seed", range(4))
def test_a_speed_that_is_not_counted_or_is_noisy_tells_nothing(seed):
    assert [*pulses.findings(rig(1.5 * shown_by(32, 1.0, seed, counts=False)))] == []
    assert [*pulses.findings(rig(1.5 * shown_by(32, 1.0, seed, noise=0.5)))] == []
    # Behind a filter as slow as the count nothing is shown before the next one.
    slow = rig(1.5 * shown_by(32, 1.0, seed), "twin.encoder_lag=0.5 s")
    assert [*pulses.findings(slow)] == []


def test_a_disc_that_turns_evenly_tells_nothing():
    assert [*pulses.findings(rig(np.full(3000, 7.1)))] == []
    assert [*pulses.findings(rig(np.zeros(3000)))] == []
    assert [*pulses.findings(rig(np.full(40, 7.1)))] == []


def test_steps_are_told_among_others_and_noise_tells_none():
    rng = np.random.default_rng(3)
    steps = 0.4 * rng.integers(-2, 3, 60) + 0.01 * rng.standard_normal(60)
    assert pulses.step_of(steps) == pytest.approx(0.4, rel=0.02)
    for _ in range(50):
        assert pulses.step_of(rng.standard_normal(60)) is None
        assert pulses.step_of(rng.uniform(-1.0, 1.0, 60)) is None
