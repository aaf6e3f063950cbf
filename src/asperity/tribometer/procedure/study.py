"""The command ``asperity rig run``: carry out a plan by the procedure."""

import contextlib
import dataclasses
import zlib
from pathlib import Path
from typing import Any

import numpy as np

from asperity.casefile import Case
from asperity.errors import AsperityError, InputError, StorageError, plain
from asperity.processes.alone import alone
from asperity.runs import Run
from asperity.runs.interrupt import Signals
from asperity.runs.key import key
from asperity.tribometer.channels import Channels
from asperity.tribometer.guardian.backends import REPLAY, GuardedBench, open_bench
from asperity.tribometer.guardian.guard import GuardedJournal
from asperity.tribometer.guardian.journal import Journal, Lines
from asperity.tribometer.instruments.acquisition import inputs_for
from asperity.tribometer.instruments.bench import Bench
from asperity.tribometer.instruments.manual import Operator
from asperity.tribometer.instruments.protocols import StillOnError
from asperity.tribometer.instruments.replay import replay_bench
from asperity.tribometer.journal_lines import NAME, Line
from asperity.tribometer.options import Plan
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.parameters import Limits, Sonotrode
from asperity.tribometer.plan.matrix import PlannedFile, planned_files
from asperity.tribometer.plan.study import check_wear, warnings
from asperity.tribometer.procedure.machine import Machine
from asperity.tribometer.procedure.result import RunResult
from asperity.tribometer.procedure.steps import Action, sequence
from asperity.tribometer.recording import Recording
from asperity.tribometer.recording.hdf5 import joined_all
from asperity.tribometer.signals import SIMULATED
from asperity.tribometer.twin.plants import plant_of
from asperity.tribometer.twin.provenance import standing

_HELD = ".rig-run"
_LEAST_SAMPLES_A_CYCLE = 2.5
_RECORDED = frozenset(("rest", "cell", "save"))


def check_recordings(journal: Lines) -> None:
    """See that the recordings of finished cells are there, can be read and are what they were.

    Raises
    ------
    InputError
        One is gone, damaged, or holds other samples than the journal says.
    StorageError
        What a killed process had recorded cannot be joined to a file, as on a full disk.
    """
    joined_all(journal.path.parent)
    recordings: dict[str, list[Line]] = {}
    for line in journal.of("done"):
        if "cell" in line:
            recordings.setdefault(line["recording"], []).append(line)
    for name, lines in recordings.items():
        path = journal.path.parent / name
        what = f"{journal.path} says that {name} holds {len(lines)} cells, and it"
        then = "put it back, or begin the plan in another --out"
        if not path.is_file():
            raise InputError(f"{what} is gone; {then}")
        try:
            wrong = _wrong(path, lines)
        except StorageError as error:
            raise InputError(f"{what} cannot be gone on with: {error}; {then}") from None
        if wrong is not None:
            raise InputError(
                f"{what} does not hold what was recorded of cell {wrong['cell']}: check sums "
                f"differ; {then}"
            )


def _wrong(path: Path, lines: list[Line]) -> Line | None:
    """Return the first cell whose counts are not those that were recorded."""
    opened = Recording.open(path)
    for line in lines:
        crc32 = 0
        for first, count in (line["before"], line["shaken"]):
            part: Any = opened.part(first, first + count)
            if len(part) < count:
                return line
            crc32 = zlib.crc32(np.ascontiguousarray(part).data, crc32)
        if crc32 != line["crc32"]:
            return line
    return None


@dataclasses.dataclass(frozen=True)
class RunProblem:
    """A plan that may be run, and how.

    Attributes
    ----------
    case : Case
        The configuration.
    files : tuple of PlannedFile
        In their order.
    actions : tuple of Action
        Everything the plan needs.
    backend : str
        Which instruments.
    recordings : str
        Folder of the run that is played back; empty but for a replay.
    resume : bool
        Whether a run is gone on with.
    acknowledge : str
        Who has looked at what latched, and what was done; empty: nobody.
    """

    case: Case
    files: tuple[PlannedFile, ...]
    actions: tuple[Action, ...]
    backend: str
    recordings: str
    resume: bool
    acknowledge: str


