"""The procedure as a state machine: its state is the journal, its transitions are actions.

An action is begun and done, each with a line on the disk. What is not done when the machine starts
is what is left, so that a run goes on where it was killed. Whatever ends it, vibration and motors
are switched off before anything else is tried.
"""

import contextlib
import functools
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from asperity.casefile import Case
from asperity.errors import AsperityError, StorageError
from asperity.runs import Run
from asperity.runs.interrupt import Interrupted, Signals
from asperity.tribometer.guardian.journal import Lines
from asperity.tribometer.instruments.bench import Bench, MadeSafe
from asperity.tribometer.instruments.protocols import (
    STOPPED,
    SWITCHED_OFF,
    InstrumentError,
    StillOnError,
    WallClock,
)
from asperity.tribometer.options import Plan, Reduction
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.parameters import Sonotrode
from asperity.tribometer.plan.matrix import PlannedFile
from asperity.tribometer.preview import Preview, units_of
from asperity.tribometer.procedure import checks
from asperity.tribometer.procedure.approach import Approach
from asperity.tribometer.procedure.driving import Driving
from asperity.tribometer.procedure.interlock import Interlock
from asperity.tribometer.procedure.logger import Logger, configuration_of
from asperity.tribometer.procedure.packer import Packer
from asperity.tribometer.procedure.sliding import Sliding
from asperity.tribometer.procedure.steps import Action, file_of

_TRIES = 3
_REST = 1.0
_TRIAL = 5.0  # An encoder's gate and filter, twice.
_TRIAL_MEAN = 1.0
_PRELOAD_TIME = 0.5
_SIMULATED_SAMPLE, _SIMULATED_SECOND = 1e-6, 0.02  # s, for a sample and a second


