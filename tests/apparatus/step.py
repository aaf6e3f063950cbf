"""Solids read from STEP files, to prove those written."""

import os

from asperity.flanks.export.brep import Solid, check


def read_step(path):
    """Return the solid a STEP file holds, in mm, with its check."""
    from OCP.IFSelect import IFSelect_ReturnStatus
    from OCP.Interface import Interface_Static
    from OCP.STEPControl import STEPControl_Reader

    Interface_Static.SetCVal_s("xstep.cascade.unit", "MM")
    reader = STEPControl_Reader()
    assert reader.ReadFile(os.fspath(path)) == IFSelect_ReturnStatus.IFSelect_RetDone
    assert reader.TransferRoots()
    shape = reader.OneShape()
    return Solid("", shape, check(shape))
