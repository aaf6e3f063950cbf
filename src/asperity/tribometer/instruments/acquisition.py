"""The ``[scope]`` table: what samples the signals, and the inputs it has for them."""

from typing import Annotated, ClassVar, Literal

from pydantic import model_validator

from asperity.casefile import Case, Table
from asperity.errors import InputError
from asperity.tribometer.channels import Channels
from asperity.tribometer.instruments.inputs import inputs_of
from asperity.tribometer.instruments.protocols import Input
from asperity.tribometer.parameters import Sonotrode
from asperity.units import Quantity

NI_RANGES = 0.2, 0.5, 1.0, 2.0, 5.0, 10.0
"""V, those that NI-DAQmx devices have; the device takes the next that it has itself."""


class Acquisition(Table):
    """What samples the signals: a PicoScope 4824 unless something else is said.

    Parameters
    ----------
    device : str
        An NI-DAQmx device in place of it, by its name in the maker's program, such as ``Dev1``;
        channels are then called ``ai0`` and so on.
    wiring : {'default', 'differential', 'rse', 'nrse'}
        Of its inputs.
    folder : str
        A folder in place of it, into which a program writes files while it samples, in any of the
        formats that are imported; channels are then the headings of the files.
    late : float or str
        How late what is written into the folder may be, s; interlocks are as late.
    serial : str
        Of the PicoScope, where there are several.
    """

    table: ClassVar[str] = "scope"

    device: str = ""
    wiring: Literal["default", "differential", "rse", "nrse"] = "default"
    folder: str = ""
    late: Annotated[float, Quantity("s", what="a time", example="2 s", ge=0.2, le=60)] = 2.0
    serial: str = ""

    @model_validator(mode="after")
    def _one(self) -> "Acquisition":
        given = [key for key in ("device", "folder", "serial") if getattr(self, key)]
        if len(given) > 1:
            raise InputError(
                f"scope.{given[0]} and scope.{given[1]} are given; keep one of them: an NI-DAQmx "
                "device, a folder that is watched, or a PicoScope's serial number"
            )
        return self

    @property
    def name(self) -> str:
        """What messages call it."""
        if self.device:
            return f"NI-DAQmx {self.device}"
        return f"folder {self.folder}" if self.folder else "PicoScope"

    def deadline(self, due: float) -> float:
        """Return how long a poll may take, s, where an instrument may take a time."""
        return max(due, self.late) if self.folder else due


def inputs_for(case: Case) -> tuple[Input, ...]:
    """Return the inputs that a case asks for, as its device has them.

    Raises
    ------
    InputError
        A signal is not mapped or has no calibration.
    """
    table = case.get(Acquisition, Acquisition())
    channels, sonotrode = case.require(Channels), case.require(Sonotrode)
    if table.device:
        return inputs_of(channels, sonotrode, NI_RANGES, letters=False)
    return inputs_of(channels, sonotrode, letters=not table.folder)
