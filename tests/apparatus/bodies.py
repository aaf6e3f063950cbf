"""Sliding bodies by lot: every law, waveform, direction and contact, each as a case file.

A case is drawn in the contact's own measures (how far the drive goes in a cycle over how far the
asperities bend, natural frequencies over that of the vibration), so that steady states, resonances
and light loads all come up, and then written in SI.
"""

import math
from typing import NamedTuple

import numpy as np

from asperity.casefile import read_case
from asperity.commands import case_tables
from asperity.slider import Model

from .plain_body import Wave, body_of, samples, steps_for, wave_of

SAMPLES = "wave.csv"
MOST_STEPS = 5000
_UNITS = {
    "drive_velocity": "m/s", "normal_force": "N", "drive_stiffness": "N/m", "mass": "kg",
    "drive_damping": "N s/m", "max_deflection": "m", "stribeck_velocity": "m/s",
    "contact_damping": "N s/m", "viscous_damping": "N s/m", "frequency": "Hz", "direction": "rad",
    "elevation": "rad", "normal_phase": "rad", "start": "s", "rise_time": "s", "duration": "s",
    "stiffness": "N/m", "step": "s",
}  # fmt: skip


class Lot(NamedTuple):
    """A body by lot: its tables as texts, and of how many cycles from the start a march takes."""

    tables: dict
    cycles: int

    def toml(self):
        """Return it as a case file."""
        lines = []
        for name, table in self.tables.items():
            lines += [f"[{name}]", *(f"{key} = {_text(value)}" for key, value in table.items()), ""]
        return "\n".join(lines)

    def model(self, folder, **solve):
        """Return the body, of a case file in a folder where the samples lie."""
        tables = {**self.tables, "solve": self.tables["solve"] | solve}
        path = folder / "lot.toml"
        path.write_text(self._replace(tables=tables).toml())
        frequency = float(self.tables["vibration"].get("frequency", "1").split()[0])
        if self.tables["vibration"]["waveform"] == "sampled":
            (folder / SAMPLES).write_text(samples(frequency))
        return Model.from_case(read_case(path, case_tables(), ()))


def _text(value):
    return f'"{value}"' if isinstance(value, str) else repr(value)


def _with_units(table):
    return {
        key: f"{float(value)!r} {_UNITS[key]}" if key in _UNITS else value
        for key, value in table.items()
    }


