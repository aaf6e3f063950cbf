"""The march against the equations of motion integrated by SciPy, every law and friction model.

Source: m X'' = F_d - F_x, m Y'' = -F_y, F_d = k_d (v_d t - X) + h_d (v_d - X'), F = k_t s, with
Dahl's asperity (1968) relaxing along itself or along the slip, or LuGre's (Canudas de Wit et al.
1995). The base or the body vibrates; eta_y of the lateral vibration reaches the contact.
"""

import math

import numpy as np
import pytest
from apparatus.grid import grid
from scipy.integrate import solve_ivp

from asperity.friction import Friction
from asperity.slider import Model, Slider, Solve, solve
from asperity.vibration import Vibration

LAWS = ["split", "unsplit", "vector"]
END = 2.5e-3
SLIDER = Slider(
    drive_velocity=0.5e-3,
    normal_force=50.0,
    drive_stiffness=3e5,
    drive_damping=40.0,
    mass=0.4,
    units="SI",
)
LUGRE = {
    "model": "lugre", "static_mu": 0.14, "stribeck_velocity": 2e-3, "contact_damping": 60.0,
    "viscous_damping": 30.0,
}  # fmt: skip


def body(steps, friction, applied_to="base"):
    made = Friction(mu=0.1, max_deflection=6e-8, transfer=0.71, **friction, units="SI")
    vibration = Vibration(
        frequency=3e3,
        velocity_ratio=5.0,
        direction=math.radians(50.0),
        applied_to=applied_to,
        units="SI",
    )
    return Model(SLIDER, made, vibration, Solve(step=END / steps, duration=END, units="SI"))


def equations(model):
    friction, slider = model.friction, model.slider
    full, limit = model.full_friction, friction.deflection_limit(slider.normal_force)
    stiffness, exponent = full / limit, friction.exponent
    direction, on_body = np.array(model.unit_direction[:2]), model.on_body
    transfer = np.array([1.0, friction.transfer])
    pulse = 2.0 * math.pi * model.frequency

    def slips(time, velocity):
        shaken = model.amplitude * pulse * math.cos(pulse * time) * direction
        if on_body:
            seen = transfer * (velocity + shaken)
            return np.array([seen[0], 0.0]), np.array([0.0, seen[1]])
        part_1 = velocity - np.array([shaken[0], 0.0])
        return part_1, np.array([0.0, -friction.transfer * shaken[1]])

    def relaxation(s, parts, bound):
        slip = sum(parts)
        if friction.law == "vector":
            distance = slip / np.hypot(*slip) - s / bound
            rest = np.hypot(*distance) ** (exponent - 1.0) * distance
            return slip - np.hypot(*slip) * rest
        size = np.hypot(*s)
        if size == 0.0:
            return np.zeros(2)
        e, share = s / size, min(size / bound, 1.0)
        along = [e @ part for part in parts] if friction.law == "split" else [e @ slip]
        return sum(u * (1.0 - (1.0 - share * np.sign(u)) ** exponent) for u in along) * e

    def rates(time, state):
        x, velocity, s = state[0], state[1:3], state[3:]
        parts = slips(time, velocity)
        slip = sum(parts)
        bound = limit
        if friction.model == "lugre" and friction.stribeck_velocity > 0.0:
            fall = math.exp(-(slip @ slip) / friction.stribeck_velocity**2)
            bound *= 1.0 + (friction.static_mu / friction.mu - 1.0) * fall
        ds = slip - relaxation(s, parts, bound)
        force = stiffness * s + friction.contact_damping * ds + friction.viscous_damping * slip
        pull = slider.drive_stiffness * (slider.drive_velocity * time - x)
        pull += slider.drive_damping * (slider.drive_velocity - velocity[0])
        push = np.array([pull - force[0], -force[1]]) / slider.mass
        return np.concatenate([velocity[:1], push, ds])

    answer = solve_ivp(
        rates, (0.0, END), np.zeros(5), "DOP853", rtol=1e-10, atol=1e-15, max_step=4e-6
    )
    return answer.y[0, -1], answer.y[3:, -1]


def reached(model):
    history = solve(model).history
    return history.position[-1, 0], history.deflection[-1]


def errors(counts, friction, applied_to="base"):
    exact = equations(body(1000, friction, applied_to))
    found = [reached(body(count, friction, applied_to)) for count in counts]
    ways = np.array([abs(x - exact[0]) for x, _ in found]) / exact[0]
    deflections = np.array([np.abs(s - exact[1]).max() for _, s in found]) / 6e-8
    return ways, deflections


FRICTIONS = {law: {"law": law} for law in LAWS}
FRICTIONS |= {f"{law}, exponent 2": {"law": law, "exponent": 2.0} for law in LAWS}
FRICTIONS |= {f"lugre, {law}": {"law": law} | LUGRE for law in LAWS}


@pytest.mark.parametrize(
    ("name", "applied_to"),
    grid(
        [*FRICTIONS],
        ["base", "body"],
        ordinary=[("split", "body"), ("unsplit, exponent 2", "base"), ("lugre, vector", "base")],
    ),
)
def test_the_march_goes_to_the_equations_of_motion(name, applied_to):
    ways, deflections = errors([20_000], FRICTIONS[name], applied_to)
    assert ways[0] < 1e-5
    assert deflections[0] < 1e-5


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "applied_to"), grid(["vector", "lugre, vector"], ["base", "body"])
)
def test_the_march_is_of_order_two_with_vector(name, applied_to):
    ways, deflections = errors([2500, 5000, 10_000], FRICTIONS[name], applied_to)
    assert np.log2(deflections[:-1] / deflections[1:]) == pytest.approx(2.0, abs=0.1)
    assert ways[-1] < 2e-6
