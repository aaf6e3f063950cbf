"""Contacts that open: what they hold then, and bodies that do not come back in time."""

import pytest

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, solve, solve_many

OPEN = """
[slider]
drive_velocity = "17.7 mm/s"
normal_force = "4.2755 N"
[friction]
model = "lugre"
mu = 0.5
max_deflection = "2.5 mm"
keeps = "deflection"
[vibration]
waveform = "sine"
frequency = "12.63 Hz"
velocity_ratio = 2.7157
elevation = "1.445 rad"
normal_phase = "2.143 rad"
[normal]
law = "hertz"
control = "displacement"
stiffness = "20898 N/m"
[solve]
duration = "2 s"
"""
THROWN = """
[slider]
drive_velocity = "1 mm/s"
normal_force = "30 N"
mass = "0.5 kg"
lateral = "guided"
[friction]
model = "coulomb"
mu = 0.3
[normal]
law = "hertz"
stiffness = "1 MN/m"
damping_ratio = 0.05
[vibration]
frequency = "4 kHz"
velocity_ratio = 20000
elevation = "90 deg"
[solve]
duration = "2 ms"
"""


def body(folder, text, *settings):
    path = folder / "case.toml"
    path.write_text(text)
    return Model.from_case(read_case(path, TABLES, settings))


@pytest.mark.parametrize(("keeps", "ratio"), [("stiffness", 0.106), ("deflection", 0.3030)])
def test_an_open_contact_lets_its_asperity_go_under_lugre_as_under_dahl(tmp_path, keeps, ratio):
    lugre, dahl = (
        solve(
            body(tmp_path, OPEN, f"friction.model={model}", f"friction.keeps={keeps}"),
            history=False,
        ).ratio
        for model in ("lugre", "dahl")
    )
    assert lugre == pytest.approx(dahl, rel=2e-3)
    assert dahl == pytest.approx(ratio, rel=5e-3 if keeps == "stiffness" else 1e-3)


def test_halves_of_an_odd_number_of_cycles_are_of_whole_cycles(tmp_path):
    answer = solve(body(tmp_path, OPEN), history=False)
    assert answer.cycles % 2
    assert answer.residual < 1e-9
    assert answer.settled


def test_a_body_that_does_not_land_has_an_answer_that_is_no_prediction(tmp_path):
    answer = solve(body(tmp_path, THROWN))
    assert answer.ratio == 0.0
    assert answer.normal.ratio_mean_load is None
    assert answer.normal.open_share == 1.0
    assert not answer.settled
    assert answer.settled_by == "the body does not land in the window of the means"
    assert answer.to_json()["ratio_mean_load"] is None


def test_nor_does_it_take_others_with_it(tmp_path):
    dahl = "friction.model=dahl", "friction.max_deflection=1 um", "friction.law=vector"
    bodies = [
        body(tmp_path, THROWN), body(tmp_path, THROWN, *dahl),
        body(tmp_path, THROWN, *dahl, "vibration.velocity_ratio=5"),
    ]  # fmt: skip
    first, second, third = solve_many(bodies)
    assert not first.settled
    assert not second.settled
    assert third.normal.open_share == 0.0
