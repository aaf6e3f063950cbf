r"""Elastic teeth as the march advances them: each tooth's contact solved for, on both flanks.

A step solves normal approach, the asperities' friction and the teeth's own give together, tooth by
tooth, implicitly. What is remembered stands at the points that touch alone: deflection of the
asperities and force, in the tooth's own frame; a tooth that leaves the mesh touches nothing any
more, and its place is taken by one that enters. So nothing has to be handed over at a pitch.

The contact's damping stands beside teeth and contact together, as in the reduced mesh: a force
:math:`c\,p\,\dot d` at each point, with the rate at which worm and wheel, both rigid, approach
each other there.

Which faces are near is looked up anew before worm and tooth have come as close as it reached.
"""

import math

from asperity.compiled import kernel
from asperity.contact.candidates.faces import collect
from asperity.contact.candidates.newton import FULL, solve
from asperity.contact.candidates.records import (
    answer_of,
    candidates_of,
    kept_of,
)
from asperity.contact.candidates.wrench import place_of, wrench
from asperity.contact.interface.counter_motion import MotionNumbers
from asperity.drive.elastic.records import Mesh
from asperity.drive.interface import AT, POSES
from asperity.drive.teeth.placing import place_worm, to_space

_AHEAD = 4.0  # steps in which surfaces are about to touch
_NEAR = 3e-6  # to the worm, within which faces are looked at, m
_LOST = 1.0  # residual of a tooth of which too much touches

# Poses and generalised forces of the damping; then for each tooth its number, how many points
# touch, and of each: number, deflection (3), pressure over the reference, force (3), the force a
# step before (3).
_HEAD = 2 * POSES
_RECORD = 11


@kernel
def _block(mesh):
    """Floats that a tooth's memory has at most."""
    return 2 + _RECORD * mesh.body.weights.shape[0]


def states(mesh: Mesh) -> int:
    """Return the floats that a mesh remembers."""
    return _HEAD + mesh.flanks * mesh.teeth * (2 + _RECORD * len(mesh.body.weights))


