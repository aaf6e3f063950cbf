"""What a loaded gearset comes to wherever its mounting may bring it."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Self

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray, IntArray
from asperity.drive.driven import OfDrive
from asperity.drive.problem import DriveProblem
from asperity.drive.static.loaded import Loaded
from asperity.drive.static.notes import read_with_care
from asperity.drive.static.spread import told_k_h_beta
from asperity.drive.studies.points import points_for_json, table_of_points
from asperity.results import quantity
from asperity.results.table import Table
from asperity.sweep.axis import Axis

_POINT = ("point",)
_PLOTS = "asperity.drive.studies.misalign_plots"
_MEGA, _MILLI, _MICRO = 1e-6, 1e3, 1e6
_BEARS = 1.0  # N, from which on an edge counts


class Misaligned(OfDrive):
    """A loaded gearset at points of its mounting; the first is the case as it is.

    What a point has no answer for is NaN.

    Attributes
    ----------
    problem : DriveProblem
        The case as it is.
    axes : tuple of Axis
        What is varied.
    """

    title: ClassVar[str] = "Misalignment of a loaded worm gearset"
    stem: ClassVar[str] = "misalign"
    drawings: ClassVar[Mapping[str, str]] = {
        "misalign": f"{_PLOTS}:over_axes",
        "misalign_patterns": f"{_PLOTS}:patterns",
    }
    captions: ClassVar[Mapping[str, str]] = {
        "misalign": "Pressure, edges, error and line load over what the mounting is off by.",
        "misalign_patterns": "Where a flank bears as the case is, at the ends, and at the worst.",
    }

    axes: tuple[Axis, ...]

    name: npt.NDArray[np.str_] = quantity(
        "", "", "what is off", dims=_POINT, coordinate=True, variable="point"
    )
    axis: npt.NDArray[np.str_] = quantity("", "", "what is varied", dims=("axis",), coordinate=True)
    axis_unit: npt.NDArray[np.str_] = quantity("", "", "unit of its values", dims=("axis",))
    value: FloatArray = quantity(
        "", "", "value of each axis, in its own unit", dims=("point", "axis")
    )
    pressure_flank: FloatArray = quantity("p", "Pa", "largest pressure on the flank", dims=_POINT)
    pressure_edge: FloatArray = quantity("p", "Pa", "largest pressure at an edge", dims=_POINT)
    flow_pressure: float | None = quantity(
        "H", "MPa", "limit: pressure at which the wheel flows, its hardness",
        key="flow_pressure_MPa", default=None,
    )  # fmt: skip
    force_worm_tip: FloatArray = quantity(
        "N", "N", "largest force at the worm's tip edge", dims=_POINT
    )
    force_wheel_tip: FloatArray = quantity(
        "N", "N", "largest force at the wheel's tip edge", dims=_POINT
    )
    force_face_end: FloatArray = quantity(
        "N", "N", "largest force at the ends of the face", dims=_POINT
    )
    flow_depth: FloatArray = quantity("", "m", "depth pressed in plastically", dims=_POINT)
    transmission_error: FloatArray = quantity(
        "", "rad", "transmission error under load, peak to peak", dims=_POINT
    )
    deflection: FloatArray = quantity("", "rad", "turn of the wheel under load", dims=_POINT)
    input_torque: FloatArray = quantity("T_B", "N m", "torque of the worm, mean", dims=_POINT)
    load_share: FloatArray = quantity("", "", "largest share of a tooth", dims=_POINT)
    k_h_beta: FloatArray = quantity(
        "K_Hbeta", "", "force by width of the face, largest over mean, of a pitch", dims=_POINT
    )
    k_h_alpha: FloatArray = quantity(
        "K_Halpha", "", "largest force of a tooth over that of an even share", dims=_POINT
    )
    line_load: FloatArray = quantity(
        "w", "N/m", "largest force by length along a contact", dims=_POINT
    )
    shift_face: FloatArray = quantity(
        "", "m", "shift of the pattern's middle along the wheel's axis", dims=_POINT
    )
    shift_radial: FloatArray = quantity(
        "", "m", "shift of the pattern's middle outwards", dims=_POINT
    )
    pattern: FloatArray = quantity(
        "p", "Pa", "largest resolved pressure over a pitch at points of the flank",
        dims=("point", "node"),
    )  # fmt: skip
    node_radius: FloatArray = quantity(
        "r", "m", "distance of the points from the wheel's axis", dims=("node",)
    )
    node_face: FloatArray = quantity(
        "z", "m", "place of the points along the wheel's axis", dims=("node",)
    )
    faces: IntArray = quantity("", "", "points of the faces", dims=("face", "corner"), only="file")

    @classmethod
    def of(
        cls,
        problem: DriveProblem,
        axes: tuple[Axis, ...],
        values: Sequence[Sequence[float]],
        names: Sequence[str],
        found: Sequence[Loaded | str],
        flank: tuple[FloatArray, FloatArray, IntArray],
        notes: tuple[str, ...],
    ) -> Self:
        """Return it of the points' answers, or reasons, and of the points of the flank.

        ``values`` are those of the axes at each, in their units; NaN where it is off another way.
        """
        radius, face, faces = flank
        first = found[0]
        assert isinstance(first, Loaded)

        def column(name: str) -> FloatArray:
            return np.array(
                [np.nan if isinstance(each, str) else getattr(each, name) for each in found]
            )

        nothing = np.full(len(radius), np.nan)
        return cls(
            problem=problem,
            axes=axes,
            name=np.array(names),
            axis=np.array([axis.path for axis in axes]),
            axis_unit=np.array([axis.unit or "1" for axis in axes]),
            value=np.array(values, np.float64),
            flow_pressure=None if (flow := problem.flow_pressure) is None else _MEGA * flow,
            pressure_edge=np.max(
                [column(f"pressure_{edge}") for edge in ("worm_tip", "wheel_tip", "face_end")], 0
            ),
            shift_face=column("centre_face") - first.centre_face,
            shift_radial=column("centre_radial") - first.centre_radial,
            pattern=np.array(
                [nothing if isinstance(each, str) else each.pattern for each in found]
            ),
            node_radius=radius,
            node_face=face,
            faces=faces,
            notes=notes,
            **{
                name: column(name)
                for name in (
                    "pressure_flank", "force_worm_tip", "force_wheel_tip", "force_face_end",
                    "flow_depth", "transmission_error", "deflection", "input_torque", "load_share",
                    "k_h_beta", "k_h_alpha", "line_load",
                )
            },
        )  # fmt: skip

    @property
    def edge_force(self) -> FloatArray:
        """Largest force on any edge at each point, N."""
        edges = self.force_worm_tip, self.force_wheel_tip, self.force_face_end
        return np.asarray(np.max(edges, axis=0))

    @property
    def rows(self) -> list[dict[str, Any]]:
        """One mapping a point."""
        columns = {
            "pressure_flank_MPa": _MEGA * self.pressure_flank,
            "pressure_edge_MPa": _MEGA * self.pressure_edge,
            "force_worm_tip_N": self.force_worm_tip,
            "force_wheel_tip_N": self.force_wheel_tip,
            "force_face_end_N": self.force_face_end,
            "force_edge_N": self.edge_force,
            "flow_depth_um": _MICRO * self.flow_depth,
            "transmission_error_rad": self.transmission_error,
            "deflection_rad": self.deflection,
            "input_torque_Nm": self.input_torque,
            "load_share_max": self.load_share,
            "k_h_beta": self.k_h_beta,
            "k_h_alpha": self.k_h_alpha,
            "line_load_N_mm": self.line_load / _MILLI,
            "shift_face_mm": _MILLI * self.shift_face,
            "shift_radial_mm": _MILLI * self.shift_radial,
        }
        return points_for_json(self.axes, self.name, self.value, columns)

    def to_json(self) -> dict[str, Any]:
        """Return every point with its numbers."""
        return super().to_json() | {"points": self.rows}

    def heading(self) -> str:
        """Return what was solved."""
        drive = self.problem.drive
        return (
            f"{len(self.name) - 1} points, {drive.phases} phases each, {drive.teeth} teeth on the "
            f"rim ({drive.density})"
        )

    def headline(self) -> tuple[str, ...]:
        """Return what being off does, in sentences."""
        edge, error = self.edge_force, _MICRO * self.transmission_error
        bearing = int((edge[1:] > _BEARS).sum())
        worst, uneven = int(np.nanargmax(edge)), int(np.nanargmax(error))
        along, out = (
            _MILLI * np.nanmax(np.abs(shift)) for shift in (self.shift_face, self.shift_radial)
        )
        said = [
            f"an edge bears at {bearing} of {len(edge) - 1} points"
            + (f", at most {edge[worst]:.4g} N ({self.name[worst]})" if bearing else "")
            + (f"; as the case is {edge[0]:.4g} N" if edge[0] > _BEARS else ""),
            f"the transmission error is {np.nanmin(error):.3g} to {error[uneven]:.3g} urad, "
            f"{error[0]:.3g} as the case is; K_Hbeta {np.nanmin(self.k_h_beta):.3g} to "
            f"{told_k_h_beta(float(np.nanmax(self.k_h_beta)))}",
            f"the pattern's middle shifts by at most {along:.3g} mm along the face and "
            f"{out:.3g} mm outwards or inwards",
            *read_with_care(self.problem),
        ]
        return tuple(said)

    def tables(self) -> tuple[Table, ...]:
        """Return a row a point."""
        columns = {
            "flank (MPa)": ("pressure_flank_MPa", ".0f", 1.0),
            "edge (N)": ("force_edge_N", ".0f", 1.0),
            "error (urad)": ("transmission_error_rad", ".1f", _MICRO),
            "K_Hbeta": ("k_h_beta", ".2f", 1.0),
            "K_Halpha": ("k_h_alpha", ".2f", 1.0),
            "share": ("load_share_max", ".2f", 1.0),
            "face (mm)": ("shift_face_mm", ".3f", 1.0),
            "radial (mm)": ("shift_radial_mm", ".3f", 1.0),
        }
        flow = self.flow_pressure
        remarks = (
            "the first row is the case as it is; face, radial: shift of the pattern's middle",
            *((f"flank: the wheel flows at {flow:.0f} MPa",) if flow is not None else ()),
            *(f"the second row is the gearset {name}" for name in self.name[1:2] if "warm" in name),
            *self.notes,
        )  # fmt: skip
        return (table_of_points(self, "points", columns, remarks),)
