"""Claims 6.8 to 6.15: what follows from numbers in the text of chapter 6."""

import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.roots import root_between
from asperity.slider.closed_forms import longitudinal_ratio, transverse_ratio
from asperity.thesis.exhibits import claim
from asperity.thesis.products import ARITHMETIC, NOT_TESTABLE, Finding
from asperity.thesis.rig import measured as m
from asperity.thesis.rig.rig import LONGITUDINAL, PLANT, TRANSVERSE, pair, plant, settled
from asperity.tribometer import discs

_RPM = math.pi / 30.0
_TUNED = 750.0  # Hz
_TRANSFER = 0.71  # eta_y of Table 4.4
_DISCS = "asperity.tribometer.discs, on the speeds of Table 6.3"


def velocities() -> tuple[FloatArray, FloatArray, FloatArray]:
    """v_sl and v_ro in m/s, and R, of the speeds in Table 6.3."""
    rig = pair("rig-preliminary")
    steel = discs.peripheral_velocity(rig.steel.diameter, _RPM * m.STEEL_RPM)
    bronze = discs.peripheral_velocity(rig.bronze.diameter, _RPM * m.BRONZE_RPM)
    return (
        discs.sliding_velocity(steel, bronze),
        discs.rolling_velocity(steel, bronze),
        discs.slide_roll_ratio(steel, bronze),
    )


def friction(loads: FloatArray) -> FloatArray:
    """Friction that the rise of the motor's current means under loads in N."""
    rig = pair("rig-preliminary")
    torque = (
        plant().twin.motor_constant
        * (m.STEEL_CURRENT[1:] - m.STEEL_CURRENT[0])
        * rig.drives.gear_ratio
    )
    return np.asarray(discs.friction_of_torque(torque, loads[1:], rig.steel.diameter))


@claim("6.8")
def _dry_runs() -> Finding:
    sliding, rolling, ratio = velocities()
    apart = float(np.abs(1e3 * sliding - m.PRINTED_SLIDING).max())
    return Finding.judged(
        {
            "v_sl within 1.6 mm/s": apart < 1.6,
            "v_ro within 1.1 mm/s": bool(np.all(np.abs(1e3 * rolling - m.PRINTED_ROLLING) < 1.1)),
            "R within 0.006": bool(np.all(np.abs(ratio - m.PRINTED_RATIO) < 0.006)),
        },
        "v_sl "
        + ", ".join(f"{1e3 * one:.0f}" for one in sliding)
        + " mm/s; R "
        + ", ".join(f"{one:.3f}" for one in ratio),
        "Within the rounding of the speeds. Its column of loads is another matter, claim 6.16.",
        {f"v_sl_{row}_m_s": one for row, one in enumerate(sliding.tolist(), start=1)}
        | {f"R_{row}": one for row, one in enumerate(ratio.tolist(), start=1)},
        [_DISCS],
        verdict=ARITHMETIC,
    )


@claim("6.9")
def _roughness() -> Finding:
    means = {name: float(values.mean()) for name, values in m.ROUGHNESS.items()}
    rounded = float(np.round(m.ROUGHNESS["steel"].mean(axis=1), 2).mean())
    return Finding.judged(
        {
            "0.76 um of bronze": round(means["bronze"], 2) == 0.76,
            "0.81 um of steel, from rounded means": math.floor(100.0 * rounded) == 81,
        },
        f"{means['bronze']:.3f}, {means['steel']:.3f} um",
        f"The nine readings of steel have the mean {means['steel']:.3f}; its three means, rounded "
        f"to two places, {rounded:.4f}, of which the thesis keeps two.",
        {f"{name}_um": value for name, value in means.items()},
        ["the mean of nine readings"],
        verdict=ARITHMETIC,
    )


@claim("6.10")
def _current() -> Finding:
    rise = float(m.STEEL_CURRENT[-1] / m.STEEL_CURRENT[0])
    ratio = float(velocities()[2][0])
    return Finding.judged(
        {"i_ms almost doubles": 1.85 < rise < 2.0, "R is 0.92, within rounding": ratio > 0.9149},
        f"x {rise:.2f}; {ratio:.4f}",
        "R lies between the two printed figures as far as its three digits tell. The load is "
        "another "
        "than is printed, claim 6.16.",
        {"current_ratio": rise, "R": ratio},
        [_DISCS],
        verdict=ARITHMETIC,
    )


@claim("6.11")
def _below_one() -> Finding:
    k = m.AMPLITUDES[LONGITUDINAL] / m.SLIDING[1]
    # Both ends of the range of sliding velocities are printed to one digit.
    least = m.SLIDING[1] - 0.005
    return Finding.judged(
        {
            "“Tests at k_v < 1 cannot be performed in longitudinal mode”, at the frequency "
            "of which the sentence is, within rounding": round(
                m.AMPLITUDES[LONGITUDINAL] / least, 2
            )
            >= 1.0
        },
        f"{k:.2f} at the fastest sliding and the frequency of the greatest v_a",
        f"At {_TUNED:g} Hz, of which the sentence is, {1e3 * m.AMPLITUDES[LONGITUDINAL]:g} over "
        f"{1e3 * m.SLIDING[1]:g} mm/s is {k:.3f}, below one as printed, and one within what the "
        f"sliding velocity is rounded to if that is a ten, {1e3 * least:g} mm/s or more. Of "
        "all frequencies it would not hold: Table 6.10 has tests along the sliding at "
        f"{m.SUPPLIES[-1]:g} V at five others, and at each of these v_a is less, by the thesis's "
        f"own words, so that k_v is below {k:.2f} in all of them.",
        {"k_v": k},
        ["v_a of 6.6.2 over v_sl of 6.4.7"],
        verdict=ARITHMETIC,
    )


