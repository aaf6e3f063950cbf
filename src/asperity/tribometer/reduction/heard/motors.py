"""Torques, speeds and currents against each other and against the supplies."""

import math
from collections.abc import Iterator

import numpy as np

from asperity.tribometer.options import Twin
from asperity.tribometer.reduction.heard.answers import Answers, answers
from asperity.tribometer.reduction.heard.finding import Finding
from asperity.tribometer.reduction.heard.level import levels_of
from asperity.tribometer.reduction.heard.material import Material
from asperity.tribometer.reduction.heard.rest import least_of
from asperity.tribometer.signals import SIGNALS

_SURE = 5.0  # standard errors
_SLOPES = 0.9, 1.11  # of the torques' changes over that of the radii; exchanged, it is the square
_LEVELS = 0.5, 2.0  # of the torques themselves, in which bearings are
_NO_ANSWER = 0.15  # of that slope, below which a torque does not answer the vibration
_MORE = 3.0  # times as much does an exchanged signal answer the vibration as the right one
_BENT = 0.03  # by what share the part that a current answers by may differ from cell to cell
_BEARS = 0.1, 0.02  # that of a torque, and of the torque itself by what its bearings may answer
_MISFIT = 0.05  # of their supplies, by which speeds that are exchanged miss these at least
_FITS = 3.0  # times better do speeds fit their supplies the other way round
_TEETH = 0.05  # of the wheel's speed, by which it may be off what the worm's has it
_MAP = "look at the cables and at the map of [channels]"


def findings(of: Material) -> Iterator[Finding]:
    """Yield what does not fit together."""
    if of.windows and of.pair.geared:
        yield from _signs(of)
        yield from _teeth(of)
        yield from _supplied(of)
        yield from _carried(of)
    elif of.windows:
        yield from _signs(of)
        yield from _torques(of)
        told = list(_exchanged(of, "speed"))
        yield from told or _other_way_round(of)
        yield from _exchanged(of, "current")
        yield from _supplied(of)
        yield from _carried(of)


def _teeth(of: Material) -> Iterator[Finding]:
    """Yield a wheel that does not turn as its teeth have it."""
    names = "speed_steel", "speed_bronze"
    worm, wheel = (_middle(of, name)[0] for name in names)
    wanted = of.pair.wheel_speed(worm)
    error = 0.5 * _encoder_step(of, names[1]) * abs(of.blocks.lines[names[1]].gain)
    if abs(worm) < least_of(names[0]) or abs(wheel - wanted) <= _TEETH * abs(wanted) + error:
        return
    yield Finding(
        "speeds are not as the teeth",
        f"speed_bronze is {wheel:.3g} rad/s, the gear ratio gives {wanted:.3g} of the worm's",
        "look at both calibrations, at the map of [channels] and at the coupling to the brake",
        names, of.curve(names[1]),
    )  # fmt: skip


def _middle(of: Material, signal: str) -> tuple[float, float]:
    levels = levels_of(of, signal)
    return float(np.median(levels[:, 0])), float(np.median(levels[:, 1]))


def _below(of: Material, signal: str) -> bool:
    value, error = _middle(of, signal)
    return value < -max(_SURE * error, least_of(signal))


def _signs(of: Material) -> Iterator[Finding]:
    def told(signal: str, against: str, *, spoils: bool = True) -> Finding:
        value, _ = _middle(of, signal)
        return Finding(
            f"{signal} has the wrong sign", f"{value:.3g} {SIGNALS[signal].unit_in_text} {against}",
            "turn the sensor's leads, or the sign of its calibration points", (signal,),
            of.curve(signal), spoils=spoils,
        )  # fmt: skip

    backwards = _below(of, "speed_steel")
    if _below(of, "torque_steel") != backwards:
        one = "speed_steel" if backwards else "torque_steel"
        yield told(one, "before vibration, while the motor drives its disc")
    bronze, error = _middle(of, "speed_bronze")
    if abs(bronze) > max(_SURE * error, least_of("speed_bronze")) and (bronze < 0.0) != backwards:
        yield told("speed_bronze", "before vibration, against that of the steel disc")
    for disc in ("steel", "bronze"):
        if of.has(f"current_{disc}") and _below(of, f"current_{disc}"):
            yield told(f"current_{disc}", "before vibration, from a supply that takes nothing back",
                       spoils=disc == "steel")  # fmt: skip
    if of.has("torque_bronze") and not backwards and not _below(of, "torque_steel"):
        value, error = _middle(of, "torque_bronze")
        if value > max(_SURE * error, least_of("torque_bronze")):
            yield told("torque_bronze", "before vibration, where the steel disc drives it on "
                       "and it is below zero; no number rests on it".replace("; ", ", "),
                       spoils=False)  # fmt: skip


