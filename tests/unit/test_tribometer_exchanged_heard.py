"""Speeds on each other's channel are told by the supplies that their motors would need."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.tribometer.reduction.heard import motors

CONSTANT, RESISTANCE = 0.05, 2.0  # V s/rad, ohm
TURNS = {"steel": 60.0, "bronze": 20.0}  # rad/s
AMPERES = {"steel": 0.5, "bronze": 0.25}
VOLTS = {disc: CONSTANT * TURNS[disc] + RESISTANCE * AMPERES[disc] for disc in TURNS}


def told(monkeypatch, gains, *, exchanged):
    """Findings of two speeds whose sensors give 1 V each so many rad/s."""
    discs = ("bronze", "steel") if exchanged else ("steel", "bronze")
    # What a channel shows: its own rad/s a volt of the sensor that is on it.
    middles = {
        f"speed_{own}": abs(TURNS[of] / gains[of] * gains[own])
        for own, of in zip(("steel", "bronze"), discs, strict=True)
    } | {f"current_{disc}": AMPERES[disc] for disc in TURNS}
    monkeypatch.setattr(motors, "_middle", lambda of, name: (middles[name], 0.0))
    twin = SimpleNamespace(motor_constant=CONSTANT, motor_resistance=RESISTANCE)
    of = SimpleNamespace(
        case=SimpleNamespace(get=lambda _: twin), has=lambda *_: True, curve=lambda *_: None,
        segments=[SimpleNamespace(start=0.0)], windows=[(0,)],
        supply=lambda disc, time: VOLTS[disc],
        blocks=SimpleNamespace(
            lines={f"speed_{disc}": SimpleNamespace(gain=gains[disc]) for disc in TURNS}
        ),
    )  # fmt: skip
    return list(motors._other_way_round(of))


@pytest.mark.parametrize("ratio", [0.4, 1.0, -1.0, 1.2])
def test_exchanged_speeds_fit_on_the_other_s_channel_whatever_its_gain(monkeypatch, ratio):
    gains = {"steel": 12.0 * ratio, "bronze": 12.0}
    assert not told(monkeypatch, gains, exchanged=False)
    (found,) = told(monkeypatch, gains, exchanged=True)
    shown = CONSTANT * 20.0 * abs(ratio) + 1.0, CONSTANT * 60.0 / abs(ratio) + 0.5
    assert found.evidence == (
        f"with their currents and [twin] they are {shown[0]:.3g} V of 4 V and {shown[1]:.3g} V "
        "of 1.5 V, on each other's channel 4 V and 1.5 V"
    )


def test_an_answer_on_the_bronze_disc_s_channel_is_shown_where_it_is_and_in_its_volts(monkeypatch):
    # Vibration takes 0.4 and 0.2 N m off; the current that should follow hardly does.
    levels = {
        "torque_steel": [[1.0, 1e-3, 0.6, 1e-3], [1.0, 1e-3, 0.8, 1e-3]],
        "current_steel": [[0.5, 1e-4, 0.5, 1e-4], [0.5, 1e-4, 0.5, 1e-4]],
        "current_bronze": [[0.25, 1e-4, 0.20, 1e-4], [0.25, 1e-4, 0.22, 1e-4]],
    }
    monkeypatch.setattr(motors, "levels_of", lambda of, name: np.array(levels[name]))
    lines = {"current_steel": SimpleNamespace(gain=-2.0), "current_bronze": SimpleNamespace(gain=4)}
    of = SimpleNamespace(
        has=lambda *_: True, curve=lambda name: name, blocks=SimpleNamespace(lines=lines)
    )
    (found,) = motors._exchanged(of, "current")
    # (0.4 * 0.05 + 0.2 * 0.03) / (0.4 + 0.2) A at 4 A/V.
    assert found.evidence.startswith("current_bronze answers the vibration by 11 mV, current_steel")
    assert found.signals == ("current_steel", "current_bronze")
    assert found.curve == "current_bronze"
