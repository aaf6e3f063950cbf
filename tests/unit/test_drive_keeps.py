"""Studies of many marches that are interrupted and go on."""

import os
import signal

import pytest
from apparatus.drives import case

from asperity.drive import directions, locking
from asperity.drive.protocols import many
from asperity.runs import Interrupted, Run

WAYS = (
    "vibration.frequency=20 kHz", "vibration.displacement_amplitude=5 um", "solve.duration=6 ms",
)  # fmt: skip
# Marches of a study whose first round is over after the second number.
STUDIES = {
    "directions": (directions, case(*WAYS), 4, (1, 3, 4)),
    "locking": (locking, case("solve.duration=6 ms", name="drive-actuator"), 23, (2, 15, 18)),
}


class Pressed(Run):
    """A run in which Ctrl-C is pressed when so many marches are done."""

    def __init__(self, folder, at):
        super().__init__(folder=folder)
        self.at = at

    def checkpoint(self, done, *args, **kwargs):
        if done >= self.at:
            os.kill(os.getpid(), signal.SIGINT)
        super().checkpoint(done, *args, **kwargs)


@pytest.mark.slow
@pytest.mark.parametrize("name", STUDIES)
def test_a_study_interrupted_anywhere_goes_on_from_the_marches_that_are_done(
    tmp_path, monkeypatch, name
):
    study, given, marches, places = STUDIES[name]
    solved = []
    solve = many.solve_shaken

    def counted(*asked):
        answer = solve(*asked)
        solved.append(asked[0])
        return answer

    monkeypatch.setattr(many, "solve_shaken", counted)
    asked = study.prepare(given)
    wanted = study.answer(asked, Run()).to_json()
    assert len(solved) == marches
    for at in places:
        (folder := tmp_path / str(at)).mkdir()
        with pytest.raises(Interrupted, match=r"the same command goes on from .*npz"):
            study.answer(asked, Pressed(folder, at))
        solved.clear()
        assert study.answer(asked, Run(folder=folder)).to_json() == wanted
        assert len(solved) <= marches - at


def test_a_study_of_another_amplitude_begins_anew(tmp_path):
    with pytest.raises(Interrupted):
        directions.answer(directions.prepare(case(*WAYS)), Pressed(tmp_path, 1))
    told = []
    other = directions.prepare(case(*WAYS, "vibration.displacement_amplitude=6 um"))
    found = directions.answer(other, Run(folder=tmp_path, notify=told.append))
    assert any("begins anew" in line for line in told)
    assert found.amplitude == pytest.approx(6e-6)
