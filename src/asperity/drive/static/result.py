"""What a loaded worm gearset without vibration is."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray, IntArray
from asperity.drive.driven import OfDrive
from asperity.drive.static.notes import flowing
from asperity.drive.teeth.sector import Sector
from asperity.results import labelled, quantity
from asperity.results.table import Table

_PLOTS = "asperity.drive.static.plots"
_PHASE, _PART = ("phase",), ("part",)
_MICRO = 1e6
_ORDERS = 5  # that a table has
PATTERNS = (1.0 / 9.0, 1.0 / 3.0, 1.0)
"""Torques that patterns are drawn at, over the load."""


class StaticResult(OfDrive):
    """Worm and wheel under load over a pitch, turning slowly.

    Attributes
    ----------
    problem : DriveProblem
        What was solved.
    sector : Sector
        The elastic teeth.
    nodal_force : ndarray
        (t, 3n) Forces on the flanks of the teeth in mesh at the phase of the largest pressure, N.
    """

    title: ClassVar[str] = "Loaded worm gearset"
    stem: ClassVar[str] = "drive"
    drawings: ClassVar[Mapping[str, str]] = {
        "drive": f"{_PLOTS}:over_pitch",
        "drive_pattern": f"{_PLOTS}:pattern",
        "drive_error": f"{_PLOTS}:error",
        "drive_stiffness": f"{_PLOTS}:stiffness",
    }

    captions: ClassVar[Mapping[str, str]] = {
        "drive": "Torque, transmission error and the teeth's shares over a pitch of the worm.",
        "drive_pattern": "Where a flank bears over a pitch, and how hard, at three torques.",
        "drive_error": "The transmission error by its orders, at rising load.",
        "drive_stiffness": "What gives way between motor and wheel.",
    }

    sector: Sector
    nodal_force: FloatArray

    output_torque: float = quantity("T_R", "N m", "torque of the wheel", key="output_torque_Nm")
    friction: float = quantity("mu", "", "coefficient of friction")
    input_torque: float = quantity(
        "T_B", "N m", "torque of the worm, mean over a pitch", key="input_torque_Nm"
    )
    input_torque_frictionless: float = quantity(
        "T_B0", "N m", "torque of the worm without friction", key="input_torque_frictionless_Nm"
    )
    input_torque_reversed: float = quantity(
        "T_C", "N m", "torque of the worm, friction turned round", key="input_torque_reversed_Nm"
    )

    @property
    @labelled("eta", "", "efficiency of the mesh")
    def efficiency(self) -> float:
        """Work of the wheel over that of the worm."""
        return self.input_torque_frictionless_exact / self.input_torque

    @property
    def input_torque_frictionless_exact(self) -> float:
        """Torque of the worm for which no work is lost over a pitch, N m."""
        return self.output_torque / self.problem.geometry.gear_ratio

    @property
    @labelled("", "", "mechanical advantage: torque of the wheel over that of the worm")
    def mechanical_advantage(self) -> float:
        """Torque of the wheel over that of the worm."""
        return self.output_torque / self.input_torque

    friction_radius: float = quantity(
        "r_e", "mm", "radius on the worm of the normal force, mean by force"
    )
    sliding_speed: float = quantity(
        "v_g", "m/s", "sliding speed, mean by force", key="sliding_speed_m_s"
    )
    transmission_error: float = quantity("", "rad", "transmission error under load, peak to peak")
    error_noise_range: float = quantity(
        "", "rad", "of it, what the points of the mesh make by themselves", key="error_noise_rad"
    )
    deflection: float = quantity(
        "", "rad", "turn of the wheel under load against the worm, mean over a pitch"
    )
    stiffness: float = quantity(
        "", "N m/rad", "stiffness at the wheel, tangent", key="stiffness_Nm_per_rad"
    )
    stiffness_secant: float = quantity(
        "", "N m/rad", "stiffness at the wheel, secant", key="stiffness_secant_Nm_per_rad"
    )
    normal_force: float = quantity("N", "N", "normal force of all teeth, mean over a pitch")
    axial_force: float = quantity("F_x", "N", "force on the worm along its axis")
    radial_force: float = quantity("F_r", "N", "force on the worm away from the wheel")
    tangential_force: float = quantity("F_t", "N", "force on the worm along the wheel's axis")
    loaded_teeth_min: int = quantity("", "", "teeth under load, least over a pitch")
    loaded_teeth_max: int = quantity("", "", "teeth under load, most over a pitch")
    load_share_max: float = quantity("", "", "largest share of a tooth in the normal force")
    k_h_beta: float = quantity(
        "K_Hbeta", "", "force by width of the face, largest over mean, of a pitch"
    )
    k_h_alpha: float = quantity(
        "K_Halpha", "", "largest force of a tooth over that of an even share"
    )
    line_load: float = quantity(
        "w", "N/mm", "largest force by length along a contact", key="line_load_N_mm"
    )
    pressure_flank: float = quantity(
        "p", "MPa", "largest pressure on the flank, away from edges", key="pressure_flank_MPa"
    )
    pressure_worm_tip: float = quantity(
        "p", "MPa", "largest pressure at the worm's tip edge", key="pressure_worm_tip_MPa"
    )
    pressure_wheel_tip: float = quantity(
        "p", "MPa", "largest pressure at the wheel's tip edge", key="pressure_wheel_tip_MPa"
    )
    pressure_face_end: float = quantity(
        "p", "MPa", "largest pressure at the ends of the face", key="pressure_face_end_MPa"
    )
    force_worm_tip: float = quantity("N", "N", "normal force at the worm's tip edge, largest")
    force_wheel_tip: float = quantity("N", "N", "normal force at the wheel's tip edge, largest")
    force_face_end: float = quantity("N", "N", "normal force at the ends of the face, largest")
    pressure_mean: float = quantity(
        "p_m", "MPa", "normal force over the area that bears", key="pressure_mean_MPa"
    )
    flow_pressure: float | None = quantity(
        "H", "MPa", "limit: pressure at which the wheel flows, its hardness",
        key="flow_pressure_MPa", default=None,
    )  # fmt: skip
    flow_depth: float | None = quantity(
        "", "um", "depth by which the wheel is pressed in at that pressure", default=None
    )
    contact_length: float = quantity(
        "", "mm", "length of the contact with the largest pressure on the flank"
    )
    contact_width: float = quantity("", "mm", "its width")
    hertz_pressure_max: float | None = quantity(
        "p", "MPa", "Hertzian pressure of contact lines, greatest, as asperity flank has it",
        key="hertz_pressure_max_MPa", default=None,
    )  # fmt: skip
    flash_temperature: float = quantity(
        "theta_fl", "K", "largest flash temperature of a contact, edges included; no limit is "
        "known for worm gears",
    )  # fmt: skip
    flash_temperature_face: float = quantity(
        "z", "mm", "there: place along the wheel's axis, 0 in mid-face"
    )
    flash_temperature_flank: float = quantity(
        "theta_fl", "K", "largest flash temperature on the flank, away from edges"
    )
    pressure_nodal: float = quantity(
        "p", "MPa", "largest pressure at a node of the mesh, which grows with a finer one",
        key="pressure_nodal_MPa", shown=False,
    )  # fmt: skip
    residual: float = quantity("", "", "largest residual of a balance", shown=False)
    teeth_nodes: int = quantity("", "", "contact nodes of a flank", shown=False)
    condense_seconds: float = quantity(
        "", "s", "time of condensing", key="condense_seconds", only="json", shown=False
    )

    worm_angle: FloatArray = quantity(
        "beta", "rad", "angle of the worm", dims=_PHASE, coordinate=True, variable="phase"
    )
    torque: FloatArray = quantity("T_B", "N m", "torque of the worm", dims=_PHASE)
    torque_frictionless: FloatArray = quantity(
        "T_B0", "N m", "torque of the worm without friction", dims=_PHASE
    )
    torque_reversed: FloatArray = quantity(
        "T_C", "N m", "torque of the worm, friction turned round", dims=_PHASE
    )
    error_loaded: FloatArray = quantity(
        "", "rad", "the wheel ahead of the worm under load", dims=_PHASE
    )
    error_unloaded: FloatArray = quantity(
        "", "rad", "the wheel ahead of the worm without load, flanks exact and rigid", dims=_PHASE
    )
    error_torque: FloatArray = quantity(
        "T_R", "N m", "torque of the wheel under which the error has harmonics; 0: rigid flanks",
        dims=("error_load",), coordinate=True, variable="error_load",
    )  # fmt: skip
    error_order: IntArray = quantity(
        "n", "", "order of the error: times in a pitch", dims=("order",), coordinate=True,
        variable="order",
    )  # fmt: skip
    error_amplitude: FloatArray = quantity(
        "a_n", "rad", "amplitude of the transmission error", dims=("error_load", "order")
    )
    error_phase: FloatArray = quantity(
        "psi_n", "rad", "phase of the transmission error, as cos(n theta - psi_n)",
        dims=("error_load", "order"),
    )  # fmt: skip
    error_noise: FloatArray = quantity(
        "", "rad", "amplitude that the points of the mesh make by themselves",
        dims=("error_load", "order"),
    )  # fmt: skip
    error_noise_ranges: FloatArray = quantity(
        "", "rad", "error that the points of the mesh make, peak to peak", dims=("error_load",)
    )
    tooth_force: FloatArray = quantity(
        "N", "N", "normal force on each tooth", dims=(*_PHASE, "tooth")
    )
    pressure_flank_course: FloatArray = quantity(
        "p", "Pa", "largest pressure on the flank", dims=_PHASE
    )
    pressure_worm_tip_course: FloatArray = quantity(
        "p", "Pa", "largest pressure at the worm's tip edge", dims=_PHASE
    )
    pressure_wheel_tip_course: FloatArray = quantity(
        "p", "Pa", "largest pressure at the wheel's tip edge", dims=_PHASE
    )
    pressure_face_end_course: FloatArray = quantity(
        "p", "Pa", "largest pressure at the ends of the face", dims=_PHASE
    )
    force_worm_tip_course: FloatArray = quantity(
        "N", "N", "normal force at the worm's tip edge", dims=_PHASE
    )
    force_wheel_tip_course: FloatArray = quantity(
        "N", "N", "normal force at the wheel's tip edge", dims=_PHASE
    )
    force_face_end_course: FloatArray = quantity(
        "N", "N", "normal force at the ends of the face", dims=_PHASE
    )
    flash_temperature_course: FloatArray = quantity(
        "theta_fl", "K", "largest flash temperature", dims=_PHASE
    )
    flash_line_face: FloatArray = quantity(
        "z", "m", "place along the wheel's axis on the contact with the largest of them",
        dims=("line",),
    )  # fmt: skip
    flash_line: FloatArray = quantity(
        "theta_fl", "K", "flash temperature along that contact", dims=("line",)
    )
    part: npt.NDArray[np.str_] = quantity(
        "", "", "what gives way", dims=_PART, coordinate=True, only="file"
    )
    part_stiffness: FloatArray = quantity(
        "", "N m/rad", "stiffness at the wheel by what gives way", dims=_PART
    )
    pattern_torque: FloatArray = quantity(
        "T_R", "N m", "torque of the wheel", dims=("load",), coordinate=True, variable="load"
    )
    pattern: FloatArray = quantity(
        "p", "Pa", "largest resolved pressure over a pitch at points of the flank",
        dims=("load", "node"),
    )  # fmt: skip
    pattern_back: FloatArray | None = quantity(
        "p", "Pa", "the same on the other flank as the drive runs backwards, at the points turned "
        "half a turn about the tooth",
        dims=("load", "node"), default=None,
    )  # fmt: skip
    node_radius: FloatArray = quantity(
        "r", "m", "distance of the points from the wheel's axis", dims=("node",)
    )
    node_face: FloatArray = quantity(
        "z", "m", "place of the points along the wheel's axis", dims=("node",)
    )
    faces: IntArray = quantity("", "", "points of the faces", dims=("face", "corner"), only="file")

    def to_json(self) -> dict[str, Any]:
        """Return the scalars, and the stiffness by what gives way."""
        parts = zip(self.part.tolist(), self.part_stiffness.tolist(), strict=True)
        return super().to_json() | {
            "stiffness_by_part_Nm_per_rad": dict(parts),
            "error_harmonics": [
                {
                    "output_torque_Nm": torque, "amplitude_rad": amplitude, "phase_rad": phase,
                    "noise_rad": noise,
                }
                for torque, amplitude, phase, noise in zip(
                    self.error_torque.tolist(), self.error_amplitude.tolist(),
                    self.error_phase.tolist(), self.error_noise.tolist(), strict=True,
                )
            ],
        }  # fmt: skip

    def tables(self) -> tuple[Table, ...]:
        """Return the scalars, and the transmission error by its orders."""
        whole, *others = super().tables()
        if not len(self.error_order):
            return (whole, *others)
        loads = [f"{torque:.4g} N m" for torque in self.error_torque]
        ends = self.error_noise[[0, -1]]
        heads = (
            "order", *(f"at {load}" for load in loads),
            *(f"mesh's own at {load}" for load in (loads[0], loads[-1])),
        )  # fmt: skip
        columns = np.round(_MICRO * np.vstack([self.error_amplitude, ends]), 4)
        rows = [(int(n), *column) for n, column in zip(self.error_order, columns.T, strict=True)]
        said = "Amplitudes of the transmission error by order in a pitch (urad)"
        return (whole, *others, Table.of(heads, rows[:_ORDERS], title=said))

    def heading(self) -> str:
        """Return what was solved."""
        drive = self.problem.drive
        return (
            f"{self.teeth_nodes} nodes a flank ({drive.density}), {drive.teeth} teeth on the rim, "
            f"{drive.phases} phases"
        )

    def headline(self) -> tuple[str, ...]:
        """Return that the flank flows in large parts, where it does."""
        return flowing(self.pressure_mean, self.flow_pressure)

    def write(self, folder: Path, *, pictures: str = "png") -> list[str]:
        """Write JSON, netCDF and pictures, and the loaded teeth for ParaView."""
        from asperity.drive.static.view import write_teeth

        names = super().write(folder, pictures=pictures)
        path = folder / "drive_teeth.vtu"
        write_teeth(self.problem, self.sector, self.nodal_force, self.pattern[-1], path)
        return [*names, "drive_teeth.vtu"]
