"""A periodic state that does not stay, on a soft drive whose friction falls: where rest leads to.

LuGre friction as Canudas de Wit et al. (1995) have it, on a base that vibrates, from rest by
another integrator.
"""

import dataclasses
import functools
import re

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from asperity.casefile import read_case
from asperity.runs import Run
from asperity.slider import TABLES, Model, slide, solve, solve_many, step_error
from asperity.slider.march import March
from asperity.slider.on_its_way import still_goes
from asperity.sweep import branches, read_grid
from asperity.sweep import run as sweep
from asperity.sweep.plots import plot_sweep
from asperity.tribometer.fit import forward
from asperity.tribometer.reduction import prediction

MASS, SPRING, LOAD, MU, STATIC = 0.1, 1e5, 10.0, 0.1, 0.15
SPEED, STRIBECK, BENDS, FREQUENCY = 1e-3, 1e-3, 2e-7, 600.0
SOFT = f"""
[slider]
mass = "{MASS} kg"
drive_velocity = "{SPEED} m/s"
drive_stiffness = "{SPRING} N/m"
normal_force = "{LOAD} N"
[friction]
model = "lugre"
mu = {MU}
static_mu = {STATIC}
stribeck_velocity = "{STRIBECK} m/s"
max_deflection = "{BENDS} m"
[vibration]
frequency = "{FREQUENCY} Hz"
velocity_ratio = 1.0
[solve]
method = "periodic"
"""


@pytest.fixture(scope="module")
def soft(tmp_path_factory):
    path = tmp_path_factory.mktemp("soft") / "soft.toml"
    path.write_text(SOFT)
    return path


def body(path, *settings):
    return Model.from_case(read_case(path, TABLES, settings))


@functools.cache
def answered(path, *settings):
    return solve(body(path, *settings), history=False)


def ratio_alone(settle, judged):
    """Mean friction over mu N of cycles after others from rest, by another integrator."""
    asperities, turn = MU * LOAD / BENDS, 2.0 * np.pi * FREQUENCY

    def rates(t, state):
        stretch, v, z, _ = state
        slip = v - SPEED * np.cos(turn * t)
        limit = LOAD * (MU + (STATIC - MU) * np.exp(-((slip / STRIBECK) ** 2)))
        force = asperities * z
        return [SPEED - v, (SPRING * stretch - force) / MASS, slip - abs(slip) * force / limit,
                force]  # fmt: skip

    ends = np.array([settle, settle + judged]) / FREQUENCY
    answer = solve_ivp(
        rates, (0.0, ends[1]), np.zeros(4), method="LSODA", rtol=1e-9, atol=1e-13, t_eval=ends
    )
    impulse = np.diff(answer.y[3])[0]
    return float(impulse / (ends[1] - ends[0]) / (MU * LOAD))


@pytest.mark.slow
def test_the_answer_of_an_unstable_state_says_where_a_march_from_rest_settles(soft):
    found = answered(soft)
    assert not found.settled
    assert "a disturbance grows" in found.settled_by
    assert abs(found.ratio - found.ratio_from_rest) > 0.3
    assert found.ratio_from_rest == pytest.approx(ratio_alone(200, 50), abs=1e-3)
    said = f"a march from rest settles at a ratio of {found.ratio_from_rest:.5g}"
    assert said in found.settled_by
    assert any(note.startswith(said) for note in found.notes)
    assert "no prediction" in found.headline()[0]
    assert found.to_json()["ratio_from_rest"] == found.ratio_from_rest
    marched = solve(body(soft, "solve.method=march"), history=False)
    assert marched.settled
    assert marched.ratio == found.ratio_from_rest


