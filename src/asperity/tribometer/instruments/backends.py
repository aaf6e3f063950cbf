"""The instruments of a configuration, by who makes them."""

from asperity.casefile import Case
from asperity.tribometer.channels import Channels
from asperity.tribometer.instruments.inputs import inputs_of, lines_of
from asperity.tribometer.instruments.manual import (
    ManualAccelerometer,
    ManualSupply,
    ManualTachometer,
    ManualVibration,
    Operator,
)
from asperity.tribometer.instruments.parameters import Controller, Supplies
from asperity.tribometer.instruments.protocols import Bench, Supply, VibrationDrive
from asperity.tribometer.parameters import Sonotrode

REPLAY = "replay"
BACKENDS = "sim", REPLAY, "hardware", "manual"
"""All of it simulated; a run played back; all that can be had as hardware; a PicoScope, and a
person for the rest."""


def open_bench(case: Case, backend: str) -> Bench:
    """Return the instruments of a configuration, each of which answers.

    Raises
    ------
    InputError
        The configuration lacks something, or nobody sits at a terminal.
    MissingExtraError
        A package or driver is not installed.
    InstrumentError
        An instrument does not answer.
    """
    channels, sonotrode = case.require(Channels), case.require(Sonotrode)
    inputs = inputs_of(channels, sonotrode)
    if backend == "sim":
        from asperity.tribometer.instruments.sim import simulated_bench
        from asperity.tribometer.twin.plant import Plant

        return simulated_bench(Plant.from_case(case), inputs, lines_of(channels, inputs))[0]
    from asperity.tribometer.instruments.picoscope import PicoScope

    person = Operator()
    vibration: VibrationDrive = ManualVibration(person)
    motors: dict[str, Supply] = {
        name: ManualSupply(person, f"supply of the {name} disc's motor")
        for name in ("steel", "bronze")
    }
    amplifier: Supply | None = None
    if backend == "hardware":
        if Controller.table in case:
            from asperity.tribometer.instruments.serial_vibration import SerialVibration

            vibration = SerialVibration(case.require(Controller))
        if Supplies.table in case:
            from asperity.tribometer.instruments.pymeasure_supply import open_supplies

            outputs: dict[str, Supply] = dict(open_supplies(case.require(Supplies)))
            amplifier = outputs.pop("amplifier", None)
            motors = outputs
    return Bench(
        scope=PicoScope(inputs),
        vibration=vibration,
        motors=motors,
        tachometer=ManualTachometer(person),
        person=person,
        amplifier=amplifier,
        accelerometer=ManualAccelerometer(person),
    )
