"""Claims 6.16 to 6.21: loads, gears, paths, strokes and speeds of the rig, by its own numbers."""

import math

import numpy as np

from asperity.thesis.exhibits import claim
from asperity.thesis.products import ARITHMETIC, NOT_TESTABLE, Finding
from asperity.thesis.rig import measured as m
from asperity.thesis.rig.readings import friction
from asperity.thesis.rig.rig import pair

_POUNDS, _DEAD_POUNDS, _DEAD_FORCE = 8.0, 40.0, 178.0
_PRINTED_RATIO_OF_960 = 960.0 / 30.0
_DISTANCE, _MISPRINTED, _HOURS = 1800.0, 1.8, 6.0
_VOLTS, _MOVED = (-20.0, 120.0), (-7.0, 25.0)
_TESTED_BEFORE = 5e-3  # m/s
_PRELOAD, _AMPLITUDE, _FREQUENCIES = 0.25, 16e-6, (750.0, 2000.0, 3000.0)


@claim("6.16")
def _pounds() -> Finding:
    force = _POUNDS * m.POUND_FORCE
    printed = float(m.PRINTED_LOADS[m.LOADS_LB == _POUNDS][0])
    dead = _DEAD_POUNDS * m.POUND_FORCE
    by_weight, as_printed = friction(m.LOADS_LB * m.POUND_FORCE), friction(m.PRINTED_LOADS)
    factor = force / printed
    return Finding.judged(
        {
            "“Adding 40 lbs (178 N) of dead mass”": round(dead) == _DEAD_FORCE,
            "“F_N >= 3.6 N (8 lbs)”": abs(force - printed) < 0.05 * force,
        },
        f"{_POUNDS:g} lb are {force:.1f} N, {factor:.2f} times as much",
        "The column of Table 6.3 that is headed N holds kilograms; 6.4.4 has pounds right. Only so "
        "does the motor's current mean friction as it may be, "
        f"{', '.join(f'{one:.2f}' for one in by_weight)}; as printed it would be "
        f"{as_printed.min():.1f} to {as_printed.max():.1f}.",
        {"force_N": force, "factor": factor}
        | {f"mu_{row}": one for row, one in enumerate(by_weight.tolist(), start=2)},
        ["asperity.tribometer.discs.friction_of_torque, on Table 6.3"],
    )


@claim("6.17")
def _gear_of_75() -> Finding:
    stated = pair().drives.gear_ratio
    right = 30.0 * stated
    less = stated / _PRINTED_RATIO_OF_960 - 1.0
    return Finding.judged(
        {"“960” with “a 90° gearbox of 30:1 speed reduction ratio”": right == 960.0},
        f"{right:.0f} for a gearbox of {stated:g}:1",
        f"The divisor is thirty times the ratio, so that the printed one means a gearbox of "
        f"{_PRINTED_RATIO_OF_960:g}:1. It stands in both halves of (75), which a slip of reading "
        f"would hardly do; which of the two is wrong is open. With {stated:g}:1 power and "
        f"efficiency come out {abs(less):.1%} too low. What "
        "was computed by it, Figures 6.40, 6.41, 6.49 and 6.50, is lost.",
        {"divisor": right, "power_change": less},
        ["30 times drives.gear_ratio of rig-final"],
    )


@claim("6.18")
def _path() -> Finding:
    fastest = m.SLIDING[1]
    hours = _DISTANCE / fastest / 3600.0
    seconds = _MISPRINTED / fastest
    return Finding.judged(
        {
            "1800 m in under 6 h": hours < _HOURS,
            "“Wear test performed to 1.8 metres of sliding”": math.isclose(_MISPRINTED, _DISTANCE),
        },
        f"{hours:.2f} h at {1e3 * fastest:g} mm/s; {seconds:.0f} s for the distance of the "
        f"conclusions",
        "Section 6.7 holds at the fastest sliding that 6.4.7 names. The number of the conclusions "
        "is that of section 6.7 in kilometres, its unit printed as metres.",
        {"hours": hours, "seconds_for_1.8_m": seconds},
        ["distance over v_sl of 6.4.7"],
    )


