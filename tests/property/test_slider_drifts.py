"""Marches of bodies that drift sideways, by lot: the mean is held to its ratio, however small.

A body that a fast vibration carries along has little friction left, and takes seconds to lose the
way sideways that it began with. What its march calls settled is where one ten times as long ends,
to 1e-3 of the ratio, or a note says where it goes; further off than 5e-3 it has not settled.
"""

import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve, solve_many
from asperity.slider.batch_fits import fits_batch
from asperity.slider.longer import lasting
from asperity.slider.on_its_way import STILL_GOES

BAR = 1e-3


def body(frequency, velocity, ratio, direction, load, mass, mu, limit, ring, damped):
    """Return a body on a drive; frequencies in Hz, velocity in m/s, angles in degrees."""
    stiffness = mass * (2.0 * math.pi * ring) ** 2
    amplitude = ratio * velocity / (2.0 * math.pi * frequency)
    settings = (
        f"slider.drive_velocity={velocity!r} m/s", f"slider.normal_force={load!r} N",
        f"slider.mass={mass!r} kg", f"slider.drive_stiffness={stiffness!r} N/m",
        "slider.lateral=free", "friction.transfer=1",
        f"slider.drive_damping={2.0 * damped * math.sqrt(stiffness * mass)!r} N s/m",
        f"friction.mu={mu!r}", f"friction.max_deflection={limit * amplitude!r} m",
        "friction.exponent=1", "friction.law=vector", "vibration.start=0 s",
        f"vibration.frequency={frequency!r} Hz", f"vibration.velocity_ratio={ratio!r}",
        f"vibration.direction={direction!r} deg", "solve.method=march",
    )  # fmt: skip
    case = read_case("table-4.4", TABLES, settings)
    return Model.from_case(case.replace_values({"solve.step": None, "solve.duration": None}))


SLOW = body(1600.0, 1e-3, 200.0, 120.0, 4.0, 2.0, 0.4, 0.4, 616.0, 0.07)


def drawn(rng):
    def log(low, high):
        return math.exp(rng.uniform(math.log(low), math.log(high)))

    low = rng.random() < 0.4
    frequency = log(50.0, 400.0) if low else log(400.0, 4000.0)
    return body(
        frequency, log(1e-3, 3e-2), log(8.0, 60.0), rng.uniform(20.0, 160.0), log(1.0, 40.0),
        log(0.2, 4.0), log(0.1, 0.5), log(0.02, 0.8), log(100.0, 1000.0), log(0.02, 0.3),
    )  # fmt: skip


def goes(answer):
    """Return where a mean is said to go, and the duration in s that would do if one is foreseen."""
    said = [each for each in (answer.settled_by, *answer.notes) if each.startswith(STILL_GOES)]
    if not said:
        return None
    words = " ".join((*said, answer.notes[-1])).replace(":", "").replace(",", "").split()
    duration = [b for a, b in zip(words, words[2:], strict=False) if a == "solve.duration"]
    return float(words[words.index("about") + 1]), float(duration[0]) if duration else None


@pytest.mark.slow
def test_a_mean_that_still_goes_further_than_a_thousandth_of_its_ratio_says_where():
    late = solve(lasting(SLOW, 8.0), history=False)
    early = solve(lasting(SLOW, 0.8), history=False)
    assert late.settled
    assert not early.settled
    assert early.step_error is None
    assert early.ratio / late.ratio - 1.0 > 10.0 * BAR
    comes_to, duration = goes(early)
    assert comes_to == pytest.approx(late.ratio, rel=1e-4)
    then = solve(lasting(SLOW, duration), history=False)
    assert then.settled
    assert goes(then) is None
    assert then.ratio == pytest.approx(late.ratio, rel=0.6 * BAR)
    # No longer than needed: what fades leaves half the bar there.
    assert then.ratio > late.ratio * (1.0 + 0.4 * BAR)


@pytest.mark.slow
def test_lanes_say_where_their_means_go_and_go_on_as_a_march_does():
    undamped = body(1600.0, 1e-3, 200.0, 120.0, 4.0, 2.0, 0.4, 0.4, 616.0, 0.0)
    short = lasting(undamped, 0.8)
    assert fits_batch(short)
    alone, together = solve(short, history=False), solve_many([short] * 2)
    assert goes(alone) is not None
    assert [each.notes for each in together] == [alone.notes] * 2
    alone, together = solve(undamped, history=False), solve_many([undamped] * 2)
    assert goes(alone) is None
    assert [each.ratio for each in together] == [alone.ratio] * 2


# Rigid friction under a triangle five times as fast as the drive goes one way as long as the other.
NOTHING = """
[slider]
drive_velocity = "0.24329281207316022 mm/s"
normal_force = "3.4666937200505896 N"
mass = "1.9948181625335144 kg"
drive_stiffness = "446775.17397973605 N/m"
drive_damping = "12.168751323176307 N s/m"
[friction]
model = "coulomb"
mu = 0.10839355564236205
[vibration]
waveform = "triangle"
frequency = "442.72567370365675 Hz"
velocity_ratio = 5.318826933305637
direction = "0 deg"
[solve]
step = "5.6468376434690396 us"
"""


@pytest.mark.parametrize(("duration", "settled"), [(0.81, False), (1.2, True), (1.6, True)])
def test_a_ratio_of_nothing_has_settled_where_it_is_so_to_four_digits(tmp_path, duration, settled):
    """A ring of the drive is left, which fades: 4.3e-4, 3.8e-5 and -3.9e-5 of mu F_N."""
    path = tmp_path / "nothing.toml"
    path.write_text(NOTHING)
    model = Model.from_case(read_case(path, TABLES, ()))
    answer = solve(lasting(model, duration), history=False)
    assert answer.settled is settled
    assert (abs(answer.ratio) < 1e-4) is settled


def untold(seed, members):
    """Return the bodies that are further from where they go than they say."""
    off, went = [], 0
    for n in members:
        model = drawn(np.random.default_rng((*seed, n)))
        answer = solve(model, history=False)
        spent = answer.steps * answer.model.step / answer.model.substeps
        went += spent > 1.01 * model.usual_duration
        if not answer.settled or goes(answer):
            continue
        late = solve(lasting(model, 10.0 * spent), history=False)
        if abs(answer.ratio - late.ratio) > BAR * abs(late.ratio) + 2.0 * answer.step_error:
            off.append((n, spent, answer.ratio, late.ratio))
    return off, went


def test_a_few_bodies_that_drift_are_where_a_longer_march_ends():
    off, _ = untold((1,), range(2))
    assert not off


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_a_few_bodies_that_drift_are_where_a_longer_march_ends")
@pytest.mark.parametrize("part", range(5))
def test_bodies_that_drift_are_where_longer_marches_end(part):
    off, went = untold((2, part), range(20))
    assert not off
    assert went >= 2
