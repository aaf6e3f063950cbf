"""The answer of `control`: a stroke whose vibration is switched, and the same with each failure."""

import math
from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.drive.control.parameters import Control
from asperity.drive.driven import inputs
from asperity.drive.problem import DriveProblem
from asperity.results import Result, quantity
from asperity.results.table import Table, table_of
from asperity.results.words import Number, Sentence

_FAILURES, _COURSE = ("failure",), ("failure", "time")
_MILLI = 1e3


class Controlled(Result):
    """A stroke with vibration where it is asked for.

    What is over ``failure`` has ``none`` first; what does not exist is NaN.
    """

    title: ClassVar[str] = "Vibration switched in a stroke"
    stem: ClassVar[str] = "control"
    drawings: ClassVar[Mapping[str, str]] = {
        "control": "asperity.drive.control.plots:plot_stroke",
        "control_failures": "asperity.drive.control.plots:plot_failures",
    }

    problem: DriveProblem
    control: Control
    torque_static: float = quantity("T_s", "N m", "torque of the motor at a seat, not shaken")
    torque_static_between: float = quantity("", "N m", "torque of the motor between the seats")
    peak: float = quantity("", "N m", "greatest torque of the motor, a mean over the peak time")
    peak_ratio: float = quantity("", "", "the same over that at a seat, not shaken")
    mean: float = quantity("", "N m", "mean torque of the motor")
    rms: float = quantity("", "N m", "root mean square of the torque of the motor")
    energy_motor: float = quantity("", "J", "mechanical energy of the motor in the stroke")
    energy_actuator: float = quantity(
        "", "J", "mechanical energy of the vibration; of a cam in that of the motor"
    )
    share_on: float = quantity("", "", "share of the stroke with vibration")
    switched: int = quantity("", "", "times that the vibration comes, that of the start in it")
    late: float | None = quantity(
        "", "s", "from the second seat's threshold to 63 % of the vibration"
    )
    crept: float = quantity("", "rad", "turn of the wheel once the motor stops, as the load pushes")
    holds: bool = quantity("", "", "whether the gearset holds then")
    rise: float = quantity("", "s", "time in which the vibration comes to 63 %")
    ripple: float = quantity("", "N m", "swing of the sensor's torque at the second seat, shaken")
    read_ripple: float = quantity("", "N m", "swing of the same behind the filter")
    filter_leaves: float = quantity(
        "", "", "share of the vibration's frequency that the filter leaves"
    )
    filter_late: float = quantity("", "s", "what the filter comes late by")
    read_as: float | None = quantity(
        "", "Hz", "frequency as which the readings show the vibration's; 0: a constant"
    )
    closure: float = quantity("", "", "of all powers, what is missing over what is put in")
    step_error: float = quantity("", "", "change of the motor's energy with steps twice as long")
    steps: int = quantity("", "", "time steps of all strokes", shown=False)
    names: npt.NDArray[np.str_] = quantity(
        "", "", "what fails", dims=_FAILURES, coordinate=True, variable="failure"
    )
    time: FloatArray = quantity("t", "s", "time", dims=("time",), coordinate=True)
    turn: FloatArray = quantity("", "rad", "turn of the wheel", dims=_COURSE)
    load: FloatArray = quantity("", "N m", "torque of the wheel's load", dims=_COURSE)
    torque: FloatArray = quantity("", "N m", "torque of the motor", dims=_COURSE)
    amplitude: FloatArray = quantity("", "", "vibration over its full amplitude", dims=_COURSE)
    reading: FloatArray = quantity("", "N m", "last reading of the controller", dims=_COURSE)
    peaks: FloatArray = quantity("", "N m", "greatest torque of the motor", dims=_FAILURES)
    shares_on: FloatArray = quantity("", "", "share of the stroke with vibration", dims=_FAILURES)
    times_on: npt.NDArray[np.int64] = quantity(
        "", "", "times that the vibration comes", dims=_FAILURES
    )
    creeps: FloatArray = quantity(
        "", "rad", "turn of the wheel once the motor stops", dims=_FAILURES
    )
    held: npt.NDArray[np.int8] = quantity("", "", "whether it holds then", dims=_FAILURES)
    faults: npt.NDArray[np.str_] = quantity("", "", "what the controller finds", dims=_FAILURES)
    fault_times: FloatArray = quantity("", "s", "when, after the start", dims=_FAILURES)

    @property
    def inputs(self) -> Mapping[str, Any]:
        """What was asked, by ``table.key``."""
        asked = self.control.model_dump(exclude_none=True)
        own = {
            f"control.{name}": value if isinstance(value, str | int | float) else str(value)
            for name, value in asked.items()
        }
        return {
            **inputs(self.problem),
            **{name: int(v) if isinstance(v, bool) else v for name, v in own.items()},
        }

    @property
    def moved(self) -> tuple[bool, ...]:
        """Whether the motor can give each stroke's torque; all, if nothing is said of it."""
        most = self.control.motor_torque or math.inf
        return tuple(bool(peak <= most) for peak in self.peaks)

    def headline(self) -> tuple[str, ...]:
        """Return what the motor needs, how long it is shaken, what holds, and what fails."""
        peak = Number.of(self.peak, ".3g", "peak_Nm")
        still = Number.of(self.torque_static, ".3g", "torque_static_Nm")
        needs = Sentence(
            "the motor needs ", peak, " N m at most, without vibration ", still, " N m"
        )
        if not self.moved[0]:
            needs = Sentence(needs, ": MORE THAN IT GIVES")
        share = Number.of(self.share_on, ".2g", "share_on", 100.0)
        times = f"it comes {self.switched} time{'' if self.switched == 1 else 's'}"
        late = ""
        if self.late is not None:
            ms = Number.of(self.late, ".2g", "late_s", _MILLI)
            late = Sentence(", at the second seat ", ms, " ms after its torque")
        held = "holds after it" if self.holds else "does NOT hold after it"
        bad = [
            str(name)
            for name, holds, moves in zip(self.names, self.held, self.moved, strict=True)
            if name != "none" and not (holds and moves)
        ]
        failing = "no failure that is tried keeps it from seating or holding"
        if bad:
            failing = f"it does not seat or hold with: {', '.join(bad)}"
        if len(self.names) == 1:
            failing = "no failure is tried"
        return (
            needs,
            Sentence("shaken for ", share, f" % of the stroke: {times}", late, f"; it {held}"),
            failing,
        )

    def to_json(self) -> dict[str, Any]:
        """Return the scalars, and a row for each failure."""
        rows = [
            {
                "failure": str(name),
                "peak_Nm": float(self.peaks[n]),
                "share_on": float(self.shares_on[n]),
                "switched": int(self.times_on[n]),
                "crept_rad": float(self.creeps[n]),
                "holds": bool(self.held[n]),
                "motor_gives_it": self.moved[n],
                "fault": str(self.faults[n]),
                "fault_time_s": None if math.isnan(self.fault_times[n]) else
                float(self.fault_times[n]),
            }
            for n, name in enumerate(self.names)
        ]  # fmt: skip
        return super().to_json() | {"failures": rows}

    def tables(self) -> tuple[Table, ...]:
        """Return the stroke's numbers, and a row for each failure."""
        headings = (
            "fails", "found", "greatest torque (N m)", "motor gives it", "shaken (%)", "comes",
            "creeps (deg)", "holds",
        )  # fmt: skip
        rows = [
            (
                str(name),
                self._found(n),
                float(self.peaks[n]),
                self.moved[n] if self.control.motor_torque is not None else "-",
                100.0 * float(self.shares_on[n]),
                int(self.times_on[n]),
                math.degrees(float(self.creeps[n])),
                bool(self.held[n]),
            )
            for n, name in enumerate(self.names)
        ]
        return (
            table_of(self),
            Table.of(headings, rows, title="What fails", left=2, remarks=self.notes),
        )

    def _found(self, n: int) -> str:
        fault = str(self.faults[n])
        return f"{fault}, {1e3 * float(self.fault_times[n]):.0f} ms" if fault else "-"
