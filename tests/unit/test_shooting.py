import math
from types import SimpleNamespace

import numpy as np
import pytest

from asperity.casefile import read_case
from asperity.errors import ConvergenceError
from asperity.friction import Friction
from asperity.slider import TABLES, Model, Slider, Solve, shooting, solve
from asperity.slider.cycle_map import Cycle
from asperity.slider.periodic import cycle_steps, solve_periodic
from asperity.slider.scaled import SPRINGS
from asperity.slider.shooting import ACCEPTED
from asperity.vibration import Vibration

pytestmark = pytest.mark.usefixtures("plain_kernels")

LAWS = ["split", "unsplit", "vector"]
RIGID = {"slider.drive_stiffness": None, "slider.drive_damping": None}


def body(name, *settings, **values):
    case = read_case(name, TABLES, ["solve.method=periodic", *settings])
    return Model.from_case(case.replace_values(values))


def solved(name, *settings, history=False, **values):
    return solve(body(name, *settings, **values), history=history)


def falling(stribeck_velocity, static_mu):
    """A slow body on a soft drive whose friction falls with speed."""
    slider = Slider(
        drive_velocity=0.5e-3, normal_force=50.0, mass=1.0, drive_stiffness=1e4, units="SI"
    )
    friction = Friction(
        model="lugre", mu=0.1, static_mu=static_mu, stribeck_velocity=stribeck_velocity,
        max_deflection=7e-8, units="SI"
    )  # fmt: skip
    vibration = Vibration(frequency=3e3, velocity_ratio=0.2, units="SI")
    return Model(slider, friction, vibration, Solve(method="periodic"))


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("lateral", ["free", "guided"])
@pytest.mark.parametrize("theta", [0, 20, 45, 80, 90])
def test_the_state_repeats_itself(theta, lateral, law):
    settings = f"vibration.direction={theta} deg", f"slider.lateral={lateral}"
    answer = solved("table-4.4", *settings, f"friction.law={law}", history=True)
    assert answer.residual <= ACCEPTED
    history = answer.history
    # The rows begin a step after the state at which the cycle starts and ends.
    first = history.drive_force[0] - history.drive_force[-1]
    steps = np.abs(np.diff(history.drive_force)).max()
    assert abs(first) <= 1.1 * steps
    assert answer.ledger.stored == 0.0
    assert answer.ledger.residual < 1e-6


@pytest.mark.slow
@pytest.mark.parametrize("case", ["table-4.3", "table-4.4"])
@pytest.mark.parametrize("law", LAWS)
def test_marching_on_from_the_periodic_state_stays_there(case, law):
    periodic = solved(case, f"friction.law={law}", "vibration.direction=30 deg")
    marched = solved(
        case, f"friction.law={law}", "vibration.direction=30 deg", "solve.method=march",
        "solve.duration=3 s",
    )  # fmt: skip
    assert periodic.ratio == pytest.approx(marched.ratio, rel=1e-3)
    for name in ("friction_mean", "friction_max", "friction_min"):
        here, there = getattr(periodic, name), getattr(marched, name)
        assert here == pytest.approx(there, abs=3e-3 * marched.static_drive_force)
    assert periodic.ledger.vibration == pytest.approx(marched.ledger.vibration, rel=2e-3)
    assert periodic.ledger.friction == pytest.approx(marched.ledger.friction, rel=2e-3)


@pytest.mark.parametrize("k", [0.0, 0.25, 0.99, 1.0])
@pytest.mark.parametrize("theta", [0, 180])
def test_where_the_slip_never_reverses_friction_sits_at_its_limit(theta, k):
    answer = solved(
        "table-4.3", f"vibration.velocity_ratio={k}", f"vibration.direction={theta} deg"
    )
    assert answer.ratio == 1.0
    assert answer.friction_max == (5.5, 0.0)
    assert answer.friction_min == (5.5, 0.0)
    assert answer.residual < 1e-12


def test_just_above_it_the_ratio_falls_without_a_jump():
    ratios = [
        solved("table-4.3", f"vibration.velocity_ratio={k}").ratio
        for k in (1.0, 1.0001, 1.01, 1.05, 1.2)
    ]
    assert ratios[0] == 1.0
    assert np.all(np.diff(ratios) <= 1e-9)
    assert ratios[1] == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("exponent", [0, 0.5, 1, 1.5, 2])
@pytest.mark.parametrize("law", LAWS)
def test_every_exponent_has_its_periodic_state(law, exponent):
    settings = f"friction.law={law}", f"friction.exponent={exponent}", "vibration.direction=60 deg"
    answer = solved("table-4.4", *settings, history=True)
    assert np.hypot(*answer.history.friction.T).max() <= 5.08 * (1.0 + 1e-12)
    assert 0.0 < answer.ratio < 1.0


