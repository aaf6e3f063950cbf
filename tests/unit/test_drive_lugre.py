"""LuGre's law between the teeth of a reduced drive: its limits, its ledger, what it refuses."""

import math

import numpy as np
import pytest
from apparatus.drives import ASPERITIES, GIVEN, all_solved, case, problem

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.drive.locking import answer as locking
from asperity.drive.locking import prepare as prepare_locking
from asperity.drive.problem import DriveProblem
from asperity.drive.reduced.in_series import ductile
from asperity.drive.reduced.lugre import LuGre, deflect_damped
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import reduction, teeth_key
from asperity.drive.static.solve import friction_of
from asperity.errors import InputError
from asperity.friction.dahl import VECTOR
from asperity.friction.lugre import lugre_loaded
from asperity.runs import Run

LUGRE = "friction.model=lugre"
SHORT = "solve.duration=6 ms"
DAMPED = (
    LUGRE, "friction.static_mu=0.18", "friction.stribeck_velocity=0.1 m/s",
    "friction.contact_damping=150 N s/m", "friction.viscous_damping=20 N s/m",
)  # fmt: skip
RATTLING = (
    "vibration.mode=axial", "vibration.frequency=6 kHz",
    "vibration.displacement_amplitude=160 um",
)  # fmt: skip
FAST = (
    "vibration.frequency=20 kHz", "vibration.velocity_ratio=1.842", "drive.flanks=driving",
    "friction.max_deflection=0.02 um", ASPERITIES,
)  # fmt: skip


def drawn_steps(count, seed):
    """Yield laws, and of steps that follow one another what changes, of any size."""
    rng = np.random.default_rng(seed)
    for _ in range(count):
        ratio = 1.0 + rng.choice([0.0, rng.uniform(0.0, 1.5)])
        # Speeds over that of a slip of one in a second; the fastest is 1 of them.
        dt = 10 ** rng.uniform(-3.0, 1.0)
        slip_time = rng.choice([0.0, 10 ** rng.uniform(-2.0, 1.0)])
        most = (slip_time + ratio) / (ratio - 1.0) if ratio > 1.0 else 10.0
        law = LuGre(
            True, ratio, 10 ** rng.uniform(-2.0, 0.5), rng.uniform(0.0, 1.0) * most, slip_time
        )
        more = rng.choice([0.0, 10 ** rng.uniform(-1.0, 2.0)])
        loads = np.abs(np.cumsum(rng.normal(0.0, 0.3, 40)) + 1.0)
        loads[rng.random(40) < 0.05] = 0.0
        ways = np.cumsum(rng.normal(0.0, 0.4, (40, 2)), axis=0)
        ways *= np.minimum(1.0, 1.0 / np.linalg.norm(ways, axis=1))[:, None] * dt
        yield law, more, dt, loads, ways


@pytest.mark.slow
@pytest.mark.usefixtures("plain_kernels")
def test_in_ten_thousand_steps_of_any_size_asperities_and_teeth_make_no_energy():
    slow = steps = 0
    for law, more, dt, loads, ways in drawn_steps(300, 5):
        s = r = (0.0, 0.0)
        share, before = 1.0, 1.0
        for load, way in zip(loads, ways, strict=True):
            wx, wy, hx, hy, tx, ty, share, off = deflect_damped(
                law, more, *s, *r, *way, before, load, load, share, 1.0 / dt, dt
            )
            w, h, t = np.array([wx, wy]), np.array([hx, hy]), np.array([tx, ty])
            assert off <= 1e-6
            # The teeth leave of the way what they do not bend by.
            bent = more * (w + h - s - np.array(r))
            assert np.abs(t + bent - way).max() <= 1e-9 * (1.0 + np.abs(bent).max())
            assert 1.0 <= share <= law.static_ratio
            if np.linalg.norm(t) <= dt:
                slow += 1
                moved = w - s
                lost = w @ (t - moved) + 0.5 * moved @ moved + h @ t
                assert lost >= -1e-9 * (1.0 + w @ w)
            s, r, before, steps = (wx, wy), (hx, hy), load, steps + 1
    assert slow > 0.8 * steps > 8000


