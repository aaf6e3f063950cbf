"""A wheel that does not turn as its teeth have it is told, beyond what its encoder can tell."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.tribometer.reduction.heard import motors

RATIO = 20.5


def told(monkeypatch, worm, wheel, *, step=0.0, gain=1.0):
    """Findings of a worm's and a wheel's speeds in three windows; the middle counts."""
    values = {"speed_steel": worm, "speed_bronze": wheel}
    monkeypatch.setattr(
        motors, "levels_of",
        lambda of, name: np.array([[values[name] + d, 1e-3 + d] for d in (-2.0, 0.0, 9.0)]),
    )  # fmt: skip
    monkeypatch.setattr(motors, "least_of", lambda name: 0.5)
    monkeypatch.setattr(motors, "_encoder_step", lambda of, name: step)
    of = SimpleNamespace(
        pair=SimpleNamespace(wheel_speed=lambda speed: speed / RATIO), curve=lambda *_: None,
        blocks=SimpleNamespace(lines={"speed_bronze": SimpleNamespace(gain=gain)}),
    )  # fmt: skip
    return list(motors._teeth(of))


@pytest.mark.parametrize("sense", [-1.0, 1.0])
@pytest.mark.parametrize(
    ("off", "finds"), [(0.0, False), (0.049, False), (-0.049, False), (0.051, True), (-0.051, True)]
)
def test_a_twentieth_off_is_told(monkeypatch, sense, off, finds):
    found = told(monkeypatch, sense * 41.0, sense * 2.0 * (1.0 + off))
    assert len(found) == finds
    if finds:
        assert f"{sense * 2.0 * (1.0 + off):.3g} rad/s" in found[0].evidence
        assert f"{sense * 2.0:.3g} of the worm" in found[0].evidence


@pytest.mark.parametrize(("gain", "finds"), [(0.5, True), (-1.5, False), (1.5, False)])
def test_half_a_step_of_the_encoder_is_no_finding(monkeypatch, gain, finds):
    # 0.25 off, of which 0.1 is allowed; half a step is 0.1 by its gain.
    assert bool(told(monkeypatch, 41.0, 2.24, step=0.2, gain=gain)) is finds


def test_a_worm_that_hardly_turns_tells_nothing(monkeypatch):
    assert not told(monkeypatch, 0.49, 3.0)
    assert told(monkeypatch, 0.51, 3.0)
    assert told(monkeypatch, -0.51, 3.0)


def test_a_signal_is_below_nothing_where_it_is_so_for_sure(monkeypatch):
    monkeypatch.setattr(motors, "least_of", lambda name: 0.3)
    for value, error, below in (
        (-0.31, 0.0, True), (-0.29, 0.0, False), (-0.9, 0.17, True), (-0.9, 0.19, False),
        (0.9, 0.0, False),
    ):  # fmt: skip
        monkeypatch.setattr(motors, "_middle", lambda of, name, v=value, e=error: (v, e))
        assert motors._below(None, "torque_steel") is below
