"""The answer of ``asperity rig plan``."""

from collections.abc import Mapping
from typing import Any, ClassVar

from asperity.arrays import FloatArray
from asperity.results import Result, quantity
from asperity.results.table import Columns, Table, table_of, table_of_rows
from asperity.tribometer.plan.matrix import PlannedFile


class PlanResult(Result):
    """A plan: its files and cells, how long they take, and what they will not tell."""

    title = "plan of a series of tests on a disc-on-disc rig"
    stem = "plan"
    drawings: ClassVar[Mapping[str, str]] = {"plan": "asperity.tribometer.plots:plot_plan"}

    planned: tuple[PlannedFile, ...]
    order: str

    file_count: int = quantity("", "", "files", key="file_count")
    cell_count: int = quantity("", "", "cells, repeats counted")
    distinct_cells: int = quantity("", "", "different cells, repeats not counted")
    settings: int = quantity("", "", "times the rig is rebuilt or given new discs")
    recording_time: float | None = quantity("", "s", "time that is recorded")
    frequency: FloatArray = quantity("f", "Hz", "frequency of the vibration", dims=("cell",))
    steel_supply: FloatArray = quantity(
        "V_ms", "V", "supply of the steel disc's motor", dims=("cell",)
    )
    file_number: Any = quantity("", "", "file of a cell", dims=("cell",))
    mode: Any = quantity("", "", "direction of the vibration", dims=("cell",))
    lubricant: Any = quantity("", "", "lubricant", dims=("cell",))
    waveform: Any = quantity("", "", "waveform", dims=("cell",))
    repeat: Any = quantity("", "", "repeat", dims=("cell",))
    velocity_ratio: FloatArray | None = quantity(
        "k_v", "", "v_a over the sliding velocity before, by the simulated rig", dims=("cell",)
    )
    steel_turns: FloatArray | None = quantity(
        "", "", "turns of the steel disc in the window before", dims=("cell",)
    )
    bronze_turns: FloatArray | None = quantity(
        "", "", "turns of the bronze disc in the window before", dims=("cell",)
    )

    def to_json(self) -> dict[str, Any]:
        """Return the plan with its files, each with its cells in their order."""
        files = [
            {
                "file": one.name,
                "mode": one.mode,
                "lubricant": one.lubricant,
                "waveform": one.waveform,
                "steel_supply_V": one.steel_supply,
                "repeat": one.repeat,
                "cells": [cell.number for cell in one.cells],
                "frequencies_Hz": [cell.frequency for cell in one.cells],
            }
            for one in self.planned
        ]
        return super().to_json() | {"order": self.order, "files": files}

    def tables(self) -> tuple[Table, ...]:
        """Return the plan in numbers and the files in their order."""
        columns: Columns = {
            "file": "name", "mode": "mode", "waveform": "waveform", "lubricant": "lubricant",
            "V_ms V": lambda one: f"{one.steel_supply:g}", "repeat": lambda one: str(one.repeat),
            "frequencies Hz": lambda one: " ".join(f"{cell.frequency:g}" for cell in one.cells),
        }  # fmt: skip
        listed = table_of_rows(self.planned, columns, title=f"Files, in {self.order} order")
        return table_of(self, remarks=self.notes), listed
