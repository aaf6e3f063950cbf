"""Whether worm and hob have threads, in closed form: what the flanks find by cutting them."""

import math

import numpy as np
import pytest

from asperity.errors import InputError
from asperity.flanks.worm.helicoid import Helicoid
from asperity.gearset import Geometry
from asperity.gearset.threads import CLOSED_FORMS, thread_room

RULES = "bs721", "iso"


def made(flank, rule, starts, diameter_factor, pressure_angle):
    """Whether the flanks find a worm and a hob; None for numbers that are no gearset."""
    try:
        geometry = Geometry.of(
            starts=starts,
            wheel_teeth=50,
            axial_module=3.0,
            diameter_factor=diameter_factor,
            pressure_angle=pressure_angle,
            flank=flank,
            tooth_proportions=rule,
        )
    except InputError:
        return None
    try:
        Helicoid.hob(geometry, flank)
        Helicoid.worm(geometry, flank)
    except InputError:
        return False
    return True


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("flank", CLOSED_FORMS)
def test_the_flanks_refuse_what_the_closed_form_says_is_pointed_and_nothing_else(flank):
    rng = np.random.default_rng(10828)
    found = []
    for _ in range(150):
        numbers = (
            RULES[int(rng.integers(2))],
            int(rng.integers(1, 9)),
            float(rng.uniform(5.0, 14.0)),
            math.radians(float(rng.uniform(14.0, 35.0))),
        )
        if (threads := made(flank, *numbers)) is not None:
            assert (float(thread_room(flank, *numbers)) > 0.0) == threads, numbers
            found.append(threads)
    assert 10 < sum(found) < len(found) - 10


def test_arrays_give_what_each_number_gives_and_other_flanks_are_left_to_the_cutting():
    starts, factors = np.array([1.0, 4.0, 6.0]), np.array([10.0, 8.0, 6.0])
    together = thread_room("ZI", "bs721", starts, factors, 0.35)
    alone = [
        float(thread_room("ZI", "bs721", *pair, 0.35)) for pair in zip(starts, factors, strict=True)
    ]
    assert together.tolist() == alone
    assert alone[0] > 0.1
    assert alone[2] < 0.0
    assert np.isinf(thread_room("ZK", "bs721", starts, factors, 0.35)).all()
