"""The Fortran written for Abaqus, compiled and driven beside the package's own friction.

Abaqus is played by a driver in Fortran: it hands the committed state to every iteration, throws
away what an iteration wrote, and commits the last one, as the interface of user subroutine FRIC
asks for (Abaqus User Subroutines Reference Guide, FRIC).
"""

import ctypes
import dataclasses
import functools
import subprocess

import numpy as np
import pytest
from apparatus.grid import slow

from asperity.block.deck import fric_subroutine
from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.contact.interface.friction import PointFriction, share_and_tangent
from asperity.friction import update
from asperity.slider.march import march
from asperity.slider.model import Model

pytestmark = pytest.mark.usefixtures("plain_kernels")

HISTORIES = 100
INCREMENTS = 24
STUB = """\
      implicit real*8(a-h,o-z)
      parameter (nprecd=2)
"""
# Every point: two iterations that go astray, then the one that counts.
DRIVER = """\
      SUBROUTINE DRIVE(N,LM,STATEV,DGAM,PRESS,TEND,DTIME,DROT,PROPS,
     1 TAU,DDTDDG,DDTDDP,DSLIP,SED,SFD)
      IMPLICIT DOUBLE PRECISION (A-H,O-Z)
      DIMENSION LM(N),STATEV(3,N),DGAM(2,N),PRESS(N),TEND(N),DTIME(N),
     1 DROT(2,2),PROPS(10),TAU(2,N),DDTDDG(2,2,N),DDTDDP(2,N),
     2 DSLIP(2,N),SED(N),SFD(N),TIME(2),TRIAL(3),G(2),Z(4)
      CHARACTER*80 NAME
      DATA Z/4*0.D0/
      NAME = 'SLIDING'
      DO 40 I = 1,N
        LMIN = LM(I)
        TIME(1) = TEND(I)
        TIME(2) = TEND(I)
        DO 30 K = 1,3
          LM(I) = LMIN
          TRIAL(1) = STATEV(1,I)
          TRIAL(2) = STATEV(2,I)
          TRIAL(3) = STATEV(3,I)
          G(1) = DGAM(1,I)*(4-K)
          G(2) = DGAM(2,I)*(2*K-5)
          CALL FRIC(LM(I),TAU(1,I),DDTDDG(1,1,I),DDTDDP(1,I),
     1     DSLIP(1,I),SED(I),SFD(I),Z,PNEWDT,TRIAL,G,Z,PRESS(I),0.D0,
     2     0.D0,Z,1,1,TIME,DTIME(I),1,NAME,NAME,NAME,1,1,1,Z,Z,DROT,
     3     Z,Z,2,3,1,3,1.D0,PROPS,10)
   30   CONTINUE
        STATEV(1,I) = TRIAL(1)
        STATEV(2,I) = TRIAL(2)
        STATEV(3,I) = TRIAL(3)
   40 CONTINUE
      RETURN
      END
"""

LAWS = {
    "two-phase, base vibrated": ["solve.scheme=two-phase"],
    "two-phase, body vibrated": ["solve.scheme=two-phase", "vibration.applied_to=body"],
    "vector": ["friction.law=vector"],
    "vector, body vibrated": ["friction.law=vector", "vibration.applied_to=body"],
    "split": ["friction.law=split"],
    "unsplit, body vibrated": ["friction.law=unsplit", "vibration.applied_to=body"],
}
ORDINARY = ("two-phase, base vibrated", "vector, body vibrated", "split")
SOME = [law if law in ORDINARY else slow(law) for law in LAWS]


@dataclasses.dataclass
class Outcome:
    lm: np.ndarray
    state: np.ndarray
    stress: np.ndarray
    by_slip: np.ndarray
    by_pressure: np.ndarray
    lost_slip: np.ndarray
    stored: np.ndarray
    lost: np.ndarray


