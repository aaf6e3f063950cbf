"""A body on another drive than its own is that body as a case with that drive has it."""

import math

import pytest

from asperity.friction import Friction
from asperity.slider import Model, Slider, Solve
from asperity.slider.integrators import integrator
from asperity.slider.other_drives import carried, damped, in_longer_steps

pytestmark = pytest.mark.usefixtures("plain_kernels")

MASS, SPRING, STEP = 0.5, 96068.0, 2e-6


def scaled(damping, step=STEP, stiffness=SPRING, model="dahl"):
    drive = {"drive_stiffness": stiffness, "drive_damping": damping} if stiffness else {}
    slider = Slider(
        drive_velocity=0.5e-3, normal_force=55.0, mass=MASS, lateral="free", **drive, units="SI"
    )
    keys = {} if model == "coulomb" else {"max_deflection": 68.75e-9}
    friction = Friction(model=model, mu=0.1, **keys, units="SI")
    return integrator(Model(slider, friction, None, Solve(units="SI")), step).p


def close(found, expected):
    for name, one, other in zip(expected._fields, found, expected, strict=True):
        assert one == pytest.approx(other, rel=1e-12), name


@pytest.mark.parametrize("model", ["dahl", "coulomb"])
@pytest.mark.parametrize("share", [0.0, 0.3, 1.7])
def test_damped_critically_it_has_twice_the_root_of_stiffness_and_mass(share, model):
    critical = 2.0 * math.sqrt(SPRING * MASS)
    close(damped(scaled(share * critical, model=model)), scaled(critical, model=model))


def test_a_rigid_drive_has_nothing_to_damp():
    rigid = scaled(0.0, stiffness=None)
    assert damped(rigid) == rigid


def test_carried_along_it_moves_as_its_drive_does_whatever_pulls():
    p = scaled(3.0)
    found = carried(p)
    assert found.rigid
    assert (found.mobility_x, found.mobility_y) == (0.0, 0.0)
    close(found._replace(rigid=p.rigid, mobility_x=p.mobility_x, mobility_y=p.mobility_y), p)


@pytest.mark.parametrize("longer", [2.0, 3.0])
def test_in_longer_steps_it_is_what_these_steps_make_of_the_case(longer):
    close(in_longer_steps(scaled(40.0), longer), scaled(40.0, longer * STEP))
