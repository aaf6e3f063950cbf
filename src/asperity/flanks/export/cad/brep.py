"""Solids of smooth patches through Open CASCADE: faces, sewing, checks.

No solid is cut from another, but for keyways: every face is a spline surface through exact points
or a plane, and faces that meet have the same curve there.
"""

import dataclasses
import functools
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError
from asperity.flanks.export.extras import require_cad
from asperity.flanks.export.patch import Body, Patch

SEWING_TOLERANCE = 1e-6
"""Distance in mm at which two edges are one; edges that meet differ by rounding."""

_INTEGRATION = 1e-9


@dataclass(frozen=True, eq=False)
class Check:
    """What is known of a solid. Free edges do not join exactly two faces: a closed one has none."""

    valid: bool
    free_edges: int
    faces: int
    shape: Any

    @functools.cached_property
    def volume(self) -> float:
        """Volume in mm^3, positive where its outside is outside."""
        from OCP.BRepGProp import BRepGProp

        return self._sum(BRepGProp.VolumeProperties_s)

    @functools.cached_property
    def area(self) -> float:
        """Area in mm^2."""
        from OCP.BRepGProp import BRepGProp

        return self._sum(BRepGProp.SurfaceProperties_s)

    def _sum(self, integrate: Callable[..., Any]) -> float:
        from OCP.GProp import GProp_GProps

        found = GProp_GProps()
        # Without a bound on its error the integration is slower and less exact.
        integrate(self.shape, found, _INTEGRATION)
        return float(found.Mass())


@dataclass(frozen=True)
class Solid:
    """A solid as Open CASCADE knows it, what it is called, and what was found when it was made."""

    name: str
    shape: Any
    check: Check


def solid(body: Body) -> Solid:
    """Return a body as a closed solid with its outside outside.

    Raises
    ------
    ConvergenceError
        The faces do not close, or the solid is not valid.
    """
    apart = [each for each in body.turned if body.patches and each[0][0] == each[-1][0] == 0.0]
    if apart:
        # A shaft thicker than the root of the threads it begins at.
        rest = [each for each in body.turned if not any(each is one for one in apart)]
        made = solid(dataclasses.replace(body, turned=rest))
        return _fused(made, [solid(Body(body.name, [], [], [each])) for each in apart])
    require_cad()
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeSolid, BRepBuilderAPI_Sewing
    from OCP.BRepLib import BRepLib
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    # Edges that meet are equal from end to end: none has to be cut, and looking for where to cut
    # takes most of the time.
    sewing = BRepBuilderAPI_Sewing(SEWING_TOLERANCE, option3=False)
    for patch in body.patches:
        sewing.Add(_face(patch))
    for ring in body.rings:
        sewing.Add(_cap(ring, body.hole(ring)))
    for section in body.turned:
        sewing.Add(_revolved(section))
    sewing.Perform()
    shells = TopExp_Explorer(sewing.SewedShape(), TopAbs_ShapeEnum.TopAbs_SHELL)
    count = len(body.patches) + len(body.rings) + sum(len(each) - 1 for each in body.turned)
    if not shells.More():
        raise ConvergenceError(f"the {body.name}'s faces do not join", reached={"faces": count})
    shape = BRepBuilderAPI_MakeSolid(TopoDS.Shell(shells.Current())).Solid()
    BRepLib.OrientClosedSolid_s(shape)
    found = check(shape)
    if not found.valid or found.free_edges or found.faces != count:
        raise ConvergenceError(
            f"the {body.name}'s {count} faces do not close to one valid solid: "
            f"{found.faces} join and leave {found.free_edges} free edges",
            reached={"free_edges": found.free_edges, "faces": found.faces},
        )
    return Solid(body.name, shape, found)


def _fused(made: Solid, others: Sequence[Solid]) -> Solid:
    """Return one solid of several that touch; raises ConvergenceError where there is none."""
    from OCP.BRepAlgoAPI import BRepAlgoAPI_Fuse
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    shape = made.shape
    for other in others:
        found = TopExp_Explorer(
            BRepAlgoAPI_Fuse(shape, other.shape).Shape(), TopAbs_ShapeEnum.TopAbs_SOLID
        )
        if not found.More():
            raise ConvergenceError(f"the {made.name} and its shaft do not join")
        shape = TopoDS.Solid(found.Current())
    seen = check(shape)
    if not seen.valid or seen.free_edges:
        raise ConvergenceError(f"the {made.name} and its shaft do not join to a valid solid")
    return Solid(made.name, shape, seen)