def prepare(
    case: Case,
    backend: str = "sim",
    recordings: str = "",
    resume: bool = False,
    acknowledge: str = "",
) -> RunProblem:
    """Lay out a run; refuses a plan beyond its limits, and instruments that cannot be had."""
    limits = case.get(Limits, Limits())
    plan = case.require(Plan)
    files = planned_files(plan, limits)
    sonotrode = case.require(Sonotrode)
    check_wear(case)
    inputs_for(case)
    most = plan.sample_rate / _LEAST_SAMPLES_A_CYCLE
    for frequency in plan.frequencies:
        if frequency > most:
            raise InputError(
                f"plan.frequencies has {frequency:g} Hz, which a plan.sample_rate of "
                f"{plan.sample_rate:g} Hz cannot tell; it must be at most {most:g} Hz"
            )
    if acknowledge.isspace():
        raise InputError("--acknowledge is blank; say who has looked at the rig, and what was done")
    if acknowledge and not resume:
        raise InputError("--acknowledge goes with --resume: it is for a run that latched")
    if (backend == REPLAY) != bool(recordings):
        raise InputError("--backend replay and --recordings DIR, a run's folder, go together")
    if backend == REPLAY and resume:
        raise InputError("a replay is not gone on with; leave --resume out, and begin it anew")
    actions = tuple(sequence(files, geared=pair_of(case).geared))
    if backend == REPLAY:
        # What is asked of a person and what is tried beforehand is in no recording.
        actions = tuple(one for one in actions if one.act in _RECORDED)
    elif backend == "sim":
        plant = plant_of(case)
        for one in files:
            for cell in one.cells:
                if cell.frequency and sonotrode.velocity(one.mode, cell.frequency) is None:
                    raise InputError(
                        f"plan.frequencies has {cell.frequency:g} Hz, outside "
                        "sonotrode.frequencies; how fast a simulated disc moves there is not known"
                    )
        for volts in plan.steel_supplies:
            plant.steady(volts, plan.bronze_supply, plant.friction())
    else:
        Operator()
    return RunProblem(case, files, actions, backend, recordings, resume, acknowledge.strip())


def answer(problem: RunProblem, run: Run) -> RunResult:
    """Carry out a plan, or what is left of it.

    Raises
    ------
    InputError
        There is no folder, what is in it does not fit, or another run writes there.
    """
    if run.folder is None:
        raise InputError("a run needs --out DIR, a folder for its recordings and its journal")
    # Before any instrument is touched: it may be the other one's.
    signals = Signals()
    with alone(run.folder / _HELD, "is written by a run that goes on; choose another --out"):
        if problem.backend == REPLAY:
            names = [f"{one.name}.nc" for one in problem.files]
            bench = replay_bench(Path(problem.recordings), names)
            return _run(problem, bench, run, run.folder)
        with signals.listening():
            # Raised nowhere but where nothing is on; what is on, the guardian switches off at once.
            guarded = open_bench(problem.case, problem.backend, run.folder)
            try:
                with signals.told_to(guarded.guard.signals):
                    return _run(problem, guarded, run, run.folder, signals)
            finally:
                guarded.close()


def _run(
    problem: RunProblem, bench: Bench, run: Run, folder: Path, signals: Signals | None = None
) -> RunResult:
    signals = signals or Signals()
    with signals.listening():
        return _listening(problem, bench, run, folder, signals)


def _listening(
    problem: RunProblem, bench: Bench, run: Run, folder: Path, signals: Signals
) -> RunResult:
    # A process that was killed has left the instruments as they were.
    failures = bench.begun()
    if failures:
        if isinstance(bench, GuardedBench):
            # Opened, it takes what the guardian found; one that is damaged hides nothing.
            with contextlib.suppress(AsperityError):
                GuardedJournal(bench.guard, folder).close()
        raise StillOnError(
            f"not everything was read back to be off: {'; '.join(failures)}; switch it off by hand "
            "and look at the instruments",
            kind="not safe",
        )
    if not bench.simulated and isinstance(bench, GuardedBench):
        # What is not there is told before a person has weighed and built anything.
        bench.identities()
    if not (folder / NAME).exists():
        if problem.resume:
            raise InputError(f"{folder} holds no run to go on with; leave --resume out")
        _refuse_others(problem, folder)
    journal: Lines = (
        GuardedJournal(bench.guard, folder) if isinstance(bench, GuardedBench) else Journal(folder)
    )
    latch: AsperityError | None = None
    try:
        _opened(problem, journal)
        case = problem.case
        for warning in warnings(case):
            run.notify(warning)
        if late := getattr(bench.scope, "late", 0.0):
            run.notify(f"samples come by files, up to {late:g} s late: interlocks trip as late")
        machine = Machine(case, problem.actions, bench, journal, folder, run, signals)
        latch = machine.go()
        if latch is None and not journal.of("finished"):
            journal.write("finished")
    finally:
        journal.close(finished=latch is None)
    return _result(problem, journal, latch)