@pytest.mark.parametrize("theta", [0, 60])
def test_it_needs_no_mass_and_no_drive_stiffness(theta):
    settings = "slider.lateral=guided", f"vibration.direction={theta} deg"
    periodic = solved("table-4.4", *settings, **RIGID)
    marched = solved("table-4.4", *settings, "solve.method=march", **RIGID)
    assert periodic.ratio == pytest.approx(marched.ratio, rel=2e-4)


def test_a_body_free_across_a_rigid_drive_has_one_too():
    settings = "slider.lateral=free", "vibration.direction=60 deg"
    periodic = solved("table-4.4", *settings, **RIGID)
    marched = solved("table-4.4", *settings, "solve.method=march", **RIGID)
    assert periodic.ratio == pytest.approx(marched.ratio, rel=2e-4)


@pytest.mark.parametrize("theta", [0, 45, 90])
def test_rigid_friction_with_mass_has_its_periodic_state(theta):
    settings = "friction.model=coulomb", f"vibration.direction={theta} deg"
    periodic = solved("table-4.4", *settings, "solve.step=0.5 us")
    marched = solved("table-4.4", *settings, "solve.step=0.5 us", "solve.method=march")
    assert periodic.ratio == pytest.approx(marched.ratio, rel=2e-4)


def test_start_and_duration_have_no_meaning():
    plain = solved("table-4.4")
    other = solved("table-4.4", "vibration.start=0 s", "solve.duration=1 ms")
    assert other.ratio == plain.ratio
    assert plain.breakaway_time is None


@pytest.mark.parametrize("waveform", ["triangle", "square"])
def test_kinks_of_the_waveform_meet_the_steps(waveform):
    settings = [f"vibration.waveform={waveform}", "vibration.direction=45 deg"]
    if waveform == "square":
        settings.append("vibration.rise_time=50 us")
    model = body("table-4.4", *settings)
    assert cycle_steps(model) % 4 == 0
    coarse = solve(model, history=False).ratio
    fine = solved("table-4.4", *settings, "solve.step=0.05 us").ratio
    assert coarse == pytest.approx(fine, rel=2e-3)


def test_at_least_256_steps_make_a_cycle():
    assert cycle_steps(body("table-4.3", "solve.step=10 us", "vibration.velocity_ratio=1")) == 256
    assert cycle_steps(body("table-4.3", "solve.step=0.1 us")) == 2500


def test_the_history_is_one_cycle():
    answer = solved("table-4.3", history=True)
    history = answer.history
    assert history.time[-1] == pytest.approx(1.0 / 4000.0, rel=1e-12)
    assert history.drive_force.mean() == pytest.approx(answer.drive_force, rel=1e-9)
    mean_velocity = history.velocity[:, 0].mean()
    assert mean_velocity == pytest.approx(0.5e-3, rel=1e-9)


def test_it_takes_few_cycles():
    counts = [
        solved(
            "table-4.4", f"vibration.velocity_ratio={k}", f"vibration.direction={theta} deg"
        ).cycles
        for k in (2, 6, 20)
        for theta in (0, 45, 90)
    ]
    assert max(counts) <= 30


def test_an_unstable_state_is_told():
    answer = solve(falling(stribeck_velocity=5e-3, static_mu=0.15), history=False)
    assert any("unstable" in note for note in answer.notes)
    assert solved("table-4.4").notes == ()


@pytest.mark.parametrize(
    ("over_64", "over_256", "grows"),
    [
        (1.002, 1.008, True),
        # A corner of the map or rounding, which adds once however long it is looked at.
        (1.002, 1.003, False),
        (1.0005, 1.5, False),
        # Rounding is any size over any time, and what leaves the finite numbers has told nothing.
        (1.002, 1.02, False),
        (1.002, 0.0, False),
        (math.inf, math.inf, False),
    ],
)
def test_what_hardly_grows_is_told_by_longer_times_in_which_it_does(over_64, over_256, grows):
    told, cycles = {64: over_64, 256: over_256}, []
    cycle = SimpleNamespace(_growth_over=lambda over: [cycles.append(over), told[over]][1])
    assert Cycle.grows_slowly(cycle, 1.0001) is grows
    # What has not grown over the shorter time is followed no longer.
    assert cycles == ([64, 256] if over_64 > 1.001 else [64])
    assert not Cycle.grows_slowly(cycle, 1.00001)
    assert not Cycle.grows_slowly(cycle, 1.01)


