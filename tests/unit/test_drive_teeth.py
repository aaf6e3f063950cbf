"""Elastic teeth as a mesh of the march: against the increments of the contact, and their energy."""

import copy
import dataclasses
import functools
import itertools
import math

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.candidates.inverse import apply, invert
from asperity.contact.candidates.records import Work
from asperity.contact.increment.problem import ContactState, IncrementProblem
from asperity.contact.increment.solver import IncrementSolver
from asperity.contact.interface.counter_motion import Drift, SurfaceMotion
from asperity.contact.interface.friction import DAHL, PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.rigid import Pose, RigidSurface
from asperity.drive.elastic.friction import find_shares, point_at
from asperity.drive.elastic.memory import states
from asperity.drive.elastic.mesh import solve_teeth
from asperity.drive.elastic.model import TeethModel
from asperity.drive.interface import AT, OUTS, POSES
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.equations_of_motion import begin, system
from asperity.drive.protocols.march import March
from asperity.drive.protocols.solve import solve_shaken
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import Reduction, reduction
from asperity.drive.static.solve import StaticModel, condensed
from asperity.drive.static.sweep import LoadCase
from asperity.drive.teeth.contact import CONTACT_STIFFNESS, TeethContact
from asperity.drive.teeth.placing import place_worm
from asperity.errors import ConvergenceError
from asperity.friction.dahl import VECTOR
from asperity.runs import Run

STEP = 0.5e-6
GIVEN = Reduction(9.8e-3, ((22.0, 80e-6), (366.0, 550e-6)), 2.6e-9)

FORTY_TO_ONE = """
[gearset]
starts = 1
wheel_teeth = 40
centre_distance = "100 mm"
axial_module = "4 mm"
diameter_factor = 9.0
worm_material = "case-hardened steel"
wheel_material = "CuSn12Ni2-C-GZ"
flank = "ZC"
[mount]
backlash = "0.2 mm"
axial_offset = "-20 um"
[operation]
worm_speed = "1500 rpm"
output_torque = "300 N m"
life = "25000 h"
lubricant = "ISO VG 220 polyglycol"
[friction]
model = "dahl"
mu = 0.05
max_deflection = "70 nm"
[vibration]
mode = "torsional"
frequency = "20 kHz"
displacement_amplitude = "10 um"
[drive]
load_inertia = "0.01 kg m**2"
worm_inertia = "1e-5 kg m**2"
worm_mass = "0.5 kg"
contact_damping = "0.01 s/m"
[shaft]
torsional_stiffness = "4000 N m/rad"
"""


@functools.cache
def model_of(*settings):
    problem = DriveProblem.from_case(
        read_case("drive-screw", case_tables(), ("drive.teeth=1", *settings))
    )
    return TeethModel.of(problem, GIVEN, Run())


def moved(model, count, way):
    """Poses and rates of a worm that turns, the wheel behind it by a deflection and a motion."""
    ratio, speed = model.point.ratio, model.problem.worm_speed
    behind = float(model.sweeps[0].deflection[0])
    t = STEP * np.arange(count + 1)
    q, v = np.zeros((count + 1, POSES)), np.zeros((count + 1, POSES))
    q[:, 0], v[:, 0] = speed * t, speed
    wave, rate = way(t)
    q[:, 2], v[:, 2] = speed / ratio * t - behind + wave, speed / ratio + rate
    return q, v


def marched(model, q, v):
    here = model.settled_in(q[0], 1.0)
    trial = here.copy()
    outs = np.zeros((len(q) - 1, OUTS))
    for k in range(1, len(q)):
        advance(model.teeth, here, trial, q[k], v[k], STEP, outs[k - 1])
        here, trial = trial, here
    return outs, here


def advance(mesh, committed, trial, q, v, dt, out):
    """As `asperity.drive.elastic.mesh.advance`, by kernels that are in the list."""
    find_shares(mesh.sliding, v)
    solve_teeth(mesh, committed, trial, q, v, dt, out)


def swung(amplitude, frequency=20e3):
    angle = 2.0 * math.pi * frequency
    return lambda t: (
        amplitude * (1.0 - np.cos(angle * t)),
        amplitude * angle * np.sin(angle * t),
    )


