"""Claims 7.19, 7.22, 7.23, 8.1 and 8.2: power, force and use of a vibration of the worm."""

import math

import numpy as np

from asperity.thesis.drive.claims import assumed, geometry
from asperity.thesis.drive.sets import (
    AMPLITUDE,
    LOAD,
    RATIO,
    RATIOS,
    SHAKEN,
    UNSHAKEN,
    conditions,
)
from asperity.thesis.drive.simulations import STROKE, of_set
from asperity.thesis.exhibits import claim
from asperity.thesis.products import ARITHMETIC, NOT_TESTABLE, Finding

_TURNS = 24.0  # of the worm in set 3, 1/s
_PRINTED = (0.09, 0.13)
_MULTIPLE = 100.0
_MASS, _BLOCKING = 0.3, 1850.0
"""Of a worm, kg; of the piezo actuator (6.4.1), N."""
_LOBES = 12
_SAME = 0.1


@claim("7.19")
def _one_power() -> Finding:
    turn = 2.0 * math.pi * _TURNS
    out = LOAD * turn / RATIO
    most, least = (out / share for share in _PRINTED)
    own = (UNSHAKEN - SHAKEN) * turn
    left = (most - least - own) / _MULTIPLE
    return Finding.judged(
        {},
        f"{1e-3 * most:.1f} and {1e-3 * least:.1f} kW in all; the sonotrode's own power must "
        f"differ "
        f"by {left:.0f} VA or more",
        f"The wheel gives {1e-3 * out:.2f} kW, so that the printed efficiencies mean two powers, "
        f"{1e-3 * (most - least):.1f} kW apart. The worm's own can make up {1e-3 * own:.1f} kW of "
        "it, between its torques without vibration and with the most: one measured V_p i_p cannot "
        "give both, so it was measured at several frequencies. That leaves the factor of a hundred "
        "right at each of them (claim 7.12).",
        {"most_kW": 1e-3 * most, "least_kW": 1e-3 * least, "worm_kW": 1e-3 * own, "apart_VA": left},
        ["T_R omega_2 / eta_sys, less the worm's power, over 100"],
        verdict=ARITHMETIC,
    )


@claim("7.22")
def _force() -> Finding:
    found = {}
    for one in conditions(3):
        omega = 2.0 * math.pi * one.frequency
        found[one.ratio] = (one.frequency, AMPLITUDE * omega**2, _MASS * AMPLITUDE * omega**2)
    first, last = found[1.0], found[RATIOS[-1]]
    return Finding.judged(
        {},
        f"{1e-3 * last[0]:.0f} kHz, {last[1]:.2g} m/s2 and {1e-6 * last[2]:.1f} MN at "
        f"k_w = {RATIOS[-1]:g}",
        f"To shake a worm of {_MASS:g} kg by this amplitude takes {1e-3 * first[2]:.1f} kN at "
        f"k_w = 1 and the number above at the end of the set, where the piezo actuator of the rig "
        f"blocks at {_BLOCKING:g} N. Off its resonance no actuator of this kind does it; the set "
        "shows what the velocity ratio does, not what can be built, and the thesis does not say "
        "that it can.",
        {"force_at_k_w_1_N": first[2], "force_at_k_w_20_N": last[2], "frequency_Hz": last[0]},
        ["worm mass times u_a (2 pi f)^2"],
        verdict=ARITHMETIC,
        assumed=f"A worm of {_MASS:g} kg, lighter than the one that claim 7.21 has at most.",
    )


