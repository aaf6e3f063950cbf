"""LuGre's model as its authors have it: a body on a spring that sticks and slips.

Sources
-------
C. Canudas de Wit, H. Olsson, K. J. Astrom, P. Lischinsky: A new model for control of systems with
friction. IEEE Transactions on Automatic Control 40 (1995) 419-425, table I and section IV-D: 1 kg
on 2 N/m pulled at 0.1 m/s, sigma_0 1e5 N/m, sigma_1 sqrt(1e5) N s/m, sigma_2 0.4 N s/m, F_C 1 N,
F_S 1.5 N, v_S 1 mm/s. Numbers: the same equations by SciPy's Radau, to 1e-9: the body passes
10 mm/s at 7.4581 s, friction peaks at 1.47657 N, the spring at 1.50799 N, and slips come every
6.362 s.
"""

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve

CASE = """
[slider]
drive_velocity = "0.1 m/s"
normal_force = "1 N"
drive_stiffness = "2 N/m"
mass = "1 kg"
lateral = "guided"
[friction]
model = "lugre"
mu = 1.0
static_mu = 1.5
tangential_stiffness = "1e5 N/m"
stribeck_velocity = "1 mm/s"
contact_damping = "316.22776601683796 N s/m"
viscous_damping = "0.4 N s/m"
[solve]
method = "march"
duration = "15 s"
step = "20 us"
"""


def body(folder, *settings):
    path = folder / "lugre.toml"
    path.write_text(CASE)
    return Model.from_case(read_case(path, TABLES, settings))


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    return solve(body(tmp_path_factory.mktemp("lugre")))


@pytest.mark.slow
def test_the_body_breaks_away_when_it_slips(found):
    assert found.breakaway_time == pytest.approx(7.4581, abs=1e-3)


def test_friction_and_spring_peak_as_in_the_paper(found):
    history = found.history
    assert history.friction_max[:, 0].max() == pytest.approx(1.47657, abs=1e-4)
    assert history.drive_force_max.max() == pytest.approx(1.507988, abs=1e-4)


def test_slips_come_at_the_paper_s_pace(found):
    history = found.history
    fast = history.velocity[:, 0] > 0.01
    starts = history.time[1:][fast[1:] & ~fast[:-1]]
    assert np.diff(starts[:2])[0] == pytest.approx(6.362, abs=0.01)


def test_a_body_that_sticks_and_slips_has_not_settled(found):
    assert not found.settled


def test_the_asperities_of_a_body_that_does_not_fall_with_speed_break_away_as_dahl_s(tmp_path):
    settings = "friction.static_mu=1", "solve.duration=6 s", "friction.contact_damping=0 N s/m"
    lugre = solve(body(tmp_path, *settings, "friction.viscous_damping=0 N s/m"), history=False)
    assert lugre.breakaway_time == pytest.approx(5.0, abs=1e-3)


@pytest.mark.parametrize("method", ["periodic", "homogenised"])
def test_steady_sliding_that_is_unstable_has_not_settled(tmp_path, method):
    slow = "slider.drive_velocity=0.5 mm/s", f"solve.method={method}", "solve.duration=1 s"
    answer = solve(body(tmp_path, *slow), history=False)
    assert not answer.settled
    assert any("the body sticks and slips" in note for note in answer.notes)
