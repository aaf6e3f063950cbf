"""The signals of a rig: what each is called, its unit, and how sure its channel is calibrated."""

import dataclasses
from collections.abc import Mapping


@dataclasses.dataclass(frozen=True)
class Signal:
    """Something a rig measures.

    Attributes
    ----------
    name : str
        As in ``[channels]`` and in recordings.
    unit : str
        SI.
    meaning : str
        In words.
    example : str
        A value in a unit that a laboratory uses.
    """

    name: str
    unit: str
    meaning: str
    example: str

    @property
    def unit_in_text(self) -> str:
        """The unit as it is written in a sentence or at an axis."""
        return self.unit.replace("**", "")


SIGNALS: Mapping[str, Signal] = {
    signal.name: signal
    for signal in (
        Signal("torque_steel", "N m", "torque of the steel disc's shaft", "0.6 N m"),
        Signal("torque_bronze", "N m", "torque of the bronze disc's shaft", "0.6 N m"),
        Signal("speed_steel", "rad/s", "speed of the steel disc's motor", "1500 rpm"),
        Signal("speed_bronze", "rad/s", "speed of the bronze disc's motor", "75 rpm"),
        Signal("drive_voltage", "V", "drive signal of the vibration", "1 V"),
        Signal("load_cell", "V", "load cell of the sonotrode", "14 mV"),
        Signal("current_steel", "A", "current of the steel disc's motor", "2 A"),
        Signal("current_bronze", "A", "current of the bronze disc's motor", "0.8 A"),
        Signal("acceleration", "m/s**2", "acceleration of the shaken disc", "100 m/s**2"),
        Signal("acceleration_2", "m/s**2", "acceleration by a second sensor", "100 m/s**2"),
        Signal("acceleration_3", "m/s**2", "acceleration by a third sensor", "100 m/s**2"),
        Signal("temperature", "K", "temperature of the lubricant or a disc", "25 degC"),
        Signal("temperature_2", "K", "temperature at a second place", "25 degC"),
        Signal("normal_force", "N", "force between the discs", "140 N"),
    )
}
"""In the order in which recordings hold them."""

WATCHED = tuple(SIGNALS)[:8]
"""The eight signals of the rig, without which no procedure runs."""

SIMULATED = (*WATCHED, "acceleration")
"""Those of the simulated rig."""

NEEDED = ("torque_steel", "speed_steel", "speed_bronze", "drive_voltage")
"""Those without which a recording cannot be reduced."""
