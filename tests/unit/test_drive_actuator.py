"""The piezo actuator against its equivalent circuit, solved as a circuit."""

import math

import numpy as np
import pytest

from asperity.drive.actuator import demand, elastic_energy, system_efficiency
from asperity.errors import InputError

GIVEN = {"coupling": 0.3, "quality_factor": 500.0, "efficiency": 0.9}


def circuit(capacity, motional, inductance, resistance, frequency, velocity_charge):
    """Real and apparent power at the terminals for a peak charge through the motional branch."""
    w = 2.0 * math.pi * frequency
    current = w * velocity_charge
    branch = resistance + 1j * (w * inductance - 1.0 / (w * motional))
    voltage = current * branch
    total = current + 1j * w * capacity * voltage
    power = 0.5 * voltage * np.conj(total)
    return power.real, abs(power)


@pytest.mark.parametrize("ratio", [0.05, 0.7, 0.99, 1.0, 1.01, 1.4])
@pytest.mark.parametrize("load", [0.0, 5.0, 400.0])
def test_powers_are_those_of_the_circuit_at_its_terminals(ratio, load):
    k, quality, frequency, charge = 0.3, 500.0, 20e3, 4e-5
    motional = 1e-9
    resonance = 2.0 * math.pi * frequency / ratio
    inductance = 1.0 / (resonance**2 * motional)
    own = 1.0 / (resonance * motional * quality)
    more = load / (0.5 * (2.0 * math.pi * frequency * charge) ** 2)
    real, apparent = circuit(
        motional * (1.0 / k**2 - 1.0), motional, inductance, own + more, frequency, charge
    )
    energy = 0.5 * charge**2 / motional
    found = demand(load, energy, frequency, **GIVEN, frequency_ratio=ratio)
    assert 0.9 * found.electrical_power == pytest.approx(real, rel=1e-9)
    assert found.apparent_power == pytest.approx(apparent, rel=1e-9)


def test_far_below_resonance_the_swing_over_the_coupling_squared_is_apparent():
    found = demand(0.0, 0.1, 500.0, **GIVEN, frequency_ratio=0.0)
    assert found.apparent_power == pytest.approx(2.0 * math.pi * 500.0 * 0.1 / 0.09, rel=1e-12)
    assert found.electrical_power == 0.0


def test_at_resonance_a_loaded_actuator_takes_hardly_more_than_real_power():
    energy = elastic_energy(0.5, 2.0, 1.0)
    found = demand(300.0, energy, 20e3, **GIVEN)
    d = (300.0 + found.own_loss) / (2.0 * math.pi * 20e3 * energy)
    expected = (300.0 + found.own_loss) * math.sqrt(1.0 + (d * (1.0 / 0.09 - 1.0)) ** 2)
    assert found.apparent_power == pytest.approx(expected, rel=1e-12)
    assert 300.0 + found.own_loss > 0.99 * found.apparent_power


def test_an_unloaded_resonator_loses_its_swing_over_its_quality_factor():
    energy = elastic_energy(0.5, 2.0, 1.0)
    assert energy == 1.0
    found = demand(0.0, energy, 20e3, **GIVEN)
    assert found.own_loss == pytest.approx(2.0 * math.pi * 20e3 / 500.0)


def test_what_the_gearset_gives_back_is_not_counted_as_gain():
    found = demand(-1e6, 1.0, 20e3, **GIVEN)
    assert found.electrical_power == 0.0
    assert found.apparent_power > 0.0


def test_the_system_s_efficiency_counts_both_inputs():
    assert system_efficiency(600.0, 700.0, 100.0) == 0.75
    assert system_efficiency(600.0, 700.0, 100.0, 400.0) == 0.5


@pytest.mark.parametrize(
    ("key", "value", "allowed"),
    [
        ("coupling", 1.0, "above 0 and below 1"),
        ("quality_factor", 0.0, "above 0"),
        ("efficiency", 1.1, "above 0 and at most 1"),
    ],
)
def test_an_impossible_actuator_is_refused_in_one_line(key, value, allowed):
    with pytest.raises(InputError, match=f"actuator.{key} is {value:g}; it must be {allowed}"):
        demand(1.0, 1.0, 1.0, **{**GIVEN, key: value})
    with pytest.raises(InputError, match="power put in"):
        system_efficiency(1.0, -1.0)
