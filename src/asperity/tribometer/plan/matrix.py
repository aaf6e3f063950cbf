"""The cells of a test matrix, in files, in an order."""

import dataclasses
import itertools
from collections.abc import Iterator, Sequence

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError, nearest
from asperity.tribometer.options import Plan, Waveform
from asperity.tribometer.parameters import Limits

_MOST = 20_000
_LONGEST = 31.0 * 86400.0  # s


@dataclasses.dataclass(frozen=True)
class Cell:
    """A segment with its before: one frequency at one setting.

    Attributes
    ----------
    number : int
        From 1, in the order of the plan.
    frequency : float
        Of the vibration, Hz; 0: none, in a wear test.
    """

    number: int
    frequency: float


@dataclasses.dataclass(frozen=True)
class PlannedFile:
    """A recording: cells that differ in frequency alone.

    Attributes
    ----------
    number : int
        From 1, in the order of the plan.
    mode, lubricant, waveform : str
        How the rig stands and is driven.
    steel_supply : float
        V.
    repeat : int
        From 1.
    cells : tuple of Cell
        In their order.
    run : int
        Of a wear test, from 1: files of one run share their discs. 0: it is none.
    stretch : int
        Of the run, from 1.
    """

    number: int
    mode: str
    lubricant: str
    waveform: Waveform
    steel_supply: float
    repeat: int
    cells: tuple[Cell, ...]
    run: int = 0
    stretch: int = 0

    @property
    def name(self) -> str:
        """What its recording is called, without suffix."""
        return f"file-{self.number:02d}"

    @property
    def setting(self) -> tuple[str, str, str, int]:
        """What needs the rig rebuilt, cleaned or given new discs."""
        return self.mode, self.waveform, self.lubricant, self.run


def _excluded(plan: Plan) -> list[frozenset[str]]:
    known = (*plan.modes, *plan.lubricants, *plan.waveforms)
    found = []
    for text in plan.excluded:
        words = text.split()
        for word in words:
            if word not in known:
                raise InputError(
                    f"plan.excluded has {text!r}; {word!r} is no mode, lubricant or waveform of "
                    f"the plan{nearest(word, known)}"
                )
        if not words:
            raise InputError("plan.excluded has an empty text, which would leave out every cell")
        found.append(frozenset(words))
    return found


def check_plan(plan: Plan, limits: Limits) -> None:
    """Refuse a plan that the rig must not run.

    Raises
    ------
    InputError
        It has no cell, names a value twice, or lies beyond a limit.
    """
    for key in ("modes", "lubricants", "waveforms", "steel_supplies", "frequencies"):
        values = getattr(plan, key)
        if not values:
            raise InputError(f"plan.{key} is empty; a plan needs at least one")
        if len(set(values)) != len(values):
            raise InputError(f"plan.{key} names a value twice; give each once")
    for frequency in plan.frequencies:
        if not limits.lowest_frequency <= frequency <= limits.highest_frequency:
            raise InputError(
                f"plan.frequencies has {frequency:g} Hz; limits.lowest_frequency and "
                f"limits.highest_frequency allow {limits.lowest_frequency:g} to "
                f"{limits.highest_frequency:g} Hz"
            )
    for volts in plan.steel_supplies:
        if not 0.0 < volts <= limits.steel_supply:
            raise InputError(
                f"plan.steel_supplies has {volts:g} V; limits.steel_supply allows up to "
                f"{limits.steel_supply:g} V, and 0 V turns nothing"
            )
    if not 0.0 < plan.bronze_supply <= limits.bronze_supply:
        raise InputError(
            f"plan.bronze_supply is {plan.bronze_supply:g} V; limits.bronze_supply allows up to "
            f"{limits.bronze_supply:g} V, and 0 V turns nothing"
        )
    for key in ("before", "shaken"):
        if getattr(plan, key) <= 0.0:
            raise InputError(
                f"plan.{key} is 0 s; a cell needs a time before and one with vibration"
            )


def planned_files(plan: Plan, limits: Limits) -> tuple[PlannedFile, ...]:
    """Return the files of a plan in their order.

    The thesis's order keeps frequencies rising and settings as they are written. Randomised, the
    order within a setting is drawn: every repeat is a block that holds each supply once, and the
    frequencies of a file are in an order of its own. What needs the rig rebuilt keeps its place.

    Raises
    ------
    InputError
        As :func:`check_plan`, or everything is excluded.
    """
    check_plan(plan, limits)
    left_out = _excluded(plan)
    count = len(plan.steel_supplies) * plan.repeats * len(plan.frequencies)
    if plan.distance is not None:
        count = (count + plan.unshaken * count // len(plan.frequencies)) * plan.stretches
    rng = np.random.default_rng(plan.seed)
    files: list[PlannedFile] = []
    cells = itertools.count(1)
    for setting in itertools.product(plan.modes, plan.waveforms, plan.lubricants):
        if any(words <= set(setting) for words in left_out):
            continue
        if sum(len(one.cells) for one in files) + count > _MOST:
            raise InputError(
                f"the plan has more than {_MOST} cells; leave out values or lower plan.repeats"
            )
        for volts, repeat in _runs(plan, rng):
            frequencies = np.array(plan.frequencies)
            if plan.order == "randomised":
                frequencies = rng.permutation(frequencies)
            mode, waveform, lubricant = setting
            if plan.distance is not None:
                one = PlannedFile(0, mode, lubricant, waveform, volts, repeat, ())
                files += _worn(plan, one, frequencies, files, cells)
                continue
            made = tuple(Cell(next(cells), float(frequency)) for frequency in frequencies)
            number = len(files) + 1
            files.append(PlannedFile(number, mode, lubricant, waveform, volts, repeat, made))
    # A stretch of a distance takes as long as the discs do, which no plan knows.
    shaken = plan.shaken if plan.distance is None else 0.0
    seconds = sum(len(one.cells) for one in files) * (plan.before + shaken + plan.idle)
    if not seconds <= _LONGEST:
        raise InputError(
            f"the plan records for {seconds / 86400.0:.3g} days; at most {_LONGEST / 86400.0:g} "
            "days may be planned: look at plan.before, plan.shaken and plan.idle"
        )
    if not files:
        raise InputError("plan.excluded leaves out every cell; keep one")
    return tuple(files)


def _worn(
    plan: Plan,
    planned: PlannedFile,
    frequencies: FloatArray,
    earlier: Sequence[PlannedFile],
    cells: Iterator[int],
) -> list[PlannedFile]:
    """Return the files of a wear test at one supply: a run a frequency, a file a stretch."""
    made: list[PlannedFile] = []
    begun, first = len(earlier), earlier[-1].run + 1 if earlier else 1
    still = [0.0] if plan.unshaken else []
    for run, frequency in enumerate((*still, *frequencies.tolist()), start=first):
        for stretch in range(1, plan.stretches + 1):
            cell = Cell(next(cells), frequency)
            number = begun + len(made) + 1
            made.append(
                dataclasses.replace(planned, number=number, cells=(cell,), run=run, stretch=stretch)
            )
    return made


def _runs(plan: Plan, rng: np.random.Generator) -> list[tuple[float, int]]:
    """Supplies and repeats of one setting, in their order."""
    repeats = range(1, plan.repeats + 1)
    if plan.order == "thesis":
        return list(itertools.product(plan.steel_supplies, repeats))
    return [
        (float(volts), repeat)
        for repeat in repeats
        for volts in rng.permutation(np.array(plan.steel_supplies))
    ]