class Compiled:
    """The subroutine of a case as a shared library."""

    def __init__(self, model, folder, **options):
        self.written = fric_subroutine(model, **options)
        (folder / "ABA_PARAM.INC").write_text(STUB)
        (folder / "fric.f").write_text(self.written.text)
        (folder / "driver.f").write_text(DRIVER)
        command = ["gfortran", "-std=legacy", "-Wall", "-Werror", "-Wno-unused-dummy-argument"]
        command += ["-O1", "-fPIC", "-c", "fric.f"]
        subprocess.run(command, cwd=folder, check=True)
        command = ["gfortran", "-O1", "-shared", "-fPIC", "-o", "all.so", "driver.f", "fric.o"]
        subprocess.run(command, cwd=folder, check=True)
        self.library = ctypes.CDLL(str(folder / "all.so"))

    def __call__(self, state, slip, pressure, time, step, *, lm=0, turned=None, properties=None):
        n = len(slip)
        lm = np.full(n, lm, np.int32)
        state = np.array(state, float)
        out = [np.full((n, *size), np.nan) for size in ((2,), (2, 2), (2,), (2,), (), ())]
        rotation = np.eye(2) if turned is None else turned
        arrays = [
            np.ascontiguousarray(np.broadcast_to(a, shape), float)
            for a, shape in (
                (slip, (n, 2)), (pressure, (n,)), (time, (n,)), (step, (n,)),
                (rotation.T, (2, 2)),
                (self.written.properties if properties is None else properties, (10,)),
            )
        ]  # fmt: skip
        pointers = [a.ctypes.data_as(ctypes.c_void_p) for a in (lm, state, *arrays, *out)]
        self.library.drive_(ctypes.byref(ctypes.c_int(n)), *pointers)
        return Outcome(lm, state, out[0], np.swapaxes(out[1], 1, 2), *out[2:])


@pytest.fixture(scope="module")
def build(tmp_path_factory):
    @functools.cache
    def make(*settings, **options):
        model = Model.from_case(read_case("block-transverse", case_tables(), settings))
        return model, Compiled(model, tmp_path_factory.mktemp("fric"), **options)

    return make


@dataclasses.dataclass
class Histories:
    """Random motions of body and base: at every increment one point of each history."""

    exponents: np.ndarray
    time: np.ndarray
    step: np.ndarray
    body: np.ndarray
    base: np.ndarray
    pressure: np.ndarray


def histories(model, seed):
    rng = np.random.default_rng(seed)
    shape = (INCREMENTS, HISTORIES)
    limit = model.friction.max_deflection
    step = rng.uniform(0.2e-6, 3e-6, shape)
    # Every other history begins before the vibration.
    first = model.start + np.where(np.arange(HISTORIES) % 2, -2e-5, rng.uniform(0, 0.1, HISTORIES))
    time = first + np.cumsum(step, axis=0)
    cycles = model.frequency * (np.stack([time - step, time]) - model.start)
    unit = np.where(cycles > 0.0, np.sin(2 * np.pi * cycles), 0.0)
    base = model.amplitude * np.diff(unit, axis=0)[0]
    # Half of them go on in one direction, and reach full friction. Two explicit phases with an
    # exponent of 2 are unstable from a quarter of the limit an increment.
    size = 0.1 if model.solve.scheme == "two-phase" else 0.4
    drift = size * rng.integers(0, 2, (HISTORIES, 1)) * rng.choice([-1.0, 1.0], (HISTORIES, 2))
    body = limit * (drift + rng.uniform(-size, size, (INCREMENTS, HISTORIES, 2)))
    # Before the vibration the two phases know friction against a forward drive alone.
    body[..., 0] = np.where(time <= model.start, np.abs(body[..., 0]), body[..., 0])
    pressure = rng.uniform(0.0, 2e5, shape)
    exponents = rng.choice([1.0, 1.5, 2.0], HISTORIES)
    return Histories(exponents, time, step, body, base, pressure)


def own_motion(model, history, n):
    """Slip along both axes, and its two parts as the package counts them."""
    cos, sin, _ = model.unit_direction
    eta = model.friction.transfer
    own, base = history.body[n], history.base[n]
    if model.on_body:
        slip = own + np.outer(base, [cos, sin])
        zero = np.zeros(HISTORIES)
        return slip, np.stack([slip[:, 0], zero], -1), np.stack([zero, eta * slip[:, 1]], -1)
    slip = own - np.outer(base, [cos, sin])
    part_1 = np.stack([slip[:, 0], own[:, 1]], -1)
    part_2 = np.stack([np.zeros(HISTORIES), -eta * base * sin], -1)
    return slip, part_1, part_2


def own_update(model, committed, part_1, part_2, exponent, one_sided):
    """The package's update of a contact point: deflection over the limit, and its signed size."""
    law = PointFriction.of(
        model.friction,
        model.slider.normal_force,
        area=1.0,
        two_phase=model.solve.scheme == "two-phase",
    )
    # FRIC is given the pressure of the end of a step only: the limit holds at any.
    p = dataclasses.replace(law, exponent=exponent, reference=0.0).numbers(1e-6)
    limit = model.friction.max_deflection
    _, _, size, *share = share_and_tangent(
        committed[0] * limit,
        committed[1] * limit,
        committed[2],
        *part_1,
        *part_2,
        one_sided,
        p,
        1.0,
    )[:5]
    return (*share, size or float(np.hypot(*share)))


