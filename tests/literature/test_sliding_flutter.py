"""Flutter of sliding bodies: the closed form of two coupled modes, and a block that is marched.

N. Hoffmann, M. Fischer, R. Allgaier, L. Gaul, A minimal model for studying properties of the
mode-coupling type instability in friction induced oscillations, Mechanics Research Communications
29 (2002) 197-205: a mass that moves along and normal to a belt, held by springs that couple both,
on a contact spring k_3 with friction mu k_3 per normal displacement,

    m x'' + k_11 x + (k_12 - mu k_3) z = 0,    m z'' + k_12 x + (k_22 + k_3) z = 0.

With a = k_11/m, b = (k_22 + k_3)/m and c = k_12 (k_12 - mu k_3)/m^2 the squares of the eigenvalues
are -(a + b)/2 +- sqrt((a - b)^2/4 + c): two frequencies meet where the root is nil.
"""

import dataclasses

import numpy as np
import pytest

from asperity.block.problem import BlockProblem
from asperity.block.solution.stability import Stability
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.interface.friction import PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.surface import contact_surface
from asperity.contact.motion.mechanism import Mechanism
from asperity.contact.motion.rest import rest_under_load
from asperity.contact.motion.stability import sliding_motion
from asperity.contact.motion.steps import Stepper
from asperity.mesh import box

MASS, ALONG, COUPLING, NORMAL, CONTACT = 2.0, 60.0, 14.0, 30.0, 24.0
A, B = ALONG / MASS, (NORMAL + CONTACT) / MASS
# Where c = -(a - b)^2/4.
CRITICAL = (COUPLING + 0.25 * (A - B) ** 2 * MASS**2 / COUPLING) / CONTACT


def minimal(mu, *, direction=(1.0, 0.0), damping=0.0):
    """Build the model: a rigid square of 1 m^2 that shifts along x and z on a bed of springs."""
    surface = contact_surface(box((1.0, 1.0, 1.0), (1, 1, 1)), "bottom")
    count = len(surface.nodes)
    shapes = np.zeros((3 * count, 2))
    shapes[0::3, 0] = shapes[2::3, 1] = 1.0
    mechanism = Mechanism(
        flexibility=np.zeros((3 * count, 3 * count)),
        shapes=shapes,
        mass=MASS * np.eye(2),
        stiffness=np.array([[ALONG, COUPLING], [COUPLING, NORMAL]]),
        held=np.zeros(2, bool),
        damping=np.full(2, damping),
    )
    friction = PointFriction(mu=mu)
    return sliding_motion(
        mechanism, surface, NormalLaw("linear", CONTACT), friction, 1.0, direction
    )


def squares(mu):
    c = COUPLING * (COUPLING - mu * CONTACT) / MASS**2
    root = np.sqrt(complex(0.25 * (A - B) ** 2 + c))
    return -0.5 * (A + B) + np.array([root, -root])


@pytest.mark.parametrize("mu", [0.0, 0.3, 0.9 * CRITICAL, 1.1 * CRITICAL, 1.0])
def test_two_modes_coupled_by_friction_have_the_eigenvalues_of_the_closed_form(mu):
    expected = np.concatenate([np.sqrt(squares(mu)), -np.sqrt(squares(mu))])
    found = minimal(mu).eigenvalues
    for value in expected:
        assert np.abs(found - value).min() < 1e-9 * np.abs(value)


def test_they_flutter_from_the_friction_on_at_which_their_frequencies_meet():
    assert minimal(CRITICAL * (1.0 - 1e-4)).growth() is None
    growth = minimal(CRITICAL * (1.0 + 1e-4)).growth()
    assert growth.frequency == pytest.approx(np.sqrt(0.5 * (A + B)) / (2.0 * np.pi), rel=1e-4)
    growth, exact = minimal(1.0).growth(), np.sqrt(squares(1.0)[0])
    assert growth.rate == pytest.approx(exact.real, rel=1e-9)
    assert growth.frequency == pytest.approx(abs(exact.imag) / (2.0 * np.pi), rel=1e-9)
    # Sliding the other way friction couples them the other way.
    assert minimal(1.0, direction=(-1.0, 0.0)).growth() is None


def test_even_damping_takes_its_rate_off_the_growth():
    # l^2 + (d/m) l - l_0^2 = 0.
    damping, free = 0.4, squares(1.0)[0]
    exact = -0.5 * damping / MASS + np.sqrt(0.25 * (damping / MASS) ** 2 + free)
    assert minimal(1.0, damping=damping).growth().rate == pytest.approx(exact.real, rel=1e-9)
    assert minimal(1.0).damped(np.full(2, damping)).growth().rate == pytest.approx(exact.real)
    enough = 2.0 * MASS * minimal(1.0).growth().rate
    assert minimal(1.0, damping=1.1 * enough).growth() is None


@pytest.mark.slow
def test_a_marched_block_flutters_as_fast_as_its_eigenvalues_say():
    """Thrown along the base at 50 mm/s, it slides; its fastest mode is read by its left vector."""
    settings = [
        "block.elements=[2, 2, 2]", "block.element=hex8", "block.modes=17",
        "block.damping_ratio=0", "vibration.velocity_ratio=0", "slider.drive_velocity=50 mm/s",
        "friction.law=vector", "solve.duration=2 ms", "solve.step=0.5 us",
    ]  # fmt: skip
    problem = BlockProblem.from_case(read_case("block-longitudinal", case_tables(), settings))
    step = problem.timetable.step
    (motion,) = Stability(problem).motions
    growth, stepped = motion.growth(), motion.growth(motion.in_steps(step))
    assert growth.rate > stepped.rate > 2000.0
    found, left = np.linalg.eig(np.linalg.solve(motion.mass, motion.stiffness).T)
    reader = left[:, np.argmax(np.sqrt(-found.astype(complex)).real)]
    rest = rest_under_load(problem.system, problem.loads)
    thrown = rest.coordinates._replace(velocity=0.05 * np.eye(len(rest.coordinates.place))[0])
    stepper = Stepper(problem.system, dataclasses.replace(rest, coordinates=thrown))
    read = []
    for number in range(1, 3001):
        stepper.step_to(number * step, step)
        read.append(reader @ stepper.state.coordinates.place)
    # From step to step, so that what stays has no share.
    size = np.log(np.abs(np.diff(read)))
    time = step * np.arange(len(size))
    late = slice(1500, None)
    slope, _ = np.polyfit(time[late], size[late], 1)
    assert slope == pytest.approx(stepped.rate, rel=0.02)