@claim("6.19")
def _stroke() -> Finding:
    total = _MOVED[1] - _MOVED[0]
    stroke = 1e6 * m.STROKE
    linear = [stroke * volts / (_VOLTS[1] - _VOLTS[0]) for volts in _VOLTS]
    return Finding.judged(
        {"the two make the stroke": math.isclose(total, stroke)},
        f"{total:g} um in all; a linear actuator would do {linear[0]:.1f} and {linear[1]:.1f} um",
        "The two readings make the stroke. They are not in proportion to the voltage: hysteresis "
        "of the piezo, or a zero that was not read at 0 V, of which a dial tells nothing.",
        {"stroke_um": total, "linear_low_um": linear[0], "linear_high_um": linear[1]},
        ["32 um over 140 V"],
        verdict=ARITHMETIC,
    )


@claim("6.20")
def _faster() -> Finding:
    fast, ratio = m.SLIDING[1], m.SLIDE_ROLL[-1]
    # R is the difference of the rims' velocities over their sum.
    bronze = 0.5 * fast * (1.0 / ratio - 1.0)
    sliding = [2.0 * bronze * one / (1.0 - one) for one in m.SLIDE_ROLL]
    return Finding.judged(
        {f"the fastest, above the {1e3 * _TESTED_BEFORE:g} mm/s of planar contacts":
         sliding[-1] > _TESTED_BEFORE},
        ", ".join(
            f"{1e3 * one:.1f} mm/s at {volts:g} V"
            for one, volts in zip(sliding, m.SUPPLIES, strict=True)
        ),
        "“Faster than any” is said of sliding-rolling, lubricated contacts, and of earlier tests "
        f"of these no velocity is named: the {1e3 * _TESTED_BEFORE:g} mm/s are of planar ones. "
        "What follows from printed numbers stands beside: with the slide-roll ratios of the same "
        f"sentence the bronze rim moves at {1e3 * bronze:.2f} mm/s, and the sliding velocity at "
        f"the lowest supply, where the greatest reduction was found, is {1e3 * sliding[0]:.1f} "
        f"mm/s for the printed {1e3 * m.SLIDING[0]:g}.",
        {f"sliding_at_{volts:g}_V_m_s": one
         for one, volts in zip(sliding, m.SUPPLIES, strict=True)}
        | {"bronze_rim_m_s": bronze},
        ["v_sl and R of 6.4.7"],
        verdict=NOT_TESTABLE,
    )  # fmt: skip


@claim("6.21")
def _preload() -> Finding:
    from asperity.thesis.rig.rig import case
    from asperity.tribometer.parameters import Sonotrode

    force = _PRELOAD * (case().require(Sonotrode).blocking_force or math.nan)
    acceleration = _AMPLITUDE * (2.0 * np.pi * np.array(_FREQUENCIES)) ** 2
    masses = force / acceleration
    held = [f"{one:.2g} kg at {f:g} Hz" for one, f in zip(masses, _FREQUENCIES, strict=True)]
    return Finding.judged(
        {},
        f"{force:.0f} N hold {', '.join(held)} at full stroke",
        "The mass that the sonotrode moves is not told, so it cannot be judged; what the preload "
        "can hold at the full stroke is. It falls with the square of the frequency: a shaft with "
        "its disc lifts off at the highest frequencies or moves less, which would explain why "
        f"{_FREQUENCIES[-1]:g} Hz do least.",
        {f"mass_at_{f:g}_Hz_kg": float(one)
         for one, f in zip(masses, _FREQUENCIES, strict=True)},
        ["preload over u_a (2 pi f)^2"],
        verdict=NOT_TESTABLE,
    )  # fmt: skip
