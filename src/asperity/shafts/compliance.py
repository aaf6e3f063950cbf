"""How a worm on its shaft gives way: as a plain shaft between two bearings that gives as much."""

import math
from typing import NamedTuple

from asperity.gearset.geometry import Geometry
from asperity.shafts.beam import POISSON, mesh_compliance
from asperity.shafts.model import model_of
from asperity.shafts.parameters import WormShaft


class PlainShaft(NamedTuple):
    """A plain shaft with the wheel midway that gives at the mesh as a given one does.

    Attributes
    ----------
    diameter, span : float
        m.
    torsional_stiffness : float
        Between the end that is driven and the mesh, N m/rad.
    bearing_radial : float or None
        Stiffness of each of two equal bearings, N/m; None where they are rigid.
    """

    diameter: float
    span: float
    torsional_stiffness: float
    bearing_radial: float | None


def plain_shaft(
    table: WormShaft, geometry: Geometry, modulus: float, span: float | None = None
) -> PlainShaft:
    """Return the plain shaft that gives as much across its axis and in torsion.

    Across the axis it gives as much under a force at the mesh, by bending and shear; under a couple
    the two differ where the mesh is not midway.

    Parameters
    ----------
    table : WormShaft
        The shaft.
    geometry : Geometry
        Of its gearset.
    modulus : float
        Young's modulus of the plain shaft, Pa.
    span : float, optional
        In place of the distance of the bearings, m.
    """
    model = model_of(table, geometry)
    first, second = model.bearings
    length = 1e-3 * (second - first) if span is None else span
    of = model.stretches, model.bearings, model.mesh, model.modulus
    gives = 1e-3 * float(mesh_compliance(*of)[0, 0])  # m/N
    diameter = (64.0 * length**3 / (48.0 * math.pi * modulus * gives)) ** 0.25
    shear = model.modulus / (2.0 * (1.0 + POISSON))
    twists = 0.0
    for stretch in model.stretches:
        long = max(min(stretch.end, model.mesh) - stretch.start, 0.0)
        twists += 32.0 * long / (math.pi * stretch.diameter**4 * shear)  # rad/(N mm)
    share = (second - model.mesh) / (second - first)
    ends = share**2 * model.radial_compliance[0] + (1.0 - share) ** 2 * model.radial_compliance[1]
    return PlainShaft(diameter, length, 1e-3 / twists, 1e3 / (2.0 * ends) if ends > 0.0 else None)