@pytest.mark.slow
def test_a_load_drives_elastic_teeth_back_as_those_reduced():
    settings = ("drive.protocol=back-drive", "solve.duration=1 ms", "vibration.frequency=20 kHz")
    case = read_case("drive-actuator", case_tables(), ("drive.teeth=1", *settings))
    problem = DriveProblem.from_case(case)
    reduced = reduction(problem, Run())
    teeth = dataclasses.replace(
        problem, drive=problem.drive.model_copy(update={"model": "teeth", "flanks": "driving"})
    )
    whole = TeethModel.of(teeth, reduced, Run())
    cycles = []
    for each in (whole, ReducedModel(problem, reduced)):
        moving = system(each.problem, each, motor=False)
        march = March(each, moving, *begin(each.problem, each, moving), Run())
        march.go(24)
        cycles.append(float(march.rows["rolled"][12:].sum() / march.rows["time"][12:].sum()))
    assert cycles[1] < -1.0
    assert cycles[0] == pytest.approx(cycles[1], rel=0.1)


@pytest.mark.slow
def test_a_tooth_takes_the_forces_that_increments_on_its_whole_flank_take():
    model = model_of("drive.flanks=driving")
    mesh, sector = model.teeth, model.sector
    q, v = moved(model, 8, swung(100e-6))
    outs, _ = marched(model, q, v)
    friction = mesh.laws.interface.friction
    surface = dataclasses.replace(sector.surface)
    surface.__dict__["points"] = sector.body.places.reshape(*surface.weights.shape, 3)
    point = PointFriction(
        DAHL, friction.mu, friction.limit, VECTOR, friction.exponent, reference=friction.reference
    )
    whole = np.zeros((len(q) - 1, 2))
    for place in range(mesh.teeth):
        tooth = float(mesh.gathered[place]["tooth"])
        problem = IncrementProblem(
            sector.body.flexibility,
            surface,
            RigidSurface.worm(sector.wheel.pair.worm, side=1),
            NormalLaw("linear", CONTACT_STIFFNESS),
            point,
        )
        solver, state = IncrementSolver(problem), ContactState.rest(problem)

        def pose(p, tooth=tooth):
            rotation, translation = np.empty((3, 3)), np.empty(3)
            angle = p[2] + mesh.ahead + mesh.stand.pitch * tooth
            shift = np.array([0.0, 0.0, -p[1]])
            place_worm(mesh.stand, p[0], shift, angle, p[3], 1, rotation, translation)
            return Pose(rotation, translation)

        slid = q[0] - np.array([1e-3, 0.0, 1e-3 / model.point.ratio, 0.0, 0.0])
        ways = [(slid, q[0]), (slid, q[0]), *itertools.pairwise(q)]
        for k, (before, after) in enumerate(ways):
            motion = SurfaceMotion(pose(after), base_1=Drift.between(pose(before), pose(after)))
            found = solver.solve(np.zeros(len(sector.body.flexibility)), motion, state)
            state = found.state
            if k >= 2:
                force = found.force.reshape(-1, 3)
                at = sector.surface.positions + found.displacement.reshape(-1, 3)
                whole[k - 2, 0] += np.cross(at, force)[:, 2].sum()
                whole[k - 2, 1] -= force[:, 2].sum()
    damped = mesh.damping * 100e-6 * 2.0 * math.pi * 20e3 * 0.065
    np.testing.assert_allclose(outs[:, AT.wheel_torque], whole[:, 0], rtol=2e-3 + damped)
    np.testing.assert_allclose(outs[:, AT.wheel_force], whole[:, 1], rtol=2e-3 + damped)


def closure(model, way, count=160):
    """What the mesh was given, and what of it is neither lost nor stored, in parts of that."""
    q, v = moved(model, count, way)
    outs, _ = marched(model, q, v)
    middle = 0.5 * (outs[1:, :POSES] + outs[:-1, :POSES])
    given = -float((middle * np.diff(q[1:], axis=0)).sum())
    lost = float(outs[1:, AT.friction].sum() + outs[1:, AT.damping].sum())
    stored = float(outs[-1, AT.stored] - outs[0, AT.stored])
    turned = float(np.abs(middle * np.diff(q[1:], axis=0)).sum())
    return (given - lost - stored) / turned, outs


@pytest.mark.slow
@pytest.mark.parametrize(
    ("amplitude", "limit"),
    # Sliding, in contact throughout, and lifting off at 5 m/s, which is 2.5 um a step.
    [(0.0, 1e-6), (100e-6, 1e-5), (600e-6, 1e-3)],
)
def test_what_the_teeth_are_given_is_lost_or_stored(amplitude, limit):
    left, outs = closure(model_of(), swung(amplitude))
    assert abs(left) < limit
    assert (outs[:, AT.friction] >= -1e-12).all()
    assert (outs[:, AT.damping] >= -1e-9 * outs[:, AT.stored].max()).all()
    assert outs[:, AT.residual].max() < 1e-6