def _torques(of: Material) -> Iterator[Finding]:
    """Yield torques that are not as the radii: the discs push each other with equal forces."""
    if not of.has("torque_bronze"):
        return
    names = "torque_steel", "torque_bronze"
    wanted = of.pair.bronze.radius / of.pair.steel.radius
    found = answers(of, *names, ("torque_steel (N m)", "torque_bronze (N m)"))
    if found is not None:
        slack = (_BEARS[0], _BEARS[1] * abs(_middle(of, names[1])[0]))
        if float(found.parts(*slack)[1].min()) < _NO_ANSWER * wanted:
            yield Finding(
                "torque_bronze does not answer the vibration",
                f"torque_steel changes by {found.x.max():.2g} N m, torque_bronze by "
                f"{found.y.max():.2g} N m, no number rests on it",
                "look at its sensor and at the map of [channels]", names, found.curve(),
                spoils=False,
            )  # fmt: skip
            return
        if told := _misfit(of, found, slack, wanted, _SLOPES):
            yield Finding(
                "torques are not as the radii",
                f"torque_bronze changes by {told} of torque_steel, the radii give {wanted:.2f}",
                "look at both calibrations, at the map of [channels] and at what their cables pick "
                "up", names, found.curve(),
            )  # fmt: skip
            return
    (one, _), (other, _) = (_middle(of, name) for name in names)
    if abs(one) < least_of("torque_steel"):
        return
    ratio = abs(other / one) / wanted
    if not _LEVELS[0] <= ratio <= _LEVELS[1]:
        yield Finding(
            "torques are not as the radii",
            f"torque_bronze is {abs(other / one):.2f} of torque_steel, the radii give {wanted:.2f}",
            "look at both calibrations and at the map of [channels]", names, of.curve(names[1]),
        )  # fmt: skip


def _exchanged(of: Material, what: str) -> Iterator[Finding]:
    """Yield a bronze disc's signal that answers the vibration as the steel disc's should."""
    names = f"{what}_steel", f"{what}_bronze"
    if not of.has(*names):
        return
    torque = levels_of(of, "torque_steel")
    weight = torque[:, 2] - torque[:, 0]
    if not np.all(np.isfinite(weight)) or not weight.any():
        return
    weight = weight / np.abs(weight).sum()
    answers, sure = [], []
    for name in names:
        levels = levels_of(of, name) / abs(of.blocks.lines[name].gain)
        if not np.all(np.isfinite(levels)):
            return
        answers.append(float(weight @ (levels[:, 2] - levels[:, 0])))
        errors = np.hypot(levels[:, 1], levels[:, 3])
        sure.append(_SURE * math.sqrt(float(weight**2 @ errors**2)))
    step = _encoder_step(of, names[1]) if what == "speed" else 0.0
    if abs(answers[1]) > max(sure[1], step) and abs(answers[1]) > _MORE * abs(answers[0]):
        yield Finding(
            f"{what}s are exchanged",
            f"{names[1]} answers the vibration by {1e3 * answers[1]:.2g} mV, {names[0]} by "
            f"{1e3 * answers[0]:.2g} mV",
            _MAP, names, of.curve(names[1]),
        )  # fmt: skip


