"""Which relief takes the load off the edges of a loaded gearset."""

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.drive.driven import OfDrive
from asperity.drive.problem import DriveProblem
from asperity.drive.static.notes import read_with_care
from asperity.drive.static.spread import told_k_h_beta
from asperity.drive.studies.points import points_for_json, table_of_points
from asperity.drive.warmed import warmth
from asperity.results import quantity
from asperity.results.table import Table
from asperity.sweep.axis import Axis

_DESIGN = ("design",)
_MEGA, _MICRO = 1e-6, 1e6
_ROOT = "modification.root_relief"
_SAME = 1e-3  # of a pressure, within which it is the same one
_BEARS = 1.0  # N, from which on an edge is said to bear


NONE = (np.inf,) * 4
"""Merit of a design without an answer."""


@dataclasses.dataclass(frozen=True)
class Design:
    """A design at the worst of its loads and mountings, in SI."""

    name: str
    values: tuple[float, ...]  #: Of the axes, in their units
    edge_force: float = np.nan  #: Of all edges together
    edge_share: float = np.nan  #: Of the normal force
    worm_tip: float = np.nan
    wheel_tip: float = np.nan
    face_end: float = np.nan
    flank: float = np.nan
    peak: float = np.nan
    error: float = np.nan
    k_h_beta: float = np.nan
    worst: str = ""  #: Where the edges bear most
    failed: str = ""  #: Why there is no answer
    counts: bool = False  #: Whether its edges bear so much that it counts
    merit: tuple[float, ...] = NONE  #: The less, the better, the first before the next

    @property
    def on_wheel_tip(self) -> bool:
        """Whether edges bear, and of all the wheel's tip the most."""
        return self.counts and self.wheel_tip > max(self.worm_tip, self.face_end)


def _of_wheel_tip(best: Design, axes: Sequence[Axis]) -> tuple[str, ...]:
    """Return what takes load off the wheel's tip edge, where that bears most and it was left out.

    Its values are for ``--over``.
    """
    if not best.on_wheel_tip or any(axis.path == _ROOT for axis in axes):
        return ()
    return (
        f"the wheel's own tip edge bears the most then, {best.wheel_tip:.4g} N, which the worm's "
        f"root meets: look with --over {_ROOT} as well",
    )


