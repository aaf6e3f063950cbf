"""The answer of ``asperity rig report``: a page that stands by itself."""

import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.results import Result, quantity
from asperity.results.report import Picture, Section
from asperity.results.table import Table
from asperity.tribometer.plots import changes, over_velocity
from asperity.tribometer.reduction import budget_tables
from asperity.tribometer.reduction.result import Reduced
from asperity.tribometer.report.standards import MISSING, StandardHeading
from asperity.tribometer.sheets import Sheet

if TYPE_CHECKING:
    pass

_BUDGETED = ("torque_before", "torque_with", "torque_change")
_CHANGES = {
    "torque_change": ("Change of the torque over the frequency", "change of the torque (%)",
                      "As figures 6.32 to 6.34, 6.42 and 6.43. Bars: 95 %."),
    "power_change": ("Change of the power over the frequency", "change of the power (%)",
                     "As figures 6.38, 6.39, 6.47 and 6.48."),
    "efficiency_change": ("Change of the efficiency over the frequency",
                          "change of thesis (75), points",
                          "As figures 6.40, 6.41, 6.49 and 6.50: losses of motor and gear count as "
                          "useful there."),
    "velocity_amplitude": ("Velocity of the vibration over the frequency", "$v_a$ (mm/s)",
                           "As figures 6.36 and 6.45, beside the change of the torque: by the "
                           "accelerometer where there is one, else by the table of [sonotrode]."),
}  # fmt: skip

_OF_GEARS = {
    "torque_change": "Of the worm's torque, at what the brake holds the wheel with. Bars: 95 %.",
    "power_change": "Of the power that goes into the worm's shaft.",
    "efficiency_change": "Of the worm's shaft over what its motor takes.",
    "velocity_amplitude": "Along the worm's axis: by the accelerometer, else by the table of "
                          "[sonotrode].",
}  # fmt: skip


