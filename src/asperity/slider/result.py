"""What a solved sliding body is: forces, motion, the power ledger; as JSON and as a dataset."""

import dataclasses
from typing import TYPE_CHECKING, Any

import numpy as np

from asperity.results.ledger import PowerLedger
from asperity.slider.model import FloatArray, Model

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


@dataclasses.dataclass(frozen=True, eq=False)
class History:
    """Motion and forces over time; rows need not be equally spaced.

    ``position`` and ``velocity`` are the body's own, (n, 2); a vibration prescribed to the body
    comes on top. Velocities are those of the half step that follows.
    """

    time: FloatArray
    drive_force: FloatArray
    friction: FloatArray
    deflection: FloatArray
    position: FloatArray
    velocity: FloatArray


@dataclasses.dataclass(frozen=True, eq=False)
class SlideResult:
    r"""The answer for one sliding body.

    Attributes
    ----------
    model : Model
        What was solved.
    ratio : float
        Mean drive force over :math:`\mu F_N`, in the window.
    drive_force : float
        Mean drive force in the window, N.
    friction_mean, friction_max, friction_min : tuple of 2 floats
        Friction components along and across the drive in the window, N.
    breakaway_time : float or None
        First time at which the drive force reaches :math:`\mu F_N`, s; None if it never does, for
        a rigid drive, and for a periodic state.
    ledger : PowerLedger or None
        None for the homogenised law without a cycle to take it from.
    residual : float
        How far from an answer it may be. ``march``: change of the mean drive force from the first
        to the second half of the window over :math:`\mu F_N` (steadiness); ``periodic``: change of
        the state over a cycle, scaled; ``homogenised``: the largest of the latter in its table.
    steps, cycles : int
        Time steps taken; whole vibration cycles the means are over (``march``) or integrated
        (``periodic``).
    substeps : int
        Parts each step was divided into to stay within the march's bounds.
    seconds : float
        Time the solution took, s.
    history : History or None
        Motion and forces over time.
    notes : tuple of str
        What a reader of the numbers should know.
    """

    model: Model
    ratio: float
    drive_force: float
    friction_mean: tuple[float, float]
    friction_max: tuple[float, float]
    friction_min: tuple[float, float]
    breakaway_time: float | None
    ledger: PowerLedger | None
    residual: float
    steps: int
    cycles: int
    seconds: float
    substeps: int = 1
    history: History | None = None
    notes: tuple[str, ...] = ()

    @property
    def static_drive_force(self) -> float:
        r"""Drive force without vibration, :math:`\mu F_N`, N."""
        return self.model.full_friction

    def to_json(self) -> dict[str, Any]:
        """Scalar results, each key with its unit."""
        model = self.model
        answer: dict[str, Any] = {
            "ratio": self.ratio,
            "drive_force_N": self.drive_force,
            "static_drive_force_N": self.static_drive_force,
            "breakaway_time_s": self.breakaway_time,
            "friction_x_mean_N": self.friction_mean[0],
            "friction_x_max_N": self.friction_max[0],
            "friction_x_min_N": self.friction_min[0],
            "friction_y_mean_N": self.friction_mean[1],
            "friction_y_max_N": max(abs(self.friction_max[1]), abs(self.friction_min[1])),
            "velocity_ratio": model.peak_velocity / model.slider.drive_velocity,
        }
        if self.ledger is not None:
            answer |= {
                "power_drive_W": self.ledger.drive,
                "power_vibration_W": self.ledger.vibration,
                "power_friction_W": self.ledger.friction,
                "power_damping_W": self.ledger.damping,
                "power_stored_W": self.ledger.stored,
                "power_untransferred_W": self.ledger.untransferred,
            }
        answer |= {
            "power_residual": self.ledger.residual if self.ledger is not None else None,
            "residual": self.residual,
            "method": model.solve.method,
            "law": model.friction.law,
            "scheme": model.solve.scheme,
            "steps": self.steps,
            "substeps": self.substeps,
            "cycles": self.cycles,
            "seconds": self.seconds,
            "notes": list(self.notes),
        }
        return answer

    def to_dataset(self) -> "xr.Dataset":
        """Scalars and, where there is one, the history as a labelled dataset in SI."""
        from asperity.slider.dataset import to_dataset

        return to_dataset(self)

    def plot(self) -> "Figure":
        """Drive force over time and friction over the last cycles."""
        from asperity.slider.plots import plot_result

        return plot_result(self)


def mean_pair(x: float, y: float, force: float) -> tuple[float, float]:
    """Scale a pair of shares to forces as plain floats."""
    return float(x * force), float(y * force)


def finite(values: FloatArray) -> bool:
    """Whether every number is finite."""
    return bool(np.all(np.isfinite(values)))
