"""The thirty-two steps of the procedure (thesis 6.4.12), in the order in which a plan needs them.

Read as they are printed, the steps contradict themselves; what is done here instead:

- Step 24 repeats step 10, which would fill oil upon oil. A lubricant is put in once for a setting
  and stays until step 27.
- Step 24 repeats step 12, which sets 1 V. Here step 12 sets the voltage of the file.
- Steps 28 to 31 repeat steps that say transverse and sinusoidal. Here they take the setting's
  direction and waveform.
- No step changes the lubricant. It is part of a setting, and each setting has new discs.
- Step 19 switches the motors off before the vibration. Here it is the vibration first, as when an
  interlock trips.
- A wear test weighs discs behind every stretch of its distance, and first behind the trial run,
  whose sliding nobody counts.
- Step 17 starts the motors before the recording. Here the recording starts first, so that every
  file holds the zeros of the sensors that step 14 asks for.
"""

import dataclasses
from collections.abc import Iterator, Sequence
from typing import Literal

from asperity.tribometer.parameters import LONGITUDINAL
from asperity.tribometer.plan.matrix import Cell, PlannedFile

Act = Literal["ask", "weigh", "arrange", "preload", "waveform", "trial", "rest", "cell", "save"]

STEPS = {
    1: "Wipe both discs clean with isopropyl alcohol.",
    2: "Weigh both discs.",
    3: "Install the discs; build the rig for {mode} vibration.",
    4: "Place the dead mass on the platform.",
    5: "Switch on mains, and the supplies of torque sensors, vibration control and load cell.",
    6: "Switch on the current clamps and the computer.",
    7: "Connect the instruments to the computer.",
    8: "Set the preload of the sonotrode.",
    9: "Set the waveform.",
    10: "Put in the lubricant.",
    11: "Cover the rig with its box.",
    12: "Set the supplies of the motors.",
    13: "Trial run: record, and switch the motors on for a while.",
    14: "See that the currents are zero while the motors are off.",
    15: "See that torques, speeds and currents change with the motors.",
    16: "Compare the speeds with a tachometer.",
    17: "Record; switch the motors on and let the discs run.",
    18: "Vibrate.",
    19: "Stop vibration and motors; wait.",
    20: "Switch the motors on again.",
    21: "Go on with the next frequency.",
    22: "Stop recording and save.",
    23: "Repeat for another set of data.",
    24: "Repeat at the next supply.",
    25: "Remove the discs.",
    26: "Wipe and weigh the discs again; store them.",
    27: "Draw the used oil out of the casing.",
    28: "Repeat with new discs for the next waveform.",
    29: "Build the rig for the other direction of vibration.",
    30: "Repeat with new discs.",
    31: "Repeat with new discs for the next waveform.",
    32: "Gather and reduce the data.",
}
"""By their number in the thesis, in our words."""

_LUBRICATE = {
    "grease": "Brush grease onto the rims of both discs.",
    "oil": "Fill the casing with 0.7 litres of oil.",
    "dry": "Leave the discs dry.",
}


@dataclasses.dataclass(frozen=True)
class Action:
    """Something that is done, and that a journal says was done.

    Attributes
    ----------
    key : str
        Its name in the journal.
    steps : tuple of int
        Of the procedure.
    act : str
        Which kind of doing.
    text : str
        What a person is told.
    file : PlannedFile or None
        What it belongs to.
    cell : Cell or None
        The same.
    """

    key: str
    steps: tuple[int, ...]
    act: Act
    text: str
    file: PlannedFile | None = None
    cell: Cell | None = None

    @property
    def asks(self) -> bool:
        """Whether a person does it, who takes time."""
        return self.act in ("ask", "weigh", "arrange")

    def __str__(self) -> str:
        if self.cell is None or self.file is None:
            return self.text.rstrip(".")
        one = self.file
        driven = f"{one.waveform} of {self.cell.frequency:g} Hz, {one.mode}"
        return (
            f"Cell {self.cell.number}: {driven if self.cell.frequency else 'no vibration'}, "
            f"{one.lubricant}, {one.steel_supply:g} V"
        )


_GEARED = {
    3: "Install worm and wheel; build the rig for {mode} vibration.",
    17: "Record; switch motor and brake on and let the gearset run.",
    25: "Remove worm and wheel.",
    30: "Repeat with a new worm and wheel.",
}
_NOT_GEARED = frozenset((1, 2, 4, 26))
"""Steps of discs alone: they are wiped, weighed and pressed together."""