def draw(rng, models=("dahl", "lugre", "coulomb", "springs"), *, pressed=None, corners=False):
    """Return a body by lot.

    Parameters
    ----------
    rng : numpy.random.Generator
        Where chance comes from.
    models : sequence of str
        Friction to choose from.
    pressed : bool, optional
        Whether the load follows a contact; left to chance if left out.
    corners : bool
        Whether the drive gives way, and what shakes has corners.
    """
    # What has come since is left to another chance: the bodies of a seed stay what they are.
    since = rng.spawn(1)[0]

    def log(low, high):
        return math.exp(rng.uniform(math.log(low), math.log(high)))

    def one(*choices):
        return choices[int(rng.integers(len(choices)))]

    def often(part):
        return bool(rng.random() < part)

    def near(low, high):
        """A natural frequency over that of the vibration, now and then at resonance."""
        return rng.uniform(0.97, 1.03) if often(0.1) else log(low, high)

    model = one(*models)
    frequency = log(200.0, 4e4)
    load, mu, limit = log(0.05, 500.0), log(0.05, 0.6), log(2e-8, 3e-6)
    if pressed is None:
        pressed = often(0.5)
    pressed = pressed or model == "springs"
    way = log(0.01, 2.0)  # of the drive in a cycle, over the deflection limit
    velocity = way * limit * frequency
    stiffness = mu * load / limit
    mass = stiffness / (2.0 * math.pi * frequency * near(0.5, 20.0)) ** 2
    friction = {"model": model, "mu": mu}
    law = one("vector", "unsplit", "split")
    if model != "coulomb":
        friction["max_deflection"] = limit
    if model in ("dahl", "lugre"):
        friction["law"] = law
    if model == "dahl":
        friction["exponent"] = one(1.0, 1.0, 0.0, 0.5, 1 / 3, 1.5, 2.0, 3.0, 4.0, rng.uniform(0, 4))
    if model == "lugre":
        if often(0.6):
            friction["static_mu"] = mu * rng.uniform(1.0, 2.0)
            friction["stribeck_velocity"] = velocity * log(0.1, 30.0)
        critical = math.sqrt(stiffness * mass)
        if often(0.6):
            friction["contact_damping"] = critical * log(0.03, 1.5)
        if often(0.4):
            friction["viscous_damping"] = critical * log(0.01, 0.5)
    friction["transfer"] = one(1.0, 1.0, 0.71, 0.0)
    rigid = not corners and often(0.35)
    slider = {
        "drive_velocity": velocity, "normal_force": load, "mass": mass,
        "lateral": one("free", "guided"),
    }  # fmt: skip
    if not rigid:
        # Taken up within forty cycles at most.
        least = stiffness / (40.0 * way)
        drive = max(least, mass * (2.0 * math.pi * frequency * near(0.02, 1.5)) ** 2)
        slider["drive_stiffness"] = drive
        if often(0.7):
            slider["drive_damping"] = 2.0 * math.sqrt(drive * mass) * log(0.01, 0.7)
    cornered = ("triangle", "square")
    waveform = one(*cornered) if corners else one("sine", "sine", "sine", *cornered, "sampled")
    vibration = {"waveform": waveform, "frequency": frequency}
    rise = 0.0
    if waveform == "square":
        rise = rng.uniform(0.05, 0.5)
        vibration["rise_time"] = rise / frequency
    if waveform == "sampled":
        vibration["samples"] = SAMPLES
    ratio = one(1.0, 2.0, log(0.1, 30.0), log(0.1, 30.0), log(0.1, 30.0), log(0.1, 30.0))
    vibration["velocity_ratio"] = ratio
    vibration["direction"] = one(
        0.0, 0.5 * math.pi, math.pi, *(rng.uniform(0.0, 2.0 * math.pi) for _ in range(4))
    )
    vibration["applied_to"] = one("base", "base", "body")
    if often(0.3):
        vibration["start"] = one(1.5, 3.0, 2.3) / frequency
    tables = {"slider": slider, "friction": friction}
    if pressed:
        normal = {"law": one("linear", "hertz", "rough"), "control": one("force", "displacement")}
        normal["stiffness"] = mass * (2.0 * math.pi * frequency * near(0.3, 15.0)) ** 2
        if often(0.85):
            normal["damping_ratio"] = log(0.01, 0.4)
        if often(0.75):
            if friction.get("law") == "split":
                friction["law"] = "vector"
            # The swing of the load, as far as a rigid machine would have it.
            steepness = Wave(waveform, rise).steepness
            amplitude = ratio * velocity / (steepness * frequency)
            up = min(log(0.03, 1.5) * load / normal["stiffness"] / amplitude, 1.0)
            up = one(up, up, 1.0) if amplitude * normal["stiffness"] < 3.0 * load else up
            elevation = math.asin(up)
            vibration["elevation"] = one(elevation, math.pi - elevation)
            if often(0.3):
                vibration["normal_phase"] = rng.uniform(0.0, 2.0 * math.pi)
        if model == "springs" and normal["law"] == "rough":
            friction["springs"] = 64  # sixteen are right to 1.3e-3 of the load only
        if model != "springs" and often(0.2):
            friction["load_exponent"] = one(2 / 3, 1.3)
        if model in ("dahl", "lugre") and since.random() < 0.15:
            friction["keeps"] = "deflection"
        tables["normal"] = _with_units(normal)
    tables["slider"], tables["friction"] = _with_units(slider), _with_units(friction)
    tables["vibration"] = _with_units(vibration)
    cycles = int(rng.integers(30, 90))
    duration = vibration.get("start", 0.0) + cycles / frequency
    tables["solve"] = _with_units({"duration": duration})
    return Lot(tables, cycles)


def followed(lot, folder):
    """Whether the plain way can follow a body in reasonable steps."""
    model = lot.model(folder)
    steps = steps_for(body_of(model), model.frequency, wave_of(model.vibration))
    return steps <= MOST_STEPS


def lots(seed, count, folder, **options):
    """Return so many bodies by lot that the plain way can follow."""
    rng = np.random.default_rng(seed)
    found = []
    while len(found) < count:
        lot = draw(rng, **options)
        if followed(lot, folder):
            found.append(lot)
    return found
