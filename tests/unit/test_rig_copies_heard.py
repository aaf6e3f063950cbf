"""Channels that hear one sensor are told by their noise, whatever their gains."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.tribometer.reduction.heard import moving


def told(counts):
    """Findings of channels a, b and so on, of these counts."""
    window = SimpleNamespace(first=0, last=len(counts) // 10)
    of = SimpleNamespace(
        recording=SimpleNamespace(
            sources=[SimpleNamespace(signal="abcdef"[n]) for n in range(counts.shape[1])],
            part=lambda first, last: counts[first:last],
        ),
        windows=[(0, window, window)], blocks=SimpleNamespace(samples=10),
        around=lambda index: index, curve=lambda signal, part: signal,
    )  # fmt: skip
    return list(moving._copies(of))


@pytest.mark.parametrize("gain", [1.0, 0.3, -20.0])
def test_a_copy_is_told_by_the_correlation_of_its_noise_and_two_sensors_are_not(gain):
    rng = np.random.default_rng(3)
    noise, mains = rng.normal(0.0, 30.0, (5000, 3)), 500.0 * np.sin(0.02 * np.arange(5000))
    own, other = noise[:, 0] + mains, noise[:, 1] + mains
    assert not told(np.round(np.column_stack((own, other))))
    # What is added is a tenth of the noise: correlated as 1 / sqrt(1 + 0.01).
    again = gain * (own + 0.1 * noise[:, 2])
    (found,) = told(np.column_stack((own, other, again)))
    assert found.name == "c is a copy of a"
    assert found.signals == ("a", "c")
    correlation = float(found.evidence.rpartition(" ")[2])
    assert correlation == pytest.approx(np.copysign(0.995, gain), abs=1.5e-3)
