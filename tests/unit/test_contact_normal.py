"""Laws of pressure against overclosure, and what they make of a body in contact."""

import numpy as np
import pytest

from asperity.contact.elastic import ElasticMaterial, condense
from asperity.contact.increment import IncrementProblem, IncrementSolver, full_newton
from asperity.contact.increment.equations import Increment
from asperity.contact.increment.multipliers import classical, multiplier_tangent
from asperity.contact.interface.counter_motion import Drift, SurfaceMotion
from asperity.contact.interface.normal import NormalLaw, augmented_overclosure, pressure
from asperity.contact.interface.rigid import Pose, RigidSurface
from asperity.contact.interface.surface import contact_surface
from asperity.contact.static import Guide, move_to
from asperity.errors import InputError
from asperity.mesh import box

STIFF = 4e14
TWO = NormalLaw("two-stage", STIFF, 0.1 * STIFF, 2e-9, 6e-9)
LAWS = {
    "linear": (NormalLaw("linear", STIFF), 0.0),
    "two-stage": (TWO, 0.0),
    "hard": (NormalLaw("hard", STIFF), 3e5),
}


@pytest.mark.usefixtures("plain_kernels")
@pytest.mark.parametrize("name", LAWS)
def test_pressure_is_never_negative_grows_and_has_the_slope_it_says(name):
    law, multiplier = LAWS[name]
    overs = np.linspace(-5e-9, 2e-8, 401)
    values = np.array([pressure(over, multiplier, law.numbers) for over in overs])
    assert (values[:, 0] >= 0.0).all()
    assert (np.diff(values[:, 0]) >= 0.0).all()
    between = np.diff(values[:, 0]) / np.diff(overs)
    least = np.minimum(values[:-1, 1], values[1:, 1])
    most = np.maximum(values[:-1, 1], values[1:, 1])
    assert (between >= least * (1 - 1e-6) - 1.0).all()
    assert (between <= most * (1 + 1e-6) + 1.0).all()


def test_the_linear_law_is_proportional_to_the_overclosure_and_opens():
    law = NormalLaw("linear", STIFF).numbers
    assert pressure(3e-9, 0.0, law) == pytest.approx((STIFF * 3e-9, STIFF))
    assert pressure(-1e-12, 0.0, law) == (0.0, 0.0)


def test_the_two_stage_law_is_soft_first_stiff_last_and_smooth_between():
    law = TWO.numbers
    assert pressure(1e-9, 0.0, law) == pytest.approx((0.1 * STIFF * 1e-9, 0.1 * STIFF))
    assert pressure(2e-8, 0.0, law)[1] == STIFF
    # In the transition the stiffness rises linearly: the pressure grows by its mean.
    gained = pressure(6e-9, 0.0, law)[0] - pressure(2e-9, 0.0, law)[0]
    assert gained == pytest.approx(0.55 * STIFF * 4e-9)
    for joint in (2e-9, 6e-9):
        below, above = (pressure(joint * (1 + e), 0.0, law) for e in (-1e-9, 1e-9))
        assert below == pytest.approx(above, rel=1e-6)


def test_past_its_transition_the_two_stage_law_is_a_line_that_starts_later():
    late = (1.0 - TWO.initial / STIFF) * 0.5 * (TWO.start + TWO.end)
    for over in (6e-9, 2e-8, 1e-6):
        value, slope = pressure(over, 0.0, TWO.numbers)
        assert value == pytest.approx(STIFF * (over - late), rel=1e-12)
        assert slope == STIFF


@pytest.mark.parametrize("over", [5e-10, 3e-9, 5.9e-9, 1e-7])
def test_the_slope_of_the_two_stage_law_is_the_derivative_of_its_pressure(over):
    step = 1e-4 * over
    ahead, behind = (pressure(over + way, 0.0, TWO.numbers)[0] for way in (step, -step))
    assert (ahead - behind) / (2.0 * step) == pytest.approx(
        pressure(over, 0.0, TWO.numbers)[1], rel=1e-9
    )


def test_the_hard_law_bears_its_multiplier_without_overclosure():
    law = NormalLaw("hard", STIFF).numbers
    assert pressure(0.0, 3e5, law) == (3e5, STIFF)
    assert pressure(-3e5 / STIFF * 1.001, 3e5, law) == (0.0, 0.0)


@pytest.mark.usefixtures("plain_kernels")
@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("give", [1e12, 4e14, 1e17])
def test_an_augmented_overclosure_meets_its_aim(name, give):
    law, multiplier = LAWS[name]
    for aim in np.concatenate([-np.logspace(2, 9, 15), np.logspace(2, 9, 15)]):
        over = augmented_overclosure(aim, give, multiplier, law.numbers)
        value, _ = pressure(over, multiplier, law.numbers)
        assert value + give * over == pytest.approx(aim, rel=1e-9)


