"""Random drives: as settings for the package, and as numbers for the plain model.

All are of gearset 3 (4 starts, 60 teeth, axial module 2.1538 mm, diameter factor 8.4, 20 deg) with
a measured mesh. What follows from these is calculated here once more.
"""

import functools
import math
import tempfile
from pathlib import Path

import numpy as np

from apparatus import kept, plain_drive
from apparatus.drives import POINTS, deflection
from apparatus.plain_drive import (
    BRITTLE,
    COULOMB,
    DAHL,
    LUGRE,
    POWER,
    SAMPLED,
    SINE,
    SQUARE,
    TRIANGLE,
    Plain,
    march,
    overtones,
)

STARTS, TEETH, MODULE, FACTOR, PRESSURE = 4, 60, 2.1538e-3, 8.4, math.radians(20.0)
RADIUS, BACKLASH, RATIO = 9.81e-3, 0.28e-3, 15.0
LEAD, CIRCLE = 0.5 * MODULE * STARTS, 0.5 * MODULE * FACTOR
LAWS = {"coulomb": COULOMB, "dahl": DAHL, "lugre": LUGRE, "brittle": BRITTLE, "power": POWER}
WAVES = {"sine": SINE, "triangle": TRIANGLE, "square": SQUARE, "sampled": SAMPLED}
EXPONENTS = (1 / 3, 0.5, 1.5, 2.0, 3.0)
PLACES = {
    "axial": ("worm", "seat"), "torsional": ("worm", "motor"), "wheel-axial": ("wheel",),
    "screw": ("worm", "seat"),
}  # fmt: skip
_GIVE = 2e-3  # of the approach: Coulomb's on rigid teeth, as the package says of itself
_REACH = 100.0  # of the force without vibration, up to which powers go on
_PER_STEP = 12e-9  # s


def drawn(rng):
    """Return a drive by its numbers, SI."""
    frequency = float(10 ** rng.uniform(2.8, 4.5))
    speed = float(rng.uniform(200.0, 3000.0)) * math.pi / 30.0
    faster = float(10 ** rng.uniform(-0.7, 0.8))
    mode = str(rng.choice(list(PLACES)))
    law = str(rng.choice(["coulomb", "dahl", "lugre"]))
    return {
        "mode": mode,
        "place": str(rng.choice(PLACES[mode])),
        "wave": str(rng.choice(["sine", "triangle", "square"])),
        "frequency": frequency,
        "amplitude": min(faster * speed * CIRCLE / (2.0 * math.pi * frequency), 1.2e-4),
        "law": law,
        "mu": float(rng.uniform(0.03, 0.25)),
        "slip": float(10 ** rng.uniform(-7.5, -6.0)),
        "rate": float(rng.uniform(0.0, 40.0)) if law == "lugre" else 0.0,
        "viscous": float(rng.uniform(0.0, 20.0)) if law == "lugre" else 0.0,
        # Behind LuGre's dampings the teeth are rigid: its equation is one for the force then.
        "compliance": 0.0 if law == "lugre" else float(rng.choice([0.0, 2.9e-9])),
        "damping": float(rng.choice([0.01, 0.03])),
        "inertia": float(10 ** rng.uniform(-2.7, -1.0)),
        "worm_inertia": float(10 ** rng.uniform(-5.2, -4.0)),
        "worm_mass": float(10 ** rng.uniform(-1.0, 0.3)),
        "load": float(rng.uniform(30.0, 600.0)),
        "speed": speed,
        "torsion": float(10 ** rng.uniform(2.8, 4.3)),
        "bearing": float(10 ** rng.uniform(7.5, 8.7)) if rng.random() < 0.4 else 0.0,
        "damping_ratio": float(rng.choice([0.03, 0.1])),
    }


def drawn_since(rng):
    """Return a drive with what `drawn` never has: another exponent, Stribeck's effect, samples."""
    since = rng.spawn(1)[0]
    drive = drawn(rng)
    law = str(since.choice(["brittle", "power", "power", "falling", "falling", "same"]))
    if law == "same" or since.random() < 0.3:
        drive["wave"] = "sampled"
    if law in ("brittle", "power"):
        rigid = law == "brittle" or since.random() < 0.5
        drive |= {"law": law, "compliance": 0.0 if rigid else 2.9e-9, "rate": 0.0, "viscous": 0.0}
    if law == "power":
        drive["exponent"] = float(since.choice([*EXPONENTS, since.uniform(0.3, 4.0)]))
    if law == "falling":
        static = float(since.uniform(1.05, 2.0))
        sliding = drive["speed"] * math.hypot(RADIUS, LEAD)
        # Far from where more would be refused, since it would give energy.
        fastest = 5.0 * (sliding + 20.0 * drive["frequency"] * drive["amplitude"])
        most = static * drive["mu"] * drive["load"] / (RATIO * LEAD) / fastest / (static - 1.0)
        drive |= {
            "law": "lugre", "static": static, "compliance": 0.0,
            "stribeck": sliding * float(10 ** since.uniform(-1.0, 0.5)),
            "rate": min(float(since.choice([0.0, since.uniform(0.0, 40.0)])), most),
            "viscous": float(since.choice([0.0, since.uniform(0.0, 20.0)])),
        }  # fmt: skip
    return drive


