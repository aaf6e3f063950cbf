"""What a rating is given by the rooms above it: the exact backlash, and no deflection overhung."""

import pytest

import asperity
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.errors import InputError
from asperity.runs import Run
from asperity.shafts import study
from asperity.studies import optimise

JS7 = "tolerances.centre_distance=js7"
OVERHUNG = "worm_shaft.bearing=[{at='8 mm', carries='both'}, {at='45 mm'}]"


def test_where_no_hob_cuts_the_wheel_the_formula_stands_and_a_note_says_so():
    rated = asperity.rate("gearset-2", settings=[JS7, "gearset.wheel_face_width=36 mm"])
    assert rated.backlash.by == "by geometry"
    assert sum("by geometry, which is no bound" in note for note in rated.notes) == 1
    assert "backlash by geometry" in rated.brief()


def test_a_thickness_that_is_given_twice_is_refused_as_flank_refuses_it():
    with pytest.raises(InputError, match=r"mount\.backlash and tolerances\.fit"):
        asperity.rate("gearset-2", settings=["tolerances.fit=C", "mount.backlash=0.1 mm"])


@pytest.mark.slow
def test_a_mount_that_thins_the_threads_counts():
    rated = asperity.rate("gearset-2", settings=["tolerances.centre_distance=0 um",
                                                 "mount.backlash=0.1 mm"])  # fmt: skip
    parts = {part.name: part for part in rated.backlash.parts}
    assert parts["hob and worm"].least == pytest.approx(106.0, rel=0.02)


@pytest.mark.slow
def test_a_worm_that_overhangs_has_no_deflection_by_the_standard_and_the_beam_has_it():
    between, over = (
        asperity.rate("actuator-shafts", settings=settings) for settings in ((), (OVERHUNG,))
    )
    assert "safety_deflection" in between.iso14521
    assert "safety_deflection" not in over.iso14521
    assert "iso14521.safety_deflection" in over.verdict.unrated
    assert "ISO/TR 14521 has no answer for deflection: the worm overhangs" in over.brief()
    assert [row.name for row in over.rows].count("worm as a beam") == 1
    assert over.to_json()["iso14521"]["safety_deflection"] is None


def test_shafts_and_optimise_say_that_the_formula_is_not_of_a_worm_that_overhangs():
    case = read_case("actuator-shafts", case_tables(), (OVERHUNG,))
    shafts = study.answer(study.prepare(case), Run())
    assert shafts.iso_deflection is None
    assert sum("overhangs, its mesh 60 mm beyond bearing B" in note for note in shafts.notes) == 1
    assert optimise.prepare(case).overhang == "60 mm beyond bearing B"


@pytest.mark.slow
def test_an_optimum_of_a_worm_that_overhangs_says_which_deflection_is_its_own():
    best = asperity.optimise("actuator-shafts", settings=(OVERHUNG,))
    assert sum("overhangs, its mesh 60 mm beyond bearing B" in note for note in best.notes) == 1
