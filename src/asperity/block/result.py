"""What a solved block is: the answer of a sliding body, and what only a contact has."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar

from asperity.arrays import FloatArray, IntArray
from asperity.block.problem import BlockProblem
from asperity.block.series import Frame, packed_series, write_block_series
from asperity.contact.motion.ledger import ContactLedger
from asperity.results import Result, labelled, part, quantity
from asperity.results.dataset import Labels
from asperity.slider.history import History
from asperity.slider.result import SlideResult, table_inputs
from asperity.slider.result import inputs as slider_inputs


class BlockResult(SlideResult):
    """The answer for one elastic block: that of a sliding body, and what only a contact has.

    Attributes
    ----------
    problem : BlockProblem
        What was asked.
    march_seconds : float
        That the increments of the march took, s.
    timed : int
        Increments that took them.
    point_pressure : ndarray, shape (q,)
        Mean in the window at the integration points of the contact, Pa.
    frames : tuple of Frame
        Of the last cycles, for the VTU files.
    """

    title: ClassVar[str] = "Elastic block"
    stem: ClassVar[str] = "block"
    drawings: ClassVar[Mapping[str, str]] = {
        "block": "asperity.slider.plots:plot_slide",
        "block_pressure": "asperity.block.plots:plot_pressure",
    }

    problem: BlockProblem
    ledger: ContactLedger | None = part(ContactLedger, "power_")
    normal_force: float = quantity("F_N", "N", "mean normal force")

    @property
    @labelled("p", "MPa", "contact pressure, mean", only="json")
    def pressure_mean(self) -> float:
        """Mean normal force in the window over the nominal area, MPa."""
        return 1e-6 * self.mean_pressure

    @property
    @labelled("p_max", "MPa", "contact pressure, greatest at an integration point", only="json")
    def pressure_max(self) -> float:
        """Greatest pressure at any point and time in the window, MPa."""
        return 1e-6 * self.peak_pressure

    #: Of increments in the window.
    iterations_mean: float = quantity("", "", "mean iterations of an increment")
    iterations_max: int = quantity("", "", "iterations of an increment, most")
    cuts: int = quantity(
        "", "", "increments taken again in halves", key="increments_cut",
        variable="increments_cut", shown=False,
    )  # fmt: skip
    #: Increments, or parts of those taken in halves, where the arithmetic has no more digits.
    unconverged: int = quantity("", "", "increments above the tolerance", shown=False)
    residual_increment_max: float = quantity("", "", "residual of an increment, greatest")
    #: Time that increments took, s, without the first of a program (which may have compiled
    #: kernels), and without what was done between them; and how many those are.
    march_seconds: float
    timed: int

    @property
    @labelled("", "ms", "time of an increment", key="ms_per_increment", only="json")
    def increment_time(self) -> float:
        """Mean time of an increment, ms."""
        return 1e3 * self.march_seconds / max(self.timed, 1)

    point_pressure: FloatArray  #: Mean in the window at the points of the contact, Pa, (q,)
    peak_pressure: float = quantity(
        "p_max", "Pa", "greatest pressure in the window", only="file", shown=False
    )
    #: For an animation: of the last two cycles, or of the whole run without vibration.
    frames: tuple[Frame, ...] = ()

    @property
    @labelled("", "", "increments", only="json", shown=False)
    def increments(self) -> int:
        """Increments that were solved, parts of those taken in halves counted once."""
        return self.steps

    @property
    def mean_pressure(self) -> float:
        """Mean normal force in the window over the nominal area, Pa."""
        return self.normal_force / self.problem.surface.area

    @property
    @labelled(
        "", "Pa/m", "slope of the normal law at the mean pressure",
        key="normal_stiffness_at_mean_pressure_Pa_per_m", only="json", shown=False,
    )  # fmt: skip
    def normal_stiffness_at_mean_pressure(self) -> float | None:
        """Slope of the normal law at the mean pressure, Pa/m; None of hard contact."""
        normal = self.problem.normal
        return None if normal.name == "hard" else normal.slope_at(self.mean_pressure)

    @property
    @labelled("p", "Pa", "mean contact pressure in the window", variable="pressure", dims=("node",))
    def nodal_pressure(self) -> FloatArray:
        """Mean pressure in the window at the contact nodes, Pa, shape (n,)."""
        surface = self.problem.surface
        return surface.to_nodes(self.point_pressure.reshape(surface.weights.shape))

    @property
    @labelled(
        "x", "m", "position of the contact nodes along the drive",
        dims=("node",), coordinate=True,
    )  # fmt: skip
    def node_x(self) -> FloatArray:
        """Position of the contact nodes along the drive, m, shape (n,)."""
        return self.problem.body.positions[:, 0]

    @property
    @labelled("y", "m", "position of the contact nodes across it", dims=("node",), coordinate=True)
    def node_y(self) -> FloatArray:
        """Position of the contact nodes across the drive, m, shape (n,)."""
        return self.problem.body.positions[:, 1]

    @property
    @labelled("", "", "nodes of the faces of the contact", dims=("face", "corner"), only="file")
    def faces(self) -> IntArray:
        """Nodes of the faces of the contact."""
        return self.problem.surface.faces

    @property
    @labelled("beta", "", "Newmark's beta", shown=False, swept=False)
    def newmark_beta(self) -> float:
        """Parameter of the time integration."""
        return self.problem.system.newmark_beta(self.problem.timetable.step)

    @property
    def inputs(self) -> Mapping[str, Any]:
        """The values of the problem's tables in SI, by ``table.key``."""
        return inputs(self.problem) | {"solver": self.problem.body.solver}

    def to_json(self) -> dict[str, Any]:
        """Return the scalars, and what was solved, each key with its unit."""
        problem, body = self.problem, self.problem.body
        compliance = problem.compliance.static
        return super().to_json() | {
            "impact_integration": problem.system.impact(problem.timetable.step),
            "contact_nodes": len(body.nodes),
            "unknowns": body.unknowns,
            "modes": len(body.mode_frequency),
            "solver": body.solver,
            "condense_seconds": body.seconds,
            "condensed_from_cache": body.from_cache,
            "normal_law": problem.contact.normal,
            "normal_stiffness_Pa_per_m": problem.normal.stiffness,
            "shear_compliance_x_m_per_N": float(compliance[0, 0]),
            "shear_compliance_y_m_per_N": float(compliance[1, 1]),
        }

    def heading(self) -> str:
        """Return what was solved and how."""
        body = self.problem.body
        return (
            f"{len(body.nodes)} contact nodes of {body.unknowns} unknowns, "
            f"{len(body.mode_frequency)} modes,\n{self.scheme}, law {self.law}, "
            f"{self.increments} increments"
        )

    def attached(self) -> Mapping[str, bytes]:
        """Return the file that the block is drawn from in motion, where frames of it were kept."""
        return {"frames.bin": packed_series(self.problem, self.frames)} if self.frames else {}

    def write(self, folder: Path, *, pictures: str = "png") -> list[str]:
        """Write JSON, netCDF and pictures, and an animation for ParaView."""
        names = super().write(folder, pictures=pictures)
        write_block_series(self.problem, self.frames, folder / "block.pvd")
        for path in sorted(folder.glob("block_[0-9]*.vtu"))[len(self.frames) :]:
            path.unlink(missing_ok=True)
        return [*names, "block.pvd with its frames"]


class UnfinishedBlock(Result):
    """A block's motion up to where its march ended before its time, and why it did."""

    title: ClassVar[str] = "Elastic block, unfinished"
    stem: ClassVar[str] = "block"
    labels: ClassVar[Labels] = SlideResult.labels

    problem: BlockProblem
    history: History = part(History)
    ended: str = quantity("", "", "why it ended")

    @property
    def inputs(self) -> Mapping[str, Any]:
        """The values of the problem's tables in SI, by ``table.key``."""
        return inputs(self.problem)


def inputs(problem: BlockProblem) -> dict[str, Any]:
    """Return the values of a problem's tables as plain numbers in SI and texts."""
    plain = slider_inputs(problem.model) | table_inputs(problem.block, problem.contact)
    plain = {key: list(v) if isinstance(v, tuple) else v for key, v in plain.items()}
    normal = problem.normal
    plain["contact.stiffness"] = normal.stiffness
    if normal.name == "two-stage":
        plain["contact.initial_stiffness"] = normal.initial
        plain["contact.transition"] = [normal.start, normal.end]
    return plain
