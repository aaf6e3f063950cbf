"""Intervals of reduced torques hold the truth as often as they say, whatever lies on the torque."""

import numpy as np
import pytest
from apparatus.rig_signals import RATIOS, Imperfections, run_of, stream

from asperity.tribometer.reduction.levels import estimate_levels

BLOCK = 0.1  # s: means over it are what the levels are estimated from
# Noise of a block, noise that lasts, for how long, run-out of each disc, drift an hour, loss while
# the rig warms; the supply.
NOISES = {
    "white": (1.2e-3, 0.0, 0.2, 0.0, 0.0, 0.0, 1.0),
    "white, run-out 3 %": (1.2e-3, 0.0, 0.2, 0.03, 0.1, 0.0, 1.0),
    "coloured": (0.5e-3, 4e-3, 0.2, 0.0, 0.0, 0.0, 1.0),
    "run-out 1 %": (0.5e-3, 4e-3, 0.2, 0.01, 0.1, 0.0, 1.0),
    "run-out 3 %, warming": (0.5e-3, 4e-3, 0.2, 0.03, 0.1, 0.01, 1.0),
    "lasting, run-out 1 %": (0.5e-3, 4e-3, 1.0, 0.01, 0.1, 0.0, 1.0),
    "3 V, run-out 3 %": (0.5e-3, 4e-3, 0.2, 0.03, 0.1, 0.0, 3.0),
    "5.5 V, run-out 3 %": (0.5e-3, 4e-3, 0.2, 0.03, 0.1, 0.0, 5.5),
}


def levels(noise, seed):
    """Levels of a simulated file of six frequencies, by means over blocks."""
    white, coloured, memory, runout, drift, warming, volts = noise
    rig = Imperfections(
        white=white,
        coloured=coloured,
        noise_time=memory,
        runout_steel=runout,
        runout_bronze=runout,
        drift=drift,
        warming=warming,
    )
    parts = list(stream(run_of(volts), rig, BLOCK, np.random.default_rng(seed)))
    torque, steel, bronze = (
        np.concatenate([part[name] for part in parts])
        for name in ("torque_steel", "speed_steel", "speed_bronze")
    )
    turned = [
        (np.cumsum(speed) - 0.5 * speed) * BLOCK / ratio
        for speed, ratio in ((steel, 30.0), (bronze, 60.0))
    ]
    times = BLOCK * (np.arange(torque.size) + 0.5)
    kept, window = [], []
    for place in range(2 * len(RATIOS)):
        begin = round((30.0 * (place // 2) + 10.0 * (place % 2) + 1.0) / BLOCK)
        kept += range(begin, begin + round(9.0 / BLOCK))
        window += [place] * round(9.0 / BLOCK)
    return estimate_levels(
        times[kept],
        torque[kept],
        (turned[0][kept], turned[1][kept]),
        np.array(window),
        [False, True] * len(RATIOS),
    )


def covered(noise, seeds):
    """Share of the intervals that hold the truth, and the mean error in points."""
    held, errors = [], []
    for seed in seeds:
        found = levels(noise, seed)
        for place, ratio in enumerate(RATIOS):
            change, low, high, _ = found.change(2 * place, 2 * place + 1, 0.95)
            held.append(low <= ratio - 1.0 <= high)
            errors.append(100.0 * (change - ratio + 1.0))
    return np.mean(held), np.mean(errors)


def test_intervals_cover_and_do_not_lean():
    shares = []
    for place, noise in enumerate(NOISES.values()):
        share, error = covered(noise, range(100 * place, 100 * place + 3))
        shares.append(share)
        assert abs(error) < 0.3
    # 144 intervals, some of one file: 0.95 with a deviation of about 0.03.
    assert 0.86 <= np.mean(shares) <= 1.0


@pytest.mark.slow
@pytest.mark.parametrize("name", NOISES)
def test_intervals_of_a_thousand_files_cover_in_92_to_97_percent(name):
    # 125 files of each of eight kinds of noise.
    share, error = covered(NOISES[name], range(125))
    assert 0.92 <= share <= 0.97
    assert abs(error) < 0.05


def test_run_out_is_found_where_turns_are_seen():
    found = levels((0.5e-3, 1e-3, 0.2, 0.03, 0.0, 0.0, 5.5), 1)
    assert found.runout[0] == pytest.approx(0.03, abs=0.003)
    assert found.runout[1] == pytest.approx(0.03, abs=0.006)


def test_drift_is_not_taken_for_an_effect_of_vibration():
    found = levels((0.5e-3, 1e-3, 0.2, 0.0, 2.0, 0.0, 1.0), 1)
    assert found.drift == pytest.approx(2.0 * 170.0 / 3600.0, rel=0.15)
    for place, ratio in enumerate(RATIOS):
        assert found.change(2 * place, 2 * place + 1, 0.95)[0] == pytest.approx(ratio - 1, abs=4e-3)
