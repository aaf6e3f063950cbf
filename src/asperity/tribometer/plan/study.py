"""The command ``asperity rig plan``: lay out a series of tests."""

import dataclasses

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.errors import InputError
from asperity.runs import Run
from asperity.tribometer.options import Plan, Reduction, Twin
from asperity.tribometer.pairs import pair_of
from asperity.tribometer.parameters import Limits
from asperity.tribometer.plan.matrix import PlannedFile, planned_files
from asperity.tribometer.plan.result import PlanResult
from asperity.tribometer.twin.chain import peak_current
from asperity.tribometer.twin.plant import Plant
from asperity.tribometer.twin.plants import plant_of

# Velocity ratios from which a friction law is identified best.
_TELLING = 1.5, 4.0
_ENOUGH_TURNS = 2.0
_EDGES = 0.2  # s
_OF_SPEED = 1.0  # s in which speeds have settled, at least


@dataclasses.dataclass(frozen=True)
class PlanProblem:
    """A plan that may be run.

    Attributes
    ----------
    plan : Plan
        The table.
    files : tuple of PlannedFile
        In their order.
    plant : Plant or None
        The simulated rig, where the configuration has one.
    warnings : tuple of str
        Of what will go wrong.
    reduction : Reduction
        How recordings will be reduced.
    """

    plan: Plan
    files: tuple[PlannedFile, ...]
    plant: Plant | None
    warnings: tuple[str, ...]
    reduction: Reduction

    def named(self, text: str) -> str:
        """Return a sentence of the discs as it is of what the rig has."""
        return text if self.plant is None else self.plant.pair.named(text)


def prepare(case: Case) -> PlanProblem:
    """Lay out a plan; refuses one beyond its limits."""
    limits = case.get(Limits, Limits())
    plan = case.require(Plan)
    check_wear(case)
    plant = plant_of(case) if Twin.table in case else None
    return PlanProblem(
        plan, planned_files(plan, limits), plant, tuple(warnings(case)),
        case.get(Reduction, Reduction()),
    )  # fmt: skip


def check_wear(case: Case) -> None:
    """Refuse a wear test of what is not weighed.

    Raises
    ------
    InputError
        The rig is a worm and its wheel.
    """
    if case.require(Plan).distance is not None and pair_of(case).geared:
        raise InputError(
            "plan.distance is of discs, which are weighed; of a worm and its wheel leave it out"
        )


def warnings(case: Case) -> list[str]:
    """Return what will go wrong with a plan that may be run, to be said before it is."""
    given = case.get(Reduction, Reduction())
    found = _too_brief(case.require(Plan), given)
    if Twin.table in case:
        limits = case.get(Limits, Limits())
        starting = plant_of(case).starting_torque
        if limits.torque < starting:
            found.append(
                f"limits.torque is {limits.torque:g} N m, below the {starting:.2g} N m of the "
                "simulated rig's discs as they start: a run can latch there"
            )
    return found


def _too_brief(plan: Plan, options: Reduction) -> list[str]:
    """Return what a plan's own reduction will refuse or doubt, for windows that are too short."""
    found = []
    least, counted = options.settling + options.least_window, options.speed_settling + _OF_SPEED
    if short := _shorter(plan, _EDGES + least):
        found.append(
            f"{short}: when reduction.settling = {options.settling:g} s is left out, rig reduce "
            f"refuses what is shorter than reduction.least_window = {options.least_window:g} s"
        )
    elif short := _shorter(plan, _EDGES + counted):
        found.append(
            f"{short}: speeds need reduction.speed_settling = {options.speed_settling:g} s, and "
            "rig reduce takes them before that"
        )
    return found


def _shorter(plan: Plan, least: float) -> str:
    return "; ".join(
        f"plan.{key} is {getattr(plan, key):g} s, which should be {least:g} s or more"
        for key in ("before", "shaken")
        if getattr(plan, key) < least and (key != "shaken" or plan.distance is None)
    )


def answer(problem: PlanProblem, run: Run) -> PlanResult:
    """Return the plan and what it will not resolve."""
    plan, files = problem.plan, problem.files
    pairs = [(one, cell) for one in files for cell in one.cells]
    expected = _expected(problem)
    ratio, steel, bronze = expected if expected is not None else (None, None, None)
    if ratio is not None and not np.all(np.isfinite(ratio)):
        ratio = None  # of some frequencies no velocity is known
    return PlanResult(
        planned=files,
        order=plan.order,
        file_count=len(files),
        cell_count=len(pairs),
        distinct_cells=len(pairs) // plan.repeats,
        settings=len({one.setting for one in files}),
        recording_time=_recorded(problem),
        frequency=np.array([cell.frequency for _, cell in pairs]),
        steel_supply=np.array([one.steel_supply for one, _ in pairs]),
        file_number=np.array([one.number for one, _ in pairs]),
        mode=np.array([one.mode for one, _ in pairs]),
        lubricant=np.array([one.lubricant for one, _ in pairs]),
        waveform=np.array([one.waveform for one, _ in pairs]),
        repeat=np.array([one.repeat for one, _ in pairs]),
        velocity_ratio=ratio,
        steel_turns=steel,
        bronze_turns=bronze,
        notes=tuple(map(problem.named, _notes(problem, expected))),
    )