@pytest.mark.slow
def test_a_wheel_that_runs_ahead_bears_on_its_other_flank():
    model = model_of()
    play = 0.28e-3 / (model.point.normal_z * model.point.arm)
    q, v = moved(model, 60, lambda t: ((play + 0.8e-3) * t / t[-1], (play + 0.8e-3) / t[-1]))
    outs, _ = marched(model, q, v)
    driving, back = outs[:, AT.driving], outs[:, AT.back]
    assert driving[0] > 0.0
    assert back[0] == 0.0
    assert driving[-1] == 0.0
    assert back[-1] > 0.0
    assert outs[-1, AT.wheel_torque] < 0.0
    assert ((driving == 0.0) & (back == 0.0)).any()
    assert not ((driving > 0.0) & (back > 0.0)).any()
    # While nothing touches nothing acts and nothing is kept.
    free = (driving == 0.0) & (back == 0.0)
    assert (outs[free, :4] == 0.0).all()
    assert (outs[free, AT.stored] == 0.0).all()


@pytest.mark.slow
def test_teeth_are_handed_over_at_a_pitch():
    model = model_of("drive.flanks=driving")
    q, v = moved(model, 3, swung(0.0))
    pitch = model.teeth.stand.pitch
    further = q + np.array([pitch * model.point.ratio, 0.0, pitch, 0.0, 0.0])
    here, there = (marched(model, way, v)[0] for way in (q, further))
    np.testing.assert_allclose(there[:, :6], here[:, :6], rtol=2e-6, atol=1e-3)
    assert states(model.teeth) == len(model.settled_in(q[0], 1.0))


def march_of(model):
    moving = system(model.problem, model)
    return March(model, moving, *begin(model.problem, model, moving), Run())


@pytest.mark.slow
def test_a_cycle_whose_slip_turns_round_is_solved_at_every_step_and_its_powers_balance():
    # Where the slip turns, points of a tooth stand at a kink between sticking and slipping back.
    model = model_of("drive.protocol=window", "drive.window=1", "vibration.velocity_ratio=1.5")
    answer = solve_shaken(model.problem, model, Run())
    assert answer.residual <= 1e-6
    assert answer.closure < 1e-3
    assert answer.steps > 900


@pytest.mark.slow
def test_powers_of_teeth_that_do_not_balance_are_no_answer():
    model = model_of(
        "drive.protocol=window", "drive.window=1", "vibration.mode=axial",
        "vibration.frequency=20 kHz", "vibration.displacement_amplitude=20 um",
        "drive.contact_damping=1000 s/m",
    )  # fmt: skip
    with pytest.raises(ConvergenceError, match="powers") as refused:
        solve_shaken(model.problem, model, Run())
    assert refused.value.exit_code == 3


@pytest.mark.slow
def test_a_vibration_near_the_teeth_s_own_is_noted_beside_their_lowest_mode():
    # Another implementation had 46 kHz for the lowest mode of this tooth, cut out with its rim.
    window = ("drive.protocol=window", "drive.window=1", "drive.flanks=driving")
    fast, slow = (
        model_of(*window, f"vibration.frequency={frequency}") for frequency in ("40 kHz", "15 kHz")
    )
    assert fast.tooth_mode == pytest.approx(46e3, rel=0.02)
    found = [solve_shaken(each.problem, each, Run()) for each in (fast, slow)]
    assert found[0].to_json()["tooth_mode_Hz"] == fast.tooth_mode
    told = [any("their inertia counts" in note for note in each.notes) for each in found]
    assert told == [True, False]


@pytest.mark.slow
def test_powers_of_teeth_under_a_worm_whose_shaft_bends_balance():
    model = model_of(
        "drive.protocol=window", "drive.window=1", "shaft.diameter=17 mm", "shaft.span=150 mm",
        "shaft.bearing_radial=100 kN/mm", "vibration.frequency=20 kHz",
    )  # fmt: skip
    answer = solve_shaken(model.problem, model, Run())
    assert answer.closure < 1e-4
    assert answer.torque_ratio == pytest.approx(1.0, abs=0.15)