@pytest.mark.slow
def test_so_do_sweeps_and_branches_with_their_pictures(soft, monkeypatch, tmp_path):
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path / "cache"))
    over = ["vibration.frequency=600,640 Hz"]
    found = sweep(*read_grid(str(soft), TABLES, [], over), cache=False)
    alone = answered(soft), answered(soft, "vibration.frequency=640 Hz")
    assert found.loose.all()
    rest = [answer.ratio_from_rest for answer in alone]
    np.testing.assert_allclose(found.arrays["ratio_from_rest"], rest)
    assert found.to_json()["ratio_from_rest"] == rest
    (table,) = found.tables()
    assert [column.heading for column in table.columns][-1] == "from rest"
    said = f"2 points settle in another state from rest, at ratios of {min(rest):.5g} to "
    assert any(str(remark).startswith(said) for remark in table.remarks)
    lines = {line.get_label(): line for line in plot_sweep(found.to_dataset()).axes[0].lines}
    assert lines["from rest"].get_ydata().tolist() == rest
    ways = branches.answer(branches.prepare(read_case(soft, TABLES, ()), over=over), Run())
    assert ways.ratio_from_rest[0] == pytest.approx(rest[0], abs=1e-3)


@pytest.mark.slow
def test_what_stays_is_not_marched_and_what_does_not_settle_is_said(soft, monkeypatch):
    short = "vibration.frequency=610 Hz", "vibration.velocity_ratio=0.5", "solve.duration=0.1 s"
    wanders = solve(body(soft, *short), history=False)
    assert wanders.ratio_from_rest is None
    assert "ratio_from_rest" not in wanders.to_json()
    assert any(note.startswith("a march from rest has not settled") for note in wanders.notes)

    def marched(*_, **__):
        raise AssertionError("it stays")

    monkeypatch.setattr(slide, "March", marched)
    assert solve(body(soft, "vibration.velocity_ratio=2"), history=False).settled
    # Nor what is one of many: from rest it is another.
    many = "normal.damping_ratio=0", "solve.method=periodic"
    rings = Model.from_case(read_case("normal-pin", TABLES, many))
    assert not solve(rings, history=False).settled


@pytest.mark.slow
def test_a_march_that_has_not_settled_gives_no_ratio_from_rest(soft):
    # Its mean of 1.24 is on the way to that of the state, where it settles after 0.4 s.
    heavy = "vibration.frequency=20000 Hz", "slider.mass=10 kg"
    found = solve(body(soft, *heavy), history=False)
    assert "but a body from rest stays at a ratio of 1.24" in found.settled_by
    assert found.ratio_from_rest is None
    over = ["vibration.frequency=20000,20001 Hz"]
    ways = branches.answer(branches.prepare(read_case(soft, TABLES, heavy[1:]), over=over), Run())
    assert np.isnan(ways.ratio_from_rest).all()
    assert not ways.beside.size
    (note,) = (each for each in ways.notes if each.startswith("a march from rest has come neither"))
    assert re.search(r"it has 1\.24\d* at vibration\.frequency=20000 Hz.*; see", note)


@pytest.mark.slow
def test_a_march_from_rest_that_comes_to_the_same_ratio_is_not_another(soft):
    heavy = "slider.mass=5 kg", "vibration.frequency=300 Hz"
    found = solve(body(soft, *heavy), history=False)
    marched = solve(body(soft, *heavy, "solve.method=march"), history=False)
    assert not found.settled
    assert marched.settled
    assert found.ratio == pytest.approx(marched.ratio, rel=1e-3)
    assert found.ratio_from_rest is None
    assert "from rest" not in found.settled_by
    assert found.notes[-1] == "a march from rest comes to the same ratio"


