"""Claims 7.4, 7.11, 7.12, 7.13, 7.16 and 7.18: what closed forms and balances say."""

import math

import numpy as np

from asperity.drive.motor import PRICE_PER_MASS, Motor, Service, lightest, scaled
from asperity.drive.point import MeshPoint
from asperity.gearset.geometry import Geometry
from asperity.thesis.drive.sets import AMPLITUDE, FREQUENCY, LOAD, SHAKEN, SPEED, UNSHAKEN
from asperity.thesis.drive.simulations import BASE, of_set, varied
from asperity.thesis.exhibits import claim
from asperity.thesis.flanks.meshing import Gear
from asperity.thesis.products import ARITHMETIC, NOT_TESTABLE, Finding

GEAR = Gear("gearset-3b")
FRICTION = 0.1344
RADIUS = 9.76e-3
"""At which one point on the worm of gearset 3 has the torque of its loaded teeth, m."""

_TORQUE = "asperity.drive.point.MeshPoint.worm_torque"
_SAVED_MASS, _SAVED_DIAMETER, _SAVED_LENGTH = 6.0, 0.05, 0.03
# A motor of cast iron or aluminium, copper and steel; kg/m3.
_DENSITIES = (3500.0, 7500.0)
_SHORTEST = 0.8
_FALLS = 0.95  # a ratio that is a saving
THIN = 0.28
"""Backlash that leaves the amplitude of the thesis, mm."""
_ULTRASONIC = 16e-6  # m, of the sonotrode (6.4.4)


def geometry() -> Geometry:
    """Gearset 3 as its flanks are checked."""
    from asperity.gearset import Gearset

    return GEAR.read().require(Gearset).geometry


def assumed() -> str:
    """Say what is ours in the simulations of a shaken gearset, with its values."""
    from asperity.casefile import read_case
    from asperity.commands import case_tables
    from asperity.drive.parameters import Drive, Shaft
    from asperity.flanks.parameters import Mount

    case = read_case(BASE, case_tables())
    drive, shaft, mount = case.require(Drive), case.require(Shaft), case.require(Mount)
    return (
        f"Inertia of the wheel {drive.load_inertia:g} kg m2 and of the worm "
        f"{drive.worm_inertia:g} kg m2, damping of the contact {drive.contact_damping:g} s/m, of "
        f"the shaft {shaft.damping_ratio:g}, normal backlash {1e3 * (mount.backlash or 0.0):g} mm, "
        "an oversized, tilted hob; k_w between the ends of a set. Marched as it moves: whether the "
        "thesis's step was static is not told."
    )


def _lower_first(text: str) -> str:
    return text[:1].lower() + text[1:]


def band() -> tuple[float, float, float]:
    """Worm torques with friction reversed, without, and as it is, N m; the wheel in balance."""
    point = MeshPoint.of(geometry(), RADIUS)
    low, none, high = (point.worm_torque(LOAD, mu) for mu in (-FRICTION, 0.0, FRICTION))
    return low, none, high


@claim("7.4")
def _advantage() -> Finding:
    low, none, high = band()
    still, most = LOAD / high, LOAD / low
    return Finding.judged(
        {
            "its own torques give 10.8 and 49.5": (
                round(LOAD / UNSHAKEN, 1) == 10.8 and round(LOAD / SHAKEN, 1) == 49.5
            ),
        },
        f"{LOAD / UNSHAKEN:.1f} and {LOAD / SHAKEN:.1f} by its own torques",
        "Arithmetic: (144) has both from its own torques. Whether the wheel keeps its own at the "
        "lower of the two is claim 7.11, which is where it is judged. Our teeth have "
        f"{still:.1f} without vibration; in balance, with one flank bearing, it is "
        f"{LOAD / none:.0f} without friction, which is the ratio, and {most:.1f} with friction "
        "reversed all the time. "
        "Above the ratio the wheel gives more power than the worm takes, which the thesis itself "
        "calls incorrect as an efficiency: the rest comes from what shakes the worm, or from the "
        "wheel's speed.",
        {
            "advantage_static": still,
            "advantage_without_friction": LOAD / none,
            "advantage_friction_reversed": most,
            "torque_reversed_Nm": low,
            "torque_without_friction_Nm": none,
            "torque_static_Nm": high,
        },
        [f"{_TORQUE}(366.0, friction) of gearset-3b, friction -0.1344, 0, 0.1344"],
        verdict=ARITHMETIC,
        assumed=f"For what is ours: the contact at one radius of the worm, {1e3 * RADIUS:g} mm, "
        f"that of its loaded teeth; friction of {FRICTION:g}.",
    )


