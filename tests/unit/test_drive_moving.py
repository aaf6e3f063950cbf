"""What moves over a step: pushed alike all through it, or as a vibration has it."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.elastic.near import _travelled
from asperity.drive.interface import AT
from asperity.drive.motion.kernels import arrive, clear, move
from asperity.drive.motion.system import STATE, SUMS
from asperity.vibration.waveform import NO_TABLE, SINE, Wave

pytestmark = pytest.mark.usefixtures("plain_kernels")

FREE = {"turn": "turns", "shift": "shifts", "roll": "rolls"}
FREQUENCY, SPEED = 20e3, 150.0
SHAKES = {
    "shake_motor": 1e-5, "shake_worm_turn": 3e-6, "shake_seat": 2e-7, "shake_worm_shift": 5e-7,
    "shake_wheel": 7e-7,
}  # fmt: skip


def a_system(free=(), bends=False, **shakes):
    names = dict.fromkeys(SHAKES, 0.0) | shakes
    return SimpleNamespace(
        wave=Wave(SINE, 0.0, NO_TABLE), frequency=FREQUENCY, speed=SPEED, bends=bends,
        **{flag: name in free for name, flag in FREE.items()}, **names,
    )  # fmt: skip


def a_state(time=0.0, step=1.0, wave=0.0, wave_rate=0.0, **places):
    state = SimpleNamespace(
        time=time, step=step, wave=wave, wave_rate=wave_rate, turned_corner=0.0,
        bent=np.zeros(3), bent_rate=np.zeros(3), bent_push=np.zeros(3),
        bent_ahead=np.zeros(3), bent_going=np.zeros(3),
    )  # fmt: skip
    for name in FREE:
        for part in ("", "_rate", "_push"):
            setattr(state, name + part, places.get(name + part, 0.0))
    return state


def moved(system, state, dt):
    q, v = np.full((2, 5), np.nan)
    move._function(system, state, dt, q, v)
    return q, v


@pytest.mark.parametrize("n", range(3))
def test_what_is_free_falls_under_a_steady_push_and_moves_nothing_else(n):
    name, place, rate, push, dt = list(FREE)[n], 0.3, -2.0, 50.0, 0.1
    pushed = {name: place, f"{name}_rate": rate, f"{name}_push": push}
    q, v = moved(a_system([name]), a_state(**pushed), dt)
    q_held, v_held = moved(a_system(), a_state(), dt)
    q_held[n], v_held[n] = place + rate * dt + 0.5 * push * dt**2, rate + push * dt
    assert q == pytest.approx(q_held, rel=1e-14)
    assert v == pytest.approx(v_held, rel=1e-14)


def test_a_shaft_that_bends_moves_the_worm_along_across_and_towards_the_wheel():
    state, dt = a_state(), 0.1
    state.bent, state.bent_rate, state.bent_push = np.random.default_rng(1).normal(size=(3, 3))
    q, v = moved(a_system(["turn"], bends=True), state, dt)
    along, across, nearer = state.bent + state.bent_rate * dt + 0.5 * state.bent_push * dt**2
    assert q == pytest.approx([0.0, along, 0.0, -across, nearer], rel=1e-14)
    along, across, nearer = state.bent_rate + state.bent_push * dt
    assert v == pytest.approx([0.0, along, 0.0, -across, nearer], rel=1e-14)


def test_what_is_imposed_goes_as_its_sine_and_with_the_rate_of_that():
    dt, time, turn = 1e-9, 1.23e-5, 2.0 * math.pi * FREQUENCY
    wave, before = (math.sin(turn * at) for at in (time, time - dt))
    state = a_state(time, dt, wave, (wave - before) / dt)
    q, v = moved(a_system(**SHAKES), state, dt)
    worm_turn = SHAKES["shake_motor"] + SHAKES["shake_worm_turn"]
    worm_shift = SHAKES["shake_seat"] + SHAKES["shake_worm_shift"]
    amplitudes = np.array([worm_turn, worm_shift, 0.0, SHAKES["shake_wheel"], 0.0])
    steady = np.array([SPEED, 0.0, 0.0, 0.0, 0.0])
    end = time + dt
    assert q == pytest.approx(steady * end + amplitudes * math.sin(turn * end), rel=1e-12)
    assert v == pytest.approx(steady + amplitudes * turn * math.cos(turn * end), rel=1e-6)


def test_a_motor_s_work_is_what_a_worm_has_that_it_turned_alone():
    torque, inertia, dt, steps = 0.3, 2e-5, 1e-4, 8
    system = a_system(["turn"])
    vars(system).update(
        speed=0.0, torsion=0.0, torsion_damping=0.0, motor_torque=torque, worm_inertia=inertia,
        load=0.0,
    )  # fmt: skip
    state, sums = (np.zeros(1, kind).view(np.recarray)[0] for kind in (STATE, SUMS))
    clear._function(sums)
    state.torque, state.turn_push, state.turn, state.turn_rate = torque, torque / inertia, 0.1, 2.0
    q, v, mesh = np.zeros(5), np.zeros(5), np.zeros(len(AT))
    for _ in range(steps):
        move._function(system, state, dt, q, v)
        arrive._function(system, state, dt, q, v, mesh, sums)
    rate = 2.0 + torque / inertia * steps * dt
    assert sums.turned == pytest.approx(0.5 * (2.0 + rate) * steps * dt, rel=1e-12)
    assert sums.drive == pytest.approx(0.5 * inertia * (rate**2 - 2.0**2), rel=1e-12)
    assert sums.stored == pytest.approx(0.5 * inertia * rate**2, rel=1e-12)


def travelled(size, turns, shifts):
    """Way of a tooth of a drive of some size as worm and wheel turn, and all is shifted."""
    mesh = SimpleNamespace(
        body=SimpleNamespace(places=size * np.array([[0.0, 0.05, 0.0]])),
        stand=SimpleNamespace(lead=size * 2.5e-3, pitch=2.0 * math.pi / 40.0),
    )
    poses = np.array([0.4, 1e-3, -0.2, 2e-3, 3e-3])
    moved = np.array([turns[0], size * shifts[0], turns[1], size * shifts[1], size * shifts[2]])
    return _travelled._function(mesh, SimpleNamespace(poses=poses), poses + moved)


def test_teeth_come_closer_in_proportion_to_the_size_of_the_drive():
    moves = (0.01, -3e-4), (1e-5, 2e-5, -4e-5)
    assert travelled(1.0, (0.0, 0.0), (0.0, 0.0, 0.0)) == 0.0
    assert travelled(3.0, *moves) == pytest.approx(3.0 * travelled(1.0, *moves), rel=1e-12)
    # A shift brings what it points at closer by no more than its way.
    assert travelled(1.0, (0.0, 0.0), (2e-5, 0.0, 0.0)) == pytest.approx(2e-5)


def test_a_worm_that_turns_with_its_wheel_leaves_only_the_height_of_a_tooth_to_come_closer():
    wheel = 1e-3
    worm = wheel * 0.05 / 2.5e-3
    way = travelled(1.0, (worm, wheel), (0.0, 0.0, 0.0))
    # A point up to two pitches from the middle of the mesh goes another way than along the worm.
    farthest = 0.05 * math.sin(4.0 * math.pi / 40.0) * wheel
    assert farthest < way < 0.5 * 0.05 * wheel