def test_two_stages_follow_from_the_size_of_the_elements():
    law = NormalLaw.two_stage(STIFF, 5e-3)
    assert (law.initial, law.start, law.end) == pytest.approx((0.1 * STIFF, 5e-5, 1.5e-4))


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"name": "soft", "stiffness": 1.0}, "'linear', 'two-stage', 'hard'"),
        ({"stiffness": 0.0}, "positive"),
        ({"stiffness": np.nan}, "positive"),
        ({"name": "two-stage", "stiffness": 1.0, "initial": 2.0, "end": 1.0}, "at most"),
        (
            {"name": "two-stage", "stiffness": 1.0, "initial": 0.5, "start": 2.0, "end": 1.0},
            "greater",
        ),
    ],
)
def test_a_law_that_cannot_be_is_refused(given, says):
    with pytest.raises(InputError, match=says):
        NormalLaw(**given)


E = 2e11
SIZE = 0.5e-3
UP = Guide(np.array([0.0, 0.0, 1.0]))
RADIUS = 0.1
# The ball touches out to sqrt(RADIUS * DEEP), nearly three of the smaller elements.
DEEP = 2e-5
BALL = Guide(UP.axis, Pose(np.eye(3), np.array([0.0, 0.0, -RADIUS])))


@pytest.fixture(scope="module", params=["hex8", "hex27"])
def block(request):
    """A block that hangs from its top: its flexibility and the surface below."""
    order, elements = (1, (6, 6, 4)) if request.param == "hex8" else (2, (3, 3, 2))
    mesh = box((6 * SIZE, 6 * SIZE, 4 * SIZE), elements, order)
    material = ElasticMaterial(E, 0.3, 7850.0)
    body = condense(mesh, material, "bottom", tied="top", use_cache=False)
    return body.flexibility, contact_surface(mesh, "bottom")


def pressed(block, law, guide, place):
    counter = RigidSurface.plane() if guide is UP else RigidSurface.sphere(RADIUS)
    problem = IncrementProblem(*block, counter, law)
    return problem, move_to(IncrementSolver(problem), guide, place).contact


@pytest.mark.ordinary(3)
@pytest.mark.parametrize("stiffness", [E / SIZE, 10 * E / SIZE, 100 * E / SIZE])
def test_hard_contact_leaves_no_overclosure_beyond_its_tolerance(block, stiffness):
    problem, contact = pressed(block, NormalLaw("hard", stiffness), BALL, DEEP)
    surface = block[1]
    basis = problem.from_corners
    over = basis.T @ surface.to_forces(-contact.distance.reshape(surface.weights.shape))
    mean = over / (basis.T @ surface.nodal_area)
    multiplier = contact.state.multiplier[problem.corners]
    bearing = multiplier > 0.0
    allowed = problem.penetration * contact.pressure.max() / stiffness
    assert 3 < bearing.sum() < len(bearing)
    assert np.abs(mean[bearing]).max() <= allowed
    assert mean[~bearing].max() <= 0.0
    assert allowed < 1e-6 * DEEP


def test_hard_contact_hardly_depends_on_its_penalty(block):
    # Only by how the pressure is spread within an element.
    forces = [
        pressed(block, NormalLaw("hard", factor * E / SIZE), BALL, DEEP)[1].force[2::3]
        for factor in (1.0, 10.0, 100.0)
    ]
    loads = [force.sum() for force in forces]
    assert loads == pytest.approx([loads[1]] * 3, rel=0.006)
    soft = pressed(block, NormalLaw("linear", E / SIZE), BALL, DEEP)[1].force[2::3].sum()
    assert soft < 0.8 * loads[0]


def test_a_hard_contact_much_narrower_than_an_element_bears_on_its_penalty(block):
    laws = [NormalLaw(name, 10 * E / SIZE) for name in ("hard", "linear")]
    hard, linear = (pressed(block, law, BALL, 2e-7)[1] for law in laws)
    assert not hard.state.multiplier.any()
    assert hard.force == pytest.approx(linear.force, rel=1e-7, abs=1e-7)