@pytest.mark.slow
def test_teeth_in_motion_give_way_to_their_neighbours_as_loaded_ones_do():
    model = model_of("drive.flanks=driving", "drive.teeth=3")
    mesh, contact = model.teeth, model.contact
    pose = np.array([0.3, 0.0, 0.3 / model.point.ratio, 0.0, 0.0])
    model.balanced(pose, model.problem.load)
    taken = model.settled_in(pose, 1.0)
    out = np.zeros(OUTS)
    advance(mesh, taken, taken.copy(), pose, np.zeros(POSES), 1.0, out)
    # The loaded contact takes all of what teeth do to each other, the march its main shapes.
    alone = TeethContact(model.sector, 0.1344, coupled=False)
    together, apart = (
        each.act(pose[0], pose[2] + mesh.ahead, np.zeros(3)).wrench[5] for each in (contact, alone)
    )
    assert out[AT.wheel_torque] == pytest.approx(together, rel=5e-3)
    assert apart > 1.05 * together


@pytest.mark.slow
def test_a_screw_near_the_resonance_begins_of_elastic_teeth_as_of_these_reduced():
    # Six cycles of its way to the periodic state, which is in `benchmarks/drive_teeth_runs.py`.
    model = model_of(
        "drive.flanks=driving", "vibration.frequency=4 kHz", "vibration.velocity_ratio=1.2",
        "drive.protocol=window", "drive.window=6",
    )  # fmt: skip
    teeth = solve_shaken(model.problem, model, Run())
    reduced = solve_shaken(model.problem, ReducedModel(model.problem, GIVEN), Run())
    assert teeth.torque_ratio == pytest.approx(reduced.torque_ratio, abs=0.02)
    assert teeth.energy_ratio == pytest.approx(reduced.energy_ratio, abs=0.01)
    assert teeth.closure < 1e-4
    assert teeth.open_share == 0.0


@pytest.mark.slow
def test_a_vibration_of_nothing_changes_nothing_of_elastic_teeth():
    model = model_of(
        "drive.flanks=driving", "vibration.frequency=20 kHz", "vibration.velocity_ratio=1e-6",
        "drive.protocol=window", "drive.window=2",
    )  # fmt: skip
    found = solve_shaken(model.problem, model, Run())
    assert found.torque_ratio == pytest.approx(1.0, abs=1e-9)
    assert found.energy_ratio == pytest.approx(1.0, abs=1e-9)


