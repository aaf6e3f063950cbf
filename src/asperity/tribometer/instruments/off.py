"""Off is what was read back: what proves of an output that it gives nothing."""

import dataclasses
from collections.abc import Callable
from typing import Any, TypeVar

from asperity.errors import AsperityError
from asperity.tribometer.instruments.protocols import Reading, Supply

STILL_CURRENT = 0.05  #: A, of an output that is off.
STILL_VOLTAGE = 0.5  #: V, of one that cannot be asked whether it is off.

T = TypeVar("T")


@dataclasses.dataclass(frozen=True)
class Off:
    """What was found of an output that should be off.

    Attributes
    ----------
    name : str
        Of the instrument.
    proven : bool
        Whether it was read back that it is off.
    evidence : str
        What was read back, or why nothing was.
    unheard : bool
        Whether nothing speaks against it, and it has yet to be listened to: what is proven so far
        is so by what it says of itself.
    on : bool
        Whether what was read says that it is on.
    """

    name: str
    proven: bool
    evidence: str
    unheard: bool = False
    on: bool = False

    def __str__(self) -> str:
        return f"{self.name}: {self.evidence}"


def tried(act: Callable[[], T]) -> T | Exception:
    """Return what something gives, or the error that it raises."""
    try:
        return act()
    except Exception as error:
        return error


def read_back(supply: Supply) -> tuple[bool | None, Reading]:
    """Ask a supply for its output's state and what it measures."""
    return supply.output(), supply.reading()


def supply_off(name: str, found: tuple[bool | None, Reading] | Exception) -> Off:
    """Judge what was read back of a supply.

    Parameters
    ----------
    name : str
        Of the supply.
    found : tuple or Exception
        What :func:`read_back` gave or raised.
    """
    if isinstance(found, Exception):
        return Off(name, False, said(found))
    on, given = found
    measured = _measured(given.current, "A")
    if given.current is None:
        state = {True: "on", False: "off", None: "not asked"}[on]
        return Off(name, False, f"not proven off: its state is {state}, {measured}", on=bool(on))
    if on:
        return Off(name, False, f"its output's state is on, {measured}", on=True)
    # Of a comparison with what is no number nothing is proven.
    still = abs(given.current) <= STILL_CURRENT
    flows = abs(given.current) > STILL_CURRENT
    if on is None:
        still = still and given.voltage is not None and abs(given.voltage) <= STILL_VOLTAGE
        volts = _measured(given.voltage, "V").removesuffix(" measured")
        told = f"its output's state cannot be asked, {volts}, {measured}"
        return Off(name, still, told, on=flows)
    return Off(name, still, f"its output's state is off, {measured}", on=flows)


def drive_state(drive: Any) -> bool | str | None:
    """Ask a drive whether it is on; returns what it said where that is all that tells of it."""
    state: bool | None = drive.vibrates()
    return state and (getattr(drive, "unlike_off", "") or state)


def _measured(value: float | None, unit: str) -> str:
    if value is None:
        return f"its {'voltage' if unit == 'V' else 'current'} cannot be measured"
    return f"{value:.3g} {unit} measured"


def drive_off(
    name: str,
    state: bool | str | Exception | None,
    moves: bool | Exception | None,
    amplifier: Off | None = None,
    *,
    moved: bool = False,
    ear: str = "",
) -> Off:
    """Judge what was read back of a drive.

    Who listens and hears nothing of it leaves it unproven, unless its amplifier has no power.

    Parameters
    ----------
    name : str
        Of the drive.
    state : bool, str or Exception, optional
        What it answers, asked whether it is on; a text: it is taken to be, by an answer that is not
        that of one which is off; None: it cannot be asked.
    moves : bool or Exception, optional
        Whether the drive signal is heard; None: nobody listens.
    amplifier : Off, optional
        What was found of its amplifier's supply.
    moved : bool
        Whether it moved when it was heard last, which nothing but listening takes back.
    ear : str
        With nothing heard yet: ``asked``, of one that has yet to answer; ``there``, of one that is
        not asked now.
    """
    told = []
    if isinstance(state, Exception):
        told.append(said(state))
    elif isinstance(state, str):
        told.append(f"it is taken to be on: {state}")
        state = True
    elif state is not None:
        told.append(f"its state is {'on' if state else 'off'}")
    if isinstance(moves, Exception):
        told.append(f"its signal is not heard: {said(moves)}")
    elif moves is not None:
        told.append(f"its signal {'moves' if moves else 'is still'}")
    if moved and not isinstance(moves, bool):
        told.append("its signal moved when it was heard last")
        return Off(name, False, ", ".join(told), on=True)
    if state is True or moves is True:
        return Off(name, False, ", ".join(told), on=True)
    if moves is False:
        return Off(name, True, ", ".join(told))
    if moves is None and ear and not isinstance(state, Exception):
        told.append("its signal is not yet heard")
    if moves is None and ear == "asked":
        return Off(name, False, ", ".join(told), unheard=not isinstance(state, Exception))
    if state is False and moves is None:
        return Off(name, True, ", ".join(told), unheard=bool(ear))
    if not isinstance(state, Exception) and amplifier is not None and amplifier.proven:
        told.append("its amplifier has no power")
        return Off(name, True, ", ".join(told), unheard=moves is None and bool(ear))
    if state is None and moves is None:
        told = ["its state cannot be asked", told[0] if ear else "nobody listens"]
        return Off(name, False, ", ".join(told) if ear else ", and ".join(told), unheard=True)
    return Off(name, False, ", ".join(told))


def by_hand(name: str) -> Off:
    """Return what is known of an output that a person was asked to switch off."""
    return Off(name, True, "a person says that it is off")


def said(error: BaseException) -> str:
    """Return what an error says in one line."""
    return str(error) if isinstance(error, AsperityError) else f"{type(error).__name__}: {error}"