class Relieved(OfDrive):
    """Designs that were tried, the case as it is first, each at the worst it stands."""

    title: ClassVar[str] = "Relief of a loaded worm gearset"
    stem: ClassVar[str] = "relief"
    drawings: ClassVar[Mapping[str, str]] = {
        "relief": "asperity.drive.studies.relief_plots:designs"
    }
    captions: ClassVar[Mapping[str, str]] = {
        "relief": "Forces on the edges, pressure and error of the designs that were tried."
    }

    axes: tuple[Axis, ...]
    stands: tuple[str, ...]
    failed: tuple[str, ...]

    best: str = quantity("", "", "best design")
    tried: int = quantity("", "", "designs that were tried")
    edge_force_before: float = quantity("N", "N", "force on all edges, as the case is")
    edge_force_after: float = quantity("N", "N", "force on all edges, best design")
    peak_before: float = quantity(
        "p", "MPa", "largest pressure, as the case is", key="peak_before_MPa"
    )
    peak_after: float = quantity("p", "MPa", "largest pressure, best design", key="peak_after_MPa")
    error_before: float = quantity("", "rad", "transmission error, as the case is")
    error_after: float = quantity("", "rad", "transmission error, best design")

    name: npt.NDArray[np.str_] = quantity(
        "", "", "design", dims=_DESIGN, coordinate=True, variable="design"
    )
    axis: npt.NDArray[np.str_] = quantity("", "", "what is varied", dims=("axis",), coordinate=True)
    value: FloatArray = quantity(
        "", "", "value of each axis, in its own unit", dims=("design", "axis")
    )
    is_best: npt.NDArray[np.int8] = quantity("", "", "1: the best", dims=_DESIGN)
    edge_force: FloatArray = quantity("N", "N", "force on all edges", dims=_DESIGN)
    edge_share: FloatArray = quantity("", "", "the same over the normal force", dims=_DESIGN)
    worm_tip: FloatArray = quantity("N", "N", "force on the worm's tip edge", dims=_DESIGN)
    wheel_tip: FloatArray = quantity("N", "N", "force on the wheel's tip edge", dims=_DESIGN)
    face_end: FloatArray = quantity("N", "N", "force on the ends of the face", dims=_DESIGN)
    flank: FloatArray = quantity("p", "Pa", "largest pressure on the flank", dims=_DESIGN)
    peak: FloatArray = quantity("p", "Pa", "largest pressure, edges included", dims=_DESIGN)
    error: FloatArray = quantity("", "rad", "transmission error, peak to peak", dims=_DESIGN)
    k_h_beta: FloatArray = quantity(
        "K_Hbeta", "", "force by width of the face, largest over mean", dims=_DESIGN
    )

    @classmethod
    def of(
        cls,
        problem: DriveProblem,
        axes: tuple[Axis, ...],
        stands: tuple[str, ...],
        designs: Sequence[Design],
        best: int,
    ) -> Self:
        """Return it of the designs, of which the first is the case as it is."""
        first, last = designs[0], designs[best]
        return cls(
            problem=problem,
            axes=axes,
            stands=stands,
            failed=tuple(f"{each.name}: {each.failed}" for each in designs if each.failed),
            best=last.name,
            tried=len(designs),
            is_best=np.array([n == best for n in range(len(designs))], np.int8),
            edge_force_before=first.edge_force,
            edge_force_after=last.edge_force,
            peak_before=_MEGA * first.peak,
            peak_after=_MEGA * last.peak,
            error_before=first.error,
            error_after=last.error,
            name=np.array([each.name for each in designs]),
            axis=np.array([axis.path for axis in axes]),
            value=np.array([each.values for each in designs]),
            notes=(
                "each design at the worst of: " + "; ".join(stands),
                *(f"{each.name}: {each.failed}" for each in designs if each.failed),
                *_of_wheel_tip(last, axes), *warmth(problem),
            ),
            **{
                key: np.array([getattr(each, key) for each in designs])
                for key in (
                    "edge_force", "edge_share", "worm_tip", "wheel_tip", "face_end", "flank",
                    "peak", "error", "k_h_beta",
                )
            },
        )  # fmt: skip

    @property
    def best_number(self) -> int:
        """Number of the best design, the case as it is being 0."""
        return int(np.argmax(self.is_best))

    def heading(self) -> str:
        """Return what was solved."""
        drive = self.problem.drive
        return (
            f"{self.tried} designs at {len(self.stands)} loads and mountings, {drive.phases} "
            "phases each"
        )

    def headline(self) -> tuple[str, ...]:
        """Return what relief does, in one sentence."""
        n = self.best_number
        if not n:
            none = "no design that was tried is better than the case as it is"
            return none, *read_with_care(self.problem)
        gone = [edge for edge, forces in self._edges() if forces[0] > _BEARS >= forces[n]]
        does = f"takes {' and '.join(gone)} away" if gone else "takes load off the edges"
        return (
            f"{self.best} {does}: the force on edges goes from {self.edge_force_before:.4g} to "
            f"{self.edge_force_after:.4g} N, {self._pressure()}, the transmission error from "
            f"{_MICRO * self.error_before:.3g} to {_MICRO * self.error_after:.3g} urad, K_Hbeta "
            f"from {told_k_h_beta(self.k_h_beta[0])} to {told_k_h_beta(self.k_h_beta[n])}",
            *read_with_care(self.problem),
        )

    def _edges(self) -> tuple[tuple[str, FloatArray], ...]:
        """Edges in words, with the force on each by design, N."""
        return (
            ("the worm's tip edge", self.worm_tip), ("the wheel's tip edge", self.wheel_tip),
            ("the ends of the face", self.face_end),
        )  # fmt: skip

    def _pressure(self) -> str:
        """What becomes of the largest pressure, in words; where it stays, where it is."""
        before, after = self.peak_before, self.peak_after
        if not math.isclose(before, after, rel_tol=_SAME):
            return f"the largest pressure from {before:.4g} to {after:.4g} MPa"
        flow = self.problem.flow_pressure
        if flow is None or not math.isclose(after, _MEGA * flow, rel_tol=_SAME):
            return f"the largest pressure stays at {after:.4g} MPa"
        n = self.best_number
        left = [edge for edge, forces in self._edges() if forces[n] > _BEARS]
        on_edges = left and self.flank[n] < (1.0 - _SAME) * self.peak[n]
        where = f" at what still bears, {' and '.join(left)}" if on_edges else ""
        return f"the largest pressure stays at {after:.4g} MPa, at which the wheel flows{where}"

    @property
    def rows(self) -> list[dict[str, Any]]:
        """One mapping a design."""
        columns = {
            "edge_force_N": self.edge_force,
            "edge_share": self.edge_share,
            "force_worm_tip_N": self.worm_tip,
            "force_wheel_tip_N": self.wheel_tip,
            "force_face_end_N": self.face_end,
            "pressure_flank_MPa": _MEGA * self.flank,
            "pressure_peak_MPa": _MEGA * self.peak,
            "transmission_error_rad": self.error,
            "k_h_beta": self.k_h_beta,
        }
        return points_for_json(self.axes, self.name, self.value, columns)

    def to_json(self) -> dict[str, Any]:
        """Return every design with its numbers."""
        return super().to_json() | {"stands": list(self.stands), "designs": self.rows}

    def tables(self) -> tuple[Table, ...]:
        """Return a row a design, the best marked."""
        columns = {
            "edges (N)": ("edge_force_N", ".0f", 1.0),
            "worm tip": ("force_worm_tip_N", ".0f", 1.0),
            "wheel tip": ("force_wheel_tip_N", ".0f", 1.0),
            "face ends": ("force_face_end_N", ".0f", 1.0),
            "flank (MPa)": ("pressure_flank_MPa", ".0f", 1.0),
            "peak (MPa)": ("pressure_peak_MPa", ".0f", 1.0),
            "error (urad)": ("transmission_error_rad", ".1f", _MICRO),
            "K_Hbeta": ("k_h_beta", ".2f", 1.0),
        }
        best = tuple("best" if n == self.best_number else "" for n in range(len(self.rows)))
        remarks = ("the first row is the case as it is", *self.notes)
        return (table_of_points(self, "designs", columns, remarks, best),)