@pytest.mark.slow
def test_by_the_standard_s_friction_teeth_are_loaded_as_without_vibration():
    settings = ("drive.friction=iso14521", "drive.flanks=driving", "drive.phases=8")
    model = model_of(*settings, "vibration.displacement_amplitude=1e-6 um", "drive.window=1")
    static = StaticModel(model.problem, Run())
    (pitch_sweep,) = static.sweeps([LoadCase(model.problem.load)])
    assert static.friction == pytest.approx(model.friction, rel=0.01)
    wanted = float(pitch_sweep.worm_torque.mean())
    point = model.point
    slope = point.worm_torque(1.0, static.friction) / point.worm_torque(1.0, model.friction)
    assert model.worm_torque * slope == pytest.approx(wanted, rel=1e-3)
    march = march_of(model)
    march.go(1)
    assert model.teeth.sliding.share == pytest.approx([1.0, 1.0], abs=1e-3)
    assert march.rows["worm_torque"][0] / march.rows["time"][0] == pytest.approx(-wanted, rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("way", [("vibration.mode=screw",), ("vibration.mode=torsional",)])
def test_by_the_standard_s_friction_they_go_with_the_speed_as_those_reduced(way):
    model = model_of(
        "drive.friction=iso14521", "drive.flanks=driving", "vibration.frequency=20 kHz",
        "vibration.velocity_ratio=0.9", "drive.protocol=window", "drive.window=6", *way,
    )  # fmt: skip
    teeth = solve_shaken(model.problem, model, Run())
    reduced = solve_shaken(model.problem, ReducedModel(model.problem, GIVEN), Run())
    constant = model_of(
        "drive.flanks=driving", "vibration.frequency=20 kHz", "vibration.velocity_ratio=0.9",
        "drive.protocol=window", "drive.window=6", *way,
    )  # fmt: skip
    plain = solve_shaken(constant.problem, ReducedModel(constant.problem, GIVEN), Run())
    assert teeth.torque_ratio == pytest.approx(reduced.torque_ratio, abs=0.02)
    assert abs(reduced.torque_ratio - plain.torque_ratio) > 0.03
    assert teeth.energy_ratio == pytest.approx(reduced.energy_ratio, abs=0.02)
    assert teeth.closure < 1e-4
    assert teeth.ledger.friction > 0.0


@pytest.mark.usefixtures("plain_kernels")
def test_asperities_keep_their_stiffness_as_the_friction_of_teeth_changes():
    model = model_of("drive.flanks=driving")
    given = model.teeth.laws.interface.friction
    found = point_at(given, 1.3)
    assert found.mu == 1.3 * given.mu
    assert found.mu / found.limit == pytest.approx(given.mu / given.limit, rel=1e-15)
    assert point_at(given, 1.0) == given


@pytest.mark.slow
def test_a_march_of_teeth_goes_on_to_the_bit_from_where_it_was_left():
    settings = ("drive.flanks=driving", "vibration.frequency=20 kHz")
    whole, first, other = (march_of(model_of(*settings)) for _ in range(3))
    for _ in range(3):
        whole.go(1)
    first.go(2)
    left = first.tree()
    # What other steps leave in the mesh's room is nothing to it.
    whole.mesh.settled_in(np.zeros(POSES), 1.0)
    other.restore(copy.deepcopy(left))
    other.go(1)
    assert other.rows.tobytes() == whole.rows.tobytes()
    assert other.committed.tobytes() == whole.committed.tobytes()


@pytest.mark.slow
def test_an_open_tooth_tells_how_fast_it_comes_near_before_it_touches():
    model = model_of()
    play = 0.5 * 0.28e-3 / (model.point.normal_z * model.point.arm)
    speed = -6.0 / model.point.arm
    last = 40

    def way(t):
        # From the middle of the play towards the flank that drives, at 6 m/s along the axis.
        return play + speed * (t - t[-1]) * 0.5, np.full_like(t, 0.5 * speed)

    q, v = moved(model, last, way)
    # It ends with the flank that drives just touched.
    q[:, 2] += float(model.sweeps[0].deflection[0]) - play
    outs, _ = marched(model, q, v)
    free = outs[:, AT.driving] == 0.0
    told = outs[free, AT.approach]
    assert free.sum() > 20
    assert told[0] == 0.0
    assert told[-3:] == pytest.approx(3.0 * model.point.normal_z, rel=0.1)


@pytest.mark.slow
def test_a_step_that_no_tooth_can_be_solved_for_ends_in_one_line(monkeypatch):
    model = model_of("drive.flanks=driving", "vibration.frequency=20 kHz")
    march = march_of(model)
    narrow = model.teeth._replace(work=Work.workspace(model.sector.body, 2))
    monkeypatch.setitem(model.__dict__, "teeth", narrow)
    with pytest.raises(ConvergenceError, match="the mesh are left with 1 of its forces"):
        march.stretches(1, 1e-6)


@pytest.mark.usefixtures("plain_kernels")
def test_a_small_matrix_is_inverted_and_one_without_inverse_refused():
    matrix = np.random.default_rng(3).normal(size=(7, 7))
    matrix[0, 0] = 0.0
    inverse, order, out = matrix.ravel().copy(), np.zeros(7, np.int64), np.zeros(7)
    assert invert(inverse, 7, order)
    apply(inverse, matrix[:, 2].copy(), out)
    np.testing.assert_allclose(out, np.eye(7)[2], atol=1e-13)
    matrix[3] = 2.0 * matrix[5]
    assert not invert(matrix.ravel(), 7, order)
    assert not invert(np.full(4, np.nan), 2, order)


@pytest.mark.slow
def test_a_worm_meets_teeth_where_the_next_set_of_them_begins(tmp_path):
    """Half a pitch from a tooth the next set began in the middle of the search."""
    case = tmp_path / "gear.toml"
    case.write_text(FORTY_TO_ONE)
    problem = DriveProblem.from_case(read_case(case, case_tables(), ("drive.teeth=1",)))
    contact = TeethContact(condensed(problem, Run()), 0.0)
    stand = contact.stand
    for turn in (0.5, 1.5, 0.4999, 0.2):
        beta = stand.ratio * stand.pitch * turn
        for along in np.linspace(-30e-6, 30e-6, 11):
            shift = np.array([0.0, 0.0, along])
            phi = contact.touching_angle(beta, shift)
            assert abs(contact.least_gap(beta, phi, shift)) <= 1e-10
            # It is the place at which they begin to touch.
            assert contact.least_gap(beta, phi + contact.side * 1e-6, shift) > 0.0
