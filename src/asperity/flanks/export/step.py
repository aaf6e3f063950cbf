"""STEP files (ISO 10303-214, lengths in mm) of exact bodies, through Open CASCADE."""

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path

from asperity.errors import StorageError
from asperity.flanks.export.brep import Solid, solid
from asperity.flanks.export.extras import require_cad
from asperity.flanks.export.patch import Body
from asperity.store import write_atomically


def write_step(path: str | os.PathLike[str], body: Body) -> Solid:
    """Write a body as one closed solid, atomically; its name becomes the product's.

    Raises
    ------
    MissingExtraError
        The ``cad`` extra is not installed.
    ConvergenceError
        The body's faces do not close.
    """
    require_cad()
    from OCP.APIHeaderSection import APIHeaderSection_MakeHeader
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer
    from OCP.TCollection import TCollection_HAsciiString

    made = solid(body)

    def put(target: Path) -> None:
        # Open CASCADE does not say why it cannot write; this does.
        target.touch()
        with _settings(body.name):
            writer = STEPControl_Writer()
            writer.Transfer(made.shape, STEPControl_StepModelType.STEPControl_AsIs)
            header = APIHeaderSection_MakeHeader(writer.Model())
            header.SetName(TCollection_HAsciiString(body.name))
            header.SetOriginatingSystem(TCollection_HAsciiString("asperity"))
            for blank in (header.SetAuthorValue, header.SetOrganizationValue):
                blank(1, TCollection_HAsciiString(""))
            header.SetAuthorisation(TCollection_HAsciiString(""))
            if writer.Write(str(target)) != IFSelect_ReturnStatus.IFSelect_RetDone:
                raise StorageError(f"{path} cannot be written: no room left, perhaps")

    write_atomically(path, put)
    return made


@contextlib.contextmanager
def _settings(name: str) -> Iterator[None]:
    """Set what Open CASCADE keeps for the whole process, and put it back.

    It would also print what it does to standard output, where a command's answer belongs.
    """
    from OCP.Interface import Interface_Static
    from OCP.Message import Message
    from OCP.STEPControl import STEPControl_Controller

    # Before this the keys are unknown, and setting them is ignored without a word.
    STEPControl_Controller.Init_s()
    wanted = {
        "write.step.product.name": name,
        "write.step.schema": "AP214IS",
        "write.step.unit": "MM",
        "xstep.cascade.unit": "MM",
    }
    before = {key: Interface_Static.CVal_s(key) for key in wanted}
    messenger = Message.DefaultMessenger_s()
    printers = list(messenger.Printers())
    try:
        for key, value in wanted.items():
            Interface_Static.SetCVal_s(key, value)
        for printer in printers:
            messenger.RemovePrinter(printer)
        yield
    finally:
        for key, value in before.items():
            Interface_Static.SetCVal_s(key, value)
        for printer in printers:
            messenger.AddPrinter(printer)