@pytest.mark.usefixtures("plain_kernels")
@pytest.mark.parametrize(
    ("above", "way", "compliance"),
    [
        ((0.25528921, -0.9775963), (0.47360269, 6.25277318), 856.38853),
        ((-1.29149611, 0.12874437), (0.0005108, -0.0003126), 3.4170292),
        ((-1.1457482, 0.08761238), (2.62764061, 1.47537641), 24.648451),
    ],
)
def test_asperities_above_their_limit_relax_over_the_slip_that_bent_teeth_leave(
    above, way, compliance
):
    s, d = np.array(above), np.array(way)
    *w, left = ductile(*s, *d, 1.0, 1.0, compliance)
    slip = d - compliance * (w - s)
    length = np.linalg.norm(slip)
    relaxed = s * math.exp(-length) - slip * math.expm1(-length) / length
    assert w == pytest.approx(relaxed, abs=1e-8)
    assert left < 1e-8


@pytest.mark.slow
@pytest.mark.usefixtures("plain_kernels")
def test_of_rigid_teeth_a_step_is_that_of_the_friction_room_s_law():
    for law, _, dt, loads, ways in drawn_steps(60, 6):
        s, share, before = (0.0, 0.0), 1.0, 1.0
        for load, way in zip(loads, ways, strict=True):
            wx, wy, hx, hy, _, _, share, _ = deflect_damped(
                law, 0.0, *s, 0.0, 0.0, *way, before, load, load, share, 1.0 / dt, dt
            )
            if load > 0.0 and before > 0.0:
                for rate_time in (law.rate_time, 0.0):
                    new, whole, _, _ = lugre_loaded(
                        s, tuple(way), (0.0, 0.0), 1.0, before, load, dt, law.static_ratio,
                        law.stribeck_speed, rate_time, law.slip_time, VECTOR,
                    )  # fmt: skip
                    moved = np.subtract(new, s)
                    if load * np.dot(whole, way) - np.dot(new, moved) + 0.5 * moved @ moved >= 0.0:
                        break
                assert (wx, wy) == pytest.approx(new, rel=1e-8, abs=1e-9)
                found = ((wx + hx) / load, (wy + hy) / load)
                # Below a load of one both are known to its inverse less.
                assert found == pytest.approx(whole, rel=1e-7, abs=1e-8 / load)
            s, before = (wx, wy), load


@pytest.mark.parametrize("way", [(), RATTLING, (ASPERITIES,)])
def test_without_stribeck_and_dampings_it_is_dahl_s(way):
    dahl, lugre = all_solved([(SHORT, *way), (SHORT, LUGRE, *way)])
    assert lugre.torque_ratio == pytest.approx(dahl.torque_ratio, abs=1e-9)
    assert lugre.ledger.friction == pytest.approx(dahl.ledger.friction, rel=1e-9)
    assert lugre.torque_ratio_closed_form == dahl.torque_ratio_closed_form


def test_its_powers_balance_in_contact_and_while_both_flanks_hammer():
    contact, hammering = all_solved([(SHORT, *DAMPED), (SHORT, *DAMPED, *RATTLING)])
    assert contact.open_share == 0.0
    assert contact.closure < 1e-5
    assert hammering.second_flank_share > 0.01
    assert hammering.open_share > 0.2
    assert hammering.closure < 3e-3
    for one in (contact, hammering):
        assert one.ledger.friction > 0.0
        assert one.torque_ratio_closed_form is None


def test_without_vibration_to_speak_of_it_runs_at_the_friction_of_its_speed():
    (one,) = all_solved([(*DAMPED, SHORT, "vibration.displacement_amplitude=1e-6 um")])
    assert one.torque_ratio == pytest.approx(1.0, abs=1e-6)
    assert one.torque_balance == pytest.approx(0.0, abs=1e-6)
    given = one.problem
    model = ReducedModel(given, reduction(given, Run()))
    speed = model.sliding_speed
    mu = 0.1344 + 0.0456 * math.exp(-((speed / 0.1) ** 2)) + 20.0 * speed / model.normal_force
    assert model.friction == pytest.approx(mu, rel=1e-12)
    assert one.torque_static == pytest.approx(model.point.worm_torque(366.0, mu), rel=1e-12)