def _half_range():
    fine = np.array([overtones(phase) for phase in np.linspace(0.0, 1.0, 10_001)])
    return 0.5 * float(np.ptp(fine))


@functools.cache
def _samples(frequency):
    """A file of the wave that is given by samples, of a frequency in Hz."""
    cycle = np.linspace(0.0, 1.0, 241).tolist()
    rows = "".join(f"{phase / frequency!r},{overtones(phase)!r}\n" for phase in cycle)
    path = Path(tempfile.mkdtemp(prefix="asperity-drives-")) / "wave.csv"
    path.write_text(f"time,displacement\n{rows}")
    return path


def settings(drive):
    """Return a drive's settings for the package."""
    given = [
        deflection(),
        f"drive.effective_radius={RADIUS!r} m",
        f"drive.tangential_compliance={drive['compliance']!r} m/N",
        f"gearset.axial_module={MODULE!r} m",
        f"gearset.centre_distance={0.5 * MODULE * (FACTOR + TEETH)!r} m",
        f"mount.backlash={BACKLASH!r} m",
        f"vibration.mode={drive['mode']}",
        f"vibration.applied_to={drive['place']}",
        f"vibration.waveform={drive['wave']}",
        f"vibration.frequency={drive['frequency']!r} Hz",
        f"vibration.displacement_amplitude={drive['amplitude']!r} m",
        f"friction.model={drive['law'].replace('brittle', 'dahl').replace('power', 'dahl')}",
        f"friction.mu={drive['mu']!r}",
        f"friction.max_deflection={drive['slip']!r} m",
        f"drive.contact_damping={drive['damping']!r} s/m",
        f"drive.load_inertia={drive['inertia']!r} kg m**2",
        f"drive.worm_inertia={drive['worm_inertia']!r} kg m**2",
        f"drive.worm_mass={drive['worm_mass']!r} kg",
        f"operation.output_torque={drive['load']!r} N m",
        f"operation.worm_speed={drive['speed']!r} rad/s",
        f"shaft.damping_ratio={drive['damping_ratio']!r}",
        f"shaft.torsional_stiffness={drive['torsion']!r} N m/rad",
    ]
    if drive["wave"] == "square":
        given.append(f"vibration.rise_time={0.1 / drive['frequency']!r} s")
    if drive["wave"] == "sampled":
        given.append(f"vibration.samples={_samples(drive['frequency'])}")
    if drive["law"] == "brittle":
        given.append("friction.exponent=0")
    if drive["law"] == "power":
        given.append(f"friction.exponent={drive['exponent']!r}")
    if "static" in drive:
        given.append(f"friction.static_mu={drive['static'] * drive['mu']!r}")
        given.append(f"friction.stribeck_velocity={drive['stribeck']!r} m/s")
    if drive["law"] == "lugre":
        given.append(f"friction.contact_damping={drive['rate']!r} N s/m")
        given.append(f"friction.viscous_damping={drive['viscous']!r} N s/m")
    if drive["bearing"]:
        given.append(f"shaft.bearing_axial={drive['bearing']!r} N/m")
    return tuple(given)


def approach_at(logs, force):
    """Return the approach under a force, and the power that the force goes by there."""
    n = int(np.clip(np.searchsorted(logs[1], math.log(force)), 1, logs.shape[1] - 1))
    power = (logs[1, n] - logs[1, n - 1]) / (logs[0, n] - logs[0, n - 1])
    return math.exp(logs[0, n] + (math.log(force) - logs[1, n]) / power), power


