"""The inputs of the oscilloscope that a configuration asks for."""

from asperity.errors import InputError
from asperity.tribometer.calibration import Line
from asperity.tribometer.channels import Channels
from asperity.tribometer.instruments.picoscope import RANGES, smallest_range
from asperity.tribometer.instruments.protocols import FULL_SCALE, Input
from asperity.tribometer.parameters import Sonotrode
from asperity.tribometer.signals import SIGNALS, SIMULATED, WATCHED

# A load cell rides on its preload, and a drive signal on its middle.
_MARGIN = 2.0


def inputs_of(
    channels: Channels,
    sonotrode: Sonotrode,
    ranges: tuple[float, ...] = RANGES,
    *,
    letters: bool = True,
) -> tuple[Input, ...]:
    """Return inputs in the order of recordings, each with the smallest range that holds its signal.

    Parameters
    ----------
    channels : Channels
        What is mapped.
    sonotrode : Sonotrode
        Whose drive signal it is.
    ranges : tuple of float
        That an input may have, V, either side of zero.
    letters : bool
        Whether channels are letters on a housing, and no names.

    Raises
    ------
    InputError
        A signal is not mapped or has no calibration, without which its range is not known.
    """
    found = []
    for name, channel in channels.mapped().items():
        if channel.points:
            volts = max(abs(put) for put, _ in channel.points)
        elif name == "drive_voltage":
            ends = sonotrode.lowest_voltage, sonotrode.highest_voltage
            volts = max(map(abs, ends)) / sonotrode.amplifier_gain
        elif name == "load_cell":
            volts = _MARGIN * abs(sonotrode.preload_voltage) or 0.01
        else:
            raise InputError(
                f"channels.{name}.points is missing; a signal that is recorded live needs its "
                f'calibration, such as [["0 V", "0"], ["1 V", "{SIGNALS[name].example}"]]'
            )
        try:
            most = smallest_range(volts, ranges)
        except InputError as error:
            raise InputError(
                f"channels.{name}: {error}; put a divider before it, and its volts into points"
            ) from None
        called = channel.channel.strip()
        found.append(Input(called.upper() if letters else called, name, most))
    there = {one.signal for one in found}
    missing = [name for name in WATCHED if name not in there]
    if missing:
        raise InputError(
            f"channels.{missing[0]} is missing; a procedure watches the eight signals of the rig"
        )
    return tuple(found)


def simulated_of(inputs: tuple[Input, ...]) -> tuple[Input, ...]:
    """Return those of some inputs that a simulated rig has something for."""
    return tuple(one for one in inputs if one.signal in SIMULATED)


def lines_of(channels: Channels, inputs: tuple[Input, ...]) -> tuple[Line, ...]:
    """Return what the volts of each input mean."""
    mapped = channels.mapped()
    return tuple(mapped[one.signal].line() for one in inputs)


def volts_a_count(channel: Input) -> float:
    """Return what a count of an input is worth, V."""
    return channel.range / FULL_SCALE
