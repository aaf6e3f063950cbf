"""What elastic teeth remember from step to step: loads on each other, and points that touch."""

from typing import NamedTuple

from asperity.contact.candidates.records import candidates_of
from asperity.drive.elastic.records import Mesh
from asperity.drive.elastic.rim import moved_by
from asperity.drive.interface import POSES
from asperity.kernels.compiled import kernel


class _Tooth(NamedTuple):
    """Where what a tooth remembers stands, behind poses and generalised forces of the damping.

    Its number, how many points touch, the amplitude that its neighbours moved it by; behind that
    its load on them and that of a step before, and its points.
    """

    number: int = 0
    touching: int = 1
    moved: int = 2


class _Point(NamedTuple):
    """Where what a point remembers stands.

    Number, deflection (3), pressure over the reference times friction's share, force (3), the
    force a step before (3); and where the next point begins.
    """

    number: int = 0
    deflection: int = 1
    size: int = 4
    force: int = 5
    earlier: int = 8
    end: int = 11


HEAD = 2 * POSES
TOOTH, POINT = _Tooth(), _Point()


@kernel
def points_at(mesh):
    """Where in a tooth's memory its points begin."""
    return TOOTH.moved + 3 * mesh.rim.shapes.shape[1]


@kernel
def block_of(mesh):
    """Floats that a tooth's memory has at most."""
    return points_at(mesh) + POINT.end * mesh.body.weights.shape[0]


def states(mesh: Mesh) -> int:
    """Return the floats that a mesh remembers."""
    own = TOOTH.moved + 3 * mesh.rim.shapes.shape[1] + POINT.end * len(mesh.body.weights)
    return int(HEAD + mesh.flanks * mesh.teeth * own)


@kernel
def bring(mesh, k, committed, at, tooth, share):
    """Bring what a tooth remembers to its candidates: asperities, forces, displacement.

    The limit that asperities had is told over that of this step's ``share`` of friction.
    """
    own = candidates_of(mesh.candidates, k)
    points = 4 * own.counts[0]
    history, force = mesh.history, mesh.answer.force[k]
    for q in range(points):
        history.size[q] = 0.0
        for c in range(3):
            history.deflection[q, c] = 0.0
            force[q, c] = 0.0
            mesh.earlier[q, c] = 0.0
    count = int(committed[at + TOOTH.touching]) if committed[at + TOOTH.number] == tooth else 0
    first = at + points_at(mesh)
    for i in range(count):
        entry = first + POINT.end * i
        number = int(committed[entry + POINT.number])
        face = own.place[number // 4]
        if face < 0:
            continue
        q = 4 * face + number % 4
        history.size[q] = committed[entry + POINT.size] / share
        for c in range(3):
            history.deflection[q, c] = committed[entry + POINT.deflection + c]
            # Continued as from the step before.
            force[q, c] = (
                2.0 * committed[entry + POINT.force + c] - committed[entry + POINT.earlier + c]
            )
            mesh.earlier[q, c] = committed[entry + POINT.force + c]
    return count


@kernel
def displace(mesh, place, committed, at, tooth, all_nodes, nodes, number, u):
    """Displacement of nodes under the forces that a tooth remembers, and its neighbours'."""
    body, nodal = mesh.body, mesh.work.nodal
    a = body.flexibility
    total = nodal.shape[0] // 3 if all_nodes else number
    for i in range(total):
        j = 3 * (i if all_nodes else nodes[i])
        u[j] = u[j + 1] = u[j + 2] = 0.0
    if committed[at + TOOTH.number] != tooth:
        # New here: as if its neighbours had moved it before.
        moved_by(mesh.rim, mesh.rim.given[place], all_nodes, nodes, number, u)
        return
    moved = committed[at + TOOTH.moved : at + TOOTH.moved + mesh.rim.shapes.shape[1]]
    moved_by(mesh.rim, moved, all_nodes, nodes, number, u)
    count = int(committed[at + TOOTH.touching])
    if count == 0:
        return
    nodal[:] = 0.0
    first = at + points_at(mesh)
    for i in range(count):
        entry = first + POINT.end * i
        point = int(committed[entry + POINT.number])
        for b in range(4):
            j = 3 * body.faces[point // 4, b]
            share = body.shapes[point % 4, b]
            for c in range(3):
                nodal[j + c] += share * committed[entry + POINT.force + c]
    for m in range(nodal.shape[0] // 3):
        k = 3 * m
        fx = nodal[k]
        fy = nodal[k + 1]
        fz = nodal[k + 2]
        if fx == 0.0 and fy == 0.0 and fz == 0.0:
            continue
        for i in range(total):
            j = 3 * (i if all_nodes else nodes[i])
            u[j] += a[k, j] * fx + a[k + 1, j] * fy + a[k + 2, j] * fz
            u[j + 1] += a[k, j + 1] * fx + a[k + 1, j + 1] * fy + a[k + 2, j + 1] * fz
            u[j + 2] += a[k, j + 2] * fx + a[k + 1, j + 2] * fy + a[k + 2, j + 2] * fz
