"""Bodies that slide back in every second cycle only, shaken at up to twice a resonance.

A bent asperity is soft the way it is bent and stiff the other. An oscillator of two stiffnesses,
like a moored tower (Thompson and Stewart, Nonlinear Dynamics and Chaos), answers near twice its
own frequency with a large motion at half of what shakes it, beside a small one at the whole of it;
which of the two comes follows from where it comes from.
"""

import math
import re

import pytest
from apparatus.grid import slow

from asperity.casefile import read_case
from asperity.slider import TABLES, Model, from_rest, solve
from asperity.slider.cycle_map import Cycle
from asperity.slider.periodic import solve_periodic

# By lot, shaken at 1.74 times the resonance on asperities that are not bent.
HALVED = """
[slider]
drive_velocity = "2.189836041601042 mm/s"
normal_force = "1.7025853597046763 N"
mass = "0.4932068385147147 g"
drive_stiffness = "44457.29340695794 N/m"
drive_damping = "0.12889802224215405 N s/m"
[friction]
model = "lugre"
mu = 0.2543823968613899
max_deflection = "0.906054266521706 um"
law = "split"
contact_damping = "1.6088268189546808 N s/m"
transfer = 0.0
[vibration]
frequency = "8991.22074026986 Hz"
velocity_ratio = 1.1
direction = "180 deg"
"""

# By lot too, at 3.3 times: its slip turns round, and friction with it, which pumps it sideways.
PUMPED = """
[slider]
drive_velocity = "2.764212829926207 um/s"
normal_force = "0.37603227085756363 N"
mass = "164.18963904482944 g"
drive_stiffness = "52753.41583823562 N/m"
[friction]
model = "dahl"
mu = 0.2616150583277325
max_deflection = "0.19647837399508996 um"
law = "vector"
exponent = 0.3333333333333333
[vibration]
waveform = "square"
rise_time = "258.9094422066836 us"
frequency = "963.0665495240567 Hz"
velocity_ratio = 1.4319327942373707
direction = "3.181368329293012 rad"
"""


# A block on a way, shaken up at 2.4 times the resonance on its contact: it is thrown.
THROWN = """
[slider]
drive_velocity = "2 mm/s"
drive_stiffness = "250 kN/m"
drive_damping = "40 N s/m"
mass = "1.2 kg"
normal_force = "120 N"
[friction]
model = "dahl"
mu = 0.16
max_deflection = "0.3 um"
law = "vector"
[vibration]
frequency = "6 kHz"
elevation = "90 deg"
velocity_ratio = 20
[normal]
law = "hertz"
stiffness = "300 N/um"
damping_ratio = 0.05
"""


# By lot: pressed, with a friction that falls with the speed. It never comes to a state of four
# cycles that repeats itself, but sticks and slips as it likes.
FALLING = """
[slider]
drive_velocity = "29.024913304372294 um/s"
normal_force = "284.2676121334835 N"
mass = "24.392757921709197 kg"
lateral = "guided"
drive_stiffness = "742956.8928583713 N/m"
drive_damping = "667.2838313848516 N s/m"
[friction]
model = "lugre"
mu = 0.09449234470550519
max_deflection = "0.4581287661823846 um"
law = "split"
static_mu = 0.1711382904079558
stribeck_velocity = "10.45218755116122 um/s"
transfer = 0.0
load_exponent = 1.3
contact_damping = "10575.396568190232 N s/m"
viscous_damping = "495.8842426701624 N s/m"
[normal]
law = "hertz"
control = "force"
stiffness = "26283778.93933343 N/m"
damping_ratio = 0.06112920249164256
[vibration]
waveform = "triangle"
frequency = "492.21821822248586 Hz"
velocity_ratio = 0.8401255272414353
direction = "5.0941220804952225 rad"
"""


@pytest.fixture
def body(tmp_path):
    def of(case, *settings):
        path = tmp_path / "body.toml"
        path.write_text(case)
        return Model.from_case(read_case(path, TABLES, settings))

    return of


