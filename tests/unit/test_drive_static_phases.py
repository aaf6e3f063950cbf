"""At which phases of a pitch loaded teeth are solved beside their load."""

from types import SimpleNamespace

import pytest
from apparatus.drives import problem

from asperity.drive.static import solve
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
