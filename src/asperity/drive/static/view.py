"""The loaded teeth as a mesh for ParaView: the whole sector, as it is deformed."""

from pathlib import Path

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.elastic import ElasticMaterial, elastic_body
from asperity.contact.interface.surface import contact_surface
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.flank import grid_of
from asperity.drive.teeth.sector import (
    DENSITY,
    ELEMENT,
    RIM,
    Sector,
    lattice,
    moving_rim,
    on_coarse,
)
from asperity.flanks.wheel.frame import turned
from asperity.mesh.vtu import write_vtu


def write_teeth(
    problem: DriveProblem,
    sector: Sector,
    nodal_force: FloatArray,
    pattern: FloatArray,
    path: Path,
) -> Path:
    """Write the sector under the forces on its flanks.

    Parameters
    ----------
    problem : DriveProblem
        Has the wheel's material.
    sector : Sector
        The condensed teeth.
    nodal_force : ndarray, shape (K, 3n)
        On the flanks of its teeth, N, each in the tooth's own frame, about +Z.
    pattern : ndarray, shape (k,)
        Largest resolved pressures over a pitch at the points of
        `asperity.drive.resolved.flank.grid_of`, Pa.
    path : Path
        Of the ``.vtu`` file.
    """
    mesh = sector.mesh
    material = problem.gearset.wheel_material
    body = elastic_body(
        mesh,
        ElasticMaterial(material.youngs_modulus, material.poisson_ratio, DENSITY),
        element=ELEMENT,
        tied=RIM,
    )
    forces = np.zeros((len(mesh.points), 3))
    pressure, largest = np.zeros(len(mesh.points)), np.zeros(len(mesh.points))
    of_pitch = at_nodes(sector, pattern)
    middle, teeth = len(nodal_force) // 2, sector.teeth
    for k, own in enumerate(nodal_force):
        # In the mesh teeth follow one another about -Z.
        place = teeth // 2 - (k - middle)
        if not 0 <= place < teeth:
            continue
        name = "flank_plus" if teeth == 1 else f"flank_plus_{place}"
        surface = contact_surface(mesh, name)
        turn = turned(-(k - middle) * sector.pitch)
        values = own.reshape(-1, 3) @ turn.T
        forces[surface.nodes] += values
        normal = -np.einsum("ni,ni->n", values, surface.nodal_normals)
        pressure[surface.nodes] = np.maximum(normal, 0.0) / surface.nodal_area
    # Every tooth goes through the whole pitch.
    for place in range(teeth):
        name = "flank_plus" if teeth == 1 else f"flank_plus_{place}"
        largest[contact_surface(mesh, name).nodes] = of_pitch
    held = np.zeros_like(forces)
    if problem.wheel_body is not None:
        rim = moving_rim(sector, material, problem.wheel_body)
        # Teeth that follow one another about +Z are further towards -X.
        own = on_coarse(sector, nodal_force.reshape(len(nodal_force), -1, 3))
        at = {middle - k: each for k, each in enumerate(own)}
        held[body.tied] = rim.at(body.mesh.points[body.tied], at)
    moved = body.carried(forces.reshape(-1, 1), held.reshape(-1, 1)).reshape(-1, 3)
    mirror = np.array([1.0, 1.0, float(sector.wheel.pair.mirror)])
    shown = mesh if sector.wheel.pair.mirror > 0 else mesh.transformed(np.diag(mirror))
    return write_vtu(
        path,
        shown,
        {
            "displacement_mm": 1e3 * moved * mirror,
            "force_N": forces * mirror,
            "pressure_MPa": 1e-6 * pressure,
            "largest_pressure_MPa": 1e-6 * largest,
        },
    )


def at_nodes(sector: Sector, pattern: FloatArray) -> FloatArray:
    """Return at the nodes of a flank what is known at the points of its exact grid, (n,)."""
    from scipy.interpolate import RegularGridInterpolator

    _, _, share, z = grid_of(sector.wheel)
    shares = np.unique(share)
    columns = z[: len(z) // len(shares)]
    nodes = lattice(sector.surface)
    own = np.empty(nodes.size)
    own[nodes] = np.linspace(0.0, 1.0, len(nodes))[:, None]
    at = np.clip(sector.surface.positions[:, 2], columns[0], columns[-1])
    known = RegularGridInterpolator((shares, columns), pattern.reshape(len(shares), -1))
    return np.asarray(known(np.column_stack([own, at])))
