"""Claims 6.1 to 6.7: what the rig is, and what vibration does on it."""

import math

from asperity.slider.closed_forms import (
    longitudinal_ratio,
    transverse_ratio,
    triangle_longitudinal_ratio,
    triangle_transverse_ratio,
)
from asperity.thesis.exhibits import claim
from asperity.thesis.products import Finding
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


@claim("6.1", "6.4.8", "Hertz pressure and normal load of the final rig.", "194.3 N/mm2, 141.6 N")
def _pressure() -> Finding:
    rig = pair()
    pressure = 1e-6 * rig.pressure
    return Finding.judged(
        {
            "194.3 N/mm2": abs(pressure - 194.3) < 0.1,
            "141.6 N": abs(rig.rig.load - 141.6) < 0.05,
        },
        f"{pressure:.2f} N/mm2, {rig.rig.load:.2f} N",
        "The table of its inputs is lost: moduli of 210 and 125 GPa give the printed pressure, the "
        "209 and 120 GPa that the thesis names elsewhere 191.6. 20 lb are 9.0718 kg; the 9.1 kg "
        "in the text would press with 141.9 N.",
        {
            "pressure_N_per_mm2": pressure,
            "load_N": rig.rig.load,
            "contact_width_mm": 2e3 * rig.half_width,
        },
        ["asperity.tribometer.discs.contact_pressure, on rig-final"],
    )


@claim("6.2", "6.4.7", "Slide-roll ratio at V_ms 1, 3 and 5.5 V.", "0.44, 0.88, 0.94")
def _slide_roll() -> Finding:
    before = [settled(supply).slide_roll for supply in m.SUPPLIES]
    shaken = settled(1.0, _TUNED).slide_roll
    mean = 0.5 * (before[0] + shaken)
    found = [mean, *before[1:]]
    close = [abs(one - said) < 0.03 for one, said in zip(found, m.SLIDE_ROLL, strict=True)]
    return Finding.judged(
        {"0.44, 0.88 and 0.94 within 0.03": all(close)},
        ", ".join(f"{one:.2f}" for one in found),
        f"{_FITTED} At 1 V it is {before[0]:.2f} before and {shaken:.2f} with vibration at 750 Hz: "
        "the printed one can be a mean of both only.",
        {
            "at_1_V_before": before[0],
            "at_1_V_with": shaken,
            "at_3_V": before[1],
            "at_5_5_V": before[2],
        },
        [PLANT],
        fitted=True,
    )


@claim("6.3", "6.4.11", "Torque at 750 Hz, transverse, in oil at 1 V.", "0.6448 -> 0.0925 N m")
def _torque() -> Finding:
    torques = [settled(1.0).state.torque, settled(1.0, _TUNED).state.torque]
    sliding = settled(1.0, _TUNED).state.sliding
    peak = m.AMPLITUDES[TRANSVERSE]
    rigid = float(transverse_ratio(peak / sliding))
    return Finding.judged(
        {
            "both within 2 %": all(
                abs(one / said - 1.0) < 0.02 for one, said in zip(torques, m.TORQUES, strict=True)
            )
        },
        f"{torques[0]:.4f} -> {torques[1]:.4f} N m",
        f"{_FITTED} The discs slide at {1e3 * sliding:.1f} mm/s then, k = {peak / sliding:.1f}, "
        f"where rigid friction of one coefficient alone would leave {rigid:.3f} of the torque; the "
        f"printed {m.TORQUES[1] / m.TORQUES[0]:.4f} needs k = 19.3 or friction that falls with "
        "speed.",
        {
            "torque_before_Nm": torques[0],
            "torque_with_Nm": torques[1],
            "sliding_velocity_m_s": sliding,
            "rigid_ratio": rigid,
        },
        [PLANT, "asperity.slider.closed_forms.transverse_ratio"],
        fitted=True,
    )


