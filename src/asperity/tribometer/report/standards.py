"""What ASTM G99 (pin on disc) and G133 (reciprocating) ask a report to tell.

The headings are those of either standard's section on its report, in words of this package; the
standards are neither copied nor followed as a method: neither describes two discs that roll and
slide on each other.
"""

import dataclasses
import math
from collections.abc import Iterator, Sequence

from asperity.casefile import Case
from asperity.results.interval import numbers_of
from asperity.results.table import Table
from asperity.tribometer import discs
from asperity.tribometer.channels import Channels
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.parameters import Conditions, Disc, Lubricant
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction.blocks import lines_of
from asperity.tribometer.reduction.result import REFUSED, FileResult, Reduced, SegmentResult
from asperity.tribometer.reduction.wear import path_of
from asperity.tribometer.signals import SIGNALS

STANDARDS = {
    "G99": "ASTM G99, wear and friction with a pin-on-disc apparatus",
    "G133": "ASTM G133, linearly reciprocating ball-on-flat sliding wear",
}
MISSING = "not recorded"
_KELVIN = 273.15

Items = tuple[tuple[str, str], ...]


@dataclasses.dataclass(frozen=True)
class StandardHeading:
    """A heading of a standard's report, with what is told under it."""

    heading: str
    items: Items

    @property
    def missing(self) -> tuple[str, ...]:
        """What is not told."""
        return tuple(name for name, told in self.items if told == MISSING)


def headings_of(
    standard: str, case: Case, reduced: Reduced, recordings: Sequence[Recording]
) -> tuple[StandardHeading, ...]:
    """Return what a standard asks for, told as far as case and recordings do."""
    used = [one for one in reduced.segments if one.quality != REFUSED]
    found = (
        StandardHeading("Conformance", tuple(_conformance(standard, case))),
        StandardHeading("Apparatus and contact", tuple(_contact(case))),
        StandardHeading("Specimens", tuple(_specimens(case))),
        StandardHeading(
            "Test parameters",
            (
                *_parameters(standard, case, used, reduced.files),
                ("normal force, measured", measured("normal_force", case, recordings)),
            ),
        ),
        StandardHeading(
            "Environment and lubricant",
            (
                *_environment(case),
                ("temperature, measured", measured("temperature", case, recordings)),
            ),
        ),
        StandardHeading("Friction", tuple(_friction(used, reduced))),
        StandardHeading("Wear", tuple(_wear(case, reduced))),
        StandardHeading("Laboratory and instruments", tuple(_laboratory(case, recordings))),
    )
    return found


def measured(signal: str, case: Case, recordings: Sequence[Recording]) -> str:
    """Return what a signal was on average, over the recordings that have it."""
    import numpy as np

    unit, means = SIGNALS[signal].unit, []
    for one in (one for one in recordings if one.index_of(signal) is not None):
        scale, line = lines_of(one, case.require(Channels))[signal]
        if not np.isnan(values := one.values(signal)).all():
            means.append(float(line.of(np.array([scale * np.nanmean(values)]))[0]))
    if unit == "K":
        return _range([mean - _KELVIN for mean in means], "degC")
    return _range(means, unit)


def friction(case: Case, segments: Sequence[SegmentResult]) -> Table:
    """Return the coefficient of friction of each segment, with its interval."""
    pair = pair_of(case)

    def of(torque: float | None) -> float | str:
        if torque is None:
            return ""
        found = discs.friction_of_torque(
            torque, pair.rig.load, pair.steel.diameter, pair.rig.bearing_torque_steel
        )
        return float(f"{float(found):.4g}")

    rows = [
        (one.file, one.commanded, one.motor_voltage,
         *(of(value) for found in (one.torque_before, one.torque_with)
           for value in numbers_of(found)))
        for one in segments if one.quality != REFUSED
    ]  # fmt: skip
    heads = ("file", "f Hz", "V_ms V", "mu before", "low", "high", "mu with", "low", "high")
    return Table.of(
        heads, rows, title="Coefficient of friction",
        remarks=(
            "thesis (65) solved for mu, with the normal force, the radius and the bearings' torque "
            "taken as exact",
        ),
    )  # fmt: skip


def _conformance(standard: str, case: Case) -> Iterator[tuple[str, str]]:
    given = case.get(Conditions, Conditions())
    yield "standard", f"{STANDARDS[standard]}: headings of its report"
    moves = (
        "a pin or ball at rest on a turning disc" if standard == "G99"
        else "a ball that moves to and fro on a flat"
    )  # fmt: skip
    yield "deviation: contact", f"two discs in line contact in place of {moves}"
    yield "deviation: motion", "both surfaces move; they roll and slide, and one is shaken"
    yield "deviation: parameters", "not those of the standard's interlaboratory tests"
    yield "other deviations", given.deviations or "none stated"


def _contact(case: Case) -> Iterator[tuple[str, str]]:
    pair = pair_of(case)
    yield "apparatus", pair.rig.name
    yield "contact", f"line, {1e3 * pair.length:g} mm long, {2e3 * pair.half_width:.3g} mm wide"
    yield "largest Hertz pressure", f"{1e-6 * pair.pressure:.1f} N/mm2"
    yield "vibration", f"{pair.rig.mode}, of the bronze disc"


