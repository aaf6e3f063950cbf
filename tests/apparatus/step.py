"""Solids read from STEP files, to prove those written."""

import os

import numpy as np

from asperity.flanks.export.cad.brep import Solid, check


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


def parts(shape, kind):
    """Yield the parts of a shape of a kind, such as ``FACE``."""
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer

    found = TopExp_Explorer(shape, getattr(TopAbs_ShapeEnum, f"TopAbs_{kind}"))
    while found.More():
        yield found.Current()
        found.Next()


def faces(shape):
    """Yield the faces of a shape."""
    from OCP.TopoDS import TopoDS

    return map(TopoDS.Face, parts(shape, "FACE"))


def sampled(shape, shares):
    """Yield points of each face that is a spline: at these shares of its two parameters."""
    from OCP.BRep import BRep_Tool
    from OCP.Geom import Geom_BSplineSurface

    for surface in map(BRep_Tool.Surface_s, faces(shape)):
        if isinstance(surface, Geom_BSplineSurface):
            u0, u1, v0, v1 = surface.Bounds()
            points = [
                surface.Value(u0 + a * (u1 - u0), v0 + b * (v1 - v0))
                for a in shares
                for b in shares
            ]
            yield np.array([(point.X(), point.Y(), point.Z()) for point in points])
