"""Wear over distance: what discs lost at each weighing against the path up to there."""

import dataclasses
import math
from collections.abc import Iterator, Sequence

import numpy as np

from asperity.errors import InputError
from asperity.tribometer.calibration import Line, fitted_line
from asperity.tribometer.pair import Pair
from asperity.tribometer.parameters import Disc
from asperity.tribometer.reduction.result import FileResult, SegmentResult
from asperity.tribometer.reduction.wear import DISCS, Weighing, path_of
from asperity.tribometer.reduction.wear_result import WearResult
from asperity.tribometer.uncertainty import Budget, Budgeted, Cause, Contribution

_TO_MM3 = 1e9  # mm3/(N m) in m2/N


@dataclasses.dataclass(frozen=True)
class Stretch:
    """What lies between two weighings.

    Attributes
    ----------
    weighing : Weighing
        What the discs weighed before and behind.
    files : sequence of FileResult
        The recordings between.
    segments : sequence of SegmentResult
        Vibration in them.
    mode, lubricant : str
        Of the run.
    """

    weighing: Weighing
    files: Sequence[FileResult]
    segments: Sequence[SegmentResult]
    mode: str
    lubricant: str


def wear_rates(
    pair: Pair,
    stretches: Sequence[Stretch],
    uncertainty: float | None,
    confidence: float,
    notes: list[str],
) -> Iterator[WearResult]:
    """Yield the wear of each disc over the stretches of each run.

    Parameters
    ----------
    pair : Pair
        The discs.
    stretches : sequence of Stretch
        In their order.
    uncertainty : float or None
        Standard deviation of a weighing, kg; None: that of the masses about their line.
    confidence : float
        Of intervals.
    notes : list of str
        Takes why a rate has no interval, or is none.
    """
    for run in _runs(stretches):
        setting = run[0].weighing.setting
        for name in DISCS:
            if all(name in one.weighing.masses for one in run):
                disc: Disc = pair.steel if name == "steel" else pair.bronze
                yield _of_run(pair, name, disc, setting, run, uncertainty, confidence, notes)


def _runs(stretches: Sequence[Stretch]) -> list[list[Stretch]]:
    """Return stretches of the same discs together: each begins with what was weighed before it."""
    runs: list[list[Stretch]] = []
    for one in stretches:
        last = runs[-1][-1].weighing if runs else None
        goes_on = (
            last is not None
            and last.setting == one.weighing.setting
            and {disc: behind for disc, (_, behind) in last.masses.items()}
            == {disc: before for disc, (before, _) in one.weighing.masses.items()}
        )
        if goes_on:
            runs[-1].append(one)
        else:
            runs.append([one])
    return runs


def _of_run(
    pair: Pair,
    name: str,
    disc: Disc,
    setting: str,
    run: Sequence[Stretch],
    uncertainty: float | None,
    confidence: float,
    notes: list[str],
) -> WearResult:
    masses = [run[0].weighing.masses[name][0]]
    ways: dict[str, list[float]] = {"distance": [0.0], "path": [0.0]}
    doubt, known = 0.0, True
    for one in run:
        masses.append(one.weighing.masses[name][1])
        ways["distance"].append(ways["distance"][-1] + sum(of.distance for of in one.files))
        gone = path_of(one.files)
        known = known and gone is not None
        ways["path"].append(ways["path"][-1] + (gone or 0.0))
        doubt += sum(of.path_deviation for of in one.files)
    path = ways["path"][-1] if known else None
    distance = ways["distance"][-1]
    rates: dict[str, Budgeted | None] = dict.fromkeys(("path", "distance"))
    if disc.density is None:
        notes.append(f"{name} disc of {setting}: no density is given, and so no wear rate")
    elif (why := _unknown(masses, uncertainty)) and distance > 0.0:
        notes.append(f"{name} disc of {setting}: {why}")
    elif distance > 0.0:
        by_volume = -_TO_MM3 / (disc.density * pair.load)
        if path is None:
            refused = [
                f"{one.file} at {one.start or 0.0:.0f} s"
                for of in run for one in of.segments if one.k_v_with is None
            ]  # fmt: skip
            notes.append(
                f"{name} disc of {setting}: k is not known of the vibration of "
                f"{', '.join(refused)}, nor so the path; its wear rate is by distance alone"
            )
        offs = {} if path is None else {"path": doubt / path}
        for way, off in (offs | {"distance": 0.0}).items():
            line = _line(ways[way], masses, uncertainty)
            rates[way] = _rate(line, by_volume, off, uncertainty, confidence)
    if path is None and (alone := rates["distance"]) is not None:
        notes[-1] += f", {alone.value:.4g} ({alone.low:.4g} to {alone.high:.4g}) mm3/(N m)"
    rate = rates["path"]
    hardness = disc.hardness
    shaken = [one.commanded for of in run for one in of.segments if one.commanded is not None]
    return WearResult(
        disc=name, setting=setting, mode=run[0].mode, lubricant=run[0].lubricant,
        frequency=shaken[0] if shaken else 0.0, weighings=len(masses),
        distance=distance, path=path,
        shaken_distance=sum(file.shaken_distance for one in run for file in one.files),
        mass_loss=1e6 * (masses[0] - masses[-1]),
        wear_rate=rate, wear_rate_by_distance=rates["distance"],
        archard=None if rate is None or hardness is None else rate.value / _TO_MM3 * hardness,
    )  # fmt: skip


def _unknown(masses: Sequence[float], uncertainty: float | None) -> str:
    """Return why weighings leave no interval; nothing where they do."""
    if uncertainty is None and len(masses) < 3:
        return (
            "weighed twice only, so that its wear rate has no interval: give "
            "reduction.weighing_uncertainty, or plan.stretches of 2 or more"
        )
    if uncertainty is None and np.ptp(masses) == 0.0:
        return "the balance showed the same each time: give reduction.weighing_uncertainty"
    return ""


def _line(ways: Sequence[float], masses: Sequence[float], uncertainty: float | None) -> Line:
    # About its first value: a disc weighs a million times what it loses.
    points = [(way, mass - masses[0]) for way, mass in zip(ways, masses, strict=True)]
    try:
        return fitted_line(points, uncertainty)
    except InputError:
        # Nothing was lost that the balance shows.
        spread = np.array(ways) - np.mean(ways)
        return Line(0.0, gain_deviation=(uncertainty or 0.0) / math.sqrt(float(spread @ spread)))


def _rate(
    line: Line, by_volume: float, doubt: float, uncertainty: float | None, confidence: float
) -> Budgeted:
    value = by_volume * line.gain
    weighed = Cause(
        "weighings", "A" if uncertainty is None else "B", np.array([[line.gain_deviation**2]]),
        line.degrees_of_freedom,
    )  # fmt: skip
    causes = [Contribution.of(weighed, ["mass by way, kg/m"], [by_volume])]
    if doubt:
        shaken = Cause("velocity of the vibration", "B", np.array([[doubt**2]]))
        causes.append(Contribution.of(shaken, ["path, a share"], [value]))
    return Budgeted.of(Budget(value, tuple(causes), confidence))
