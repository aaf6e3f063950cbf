"""The picture of a signal's tones is of the window that vibrates, and loses none of them."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.tribometer.reduction.heard import spectrum

INTERVAL, SAMPLES = 1e-4, 500
SHAKEN = SimpleNamespace(first=8, last=24)


def picture(monkeypatch, tones, *, first=SHAKEN.first, last=SHAKEN.last):
    """Tones (Hz, peak) that sound from one block to another, among others before and behind."""
    time = np.arange(32 * SAMPLES) * INTERVAL
    values = np.sin(2.0 * np.pi * 777.0 * time)
    within = slice(first * SAMPLES, last * SAMPLES)
    values[within] = sum(peak * np.sin(2.0 * np.pi * hz * time[within]) for hz, peak in tones)
    monkeypatch.setattr(
        spectrum, "lines_of",
        lambda recording, channels: {"torque_steel": (4.0, SimpleNamespace(of=lambda x: 0.5 * x))},
    )  # fmt: skip
    tone = SimpleNamespace(frequency=tones[0][0])
    of = SimpleNamespace(
        segments=[None, SimpleNamespace(shaken=SHAKEN, tone=tone)],
        blocks=SimpleNamespace(samples=SAMPLES),
        recording=SimpleNamespace(
            values=lambda signal, start, stop: values[start:stop], sample_interval=INTERVAL
        ),
        case=SimpleNamespace(require=lambda table: None),
    )  # fmt: skip
    return spectrum.spectrum_of(of, 1, "torque_steel")


def test_tones_stand_where_they_are_with_their_peaks(monkeypatch):
    found = picture(monkeypatch, [(50.0, 0.3), (150.0, 0.1)])
    # A point is as wide as the lines that fall on it.
    wide = found.x[1] - found.x[0]
    for hz, peak in ((50.0, 0.3), (150.0, 0.1)):
        near = np.abs(found.x - hz) <= 2.0 * wide
        assert found.y[near].max() == pytest.approx(2.0 * peak, rel=1e-3)
        assert abs(found.x[np.argmax(np.where(near, found.y, 0.0))] - hz) <= wide
    quiet = np.abs(found.x[:, None] - [50.0, 150.0]).min(axis=1) > 4.0 * wide
    assert found.y[quiet].max() < 1e-3
    # Up to eight times the tone, in some 240 points, and the tone's own range marked.
    assert found.x[-1] == pytest.approx(8.0 * 50.0, abs=2.0 * wide)
    assert 120 < found.x.size <= 240
    ((low, high),) = found.marked
    assert (low, high) == pytest.approx((50.0 - 2.0 * wide, 50.0 + 2.0 * wide))


@pytest.mark.parametrize(("first", "last"), [(8, 22), (10, 24)])
def test_what_sounds_outside_of_the_window_is_not_in_it(monkeypatch, first, last):
    whole = picture(monkeypatch, [(120.0, 0.2)])
    part = picture(monkeypatch, [(120.0, 0.2)], first=first, last=last)
    high = np.abs(whole.x - 777.0) < 20.0
    assert whole.y[high].max() < 1e-3 < part.y[high].max()


def test_nothing_is_drawn_of_a_window_without_a_tone(monkeypatch):
    monkeypatch.setattr(spectrum.drive_signal.Spectrum, "of", lambda *_: None)
    found = picture(monkeypatch, [(50.0, 0.3)])
    assert not found.y.any()