def _other_way_round(of: Material) -> Iterator[Finding]:
    """Yield speeds that fit both supplies on each other's channel, and not on their own.

    Where vibration takes little off the torque, the steel disc's motor runs faster by less than
    a pulse of the bronze disc's encoder is worth, so that no answer tells them apart. Levels do:
    a motor's supply is its back voltage and what falls in it, V = k w + R i.
    """
    names, twin = ("speed_steel", "speed_bronze"), of.case.get(Twin)
    if twin is None or not of.has(*names, "current_steel", "current_bronze"):
        return
    time = of.segments[of.windows[0][0]].start
    supplies = [of.supply(disc, time) for disc in ("steel", "bronze")]
    drops = [
        twin.motor_resistance * max(_middle(of, f"current_{disc}")[0], 0.0)
        for disc in ("steel", "bronze")
    ]
    speeds = [abs(_middle(of, name)[0]) for name in names]
    lines = [of.blocks.lines[name] for name in names]
    if min(supplies) <= 0.0 or any(
        one < least_of(name) for one, name in zip(speeds, names, strict=True)
    ):
        return
    gain = abs(lines[0].gain / lines[1].gain)
    ways = speeds, [speeds[1] * gain, speeds[0] / gain]
    volts = [
        [twin.motor_constant * one + drop for one, drop in zip(way, drops, strict=True)]
        for way in ways
    ]
    here, there = (
        math.hypot(*(math.log(one / all_of) for one, all_of in zip(way, supplies, strict=True)))
        for way in volts
    )
    if here > _MISFIT and here > _FITS * there:
        yield Finding(
            "speeds are exchanged",
            f"with their currents and [twin] they are {volts[0][0]:.3g} V of {supplies[0]:g} V "
            f"and {volts[0][1]:.3g} V of {supplies[1]:g} V, on each other's channel "
            f"{volts[1][0]:.3g} V and {volts[1][1]:.3g} V",
            _MAP, names, of.curve(names[1]),
        )  # fmt: skip


def _encoder_step(of: Material, name: str) -> float:
    """Return what a pulse in a whole window is worth, in volts of its channel."""
    seconds = min(one.count for _, *both in of.windows for one in both) * of.blocks.length
    step = 2.0 * math.pi / (of.pair.drives.encoder_pulses * max(seconds, 1.0))
    return step / abs(of.blocks.lines[name].gain)


def _supplied(of: Material) -> Iterator[Finding]:
    """Yield motors that give more than they take, or turn as their supply does not let them."""
    time = of.segments[of.windows[0][0]].start
    volts = of.supply("steel", time)
    torque, speed = (_middle(of, one)[0] for one in ("torque_steel", "speed_steel"))
    current = _middle(of, "current_steel")[0] if of.has("current_steel") else None
    names = ("speed_steel",) if current is None else ("speed_steel", "current_steel")
    if current is not None and current > least_of("current_steel") and volts > 0.0:
        given = torque * speed / of.pair.drives.gear_ratio
        if given > volts * current:
            yield Finding(
                "more power than the supply gives",
                f"torque and speed are {given:.3g} W, {volts:g} V and {current:.3g} A are "
                f"{volts * current:.3g} W",
                "look at the calibrations of torque, speed and current, and at the supply's volts",
                ("torque_steel", *names), of.curve("speed_steel"),
            )  # fmt: skip
    if (twin := of.case.get(Twin)) is not None:
        for disc in ("steel",) if of.pair.geared else ("steel", "bronze"):
            yield from _turning(of, twin, disc)


