"""Levels of signals that one another and ``[twin]`` tell: torques, the current, a speed.

What vibration changes tells nothing of what is added to a signal before and with it alike. Levels
do, as well as is known what else is in them: the bearings' torques, and what a motor drags.
"""

import math
from collections.abc import Collection, Iterator

import numpy as np

from asperity.arrays import FloatArray
from asperity.tribometer.options import Twin
from asperity.tribometer.reduction.heard.finding import Finding
from asperity.tribometer.reduction.heard.material import Material
from asperity.tribometer.reduction.heard.rest import least_of

_SURE = 5.0  # standard errors
# Of the torques' ratio, by which it may be off the radii's: where calibrations do not tell how
# well they are known, and where they do.
_GAIN, _RADII = 0.1, 0.02


def levels_of(of: Material, signal: str) -> FloatArray:
    """Return levels and standard errors, a row a segment: before, its error, with, its error."""
    rows = []
    for _, *both in of.windows:
        one, other = (of.level(signal, window) for window in both)
        rows.append((one.value, one.error, other.value, other.error))
    return np.array(rows)


def _sides(of: Material) -> Iterator[Finding]:
    """Yield torques whose levels leave bearings a torque that none has.

    The discs push each other with one force: T_s = b_s + r_s F and T_b = b_b - r_b F, so that
    T_b + (r_b / r_s) T_s is what bearings hold, which brake and do not drive.
    """
    names = "torque_steel", "torque_bronze"
    if not of.has(*names):
        return
    steel, bronze = (levels_of(of, name) for name in names)
    if not (np.isfinite(steel).all() and np.isfinite(bronze).all()):
        return
    ratio = of.pair.bronze.radius / of.pair.steel.radius
    level = float(np.median(steel[:, 0]))
    if level < least_of(names[0]):
        return
    rig = of.pair.rig
    # Either torque tells the force they share, one with its bearings in it, one without.
    pushed = abs(float(np.median(bronze[:, 0]))) + rig.bearing_torque_bronze
    shared = min(level, pushed / ratio / (1.0 - rig.bearing_tolerance))
    most = rig.bearing_torque_bronze + ratio * rig.bearing_torque_steel
    most += 2.0 * ratio * rig.bearing_tolerance * shared
    gain = _gain_of(of, names)
    over, under = [], []
    for n in (0, 2):
        left = bronze[:, n] + ratio * steel[:, n]
        unsure = gain * ratio * np.abs(steel[:, n])
        unsure += _SURE * np.hypot(bronze[:, n + 1], ratio * steel[:, n + 1])
        unsure += least_of(names[1])
        over.append(left - unsure - most)
        under.append(-left - unsure)
    if max(float(np.median(one)) for one in (*over, *under)) > 0.0:
        together = float(np.median(bronze[:, 0] + ratio * steel[:, 0]))
        yield Finding(
            "torques leave bearings what they cannot hold",
            f"torque_bronze and {ratio:.2f} of torque_steel come to {together:.3g} N m, bearings "
            f"hold 0 to {most:.3g} N m",
            "look at what comes into the torques with the motors, at both calibrations and at "
            "bearing_torque_steel, bearing_torque_bronze and bearing_tolerance of [rig]",
            names, of.curve(names[1]),
        )  # fmt: skip


def _gain_of(of: Material, names: Collection[str]) -> float:
    """Return by what share of itself the ratio of two torques may be off the radii's."""
    lines = [of.blocks.lines[name] for name in names]
    if not all(line.gain_deviation for line in lines):
        return _GAIN
    return _RADII + _SURE * math.hypot(*(line.gain_deviation / line.gain for line in lines))


