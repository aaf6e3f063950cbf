"""The instruments of a rig together: made safe in one order, vibration off, then motors off."""

import contextlib
import dataclasses
from collections.abc import Callable, Mapping
from typing import TypeVar

from asperity.tribometer.instruments import off
from asperity.tribometer.instruments.off import Off
from asperity.tribometer.instruments.protocols import (
    Accelerometer,
    Clock,
    Instrument,
    InstrumentError,
    Listener,
    Memory,
    Person,
    Scope,
    Supply,
    Tachometer,
    VibrationDrive,
    WallClock,
)

T = TypeVar("T")


class MadeSafe(KeyboardInterrupt):
    """Ctrl-C that came while everything was made safe.

    Parameters
    ----------
    failures : tuple of str
        What could not be switched off.
    """

    def __init__(self, failures: tuple[str, ...]) -> None:
        super().__init__("interrupted")
        self.failures = failures


@dataclasses.dataclass(frozen=True)
class Bench:
    """The instruments of a rig together.

    Attributes
    ----------
    scope, vibration, tachometer : Scope, VibrationDrive, Tachometer
        One of each.
    motors : mapping of str to Supply
        Of the ``steel`` and the ``bronze`` disc.
    person : Person
        Who does what no instrument does.
    clock : Clock
        What time it is at the rig.
    amplifier : Supply, optional
        What feeds the vibration's amplifier: a second way to stop it.
    accelerometer : Accelerometer, optional
        For runs that measure the vibration's velocity.
    listener : Listener, optional
        Hears whether the drive signal moves.
    memory : Memory, optional
        Of a simulated rig.
    simulated : bool
        Whether what it measures comes from no rig.
    """

    scope: Scope
    vibration: VibrationDrive
    motors: Mapping[str, Supply]
    tachometer: Tachometer
    person: Person
    clock: Clock = dataclasses.field(default_factory=WallClock)
    amplifier: Supply | None = None
    accelerometer: Accelerometer | None = None
    listener: Listener | None = None
    memory: Memory | None = None
    simulated: bool = False

    @property
    def instruments(self) -> tuple[Instrument, ...]:
        """All of them, in the order in which they are made safe."""
        optional = self.amplifier, self.accelerometer
        known: tuple[Instrument | None, ...] = (
            self.vibration, optional[0], *self.motors.values(), self.scope, self.tachometer,
            optional[1],
        )  # fmt: skip
        return tuple(instrument for instrument in known if instrument is not None)

    def identities(self) -> dict[str, str]:
        """Return what each instrument says it is, by its name; raises InstrumentError."""
        return {one.name: one.identify() for one in self.instruments}

    def cause_of(self, error: BaseException) -> BaseException:
        """Return what an error comes from: itself, where nobody else switches anything off."""
        return error

    def safe(self) -> tuple[str, ...]:
        """Switch vibration off, then motors, then the rest, and read back that they are off.

        Returns
        -------
        tuple of str
            What was not read back to be off, and why; one failure keeps none of the others.

        Raises
        ------
        MadeSafe
            Ctrl-C came meanwhile, which turns to the next instrument and ends nothing.
        """
        left, pressed = list(self.instruments), 0
        failures: dict[str, str] = {}
        while left:
            try:
                _switch_off(left, failures)
            except KeyboardInterrupt:
                pressed += 1
                if pressed > len(self.instruments):
                    failures |= {instrument.name: "interrupted" for instrument in left}
                    break
                # Whatever it was at may hang: the others first.
                left.append(left.pop(0))
        # What was read back counts, whatever was answered to the command.
        for one in self.read_back():
            if one.proven:
                failures.pop(one.name, None)
            else:
                failures.setdefault(one.name, one.evidence)
        said = tuple(f"{name}: {why}" for name, why in failures.items())
        if pressed:
            raise MadeSafe(said)
        return said

    def begun(self) -> tuple[str, ...]:
        """Make everything safe as the first act of a run; returns as :meth:`safe`."""
        return self.safe()

    def read_back(self) -> tuple[Off, ...]:
        """Return of each output whether it was read back to be off."""
        amplifier = None if self.amplifier is None else _supply(self.amplifier)
        drive, ear = self.vibration, self.listener
        if drive.by_hand and ear is None:
            found = off.by_hand(drive.name)
        else:
            moves = None if ear is None else off.tried(ear.moves)
            found = off.drive_off(drive.name, off.tried(drive.vibrates), moves, amplifier)
        motors = tuple(map(_supply, self.motors.values()))
        return (found, *(() if amplifier is None else (amplifier,)), *motors)

    def waiting(self) -> contextlib.AbstractContextManager[None]:
        """Return what holds while a person is waited for, everything read back to be off."""
        return contextlib.nullcontext()

    def work(self, act: Callable[[], T]) -> T:
        """Return what a piece of work gives that takes its time, as a disk does."""
        return act()

    def close(self) -> None:
        """Let go of all of them."""
        for instrument in self.instruments:
            with contextlib.suppress(Exception):
                instrument.close()


def _supply(supply: Supply) -> Off:
    if supply.by_hand:
        return off.by_hand(supply.name)
    return off.supply_off(supply.name, off.tried(lambda: off.read_back(supply)))


def _switch_off(left: list[Instrument], failures: dict[str, str]) -> None:
    """Switch instruments off, in their order, and take those that are done off the list."""
    while left:
        try:
            left[0].safe()
        except (InstrumentError, OSError) as error:
            failures[left[0].name] = str(error)
        except Exception as error:  # of a driver, or our own: the motors must stop all the same
            failures[left[0].name] = f"{type(error).__name__}: {error}"
        left.pop(0)