def plain(drive):
    """Return a drive as the plain model has it, and the steady sliding that it starts from."""
    length = math.hypot(RADIUS, LEAD)
    axial = math.cos(math.atan2(STARTS, FACTOR)) * math.cos(PRESSURE)
    along = axial * LEAD / RADIUS
    normal = np.array([along, axial, math.sqrt(1.0 - along**2 - axial**2)])
    arm, tilt = RATIO * LEAD, LEAD / length
    speed, load = drive["speed"], drive["load"]
    # N = T/(i p (n_z - mu_e p/L)), with Stribeck's share and a viscous part h_v v/N in mu_e: solved
    # for N.
    dragged = drive["viscous"] * speed * length
    static, stribeck = drive.get("static", 1.0), drive.get("stribeck", 0.0)
    risen = 1.0
    if stribeck:
        risen += (static - 1.0) * math.exp(-((speed * length / stribeck) ** 2))
    force = (load / arm + tilt * dragged) / (axial - risen * drive["mu"] * tilt)
    friction = risen * drive["mu"] * force + dragged
    torque = RADIUS * (force * along + friction * RADIUS / length)
    torques, angles = np.array(POINTS).T
    unit = 1.0 / (arm * (axial - friction / force * tilt))
    logs = np.log(np.stack([axial * arm * 1e-6 * angles, unit * torques]))
    full = drive["mu"] * force
    approach, _ = approach_at(logs, force)
    far, power = approach_at(logs, _REACH * force)
    end = np.array([far, _REACH * force, power * _REACH * force / far])
    if drive["law"] == "coulomb":
        # Rigid asperities: what gives is the teeth, or next to nothing.
        slip, teeth = drive["compliance"] * full or _GIVE * approach, 0.0
    else:
        slip = drive["slip"]
        teeth = drive["compliance"] * full / slip
    amplitude, places = drive["amplitude"], np.zeros(5)
    if drive["mode"] == "wheel-axial":
        places[2] = amplitude
    elif drive["mode"] == "axial":
        places[3 if drive["place"] == "seat" else 1] = amplitude
    elif drive["mode"] == "torsional":
        places[4 if drive["place"] == "motor" else 0] = amplitude / CIRCLE
    else:
        places[0] = amplitude / CIRCLE
        places[3 if drive["place"] == "seat" else 1] = -LEAD * amplitude / CIRCLE
    ratio, seat, mass = drive["damping_ratio"], drive["bearing"], drive["worm_mass"]
    model = Plain(
        lead=LEAD, radius=RADIUS, arm=arm, normal=normal, logs=logs, end=end,
        damping=drive["damping"], backlash=BACKLASH,
        law=LAWS[drive["law"]], mu=drive["mu"], reference=force,
        stiffness=full / slip, teeth=teeth, rate=drive["rate"], viscous=drive["viscous"],
        exponent=drive.get("exponent", 1.0), static=static, stribeck=stribeck,
        torsion=drive["torsion"],
        torsion_damping=2.0 * ratio * math.sqrt(drive["torsion"] * drive["worm_inertia"]),
        worm_inertia=drive["worm_inertia"], seat=seat,
        seat_damping=2.0 * ratio * math.sqrt(seat * mass), worm_mass=mass,
        wheel_inertia=drive["inertia"], load=load, speed=speed, amplitudes=places,
        wave=WAVES[drive["wave"]],
        rise=_half_range() if drive["wave"] == "sampled" else 0.1, frequency=drive["frequency"],
    )  # fmt: skip
    turn = -torque / drive["torsion"]
    shift = -load / arm / seat if seat else 0.0
    roll = (LEAD * turn + shift - approach / axial) / arm
    sliding = risen * slip * np.array([RADIUS, -LEAD, 0.0]) / length
    return model, np.array([turn, shift, roll, *sliding]), torque


def _marched(model, start, cycles, per_cycle, judged):
    """Means over the last of the cycles, and of the torque over each third of those."""
    means = np.zeros((cycles, 9))
    march(model, start, cycles, per_cycle, means)
    blocks = means[-judged:].reshape(3, -1, 9)[:, :, 0].mean(axis=1)
    return [*means[-judged:].mean(axis=0), *blocks]


def solved(drive, cycles, judged):
    """Return the means of the last ``judged`` of so many cycles, and what settles it.

    As a dictionary: ``ratio``, powers of ``drive``, ``actuator``, ``load``, ``friction`` over that
    of the motor without vibration, ``open``, and by how much what is to stay is missed over what is
    allowed, ``off``.
    """
    model, start, torque = plain(drive)
    # A step for a share of the asperities' own time too.
    step = min(_PER_STEP, 1.0 / (2000 * drive["frequency"]))
    per_cycle = math.ceil(1.0 / (drive["frequency"] * step))
    found = kept.answer(plain_drive.__file__, _marched, model, start, cycles, per_cycle, judged)
    last, blocks = np.array(found[:9]), np.array(found[9:]) / torque
    power = torque * drive["speed"]
    turned = RATIO * last[8] / drive["speed"] - 1.0
    off = max(np.ptp(blocks), abs(last[1] / drive["load"] - 1.0), abs(turned)) / 5e-3
    names = ("drive", "actuator", "load", "friction")
    return {"ratio": last[0] / torque, "open": last[7], "off": off, "torque": torque} | {
        name: last[2 + n] / power for n, name in enumerate(names)
    }


def unshaken(drive, seconds=0.12):
    """Return the mean torque without vibration in the second half of so long."""
    model, start, _ = plain(drive)
    cycles, per_cycle = math.ceil(seconds * 1e3), math.ceil(1e-3 / _PER_STEP)
    still = model._replace(amplitudes=np.zeros(5), frequency=1e3)
    return kept.answer(
        plain_drive.__file__, _marched, still, start, cycles, per_cycle, cycles // 6 * 3
    )[0]