@claim("7.11")
def _savings() -> Finding:
    low, _, high = band()
    saved, gain = 1.0 - SHAKEN / UNSHAKEN, UNSHAKEN / SHAKEN
    floor = low / high
    last = of_set(3)[-1]
    others = varied()
    found, *changed = [run.shaken() for run in (last, *others)]
    marched = sorted(one.ratio for one in (found, *changed) if one.settled)
    least = min(floor, *marched)
    return Finding.judged(
        {
            "rounded, that is what its own 33.8 and 7.4 N m give": (
                round(saved, 1) == 0.8 and round(gain) == 5
            ),
            "“reduces worm torque by up to 80% to achieve the same wheel output torque”": (
                1.0 - least >= saved
            ),
        },
        f"its own numbers: -{saved:.1%} and {gain:.2f}; with the wheel in balance at most "
        f"-{1.0 - floor:.0%} and {1.0 / floor:.2f} with one flank bearing, "
        f"-{1.0 - found.ratio:.0%} marched",
        "At “the same wheel output torque” nothing that was tried comes near. While one flank "
        f"bears, as it must in a static step, the worm has at least {low:.1f} of {high:.1f} N m, "
        f"with friction reversed all the time, {floor:.2f} for the thesis's "
        f"{SHAKEN / UNSHAKEN:.2f}; where both flanks hammer that bound does not hold, and "
        "our march in balance leaves "
        f"{marched[0]:.2f} to {marched[-1]:.2f}, at the highest k_w, the two inertias, the "
        "contact's damping and the backlash one at a time a third and three times ours "
        f"({len(marched)} of {1 + len(changed)} settled; the shaft's damping and the hob stayed). "
        "A mean that is read "
        "while the wheel still coasts can be as low (claim 7.3), but the mesh does not give the "
        "wheel its torque then. The saving itself, by its own two torques, is right, rounded.",
        {
            "saved_by_its_numbers": saved,
            "gain_by_its_numbers": gain,
            "saved_at_most": 1.0 - floor,
            "gain_at_most": 1.0 / floor,
            "ratio_marched": found.ratio,
            "ratio_marched_least": marched[0],
            "ratio_marched_most": marched[-1],
        },
        [f"{_TORQUE}(366.0, friction) of gearset-3b", last, *others],
        assumed=f"For the bound, the contact at one radius of the worm, {1e3 * RADIUS:g} mm, and "
        f"friction of {FRICTION:g}. {assumed()}",
    )


@claim("7.12")
def _energy() -> Finding:
    ratios = np.array([0.5, 1.0, 2.0, 5.0])
    frequency = ratios * SPEED / (2.0 * math.pi * AMPLITUDE)
    energy = (AMPLITUDE * frequency / (_ULTRASONIC * FREQUENCY)) ** 2
    power = energy * frequency / FREQUENCY
    at = dict(zip(ratios, zip(frequency, energy, power, strict=True), strict=True))
    high = at[5.0]
    return Finding.judged(
        {
            "100 for the amplitude alone": round((AMPLITUDE / _ULTRASONIC) ** 2) == 100,
        },
        f"{(AMPLITUDE / _ULTRASONIC) ** 2:.0f} at equal frequency",
        "Ten times the amplitude at the same frequency is a hundred times the energy, by (146). "
        "In set 3 the amplitude stays and the frequency rises with k_w; were the sonotrode "
        f"measured at {FREQUENCY:g} Hz alone, the factor would be "
        + ", ".join(f"{energy_at:.3g} at k_w = {k:g}" for k, (_, energy_at, _) in at.items())
        + f", where the vibration is of up to {high[0]:.0f} Hz. Claim 7.19 finds from the printed "
        "efficiencies that it was measured at several, so that a hundred may be right in each.",
        {f"energy_at_k_w_{k:g}": float(values[1]) for k, values in at.items()}
        | {f"power_at_k_w_{k:g}": float(values[2]) for k, values in at.items()},
        ["(u_a f / (16 um 750 Hz))^2, f = k_w 1510.8 mm/s / (2 pi 0.16 mm)"],
        verdict=ARITHMETIC,
    )


