"""What samples the signals of a case, opened."""

from pathlib import Path

from asperity.casefile import Case
from asperity.tribometer.instruments.acquisition import Acquisition
from asperity.tribometer.instruments.protocols import Input, Scope


def opened_scope(case: Case, inputs: tuple[Input, ...]) -> Scope:
    """Return what samples, opened.

    Raises
    ------
    InstrumentError
        It is not there.
    MissingExtraError
        What speaks to it is not installed.
    """
    table = case.get(Acquisition, Acquisition())
    if table.device:
        from asperity.tribometer.instruments.nidaq import NiDaq

        return NiDaq(inputs, table.device, table.wiring)
    if table.folder:
        from asperity.tribometer.guardian.folder_scope import FolderScope

        return FolderScope(inputs, case.folder / Path(table.folder), table.late)
    from asperity.tribometer.instruments.picoscope import PicoScope

    return PicoScope(inputs, table.serial)
