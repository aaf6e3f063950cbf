"""A torque that steps within a window is told where it does so for sure, however large it is."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.tribometer.reduction.heard import drive

EVERY, GROUPS = 5, 32


def told(step, *, noise=0.0, bend=0.0, size=1.0, at=12, change=1.0, window="shaken"):
    rng = np.random.default_rng(11)
    count = EVERY * GROUPS
    place = np.arange(count) // EVERY
    course = 5.0 + noise * np.sqrt(EVERY) * rng.standard_normal(count)
    course += bend * (place / GROUPS - 0.5) ** 2 + np.where(place >= at, step, 0.0)
    still = 5.0 + 1e-4 * rng.standard_normal(count)
    means = np.concatenate([course, still] if window == "before" else [still, course])
    parts = SimpleNamespace(first=0, last=count), SimpleNamespace(first=count, last=2 * count)
    levels = {0: 5.0 * size, count: (5.0 + change) * size}
    of = SimpleNamespace(
        segments=[SimpleNamespace(before=parts[0], shaken=parts[1], start=count * 0.05)],
        level=lambda signal, part: SimpleNamespace(value=levels[part.first]),
        blocks=SimpleNamespace(length=0.05, means={"torque_steel": size * means}),
        curve=lambda *_, **__: None, around=lambda place: None,
    )  # fmt: skip
    return list(drive._late(of, 0))


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
@pytest.mark.parametrize("window", ["before", "shaken"])
@pytest.mark.parametrize("step", [-0.5, 0.5])
def test_a_step_is_told_with_its_height_and_its_moment(step, window, size):
    (found,) = told(step, noise=0.02, size=size, window=window)
    count = EVERY * GROUPS
    first = 0 if window == "before" else count
    moment = (first + 12 * EVERY) * 0.05
    assert f"at {moment:.1f} s, {moment - count * 0.05:.1f} s after" in found.evidence
    assert float(found.evidence.split()[1]) == pytest.approx(step * size, rel=0.05)
    assert f"of a change of {size:.2g} N m" in found.evidence


@pytest.mark.parametrize("size", [1e-3, 1.0, 1e3])
def test_what_is_small_unsure_or_bends_is_no_step(size):
    assert not told(0.29, size=size, noise=0.001)
    assert told(0.31, size=size, noise=0.001)
    assert not told(0.5, size=size, noise=0.001, change=2.0)
    assert not told(0.5, size=size, noise=0.25)
    assert not told(0.0, size=size, bend=4.0, noise=0.01)
    # Nor is one at the very end of a window.
    assert not told(0.5, size=size, noise=0.001, at=GROUPS - 1)