@pytest.mark.slow
@pytest.mark.parametrize("case", [slow(HALVED), PUMPED])
def test_the_state_is_shown_to_which_a_body_from_rest_comes(body, case):
    alone = solve_periodic(body(case, "solve.method=periodic"), history=False)
    state = solve(body(case, "solve.method=periodic"), history=False)
    marched = solve(body(case, "solve.method=march"), history=False)
    assert marched.settled
    assert state.ratio == pytest.approx(marched.ratio, abs=1e-3)
    assert state.settled_by.startswith("the state repeats itself every 2 cycles")
    assert alone.ratio > state.ratio + 0.04
    (note,) = state.notes
    assert f"with the ratio {alone.ratio:.5g}, repeats itself as well" in note


def test_a_body_swings_at_half_the_frequency_near_the_resonance_of_two_stiffnesses(body):
    model = body(HALVED, "solve.method=periodic")
    bent = solve(model, history=False).ratio
    asperities = model.full_friction / model.friction.max_deflection
    halves = [
        math.pi * math.sqrt(model.slider.mass / (asperities * share + model.slider.drive_stiffness))
        for share in (1.0 - bent, 1.0 + bent)
    ]
    assert model.frequency == pytest.approx(2.0 / sum(halves), rel=0.05)


@pytest.mark.parametrize("times", [1.2, 3.0])
def test_well_above_that_a_body_has_the_one_state(body, times):
    settings = f"vibration.frequency={times * 8991.2} Hz", "solve.method=periodic"
    state = solve(body(HALVED, *settings), history=False)
    assert state.settled
    assert not state.notes


def test_a_contact_bounces_in_every_second_cycle_where_that_of_a_body_from_rest_does():
    """At 4 kHz, 1.8 times the resonance of the contact, which a rising body loses."""
    settings = "vibration.velocity_ratio=18.3", "solve.method=periodic"
    model = Model.from_case(read_case("pin-on-disc", TABLES, settings))
    alone, state = solve_periodic(model, history=False), solve(model, history=False)
    assert (alone.normal.period, state.normal.period) == (1, 2)
    marched = Model.from_case(read_case("pin-on-disc", TABLES, settings[:1]))
    assert state.ratio == pytest.approx(solve(marched, history=False).ratio, abs=1e-5)
    assert alone.ratio > state.ratio + 0.1


@pytest.mark.parametrize(
    ("ramp", "period"), [(0.0, 2), (0.01, 1), pytest.param(0.1, 1, marks=pytest.mark.slow)]
)
def test_where_the_vibration_grows_slowly_a_body_from_rest_comes_to_the_small_motion(ramp, period):
    """The large one is there at once or not at all."""
    settings = "vibration.velocity_ratio=18.3", f"vibration.ramp={ramp} s"
    marched, state = (
        solve(Model.from_case(read_case("pin-on-disc", TABLES, (*settings, method))), history=False)
        for method in (f"solve.duration={ramp + 0.5} s", "solve.method=periodic")
    )
    assert state.settled
    assert state.normal.period == period
    assert state.ratio == pytest.approx(marched.ratio, abs=5e-4)
    spared = "vibration.velocity_ratio=18.3", "solve.method=periodic", "vibration.ramp=1e4 s"
    told = Model.from_case(read_case("pin-on-disc", TABLES, (*spared, "vibration.start=1 s")))
    (note,) = solve(told, history=False).notes
    assert note.endswith("the one from rest, without its vibration.start and vibration.ramp")


@pytest.mark.parametrize("ramp", [0.5, 2.5])
def test_a_vibration_grows_to_its_end_within_a_cycle_from_rest_as_in_a_march(ramp):
    """Left off at the whole cycle before, the cycles after are up to 33 % off."""
    period, steps = 0.25e-3, 100
    settings = (
        "solve.method=march", f"vibration.ramp={ramp * period!r} s", "vibration.start=0 s",
        f"solve.step={period / steps!r} s", f"solve.duration={40 * period!r} s",
    )  # fmt: skip
    model = Model.from_case(read_case("table-4.3", TABLES, settings))
    body = Cycle(model, steps, period / steps)
    from_rest._grow(body)
    grown = body.run
    last, *_ = from_rest._marched(body, 4)
    history = solve(model, history=True).history
    force = history.drive_force / (model.friction.mu * model.slider.normal_force)
    marched = force[grown * steps : (grown + 4) * steps].reshape(4, steps).mean(axis=1)
    assert last == pytest.approx(marched, rel=2e-3)


