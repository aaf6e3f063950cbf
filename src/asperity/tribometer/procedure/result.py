"""The answer of ``asperity rig run``."""

from collections.abc import Mapping
from typing import Any, ClassVar

from asperity.arrays import FloatArray
from asperity.errors import AsperityError
from asperity.results import Result, quantity
from asperity.results.table import Table, table_of
from asperity.tribometer.twin.provenance import figure_standing


class RunResult(Result):
    """What a run has recorded: its cells, at a glance, and what ended it."""

    title = "run of a plan on a disc-on-disc rig"
    stem = "run"
    drawings: ClassVar[Mapping[str, str]] = {"run": "asperity.tribometer.plots:plot_run"}
    # Its recordings have one, which `asperity rig report` puts into the same folder.
    reported = False

    lines: tuple[Mapping[str, Any], ...]
    latch: AsperityError | None = None

    backend: str = quantity("", "", "instruments", key="backend", shown=False)
    cells_planned: int = quantity("", "", "cells of the plan")
    cells_done: int = quantity("", "", "cells recorded")
    recordings: int = quantity("", "", "files recorded")
    starts: int = quantity("", "", "times the run was started or gone on with")
    cell: Any = quantity("", "", "number of a cell in the plan", dims=("done",))
    frequency: FloatArray = quantity("f", "Hz", "frequency of the vibration", dims=("done",))
    torque_before: FloatArray = quantity(
        "T_s", "N m", "torque of the steel disc without vibration", dims=("done",)
    )
    torque_with: FloatArray = quantity(
        "T_s", "N m", "torque of the steel disc with vibration", dims=("done",)
    )
    torque_change: FloatArray = quantity(
        "", "%", "change of the torque at a glance", dims=("done",)
    )

    def to_json(self) -> dict[str, Any]:
        """Return the run with its cells, each with where it is recorded and its mean signals."""
        kept = (
            "cell", "file", "recording", "mode", "waveform", "frequency_Hz", "before",
            "shaken", "crc32", "level_before", "level_with",
        )  # fmt: skip
        cells = [{key: line[key] for key in kept} for line in self.lines]
        if self.backend == "sim":
            for one in cells:
                asked = one["mode"], one["waveform"], one["frequency_Hz"]
                one["rests_on"] = figure_standing(*asked)
        latched = None if self.latch is None else str(self.latch)
        return super().to_json() | {"cells": cells, "latched": latched}

    @property
    def failure(self) -> AsperityError | None:
        """What latched."""
        return self.latch

    def tables(self) -> tuple[Table, ...]:
        """Return the run in numbers and its cells at a glance."""
        rows = [
            (line["cell"], line["recording"], line["frequency_Hz"], before, after, change)
            for line, before, after, change in zip(
                self.lines,
                map(float, self.torque_before),
                map(float, self.torque_with),
                map(float, self.torque_change),
                strict=True,
            )
        ]
        headings = "cell", "recording", "f Hz", "T_s before N m", "T_s with N m", "change %"
        title = "Cells at a glance; rig reduce gives them with their intervals"
        listed = Table.of(headings, rows, title=title, left=2)
        return table_of(self, remarks=self.notes), *((listed,) if rows else ())
