"""A block in motion as a series of VTU files: all of it, deformed, with its pressure below."""

import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from asperity.arrays import FloatArray
from asperity.contact.elastic.modes import whole_shapes
from asperity.errors import InputError
from asperity.mesh.packed import floats, indices, packed
from asperity.mesh.vtu import Data, write_series

if TYPE_CHECKING:
    from asperity.block.problem import BlockProblem


@dataclasses.dataclass(frozen=True, eq=False)
class Frame:
    """One moment of a block, enough to draw all of it."""

    time: float  #: s
    coordinates: FloatArray  #: (m,): Generalised coordinates
    drive_force: float  #: N
    force: FloatArray  #: (3 n,): Contact forces on the block, N
    pressure: FloatArray  #: (q,): At the points of the contact, Pa
    traction: FloatArray  #: (q, 3): On the block, Pa


def write_block_series(problem: "BlockProblem", frames: tuple[Frame, ...], path: Path) -> Path:
    """Write a block's frames for ParaView, which plays the ``.pvd`` file they stand beside.

    At the nodes of the block: ``displacement`` (m), from where it stood unloaded; ``deformation``
    (m), that part of it which is not rigid motion, to be magnified; on the bottom ``pressure_Pa``
    and ``friction_Pa``, zero elsewhere.
    """
    if not frames:
        raise InputError("the result has no frames to write; solve with history=True")
    return write_series(path, problem.mesh, fields(problem, frames))


def packed_series(problem: "BlockProblem", frames: tuple[Frame, ...]) -> bytes:
    """Return a block's frames in one small file that a program draws from.

    Of the skin's corner nodes ``points`` (m) and ``quads``; ``deformation`` (m) of each point and
    ``pressure`` (Pa) of each contact node in every frame; in the header the frames' times (s)
    and drive forces (N).

    Parameters
    ----------
    problem : BlockProblem
        The block.
    frames : tuple of Frame
        At least one.
    """
    if not frames:
        raise InputError("the result has no frames to draw; solve with history=True")
    mesh, contact = problem.mesh, problem.body.nodes
    nodes, quads = np.unique(mesh.skin(), return_inverse=True)
    told = [
        {name: np.asarray(of) for name, of in data.items()} for _, data in fields(problem, frames)
    ]
    header = {
        "time_s": [frame.time for frame in frames],
        "drive_force_N": [frame.drive_force for frame in frames],
    }
    return packed(
        header,
        {
            "points": floats(mesh.points[nodes]),
            "quads": indices(quads.reshape(-1, 4)),
            "deformation": floats(np.array([data["deformation"][nodes] for data in told])),
            "pressure": floats(np.array([data["pressure_Pa"][contact] for data in told])),
        },
    )


def fields(problem: "BlockProblem", frames: tuple[Frame, ...]) -> Iterator[tuple[float, Data]]:
    """Yield time and nodal fields of each frame.

    What the contact nodes were condensed from is found again from the forces: the deformation
    under contact, drive and loads that the block as a whole is accelerated by, and its modes.
    """
    body, condensed = problem.uncondensed, problem.body
    mesh, surface = problem.mesh, problem.surface
    rows = (3 * condensed.nodes[:, None] + np.arange(3)).ravel()
    loads = problem.nodal_loads
    drive = problem.nodal_drive
    shapes = whole_shapes(body, surface, condensed)
    for frame in frames:
        forces = loads + frame.drive_force * drive
        forces[rows] += frame.force
        deformation = body.response(forces)
        # Modes move by themselves; their share of the static answer goes.
        deformation += shapes @ (
            frame.coordinates[6:] - (shapes.T @ forces) / condensed.mode_stiffness
        )
        displacement = deformation + body.rigid @ frame.coordinates[:6]
        pressure = np.zeros(len(mesh.points))
        friction = np.zeros((len(mesh.points), 3))
        points = surface.weights.shape
        pressure[condensed.nodes] = surface.to_nodes(frame.pressure.reshape(points))
        normal = -surface.normals * frame.pressure.reshape(*points, 1)
        tangential = frame.traction.reshape(*points, 3) - normal
        friction[condensed.nodes] = surface.to_nodes(tangential)
        yield (
            frame.time,
            {
                "displacement": _vectors(displacement),
                "deformation": _vectors(deformation),
                "pressure_Pa": pressure,
                "friction_Pa": friction,
            },
        )


def _vectors(freedoms: FloatArray) -> FloatArray:
    return freedoms.reshape(-1, 3)