@pytest.mark.parametrize("name", ["table-4.4", "normal-pin"])
def test_a_growth_over_many_cycles_is_that_of_one_so_many_times(name):
    """Of a state that fades; as of the map over those cycles that is found anew."""
    model = body(name, "solve.method=periodic")
    steps = cycle_steps(model)
    cycle = Cycle(model, steps, 1.0 / (steps * model.frequency))
    assert cycle.find(0)
    growth, found = cycle.multiplier(), cycle.copied()
    found.repeat(4)
    assert found.find(0)
    assert cycle._growth_over(1) == pytest.approx(growth, rel=1e-4)
    assert cycle._growth_over(4) == pytest.approx(growth**4, rel=1e-3)
    assert cycle._growth_over(4) == pytest.approx(found.multiplier(), rel=1e-3)


def test_a_push_fades_as_a_drive_has_it_that_is_damped_beyond_ringing():
    """Coulomb friction that never reverses is a load: m x'' + c x' + k x is constant."""
    mass, damping, stiffness, frequency = 1e-3, 200.0, 1e4, 1e3
    slider = Slider(
        drive_velocity=0.5e-3, normal_force=50.0, mass=mass, drive_stiffness=stiffness,
        drive_damping=damping, units="SI"
    )  # fmt: skip
    shaken = Vibration(frequency=frequency, velocity_ratio=0.2, units="SI")
    friction = Friction(model="coulomb", mu=0.1, units="SI")
    cycle = Cycle(Model(slider, friction, shaken, Solve(method="periodic")), 100, 1e-5)
    assert cycle.find(0)
    rate = (damping - math.sqrt(damping**2 - 4.0 * stiffness * mass)) / (2.0 * mass)
    a_cycle, _ = cycle._of_pushes(1e-3, 1.1)
    assert a_cycle == pytest.approx(math.exp(-rate / frequency), rel=1e-6)


def test_a_body_that_sticks_and_slips_at_its_own_rate_has_no_state_that_stays():
    answer = solve_periodic(falling(stribeck_velocity=1e-3, static_mu=0.2), history=False)
    assert not answer.settled
    assert "a disturbance grows" in answer.settled_by


def test_where_no_state_repeats_itself_what_was_reached_is_told():
    settings = (
        "friction.law=split", "friction.exponent=0.5", "vibration.direction=90 deg",
        "slider.lateral=guided",
    )  # fmt: skip
    with pytest.raises(ConvergenceError) as raised:
        solve_periodic(body("table-4.3", *settings))
    error = raised.value
    assert len(str(error).splitlines()) == 1
    assert "solve.method 'march' shows what it does" in str(error)
    assert error.reached["residual"] > ACCEPTED
    assert error.reached["cycles"] > 0


def test_the_untransferred_motion_of_a_free_vibrated_body_is_no_obstacle():
    settings = "vibration.applied_to=body", "friction.transfer=0", "vibration.direction=50 deg"
    answer = solved("table-4.4", *settings)
    guided = solved("table-4.4", *settings, "slider.lateral=guided")
    assert answer.ratio == pytest.approx(guided.ratio, rel=1e-9)
    assert math.isfinite(answer.ledger.untransferred)


def test_a_body_without_a_state_that_is_found_to_repeat_is_marched_and_told():
    settings = (
        "friction.law=split", "friction.exponent=0.5", "vibration.direction=90 deg",
        "slider.lateral=guided",
    )  # fmt: skip
    answer = solved("table-4.3", *settings)
    marched = solved("table-4.3", *settings, "solve.method=march")
    assert answer.method == "march"
    assert answer.notes[0].endswith("this is a march")
    assert answer.ratio == marched.ratio


def test_where_that_march_cannot_be_the_first_trouble_is_told():
    settings = (
        "friction.law=split", "friction.exponent=0.5", "vibration.direction=90 deg",
        "slider.lateral=guided", "solve.duration=1 ms",
    )  # fmt: skip
    with pytest.raises(ConvergenceError, match="no periodic state found"):
        solved("table-4.3", *settings)


