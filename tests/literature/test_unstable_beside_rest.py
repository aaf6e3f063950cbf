"""A periodic state that does not stay, on a soft drive whose friction falls: where rest leads to.

LuGre friction as Canudas de Wit et al. (1995) have it, on a base that vibrates, from rest by
another integrator.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, slide, solve
from asperity.sweep import branches, read_grid
from asperity.sweep import run as sweep
from asperity.sweep.plots import plot_sweep

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


@pytest.fixture
def soft(tmp_path):
    path = tmp_path / "soft.toml"
    path.write_text(SOFT)
    return path


def body(path, *settings):
    return Model.from_case(read_case(path, TABLES, settings))


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


def test_the_answer_of_an_unstable_state_says_where_a_march_from_rest_settles(soft):
    found = solve(body(soft), history=False)
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


def test_so_do_sweeps_and_branches_with_their_pictures(soft, monkeypatch, tmp_path):
    monkeypatch.setenv("ASPERITY_CACHE", str(tmp_path / "cache"))
    over = ["vibration.frequency=600,640 Hz"]
    found = sweep(*read_grid(str(soft), TABLES, [], over), cache=False)
    alone = [solve(body(soft, f"vibration.frequency={f} Hz"), history=False) for f in (600, 640)]
    assert found.loose.all()
    rest = [answer.ratio_from_rest for answer in alone]
    np.testing.assert_allclose(found.arrays["ratio_from_rest"], rest)
    assert found.to_json()["ratio_from_rest"] == rest
    assert [column.heading for column in found.tables()[0].columns][-1] == "from rest"
    lines = {line.get_label(): line for line in plot_sweep(found.to_dataset()).axes[0].lines}
    assert lines["from rest"].get_ydata().tolist() == rest
    ways = branches.answer(branches.prepare(read_case(soft, TABLES, ()), over=over), slide.Run())
    assert ways.ratio_from_rest[0] == pytest.approx(rest[0], abs=1e-3)


def test_what_stays_is_not_marched_and_what_does_not_settle_is_said(soft, monkeypatch):
    short = "vibration.frequency=610 Hz", "vibration.velocity_ratio=0.5", "solve.duration=0.1 s"
    wanders = solve(body(soft, *short), history=False)
    assert wanders.ratio_from_rest is None
    assert "ratio_from_rest" not in wanders.to_json()
    assert any(note.startswith("a march from rest has not settled") for note in wanders.notes)

    def marched(*_, **__):
        raise AssertionError("it stays")

    monkeypatch.setattr(slide, "march", marched)
    assert solve(body(soft, "vibration.velocity_ratio=2"), history=False).settled
    # Nor what is one of many: from rest it is another.
    many = "normal.damping_ratio=0", "solve.method=periodic"
    rings = Model.from_case(read_case("normal-pin", TABLES, many))
    assert not solve(rings, history=False).settled