@pytest.mark.slow
def test_a_march_beside_a_state_takes_no_more_steps_than_it_may(soft, monkeypatch):
    marches = []

    class Counted(March):
        def __init__(self, *args, **kwargs):
            super().__init__(*args, **kwargs)
            marches.append(self)

    monkeypatch.setattr(slide, "March", Counted)

    def beside(*settings):
        """Return the answer, and the steps of each march beside it."""
        marches.clear()
        answer = solve(body(soft, *settings), history=False)
        return answer, [each.done for each in marches]

    # Two million it would be, of which a tenth does not do. Of a duration that is asked for nothing
    # is marched.
    long = "vibration.frequency=5000 Hz", "vibration.velocity_ratio=0.3"
    found, taken = beside(*long, "solve.duration=0.8 s")
    assert sum(taken) == 0
    assert found.notes[-1].startswith("where a body from rest goes takes too long to follow")
    found, taken = beside(*long)
    assert taken == [0, 200_000]
    assert found.ratio_from_rest is None
    assert found.notes[-1].startswith("where a body from rest goes takes too long to follow")
    # It goes on up to there, where a window more has room.
    found, taken = beside("vibration.frequency=610 Hz", "vibration.velocity_ratio=0.5")
    assert len(taken) == 1
    assert 499_000 < taken[0] <= 500_000
    monkeypatch.setattr(slide, "_MOST_BESIDE", 300_000)
    found, taken = beside("vibration.frequency=610 Hz", "vibration.velocity_ratio=0.5")
    assert taken == [244_000]
    assert found.notes[-1].startswith("a march from rest has not settled")
    # What finer steps take counts too.
    assert beside()[0].ratio_from_rest
    monkeypatch.setattr(slide, "_MOST_BESIDE", 600_000)
    monkeypatch.setattr(step_error, "allowed", lambda answer: 0.8 * answer.step_error)
    found, taken = beside()
    assert taken == [240_000, 0, 240_000, 0]
    assert found.ratio_from_rest is None
    assert found.notes[-1].startswith("where a body from rest goes takes too long to follow")


def test_a_mean_that_still_goes_on_is_no_ratio_from_rest(soft, monkeypatch):
    whole = slide.until_settled

    def cut_short(*args, **how):
        return dataclasses.replace(whole(*args, **how), notes=(still_goes(0.738, 0.741),))

    monkeypatch.setattr(slide, "until_settled", cut_short)
    found = solve(body(soft), history=False)
    assert found.ratio_from_rest is None
    assert found.notes[-1].startswith("a march from rest has not settled, at a ratio of 0.737")


def test_what_drops_answers_that_have_not_settled_is_not_marched_for_them(soft, monkeypatch):
    def marched(*_, **__):
        raise AssertionError("nobody asked")

    monkeypatch.setattr(slide, "March", marched)
    (found,) = solve_many([body(soft)], beside=False)
    assert not found.settled
    case = forward.prepared(read_case(soft, TABLES, ()), "slide")
    values, why = forward.Predictor(case, "slide", forces=False)([{}], {})
    assert np.isnan(values).all()
    assert "a disturbance grows" in why[0]
    monkeypatch.setattr(prediction, "Solve", lambda **_: body(soft).solve)
    monkeypatch.setattr(prediction, "Model", lambda *_: body(soft))
    asked = ("longitudinal", "sine", SPEED, SPEED, FREQUENCY)
    assert prediction.model_ratios(read_case(soft, TABLES, ()), LOAD, [asked]) == [None]


@pytest.mark.slow
def test_a_drive_too_soft_to_be_stretched_is_told_where_another_state_is_not_looked_for(tmp_path):
    """From rest a march of 13 s comes to 0.7360; a body that comes from 0.999 stays there."""
    case = tmp_path / "soft.toml"
    case.write_text("""
        [slider]
        drive_velocity = "197 um/s"
        normal_force = "1.7964 N"
        mass = "0.62689 g"
        lateral = "free"
        drive_stiffness = "47.526 N/m"
        [friction]
        model = "dahl"
        mu = 0.0528
        law = "unsplit"
        max_deflection = "0.71282 um"
        [vibration]
        waveform = "square"
        frequency = "1699.88 Hz"
        velocity_ratio = 2.2022
        direction = "270 deg"
        rise_time = "147.07 us"
        [solve]
        method = "periodic"
    """)
    soft = solve(body(case), history=False)
    assert soft.ratio == pytest.approx(0.9991, abs=1e-3)
    (note,) = soft.notes
    assert "stretched so slowly" in note
    ways = branches.answer(
        branches.prepare(read_case(case, TABLES, ()), over=["vibration.velocity_ratio=2.0,2.2022"]),
        Run(),
    )
    assert note in ways.notes
    # Where it can be followed it is shown.
    stiff = solve(body(case, "slider.drive_stiffness=400 N/m"), history=False)
    assert stiff.ratio == pytest.approx(0.738, abs=2e-3)
    assert "shown is the one from rest" in stiff.notes[0]