def properties(compiled, exponent):
    values = list(compiled.written.properties)
    values[1] = exponent
    return values


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("law", SOME)
def test_stress_and_state_are_those_of_the_package_over_random_histories(build, law):
    model, fric = build(*LAWS[law], side=1)
    limit, mu = model.friction.max_deflection, model.friction.mu
    history = histories(model, seed=1)
    state = np.zeros((HISTORIES, 3))
    own = np.zeros((HISTORIES, 3))
    for n in range(INCREMENTS):
        slip, part_1, part_2 = own_motion(model, history, n)
        for exponent in np.unique(history.exponents):
            here = np.flatnonzero(history.exponents == exponent)
            time, step, pressure = (
                a[n, here] for a in (history.time, history.step, history.pressure)
            )
            found = fric(
                state[here], slip[here], pressure, time, step,
                properties=properties(fric, exponent),
            )  # fmt: skip
            for i, one_sided in zip(here, time <= model.start, strict=True):
                own[i] = own_update(model, own[i], part_1[i], part_2[i], exponent, one_sided)
            state[here] = found.state
            expected = mu * pressure[:, None] * own[here, :2]
            np.testing.assert_allclose(found.stress, expected, rtol=0, atol=1e-10 * mu * 2e5)
            assert np.all(found.lm == 0)
        np.testing.assert_allclose(state / limit, own, rtol=0, atol=1e-10)
    assert np.abs(own).max() > 0.9


@pytest.mark.slow
@pytest.mark.parametrize("law", SOME)
def test_derivatives_are_those_of_the_stress_by_slip_and_by_pressure(build, law):
    model, fric = build(*LAWS[law])
    limit, mu = model.friction.max_deflection, model.friction.mu
    history = histories(model, seed=2)
    tried = turning = 0
    for exponent in np.unique(history.exponents):
        here = np.flatnonzero(history.exponents == exponent)
        state = np.zeros((len(here), 3))
        numbers = properties(fric, exponent)
        for n in range(INCREMENTS):
            slip = own_motion(model, history, n)[0][here] * [1, -1]
            when = history.time[n, here], history.step[n, here]
            pressure = history.pressure[n, here]
            found = fric(state, slip, pressure, *when, properties=numbers)

            def stress(slip, pressure, state=state, when=when, numbers=numbers):
                return fric(state, slip, pressure, *when, properties=numbers).stress

            full = mu * pressure[:, None]
            h = 1e-6 * limit
            for axis in range(2):
                way = h * np.eye(2)[axis]
                ahead = (stress(slip + way, pressure) - found.stress) / h
                behind = (found.stress - stress(slip - way, pressure)) / h
                error = np.abs(found.by_slip[:, :, axis] - 0.5 * (ahead + behind)) * limit / full
                # Where the slip along the asperity reverses the derivative is one-sided.
                kink = np.abs(ahead - behind).max(-1) * limit / full[:, 0] > 1e-3
                assert error[~kink].max() < 1e-6
                tried += kink.size
                turning += np.count_nonzero(kink)
            dp = 1e-3 * pressure[:, None]
            ahead = stress(slip, pressure + dp[:, 0])
            behind = stress(slip, pressure - dp[:, 0])
            error = np.abs(found.by_pressure - 0.5 * (ahead - behind) / dp)
            assert error.max() < 1e-6 * mu
            state = found.state
    assert turning < 0.001 * tried


def test_an_open_point_goes_back_open_with_its_asperities_unbent(build):
    _, fric = build()
    found = fric(np.full((4, 3), 3e-8), np.full((4, 2), 1e-8), 1e5, 0.2, 1e-6, lm=2)
    assert np.all(found.lm == 2)
    assert np.all(found.state == 0.0)
    assert np.all(np.isnan(found.stress))