@pytest.mark.slow
def test_a_state_of_four_cycles_to_which_no_body_from_rest_comes_has_not_settled(body):
    state = solve(body(FALLING, "solve.method=periodic"), history=False)
    assert state.normal.period == 4
    assert not state.settled
    # Its cycles do not repeat themselves: the mean of any is by chance between 0.98 and 1.01.
    found = re.search(r"a body from rest stays at a ratio of (\S+)", state.settled_by)
    assert float(found[1]) == pytest.approx(0.995, abs=0.02)
    assert state.ratio == pytest.approx(0.9121, abs=1e-3)


@pytest.mark.parametrize(("ratio", "from_rest"), [(20, 0.07706), (29, 0.05605)])
def test_a_body_that_is_thrown_is_shown_as_it_bounces_from_rest(tmp_path, ratio, from_rest):
    """By a semi-implicit program of another hand; it bounces every cycle too, 0.1198 and 0.0826."""
    path = tmp_path / "thrown.toml"
    path.write_text(THROWN)
    case = read_case(path, TABLES, ["solve.method=periodic", f"vibration.velocity_ratio={ratio}"])
    found = solve(Model.from_case(case), history=False)
    assert found.settled
    assert found.ratio == pytest.approx(from_rest, rel=2e-3)
    assert found.normal.period == 3
    assert any("repeats itself as well" in note for note in found.notes)


@pytest.mark.slow
def test_a_march_that_rings_beside_a_state_is_followed_to_where_it_comes():
    """To one of four cycles, at -0.0275; after 284 cycles it is next to one of a cycle."""
    settings = (
        "slider.mass=1.702809308205 kg", "slider.drive_stiffness=1633406.373914 N/m",
        "slider.drive_damping=40 N s/m", "slider.drive_velocity=1.102083922495 mm/s",
        "slider.normal_force=8.579265055564 N", "friction.max_deflection=60.63397492629 nm",
        "friction.law=vector", "friction.transfer=1", "vibration.start=0 s",
        "vibration.frequency=5862.690533360 Hz", "vibration.velocity_ratio=5.325863921517",
        "vibration.elevation=60 deg", "normal.law=hertz", "normal.stiffness=316826738.13198 N/m",
        "normal.damping_ratio=0.02", "normal.control=force", "solve.method=periodic",
    )  # fmt: skip
    case = read_case("table-4.3", TABLES, settings).replace_values({"solve.step": None})
    found = solve(Model.from_case(case), history=False)
    assert not found.settled
    assert "a body from rest stays at a ratio of -0.027" in found.settled_by


@pytest.mark.parametrize(
    ("case", "settings", "from_rest"),
    [
        pytest.param(HALVED, [], 0.54189, marks=pytest.mark.slow),
        (THROWN, ["vibration.velocity_ratio=20"], 0.07714),
    ],
)
def test_a_cycle_mean_law_says_that_a_body_from_rest_moves_otherwise(
    body, case, settings, from_rest
):
    found = solve(body(case, "solve.method=homogenised", *settings), history=False)
    assert not found.settled
    assert found.ratio > from_rest + 0.04
    assert found.ratio_from_rest == pytest.approx(from_rest, abs=2e-5)
    other = f"another state than that of the law, with the ratio {found.ratio_from_rest:.5g}"
    said = f"a body from rest comes to {other}"
    assert said in found.settled_by
    assert f"at the drive velocity {said}: see solve.method 'periodic' and 'march'" in found.notes
    assert not [note for note in found.notes if "would do" in note]


@pytest.mark.slow
def test_a_cycle_mean_law_is_settled_where_a_body_from_rest_comes_to_its_state(body):
    found = solve(
        body(HALVED, "solve.method=homogenised", "vibration.frequency=27 kHz"), history=False
    )
    assert found.ratio_from_rest is None
    assert "another state" not in found.settled_by