def _drawn(of: Material, twin: Twin) -> Iterator[Finding]:
    """Yield a current that is not what drag and torque take: k i = D + T / (N eta)."""
    if not of.has("current_steel") or twin.motor_drag <= 0.0:
        return
    torque, current = (levels_of(of, name) for name in ("torque_steel", "current_steel"))
    if not (np.isfinite(torque).all() and np.isfinite(current).all()):
        return
    told, ratio = twin.gear_efficiency, of.pair.drives.gear_ratio
    load = np.maximum(torque[:, [0, 2]], 0.0)
    slack = _SURE * torque[:, [1, 3]]
    best, worst = min(1.0, told * (1.0 + twin.gear_tolerance)), told * (1.0 - twin.gear_tolerance)
    least, most = (twin.motor_drag * (1.0 + sign * twin.drag_tolerance) for sign in (-1.0, 1.0))
    low = least + np.maximum(load - slack, 0.0) / (ratio * best)
    high = most + (load + slack) / (ratio * worst)
    low, high = (
        one / ((1.0 + sign * twin.motor_tolerance) * twin.motor_constant)
        for one, sign in ((low, 1.0), (high, -1.0))
    )
    seen = current[:, [0, 2]]
    off = _SURE * current[:, [1, 3]]
    if np.median(np.maximum(low - seen - off, seen - off - high).max(axis=1)) <= 0.0:
        return
    wanted = (twin.motor_drag + load / (ratio * told)) / twin.motor_constant
    yield Finding(
        "current_steel is not what drag and torque take",
        f"it is {np.median(seen[:, 0]):.3g} A before vibration, drag and torque take "
        f"{np.median(wanted[:, 0]):.3g} A by [twin] ({np.median(low[:, 0]):.3g} to "
        f"{np.median(high[:, 0]):.3g})",
        "look at the calibrations of its clamp and of the torque, at what comes into them with "
        "the motor, and at motor_constant, motor_drag and gear_efficiency of [twin]",
        ("current_steel", "torque_steel"), of.curve("current_steel"),
    )  # fmt: skip


def _runs(of: Material, twin: Twin) -> Iterator[Finding]:
    """Yield a speed that does not answer vibration as its motor does: k dw = -R di at its supply.

    What falls in leads and brushes, and what the windings warm by, moves with the current.
    """
    names = "speed_steel", "current_steel"
    if not of.has(*names):
        return
    speed, current = (levels_of(of, name) for name in names)
    told = []
    for (index, *both), w, i in zip(of.windows, speed, current, strict=True):
        if not (np.isfinite(w).all() and np.isfinite(i).all()) or w[0] < least_of(names[0]):
            continue
        less, left = i[0] - i[2], _SURE * float(np.hypot(i[1], i[3]))
        wanted = twin.motor_resistance * less / twin.motor_constant
        seconds = min(one.count for one in both) * of.blocks.length - of.options.speed_settling
        step = 2.0 * np.pi / (of.pair.drives.encoder_pulses * max(seconds, 1.0))
        unsure = _SURE * float(np.hypot(w[1], w[3])) + 2.0 * step + twin.supply_tolerance * w[0]
        unsure += (
            2.0 * twin.motor_tolerance * abs(wanted)
            + twin.motor_resistance * left / twin.motor_constant
        )
        unsure += twin.lead_voltage * abs(less) / max(abs(i[0]), abs(less)) / twin.motor_constant
        if abs(w[2] - w[0] - wanted) > unsure:
            told.append((index, w[2] - w[0], wanted, w[0]))
    for index, seen, wanted, level in told[:1] if len(told) == len(of.windows) else told:
        yield Finding(
            "speed_steel does not answer as its motor",
            f"it changes by {seen:.3g} rad/s of {level:.3g}, its current leaves it {wanted:.3g} "
            "at a supply that holds its volts",
            "look at the encoder and its coupling, at the supply, and at motor_constant and "
            "motor_resistance of [twin]",
            names, of.curve(names[0]), index if len(told) < len(of.windows) else None,
        )  # fmt: skip


def findings(of: Material, told: Collection[str] = ()) -> Iterator[Finding]:
    """Yield levels that do not fit together; ``told``: signals of which something is told."""
    if not of.windows:
        return
    # Of a torque that something is wrong with no level is worth telling again.
    if not of.pair.geared and "torque_bronze" not in told:
        yield from _sides(of)
    if (twin := of.case.get(Twin)) is not None:
        yield from _drawn(of, twin)
        yield from _runs(of, twin)