def _specimens(case: Case) -> Iterator[tuple[str, str]]:
    pair = pair_of(case)
    for name, one in (("steel disc", pair.steel), ("bronze disc", pair.bronze)):
        yield f"{name}: material", one.material or MISSING
        yield f"{name}: composition", one.composition or MISSING
        yield f"{name}: treatment", one.treatment or MISSING
        yield f"{name}: size", f"{1e3 * one.diameter:g} mm by {1e3 * one.thickness:g} mm"
        yield f"{name}: hardness", _told(one.hardness, 1e-9, "GPa")
        yield f"{name}: roughness Ra", _told(one.roughness, 1e6, "um")
        yield f"{name}: density", _told(one.density, 1.0, "kg/m3")
    given = case.get(Conditions, Conditions())
    yield "cleaning", given.cleaning or MISSING
    yield "running-in", given.running_in or MISSING


def _parameters(
    standard: str, case: Case, used: Sequence[SegmentResult], files: Sequence[FileResult]
) -> Iterator[tuple[str, str]]:
    pair = pair_of(case)
    yield "normal force", f"{pair.rig.load:.1f} N"
    speeds = [one.value for segment in used for one in
              (segment.sliding_velocity_before, segment.sliding_velocity_with)
              if one and one.value]  # fmt: skip
    yield "sliding speed", _range(speeds, "mm/s")
    yield "sliding distance", f"{sum(one.distance for one in files):.4g} m"
    path = path_of(files)
    yield "path with vibration", f"{path:.4g} m" if path else MISSING
    yield (
        "sliding radius",
        f"{1e3 * pair.steel.radius:g} mm (steel), " + (f"{1e3 * pair.bronze.radius:g} mm (bronze)"),
    )
    if standard == "G133":
        yield "frequency", _range([one.frequency for one in used if one.frequency], "Hz")
        strokes = [
            2e3 * one.velocity_amplitude / (2.0 * math.pi * one.frequency)
            for one in used if one.velocity_amplitude and one.frequency
        ]  # fmt: skip
        yield "stroke (twice the amplitude)", _range(strokes, "um")
        yield "waveform", ", ".join(sorted({one.waveform for one in used})) or MISSING
    yield "recordings", str(len(files))
    yield "segments", str(len(used))


def _environment(case: Case) -> Iterator[tuple[str, str]]:
    given, oil = case.get(Conditions, Conditions()), case.get(Lubricant)
    air = given.temperature
    yield "temperature of the air", MISSING if air is None else f"{air - _KELVIN:.3g} degC"
    humid = given.humidity
    yield "relative humidity", MISSING if humid is None else f"{100.0 * humid:.3g} %"
    yield "atmosphere", given.atmosphere or MISSING
    yield "lubricant", MISSING if oil is None else f"{oil.kind} {oil.name}".strip()
    if oil is not None and oil.kind != "dry":
        yield "viscosity", _told(oil.viscosity, 1.0, "Pa s")
        warm = oil.temperature
        yield "temperature of the discs", MISSING if warm is None else f"{warm - _KELVIN:.3g} degC"


def _friction(used: Sequence[SegmentResult], reduced: Reduced) -> Iterator[tuple[str, str]]:
    yield "coefficient of friction", "below, of each segment" if used else MISSING
    yield "change by vibration", _range([one.torque_change.value for one in used
                                         if one.torque_change is not None], "%")  # fmt: skip
    deviation = reduced.repeat_deviation
    yield "repeatability", (
        MISSING if deviation is None
        else f"{deviation:.2g} points of the change ({reduced.repeat_freedom} degrees of freedom)"
    )  # fmt: skip


def _wear(case: Case, reduced: Reduced) -> Iterator[tuple[str, str]]:
    pair = pair_of(case)
    for name, one in (("steel", pair.steel), ("bronze", pair.bronze)):
        lost = [1e-6 * worn["mass_loss_mg"] for worn in reduced.weighed if worn["disc"] == name]
        masses = [loss for file in reduced.files
                  if (loss := getattr(file, f"mass_loss_{name}")) is not None]  # fmt: skip
        total = sum(lost) if lost else 1e-6 * sum(masses) if masses else None
        yield f"{name} disc: mass loss", _told(total, 1e6, "mg")
        yield f"{name} disc: volume loss", _told(_volume(total, one), 1e9, "mm3")


def _volume(loss: float | None, disc: Disc) -> float | None:
    return None if loss is None or disc.density is None else loss / disc.density


def _laboratory(case: Case, recordings: Sequence[Recording]) -> Iterator[tuple[str, str]]:
    given = case.get(Conditions, Conditions())
    yield "laboratory", given.laboratory or MISSING
    yield "operator", given.operator or MISSING
    days = sorted({one.start.date().isoformat() for one in recordings})
    yield "dates", days[0] if len(days) == 1 else f"{days[0]} to {days[-1]}"
    rate = sorted({1.0 / one.sample_interval for one in recordings})
    yield "samples a second", _range(rate, "Hz")
    yield "simulated", "yes" if any(one.simulated for one in recordings) else "no"


def _told(value: float | None, size: float, unit: str) -> str:
    return MISSING if value is None else f"{size * value:.4g} {unit}"


def _range(values: Sequence[float], unit: str) -> str:
    if not values:
        return MISSING
    low, high = min(values), max(values)
    return f"{low:.4g} {unit}" if low == high else f"{low:.4g} to {high:.4g} {unit}"