@claim("7.23")
def _by_ratio() -> Finding:
    found = {number: [run.shaken() for run in of_set(number)] for number in (1, 2, 3)}
    ratios = np.array([[one.ratio for one in group] for group in found.values()])
    apart = np.ptp(ratios, axis=0)
    settled = np.array([[one.settled for one in group] for group in found.values()]).all(axis=0)
    at = {k: ratios[:, n] for n, k in enumerate(RATIOS)}
    worst = float(apart[settled].max()) if settled.any() else float(apart.max())
    shown = (1.0, RATIOS[-1])
    return Finding.judged(
        {
            "the ratio goes by k_w": worst < _SAME,
        },
        "; ".join(f"{', '.join(f'{one:.2f}' for one in at[k])} at k_w = {k:g}" for k in shown)
        + " (sets 1, 2, 3)",
        "Both figures that look alike are lost, “similar” names no number, and what decides is "
        "ours or not told, as in claim 7.10: in a static step, and wherever no tooth parts, "
        "friction does go by k_w alone. In our march it does not: the same velocity ratio stands "
        "for other amplitudes and forces in each set, and what lifts "
        "the teeth off is the amplitude beside their deflection. Apart by up to "
        f"{apart.max():.2f}, and by {worst:.2f} where all three have settled, at "
        f"{int(settled.sum())} of {len(RATIOS)} ratios; at k_w = {RATIOS[0]:g}, where nothing "
        f"parts, by {apart[0]:.3f}.",
        {f"apart_at_k_w_{k:g}": float(d) for k, d in zip(RATIOS, apart, strict=True)},
        [run for number in (1, 2, 3) for run in of_set(number)],
        verdict=NOT_TESTABLE,
        assumed=f"The yardstick, {_SAME:g}. {assumed()}",
    )


@claim("8.1")
def _coupling() -> Finding:
    g = geometry()
    radius = 0.5 * g.diameter_factor * g.axial_module
    needed = radius / math.cos(g.lead_angle)
    return Finding.judged(
        {},
        f"k_w = 1 takes n u_a = {needed:.0f} mm; {needed / _LOBES:.2f} mm with {_LOBES} lobes",
        "A cam of n lobes on the worm moves it n times a turn, so that k_w = n u_a cos(gamma)/r_1: "
        "the speed drops out, and what it takes is a stroke. For gearset 3 that is more than its "
        "clearance lets it move, unless the lobes are many. An example is in docs, Drive "
        "(vibration tied to the worm's turn). The decoupling that the thesis asks for with it is "
        "marched by asperity control as a clutch between cam and worm (docs, What it is worth): "
        "the worm turns the cam, so that it pays for the vibration itself.",
        {"lobes_times_amplitude_mm": needed, "amplitude_of_12_lobes_mm": needed / _LOBES},
        ["r_1/cos(gamma) of gearset-3b"],
        verdict=ARITHMETIC,
    )


@claim("8.2")
def _on_demand() -> Finding:
    found = STROKE.stroke()
    energy = found.energy_shaken / found.energy_plain - 1.0
    wear = found.safety_plain / found.safety_shaken - 1.0
    return Finding.judged(
        {},
        f"{found.energy_shaken:.0f} for {found.energy_plain:.0f} J a stroke, wear {wear:+.0%}, "
        f"motor {found.motor_plain - found.motor_shaken:.1f} kg lighter for an actuator of "
        f"{found.actuator:.1f} kg",
        "What outweighs what is a judgement of the application. Of one, a valve actuator whose "
        f"gearset is shaken while it seats, {found.share:.0%} of the time: wear and efficiency are "
        f"indeed small matters, {wear:+.1%} and {energy:+.0%} of a stroke's energy, and so is the "
        "boost: a smaller motor, most of whose saved mass the actuator is. The control that "
        "switches it (section 8.2 iii), with each of its parts failing in turn, and sensors beside "
        "a shaken gear (section 8.2 v) are marched by asperity control (docs, What it is worth).",
        {
            "energy_change": energy, "wear_change": wear,
            "motor_saved_kg": found.motor_plain - found.motor_shaken,
            "actuator_kg": found.actuator,
        },
        [STROKE],
        verdict=NOT_TESTABLE,
        assumed="Gearset 2 shaken as a screw by an ultrasonic actuator; masses from memory.",
    )  # fmt: skip