@kernel
def _committed(mesh, k, committed, at, tooth):
    """Bring what a tooth remembers to its candidates: asperities, forces, displacement."""
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
    for i in range(count):
        entry = at + 2 + _RECORD * i
        number = int(committed[entry])
        face = own.place[number // 4]
        if face < 0:
            continue
        q = 4 * face + number % 4
        history.size[q] = committed[entry + 4]
        for c in range(3):
            history.deflection[q, c] = committed[entry + 1 + c]
            # Continued as from the step before.
            force[q, c] = 2.0 * committed[entry + 5 + c] - committed[entry + 8 + c]
            mesh.earlier[q, c] = committed[entry + 5 + c]
    return count


@kernel
def _displace(mesh, committed, at, count, all_nodes, nodes, number, u):
    """Displacement of nodes under the forces that a tooth remembers."""
    body, nodal = mesh.body, mesh.work.nodal
    a = body.flexibility
    total = nodal.shape[0] // 3 if all_nodes else number
    for i in range(total):
        j = 3 * (i if all_nodes else nodes[i])
        u[j] = u[j + 1] = u[j + 2] = 0.0
    if count == 0:
        return
    nodal[:] = 0.0
    for i in range(count):
        entry = at + 2 + _RECORD * i
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


@kernel
def _travelled(mesh, seen, q):
    """By how much a point of a tooth may have come closer since its faces were gathered, m.

    A worm's turn is a shift along its axis; of the wheel's turn the part at the middle of the
    flank goes along with it.
    """
    places = mesh.body.places
    middle = places[places.shape[0] // 2, 1]
    worm = mesh.stand.lead * (q[0] - seen[1]) + (q[1] - seen[2])
    wheel = q[2] - seen[3]
    # Half the height of a tooth and how far it stands from the middle of the mesh: of its pitch.
    reach = 3.0 * mesh.stand.pitch * middle
    return abs(worm - middle * wheel) + reach * abs(wheel) + abs(q[3] - seen[4])


@kernel
def _reach(mesh, v, dt):
    """How near to the worm a tooth's points may touch or be about to, m."""
    middle = mesh.body.places[mesh.body.places.shape[0] // 2, 1]
    # The thread's slope brings the worm closer as the wheel shifts: less than its whole way.
    rate = abs(mesh.stand.lead * v[0] + v[1] - middle * v[2]) + abs(v[3])
    return max(_NEAR, _AHEAD * rate * dt)


@kernel
def _gather(mesh, k, laws, committed, at, tooth, q, reach):
    """Gather a tooth's faces near the worm, unless those there are will do; if any are near."""
    seen = mesh.gathered[k]
    if seen[0] == tooth:
        way = _travelled(mesh, seen, q) + seen[7]
        if way + reach <= seen[6]:
            return mesh.candidates.counts[k, 0] > 0
        if seen[5] - way > reach:
            return False
    count = int(committed[at + 1]) if committed[at] == tooth else 0
    u = mesh.shape[k]
    own = candidates_of(mesh.candidates, k)
    _displace(mesh, committed, at, count, True, own.nodes, 0, u)
    seen[5] = collect(
        mesh.body, laws.interface.counter, mesh.rotation[1], mesh.translation[1], u, 2.0 * reach,
        own,
    )  # fmt: skip
    seen[0] = tooth
    for c in range(POSES):
        seen[1 + c] = q[c]
    seen[6] = 2.0 * reach
    seen[7] = 0.0
    return own.counts[0] > 0


@kernel
def forget(mesh):
    """Forget what earlier steps left for those after them, so that a march goes on from its state.

    Which faces were gathered and by which inverse a tooth was solved shows in the last digits.
    """
    mesh.gathered[:, 0] = math.inf
    mesh.kept.size[:] = 0


@kernel
def _drifted(mesh):
    """Write how the worm's material moved past the tooth over the step, ``shift + drift @ x``."""
    before, after = mesh.rotation[0], mesh.rotation[1]
    for r in range(3):
        for c in range(3):
            back = (
                before[r, 0] * after[c, 0] + before[r, 1] * after[c, 1] + before[r, 2] * after[c, 2]
            )
            mesh.drift[r, c] = (1.0 if r == c else 0.0) - back
    for r in range(3):
        moved = 0.0
        for c in range(3):
            back = (1.0 if r == c else 0.0) - mesh.drift[r, c]
            moved += back * mesh.translation[1, c]
        mesh.shift[r] = moved - mesh.translation[0, r]


@kernel
def _approach(mesh, side, v, x, y, z, nx, ny, nz):
    """Rate at which the worm's surface approaches a place of a tooth along its normal, m/s."""
    ex, ey, ez = mesh.rotation[1, 0, 2], mesh.rotation[1, 1, 2], mesh.rotation[1, 2, 2]
    t = mesh.translation[1]
    ax, ay, az = x - t[0], y - t[1], z - t[2]
    wheel = v[2] if side > 0 else -v[2]
    along = v[3] if side > 0 else -v[3]
    vx = v[0] * (ey * az - ez * ay) - v[1] * ex + wheel * y
    vy = v[0] * (ez * ax - ex * az) - v[1] * ey - wheel * x
    vz = v[0] * (ex * ay - ey * ax) - v[1] * ez + along
    return vx * nx + vy * ny + vz * nz


@kernel
def _write(mesh, k, trial, at, tooth, side, v, dt, reach, out):
    """Write what a tooth remembers, and add up energies, losses and the damping's wrench.

    Returns the normal force.
    """
    own, answer = candidates_of(mesh.candidates, k), answer_of(mesh.answer, k)
    history, shapes = mesh.history, mesh.body.shapes
    bristle = mesh.friction_stiffness
    count = 0
    normal = 0.0
    pull = mesh.vectors
    pull[:] = 0.0
    for q in range(4 * own.counts[0]):
        w = own.weights[q]
        p = answer.pressure[q]
        n = answer.normal[q]
        s0 = history.deflection[q]
        s1 = answer.deflection[q]
        if bristle > 0.0 and (p > 0.0 or history.size[q] > 0.0):
            slip = answer.slip_1[q]
            for c in range(3):
                out[AT.friction] += (
                    0.5 * w * bristle * (s0[c] + s1[c]) * (slip[c] - (s1[c] - s0[c]))
                )
                out[AT.stored] += 0.5 * w * bristle * s1[c] * s1[c]
        gap = answer.distance[q]
        rate = 0.0
        if p > 0.0 or gap < reach:
            x, y, z = place_of(own, shapes, answer.u, q)
            rate = _approach(mesh, side, v, x, y, z, n[0], n[1], n[2])
            if gap - _AHEAD * max(rate, 0.0) * dt < 0.0:
                out[AT.approach] = max(out[AT.approach], abs(rate))
        if p <= 0.0:
            continue
        entry = at + 2 + _RECORD * count
        count += 1
        trial[entry] = 4.0 * own.face[q // 4] + q % 4
        trial[entry + 4] = answer.size[q]
        elastic = 0.0
        face = q // 4
        for c in range(3):
            f = w * answer.traction[q, c]
            answer.force[q, c] = f
            trial[entry + 1 + c] = s1[c]
            trial[entry + 5 + c] = f
            trial[entry + 8 + c] = mesh.earlier[q, c]
            u = 0.0
            for b in range(4):
                u += shapes[q % 4, b] * answer.u[3 * own.faces[face, b] + c]
            elastic += f * u
        out[AT.stored] += 0.5 * elastic + 0.5 * w * p * p / mesh.stiffness
        force = w * p * max(mesh.damping * rate, -1.0)
        normal += w * p + force
        fx, fy, fz = force * n[0], force * n[1], force * n[2]
        pull[0, 0] += fx
        pull[0, 1] += fy
        pull[0, 2] += fz
        pull[1, 0] += y * fz - z * fy
        pull[1, 1] += z * fx - x * fz
        pull[1, 2] += x * fy - y * fx
    trial[at] = tooth
    trial[at + 1] = count
    way = 0.0
    for i in range(own.counts[1]):
        j = 3 * own.nodes[i]
        for c in range(3):
            way = max(way, abs(answer.u[j + c] - mesh.shape[k, j + c]))
    # Along the normal at most the length of what each direction has moved.
    mesh.gathered[k, 7] = math.sqrt(3.0) * way
    return normal


@kernel
def _act(mesh, vectors, q, forces):
    """Add what a force and moment on the wheel are in the drive's coordinates."""
    stand = mesh.stand
    fx, fy, fz = vectors[0, 0], vectors[0, 1], vectors[0, 2]
    e, o = stand.axes[2], stand.origin
    # About the worm's axis, which its shift leaves where it is.
    mx = vectors[1, 0] - (o[1] * fz - o[2] * fy)
    my = vectors[1, 1] - (o[2] * fx - o[0] * fz)
    mz = vectors[1, 2] - (o[0] * fy - o[1] * fx)
    # The wheel's shift moves the worm, seen from it: the moment about the axis takes it along.
    along = q[3]
    mx -= -along * fy
    my -= along * fx
    forces[0] -= e[0] * mx + e[1] * my + e[2] * mz
    forces[1] += e[0] * fx + e[1] * fy + e[2] * fz
    forces[2] += vectors[1, 2]
    forces[3] -= fz


@kernel
def advance(mesh, committed, trial, q, v, dt, out):
    """Advance the mesh over a step, see `asperity.drive.interface`."""
    out[:] = 0.0
    stand = mesh.stand
    pitch = stand.pitch
    block = _block(mesh)
    before, forces = committed[:POSES], out[:POSES]
    damped = mesh.damped
    damped[:] = 0.0
    shift = mesh.moved
    reach = _reach(mesh, v, dt)
    for place in range(mesh.flanks * mesh.teeth):
        side = 1 if place < mesh.teeth else -1
        laws = mesh.laws if side > 0 else mesh.back
        own_place = place % mesh.teeth
        # The tooth of this place that is nearest to the middle of the mesh.
        angle = q[2] + mesh.ahead
        tooth = mesh.teeth * round((-angle / pitch - own_place) / mesh.teeth) + own_place
        angle += pitch * tooth
        at = _HEAD + place * block
        trial[at] = tooth
        trial[at + 1] = 0.0
        shift[2] = -q[1]
        place_worm(stand, q[0], shift, angle, q[3], side, mesh.rotation[1], mesh.translation[1])
        touched = committed[at] == tooth and committed[at + 1] > 0.0
        near = _gather(mesh, place, laws, committed, at, tooth, q, reach)
        if not near and not touched:
            continue
        shift[2] = -before[1]
        place_worm(
            stand, before[0], shift, before[2] + mesh.ahead + pitch * tooth, before[3], side,
            mesh.rotation[0], mesh.translation[0],
        )  # fmt: skip
        _drifted(mesh)
        own, answer = candidates_of(mesh.candidates, place), answer_of(mesh.answer, place)
        count = _committed(mesh, place, committed, at, tooth)
        _displace(
            mesh, committed, at, count, False, own.nodes, own.counts[1], mesh.history.displacement
        )
        motion = MotionNumbers(
            mesh.rotation[1], mesh.translation[1], mesh.shift, mesh.drift, mesh.still,
            mesh.nothing, mesh.one, mesh.nothing, False,
        )  # fmt: skip
        residual, took = solve(
            mesh.body, own, laws, motion, mesh.history, answer, kept_of(mesh.kept, place),
            mesh.work,
        )  # fmt: skip
        if residual == FULL:
            residual = _LOST
        mesh.counted[0] += took
        out[AT.residual] = max(out[AT.residual], residual)
        normal = _write(mesh, place, trial, at, tooth, side, v, dt, reach, out)
        out[AT.driving if side > 0 else AT.back] += normal
        to_space(angle, side, mesh.vectors)
        _act(mesh, mesh.vectors, q, damped)
        mesh.wrench[:] = 0.0
        wrench(mesh.body, own, answer, mesh.wrench)
        mesh.vectors[0] = mesh.wrench[:3]
        mesh.vectors[1] = mesh.wrench[3:]
        to_space(angle, side, mesh.vectors)
        _act(mesh, mesh.vectors, q, forces)
    shift[2] = 0.0
    for c in range(POSES):
        out[AT.damping] -= 0.5 * (committed[POSES + c] + damped[c]) * (q[c] - before[c])
        trial[c] = q[c]
        trial[POSES + c] = damped[c]
        forces[c] += damped[c]
