"""What a solved block is: the answer of a sliding body, and what only a contact has."""

import dataclasses
from typing import TYPE_CHECKING, Any

from asperity.block.problem import BlockProblem
from asperity.slider.model import FloatArray
from asperity.slider.result import SlideResult

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from asperity.contact.motion.ledger import ContactLedger


@dataclasses.dataclass(frozen=True, eq=False)
class Frame:
    """One moment of a block, enough to draw all of it.

    Attributes
    ----------
    time : float
        s.
    coordinates : ndarray, shape (m,)
        Generalised coordinates.
    drive_force : float
        N.
    force : ndarray, shape (3 n,)
        Contact forces on the block, N.
    pressure : ndarray, shape (q,)
        At the points of the contact, Pa.
    traction : ndarray, shape (q, 3)
        On the block, Pa.
    """

    time: float
    coordinates: FloatArray
    drive_force: float
    force: FloatArray
    pressure: FloatArray
    traction: FloatArray


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class BlockResult(SlideResult):
    """The answer for one elastic block; see `SlideResult` for what it shares with a sliding body.

    Attributes
    ----------
    problem : BlockProblem
        What was solved.
    normal_force : float
        Mean normal force in the window, N.
    iterations_mean, iterations_max : float
        Iterations of an increment in the window.
    cuts : int
        Increments that were taken again in halves.
    unconverged : int
        Increments, or parts of those taken in halves, that ended above the tolerance, where the
        arithmetic has no more digits.
    residual_increment_max : float
        Greatest relative residual of an increment in the whole march.
    march_seconds : float
        Time that increments took, s, without the first of a program (which may have compiled
        kernels), and without what was done between them.
    timed : int
        How many those are.
    point_pressure : ndarray, shape (q,)
        Mean pressure in the window at the points of the contact, Pa.
    peak_pressure : float
        Greatest pressure at any point and time in the window, Pa.
    frames : tuple of Frame
        Moments for an animation: the last two cycles, or the whole run without vibration.
    """

    problem: BlockProblem
    normal_force: float
    iterations_mean: float
    iterations_max: int
    cuts: int
    unconverged: int
    residual_increment_max: float
    march_seconds: float
    timed: int
    point_pressure: FloatArray
    peak_pressure: float
    frames: tuple[Frame, ...] = ()

    @property
    def increments(self) -> int:
        """Increments that were solved, parts of those taken in halves counted once."""
        return self.steps

    @property
    def mean_pressure(self) -> float:
        """Mean normal force in the window over the nominal area, Pa."""
        return self.normal_force / self.problem.surface.area

    @property
    def normal_stiffness_at_mean_pressure(self) -> float | None:
        """Slope of the normal law at the mean pressure, Pa/m; None of hard contact."""
        normal = self.problem.normal
        return None if normal.name == "hard" else normal.slope_at(self.mean_pressure)

    @property
    def nodal_pressure(self) -> FloatArray:
        """Mean pressure in the window at the contact nodes, Pa, shape (n,)."""
        surface = self.problem.surface
        return surface.to_nodes(self.point_pressure.reshape(surface.weights.shape))

    def to_json(self) -> dict[str, Any]:
        """Scalar results, each key with its unit."""
        answer = super().to_json()
        ledger: ContactLedger | None = self.ledger  # type: ignore[assignment]
        if ledger is not None:
            answer |= {
                "power_loads_W": ledger.loads,
                "power_numerical_W": ledger.numerical,
                "power_transfer_W": ledger.transfer,
            }
        problem, body = self.problem, self.problem.body
        step = problem.timetable.step
        return answer | {
            "increments": self.increments,
            "iterations_mean": self.iterations_mean,
            "iterations_max": self.iterations_max,
            "ms_per_increment": 1e3 * self.march_seconds / max(self.timed, 1),
            "increments_cut": self.cuts,
            "unconverged": self.unconverged,
            "residual_increment_max": self.residual_increment_max,
            "newmark_beta": problem.system.newmark_beta(step),
            "impact_integration": problem.system.impact(step),
            "contact_nodes": len(body.nodes),
            "unknowns": body.unknowns,
            "modes": len(body.mode_frequency),
            "solver": body.solver,
            "condense_seconds": body.seconds,
            "condensed_from_cache": body.from_cache,
            "normal_force_N": self.normal_force,
            "normal_law": problem.contact.normal,
            "normal_stiffness_Pa_per_m": problem.normal.stiffness,
            "normal_stiffness_at_mean_pressure_Pa_per_m": self.normal_stiffness_at_mean_pressure,
            "shear_compliance_x_m_per_N": float(problem.compliance.static[0, 0]),
            "shear_compliance_y_m_per_N": float(problem.compliance.static[1, 1]),
            "pressure_max_MPa": 1e-6 * self.peak_pressure,
            "pressure_mean_MPa": 1e-6 * self.mean_pressure,
        }

    def to_dataset(self) -> "xr.Dataset":
        """Scalars, history and the mean pressure over the face as a labelled dataset in SI."""
        from asperity.block.dataset import to_dataset

        return to_dataset(self)

    def plot_pressure(self) -> "Figure":
        """Mean contact pressure over the block's face."""
        from asperity.block.plots import plot_pressure

        return plot_pressure(self)