def sequence(files: Sequence[PlannedFile], *, geared: bool = False) -> Iterator[Action]:
    """Yield everything a plan needs, in order.

    Parameters
    ----------
    files : sequence of PlannedFile
        Of the plan.
    geared : bool
        Whether a worm and its wheel stand in place of the discs.
    """
    for action in _sequence(files):
        if not geared:
            yield action
        elif not _NOT_GEARED.intersection(action.steps):
            (first, *_) = action.steps
            told = action.act in ("ask", "arrange", "rest") and first in _GEARED
            mode = action.file.mode if action.file is not None else ""
            text = _GEARED[first].format(mode=mode) if told else action.text
            yield dataclasses.replace(action, text=text)


def _sequence(files: Sequence[PlannedFile]) -> Iterator[Action]:
    for step in (5, 6, 7):
        yield Action(f"start/step-{step}", (step,), "ask", STEPS[step])
    before: PlannedFile | None = None
    number = 0
    for place, one in enumerate(files):
        new = before is None or one.setting != before.setting
        if new:
            if before is not None:
                yield from _leaving(f"setting-{number}", before)
            number += 1
            yield from _entering(f"setting-{number}", one, before)
        if one.stretch and not new:
            yield from _weighing(f"setting-{number}/stretch-{one.stretch}", one, 26)
        if before is None or new or one.steel_supply != before.steel_supply:
            yield Action(f"{one.name}/trial", (12, 13, 14, 15, 16), "trial", STEPS[13], one)
        if one.stretch and new:
            yield from _weighing(f"setting-{number}/stretch-{one.stretch}", one, 2)
        yield Action(f"{one.name}/rest", (17,), "rest", STEPS[17], one)
        for cell in one.cells:
            key = f"{one.name}/cell-{cell.number:03d}"
            yield Action(key, (17, 18, 19, 20), "cell", STEPS[18], one, cell)
        yield Action(f"{one.name}/save", (22,), "save", STEPS[22], one)
        before = one
        if place == len(files) - 1:
            yield from _leaving(f"setting-{number}", one)
    yield Action("end/step-32", (32,), "ask", STEPS[32])


def _entering(name: str, planned: PlannedFile, before: PlannedFile | None) -> Iterator[Action]:
    """What comes before the first file of a setting."""
    built = 29 if before is not None and planned.mode == LONGITUDINAL != before.mode else 3
    steps: tuple[tuple[int, Act, str], ...] = (
        (1, "ask", STEPS[1]),
        *(() if planned.stretch else ((2, "weigh", STEPS[2]),)),
        (built, "arrange", STEPS[3].format(mode=planned.mode)),
        (4, "ask", STEPS[4]),
        (8, "preload", STEPS[8]),
        (9, "waveform", STEPS[9]),
        (10, "ask", _LUBRICATE.get(planned.lubricant, STEPS[10])),
        (11, "ask", STEPS[11]),
    )
    for step, act, text in steps:
        yield Action(f"{name}/step-{step}", (step,), act, text, planned)


def _weighing(name: str, planned: PlannedFile, step: int) -> Iterator[Action]:
    """Take discs out and weigh them, between what nobody has counted the sliding of and what is."""
    yield Action(f"{name}/step-25", (25,), "ask", STEPS[25], planned)
    yield Action(f"{name}/step-{step}", (step,), "weigh", STEPS[2], planned)
    yield Action(f"{name}/step-3", (3,), "arrange", STEPS[3].format(mode=planned.mode), planned)
    yield Action(f"{name}/step-11", (11,), "ask", STEPS[11], planned)


def _leaving(name: str, planned: PlannedFile) -> Iterator[Action]:
    """What comes after the last file of a setting."""
    yield Action(f"{name}/step-25", (25,), "ask", STEPS[25], planned)
    yield Action(f"{name}/step-26", (26,), "weigh", STEPS[26], planned)
    if planned.lubricant == "oil":
        yield Action(f"{name}/step-27", (27,), "ask", STEPS[27], planned)


def file_of(action: Action) -> PlannedFile:
    """Return the file that an action is for, where it is for one."""
    if action.file is None:
        raise AssertionError
    return action.file
