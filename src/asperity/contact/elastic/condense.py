"""Condensing an elastic body to its contact nodes: factorised once, kept on disk by content."""

import contextlib
import dataclasses
import math
import os
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.contact.elastic.body import ElasticBody, elastic_body, freedoms_of
from asperity.contact.elastic.condensed import CondensedBody
from asperity.contact.elastic.loads import Load
from asperity.contact.elastic.material import ElasticMaterial
from asperity.contact.elastic.modes import shapes_with_inertia
from asperity.contact.elastic.solver import COLUMNS_AT_A_TIME, factor_bytes, installed_solver
from asperity.contact.interface.surface import ContactSurface, contact_surface
from asperity.errors import InputError
from asperity.kernels.closure import source_key
from asperity.mesh import HexMesh
from asperity.runs.cache import Cache
from asperity.runs.key import key
from asperity.runs.tree import from_tree, to_tree

GRAVITY = ("gravity_x", "gravity_y", "gravity_z")
"""The loads every body has: its mass times 1 m/s^2 along an axis."""

# Columns of the flexibility that are solved for besides.
_LOOKED_AT = 8

# Where Linux says how much a container may have; without a limit a word stands there.
_CONTAINER_LIMITS = (
    "/sys/fs/cgroup/memory.max",
    "/sys/fs/cgroup/memory/memory.limit_in_bytes",
)

_NO_LOADS: Mapping[str, Load] = MappingProxyType({})


def condense(
    mesh: HexMesh,
    material: ElasticMaterial,
    contact: str,
    *,
    element: str | None = None,
    tied: str | None = None,
    movable: bool = False,
    loads: Mapping[str, Load] = _NO_LOADS,
    modes: int = 0,
    solver: str = "auto",
    memory_limit: float | None = None,
    use_cache: bool = True,
    notify: Callable[[str], None] | None = None,
) -> CondensedBody:
    """Condense an elastic body to the nodes of its contact faces.

    Parameters
    ----------
    mesh : HexMesh
        One piece, in any unit; the result is in m.
    material : ElasticMaterial
        What it is made of.
    contact : str
        Name of the face set that may touch another body.
    element : {'hex27', 'hex8', 'hex8i'}, optional
        Default: 27 or 8 nodes as the mesh has.
    tied : str, optional
        Node set or face set that is tied to a rigid body; left out, the body is free.
    movable : bool
        Whether that rigid body moves, so that the result has rigid modes too. A free body always
        has.
    loads : mapping of str to Load, optional
        Named loads beside gravity, see `asperity.contact.elastic.loads`.
    modes : int
        Lowest natural modes that have inertia of their own; with them 18 static shapes of the
        contact have, see `asperity.contact.elastic.modes`. With 0 the body deforms as in statics.
    solver : {'auto', 'pypardiso', 'superlu'}
        Direct solver.
    memory_limit : float, optional
        Most memory this may need, bytes; estimated before anything is done. Left out: what this
        machine has.
    use_cache : bool
        Whether to look for, and keep, the result on disk. Its key is the content of everything
        above and of the sources of this room.
    notify : callable, optional
        Takes one line about a kept file that is damaged; it is set aside.

    Returns
    -------
    CondensedBody

    Raises
    ------
    InputError
        The body is not held or not one piece, a set is missing, modes are negative or too many, or
        the estimated memory exceeds the limit.
    """
    if any(name in GRAVITY for name in loads):
        raise InputError(f"a load is named like one of {', '.join(GRAVITY)}; choose another name")
    unknowns = 3 * len(mesh.points)
    if not 0 <= modes <= unknowns // 4:
        raise InputError(f"modes is {modes}; allowed: 0 to {unknowns // 4} with this mesh")
    mesh = mesh.converted("m")
    surface = contact_surface(mesh, contact)
    names = (*GRAVITY, *loads)
    pushed = np.array([loads[name].forces(mesh).reshape(-1) for name in loads])
    pushed = pushed.reshape(-1, unknowns).T

    cache = Cache.of_this_user("condensed", notify) if use_cache else Cache(None)
    digest = key(
        source_key("asperity.contact.elastic"),
        mesh.points,
        mesh.cells,
        mesh.face_nodes(contact),
        pushed,
        _tied_nodes(mesh, tied),
        repr((material, element, movable, names, modes, solver)),
    )
    kept = cache.get(digest)
    if kept is not None:
        return from_tree(CondensedBody, kept | {"from_cache": True})

    name = installed_solver(solver)
    expected = memory_for(
        len(mesh.points), mesh.cells.shape, len(surface.nodes), modes=modes, solver=name
    )
    limit = machine_memory() if memory_limit is None else memory_limit
    if expected > limit:
        raise InputError(
            f"condensing {unknowns} unknowns to {len(surface.nodes)} contact nodes needs about "
            f"{expected / 1e9:.2g} GB, more than the limit of {limit / 1e9:.2g} GB; take "
            "fewer elements, or raise memory_limit"
        )
    began = time.perf_counter()
    body = elastic_body(
        mesh, material, element=element, tied=tied, solver=name, loaded=freedoms_of(surface.nodes)
    )
    condensed = _condense(body, surface, names, pushed, movable or body.free, modes)
    condensed = dataclasses.replace(condensed, seconds=time.perf_counter() - began)
    cache.put(digest, to_tree(condensed))
    return condensed


