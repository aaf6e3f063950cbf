"""Marches of short durations that are given: what they call settled stays, by lot.

A body rings on its drive, with little damping, near stick or far from it, for few rings and few
cycles. What its march calls settled is where a march of twenty times the duration ends; of the
durations that are said to do all do. Steps are given: none is chosen by its error.
"""

import math
import re
from types import SimpleNamespace

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import AsperityError
from asperity.slider import Model, solve

BAR = 2e-3
MOST_STEPS = 4e6  # of a march


def draw(rng):
    """Return a body by lot, as tables, and the duration of its march in s."""

    def log(low, high):
        return math.exp(rng.uniform(math.log(low), math.log(high)))

    def one(*choices):
        return choices[int(rng.integers(len(choices)))]

    mu, load, mass = log(0.05, 0.5), log(2.0, 200.0), log(0.02, 2.0)
    ring, rings = log(8.0, 800.0), log(1.5, 40.0)
    frequency = ring * min(log(0.5, 50.0), 200.0 / rings)
    angular = 2.0 * math.pi * ring
    duration = max(rings / ring, rng.uniform(3.0, 12.0) / frequency)
    # The drive is taken up in a fiftieth to twice that time.
    velocity = mu * load / (mass * angular**2 * duration * log(0.02, 2.0))
    ratio = one(log(0.3, 10.0), log(0.3, 10.0), rng.uniform(0.9, 1.2))
    model = one("dahl", "dahl", "lugre", "coulomb")
    friction = {"model": model, "mu": mu}
    if model != "coulomb":
        limit = max(1.0, ratio) * velocity / frequency * log(0.02, 0.5)
        friction["max_deflection"] = f"{limit!r} m"
    if model == "dahl":
        friction["exponent"] = one(1.0, 1.0, 0.5, 2.0)
    if model == "lugre" and rng.random() < 0.5:
        friction["static_mu"] = mu * rng.uniform(1.0, 1.5)
        friction["stribeck_velocity"] = f"{velocity * log(0.3, 10.0)!r} m/s"
    damping = 2.0 * mass * angular * one(0.0, log(1e-3, 0.3), log(1e-3, 0.3))
    slider = {
        "drive_velocity": f"{velocity!r} m/s", "normal_force": f"{load!r} N",
        "mass": f"{mass!r} kg", "drive_stiffness": f"{mass * angular**2!r} N/m",
        "drive_damping": f"{damping!r} N s/m", "lateral": one("free", "guided"),
    }  # fmt: skip
    vibration = {
        "waveform": one("sine", "sine", "sine", "triangle"), "frequency": f"{frequency!r} Hz",
        "velocity_ratio": ratio, "direction": f"{one(0.0, 0.0, 90.0, rng.uniform(0, 90))!r} deg",
    }  # fmt: skip
    step = {"step": f"{1.0 / (400.0 * frequency)!r} s"}
    return {"slider": slider, "friction": friction, "vibration": vibration, "solve": step}, duration


def marched(tables, folder, duration):
    lines = []
    for name, table in (
        tables | {"solve": tables["solve"] | {"duration": f"{duration!r} s"}}
    ).items():
        lines.append(f"[{name}]")
        lines += [
            f'{k} = "{v}"' if isinstance(v, str) else f"{k} = {v!r}" for k, v in table.items()
        ]
    path = folder / "short.toml"
    path.write_text("\n".join(lines))
    return solve(Model.from_case(read_case(path, case_tables(), ())), history=False)


def foreseen(answer):
    """Return the duration that is said to do, s; None where none is."""
    said = [note for note in answer.notes if "would do, by the means" in note]
    return float(said[0].split()[3]) if said else None


def mean_of(answer):
    """Return the mean ratio of all cycles: that of a window may have parts of those in it."""
    told = re.search(r"whose mean ratio is ([\d.]+)", answer.settled_by)
    return float(told[1]) if told else answer.ratio


def short_marches(seed, members, folder):
    """Return what is called settled and is not, and of how many durations foreseen how many fail.

    A body whose march twenty times as long has not settled may have nowhere to go: what it was
    foreseen is not counted.
    """
    off, tried, failed = [], 0, []
    for n in members:
        tables, duration = draw(np.random.default_rng((*seed, n)))
        try:
            answer = marched(tables, folder, duration)
            rate, longer = answer.steps / duration, foreseen(answer)
            if 20.0 * duration * rate > MOST_STEPS:
                continue
            if longer and 4.0 * longer * rate > MOST_STEPS:
                longer = None
            late = marched(tables, folder, max(20.0 * duration, 4.0 * (longer or 0.0)))
            then = marched(tables, folder, longer) if longer else None
        except AsperityError:
            continue
        for each in (answer, late, then):
            # The words tell no mean that the number is far from.
            if each and each.settled and abs(each.ratio - mean_of(each)) > BAR:
                off.append((n, each.ratio, mean_of(each)))
            if each and each.settled and late.settled and abs(mean_of(each) - mean_of(late)) > BAR:
                off.append((n, each.ratio, late.ratio))
        if then and late.settled:
            tried += 1
            if not then.settled or abs(mean_of(then) - mean_of(late)) > BAR:
                failed.append((n, longer, then.ratio, late.ratio, then.settled_by))
    return off, tried, failed


def test_a_few_short_marches_are_judged_as_longer_ones_show(tmp_path):
    off, tried, failed = short_marches((1, 16), range(3), tmp_path)
    assert not off
    assert not failed
    assert tried == 3


def test_a_ratio_far_from_the_mean_that_its_words_tell_is_seen(tmp_path, monkeypatch):
    said = "the motion repeats itself after 2 cycles, whose mean ratio is 0.51"
    told = SimpleNamespace(settled=True, settled_by=said, ratio=0.5, steps=1000, notes=())
    monkeypatch.setitem(globals(), "marched", lambda *_: told)
    assert short_marches((1, 16), [0], tmp_path)[0]
    told.ratio = 0.5099
    assert not short_marches((1, 16), [0], tmp_path)[0]


@pytest.mark.ordinary(2)
@pytest.mark.parametrize(
    ("part", "member"),
    [(1, 0), (4, 8), (6, 27), (2, 1), (1, 8), (9, 37), (3, 23), (5, 35), (9, 11), (8, 10)],
)
def test_durations_said_to_do_that_did_not_do_now(tmp_path, part, member):
    """A ring that its damper alone damps, and motions that repeat themselves after two cycles.

    A ring that goes to a ratio of nothing, asperities that bend far, a mean that follows a ring by
    its square, a swing from cycle to cycle, a window that begins in a cycle, and a motion that has
    first to leave a state that is unstable. And a ring beside asperities that come to their limit.
    """
    off, tried, failed = short_marches((2, part), [member], tmp_path)
    assert (off, tried, failed) == ([], 1, [])


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_few_short_marches_are_judged_as_longer_ones_show")
@pytest.mark.parametrize("part", range(10))
def test_short_marches_are_judged_as_longer_ones_show(tmp_path, part):
    off, tried, failed = short_marches((2, part), range(40), tmp_path)
    assert not off
    assert tried >= 10
    assert not failed
