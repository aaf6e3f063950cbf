"""Springs that may be too few to tell the friction of a contact by are told of."""

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.friction.springs import REFERENCE_INDENTATION, load_and_slope, spring_profile
from asperity.runs import Run
from asperity.slider import TABLES, Model, static
from asperity.slider.space import missed_limit, too_few_springs

DEEP = 2.0
ROUGH = "normal.law=rough", "vibration.displacement_amplitude=2 um"


@pytest.mark.parametrize("law", ["hertz", "rough"])
@pytest.mark.parametrize("count", [16, 64])
def test_springs_miss_the_law_by_no_more_than_is_told(law, count):
    deepest = REFERENCE_INDENTATION[law] + DEEP
    heights, weights = spring_profile(law, count, deepest)
    depth = np.linspace(-9.0, deepest, 40001)
    carried = np.maximum(depth[:, None] - heights, 0.0) @ weights
    off = np.abs(carried - load_and_slope(law, depth)[0]).max()
    assert off == pytest.approx(missed_limit(law, count, deepest), rel=0.05)


def told(*settings):
    return too_few_springs(Model.from_case(read_case("normal-machine", TABLES, settings)))


def test_a_rough_contact_whose_load_swings_far_is_told_its_springs_are_few():
    assert not told("normal.law=rough", "vibration.displacement_amplitude=1 nm")
    (note,) = told(*ROUGH)
    assert "of 16 springs" in note
    assert "friction.springs = " in note
    enough = note.rpartition("springs = ")[2].split()[0]
    assert not told(*ROUGH, f"friction.springs={enough}")


def test_static_friction_tells_it_too():
    few = "friction.model=springs", "friction.springs=4", "slider.mass=0.5 kg"
    settings = ("normal.law=rough", "vibration.displacement_amplitude=1 um", *few)
    found = static.answer(static.prepare(read_case("normal-machine", TABLES, settings)), Run())
    assert any("of 4 springs friction is known to within" in note for note in found.notes)
