"""Claims 6.1 to 6.7: what the rig is, and what vibration does on it."""

import math

from asperity.roots import root_between
from asperity.slider.closed_forms import (
    longitudinal_ratio,
    transverse_ratio,
    triangle_longitudinal_ratio,
    triangle_transverse_ratio,
)
from asperity.thesis.exhibits import claim
from asperity.thesis.products import FITTED, NOT_TESTABLE, Finding
from asperity.thesis.rig import measured as m
from asperity.thesis.rig.rig import LONGITUDINAL, PLANT, TRANSVERSE, case, pair, reduction, settled
from asperity.tribometer.parameters import Sonotrode
from asperity.tribometer.reduction.wear import path_share

_TUNED = 750.0
_FITTED = (
    "Fitted: drag, friction and its fall with speed of the simulated rig were chosen to give this "
    "number, which therefore is no test of it; other choices give it as well."
)
_EQUAL_STROKE = 2.0 / math.pi  # peak velocity of a triangle over that of a sine


@claim("6.1")
def _pressure() -> Finding:
    rig = pair()
    pressure = 1e-6 * rig.pressure
    return Finding.judged(
        {
            "194.3 N/mm2": abs(pressure - 194.3) < 0.1,
            "141.6 N": abs(rig.rig.load - 141.6) < 0.05,
        },
        f"{pressure:.2f} N/mm2, {rig.rig.load:.2f} N",
        "Table 6.8, which has its inputs, is lost, and the moduli here, "
        f"{1e-9 * rig.steel.young_modulus:g} and {1e-9 * rig.bronze.young_modulus:g} GPa, were "
        "chosen to give the printed pressure. The load is arithmetic: the platform's "
        f"{m.PLATFORM:g} kg and the dead mass of the text in pounds, {20.0 * m.POUND:.4f} kg, "
        f"under gravity of {m.GRAVITY:g}; "
        f"the {m.PRINTED_DEAD_MASS:g} kg that the text rounds them to would press with "
        f"{(m.PLATFORM + m.PRINTED_DEAD_MASS) * m.GRAVITY:.1f} N.",
        {
            "pressure_N_per_mm2": pressure,
            "load_N": rig.rig.load,
            "contact_width_mm": 2e3 * rig.half_width,
        },
        ["asperity.tribometer.discs.contact_pressure, on rig-final"],
        verdict=FITTED,
    )


@claim("6.2")
def _slide_roll() -> Finding:
    before = [settled(supply).slide_roll for supply in m.SUPPLIES]
    shaken = settled(1.0, _TUNED).slide_roll
    mean = 0.5 * (before[0] + shaken)
    found = [mean, *before[1:]]
    close = [abs(one - said) < 0.03 for one, said in zip(found, m.SLIDE_ROLL, strict=True)]
    return Finding.judged(
        {"0.44, 0.88 and 0.94 within 0.03": all(close)},
        ", ".join(f"{one:.2f}" for one in found),
        f"{_FITTED} At the lowest supply it is {before[0]:.2f} before and {shaken:.2f} with "
        f"vibration; of this rig, which proves nothing of the thesis's, the printed one can be a "
        "mean of both only.",
        {
            "at_1_V_before": before[0],
            "at_1_V_with": shaken,
            "at_3_V": before[1],
            "at_5_5_V": before[2],
        },
        [PLANT],
        verdict=FITTED,
    )


