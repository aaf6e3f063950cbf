"""The command `directions`: which way of shaking a gearset gives most, and for what."""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.drive.driven import inputs
from asperity.drive.problem import PLACES, DriveProblem
from asperity.drive.protocols.many import solve_many
from asperity.drive.protocols.solve import asked
from asperity.drive.reduced.reduction import reduction
from asperity.drive.result import EQUAL, DriveResult
from asperity.drive.solve import prepare_shaken
from asperity.errors import AsperityError
from asperity.results import Result, quantity
from asperity.results.dataset import Labels
from asperity.results.table import Table
from asperity.runs import Run
from asperity.runs.key import code_key, key

_MODES = ("mode",)
_MICROMETRES = 1e6
# In JSON and the file; in notes, where it matters.
_TOLD_ELSEWHERE = (
    "settled_by", "step_error", "saved_per_actuator_error_W_W", "energy_ratio_error",
)  # fmt: skip
OR = " or "
"""Between ways of shaking that stand at the same place."""


class Directions(Result):
    """What each way of shaking does at the same frequency and amplitude.

    Everything is over the modes, in the order of `PLACES`; what did not settle is shown as such and
    saves nothing, and what is not defined, or less than its error, is NaN.
    """

    title: ClassVar[str] = "Ways of shaking a worm gearset"
    stem: ClassVar[str] = "directions"
    drawings: ClassVar[Mapping[str, str]] = {"directions": "asperity.drive.plots:plot_directions"}
    labels: ClassVar[Labels] = {"mode": (tuple(PLACES), "which way it is shaken")}

    problem: DriveProblem
    amplitude: float = quantity("u_a", "m", "amplitude of the displacement")
    torque_ratio: FloatArray = quantity(
        "T_Bv/T_Bs", "", "mean torque over that without", dims=_MODES
    )
    torque_balance: FloatArray = quantity("T_m/T_R - 1", "", "balance of the wheel", dims=_MODES)
    settled: npt.NDArray[np.int8] = quantity("", "", "1 periodic and balanced", dims=_MODES)
    settled_by: npt.NDArray[np.str_] = quantity("", "", "settled by", dims=_MODES)
    step_error: FloatArray = quantity("", "", "error of the ratio from the step", dims=_MODES)
    saved: FloatArray = quantity(
        "P_0 - P_d", "W", "drive power saved, worm and wheel in balance", dims=_MODES
    )
    saved_error: FloatArray = quantity("", "W", "error of the drive power saved", dims=_MODES)
    actuator: FloatArray = quantity("P_a", "W", "mechanical power of the actuator", dims=_MODES)
    saved_per_actuator: FloatArray = quantity(
        "(P_0 - P_d)/P_a", "", "drive power saved per actuator power",
        dims=_MODES, key="saved_per_actuator_W_W",
    )  # fmt: skip
    saved_per_actuator_error: FloatArray = quantity(
        "", "", "error of what is saved per actuator power", dims=_MODES,
        key="saved_per_actuator_error_W_W",
    )  # fmt: skip
    energy_ratio: FloatArray = quantity("", "", "power put in over that without", dims=_MODES)
    energy_ratio_error: FloatArray = quantity(
        "", "", "error of the power put in over that without", dims=_MODES
    )
    force_ratio: FloatArray = quantity(
        "N_max/N_s", "", "greatest normal force over that without", dims=_MODES
    )
    open_share: FloatArray = quantity("", "", "share of time without contact", dims=_MODES)

    @property
    def inputs(self) -> Mapping[str, Any]:
        """What was asked, by ``table.key``."""
        return inputs(self.problem)

    @property
    def rows(self) -> list[dict[str, Any]]:
        """One mapping a mode: what it does per micrometre, per watt and to the force."""
        micrometres = self.amplitude * _MICROMETRES
        return [
            {
                "mode": mode,
                "torque_ratio": float(self.torque_ratio[n]),
                "torque_balance": float(self.torque_balance[n]),
                "settled": bool(self.settled[n]),
                "settled_by": str(self.settled_by[n]),
                "step_error": float(self.step_error[n]),
                "saved_W": _told(self.saved[n]),
                "saved_error_W": _told(self.saved_error[n]),
                "saved_per_micrometre_W": _told(self.saved[n] / micrometres),
                "actuator_W": float(self.actuator[n]),
                "saved_per_actuator_W_W": _told(self.saved_per_actuator[n]),
                "saved_per_actuator_error_W_W": _told(self.saved_per_actuator_error[n]),
                "energy_ratio": float(self.energy_ratio[n]),
                "energy_ratio_error": float(self.energy_ratio_error[n]),
                "force_ratio": float(self.force_ratio[n]),
                "open_share": float(self.open_share[n]),
            }
            for n, mode in enumerate(PLACES)
        ]

    @property
    def rankings(self) -> dict[str, list[str]]:
        """The modes, best first, by each measure; only those that settled are ranked.

        By what is saved only those are for which that is told. Ways that are no further apart than
        their errors stand at one place, as "axial or screw".
        """
        solid = [row for row in self.rows if row["settled"]]
        equal = 0.5 * EQUAL

        def ranked(by: str, sign: float, error: Callable[[dict[str, Any]], float]) -> list[str]:
            told = [row for row in solid if row[by] is not None]
            places: list[list[str]] = []
            before = -np.inf
            for row in sorted(told, key=lambda row: sign * row[by]):
                # Best first, so that each is followed by what is worse.
                if sign * row[by] - error(row) > before:
                    places.append([])
                places[-1].append(row["mode"])
                before = max(before, sign * row[by] + error(row))
            return [OR.join(place) for place in places]

        return {
            "per_micrometre": ranked(
                "saved_per_micrometre_W", -1.0,
                lambda row: row["saved_error_W"] / (self.amplitude * _MICROMETRES),
            ),
            "per_watt": ranked(
                "saved_per_actuator_W_W", -1.0, lambda row: row["saved_per_actuator_error_W_W"]
            ),
            "by_force": ranked("force_ratio", 1.0, lambda row: equal * row["force_ratio"]),
        }  # fmt: skip

    def _untold(self, order: list[str]) -> str:
        """Name the ways that settled and have no place, of which any may be better."""
        placed = {mode for place in order for mode in place.split(OR)}
        missing = [
            mode
            for mode, settled in zip(PLACES, self.settled, strict=True)
            if settled and mode not in placed
        ]
        return f"; of {', '.join(missing)} it is not known" if placed and missing else ""

    def to_json(self) -> dict[str, Any]:
        """Return each mode with its numbers, and the rankings."""
        listed = [
            {
                key: None if isinstance(value, float) and not np.isfinite(value) else value
                for key, value in row.items()
            }
            for row in self.rows
        ]
        return super().to_json() | {"directions": listed, "rankings": self.rankings}

    def tables(self) -> tuple[Table, ...]:
        """Return a row a mode."""
        headings = (
            "mode", "ratio", "balance", "settled", "saved (W)", "± (W)", "per µm (W)",
            "actuator (W)", "per W", "energy", "force", "open",
        )  # fmt: skip
        rows = [
            [_shown(row, key) for key in row if key not in _TOLD_ELSEWHERE] for row in self.rows
        ]
        for row, settled in zip(rows, self.settled, strict=True):
            row[0] = row[0] if settled else f"{row[0]} (not settled)"
        best = (
            f"best {name.replace('_', ' ')}: {', '.join(order) or 'none told'}{self._untold(order)}"
            for name, order in self.rankings.items()
        )
        return (Table.of(headings, rows, remarks=(*best, *self.notes)),)