@pytest.mark.parametrize("lm", [0, 1])
def test_a_point_without_pressure_has_no_stress_and_keeps_its_asperities(build, lm):
    _, fric = build()
    slip = np.array([[2e-8, 1e-8]])
    loaded, free = (fric(np.zeros((1, 3)), slip, p, 0.2, 1e-6, lm=lm) for p in (1e5, -1e3))
    assert loaded.lm[0] == free.lm[0] == 0
    assert np.all(free.stress == 0.0)
    assert np.all(free.by_slip == 0.0)
    np.testing.assert_array_equal(free.state, loaded.state)
    np.testing.assert_array_equal(free.by_pressure, loaded.by_pressure)


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("law", LAWS)
def test_no_slip_and_a_huge_slip_have_finite_answers(build, law):
    model, fric = build(*LAWS[law])
    slip = np.array([[0.0, 0.0], [1e-3, 0.0], [0.0, -1e-3], [1e-300, 0.0]])
    for exponent in (0.0, 0.5, 1.0, 2.0):
        if exponent < 1.0 and model.solve.scheme == "two-phase":
            continue
        found = fric(np.zeros((4, 3)), slip, 1e5, 0.1, 1e-6, properties=properties(fric, exponent))
        for value in (found.stress, found.state, found.by_slip, found.by_pressure, found.lost):
            assert np.all(np.isfinite(value))
        np.testing.assert_allclose(found.stress[0], 0.0, atol=1e-9)
        if model.solve.scheme == "exponential":
            assert np.linalg.norm(found.stress, axis=1).max() <= 1e5 * model.friction.mu * (
                1 + 1e-9
            )


def test_the_second_slip_direction_may_point_either_way(build):
    model, there = build("friction.law=split", "vibration.direction=50 deg", side=1)
    _, here = build("friction.law=split", "vibration.direction=50 deg", side=-1)
    rng = np.random.default_rng(3)
    slip = rng.uniform(-0.5, 0.5, (50, 2)) * model.friction.max_deflection
    mirror = np.array([1.0, -1.0])
    first = there(np.zeros((50, 3)), slip, 1e5, 0.1512, 5e-6)
    other = here(np.zeros((50, 3)), slip * mirror, 1e5, 0.1512, 5e-6)
    np.testing.assert_array_equal(other.stress, first.stress * mirror)
    np.testing.assert_array_equal(other.state[:, :2], first.state[:, :2] * mirror)
    np.testing.assert_array_equal(other.by_slip, first.by_slip * np.outer(mirror, mirror))
    np.testing.assert_array_equal(other.by_pressure, first.by_pressure * mirror)