@claim("6.3")
def _torque() -> Finding:
    torques = [settled(1.0).state.torque, settled(1.0, _TUNED).state.torque]
    sliding = settled(1.0, _TUNED).state.sliding
    peak = m.AMPLITUDES[TRANSVERSE]
    rigid = float(transverse_ratio(peak / sliding))
    said = m.TORQUES[1] / m.TORQUES[0]
    needed = root_between(lambda k: float(transverse_ratio(k)) - said, 1.0, 100.0)
    return Finding.judged(
        {
            "both within 2 %": all(
                abs(one / said - 1.0) < 0.02 for one, said in zip(torques, m.TORQUES, strict=True)
            )
        },
        f"{torques[0]:.4f} -> {torques[1]:.4f} N m",
        f"{_FITTED} The discs slide at {1e3 * sliding:.1f} mm/s then, k = {peak / sliding:.1f}, "
        f"where rigid friction of one coefficient alone would leave {rigid:.3f} of the torque; the "
        f"printed {m.TORQUES[1] / m.TORQUES[0]:.4f} needs k = {needed:.1f} or friction that falls "
        "with speed.",
        {
            "torque_before_Nm": torques[0],
            "torque_with_Nm": torques[1],
            "sliding_velocity_m_s": sliding,
            "rigid_ratio": rigid,
            "needed_k": needed,
        },
        [PLANT, "asperity.slider.closed_forms.transverse_ratio"],
        verdict=FITTED,
    )


@claim("6.4")
def _largest() -> Finding:
    across, along = (reduction(1.0, _TUNED, mode) for mode in (TRANSVERSE, LONGITUDINAL))
    said, peak = m.LARGEST, m.AMPLITUDES[LONGITUDINAL]
    sliding = settled(1.0, _TUNED, LONGITUDINAL).state.sliding
    needed = root_between(lambda k: 1.0 - float(longitudinal_ratio(k)) - said[1], 1.0001, 100.0)
    return Finding.judged(
        {
            "“T_s reduces by up to 86% under transverse vibration”": abs(across - said[0]) < 0.02,
            "“78% under longitudinal vibration”": abs(along - said[1]) < 0.02,
        },
        f"{across:.0%}, {along:.0%} of the simulated rig",
        "The figures are lost, and a simulation refutes no measurement: the transverse number is "
        "what the simulated rig was fitted to, and of the longitudinal one it makes too much. "
        f"A steel disc that is held and sees the whole v_a of {1e3 * peak:g} mm/s must lose "
        f"{along:.0%} of its torque along the sliding; what was measured needs a velocity ratio of "
        f"{needed:.2f} for {peak / sliding:.1f}. So something takes vibration away: v_a was "
        "measured with the shaft at rest, and a disc on its shaft follows friction that reverses; "
        "a torsional resonance below the frequency would do it, which is a hypothesis "
        "(docs, Tribometer).",
        {"transverse": across, "longitudinal": along, "needed_velocity_ratio": needed},
        [PLANT],
        verdict=NOT_TESTABLE,
    )


@claim("6.5")
def _velocity() -> Finding:
    table = case().require(Sonotrode)
    found = {mode: table.velocity(mode, _TUNED) or 0.0 for mode in m.AMPLITUDES}
    rigid = math.pi * m.STROKE * _TUNED
    return Finding.judged(
        {
            "59 and 87 mm/s": all(
                abs(found[mode] - said) < 5e-4 for mode, said in m.AMPLITUDES.items()
            )
        },
        ", ".join(f"{1e3 * one:.0f} mm/s" for one in found.values()),
        "Fitted: the simulated chain holds the two numbers as they are printed, and placeholders "
        f"at all other frequencies. A rigid chain at the full stroke would move at "
        f"{1e3 * rigid:.1f} mm/s.",
        {f"{mode}_m_s": one for mode, one in found.items()} | {"rigid_chain_m_s": rigid},
        ["rig-final: sonotrode.transverse_velocity, sonotrode.longitudinal_velocity"],
        verdict=FITTED,
    )