def _turning(of: Material, twin: Twin, disc: str) -> Iterator[Finding]:
    """Yield a motor that turns as its supply does not let it, V = k w + R i, by [twin]."""
    name, current = f"speed_{disc}", f"current_{disc}"
    step = 0.5 * _encoder_step(of, name) * abs(of.blocks.lines[name].gain)
    told = []
    for index, before, _ in of.windows:
        volts, turns = of.supply(disc, of.segments[index].start), of.level(name, before)
        takes = of.level(current, before) if of.has(current) else None
        if volts <= 0.0 or not math.isfinite(turns.error) or abs(turns.value) < least_of(name):
            continue
        back, drop = twin.motor_constant * abs(turns.value), 0.0
        known = (
            twin.supply_tolerance * volts
            + twin.lead_voltage
            + twin.motor_constant * (_SURE * turns.error + step)
        )
        if takes is not None and math.isfinite(takes.error):
            drop = twin.motor_resistance * max(takes.value, 0.0)
            known += twin.motor_resistance * _SURE * takes.error
        # What falls in a motor whose current is not known leaves open how slow it is.
        known += twin.motor_tolerance * math.hypot(back, drop)
        least = volts - known if drop else 0.0
        if not least <= back + drop <= volts + known:
            told.append((index, back, drop, abs(turns.value), volts))
    for index, back, drop, turns_at, volts in told[:1] if len(told) == len(of.windows) else told:
        yield Finding(
            f"{name} does not fit its supply",
            f"{turns_at:.3g} rad/s are {back:.2g} V with twin.motor_constant, and {drop:.2g} V "
            f"fall in the motor, of {volts:g} V",
            "look at its scale and channel, at that of the current, at the supply's volts, and at "
            "motor_constant and motor_resistance of [twin]",
            (name,), of.curve(name), index if len(told) < len(of.windows) else None,
        )  # fmt: skip


def _carried(of: Material) -> Iterator[Finding]:
    """Yield a current that answers the torque by another part than motor and gear make of it.

    A motor gives k i, and of a change of the disc's torque ratio and efficiency of its gear leave
    it that part; what it drags by itself changes nothing of that. A gear gives no more than it
    takes, and the part is one for all cells of a file.
    """
    twin = of.case.get(Twin)
    if twin is None or not of.has("current_steel"):
        return
    found = answers(
        of, "torque_steel", "current_steel", ("torque_steel (N m)", "current_steel (A)")
    )
    if found is None:
        return
    told = twin.gear_efficiency
    part = 1.0 / (of.pair.drives.gear_ratio * told * twin.motor_constant)
    bounds = (
        (1.0 - twin.motor_tolerance) * told / min(1.0, told * (1.0 + twin.gear_tolerance)),
        (1.0 + twin.motor_tolerance) / (1.0 - twin.gear_tolerance),
    )  # fmt: skip
    if share := _misfit(of, found, (_BENT, 0.0), part, bounds, of_it=part):
        yield Finding(
            "current_steel does not fit its torque",
            f"it answers the vibration by {share} of what motor and gear take for the torque's "
            "answer, by [twin] and the gear's ratio",
            "look at the calibrations of its clamp and of the torque, at what their cables pick up "
            "of the drive, and at motor_constant and gear_efficiency of [twin]",
            ("current_steel",), found.curve(),
        )  # fmt: skip


def _misfit(
    of: Material, answers: Answers, slack: tuple[float, float], wanted: float,
    bounds: tuple[float, float], of_it: float = 1.0,
) -> str:  # fmt: skip
    """Return by what parts a signal answers a torque, where no one of those wanted fits all cells.

    Parameters
    ----------
    of : Material
        What is looked at.
    answers : Answers
        Changes of both.
    slack : tuple of 2 floats
        By what share the part may differ from cell to cell, and by what else the signal changes.
    wanted : float
        The part it should answer by.
    bounds : tuple of 2 floats
        By what share of that it may.
    of_it : float
        What the parts are told as shares of.
    """
    least, most = answers.parts(*slack)
    one, other = int(least.argmax()), int(most.argmin())
    if least[one] > most[other]:
        shares = answers.y / np.maximum(answers.x, 1e-12) / of_it
        told = sorted({one, other})
        return ", ".join(
            f"{shares[n]:.2g} at {of.segments[answers.places[n]].start:.0f} s" for n in told
        )
    least, most = answers.parts(0.0, slack[1])
    if least.max() > bounds[1] * wanted or most.min() < bounds[0] * wanted:
        return f"{answers.slope / of_it:.2g}"
    return ""