def _shown(row: Mapping[str, Any], key: str) -> Any:
    """A value of the table, in which no energy ratio that stays tells less than its error."""
    value = row[key]
    known = abs(row["energy_ratio"] - 1.0) > row["energy_ratio_error"]  # not of one that is not
    if key == "energy_ratio" and row["settled"] and not known:
        return None
    return value


def _told(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def prepare(case: Case) -> DriveProblem:
    """Return the problem of a case, with a vibration; InputError where it cannot be solved."""
    problem = prepare_shaken(case, "steady")
    for mode in PLACES:
        problem.shaken(mode, problem.amplitude)
    return problem


def answer(problem: DriveProblem, run: Run) -> Directions:
    """Shake a drive each way.

    A way that cannot be solved stands with a note in place of numbers.

    Raises
    ------
    AsperityError
        None could.
    """
    reduced = reduction(problem, run)
    ways = [(problem.shaken(mode, problem.amplitude), reduced) for mode in PLACES]
    known = run.resume(key(code_key(__name__), asked(problem))) or {}
    found = solve_many(ways, run, what="ways", known=known)
    solved = [each for each in found if isinstance(each, DriveResult)]
    if not solved:
        raise next(each for each in found if isinstance(each, AsperityError))

    def column(value: Callable[[DriveResult], float | None]) -> FloatArray:
        told = [value(each) if isinstance(each, DriveResult) else None for each in found]
        return np.array([np.nan if each is None else each for each in told], float)

    of_all = set.intersection(*(set(each.notes) for each in solved))
    notes: dict[str, None] = {}
    for mode, each in zip(PLACES, found, strict=True):
        if isinstance(each, AsperityError):
            notes[f"{mode}: not solved, {each}"] = None
            continue
        for note in each.notes:
            notes[note if note in of_all else f"{mode}: {note}"] = None
    return Directions(
        problem=problem,
        amplitude=problem.amplitude,
        torque_ratio=column(lambda each: each.torque_ratio),
        torque_balance=column(lambda each: each.torque_balance),
        settled=np.array(
            [isinstance(each, DriveResult) and each.settled for each in found], np.int8
        ),
        settled_by=np.array(
            [each.settled_by if isinstance(each, DriveResult) else str(each) for each in found]
        ),
        step_error=column(lambda each: each.step_error),
        saved=column(lambda each: each.saved_power),
        saved_error=column(lambda each: each.saved_power_error),
        actuator=column(lambda each: each.ledger.actuator),
        saved_per_actuator=column(lambda each: each.saved_per_actuator),
        saved_per_actuator_error=column(lambda each: each.saved_per_actuator_error),
        energy_ratio=column(lambda each: each.energy_ratio),
        energy_ratio_error=column(lambda each: each.energy_ratio_error),
        force_ratio=column(lambda each: each.force_max / each.force_static),
        open_share=column(lambda each: each.open_share),
        notes=tuple(notes),
    )
