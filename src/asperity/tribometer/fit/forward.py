"""What a model says of every measurement, for values of the free parameters."""

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.errors import AsperityError, ConvergenceError, InputError
from asperity.results.settled import unsettled
from asperity.runs import Run
from asperity.slider.batch import solve_many
from asperity.slider.model import Model
from asperity.tribometer.fit.data import Value
from asperity.tribometer.fit.rigid import DEFLECTION, Limit, limit_of

SLIDE, BLOCK, DRIVE = "slide", "block", "drive"
_MARCHED = "this is a march"


@dataclasses.dataclass
class Predictor:
    """A case's model at the conditions of measurements.

    Attributes
    ----------
    case : Case
        With the keys that no column and no parameter gives.
    by : {'slide', 'block', 'drive'}
        The command whose model it is.
    forces : bool
        Whether forces are predicted, in N, or ratios.
    between : callable
        Called before each data set is solved; may end the work.
    solves, marched, rigid : int
        Bodies solved so far; those of them without a periodic state, which were marched; and those
        that are as good as rigid.
    """

    case: Case
    by: str
    forces: bool
    between: Callable[[], None] = lambda: None
    solves: int = 0
    marched: int = 0
    rigid: int = 0

    def __call__(
        self, conditions: Sequence[Mapping[str, Value]], parameters: Mapping[str, Value]
    ) -> tuple[FloatArray, dict[int, str]]:
        """Return what is predicted of each row, not a number where there is no answer, and why."""
        self.between()
        cases = [self.case.replace_values({**one, **parameters}) for one in conditions]
        self.solves += len(cases)
        limits: list[Limit | None] = [None] * len(cases)
        if self.by == SLIDE:
            answers, limits = _slid(cases)
        else:
            answers = [_solved(one, self.by) for one in cases]
        values = np.full(len(cases), math.nan)
        why: dict[int, str] = {}
        for place, answer in enumerate(answers):
            if isinstance(answer, AsperityError):
                why[place] = str(answer)
                continue
            if missing := unsettled(answer):
                # What has not settled is no prediction.
                why[place] = f"the model has not settled there: {missing}"
                continue
            self.marched += any(_MARCHED in note for note in answer.notes)
            values[place] = _force_of(answer) if self.forces else _ratio_of(answer)
            if (limit := limits[place]) is not None:
                self.rigid += 1
                ratio = _ratio_of(answer)
                values[place] *= limit.ratio(ratio) / ratio
        return values, why


def prepared(case: Case, by: str) -> Case:
    """Return a case whose body is solved for its periodic state, where that is the model."""
    if by != SLIDE:
        return case
    method = case.raw.get("solve", {}).get("method", "march")
    chosen = "homogenised" if method == "homogenised" else "periodic"
    return case.replace_values({"solve.method": chosen, "solve.scheme": "exponential"})


def _slid(cases: Sequence[Case]) -> tuple[list[Any], list[Limit | None]]:
    models: list[Model | AsperityError] = []
    limits: list[Limit | None] = []
    for case in cases:
        limit = None
        try:
            model = Model.from_case(case)
            if (limit := limit_of(model)) is not None:
                model = Model.from_case(case.replace_values({DEFLECTION: limit.deflection}))
            models.append(model)
        except AsperityError as error:
            models.append(error)
        limits.append(limit)
    # What has not settled is dropped: nothing beside it is wanted.
    answers = iter(solve_many([one for one in models if isinstance(one, Model)], beside=False))
    return [next(answers) if isinstance(one, Model) else one for one in models], limits


def _solved(case: Case, by: str) -> Any:
    """Answer a case by another room's command."""
    from asperity.block import solve as block
    from asperity.drive import solve as drive

    room: Any = {BLOCK: block, DRIVE: drive}[by]
    try:
        return room.answer(room.prepare(case), Run())
    except (ConvergenceError, InputError) as error:
        return error


def _ratio_of(answer: Any) -> float:
    return _first(answer, ("ratio", "torque_ratio"), "ratio")


def _force_of(answer: Any) -> float:
    return _first(answer, ("drive_force",), "force")


def _first(answer: Any, names: Sequence[str], what: str) -> float:
    found = [value for name in names if (value := getattr(answer, name, None)) is not None]
    if not found:
        raise InputError(
            f"an answer of this model has no {what}; choose another --model, or measure "
            "something else"
        )
    return float(found[0])