def _refuse_others(problem: RunProblem, folder: Path) -> None:
    """See that no recording of another run stands where one of this run will."""
    joined_all(folder)
    files = (folder / f"{one.name}.nc" for one in problem.files)
    if there := next(filter(Path.exists, files), None):
        raise InputError(f"{there} is there already, of another run; choose another --out")


def _opened(problem: RunProblem, journal: Lines) -> None:
    """Begin a journal, or go on with it if it is of this run and nothing stands in the way."""
    name = key("rig run", problem.case.canonical(), problem.backend)
    begun = journal.of("started")
    if not problem.resume:
        if begun:
            raise InputError(
                f"{journal.path} holds a run; go on with it by --resume, or choose another --out"
            )
        # One that tells of no more than what was on when it was to begin.
        _refuse_others(problem, journal.path.parent)
        journal.write("started", key=name, backend=problem.backend, cells=_cells(problem.files))
        return
    if not begun:
        raise InputError(f"{journal.path} holds no run to go on with; leave --resume out")
    if begun[0].get("key") != name:
        raise InputError(
            f"{journal.path} is of another configuration or backend; go on with the one it was "
            "begun with, or choose another --out"
        )
    latched = journal.latched
    if latched is not None and not problem.acknowledge:
        raise InputError(
            f"the run latched ({latched['interlock']}: {latched['reason']}); look at the rig, then "
            'go on with --resume --acknowledge "who, and what was done"'
        )
    if latched is None and problem.acknowledge:
        raise InputError("--acknowledge is given and nothing has latched; leave it out")
    if latched is not None:
        journal.write("acknowledged", text=problem.acknowledge, of=latched["line"])
    check_recordings(journal)
    journal.write("resumed")


def _cells(files: tuple[PlannedFile, ...]) -> int:
    return sum(len(one.cells) for one in files)


def _result(problem: RunProblem, journal: Lines, latch: AsperityError | None) -> RunResult:
    lines = tuple(line for line in journal.of("done") if "cell" in line)
    before, after = (
        np.array([line[level]["torque_steel"] for line in lines])
        for level in ("level_before", "level_with")
    )
    change = np.zeros(len(lines))
    np.divide(after - before, before, out=change, where=before != 0.0)
    return RunResult(
        lines=lines,
        latch=latch,
        backend=problem.backend,
        cells_planned=_cells(problem.files),
        cells_done=len(lines),
        recordings=len(journal.of("recording")),
        starts=len(journal.of("started")) + len(journal.of("resumed")),
        cell=np.array([line["cell"] for line in lines], dtype=int),
        frequency=np.array([line["frequency_Hz"] for line in lines], dtype=float),
        torque_before=before,
        torque_with=after,
        torque_change=100.0 * change,
        notes=tuple(_notes(problem, journal, latch)),
    )


def _notes(problem: RunProblem, journal: Lines, latch: AsperityError | None) -> list[str]:
    notes: list[str] = []
    if problem.backend == REPLAY:
        notes.append(f"played back from {plain(problem.recordings)}: no rig was run")
    if problem.backend == "sim":
        notes.append("simulated: no rig was run")
        mapped = problem.case.require(Channels).mapped()
        if absent := [name for name in mapped if name not in SIMULATED]:
            notes.append(f"nothing simulates {', '.join(absent)}: not recorded")
        notes.extend(standing(problem.case))
    if latch is not None:
        notes.append(
            f"latched: {latch}; nothing is switched on before a person acknowledges it: "
            '--resume --acknowledge "who, and what was done"'
        )
    parts: dict[str, Any] = {}
    for line in journal.of("recording"):
        parts.setdefault(line["file"], []).append(line["recording"])
    broken = {name: made for name, made in parts.items() if len(made) > 1}
    notes.extend(
        f"{name} is in {len(made)} parts: {', '.join(made)}" for name, made in broken.items()
    )
    return notes