@claim("6.12")
def _power() -> Finding:
    before, shaken = settled(1.0), settled(1.0, 750.0)
    torque = shaken.state.torque / before.state.torque - 1.0
    power = shaken.power / before.power - 1.0
    speed = shaken.state.steel / before.state.steel - 1.0
    droop = m.STEEL_RPM[0] - m.STEEL_RPM[-1]
    drawn = m.STEEL_CURRENT[-1] - m.STEEL_CURRENT[0]
    return Finding.judged(
        {"power falls about as torque does": abs(power - torque) < 0.1},
        f"torque {torque:.0%}, power {power:.0%}, speed {speed:+.0%}",
        "Table 6.11 and Figures 6.38 and 6.39 are lost. On the simulated rig, whose motor is "
        "fitted, power and torque do fall alike; yet a motor at a fixed voltage that is relieved "
        "of its torque runs faster, and at the lowest supply by no small part: Table 6.3 has it "
        f"lose {droop:.0f} rpm for {drawn:.2f} A, at {m.DRY_SUPPLY:g} V.",
        {"torque_change": torque, "power_change": power, "speed_change": speed},
        [PLANT],
        verdict=NOT_TESTABLE,
    )


@claim("6.13")
def _fixed_disc() -> Finding:
    crossing = root_between(
        lambda k: float(longitudinal_ratio(k)) - float(transverse_ratio(k)), 1.0001, 3.0
    )
    k = np.array([2.0, 5.0, 20.0])
    along, across = longitudinal_ratio(k), transverse_ratio(k)
    part, full = (float(transverse_ratio(share * k[-1])) for share in (_TRANSFER, 1.0))
    return Finding.judged(
        {
            "full transfer leaves less than a part of it": full < part,
        },
        f"full transfer leaves {full:.3f} for {part:.3f} at k = {k[-1]:g}; longitudinal is lower "
        f"above k = {crossing:.3f}",
        "The explanation, a possible one, points the right way: a disc that cannot move sideways "
        "has all of the vibration in its contact, and friction falls more. Whether it suffices "
        "the thesis does not say, and the figure that shows how far the order turned is lost. "
        "By itself, which is ours, it does not turn the order of rigid friction, which leaves less "
        "along the sliding from the crossing on, "
        + ", ".join(f"{a:.3f} against {b:.3f} at k = {x:g}" for x, a, b in
                    zip(k, along, across, strict=True))
        + ". Something that weakens the longitudinal one would have to come to it.",
        {"crossing_k": crossing, "ratio_full_transfer": full, "ratio_in_part": part},
        ["asperity.slider.closed_forms.longitudinal_ratio, transverse_ratio"],
        verdict=NOT_TESTABLE,
        assumed=f"The part of it, {_TRANSFER:g}, as eta_y of chapter 4.",
    )  # fmt: skip


@claim("6.14")
def _trends() -> Finding:
    low = m.AMPLITUDES[TRANSVERSE] / m.SLIDING[1]
    across = float(transverse_ratio(low))
    ratios = (1.5, 1.1, 1.0)
    along = [float(longitudinal_ratio(k)) for k in ratios]
    return Finding.judged(
        {
            "transverse below 1 at k <= 1": across < 0.95,
            "longitudinal rises to 1 at k = 1": along[0] < along[1] < along[2] == 1.0,
        },
        f"transverse {across:.3f} at k = {low:.2f}; longitudinal "
        + ", ".join(f"{one:.2f}" for one in along)
        + " at k = "
        + ", ".join(f"{k:g}" for k in ratios),
        "The measured curves, Figures 6.37 and 6.46, are lost. What rigid friction does at the k "
        "of the thesis's own velocities stands here; it has both trends by its formula.",
        {"transverse_ratio": across, "k": low},
        ["asperity.slider.closed_forms.longitudinal_ratio, transverse_ratio"],
        verdict=NOT_TESTABLE,
    )


@claim("6.15")
def _gain() -> Finding:
    rigid = math.pi * m.STROKE * 750.0
    gains = {mode: one / rigid for mode, one in m.AMPLITUDES.items()}
    return Finding.judged(
        {},
        ", ".join(f"{mode} {one:.2f}" for mode, one in gains.items()),
        f"The thesis claims nothing of it: what follows from its numbers is told. A rigid chain at "
        f"the full stroke would move at {1e3 * rigid:.1f} mm/s, so that the lower shaft gets "
        f"{gains[TRANSVERSE]:.2f} of it across and {gains[LONGITUDINAL]:.2f} along the sliding, "
        "the latter near a resonance. Both were measured with the shaft at rest. That the "
        "displacement is “fully transferred” was checked at a steady voltage, and says nothing of "
        f"{_TUNED:g} Hz.",
        {f"{mode}_gain": one for mode, one in gains.items()} | {"rigid_m_s": rigid},
        ["v_a over pi f 32 um"],
        verdict=ARITHMETIC,
    )
