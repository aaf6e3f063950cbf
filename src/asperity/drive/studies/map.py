"""A map of the torque ratio over frequency and velocity ratio, with resonances and closed form."""

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.drive.problem import DriveProblem
from asperity.drive.protocols.many import solve_many
from asperity.drive.reduced.model import ReducedModel
from asperity.drive.reduced.reduction import reduction
from asperity.drive.result import DriveResult, inputs
from asperity.drive.solve import prepare
from asperity.drive.studies.closed_form import screw_ratio
from asperity.errors import AsperityError, InputError
from asperity.results import Result, quantity
from asperity.runs import Run

_PLANE = ("frequency", "velocity_ratio")
FREQUENCIES = (500.0, 1000.0, 1500.0, 2000.0, 3000.0, 4000.0, 6000.0, 10000.0, 20000.0)
RATIOS = (0.5, 1.0, 1.2, 1.5, 2.0, 3.0, 5.0)


class DriveMap(Result):
    """What a drive comes to over frequency and velocity ratio; NaN where it has no answer.

    A ratio where ``settled`` is 0 or ``torque_balance`` is not small is no ratio of the gearset.
    """

    title: ClassVar[str] = "Map of a shaken worm gearset"
    stem: ClassVar[str] = "drive_map"
    drawings: ClassVar[Mapping[str, str]] = {"drive_map": "asperity.drive.studies.plots:plot_map"}

    problem: DriveProblem
    frequency: FloatArray = quantity(
        "f", "Hz", "frequency of the vibration", dims=("frequency",), coordinate=True
    )
    velocity_ratio: FloatArray = quantity(
        "k_w", "", "peak velocity over the sliding", dims=("velocity_ratio",), coordinate=True
    )
    torque_ratio: FloatArray = quantity("", "", "mean torque over that without", dims=_PLANE)
    torque_balance: FloatArray = quantity("", "", "wheel torque over its load less 1", dims=_PLANE)
    settled: npt.NDArray[np.int8] = quantity("", "", "1 periodic and balanced", dims=_PLANE)
    energy_ratio: FloatArray = quantity("", "", "power put in over that without", dims=_PLANE)
    open_share: FloatArray = quantity("", "", "share of time without contact", dims=_PLANE)
    closed_form: FloatArray = quantity(
        "", "", "ratio of a screw far above resonance", dims=("velocity_ratio",)
    )
    resonance_worm: float | None = quantity("f_1", "Hz", "of the worm on its shaft, mesh open")
    resonance_wheel: float | None = quantity("f_2", "Hz", "of the wheel on its teeth, worm held")

    @property
    def inputs(self) -> Mapping[str, Any]:
        """What was asked, by ``table.key``."""
        return inputs(self.problem)


def drive_map(
    case: Case,
    frequencies: Sequence[float] = FREQUENCIES,
    ratios: Sequence[float] = RATIOS,
    run: Run | None = None,
) -> DriveMap:
    """Return the map of a case's drive.

    Parameters
    ----------
    case : Case
        With a vibration, whose frequency and amplitude are replaced.
    frequencies, ratios : sequence of float
        Of the vibration, Hz, and of its peak velocity to the sliding; each positive and rising.
    run : Run, optional
        Who is told how far it is.

    Raises
    ------
    InputError
        The axes are none, or no point can be solved, with the reason of the first.
    """
    for name, axis in (("frequencies", frequencies), ("ratios", ratios)):
        if len(axis) == 0 or min(axis) <= 0.0 or list(axis) != sorted(set(axis)):
            raise InputError(f"{name} are {list(axis)}; give positive numbers that rise")
    doing = Run() if run is None else run
    centre = prepare(case)
    _ = centre.vibrated
    plain = centre.drive.model_copy(update={"protocol": "steady"}, units="SI")
    reduced = reduction(centre, doing)
    points: list[DriveProblem | AsperityError] = []
    for frequency in frequencies:
        for ratio in ratios:
            try:
                other = case.replace_values(
                    {"vibration.frequency": frequency, "vibration.velocity_ratio": ratio}
                )
                points.append(dataclasses.replace(DriveProblem.from_case(other), drive=plain))
            except InputError as error:
                points.append(error)
    solvable = [(point, reduced) for point in points if isinstance(point, DriveProblem)]
    solved = iter(solve_many(solvable, doing, what="points"))
    found = [next(solved) if isinstance(point, DriveProblem) else point for point in points]
    failures = [str(each) for each in found if isinstance(each, AsperityError)]
    answers = [each for each in found if isinstance(each, DriveResult)]
    if not answers:
        raise InputError(f"no point of the map has an answer: {failures[0]}")

    def plane(name: str, empty: float = np.nan) -> Any:
        values = [getattr(each, name) if isinstance(each, DriveResult) else empty for each in found]
        return np.array([empty if v is None else float(v) for v in values]).reshape(
            len(frequencies), len(ratios)
        )

    model = ReducedModel(centre, reduced)
    return DriveMap(
        problem=centre,
        frequency=np.array(frequencies, float),
        velocity_ratio=np.array(ratios, float),
        torque_ratio=plane("torque_ratio"),
        torque_balance=plane("torque_balance"),
        settled=plane("settled", 0.0).astype(np.int8),
        energy_ratio=plane("energy_ratio"),
        open_share=plane("open_share"),
        closed_form=screw_ratio(model.point, model.friction, ratios),
        resonance_worm=answers[0].resonance_worm,
        resonance_wheel=answers[0].resonance_wheel,
        notes=tuple(f"without an answer: {reason}" for reason in dict.fromkeys(failures)),
    )
