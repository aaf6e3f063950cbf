"""The longest step of a march is that of the fastest vibration which its freedoms can have."""

import math
import re
from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.protocols import equations_of_motion as equations
from asperity.errors import InputError

NORMAL, ALONG = 3e7, 5e6
POINT = SimpleNamespace(
    normal_z=0.9, lead=3e-3, length=14e-3, radius=11e-3, arm=40e-3, normal_across=0.25,
    normal_radial=0.4,
)  # fmt: skip
OWN = {"torsion": 2e4, "seat": 7e6, "bent_stiffness": np.array([4e6, 5e6, 6e6])}
MASSES = {
    "worm_inertia": 2e-5, "worm_mass": 0.4, "bent_mass": np.array([0.2, 0.3, 0.25]),
    "wheel_inertia": 1.5e-3,
}  # fmt: skip


def longest(*freedoms, step=None, approach_speed=1e-4):
    found = SimpleNamespace(
        **{name: name in freedoms for name in ("turns", "shifts", "bends", "rolls")},
        **OWN, **MASSES, landing=1e-9,
    )  # fmt: skip
    problem = SimpleNamespace(
        step=1.0, solve=SimpleNamespace(step=step), approach_speed=approach_speed
    )
    model = SimpleNamespace(stiffness=(NORMAL, ALONG), point=POINT)
    return equations._longest(problem, model, found)


def squares(*freedoms):
    """Stiffness over mass by freedom: own springs, and contacts by how far it moves them."""
    p, tilt = POINT, POINT.lead / POINT.length
    # Own spring, mass, way into the flank and way along the flank, of a unit of each freedom.
    ways = {
        "turns": [(OWN["torsion"], MASSES["worm_inertia"], p.normal_z * p.lead,
                   p.radius * p.radius / p.length)],
        "shifts": [(OWN["seat"], MASSES["worm_mass"], p.normal_z, tilt)],
        "bends": [
            (*pair, *way)
            for pair, way in zip(
                zip(OWN["bent_stiffness"], MASSES["bent_mass"], strict=True),
                [(p.normal_z, tilt), (p.normal_across * tilt, p.radius / p.length),
                 (p.normal_radial, p.normal_across)],
                strict=True,
            )
        ],
        "rolls": [(0.0, MASSES["wheel_inertia"], p.arm * p.normal_z, p.arm * tilt)],
    }  # fmt: skip
    return sum(
        (own + equations._STIFFER * NORMAL * into * into + ALONG * along * along) / mass
        for name in freedoms
        for own, mass, into, along in ways[name]
    )


@pytest.mark.parametrize(
    "freedoms",
    [("turns",), ("shifts",), ("bends",), ("rolls",), ("turns", "shifts", "bends", "rolls")],
    ids="/".join,
)
def test_it_is_of_the_sum_of_all_squares(freedoms):
    fastest = math.sqrt(squares(*freedoms))
    stable = equations._STABLE / fastest
    assert longest(*freedoms) == pytest.approx(stable, rel=1e-12)
    # One that is given is left where it is stable at all.
    assert longest(*freedoms, step=3.9 * stable, approach_speed=0.0) == 3.9 * stable
    with pytest.raises(InputError, match=re.escape(f"{fastest / (2.0 * math.pi):.3g} Hz")):
        longest(*freedoms, step=4.1 * stable)


def test_a_step_in_which_flanks_come_too_near_is_refused():
    step = 0.5 * longest("rolls")
    assert longest("rolls", step=step, approach_speed=0.99e-9 / step) == step
    with pytest.raises(InputError, match="flanks that approach"):
        longest("rolls", step=step, approach_speed=1.01e-9 / step)


def test_nothing_that_moves_sets_no_step():
    assert longest() == 1.0