class Machine:
    """A run of a plan on a bench.

    Parameters
    ----------
    case : Case
        The configuration.
    actions : sequence of Action
        All of the plan.
    bench : Bench
        Its instruments.
    journal : Journal
        What is done already, and where more is written.
    folder : Path
        For recordings.
    run : Run
        Progress.
    signals : Signals
        What ends the run.
    """

    def __init__(
        self,
        case: Case,
        actions: Sequence[Action],
        bench: Bench,
        journal: Lines,
        folder: Path,
        run: Run,
        signals: Signals,
    ) -> None:
        self._case = case
        self._actions = actions
        self._bench = bench
        self._journal = journal
        self._folder = folder
        self._run = run
        self._signals = signals
        self._plan = case.require(Plan)
        self._pair = pair_of(case)
        self._sonotrode = case.require(Sonotrode)
        self._settling = (case.get(Reduction, Reduction())).settling
        self._interlock = Interlock.from_case(case, bench.scope.inputs)
        self._interval = 1.0 / self._plan.sample_rate
        self._logger: Logger | None = None
        self._file: PlannedFile | None = None
        self._cells = sum(action.act == "cell" for action in actions)
        self._done_cells = 0
        self._packer = Packer(run.notify)
        units = units_of([one.signal for one in bench.scope.inputs])
        self._preview = Preview(folder, units, simulated=bench.simulated)
        self._approach = Approach(bench, self._new_logger, self._preview.show_outputs)
        self._slides = Sliding(case, self._plan)
        self._driving = Driving(bench, self._plan, self._approach.ran, self._preview.show_outputs)

    def go(self) -> AsperityError | None:
        """Do what is left.

        Returns
        -------
        AsperityError or None
            What latched; None when all is done.

        Raises
        ------
        Interrupted
            Ctrl-C was pressed; what is done is kept.
        """
        done = self._journal.done
        self._done_cells = sum(one.act == "cell" and one.key in done for one in self._actions)
        self._forecast(done)
        try:
            self._remember(done)
            with self._packer:
                for place, action in enumerate(self._actions):
                    self._signals.check(self._how_far())
                    if action.key in done:
                        continue
                    following = next(map(str, self._actions[place + 1 :]), "")
                    far = self._done_cells, self._cells
                    self._preview.step(str(action), following, *far, asks=action.asks)
                    self._journal.write("begun", action=action.key, steps=list(action.steps))
                    told = self._act(action)
                    self._journal.write(
                        "done", action=action.key, steps=list(action.steps), **told, **self._held()
                    )
                    self._done_cells += action.act == "cell"
                # Nothing is on while the last recordings are packed.
                failures = self._bench.safe()
        except BaseException as error:
            return self._ended(error)
        self._preview.end("latched" if failures else "finished")
        if not failures:
            return None
        return self._still_on("all is done", "still on", failures)

    def _forecast(self, done: dict[str, dict[str, Any]]) -> None:
        """Say how long it takes: as long as is recorded, or a part of that where simulated."""
        left = sum(one.act == "cell" and one.key not in done for one in self._actions)
        plan = self._plan
        if plan.distance is not None:
            return  # How fast discs wear a distance off, they say themselves.
        seconds = left * (plan.before + plan.shaken + plan.idle)
        if not isinstance(self._bench.clock, WallClock):
            seconds *= plan.sample_rate * _SIMULATED_SAMPLE + _SIMULATED_SECOND
        self._run.forecast(seconds, f"{left} cells")

    def _remember(self, done: dict[str, dict[str, Any]]) -> None:
        """Let a simulated rig stand where it stood when the last action was done."""
        if self._bench.memory is not None and done:
            last = max(done.values(), key=lambda line: line["line"])
            self._bench.memory.restore(last["memory"])

    def _held(self) -> dict[str, Any]:
        memory = self._bench.memory
        return {} if memory is None else {"memory": memory.state()}

    def _ended(self, error: BaseException) -> AsperityError:
        """Make everything safe, then say why; what is no fault of the rig is raised on."""
        try:
            failures = self._bench.safe()
        except MadeSafe as again:
            error, failures = again, again.failures
        still = {"still_on": list(failures)} if failures else {}
        if self._logger is not None:
            self._logger.abandon()
        self._packer.join_left()
        error = self._bench.cause_of(error)
        kind = getattr(error, "kind", "")
        if kind == STOPPED or (self._signals.heard and kind == SWITCHED_OFF):
            # The guardian heard of the request first.
            error = Interrupted(f"{self._signals.heard or STOPPED}{self._how_far()}")
        if isinstance(error, Interrupted | KeyboardInterrupt):
            said = str(error) or "interrupted"
            self._preview.end("latched" if failures else "interrupted")
            if failures:
                return self._still_on(said, "still on", failures)
            self._journal.write("interrupted", reason=said)
            raise Interrupted(f"{said}; --resume goes on") from None
        self._preview.end("latched")
        kind = getattr(error, "kind", "disk" if isinstance(error, StorageError) else "error")
        reason = str(error) or type(error).__name__
        try:
            self._journal.write("latched", interlock=kind, reason=reason, **still)
        except StorageError as full:
            if not isinstance(error, StorageError):
                error.add_note(str(full))
        if not isinstance(error, AsperityError):
            raise error
        if failures:
            return StillOnError.of(reason, kind, failures)
        # Whatever latched ends with one status, also where it is no instrument's.
        latched = error.exit_code == InstrumentError.exit_code
        return error if latched else InstrumentError(reason, kind=kind)

    def _still_on(self, reason: str, kind: str, failures: Sequence[str]) -> AsperityError:
        """Latch, since something was not read back to be off."""
        self._journal.write("latched", interlock=kind, reason=reason, still_on=list(failures))
        return StillOnError.of(reason, kind, failures)

    def _how_far(self) -> str:
        return f" after {self._done_cells} of {self._cells} cells"

    def _act(self, action: Action) -> dict[str, Any]:
        acts: dict[str, Callable[[Action], dict[str, Any]]] = {
            "ask": self._ask,
            "weigh": self._weigh,
            "arrange": self._arrange,
            "preload": self._preload,
            "waveform": self._waveform,
            "trial": self._trial,
            "rest": self._record_at_rest,
            "cell": self._record_cell,
            "save": self._save,
        }
        with self._approach.safe() if action.asks else contextlib.nullcontext():
            return acts[action.act](action)

    def _ask(self, action: Action) -> dict[str, Any]:
        with self._signals.raising():
            self._bench.person.do(action.text)
        return {}

    def _weigh(self, action: Action) -> dict[str, Any]:
        read = self._bench.person.read
        with self._signals.raising():
            return {f"{disc}_kg": read(f"Weight of the {disc} disc", "kg") for disc in _DISCS}

    def _arrange(self, action: Action) -> dict[str, Any]:
        one = file_of(action)
        with self._signals.raising():
            self._bench.person.arrange(action.text, one.mode)
        return {"mode": one.mode}

    def _preload(self, action: Action) -> dict[str, Any]:
        wanted, sensitivity = self._sonotrode.preload_voltage, self._sonotrode.preload_sensitivity

        def checked(logger: Logger) -> dict[str, Any]:
            level = logger.levels(logger.watch(_PRELOAD_TIME))["load_cell"]
            checks.check_preload(level, wanted)
            return {"preload_V": level} | (
                {} if sensitivity is None else {"preload_N": level * sensitivity}
            )

        return self._tried(action, checked)

    def _waveform(self, action: Action) -> dict[str, Any]:
        one = file_of(action)
        if frequency := one.cells[0].frequency:
            self._bench.vibration.configure(one.waveform, frequency)
        return {"waveform": one.waveform}

    def _trial(self, action: Action) -> dict[str, Any]:
        """Steps 12 to 16, with motors but without vibration."""
        one = file_of(action)

        def checked(logger: Logger) -> dict[str, Any]:
            rest = logger.levels(logger.watch(_REST))
            checks.check_zeros(rest)
            self._driving.energise(logger, one)
            running = logger.levels(logger.watch(_TRIAL, skip=_TRIAL - _TRIAL_MEAN))
            given = {
                name: logger.during(supply, supply.reading)
                for name, supply in self._bench.motors.items()
            }
            checks.check_changes(rest, running, self._pair.tied)
            checks.check_map(running, given, self._pair.torque_share)
            meter = self._bench.tachometer
            measured = {
                name: logger.during(meter, functools.partial(meter.speed, name)) for name in _DISCS
            }
            pulses = self._pair.drives.encoder_pulses
            checks.check_speeds(running, measured, 2.0 * np.pi / pulses)
            self._driving.still(logger)
            if self._plan.distance is not None:
                # Encoders have forgotten it before the sliding is counted.
                logger.watch(self._slides.idle)
            return {"running": running, "tachometer_rad_per_s": measured}

        return self._tried(action, checked)

    def _tried(self, action: Action, check: Callable[[Logger], dict[str, Any]]) -> dict[str, Any]:
        """Make a check, let a person put right what is wrong, and make it again."""
        for left in range(_TRIES - 1, -1, -1):
            logger = self._logger = self._new_logger(None, None)
            try:
                told = check(logger)
            except InstrumentError as error:
                # Only what a check found may be tried again; an interlock stays tripped.
                if left == 0 or error.kind not in _PUT_RIGHT:
                    raise
                self._driving.still(logger)
                self._journal.write("check", action=action.key, reason=str(error))
                logger.close()
                with self._approach.safe(), self._signals.raising():
                    self._bench.person.do(f"{error}. Put it right.")
                continue
            logger.close()
            self._logger = None
            return told
        raise AssertionError

    def _record_at_rest(self, action: Action) -> dict[str, Any]:
        one = file_of(action)
        logger = self._recording(one)
        logger.watch(_REST)
        return {"recording": _name(logger)}

    def _record_cell(self, action: Action) -> dict[str, Any]:
        """Steps 17 to 20 of one frequency: discs alone, with vibration, and at rest."""
        one, cell = file_of(action), action.cell
        if cell is None:
            raise AssertionError
        logger, plan = self._recording(one), self._plan
        logger.event("cell", str(cell.number))
        if cell.frequency:
            self._driving.configure(logger, one, cell)
        self._driving.energise(logger, one)
        before = logger.watch(plan.before, skip=min(self._settling, 0.5 * plan.before))
        if cell.frequency:
            self._driving.shake(logger, one, cell)
        told: dict[str, Any] = {}
        if plan.distance is None:
            shaken = logger.watch(
                plan.shaken, skip=min(self._settling, 0.5 * plan.shaken), crc32=before.crc32
            )
        else:
            far = plan.distance / plan.stretches - self._slides.over(logger, before)
            shaken, slid = self._slides.far(logger, far, before.crc32)
            told = {"distance_m": plan.distance / plan.stretches - far + slid}
        self._driving.still(logger)
        if idle := self._slides.idle:
            logger.watch(idle)
        # The journal is not to tell of samples that a kill would still cost.
        logger.flush()
        return {
            "cell": cell.number,
            "frequency_Hz": cell.frequency,
            "mode": one.mode,
            "waveform": one.waveform,
            "file": one.name,
            "recording": _name(logger),
            "before": [before.first, before.samples],
            "shaken": [shaken.first, shaken.samples],
            "crc32": shaken.crc32,
            "level_before": logger.levels(before),
            "level_with": logger.levels(shaken),
        } | told

    def _save(self, action: Action) -> dict[str, Any]:
        if self._logger is None:
            return {}
        logger, self._logger, self._file = self._logger, None, None
        logger.close()
        if logger.path is not None:
            self._packer.pack(logger.path)
        return {"recording": _name(logger), "samples": logger.samples}

    def _recording(self, planned: PlannedFile) -> Logger:
        """Return the recording of a file that runs, or begin a part of it."""
        if self._logger is None or self._file != planned:
            part = 1 + sum(line["file"] == planned.name for line in self._journal.of("recording"))
            name = planned.name if part == 1 else f"{planned.name}-{part}"
            path = self._folder / f"{name}.nc"
            self._journal.write("recording", file=planned.name, recording=path.name)
            self._logger, self._file = self._new_logger(path, planned), planned
        return self._logger

    def _new_logger(self, path: Path | None, planned: PlannedFile | None) -> Logger:
        return Logger(
            self._bench, self._interlock, self._interval, path,
            configuration_of(self._case, planned), self._checkpoint, self._preview,
        )  # fmt: skip

    def _checkpoint(self) -> None:
        self._run.checkpoint(self._done_cells, self._cells, what="cells")
        self._signals.check(self._how_far())


_DISCS = "steel", "bronze"
_PUT_RIGHT = frozenset(("preload", "zero", "no change", "wrong channel map"))


def _name(logger: Logger) -> str:
    return logger.path.name if logger.path is not None else ""