def motor_of_the_saving(ratio: float) -> tuple[float, list[tuple[float, float, float]]]:
    """Return the mass of a motor that saves 6 kg at a share of the torque, and its shapes.

    Each shape is a diameter, length and density of the body, m and kg/m3, of which 50 mm and 30 mm
    leave that share of diameter squared times length; none is shorter than 0.8 diameters.
    """
    mass = _SAVED_MASS / (1.0 - ratio)
    shapes = []
    for diameter in np.arange(0.08, 0.2005, 0.0025):
        left = ratio / (1.0 - _SAVED_DIAMETER / diameter) ** 2
        if left < 1.0:
            length = _SAVED_LENGTH / (1.0 - left)
            density = mass / (0.25 * math.pi * diameter**2 * length)
            if length >= _SHORTEST * diameter and _DENSITIES[0] <= density <= _DENSITIES[1]:
                shapes.append((float(diameter), length, density))
    return mass, shapes


@claim("7.13")
def _motor() -> Finding:
    ratio = SHAKEN / UNSHAKEN
    mass, shapes = motor_of_the_saving(ratio)
    runs = of_set(3)
    # In balance, where the torque falls at all.
    reached = [one.ratio for one in (run.shaken() for run in runs) if one.settled]
    least, most = min(reached), max(ratio for ratio in reached if ratio < _FALLS)
    balanced = {k: (1.0 - k) * mass for k in (least, most)}
    diameters = [shape[0] for shape in shapes]
    like = Motor.model_validate(
        {
            "name": "thesis", "power": 1.0, "speed": 1.0, "breakdown": 2.0, "mass": mass,
            "diameter": 0.1, "length": 0.18,
        }
    )  # fmt: skip
    less = scaled(like, least)
    before, after = (lightest(Service(((torque, 1.0),))) for torque in (UNSHAKEN, SHAKEN))
    return Finding.judged(
        {
            "the four numbers belong together at its own ratio": bool(shapes),
        },
        f"a motor of {mass:.1f} kg, some {1e3 * min(diameters):.0f} to {1e3 * max(diameters):.0f} "
        f"mm thick, saves all four at {ratio:.2f} of the torque",
        "Arithmetic: with torque, and mass, as diameter squared times length, the four numbers "
        f"agree with its own ratio of {ratio:.2f}, of one motor whose mass, diameter, length and "
        "price are free. Whether the torque falls to that "
        "is claims 7.3 and 7.11. The motor would be "
        f"one for short duty, where {UNSHAKEN:g} N m all the "
        f"time take {before.mass:g} kg (frame {before.name}) and {SHAKEN:g} N m {after.mass:g} kg "
        f"({after.name}). At the settled ratios of our set 3 that are below one, {least:.2f} to "
        f"{most:.2f}, it would save {balanced[most]:.1f} to {balanced[least]:.1f} kg; at "
        f"{least:.2f} it would be {1e3 * less.diameter:.0f} mm "
        f"thinner and {less.mass * PRICE_PER_MASS:.0f} GBP cheaper, before the actuator and its "
        "generator are paid and carried.",
        {
            "motor_mass_kg": mass,
            "least_settled_ratio": least,
            "most_settled_ratio_below_1": most,
            "saved_at_least_kg": balanced[least],
            "saved_at_most_kg": balanced[most],
            "saved_at_least_GBP": less.mass * PRICE_PER_MASS,
            "continuous_before_kg": before.mass,
            "continuous_after_kg": after.mass,
        },
        [*runs, "asperity.drive.motor.scaled", "asperity.drive.motor.lightest"],
        verdict=ARITHMETIC,
        assumed=f"For what stands beside: {_lower_first(assumed())}",
    )