def machine_memory() -> float:
    """Return the memory this process may have: the machine's, or less of it in a container, bytes.

    Where neither says, there is no bound.
    """
    found = [math.inf]
    with contextlib.suppress(AttributeError, OSError, ValueError):
        found.append(float(os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")))
    for file in _CONTAINER_LIMITS:
        with contextlib.suppress(OSError, ValueError):
            found.append(float(Path(file).read_text()))
    return min(size for size in found if size > 0.0)


def memory_for(
    nodes: int,
    cells: tuple[int, ...],
    contact_nodes: int,
    *,
    modes: int = 0,
    solver: str = "pypardiso",
) -> float:
    """Return the memory that condensing is expected to need at most, bytes.

    Parameters
    ----------
    nodes : int
        Of the mesh.
    cells : tuple of 2 int
        Its cells, and the nodes of each.
    contact_nodes : int
        Nodes it is condensed to.
    modes : int
        Elastic modes.
    solver : {'pypardiso', 'superlu'}
        Direct solver.
    """
    unknowns = 3 * nodes
    pairs = cells[0] * cells[1] ** 2
    # A pair of nodes of a cell: its place and what sorting takes; its 3 x 3 block twice while the
    # matrix is put together; the matrix, its part that moves, and the upper triangle of that.
    assembly = pairs * (4 * 8 + 2 * 9 * 8 + 2.5 * 9 * 12)
    columns = min(3 * contact_nodes, COLUMNS_AT_A_TIME) + 2 * modes + 54
    dense = 8.0 * (6 * unknowns * columns + 3 * (3 * contact_nodes) ** 2)
    return float(assembly + factor_bytes(unknowns, 9 * pairs, solver) + dense)


def _tied_nodes(mesh: HexMesh, tied: str | None) -> IntArray:
    if tied is None:
        return np.empty(0, dtype=np.int64)
    return mesh.node_set(tied) if tied in mesh.node_sets else mesh.face_nodes(tied)


def _condense(
    body: ElasticBody,
    surface: ContactSurface,
    names: tuple[str, ...],
    pushed: FloatArray,
    movable: bool,
    count: int,
) -> CondensedBody:
    rows = body.loaded
    size = 3 * len(body.mesh.points)
    loads = np.concatenate([body.inertia[:, :3], pushed], axis=1)
    answer = body.response(loads)
    residual = body.residual(loads, answer)
    load_flexibility, load_compliance = answer[rows], loads.T @ answer

    flexibility = body.flexibility()
    some = np.unique(np.linspace(0, len(rows) - 1, _LOOKED_AT).astype(int))
    forces = np.zeros((size, len(some)))
    forces[rows[some], np.arange(len(some))] = 1.0
    answer = body.response(forces)
    apart = float(np.abs(answer[rows] - flexibility[:, some]).max() / np.abs(flexibility).max())
    residual = max(residual, body.residual(forces, answer), apart)

    shapes, frequency = shapes_with_inertia(body, surface, count)
    return CondensedBody(
        nodes=surface.nodes,
        positions=surface.positions,
        flexibility=flexibility,
        rigid=body.rigid[rows] if movable else np.empty((len(rows), 0)),
        mass=body.rigid_mass,
        centre=body.centre,
        modes=shapes[rows],
        natural_modes=count,
        mode_frequency=frequency,
        load_names=names,
        load_flexibility=load_flexibility,
        load_compliance=0.5 * (load_compliance + load_compliance.T),
        load_rigid=body.rigid.T @ loads,
        load_modes=shapes.T @ loads,
        unknowns=size,
        solver=body.factorisation.solver,
        residual=residual,
        seconds=0.0,
    )
