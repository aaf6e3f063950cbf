"""What becomes of a loaded wheel as it wears."""

from collections.abc import Mapping
from typing import ClassVar

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.drive.driven import OfDrive
from asperity.drive.static.notes import read_with_care
from asperity.results import labelled, quantity
from asperity.results.table import Table

_STEP, _NODE = ("step",), ("node",)
_PLOTS = "asperity.drive.wear.plots"
_MEGA, _MICRO = 1e6, 1e6
_ROWS = 8  # of a table


class WheelWorn(OfDrive):
    """A wheel's flank worn step by step under its load; the worm does not wear."""

    title: ClassVar[str] = "Bedding-in and wear of a loaded worm wheel"
    stem: ClassVar[str] = "wear"
    drawings: ClassVar[Mapping[str, str]] = {
        "wear": f"{_PLOTS}:over_life",
        "wear_flank": f"{_PLOTS}:flank",
    }
    captions: ClassVar[Mapping[str, str]] = {
        "wear": "Pressure, error, efficiency and depth over the turns of the wheel.",
        "wear_flank": "What is worn off, and where the flank bears, new and worn.",
    }

    coefficient: float = quantity(
        "k", "m2/N", "volume worn by normal force and way slid", key="coefficient_m2_N"
    )
    coefficient_source: str = quantity("", "", "where the coefficient is from")
    revolutions: float = quantity("", "", "turns of the wheel")
    time: float = quantity("t", "h", "time at the worm's speed")
    depth_max: float = quantity("h", "um", "largest depth worn off the flank")
    depth_mean: float = quantity("", "um", "volume over the area of the flank")
    depth_standard: float | None = quantity(
        "delta_Wn", "um", "depth by ISO/TR 14521 after as many turns", default=None
    )
    volume: float = quantity("V", "mm3", "worn off a tooth")
    friction_work: float = quantity("W", "J", "work of friction on a tooth meanwhile")
    pressure_mean_new: float = quantity(
        "p_m", "MPa", "normal force over the area that bears, new", key="pressure_mean_new_MPa"
    )
    pressure_mean: float = quantity("p_m", "MPa", "the same, worn", key="pressure_mean_MPa")
    flow_pressure: float | None = quantity(
        "H", "MPa", "limit: pressure at which the wheel flows, its hardness",
        key="flow_pressure_MPa", default=None,
    )  # fmt: skip
    transmission_error_new: float = quantity(
        "", "rad", "transmission error under load, peak to peak, new"
    )
    transmission_error: float = quantity("", "rad", "the same, worn")
    efficiency_new: float = quantity("eta", "", "efficiency of the mesh, new")
    efficiency: float = quantity("eta", "", "the same, worn")

    turns: FloatArray = quantity(
        "", "", "turns of the wheel", dims=_STEP, coordinate=True, variable="step"
    )
    depth_course: FloatArray = quantity("h", "m", "largest depth", dims=_STEP)
    mean_course: FloatArray = quantity("", "m", "mean depth", dims=_STEP)
    pressure_course: FloatArray = quantity("p_m", "Pa", "mean pressure", dims=_STEP)
    peak_course: FloatArray = quantity("p", "Pa", "largest pressure on the flank", dims=_STEP)
    error_course: FloatArray = quantity("", "rad", "transmission error, peak to peak", dims=_STEP)
    torque_course: FloatArray = quantity("T_B", "N m", "torque of the worm", dims=_STEP)
    deflection_course: FloatArray = quantity("", "rad", "turn of the wheel under load", dims=_STEP)
    area_course: FloatArray = quantity("", "m2", "area that bears, mean of a pitch", dims=_STEP)
    depth: FloatArray = quantity("h", "m", "depth worn off at points of the flank", dims=_NODE)
    pattern_new: FloatArray = quantity(
        "p", "Pa", "largest pressure over a pitch at the points, new", dims=_NODE
    )
    pattern: FloatArray = quantity("p", "Pa", "the same, worn", dims=_NODE)
    node_radius: FloatArray = quantity(
        "r", "m", "distance of the points from the wheel's axis", dims=_NODE
    )
    node_face: FloatArray = quantity(
        "z", "m", "place of the points along the wheel's axis", dims=_NODE
    )
    faces: IntArray = quantity("", "", "points of the faces", dims=("face", "corner"), only="file")

    @property
    @labelled("", "", "mean pressure, worn over new")
    def pressure_left(self) -> float:
        """Of the mean pressure of the new wheel, what is left."""
        return self.pressure_mean / self.pressure_mean_new

    def heading(self) -> str:
        """Return what was solved."""
        drive = self.problem.drive
        return (
            f"{len(self.turns) - 1} steps, {drive.phases} phases each, {drive.teeth} teeth on the "
            f"rim ({drive.density})"
        )

    def headline(self) -> tuple[str, ...]:
        """Return what wear does, in a sentence."""
        return (
            f"after {self.revolutions:.4g} turns of the wheel ({self.time:.3g} h) the flank is "
            f"worn by {self.depth_max:.3g} um at most: its mean pressure has gone from "
            f"{self.pressure_mean_new:.4g} to {self.pressure_mean:.4g} MPa, the transmission "
            f"error from {_MICRO * self.transmission_error_new:.3g} to "
            f"{_MICRO * self.transmission_error:.3g} urad",
            *read_with_care(self.problem),
        )

    def tables(self) -> tuple[Table, ...]:
        """Return the scalars, and some of the steps."""
        whole, *others = super().tables()
        some = np.unique(np.linspace(0, len(self.turns) - 1, _ROWS).astype(int))
        rows = [
            (
                f"{self.turns[n]:.4g}", f"{_MICRO * self.depth_course[n]:.2f}",
                f"{self.pressure_course[n] / _MEGA:.0f}", f"{self.peak_course[n] / _MEGA:.0f}",
                f"{_MICRO * self.error_course[n]:.1f}", f"{self.torque_course[n]:.3f}",
            )
            for n in some
        ]  # fmt: skip
        heads = (
            "turns", "depth (um)", "mean (MPa)", "peak (MPa)", "error (urad)", "torque (N m)"
        )  # fmt: skip
        return (whole, *others, Table.of(heads, rows, left=0, title="As it wears"))