def test_a_turn_of_the_slip_directions_turns_the_deflection_with_them(build):
    model, fric = build("friction.law=vector", "friction.transfer=1", side=1)
    limit = model.friction.max_deflection
    rng = np.random.default_rng(4)
    state = np.zeros((20, 3))
    state[:, :2] = rng.uniform(-0.6, 0.6, (20, 2)) * limit
    slip = rng.uniform(-0.6, 0.6, (20, 2)) * limit
    angle = 0.3
    turn = np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])
    plain = fric(state, slip, 1e5, 0.2, 1e-6)
    turned = fric(state, slip @ turn.T, 1e5, 0.2, 1e-6, turned=turn)
    np.testing.assert_allclose(turned.stress, plain.stress @ turn.T, rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(turned.by_slip, turn @ plain.by_slip @ turn.T, rtol=1e-9)


def test_work_put_in_is_stored_or_lost_and_never_less_than_what_is_stored(build):
    model, fric = build("friction.law=vector", "vibration.applied_to=body", "friction.transfer=1")
    limit, mu, pressure = model.friction.max_deflection, model.friction.mu, 1e5
    rng = np.random.default_rng(5)
    # Fine increments, for stored and lost energy are those of the mean stress of an increment.
    path = 0.02 * limit * np.cumsum(rng.normal(0.0, 0.4, (400, 200, 2)), axis=0)[::4]
    state, last = np.zeros((200, 3)), np.zeros((200, 2))
    work, lost = np.zeros(200), np.zeros(200)
    for slip in np.diff(path, axis=0, prepend=0.0):
        found = fric(state, slip, pressure, 0.2, 1e-6)
        work += (0.5 * (last + found.stress) * slip).sum(-1)
        lost += found.lost
        state, last = found.state, found.stress
    np.testing.assert_allclose(found.stored + lost, work, rtol=1e-10)
    assert lost.min() >= 0.0
    assert np.all(work <= mu * pressure * np.linalg.norm(np.diff(path, axis=0), axis=-1).sum(0))


WAVES = {
    "sine": [],
    "triangle": ["vibration.waveform=triangle"],
    "square": ["vibration.waveform=square", "vibration.rise_time=30 us"],
    "sampled": ["vibration.waveform=sampled"],
}


@pytest.mark.ordinary(1)
@pytest.mark.parametrize("wave", ["sine", slow("triangle"), slow("square"), "sampled"])
def test_the_law_knows_the_motion_of_the_base_whatever_its_waveform(build, tmp_path, wave):
    settings = [*WAVES[wave], "friction.law=split", "vibration.direction=90 deg"]
    if wave == "sampled":
        phase = np.linspace(0.0, 1.0, 41)
        shape = np.sin(2 * np.pi * phase) + 0.3 * np.sin(6 * np.pi * phase)
        rows = "\n".join(f"{t / 3000:.17g},{u:.17g}" for t, u in zip(phase, shape, strict=True))
        (tmp_path / "wave.csv").write_text(rows)
        settings.append(f"vibration.samples={tmp_path / 'wave.csv'}")
    model, fric = build(*settings, side=1, before=0.02)
    limit, eta = model.friction.max_deflection, model.friction.transfer
    step = 0.9e-6
    base = model.amplitude * model.shape.increments(
        -2 * model.frequency * step, model.frequency * step, 400
    )
    ends = 0.02 + model.start + step * (np.arange(400) - 1)
    # A body at rest: the slip is the base's motion backwards, and only its share eta arrives.
    found = fric(np.zeros((400, 3)), np.stack([0 * base, -base], -1), 1e5, ends, step)
    for deflection, moved in zip(found.state, base, strict=True):
        own, _, _ = update((0.0, 0.0), (0.0, 0.0), (0.0, -eta * moved), limit, 1.0, 0)
        assert deflection[:2] == pytest.approx(own, abs=1e-9 * limit)
    assert np.abs(found.state).max() > 0.01 * limit


@pytest.mark.parametrize("wave", ["triangle", slow("square")])
def test_disp_moves_the_base_as_the_case_says(build, wave):
    model, fric = build(*WAVES[wave], "vibration.direction=30 deg", before=0.02)
    assert fric.written.moves_base
    u, time = (ctypes.c_double * 3)(), (ctypes.c_double * 2)()
    one, point = ctypes.c_int(1), (ctypes.c_double * 3)()
    for cycles in (-0.3, 0.11, 0.4, 7.63):
        time[1] = 0.02 + model.start + cycles / model.frequency
        unit = model.shape.increments(-1.0, cycles + 1.0, 1)[0]
        slope = model.shape.increments(cycles - 1e-6, 2e-6, 1)[0] / 2e-6 * model.frequency
        for direction, share in ((1, np.cos(np.pi / 6)), (2, np.sin(np.pi / 6))):
            fric.library.disp_(
                u, ctypes.byref(one), ctypes.byref(one), time, ctypes.byref(one),
                ctypes.byref(one), ctypes.byref(ctypes.c_int(direction)), point,
            )  # fmt: skip
            assert u[0] == pytest.approx(share * model.amplitude * unit, rel=1e-9, abs=1e-18)
            assert u[1] == pytest.approx(share * model.amplitude * slope, rel=1e-5, abs=1e-9)
            assert u[2] == 0.0


@pytest.mark.slow
@pytest.mark.parametrize("law", ["split", "vector"])
def test_a_body_solved_with_the_subroutine_slides_as_the_package_says(build, law):
    settings = [f"friction.law={law}", "vibration.direction=60 deg", "vibration.start=0.5 ms"]
    case = read_case("block-transverse", case_tables(), [*settings, "solve.duration=6.5 ms"])
    # Driven along x, free across.
    case = case.replace_values({"slider.drive_stiffness": None, "slider.drive_damping": None})
    model = Model.from_case(case)
    _, fric = build(*settings, side=1)
    own = march(model).to_json()

    step, mass, force = model.step, model.slider.mass, model.slider.normal_force
    cos, sin, _ = model.unit_direction
    total = round(model.duration / step)
    base = model.amplitude * model.shape.increments(
        -model.start * model.frequency, model.frequency * step, total
    )
    state, velocity, acceleration = np.zeros((1, 3)), 0.0, 0.0
    friction = np.empty((total, 2))
    iterations = 0
    for n in range(total):
        along = model.slider.drive_velocity * step - cos * base[n]
        new = acceleration
        # Newmark's average acceleration, Newton with the subroutine's own derivative.
        for _ in range(10):
            across = velocity * step + 0.25 * step**2 * (acceleration + new) - sin * base[n]
            found = fric(state, np.array([[along, across]]), force, (n + 1) * step, step)
            iterations += 1
            residual = mass * new + found.stress[0, 1]
            if abs(residual) < 1e-9 * force:
                break
            new -= residual / (mass + 0.25 * step**2 * found.by_slip[0, 1, 1])
        velocity += 0.5 * step * (acceleration + new)
        acceleration = new
        state, friction[n] = found.state, found.stress[0]
    last = friction[-round(own["cycles"] / (model.frequency * step)) :]
    assert last[:, 0].mean() == pytest.approx(own["drive_force_N"], rel=2e-4)
    assert last[:, 0].max() == pytest.approx(own["friction_x_max_N"], rel=1e-3)
    assert iterations < 3 * total
