"""The answer of ``asperity rig reduce``: what vibration did in each segment."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from asperity.files.store import write_text
from asperity.results import Quantities, Result, labelled, measured, quantity
from asperity.results.dataset import along, described
from asperity.results.files import csv_text
from asperity.results.interval import numbers_of, value_of
from asperity.results.quantity import plain
from asperity.results.table import Table
from asperity.tribometer.parameters import TRANSVERSE
from asperity.tribometer.reduction import budget_tables
from asperity.tribometer.reduction.rows import csv_of
from asperity.tribometer.reduction.wear_result import WearResult, path_text, wear_table
from asperity.tribometer.uncertainty import Budget, Budgeted

if TYPE_CHECKING:
    import xarray as xr

_MEASURED = (
    "ratio", "sd", "slider.drive_velocity [mm/s]", "sd slider.drive_velocity [mm/s]",
    "vibration.velocity_amplitude [mm/s]",
    "sd vibration.velocity_amplitude [mm/s]", "vibration.frequency [Hz]",
    "vibration.direction [deg]",
)  # fmt: skip
_OF_DRIVES = (
    "ratio", "sd", "operation.worm_speed [rpm]", "operation.output_torque [N m]",
    "vibration.velocity_amplitude [mm/s]", "sd vibration.velocity_amplitude [mm/s]",
    "vibration.frequency [Hz]",
)  # fmt: skip
_ENDS = "low", "high"
GOOD, DOUBTFUL, REFUSED = "good", "doubtful", "refused"


def _beside(symbol: str, unit: str, meaning: str) -> Any:
    """Declare what files tell beside what JSON does."""
    return quantity(symbol, unit, meaning, only="file", default=None)


class SegmentResult(Quantities):
    """A segment: numbers before and with vibration; none where it was refused."""

    file: str = quantity("", "", "recording")
    mode: str = quantity("", "", "direction of the vibration")
    lubricant: str = quantity("", "", "lubricant")
    waveform: str = quantity("", "", "waveform")
    frequency: float | None = quantity("f", "Hz", "measured frequency", default=None)
    commanded: float | None = quantity(
        "f_c", "Hz", "commanded frequency", key="commanded_Hz", default=None
    )
    motor_voltage: float = quantity("V_ms", "V", "supply of the steel disc's motor")
    torque_before: Budgeted | None = measured("T_b", "N m", "torque before")
    torque_with: Budgeted | None = measured("T_w", "N m", "torque with vibration")
    torque_change: Budgeted | None = measured("dT", "%", "change of the torque", ends_only="json")
    power_change: Budgeted | None = measured("dP", "%", "change of the power")
    efficiency_change: Budgeted | None = measured(
        "d eta_s", "%", "change of thesis (75), points", key="efficiency_change_points"
    )
    sliding_velocity_before: Budgeted | None = measured(
        "v_sl", "mm/s", "sliding velocity before", key="sliding_velocity_before_mm_s"
    )
    sliding_velocity_with: Budgeted | None = measured(
        "v_sl", "mm/s", "sliding velocity with vibration", key="sliding_velocity_with_mm_s"
    )
    slide_roll_ratio: float | None = quantity(
        "R", "", "slide-roll ratio, mean of before and with", default=None
    )
    k_v: Budgeted | None = measured(
        "k_v", "", "v_a over the mean of the sliding velocities before and with"
    )
    model_ratio: float | None = quantity(
        "", "", "torque with over torque before, by the friction model", default=None
    )
    turns_seen: float | None = quantity(
        "", "", "turns of the steel disc in the window with vibration", default=None
    )
    quality: str = quantity("", "", "good, doubtful or refused")
    flags: tuple[str, ...] = quantity("", "", "what to know of it", default=())

    @property
    @labelled("", "%", "lower end of the change's interval", only="file")
    def low(self) -> float | None:
        """Lower end of the interval of the torque's change, %."""
        return None if self.torque_change is None else self.torque_change.low

    @property
    @labelled("", "%", "upper end of the change's interval", only="file")
    def high(self) -> float | None:
        """Upper end of the interval of the torque's change, %."""
        return None if self.torque_change is None else self.torque_change.high

    @property
    @labelled("", "%", "standard deviation of the change", only="file")
    def deviation(self) -> float | None:
        """Standard deviation of the torque's change, %."""
        return None if self.torque_change is None else self.torque_change.deviation

    full_efficiency_change: Budgeted | None = measured(
        "d eta", "%", "change of the efficiency in which motor and gear lose, points",
        key="full_efficiency_change_points", only="file",
    )  # fmt: skip
    k_v_before: float | None = _beside("k_v", "", "v_a over the sliding velocity before")
    k_v_with: float | None = _beside("k_v", "", "v_a over the sliding velocity with vibration")
    velocity_amplitude: float | None = _beside("v_a", "mm/s", "peak velocity of the vibration")
    velocity_deviation: float | None = _beside("", "mm/s", "standard deviation of v_a")

    @property
    @labelled("", "mm/s", "standard deviation of the sliding velocity with vibration", only="file")
    def sliding_velocity_deviation(self) -> float | None:
        """Standard deviation of the sliding velocity with vibration, mm/s."""
        return None if self.sliding_velocity_with is None else self.sliding_velocity_with.deviation

    bronze_turns: float | None = _beside("", "", "turns of the bronze disc in the window")
    worm_speed: float | None = _beside("n_1", "rpm", "speed of the worm with vibration")
    wheel_torque: float | None = _beside("T_2", "N m", "torque of the wheel with vibration")
    film_parameter: float | None = _beside("lambda", "", "film over roughness before")
    start: float | None = _beside("t", "s", "start of the vibration")

    @property
    def budgets(self) -> dict[str, Budget]:
        """What each number is uncertain by; nothing of a segment that was refused."""
        found = {name: getattr(self, name) for name in budget_tables.NUMBERS}
        return {name: one.budget for name, one in found.items() if one is not None}

    @property
    def cell(self) -> tuple[Any, ...]:
        """What two repeats of one measurement share."""
        return self.mode, self.lubricant, self.waveform, self.commanded, self.motor_voltage

    @property
    def ratio(self) -> float | None:
        """Torque with over torque before."""
        if self.torque_with is None or self.torque_before is None:
            return None
        return self.torque_with.value / self.torque_before.value


