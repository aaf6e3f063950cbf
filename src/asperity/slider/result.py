"""What a solved sliding body is: forces, motion, the power ledger."""

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from asperity.casefile import Table
from asperity.results import Result, labelled, part, quantity
from asperity.results.dataset import Labels
from asperity.results.ledger import PowerLedger, PressedLedger
from asperity.results.settled import by_what, error_of_step, told, whether_settled
from asperity.results.words import Number, Sentence
from asperity.slider.history import History
from asperity.slider.model import Model
from asperity.slider.space import NormalMotion
from asperity.slider.wear import WearAndHeat

if TYPE_CHECKING:
    from asperity.results.report import Section

_ROUNDING = 1e-12


class SlideResult(Result):
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
    normal : NormalMotion or None
        What happens normal to the plane; None where the normal force is a constant.
    wear : WearAndHeat or None
        None without the table [wear].
    ledger : PowerLedger
        Of a body that is pressed, a `PressedLedger`.
    settled : bool
        Whether the mean stays as it is; what has not settled is no prediction.
    settled_by : str
        What shows it, or what is missing.
    step_error : float or None
        Estimated error of the ratio that the time step makes; None where it is not estimated.
    ratio_from_rest : float or None
        Ratio at which a march from rest settles, where the periodic state is unstable, or where
        that of a homogenised law is another; None where it is the same to 1e-3 of it, where that
        march has not settled, and where none was made.
    residual : float
        How far from an answer it may be. ``march``: change of the mean drive force from the first
        to the second half of the window over :math:`\mu F_N` (steadiness), above 1e-3 also where a
        motion repeats itself after cycles that the halves have no whole number of, see
        ``settled_by``; ``periodic``: change of
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

    title: ClassVar[str] = "Sliding body"
    stem: ClassVar[str] = "slide"
    drawings: ClassVar[Mapping[str, str]] = {"slide": "asperity.slider.plots:plot_slide"}
    labels: ClassVar[Labels] = {"axis": (("x", "y"), "direction: x along the drive, y across")}

    model: Model
    drive_force: float = quantity("F_dv", "N", "mean drive force", variable="mean_drive_force")

    @property
    @labelled("mu F_N", "N", "drive force without vibration")
    def static_drive_force(self) -> float:
        r"""Drive force without vibration, :math:`\mu F_N`, N."""
        return self.model.full_friction

    @property
    @labelled(
        "F_t", "N", "thrust: the vibration drives the body", only="json", swept=False, optional=True
    )
    def thrust(self) -> float | None:
        """Mean force that holds the body back to the drive's velocity, N; None where it is pulled.

        The vibration drives it forward then: the mean drive force is negative.
        """
        return -self.drive_force if self.drive_force < -self.resolution("drive_force") else None

    ratio: float = quantity("F_dv/F_ds", "", "mean drive force over mu F_N")
    breakaway_time: float | None = quantity("t_b", "s", "time of breakaway")
    friction_mean: tuple[float, float] = quantity(
        "F", "N", "mean friction force on the body", variable="mean_friction", dims=("axis",)
    )
    friction_max: tuple[float, float] = quantity(
        "F_max", "N", "max friction force on the body", variable="max_friction", dims=("axis",)
    )
    friction_min: tuple[float, float] = quantity(
        "F_min", "N", "min friction force on the body", variable="min_friction", dims=("axis",)
    )

    @property
    @labelled("F_x", "N", "mean friction along the drive", only="json")
    def friction_x_mean(self) -> float:
        """Mean friction along the drive, N."""
        return self.friction_mean[0]

    @property
    @labelled("F_x,max", "N", "greatest friction along the drive", only="json")
    def friction_x_max(self) -> float:
        """Greatest friction along the drive, N."""
        return self.friction_max[0]

    @property
    @labelled("F_x,min", "N", "least friction along the drive", only="json")
    def friction_x_min(self) -> float:
        """Least friction along the drive, N."""
        return self.friction_min[0]

    @property
    @labelled("F_y", "N", "mean friction across", only="json", shown=False)
    def friction_y_mean(self) -> float:
        """Mean friction across the drive, N."""
        return self.friction_mean[1]

    @property
    @labelled("|F_y|,max", "N", "greatest size of friction across", only="json")
    def friction_y_max(self) -> float:
        """Greatest size of friction across the drive, N."""
        return max(abs(self.friction_max[1]), abs(self.friction_min[1]))

    @property
    @labelled(
        "k", "", "peak velocity of the vibration over that of the drive",
        only="json", shown=False, swept=False,
    )  # fmt: skip
    def velocity_ratio(self) -> float:
        """Peak velocity of the vibration over that of the drive."""
        return self.model.peak_velocity / self.model.slider.drive_velocity

    normal: NormalMotion | None = part(NormalMotion, default=None)
    wear: WearAndHeat | None = part(WearAndHeat, default=None)
    ledger: PowerLedger | None = part(PressedLedger, "power_")

    @property
    @labelled("", "", "error of the power balance")
    def power_residual(self) -> float | None:
        """What is missing from the power balance, over the power of the drive.

        Of a body that is pressed, over all that is put in, where the actuator normal to the plane
        may do most of it.
        """
        return None if self.ledger is None else self.ledger.residual

    settled: bool = whether_settled()
    settled_by: str = by_what()
    step_error: float | None = error_of_step()
    ratio_from_rest: float | None = quantity(
        "", "", "ratio that a march from rest comes to", default=None, optional=True
    )
    residual: float = quantity("", "", "residual of the method")

    @property
    @labelled("", "", "method", only="json", shown=False)
    def method(self) -> str:
        """How it was solved."""
        return self.model.solve.method

    @property
    @labelled("", "", "friction law in the plane", only="json", shown=False)
    def law(self) -> str:
        """Friction law in the plane."""
        return self.model.friction.law

    @property
    @labelled("", "", "scheme of the march", only="json", shown=False)
    def scheme(self) -> str:
        """Scheme of the march."""
        return self.model.solve.scheme

    steps: int = quantity("", "", "time steps", shown=False)
    cycles: int = quantity("", "", "whole cycles of the vibration", shown=False)
    substeps: int = quantity("", "", "parts of each step", only="json", shown=False, default=1)
    seconds: float = quantity(
        "", "s", "time it took", key="seconds", only="json", shown=False, swept=False
    )
    history: History | None = part(History, default=None)

    @property
    def inputs(self) -> Mapping[str, Any]:
        """The values of the model's tables in SI, by ``table.key``."""
        return inputs(self.model)

    def resolution(self, name: str) -> float:
        """Return the size below which a power or force is rounding."""
        if not name.startswith(("power_", "friction_", "drive_")) or name == "power_residual":
            return 0.0
        force = self.model.full_friction
        unit = self.model.slider.drive_velocity if name.startswith("power_") else 1.0
        return _ROUNDING * force * unit

    def traces(self, points: int) -> Mapping[str, Any]:
        """Return the last cycle of the vibration, where there is a history, by what is in it."""
        from asperity.slider.cycle import cycle_of

        if self.history is None:
            return {}
        found = cycle_of(self.model, self.history, points)
        # What is nothing over all of it is not told.
        return {name: values for name, values in found.items() if values.any()}

    def headline(self) -> tuple[str, ...]:
        """Return that it has not settled, where it has not."""
        return told(self)

    def sections(self, folder: Path | None = None) -> "tuple[Section, ...]":
        """Return what its report says: first of all how much of the force is left."""
        first, *others = super().sections(folder)
        still, left = (
            Number.of(getattr(self, name), ".4g", f"{name}_N")
            for name in ("static_drive_force", "drive_force")
        )
        ratio = Number.of(self.ratio, ".4g", "ratio")
        said = Sentence("of ", still, " N without vibration ", ratio, " is left: ", left, " N")
        return dataclasses.replace(first, texts=(said, *first.texts)), *others

    def heading(self) -> str:
        """Return how it was solved."""
        return f"{self.method}, {self.scheme}, law {self.law}, {self.steps} steps"


def inputs(model: Model) -> dict[str, Any]:
    """Return the values of a model's tables as plain numbers in SI and texts, by ``table.key``."""
    tables = model.slider, model.friction, model.vibration, model.normal, model.wear, model.solve
    return table_inputs(*tables)


def table_inputs(*tables: Table | None) -> dict[str, Any]:
    """Return the values of tables as plain numbers in SI and texts, by ``table.key``."""
    return {
        f"{table.table}.{key}": str(value) if isinstance(value, Path) else value
        for table in tables
        if table is not None
        for key, value in table
        if value is not None
    }