class Report(Result):
    """A series of tests on one page.

    Attributes
    ----------
    reduced : Reduced
        The recordings, reduced.
    conditions : tuple of (str, str)
        What they were made under, in words.
    planned : dict
        Cells of the plan, and how many of them were measured.
    refused : tuple of (str, str)
        Files and segments that were left out, and why.
    sheets : tuple of Sheet
        Of the sensors.
    standard : str
        Whose headings it has; empty: none.
    asked : tuple of StandardHeading
        What that asks for.
    friction : Table or None
        Coefficients of friction, where a standard asks for them.
    geared : bool
        Whether a worm and its wheel stand in place of the discs.
    """

    title = "Tests on a rig"
    stem = "report"
    whole = True

    reduced: Reduced
    conditions: tuple[tuple[str, str], ...]
    refused: tuple[tuple[str, str], ...]
    sheets: tuple[Sheet, ...] = ()
    standard: str = ""
    asked: tuple[StandardHeading, ...] = ()
    friction: Table | None = None
    recordings: int = quantity("", "", "recordings")
    measured: int = quantity("", "", "segments that were reduced")
    left_out: int = quantity("", "", "files and segments that were left out")
    planned: int = quantity("", "", "cells of the plan, repeats counted")
    simulated: bool = quantity("", "", "whether simulated recordings are among them")
    geared: bool = False

    def to_json(self) -> dict[str, Any]:
        """Return what there is, the cells as they were reduced, and why something is not."""
        refused = [{"what": what, "why": why} for what, why in self.refused]
        told: dict[str, Any] = {"refused": refused}
        if self.standard:
            told["standard"] = self.standard
            told["asked"] = {one.heading: dict(one.items) for one in self.asked}
        return self.reduced.to_json() | super().to_json() | told

    def tables(self) -> tuple[Table, ...]:
        """Return what a standard asks for, conditions, cells, and what was left out."""
        return *self._headings(), *self._numbers()

    def _numbers(self) -> tuple[Table, ...]:
        cells, *intervals, files = self.reduced.tables()
        conditions = Table.of(("", ""), self.conditions, title="Conditions", left=2)
        refused = Table.of(("what", "why"), self.refused, title="Left out", left=2)
        named = Table(cells.columns, cells.rows, "Cells", cells.remarks)
        recorded = Table(files.columns, files.rows, "Recordings", files.remarks)
        return (
            conditions, named, *intervals, budget_tables.summary(self.reduced.uncertainties,
            self.reduced.not_counted, _BUDGETED), *self._calibrations(), recorded,
            *((refused,) if self.refused else ()),
        )  # fmt: skip

    def _calibrations(self) -> Iterator[Table]:
        """Yield what is told of the sensors, and the points of each."""
        heads = (
            "signal", "sensor", "points", "deviation %", "hysteresis %", "creep %", "class",
            "kept", "calibrated", "good until",
        )  # fmt: skip
        rows = [
            (one.signal, one.named or MISSING, len(one.points),
             *(_percent(value) for value in (one.deviation, one.hysteresis, one.creep)),
             "" if one.channel.accuracy_class is None else f"{one.channel.accuracy_class:g}",
             {None: "", True: "yes", False: "no"}[one.keeps_class],
             str(one.channel.date or MISSING), str(one.last_day or MISSING))
            for one in self.sheets
        ]  # fmt: skip
        yield Table.of(
            heads, rows, title="Calibrations", left=2,
            remarks=("percent of the capacity, or of the largest that was applied; a class is kept "
                     "where no deviation is larger, as makers mean it",),
        )  # fmt: skip
        named = ("signal", "applied", "unit", "from", "by the line", "error %", "back - forth %")
        points = [
            (one.signal, f"{point.applied:.5g}", one.unit,
             "above" if point.from_above else "below", f"{point.shown:.5g}",
             _percent(point.interpolation), _percent(point.reversibility))
            for one in self.sheets for point in one.points
        ]  # fmt: skip
        if points:
            yield Table.of(named, points, title="Points of the calibrations")

    def _headings(self) -> Iterator[Table]:
        for one in self.asked:
            yield Table.of(("", ""), one.items, title=one.heading, left=2)
        if self.friction is not None:
            yield self.friction

    def pictures(self, folder: Path | None = None) -> tuple[Picture, ...]:
        """Return the pictures, simulated ones marked."""
        dataset = self.reduced.to_dataset()
        if self.geared:
            return tuple(
                Picture(title, changes(dataset, name, label), _OF_GEARS.get(name, ""))
                for name, (title, label, _) in _CHANGES.items()
            )
        made = [
            Picture(title, changes(dataset, name, label), caption)
            for name, (title, label, caption) in _CHANGES.items()
        ]
        return (*made, Picture(
            "Torque ratio over the velocity ratio", over_velocity(dataset),
            "As figures 6.37, 6.46 and 6.51, measured against the model: k_v counts v_a over the "
            "mean of the sliding velocities before and with vibration. The model's ratio is that "
            "at the velocity with vibration.",
        ))  # fmt: skip

    def sections(self, folder: Path | None = None) -> tuple[Section, ...]:
        """Return notes, tables and pictures."""
        notes = Table((), (), remarks=self.notes)  # first, and once
        tables = (
            dataclasses.replace(
                one, remarks=tuple(said for said in one.remarks if said not in self.notes)
            )
            for one in self._numbers()
        )
        followed: tuple[Section, ...] = ()
        if self.standard:
            followed = (Section(f"By the headings of ASTM {self.standard}", tables=(
                *self._headings(),)),)  # fmt: skip
        numbers = Section("", tables=tuple(tables))
        return (
            Section("", tables=(notes,)),
            *followed,
            numbers,
            Section("", pictures=self.pictures()),
        )

    def write(self, folder: Path, *, pictures: str = "png") -> list[str]:
        """Write the reduced recordings, which the page is made of."""
        return self.reduced.write(folder, pictures="")


def _percent(value: float | None) -> str:
    return "" if value is None else f"{value + 0.0:.2g}"