@claim("7.16")
def _clearance() -> Finding:
    from asperity.flanks.meshing.analysis import analyse
    from asperity.flanks.wheel.enveloped import Wheel
    from asperity.thesis.flanks.meshing import pair_of

    thin = GEAR.plus(f"mount.backlash={THIN:g} mm")
    amplitudes = {}
    for name, gear in (("nominal", GEAR), ("thin", thin)):
        pair = pair_of(gear)
        amplitudes[name] = 1e-3 * analyse(pair, Wheel.cut(pair)).play.amplitude
    g = geometry()
    needed = 2.0 * AMPLITUDE * math.cos(g.lead_angle) * math.cos(g.pressure_angle)
    return Finding.judged(
        {},
        f"{1e3 * amplitudes['nominal']:.2f} mm with nominal threads; {1e3 * AMPLITUDE:g} mm "
        f"takes a "
        f"normal backlash of {1e3 * needed:.2f} mm",
        "The backlash of the thesis's gearset and the hob of its wheel are lost, and with them "
        "what its clearance allows. With the hob that is borrowed, threads of nominal thickness "
        f"have none; with {THIN:g} mm it is {1e3 * amplitudes['thin']:.3f} mm. Under load the "
        f"worm does not "
        "stand in the middle of it: it bears on one flank, the wheel goes with it, and nothing "
        "keeps the other flank away but the wheel's inertia.",
        {
            "amplitude_nominal_mm": 1e3 * amplitudes["nominal"],
            "amplitude_at_0.28_mm": 1e3 * amplitudes["thin"],
            "needed_backlash_mm": 1e3 * needed,
        },
        [GEAR, thin],
        verdict=NOT_TESTABLE,
    )


_PATENT = 2500.0  # Hz
_WORM_INERTIA, _SHAFT, _DAMPING = 1.3e-5, 4394.0, 0.03
_ROTOR = 2.14e-2
"""Of a motor of frame 132S, kg m2; Motive, Delphi series 07/04."""


def worm_swing(torque: float, frequency: float) -> float:
    """Amplitude of the worm's turn under a swinging torque on its motor's rotor, rad.

    Rotor and worm on the shaft, free to turn, the shaft damped; the mesh holds nothing back.
    """
    omega = 2.0 * math.pi * frequency
    loss = 2.0 * _DAMPING * math.sqrt(_SHAFT * _WORM_INERTIA)
    spring = complex(_SHAFT, omega * loss)
    system = np.array(
        [
            [spring - _ROTOR * omega**2, -spring],
            [-spring, spring - _WORM_INERTIA * omega**2],
        ]
    )
    return float(abs(np.linalg.solve(system, [torque, 0.0])[1]))


@claim("7.18")
def _patent() -> Finding:
    resonance = math.sqrt(_SHAFT / _WORM_INERTIA) / (2.0 * math.pi)
    motor = lightest(Service(((UNSHAKEN, 1.0),)))
    speed = 2.0 * math.pi * 24.0
    mains = 50.0
    swings = {f: worm_swing(motor.torque, f) for f in (mains, _PATENT, resonance)}
    ratios = {f: swing * 2.0 * math.pi * f / speed for f, swing in swings.items()}
    needed = 1.0 / ratios[_PATENT]
    return Finding.judged(
        {},
        f"the worm's speed swings by {ratios[_PATENT]:.3f} of its mean at {_PATENT:g} Hz",
        "The thesis says that a patent indicates it; of the patent's own machine it tells too "
        "little to judge. What gearset 3 would do at its speed, its motor "
        f"({motor.name}) swinging its torque by all of its rated {motor.torque:.0f} N m: the "
        f"rotor's inertia, {1e3 * _ROTOR:g} g m2 (of one "
        "catalogue), hardly moves; the worm on its shaft does more the nearer it is to its "
        f"resonance of {resonance:.0f} Hz, {ratios[resonance]:.2f} there, with a damping ratio of "
        f"{_DAMPING:g}, and {ratios[mains]:.2f} at {mains:g} Hz. Were friction to reverse, "
        f"it would have to be above 1: {needed:.0f} times the torque would do, or a slower machine "
        "with a lighter rotor.",
        {
            "resonance_Hz": resonance,
            "speed_ratio_at_2500_Hz": ratios[_PATENT],
            "speed_ratio_at_resonance": ratios[resonance],
            "speed_ratio_at_50_Hz": ratios[mains],
            "rotor_inertia_kg_m2": _ROTOR,
        },
        ["asperity.thesis.drive.claims.worm_swing(torque, frequency)"],
        verdict=NOT_TESTABLE,
    )