def test_friction_at_the_start_of_a_cycle_is_the_mean_over_the_asperities():
    # By their weights, which quadrature over the heights makes unlike each other.
    rng = np.random.default_rng(5)
    springs, weights = rng.normal(size=(2, 7)), rng.dirichlet(np.ones(7))
    state = SimpleNamespace(
        rise=0.1, penetration=0.4, velocity_x=0.2, stretch=0.3, deflection_x=9.0, deflection_y=9.0,
        friction_x=9.0, friction_y=9.0, load=0.0, drive_force=0.0,
    )  # fmt: skip
    p = SimpleNamespace(model=SPRINGS, stiffness=2.0, damping=0.5, drive=1.0)
    q = SimpleNamespace(
        base=1.0, law=0, mobility=0.1, damping=0.0, load_power=1.0, weights=weights, keeps=0
    )
    shooting._forces._function(state, springs, p, q, np.array([0.0, 0.1, 0.0]))
    assert [state.friction_x, state.friction_y] == pytest.approx(springs @ weights)
    assert state.drive_force == pytest.approx(2.0 * 0.3 + 0.5 * (1.0 - 0.2))


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_differences_are_taken_of_each_unknown_towards_its_inside(monkeypatch, side):
    """Of a linear map, with slopes of the mean drive force, on scales of their own."""
    rng = np.random.default_rng(3)
    matrix, slopes, scales = rng.normal(size=(3, 3)), rng.normal(size=3), np.array([1.0, 5.0, 0.2])
    here, went = np.array([0.4, -0.3, 0.0]), []
    trial = np.zeros(1, [("at", float, 3)])

    def read(state, springs, p, q, out):
        out[:] = here

    def write(given, p, q, state, springs):
        went.append((given - here) / scales)
        state["at"] = given

    def defect_of(state, *others):
        others[-1][:] = matrix @ (state[0]["at"] / scales)

    for name, plain in {
        "read_unknowns": read, "write_unknowns": write, "defect_of": defect_of,
        "mean_drive": lambda sums, start, *_: slopes @ (start["at"] / scales),
        "copy": lambda one, other: other.__setitem__(slice(None), one),
    }.items():  # fmt: skip
        monkeypatch.setattr(shooting, name, plain)
    room = SimpleNamespace(
        trial=trial, trial_springs=np.zeros(1), trial_end=trial, trial_end_springs=None,
        scales=scales, here=np.zeros(3), there=np.zeros(3), trial_defect=np.zeros(3),
        defect=matrix @ (here / scales),
    )  # fmt: skip
    jacobian = np.zeros((4, 3))
    shooting.differentiate._function(
        trial.copy(), np.zeros(1), None, None, None, None, None, 3, 1e-3, side,
        slopes @ (here / scales), room, jacobian,
    )  # fmt: skip
    assert np.array(went) == pytest.approx(side * 1e-3 * np.diag([-1.0, 1.0, 1.0]), abs=1e-15)
    assert jacobian[:3] == pytest.approx(matrix, abs=1e-10)
    assert jacobian[3] == pytest.approx(slopes, abs=1e-10)


@pytest.mark.parametrize(
    ("aim", "tried"),
    [((2.4, 3.2), (0.72, 0.96)), ((-3.2, 2.4), (-0.96, 0.72)), ((1.02, -1.36), (1.02, -1.36))],
)
def test_newton_brings_what_is_beyond_the_limit_back_along_its_direction(monkeypatch, aim, tried):
    # A plain map of which Newton's step is exact; friction holds up to 1.2, and half as much
    # again is left to the search.
    kept = np.dtype([("deflection_x", float), ("deflection_y", float)])
    start, end, trial, trial_end = (np.zeros(1, kept).view(np.recarray) for _ in range(4))
    seen = []

    def read(state, springs, p, q, out):
        out[:] = state.deflection_x, state.deflection_y

    def write(given, p, q, state, springs):
        state.deflection_x, state.deflection_y = given

    def defect_of(state, *others):
        seen.append(tuple(state[0].item()))
        others[-1][:] = np.subtract(seen[-1], aim)
        return np.abs(others[-1]).max()

    def differentiate(*arguments):
        arguments[-1][:] = np.eye(2)

    def eliminate(matrix, step, count, least):
        step[:] = np.linalg.solve(matrix, step)
        return True

    for name, plain in {
        "read_unknowns": read, "write_unknowns": write, "defect_of": defect_of,
        "differentiate": differentiate, "eliminate": eliminate,
        "mean_drive": lambda *_: 0.0, "copy": lambda *_: None,
    }.items():  # fmt: skip
        monkeypatch.setattr(shooting, name, plain)
    arrays = {name: np.zeros(2) for name in ("here", "there", "defect", "trial_defect", "step")}
    room = SimpleNamespace(
        trial=trial, trial_end=trial_end, trial_springs=None, trial_end_springs=None,
        scales=np.ones(2), matrix=np.zeros((2, 2)), **arrays,
    )  # fmt: skip
    p = SimpleNamespace(model=SPRINGS, static_ratio=1.2)
    shooting._newton._function(
        start, None, p, None, None, None, None, 2, np.zeros((2, 2)), room, end, None
    )
    assert seen[1] == pytest.approx(tried)