@claim(
    "6.4", "6.8", "Largest reduction of the torque, at 750 Hz: transverse, longitudinal.",
    "86 %, 78 %",
)  # fmt: skip
def _largest() -> Finding:
    across, along = (reduction(1.0, _TUNED, mode) for mode in (TRANSVERSE, LONGITUDINAL))
    return Finding.judged(
        {
            "86 % transverse": abs(across - 0.86) < 0.02,
            "78 % longitudinal": abs(along - 0.78) < 0.02,
        },
        f"{across:.0%}, {along:.0%}",
        "The 86 % is what the simulated rig was fitted to. A steel disc that is held predicts "
        f"{along:.0%} along the sliding at v_a = 87 mm/s; 78 % needs k = 2.95, and bearing torque "
        "within its bound of 0.04 N m does not bring it about. The friction that reverses moves "
        "the rim itself at some 50 mm/s, so that the disc is not held: a torsional resonance near "
        "530 Hz would give 78 %, which is a hypothesis.",
        {"transverse": across, "longitudinal": along},
        [PLANT],
    )


@claim("6.5", "6.5.2, 6.6.2", "Peak velocity at 750 Hz, transverse and longitudinal.",
       "59, 87 mm/s")  # fmt: skip
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
        fitted=True,
    )


@claim(
    "6.6", "6.5, 6.6", "Sine better than triangle; the faster the sliding the smaller the "
    "reduction.", "order",
)  # fmt: skip
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
    return Finding.judged(
        {
            "the faster the smaller": all(
                one[0] > one[1] > one[2] for one in slower.values()
            ),
            "sine better than an ideal triangle of equal stroke": all(
                sine[mode] < triangle[mode] for mode in sine
            ),
        },
        f"transverse {', '.join(f'{one:.0%}' for one in slower[TRANSVERSE])}, longitudinal "
        f"{', '.join(f'{one:.0%}' for one in slower[LONGITUDINAL])} at 1, 3, 5.5 V; left by sine "
        f"and triangle at 1 V {sine[TRANSVERSE]:.3f} and {triangle[TRANSVERSE]:.3f}",
        "At equal stroke a triangle is slower at its peak, 2/pi, but as fast all the time: rigid "
        "friction falls more by it above k = 1.3 across and 1.6 along the sliding. A sine is "
        "better only where amplifier and structure pass little but the first harmonic, as in the "
        f"simulated chain (by {100 * chain[TRANSVERSE]:.1f} points across, "
        f"{100 * chain[LONGITUDINAL]:.1f} along): a statement about these, not about friction.",
        {f"{mode}_{supply:g}_V": one for mode in slower
         for supply, one in zip(m.SUPPLIES, slower[mode], strict=True)}
        | {f"{mode}_sine_ratio": one for mode, one in sine.items()}
        | {f"{mode}_triangle_ratio": one for mode, one in triangle.items()},
        [PLANT, "asperity.slider.closed_forms"],
    )  # fmt: skip


@claim("6.7", "6.7", "Longitudinal vibration about doubles the wear at 5.5 V.", "x 2")
def _wear() -> Finding:
    sliding = m.SLIDING[1]
    k = m.AMPLITUDES[LONGITUDINAL] / sliding
    share = path_share(k, LONGITUDINAL)
    root_mean_square = math.sqrt(1.0 + 0.5 * k * k)
    return Finding.judged(
        {"the path doubles": share > 1.9},
        f"k = {k:.2f}: the path is {share:.3f} of the distance slid",
        "Below k = 1 the discs never slide back, so that the path on each other is the sliding "
        "distance with vibration as without: Archard's wear on it stays. The speed's root mean "
        f"square rises by {root_mean_square - 1.0:.0%}, heat and film change: none of it is a "
        "factor of two. Two runs on discs of which it is not told whether they were new leave "
        "other reasons.",
        {"velocity_ratio": k, "path_share": share, "root_mean_square_speed": root_mean_square},
        ["asperity.tribometer.reduction.wear.path_share"],
    )