class FileResult(Quantities):
    """What is told of a recording as a whole.

    Attributes
    ----------
    path_deviation : float
        Standard deviation of the path by that of the vibration's velocity, m.
    shaken_distance : float
        Sliding distance with vibration, m.
    gaps, findings : tuple of dict
        As JSON has them.
    """

    file: str = quantity("", "", "recording")
    simulated: bool = quantity("", "", "whether it comes from no rig", default=False)
    runout_steel: float | None = quantity("", "%", "run-out over the steel disc", default=None)
    runout_bronze: float | None = quantity("", "%", "run-out over the bronze disc", default=None)
    noise: float | None = quantity("", "N m", "noise of a mean over 0.1 s", default=None)
    drift: float | None = quantity("", "%", "drift over the recording", default=None)
    distance: float = quantity("s", "m", "sliding distance")
    path: float | None = quantity("", "m", "path of the discs on each other, vibration counted")
    mass_loss_steel: float | None = quantity("", "mg", "mass lost by the steel disc", default=None)
    mass_loss_bronze: float | None = quantity(
        "", "mg", "mass lost by the bronze disc", default=None
    )
    wear_steel: float | None = quantity("K", "", "Archard's coefficient, steel", default=None)
    wear_bronze: float | None = quantity("K", "", "Archard's coefficient, bronze", default=None)
    path_deviation: float = 0.0
    shaken_distance: float = 0.0
    gaps: tuple[dict[str, Any], ...] = ()
    findings: tuple[dict[str, Any], ...] = ()

    @property
    def everywhere(self) -> tuple[str, ...]:
        """Flags that all of the recording has."""
        return tuple(one["flag"] for one in self.findings if one["start_s"] is None)