def check(shape: Any) -> Check:
    """Return what is known of a solid, whether made or read."""
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.collections import (
        IndexedDataMap_TopoDS_Shape_List_TopoDS_Shape_TopTools_ShapeMapHasher as OwnerMap,
    )
    from OCP.collections import IndexedMap_TopoDS_Shape_TopTools_ShapeMapHasher as ShapeMap
    from OCP.TopAbs import TopAbs_ShapeEnum
    from OCP.TopExp import TopExp

    owners, faces = OwnerMap(), ShapeMap()
    edge, face = TopAbs_ShapeEnum.TopAbs_EDGE, TopAbs_ShapeEnum.TopAbs_FACE
    TopExp.MapShapesAndAncestors_s(shape, edge, face, owners)
    TopExp.MapShapes_s(shape, face, faces)
    free = sum(owners.FindFromIndex(index).Size() != 2 for index in range(1, owners.Extent() + 1))
    return Check(
        valid=bool(BRepCheck_Analyzer(shape).IsValid()),
        free_edges=free,
        faces=faces.Extent(),
        shape=shape,
    )


def _face(patch: Patch) -> Any:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeFace
    from OCP.collections import Array2_gp_Pnt
    from OCP.Geom import Geom_BSplineSurface
    from OCP.gp import gp_Pnt

    poles, *knots = patch.spline()
    array = Array2_gp_Pnt(1, poles.shape[0], 1, poles.shape[1])
    for i, row in enumerate(poles.tolist(), 1):
        for j, pole in enumerate(row, 1):
            array.SetValue(i, j, gp_Pnt(*pole))
    (first, times), (second, more) = map(_knots, knots)
    surface = Geom_BSplineSurface(array, first, second, times, more, *patch.degrees)
    return BRepBuilderAPI_MakeFace(surface, SEWING_TOLERANCE).Face()


def _cap(ring: Sequence[FloatArray], hole: float | None) -> Any:
    from OCP.BRepBuilderAPI import (
        BRepBuilderAPI_MakeEdge,
        BRepBuilderAPI_MakeFace,
        BRepBuilderAPI_MakeWire,
    )
    from OCP.collections import Array1_gp_Pnt
    from OCP.Geom import Geom_BSplineCurve
    from OCP.gp import gp_Ax2, gp_Circ, gp_Dir, gp_Pnt
    from OCP.TopoDS import TopoDS

    wire = BRepBuilderAPI_MakeWire()
    for row in ring:
        curve = Patch(np.stack([row, row]))
        poles, _, knots = curve.spline()
        array = Array1_gp_Pnt(1, len(row))
        for number, pole in enumerate(poles[0].tolist(), 1):
            array.SetValue(number, gp_Pnt(*pole))
        spline = Geom_BSplineCurve(array, *_knots(knots), curve.degrees[1])
        wire.Add(BRepBuilderAPI_MakeEdge(spline).Edge())
    face = BRepBuilderAPI_MakeFace(wire.Wire(), True)
    if hole is not None:
        middle, up = gp_Pnt(0.0, 0.0, float(ring[0][0, 2])), gp_Dir(0.0, 0.0, 1.0)
        circle = gp_Circ(gp_Ax2(middle, up, gp_Dir(1.0, 0.0, 0.0)), hole)
        inside = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(circle).Edge()).Wire()
        face.Add(inside if _downwards(face.Face()) else TopoDS.Wire(inside.Reversed()))
    return face.Face()


def _downwards(face: Any) -> bool:
    """Whether the normal of a plane face points against the z axis."""
    from OCP.BRepAdaptor import BRepAdaptor_Surface
    from OCP.TopAbs import TopAbs_Orientation

    plane = BRepAdaptor_Surface(face).Plane().Axis().Direction().Z()
    return bool(plane < 0.0) != bool(face.Orientation() == TopAbs_Orientation.TopAbs_REVERSED)


def _revolved(section: FloatArray) -> Any:
    from OCP.BRepBuilderAPI import BRepBuilderAPI_MakePolygon
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeRevol
    from OCP.gp import gp_Ax1, gp_Dir, gp_Pnt

    line = BRepBuilderAPI_MakePolygon()
    for radius, z in section.tolist():
        line.Add(gp_Pnt(radius, 0.0, z))
    axis = gp_Ax1(gp_Pnt(0.0, 0.0, 0.0), gp_Dir(0.0, 0.0, 1.0))
    return BRepPrimAPI_MakeRevol(line.Wire(), axis).Shape()


def _knots(knots: FloatArray) -> tuple[Any, Any]:
    from OCP.collections import Array1_double, Array1_int

    places, counts = np.unique(knots, return_counts=True)
    values, times = Array1_double(1, len(places)), Array1_int(1, len(places))
    for number, (place, count) in enumerate(zip(places.tolist(), counts.tolist(), strict=True), 1):
        values.SetValue(number, place)
        times.SetValue(number, count)
    return values, times
