"""STEP files (ISO 10303-214, lengths in mm) of exact bodies, through Open CASCADE."""

import contextlib
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import StorageError
from asperity.files.store import write_atomically
from asperity.flanks.export.cad.brep import Solid, solid
from asperity.flanks.export.extras import require_cad
from asperity.flanks.export.patch import Body


@dataclass(frozen=True, eq=False)
class Component:
    """A solid in an assembly: where it stands, mm, and its colour, red, green and blue, 0 to 1."""

    solid: Solid
    rotation: FloatArray
    place: FloatArray
    colour: tuple[float, float, float]


def write_step(path: str | os.PathLike[str], body: Body | Solid) -> Solid:
    """Write a body as one closed solid, atomically; its name becomes the product's.

    Raises
    ------
    MissingExtraError
        The ``cad`` extra is not installed.
    ConvergenceError
        The body's faces do not close.
    """
    require_cad()
    from OCP.STEPControl import STEPControl_StepModelType, STEPControl_Writer

    made = solid(body) if isinstance(body, Body) else body
    with _settings(made.name):
        writer = STEPControl_Writer()
        writer.Transfer(made.shape, STEPControl_StepModelType.STEPControl_AsIs)
        _write(path, made.name, writer)
    return made


def write_assembly(
    path: str | os.PathLike[str], name: str, components: Sequence[Component]
) -> Path:
    """Write solids as parts of an assembly, each by its own name and where it stands, atomically.

    Raises
    ------
    MissingExtraError
        The ``cad`` extra is not installed.
    """
    require_cad()
    from OCP.STEPCAFControl import STEPCAFControl_Writer
    from OCP.STEPControl import STEPControl_StepModelType
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDocStd import TDocStd_Document

    document = TDocStd_Document(TCollection_ExtendedString("XmlOcaf"))
    _assemble(document, name, components)
    with _settings(name):
        writer = STEPCAFControl_Writer()
        writer.Transfer(document, STEPControl_StepModelType.STEPControl_AsIs)
        return _write(path, name, writer.ChangeWriter())


def _assemble(document: Any, name: str, components: Sequence[Component]) -> None:
    from OCP.gp import gp_Trsf
    from OCP.Quantity import Quantity_Color, Quantity_TypeOfColor
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name
    from OCP.TopLoc import TopLoc_Location
    from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool

    def call(label: Any, text: str) -> None:
        TDataStd_Name.Set_s(label, TCollection_ExtendedString(text, True))

    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())
    whole = shapes.NewShape()
    call(whole, name)
    for component in components:
        part = shapes.AddShape(component.solid.shape, False)
        call(part, component.solid.name)
        shade = Quantity_Color(*component.colour, Quantity_TypeOfColor.Quantity_TOC_sRGB)
        colours.SetColor(part, shade, XCAFDoc_ColorType.XCAFDoc_ColorSurf)
        moved = gp_Trsf()
        moved.SetValues(*map(float, np.column_stack([component.rotation, component.place]).flat))
        call(shapes.AddComponent(whole, part, TopLoc_Location(moved)), component.solid.name)
    shapes.UpdateAssemblies()


def _write(path: str | os.PathLike[str], name: str, writer: Any) -> Path:
    """Write what was transferred to a writer, with a header that names it."""
    from OCP.APIHeaderSection import APIHeaderSection_MakeHeader
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.TCollection import TCollection_HAsciiString

    def put(target: Path) -> None:
        # Open CASCADE does not say why it cannot write; this does.
        target.touch()
        header = APIHeaderSection_MakeHeader(writer.Model())
        header.SetName(TCollection_HAsciiString(name))
        header.SetOriginatingSystem(TCollection_HAsciiString("asperity"))
        for blank in (header.SetAuthorValue, header.SetOrganizationValue):
            blank(1, TCollection_HAsciiString(""))
        header.SetAuthorisation(TCollection_HAsciiString(""))
        if writer.Write(str(target)) != IFSelect_ReturnStatus.IFSelect_RetDone:
            raise StorageError(f"{path} cannot be written: no room left, perhaps")

    return write_atomically(path, put)


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
