"""What elastic teeth remember from step to step: loads on each other, and points that touch."""

from asperity.compiled import kernel
from asperity.contact.candidates.records import candidates_of
from asperity.drive.elastic.records import Mesh
from asperity.drive.elastic.rim import moved_by
from asperity.drive.interface import POSES

# Poses and generalised forces of the damping; then for each tooth its number, how many points
# touch, the amplitude that its neighbours moved it by, its load on them and that of a step before,
# and of each point: number, deflection (3), pressure over the reference times friction's share,
# force (3), the force a step before (3).
HEAD = 2 * POSES
RECORD = 11


@kernel
def points_at(mesh):
    """Where in a tooth's memory its points begin."""
    return 2 + 3 * mesh.rim.shapes.shape[1]


@kernel
def block_of(mesh):
    """Floats that a tooth's memory has at most."""
    return points_at(mesh) + RECORD * mesh.body.weights.shape[0]


def states(mesh: Mesh) -> int:
    """Return the floats that a mesh remembers."""
    own = 2 + 3 * mesh.rim.shapes.shape[1] + RECORD * len(mesh.body.weights)
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
    count = int(committed[at + 1]) if committed[at] == tooth else 0
    first = at + points_at(mesh)
    for i in range(count):
        entry = first + RECORD * i
        number = int(committed[entry])
        face = own.place[number // 4]
        if face < 0:
            continue
        q = 4 * face + number % 4
        history.size[q] = committed[entry + 4] / share
        for c in range(3):
            history.deflection[q, c] = committed[entry + 1 + c]
            # Continued as from the step before.
            force[q, c] = 2.0 * committed[entry + 5 + c] - committed[entry + 8 + c]
            mesh.earlier[q, c] = committed[entry + 5 + c]
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
    if committed[at] != tooth:
        # New here: as if its neighbours had moved it before.
        moved_by(mesh.rim, mesh.rim.given[place], all_nodes, nodes, number, u)
        return
    moved = committed[at + 2 : at + 2 + mesh.rim.shapes.shape[1]]
    moved_by(mesh.rim, moved, all_nodes, nodes, number, u)
    count = int(committed[at + 1])
    if count == 0:
        return
    nodal[:] = 0.0
    first = at + points_at(mesh)
    for i in range(count):
        entry = first + RECORD * i
        point = int(committed[entry])
        for b in range(4):
            j = 3 * body.faces[point // 4, b]
            share = body.shapes[point % 4, b]
            for c in range(3):
                nodal[j + c] += share * committed[entry + 5 + c]
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