def _recorded(problem: PlanProblem) -> float | None:
    """Time that is recorded, s; of a wear test as the simulated rig slides, where there is one."""
    plan = problem.plan
    cells = sum(len(one.cells) for one in problem.files)
    if plan.distance is None:
        return cells * (plan.before + plan.shaken + plan.idle)
    if problem.plant is None:
        return None
    seconds = cells * plan.idle
    for one in problem.files:
        for cell in one.cells:
            friction = problem.plant.friction(one.waveform, cell.frequency, mode=one.mode)
            state = problem.plant.steady(one.steel_supply, plan.bronze_supply, friction)
            seconds += plan.distance / plan.stretches / abs(state.sliding)
    return seconds


Expected = tuple[FloatArray, FloatArray, FloatArray]


def _expected(problem: PlanProblem) -> Expected | None:
    """Velocity ratio and turns of both discs before the vibration, of each cell."""
    plant, plan = problem.plant, problem.plan
    if plant is None:
        return None
    rows = []
    states = {
        volts: plant.steady(volts, plan.bronze_supply, plant.friction())
        for volts in plan.steel_supplies
    }
    for one in problem.files:
        state = states[one.steel_supply]
        turns = plan.before / (2.0 * np.pi)
        for cell in one.cells:
            shaken = plant.sonotrode.velocity(one.mode, cell.frequency) if cell.frequency else 0.0
            rows.append(
                (
                    np.nan if shaken is None or not state.sliding else shaken / state.sliding,
                    turns * state.steel / plant.steel.ratio,
                    turns * state.bronze / plant.bronze.ratio,
                )
            )
    ratio, steel, bronze = np.array(rows).T
    return np.abs(ratio), steel, bronze


def _notes(problem: PlanProblem, expected: Expected | None) -> list[str]:
    plan = problem.plan
    notes = list(problem.warnings)
    if expected is not None:
        ratio, steel, bronze = expected
        for volts in plan.steel_supplies:
            here = [one.steel_supply == volts for one in problem.files for _ in one.cells]
            turns = float(steel[here][0]), float(bronze[here][0])
            if min(turns) < _ENOUGH_TURNS:
                notes.append(
                    f"at {volts:g} V a window of {plan.before:g} s sees {turns[0]:.2g} turns of "
                    f"the steel disc and {turns[1]:.2g} of the bronze one: run-out is a bias "
                    "there, not noise"
                )
        known = ratio[np.isfinite(ratio)]
        telling = int(np.count_nonzero((known >= _TELLING[0]) & (known <= _TELLING[1])))
        if telling < 0.1 * known.size or not telling:
            notes.append(
                f"{telling} of {known.size} cells have k between {_TELLING[0]:g} and "
                f"{_TELLING[1]:g}, where the law's parameters are told apart best: they lie at "
                + ", ".join(f"{value:.2g}" for value in _some(known))
            )
        geared = problem.plant is not None and problem.plant.pair.geared
        notes.append(
            "turns and k are those of the simulated rig, "
            + (
                "whose teeth are a drive of the same case, and whose motor is of no rig that stands"
                if geared
                else "whose motors and friction are fitted to a few published figures and whose "
                "other parameters are placeholders"
            )
        )
    if problem.plant is not None and problem.plant.sonotrode.current_limit is None:
        fastest = max(plan.frequencies)
        current = peak_current(problem.plant.sonotrode, fastest)
        if current is not None:
            notes.append(
                f"a full sine of {fastest:g} Hz takes {current:.3g} A of the amplifier, and no "
                "sonotrode.current_limit is given: what it caps is not seen"
            )
    if problem.plant is not None and problem.plant.sonotrode.frequencies:
        known_at = problem.plant.sonotrode.frequencies
        between = [one for one in plan.frequencies if one not in known_at]
        if between:
            notes.append(
                f"v_a at {', '.join(f'{one:g}' for one in between)} Hz is interpolated between "
                "sonotrode.frequencies"
            )
    notes.append(
        "no run with the discs apart is planned: the bearings' torque stays in every torque"
    )
    notes.append("no temperature is recorded: drift of the oil's film stays in the changes")
    if plan.order == "thesis" and len(plan.frequencies) > 1:
        notes.append(
            "in every file the frequencies come in the same order, so that drift and frequency are "
            "confounded; plan.order = 'randomised' tells them apart"
        )
    if plan.distance is not None:
        notes += _of_wear(problem)
    if plan.repeats < 2:
        notes.append("each cell is run once: what repeats differ by cannot be told")
    return notes


def _of_wear(problem: PlanProblem) -> list[str]:
    plan, notes = problem.plan, []
    if problem.reduction.weighing_uncertainty is None and plan.stretches < 2:
        notes.append(
            "a wear rate has no interval where a run is weighed before and after only: give "
            "reduction.weighing_uncertainty, or plan.stretches of 2 or more"
        )
    if not plan.unshaken:
        notes.append("no run without vibration is planned: what vibration adds cannot be told")
    return notes


def _some(values: FloatArray) -> FloatArray:
    found: FloatArray = np.unique(np.round(values, 2))
    return found if found.size <= 8 else np.quantile(found, np.linspace(0.0, 1.0, 8))
