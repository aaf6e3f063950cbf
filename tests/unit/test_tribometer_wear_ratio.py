"""By how much vibration changes wear is told between runs of one condition, with its interval."""

from types import SimpleNamespace

import pytest

from asperity.tribometer.reduction.wear_result import ratios


def run(value, low, high, *, frequency=0.0, disc="bronze", path=None, shaken=0.0):
    rate = None if value is None else SimpleNamespace(value=value, low=low, high=high)
    return SimpleNamespace(
        condition=(disc, "axial", "dry"), disc=disc, mode="axial", frequency=frequency,
        wear_rate_by_distance=rate, distance=200.0, shaken_distance=shaken, path=path,
    )  # fmt: skip


def test_a_ratio_is_as_unsure_as_both_rates_are():
    still = run(4.0, 3.88, 4.12)
    shaken = run(8.0, 7.2, 8.8, frequency=3000.0, path=700.0, shaken=150.0)
    (told,) = ratios([shaken, still])
    # 10 % and 3 %: the root of the sum of squares of a ratio of two.
    assert "3000 Hz axial" in told
    assert "75 % of it shaken" in told
    assert "2 (1.79 to 2.21) times the wear" in told
    assert told.endswith("on 3.5 times the path")
    (told,) = ratios([still, run(1.0, 0.9, 1.1, frequency=500.0, shaken=200.0)])
    assert "0.25 (0.224 to 0.276) times the wear" in told
    assert "path" not in told


@pytest.mark.parametrize(
    "other",
    [
        run(4.0, 3.9, 4.1, disc="steel"),
        run(None, 0.0, 0.0),
        run(4.0, 0.0, 8.0),
        run(4.0, -1.0, 9.0),
    ],
    ids=["another disc", "no rate", "perhaps none", "perhaps less than none"],
)
def test_nothing_is_told_where_nothing_can_be_divided_by(other):
    shaken = run(8.0, 7.2, 8.8, frequency=3000.0)
    assert not list(ratios([other, shaken]))
    assert not list(ratios([shaken]))