@claim("6.6")
def _orders() -> Finding:
    k = {mode: peak / settled(1.0, _TUNED, mode).state.sliding
         for mode, peak in m.AMPLITUDES.items()}  # fmt: skip
    sine = {
        TRANSVERSE: float(transverse_ratio(k[TRANSVERSE])),
        LONGITUDINAL: float(longitudinal_ratio(k[LONGITUDINAL])),
    }
    triangle = {
        TRANSVERSE: float(triangle_transverse_ratio(_EQUAL_STROKE * k[TRANSVERSE])),
        LONGITUDINAL: float(triangle_longitudinal_ratio(_EQUAL_STROKE * k[LONGITUDINAL])),
    }
    slower = {
        mode: [reduction(supply, _TUNED, mode) for supply in m.SUPPLIES] for mode in m.AMPLITUDES
    }
    chain = {
        mode: reduction(1.0, _TUNED, mode) - reduction(1.0, _TUNED, mode, "triangle")
        for mode in m.AMPLITUDES
    }
    crossing = {
        TRANSVERSE: root_between(
            lambda k: float(transverse_ratio(k) - triangle_transverse_ratio(_EQUAL_STROKE * k)),
            0.2, 20.0,
        ),
        LONGITUDINAL: root_between(
            lambda k: float(longitudinal_ratio(k) - triangle_longitudinal_ratio(_EQUAL_STROKE * k)),
            1.05, 20.0,
        ),
    }  # fmt: skip
    return Finding.judged(
        {
            "the faster the sliding the smaller the reduction": all(
                one[0] > one[1] > one[2] for one in slower.values()
            ),
        },
        f"transverse {', '.join(f'{one:.0%}' for one in slower[TRANSVERSE])}, longitudinal "
        f"{', '.join(f'{one:.0%}' for one in slower[LONGITUDINAL])} at "
        f"{', '.join(f'{supply:g}' for supply in m.SUPPLIES)} V; the sine takes "
        f"{100 * chain[TRANSVERSE]:.1f} points more across, {100 * chain[LONGITUDINAL]:.1f} along",
        "What was measured, Figures 6.32 to 6.34, 6.42 and 6.43, is lost, and a simulated rig that "
        "was fitted to three slide-roll ratios, two torques and the fall of friction with speed "
        "tests nothing of it. Its order of speeds is the thesis's at "
        f"{_TUNED:g} Hz, the one frequency of which its chain has more than placeholders (claim "
        "6.5); any friction of which less is left the faster the vibration beside the sliding has "
        "that order. Below zero, at the fastest sliding along it, vibration raises the torque of "
        "the simulated rig, whose friction falls with speed: the thesis has nothing of it. "
        "Which wave does more the chain decides: ours, which passes little but the first harmonic, "
        "has the sine ahead, while of an ideal triangle of equal stroke rigid "
        f"friction falls more than of a sine above k = {crossing[TRANSVERSE]:.2f} across and "
        f"{crossing[LONGITUDINAL]:.2f} along, {triangle[TRANSVERSE]:.3f} for "
        f"{sine[TRANSVERSE]:.3f} across at {m.SUPPLIES[0]:g} V.",
        {f"{mode}_{supply:g}_V": one for mode in slower
         for supply, one in zip(m.SUPPLIES, slower[mode], strict=True)}
        | {f"{mode}_sine_ratio": one for mode, one in sine.items()}
        | {f"{mode}_triangle_ratio": one for mode, one in triangle.items()},
        [PLANT, "asperity.slider.closed_forms"],
        verdict=NOT_TESTABLE,
        assumed="The chain from supply to disc, which passes little but the first harmonic of a "
        "wave.",
    )  # fmt: skip


@claim("6.7")
def _wear() -> Finding:
    sliding = m.SLIDING[1]
    k = m.AMPLITUDES[LONGITUDINAL] / sliding
    share = path_share(k, LONGITUDINAL)
    root_mean_square = math.sqrt(1.0 + 0.5 * k * k)
    return Finding.judged(
        {"the path that the discs slide on each other explains it": share > 1.9},
        f"k = {k:.2f}: the path is {share:.3f} of the distance slid",
        "The weights are lost (Table 6.12), and “may” is what the thesis says. The path explains "
        "no "
        "doubling: below k = 1 the discs never slide back, so that the path on each other is the "
        "sliding "
        "distance with vibration as without (one within what the velocities are rounded to, claim "
        "6.11, would not change that): Archard's wear on it stays. The speed's root mean "
        f"square rises by {root_mean_square - 1.0:.0%}, heat and film change: none of it is a "
        "factor of two. Two runs on discs of which it is not told whether they were new leave "
        "other reasons.",
        {"velocity_ratio": k, "path_share": share, "root_mean_square_speed": root_mean_square},
        ["asperity.tribometer.reduction.wear.path_share"],
        verdict=NOT_TESTABLE,
    )