@pytest.mark.slow
def test_a_fast_screw_has_the_mean_of_its_kinetic_friction_and_all_of_the_viscous():
    # Where static friction is lost at once and comes back for a negligible time.
    kinetic, viscous = all_solved(
        [(*FAST, LUGRE, "friction.static_mu=0.15", "friction.stribeck_velocity=0.02 m/s"),
         (*FAST, LUGRE, "friction.viscous_damping=20 N s/m")]
    )  # fmt: skip
    model = ReducedModel(kinetic.problem, reduction(kinetic.problem, Run()))
    point, share = model.point, 2.0 / math.pi * math.asin(1.0 / 1.842)
    torque = point.worm_torque(366.0, 0.1344 * share)
    assert kinetic.torque == pytest.approx(torque, rel=0.005)
    still = ReducedModel(viscous.problem, reduction(viscous.problem, Run()))
    wet = still.friction - 0.1344
    assert wet > 0.004
    torque = point.worm_torque(366.0, 0.1344 * share + wet)
    assert viscous.torque == pytest.approx(torque, rel=0.005)


@pytest.mark.slow
def test_it_holds_by_its_static_friction_and_creeps_at_any_amplitude():
    settings = (
        SHORT,
        LUGRE,
        "friction.static_mu=0.25",
        "friction.stribeck_velocity=0.05 m/s",
        "friction.exponent=1",
    )
    given = prepare_locking(case(*settings, name="drive-actuator"))
    model = ReducedModel(given, reduction(given, Run()))
    assert model.holding == 0.25
    answer = locking(given, Run())
    assert answer.holding_share == pytest.approx(model.point.holding_share(0.25), rel=1e-12)
    assert any("creep at any amplitude" in note for note in answer.notes)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ([*DAMPED, "friction.contact_damping=2 kN s/m"], "it may be at most .* N s/m, or more"),
        (["friction.model=lugre", "friction.static_mu=0.1"], "must not be below friction.mu"),
        (["friction.model=lugre", "friction.static_mu=0.2"], "stribeck_velocity must be"),
        (["friction.model=lugre", "friction.exponent=0"], "LuGre knows exponent 1 only"),
        (["friction.model=lugre", "friction.keeps=deflection"], "makes energy"),
        (["friction.static_mu=0.2"], "is for model 'lugre'"),
        (["friction.model=lugre", "friction.contact_damping=-1 N s/m"], "contact_damping"),
        ([*DAMPED, "drive.friction=iso14521"], "the standard says how friction falls"),
    ],
)
def test_what_cannot_be_is_refused_in_one_line(settings, words):
    with pytest.raises(InputError, match=words) as refused:
        problem(*settings)
    assert "\n" not in str(refused.value)


def test_elastic_teeth_are_not_marched_with_it_but_loaded():
    read = read_case("drive-screw", case_tables(), [*DAMPED, "drive.model=teeth"])
    with pytest.raises(InputError, match=r"lose static friction jump.*--static takes it"):
        DriveProblem.from_case(read)
    still = DriveProblem.from_case(read, shaken=False)
    speed = still.sliding_speed
    assert friction_of(still, speed) > 0.1344
    assert friction_of(still, 0.01 * speed) > friction_of(still, speed)
    others = DriveProblem.from_case(read.replace(["operation.worm_speed=300 rpm"]), shaken=False)
    assert teeth_key(others) != teeth_key(still)


def test_with_the_standard_s_friction_its_dampings_stay():
    settings = ["drive.friction=iso14521", LUGRE, "friction.viscous_damping=20 N s/m"]
    (one,) = all_solved([(SHORT, *settings)])
    read = read_case("drive-screw", case_tables(), [*GIVEN, settings[0]])
    plain = DriveProblem.from_case(read, shaken=False).friction.mu
    assert one.problem.friction.mu == plain
    assert one.closure < 1e-5
    model = ReducedModel(one.problem, reduction(one.problem, Run()))
    assert model.friction == pytest.approx(
        model.kinetic + 20.0 * model.sliding_speed / model.normal_force, rel=1e-12
    )
