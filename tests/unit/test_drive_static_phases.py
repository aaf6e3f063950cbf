"""At which phases of a pitch loaded teeth are solved beside their load."""

from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from apparatus.drives import problem

from asperity.drive.plots import pitch_closed
from asperity.drive.static import plots, solve
from asperity.runs import Run


class ToldError(Exception):
    pass


@pytest.mark.parametrize(("phases", "every"), [(6, 1), (11, 1), (12, 3), (24, 3)])
def test_of_few_phases_the_slope_is_taken_at_each_and_of_many_at_every_third(
    phases, every, monkeypatch
):
    def sweeps(asked, _step):
        raise ToldError({one.every for one in asked if one.torque != 366.0})

    body = SimpleNamespace(body=SimpleNamespace(nodes=1))
    model = SimpleNamespace(
        sector=body, contact=None, friction=0.1, phases=range(phases), sweeps=sweeps,
        resolved=SimpleNamespace(flank=SimpleNamespace(nodes=1, sector=body)),
    )  # fmt: skip
    monkeypatch.setattr(solve, "StaticModel", lambda *_: model)
    with pytest.raises(ToldError) as told:
        solve.solve_static(problem(), Run())
    assert told.value.args == ({every},)


def test_where_a_pitch_ends_courses_begin_again_and_each_tooth_is_where_the_next_one_began():
    phase = np.arange(4) * 0.5 * np.pi
    angle, course = pitch_closed(xr.Dataset({"phase": ("phase", phase)}), np.array([3.0, 1, 4, 1]))
    assert angle == pytest.approx([0.0, 90, 180, 270, 360])
    assert course.tolist() == [3.0, 1, 4, 1, 3]
    # Teeth at places a pitch apart, of which those between 0 and 3 bear; the first enters last.
    places = np.arange(-1.0, 3.0) + np.arange(5)[:, None] / 4.0
    force = np.maximum(2.25 - (places - 1.5) ** 2, 0.0)
    shares = plots._shares(force[:-1, 1:])
    assert np.abs(shares - force / force.sum(axis=1, keepdims=True)).max() < 1e-12
