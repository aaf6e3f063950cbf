"""Loaded teeth of many designs: ranked alike on every mesh, and of every type of flank."""

import functools

import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.problem import DriveProblem
from asperity.drive.static.loaded import loaded
from asperity.drive.static.solve import solve_static
from asperity.runs import Run

# Ten modifications of gearset 3, elastic, by their largest pressure on the flank or the worm's tip.
DESIGNS = {
    "none": (),
    "relief of 5 um": ("tip_relief=5 um",),
    "of 10 um": ("tip_relief=10 um",),
    "of 15 um": ("tip_relief=15 um",),
    "of 20 um": ("tip_relief=20 um",),
    "of 40 um": ("tip_relief=40 um",),
    "of 20 um from 0.2 on": ("tip_relief=20 um", "tip_relief_start=0.2"),
    "of 10 um from 0.8 on": ("tip_relief=10 um", "tip_relief_start=0.8"),
    "rounded by 0.1": ("tip_rounding=0.1",),
    "rounded by 0.2": ("tip_rounding=0.2",),
}


def problem(*settings):
    case = read_case("drive-screw", case_tables(), settings)
    return DriveProblem.from_case(case, shaken=False)


@functools.cache
def ranked(density):
    found = {}
    mesh = "drive.phases=4", "drive.teeth=3", "drive.plastic=false", f"drive.density={density}"
    for name, given in DESIGNS.items():
        one = loaded(problem(*mesh, *(f"modification.{each}" for each in given)), Run())
        found[name] = max(one.pressure_flank, one.pressure_worm_tip), one.force_worm_tip
    return [sorted(found, key=lambda name, k=k: found[name][k]) for k in (0, 1)]


@pytest.mark.slow
def test_ten_modifications_are_ranked_by_what_they_leave():
    coarse = ranked("coarse")
    # By pressure 20 um are best and none is worst; by force a larger rounding is.
    assert (coarse[0][0], coarse[0][-1]) == ("of 20 um", "none")
    assert (coarse[1][0], coarse[1][-1]) == ("of 40 um", "rounded by 0.2")


@pytest.mark.slow
@pytest.mark.campaign(tried_by="test_ten_modifications_are_ranked_by_what_they_leave")
@pytest.mark.parametrize("density", ["intermediate", "fine"])
def test_ten_modifications_rank_alike_on_three_meshes(density):
    assert ranked(density) == ranked("coarse")


@pytest.mark.slow
@pytest.mark.parametrize("flank", ["ZA", "ZN", "ZK", "ZC", "ZI"])
def test_every_type_of_flank_goes_the_whole_way(flank):
    one = solve_static(problem(f"gearset.flank={flank}", "drive.teeth=1", "drive.phases=2"), Run())
    assert one.output_torque == pytest.approx(366.0)
    # What is lost over a pitch is all that friction takes.
    assert one.input_torque_reversed < one.input_torque_frictionless < one.input_torque
    assert 0.65 < one.efficiency < 0.75
    assert one.pressure_flank <= one.flow_pressure * (1.0 + 1e-9)
    assert one.flash_temperature > 0.0
    assert one.residual < 1e-5