def test_hard_contact_is_the_limit_of_linear_contact_with_growing_stiffness():
    mesh = box((6 * SIZE, 4 * SIZE, 4 * SIZE), (6, 4, 4))
    material = ElasticMaterial(E, 0.3, 7850.0)
    body = condense(mesh, material, "bottom", tied="top", use_cache=False)
    block = body.flexibility, contact_surface(mesh, "bottom")
    _, hard = pressed(block, NormalLaw("hard", 10 * E / SIZE), UP, 1e-6)
    assert hard.active == len(hard.pressure)
    off = []
    for factor in (1e2, 1e3, 1e4):
        _, linear = pressed(block, NormalLaw("linear", factor * E / SIZE), UP, 1e-6)
        off.append(np.abs(linear.force - hard.force).max() / hard.force.max())
    # The overclosure, and with it what is off, is inversely proportional to the stiffness.
    assert off[0] / off[1] == pytest.approx(10.0, rel=0.05)
    assert off[1] / off[2] == pytest.approx(10.0, rel=0.05)
    assert off[2] < 1e-3


def test_a_body_on_a_two_stage_contact_gives_more_than_on_its_last_and_less_than_on_its_first(
    block,
):
    law = NormalLaw.two_stage(10 * E / SIZE, SIZE / 1000)
    ends = [NormalLaw("linear", stiffness) for stiffness in (law.initial, law.stiffness)]
    loads = [pressed(block, each, BALL, DEEP)[1].force[2::3].sum() for each in (*ends, law)]
    assert loads[0] < loads[2] < loads[1]


@pytest.mark.parametrize("start", [0.0, 1e-9])
def test_two_stages_give_each_pressure_at_one_overclosure_with_the_slope_there(start):
    law = NormalLaw("two-stage", 1e14, 2e13, start, 3e-9)
    for over in (1e-10, 1e-9, 1.7e-9, 3e-9, 8e-9):
        value, slope = pressure(over, 0.0, law.numbers)
        assert law.overclosure(value) == pytest.approx(over, rel=1e-12)
        assert law.slope_at(value) == pytest.approx(slope, rel=1e-9)
    assert law.overclosure(0.0) == law.overclosure(-1.0) == 0.0
    assert law.slope_at(0.0) == 2e13


@pytest.mark.parametrize("name", ["linear", "hard"])
def test_other_laws_have_one_slope(name):
    law = NormalLaw(name, 1e14)
    assert law.slope_at(5e4) == 1e14
    assert law.overclosure(5e4) == (5e-10 if name == "linear" else 0.0)


def test_a_newton_step_takes_account_of_the_multipliers_that_end():
    # What bears under a ball that is drawn back a little: at the rim multipliers end, and the body
    # comes forth there, which closes what the others leave open.
    mesh = box((6 * SIZE, 6 * SIZE, 4 * SIZE), (6, 6, 4), 1)
    body = condense(mesh, ElasticMaterial(E, 0.3, 7850.0), "bottom", tied="top", use_cache=False)
    law = NormalLaw("hard", 10 * E / SIZE)
    problem = IncrementProblem(body.flexibility, contact_surface(mesh, "bottom"),
                               RigidSurface.sphere(RADIUS), law)  # fmt: skip
    solver = IncrementSolver(problem)
    state = move_to(solver, BALL, DEEP).contact.state
    motion = SurfaceMotion(BALL.at(DEEP), Drift.between(BALL.at(DEEP), BALL.at(DEEP)))

    def overclosure(corner):
        """Integrated about the corners, for multipliers at them."""
        given = state.committed(problem.from_corners @ corner)
        increment = Increment(problem, np.zeros(3 * problem.nodes), motion.numbers(), given)
        trial, _ = full_newton.solve(increment, state.traction)
        over = -trial.points.distance.reshape(problem.surface.weights.shape)
        return problem.from_corners.T @ problem.surface.to_forces(over), trial

    known = state.multiplier[problem.corners]
    bearing = np.flatnonzero(known > 0.0)
    ended = bearing[np.argsort(known[bearing])[:3]]
    rest = np.setdiff1d(bearing, ended)
    # A little pressure at the rim that has to end, and the others as they are without overclosure.
    corner = known.copy()
    corner[ended] = 0.0
    for _ in range(4):
        _, trial = overclosure(corner)
        updated = np.where(corner > 0.0, classical(problem, trial, corner), 0.0)
        corner = multiplier_tangent(problem, trial, corner, updated).applied(
            problem, corner, updated
        )
    settled = np.abs(overclosure(corner)[0][rest]).max()
    held = corner.copy()
    held[ended] = 1e-3 * corner.max()
    before, trial = overclosure(held)
    updated = np.where(np.isin(np.arange(held.size), rest), classical(problem, trial, held), 0.0)
    after = multiplier_tangent(problem, trial, held, updated).applied(problem, held, updated)
    assert np.all(after[ended] == 0.0)
    left = np.abs(overclosure(after)[0][rest]).max()
    size = np.abs(before[rest]).max()
    assert settled < 1e-3 * size
    assert left < 0.02 * size
    assert np.abs(after - corner).max() < 0.02 * np.abs(held - corner).max()