class Reduced(Result):
    """Recordings, reduced.

    Attributes
    ----------
    segments : tuple of SegmentResult
        In the order of recordings and time.
    files : tuple of FileResult
        In the order given.
    weighed : tuple of dict
        Wear between two weighings.
    rates : tuple of WearResult
        Wear over the distance of each run of a wear test.
    told : bool
        Whether tables and JSON tell what every number is uncertain by; files always do.
    not_counted : tuple of str
        What no budget counts, because nothing tells how uncertain it is.
    """

    title = "Recordings of a disc-on-disc rig, reduced"
    stem = "reduce"
    drawings: ClassVar[Mapping[str, str]] = {"reduce": "asperity.tribometer.plots:plot_changes"}
    whole: ClassVar[bool] = True

    segments: tuple[SegmentResult, ...]
    files: tuple[FileResult, ...]
    repeat_deviation: float | None = quantity(
        "", "%", "deviation between repeats of a cell, points", key="repeat_deviation_points",
        default=None,
    )  # fmt: skip
    repeat_freedom: int = quantity("", "", "degrees of freedom of that", default=0)
    weighed: tuple[dict[str, Any], ...] = ()
    rates: tuple[WearResult, ...] = ()
    told: bool = False
    not_counted: tuple[str, ...] = ()

    @property
    def uncertainties(self) -> tuple[budget_tables.Row, ...]:
        """Of each segment that was reduced its file, its start and its budgets."""
        return (
            *((one.file, one.start, one.budgets) for one in self.segments if one.budgets),
            *((f"{one.setting}, {one.disc}", None, one.budgets)
              for one in self.rates if one.budgets),
        )  # fmt: skip

    def to_json(self) -> dict[str, Any]:
        """Return the segments, and beside them what is told of each recording."""
        beside: dict[str, Any] = {
            "runout_percent": [
                {"file": one.file, "steel": one.runout_steel, "bronze": one.runout_bronze}
                for one in self.files
            ],
            "noise_Nm": [{"file": one.file, "noise": one.noise} for one in self.files],
            "gaps": [{"file": one.file, **gap} for one in self.files for gap in one.gaps],
            "findings": [
                {"file": one.file, **found} for one in self.files for found in one.findings
            ],
            "wear": [
                {entry.key: entry.value for entry in one.entries()
                 if entry.name in ("file", "distance", "path") or entry.name.startswith(
                     ("mass_loss", "wear"))}
                for one in self.files
            ],
        }  # fmt: skip
        if self.weighed:
            beside["wear_together"] = list(self.weighed)
        if self.rates:
            beside["wear_by_distance"] = [one.to_json() for one in self.rates]
        if self.told:
            beside["budgets"] = [
                {"file": file, "start_s": start, "numbers": budget_tables.of_segment(of)}
                for file, start, of in self.uncertainties
            ]
            beside["not_counted"] = list(self.not_counted)
        segments = {"segments": [one.to_json() for one in self.segments]}
        told: dict[str, Any] = plain(beside)
        return segments | told | super().to_json()

    def to_dataset(self) -> "xr.Dataset":
        """Return the segments along a dimension, and the recordings along another."""
        dataset = super().to_dataset()
        files = along("recording", self.files)
        if files:
            files["recording"] = files.pop("file")
        worn = {f"worn_{name}": one for name, one in along("run", self.rates).items()}
        dataset = dataset.merge(described(**along("segment", self.segments), **files, **worn))
        each = [(one.file, one.start, one.budgets) for one in self.segments]
        return dataset.merge(budget_tables.variables(each))

    def tables(self) -> tuple[Table, ...]:
        """Return a row a segment, what has intervals, and a row a recording."""
        rows = [
            (
                one.file, one.mode, one.lubricant, one.waveform, one.motor_voltage, one.commanded,
                *(_rounded(number, 4) for number in (
                    value_of(one.torque_before), value_of(one.torque_with),
                    value_of(one.torque_change), one.low, one.high)),
                _rounded(value_of(one.k_v), 3), _rounded(one.model_ratio, 3), one.quality,
            )
            for one in self.segments
        ]  # fmt: skip
        headings = (
            "file", "mode", "lubricant", "wave", "V_ms V", "f Hz", "T before N m", "T with N m",
            "change %", "low", "high", "k_v", "model", "quality",
        )  # fmt: skip
        # What all of a recording has is told once.
        common = {one.file: one.everywhere for one in self.files}
        flags = [f"{file}: {flag}" for file, told in common.items() for flag in told]
        for one in self.segments:
            own = [flag for flag in one.flags if flag not in common.get(one.file, ())]
            if own:
                flags.append(f"{one.file} at {one.start or 0.0:.0f} s: {'; '.join(own)}")
        if self.repeat_deviation is not None:
            flags.append(
                f"repeats of a cell differ by {self.repeat_deviation:.2g} points about their mean, "
                f"pooled over cells ({self.repeat_freedom} degrees of freedom)"
            )
        remarks = [
            f"{one['disc']} disc{_between(one)}: {one['mass_loss_mg']:.3g} mg lost over "
            f"{one['distance_m']:.3g} m of sliding, {path_text(one['path_m'])}"
            + (f": Archard's K is {one['archard']:.3g}" if one["archard"] is not None else "")
            for one in self.weighed
        ]
        # As many digits as a part of a turn can tell.
        files = [
            (one.file, *(_rounded(number, 2) for number in (
                one.runout_steel, one.runout_bronze, one.noise, one.drift)),
             one.distance, len(one.gaps))
            for one in self.files
        ]  # fmt: skip
        heads = (
            "file", "run-out steel %", "bronze %", "noise N m", "drift of the file %",
            "distance m", "gaps",
        )  # fmt: skip
        return (
            Table.of(headings, rows, left=4, remarks=flags),
            *self._intervals(),
            *((wear_table(self.rates),) if self.rates else ()),
            *(budget_tables.tables(self.uncertainties, self.not_counted) if self.told else ()),
            Table.of(heads, files, remarks=(*remarks, *self.notes)),
        )

    def _intervals(self) -> tuple[Table, ...]:
        """Return what has an interval beside the change of the torque, with its ends."""
        tables = {
            "Torques with intervals": {
                "torque_before": "T before N m", "torque_with": "T with N m",
            },
            "Changes of power and efficiency with intervals": {
                "power_change": "power %", "efficiency_change": "efficiency, points",
            },
            "Velocities with intervals": {
                "sliding_velocity_before": "v before mm/s", "sliding_velocity_with": "v with mm/s",
                "k_v": "k_v",
            },
        }  # fmt: skip
        used = [one for one in self.segments if one.quality != REFUSED]
        return tuple(
            Table.of(
                ("file", "f Hz", *(word for head in names.values() for word in (head, *_ENDS))),
                [(one.file, one.commanded, *(
                    _rounded(value, 4) for name in names
                    for value in numbers_of(getattr(one, name)))) for one in used],
                left=1, title=title,
            )
            for title, names in tables.items()
        )  # fmt: skip

    def write(self, folder: Path, *, pictures: str = "png") -> list[str]:
        """Write JSON, netCDF, CSV, what a fit takes, budgets, and the picture."""
        texts = {
            "reduce.csv": self.to_csv(), "measurements.csv": self.to_measurements(),
            "budget.csv": budget_tables.to_csv(self.uncertainties),
        }  # fmt: skip
        if self.rates:
            texts["wear.csv"] = csv_of(WearResult, self.rates)
        for name, text in texts.items():
            write_text(folder / name, text)
        return [*super().write(folder, pictures=pictures), *texts]

    def to_measurements(self) -> str:
        """Return torque with over torque before, with its conditions: a table for ``fit``.

        Of a triangle the velocity is that of its first harmonic, as a sine. Of a worm and its
        wheel the conditions are those of a drive: ``fit --model drive``.
        """
        if any(one.worm_speed is not None for one in self.segments):
            return self._of_drives()
        rows = [
            (1.0 + one.torque_change.value / 100.0, one.deviation / 100.0,
             one.sliding_velocity_with.value, one.sliding_velocity_deviation,
             one.velocity_amplitude, one.velocity_deviation, one.commanded,
             90.0 if one.mode == TRANSVERSE else 0.0)
            for one in self.segments
            if one.torque_change is not None and one.deviation and one.commanded is not None
            and one.velocity_amplitude and one.sliding_velocity_with is not None
            and one.sliding_velocity_with.value > 0.0
        ]  # fmt: skip
        return csv_text([_MEASURED, *rows])

    def _of_drives(self) -> str:
        rows = [
            (1.0 + one.torque_change.value / 100.0, one.deviation / 100.0, one.worm_speed,
             one.wheel_torque, one.velocity_amplitude, one.velocity_deviation, one.commanded)
            for one in self.segments
            if one.torque_change is not None and one.deviation and one.commanded is not None
            and one.velocity_amplitude and one.worm_speed and one.wheel_torque
        ]  # fmt: skip
        return csv_text([_OF_DRIVES, *rows])

    def to_csv(self) -> str:
        """Return a row a segment; columns are named as in JSON, intervals by their ends."""
        return csv_of(SegmentResult, self.segments)


def _rounded(value: float | None, digits: int) -> float | None:
    return None if value is None else float(f"{value:.{digits}g}")


def _between(worn: Mapping[str, Any]) -> str:
    return f" of {worn['setting']} ({', '.join(worn['files'])})" if "setting" in worn else ""
