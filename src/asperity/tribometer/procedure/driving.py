"""What is switched on and off while a recording runs, told to interlocks and preview."""

import functools
from collections.abc import Callable, Mapping

from asperity.tribometer.instruments.bench import Bench
from asperity.tribometer.options import Plan
from asperity.tribometer.plan.matrix import Cell, PlannedFile
from asperity.tribometer.procedure.interlock import Expected
from asperity.tribometer.procedure.logger import Logger


class Driving:
    """Motors and vibration of a bench, as the plan's steps switch them.

    Parameters
    ----------
    bench : Bench
        Its instruments.
    plan : Plan
        What they are to give.
    ran : callable
        Called before anything is switched on.
    on_switched : callable
        Takes what outputs were told, by their names.
    """

    def __init__(
        self,
        bench: Bench,
        plan: Plan,
        ran: Callable[[], None],
        on_switched: Callable[[Mapping[str, str]], None],
    ) -> None:
        self._bench, self._plan = bench, plan
        self._ran, self._on_switched = ran, on_switched

    def energise(self, logger: Logger, planned: PlannedFile) -> None:
        """Switch the motors on."""
        volts = {"steel": planned.steel_supply, "bronze": self._plan.bronze_supply}
        self._ran()
        for name, supply in self._bench.motors.items():
            logger.during(supply, functools.partial(supply.set, volts[name]))
        for name, supply in self._bench.motors.items():
            logger.during(supply, supply.on)
            logger.event(f"{name}_supply", f"{volts[name]:g} V")
        logger.expect(Expected(volts=volts))

    def configure(self, logger: Logger, planned: PlannedFile, cell: Cell) -> None:
        """Tell the drive what it is to give."""
        drive = self._bench.vibration
        logger.during(drive, lambda: drive.configure(planned.waveform, cell.frequency))

    def shake(self, logger: Logger, planned: PlannedFile, cell: Cell) -> None:
        """Switch the vibration on."""
        drive, amplifier = self._bench.vibration, self._bench.amplifier
        if amplifier is not None:
            # Made safe, it is off.
            amplifier.on()
            self._on_switched({amplifier.name: "on"})
        logger.during(drive, drive.on)
        logger.expect(Expected(cell.frequency, planned.waveform, logger.expected.volts))
        logger.event("vibration", f"{planned.waveform} {cell.frequency:g} Hz")

    def still(self, logger: Logger) -> None:
        """Switch vibration off, then motors off."""
        if logger.expected.frequency:
            logger.during(self._bench.vibration, self._bench.vibration.off)
            logger.event("vibration", "off")
        if logger.expected.volts:
            for name, supply in self._bench.motors.items():
                logger.during(supply, supply.off)
                logger.event(f"{name}_supply", "off")
        logger.expect(Expected())
