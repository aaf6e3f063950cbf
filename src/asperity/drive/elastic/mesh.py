r"""Elastic teeth as the march advances them: each tooth's contact solved for, on both flanks.

A step solves normal approach, the asperities' friction and the teeth's own give together, tooth by
tooth, implicitly. What is remembered stands at the points that touch alone: deflection of the
asperities and force, in the tooth's own frame; a tooth that leaves the mesh touches nothing any
more, and its place is taken by one that enters. So nothing has to be handed over at a pitch.

The contact's damping stands beside teeth and contact together, as in the reduced mesh: a force
:math:`c\,p\,\dot d` at each point, with the rate at which worm and wheel, both rigid, approach
each other there.

Teeth that give way to each other's load on the rim (`asperity.drive.elastic.rim`) are solved in
turn until they agree.

Which faces are near is looked up anew before worm and tooth have come as close as it reached.
"""

import math

from asperity.contact.candidates.newton import FULL, solve, spread
from asperity.contact.candidates.records import (
    answer_of,
    candidates_of,
    kept_of,
)
from asperity.contact.candidates.wrench import place_of, wrench
from asperity.contact.interface.counter_motion import MotionNumbers
from asperity.drive.elastic.friction import find_shares, laws_at
from asperity.drive.elastic.memory import HEAD, POINT, TOOTH, block_of, bring, displace, points_at
from asperity.drive.elastic.near import AHEAD, gathered_near, reach_of
from asperity.drive.elastic.rim import answered, disagreement, moved_by, taken
from asperity.drive.interface import AT, POSES
from asperity.drive.teeth.placing import place_worm, to_space
from asperity.kernels.compiled import kernel
from asperity.kernels.dense import copy

_LOST = 1.0  # residual of a tooth of which too much touches

# Of the elastic energy: work that teeth which give way to each other may be apart by.
_AGREED = 1e-3
_SWEEPS = 12


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
def _approach(mesh, side, q, v, x, y, z, nx, ny, nz):
    """Rate at which the worm's surface approaches a place of a tooth along its normal, m/s."""
    ex, ey, ez = mesh.rotation[1, 0, 2], mesh.rotation[1, 1, 2], mesh.rotation[1, 2, 2]
    t = mesh.translation[1]
    ax, ay, az = x - t[0], y - t[1], z - t[2]
    wheel = v[2] if side > 0 else -v[2]
    along = v[3] if side > 0 else -v[3]
    vx = v[0] * (ey * az - ez * ay) - v[1] * ex + wheel * y
    vy = v[0] * (ez * ax - ex * az) - v[1] * ey - wheel * x
    vz = v[0] * (ex * ay - ey * ax) - v[1] * ez + along
    nearer = 0.0
    if v[4] != 0.0:
        # The worm's own axes as they stood before it turned.
        c, s = math.cos(q[0]), math.sin(q[0])
        turned = mesh.rotation[1]
        nearer += (c * turned[0, 0] - s * turned[0, 1]) * nx
        nearer += (c * turned[1, 0] - s * turned[1, 1]) * ny
        nearer += (c * turned[2, 0] - s * turned[2, 1]) * nz
    return vx * nx + vy * ny + vz * nz + v[4] * nearer


@kernel
def _write(mesh, k, trial, at, tooth, side, share, q, v, dt, reach, out):
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
    first = at + points_at(mesh)
    for point in range(4 * own.counts[0]):
        w = own.weights[point]
        p = answer.pressure[point]
        n = answer.normal[point]
        s0 = history.deflection[point]
        s1 = answer.deflection[point]
        if bristle > 0.0 and (p > 0.0 or history.size[point] > 0.0):
            slip = answer.slip_1[point]
            for c in range(3):
                out[AT.friction] += (
                    0.5 * w * bristle * (s0[c] + s1[c]) * (slip[c] - (s1[c] - s0[c]))
                )
                out[AT.stored] += 0.5 * w * bristle * s1[c] * s1[c]
        gap = answer.distance[point]
        rate = 0.0
        if p > 0.0 or gap < reach:
            x, y, z = place_of(own, shapes, answer.u, point)
            rate = _approach(mesh, side, q, v, x, y, z, n[0], n[1], n[2])
            if gap - AHEAD * max(rate, 0.0) * dt < 0.0:
                out[AT.approach] = max(out[AT.approach], abs(rate))
        if p <= 0.0:
            continue
        entry = first + POINT.end * count
        count += 1
        trial[entry + POINT.number] = 4.0 * own.face[point // 4] + point % 4
        trial[entry + POINT.size] = share * answer.size[point]
        elastic = 0.0
        face = point // 4
        for c in range(3):
            f = w * answer.traction[point, c]
            answer.force[point, c] = f
            trial[entry + POINT.deflection + c] = s1[c]
            trial[entry + POINT.force + c] = f
            trial[entry + POINT.earlier + c] = mesh.earlier[point, c]
            u = 0.0
            for b in range(4):
                u += shapes[point % 4, b] * answer.u[3 * own.faces[face, b] + c]
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
    trial[at + TOOTH.number] = tooth
    trial[at + TOOTH.touching] = count
    way = 0.0
    for i in range(own.counts[1]):
        j = 3 * own.nodes[i]
        for c in range(3):
            way = max(way, abs(answer.u[j + c] - mesh.shape[k, j + c]))
    # Along the normal at most the length of what each direction has moved.
    mesh.gathered[k].way = math.sqrt(3.0) * way
    copy(mesh.rim.given[k], mesh.rim.seen[k])
    spread(own, shapes, answer.force, mesh.work.nodal)
    taken(mesh.rim, k, own.nodes, own.counts[1], mesh.work.nodal)
    return normal


@kernel
def _act(mesh, vectors, q, forces):
    """Add what a force and moment on the wheel are in the drive's coordinates."""
    stand = mesh.stand
    fx, fy, fz = vectors[0, 0], vectors[0, 1], vectors[0, 2]
    e, inward, o = stand.axes[2], stand.axes[0], stand.origin
    # About the worm's axis, which its shift along it leaves where it is.
    ox, oy = o[0] + q[4] * inward[0], o[1] + q[4] * inward[1]
    oz = o[2] + q[4] * inward[2]
    mx = vectors[1, 0] - (oy * fz - oz * fy)
    my = vectors[1, 1] - (oz * fx - ox * fz)
    mz = vectors[1, 2] - (ox * fy - oy * fx)
    # The wheel's shift moves the worm, seen from it: the moment about the axis takes it along.
    along = q[3]
    mx -= -along * fy
    my -= along * fx
    forces[0] -= e[0] * mx + e[1] * my + e[2] * mz
    forces[1] += e[0] * fx + e[1] * fy + e[2] * fz
    forces[2] += vectors[1, 2]
    forces[3] -= fz
    forces[4] -= inward[0] * fx + inward[1] * fy + inward[2] * fz


@kernel
def _number(mesh, place, q):
    """The tooth of a place: that of its teeth which is nearest to the middle of the mesh."""
    own = place % mesh.teeth
    angle = q[2] + mesh.ahead
    return mesh.teeth * round((-angle / mesh.stand.pitch - own) / mesh.teeth) + own


@kernel
def _expect(mesh, committed, block, numbers):
    """Write what the teeth's loads on each other go on to from the last two steps."""
    rim = mesh.rim
    count = rim.shapes.shape[1]
    for place in range(numbers.shape[0]):
        at = HEAD + place * block
        side = 1 if place < mesh.teeth else -1
        there = (
            committed[at + TOOTH.number] == side * numbers[place]
            and committed[at + TOOTH.touching] > 0.0
        )
        for i in range(count):
            load = 0.0
            if there:
                load = (
                    2.0 * committed[at + TOOTH.moved + count + i]
                    - committed[at + TOOTH.moved + 2 * count + i]
                )
            rim.loads[place, i] = load


@kernel
def _tooth(mesh, place, tooth, committed, trial, at, q, v, dt, reach, out):
    """Solve for one tooth and add what it does; its memory is written."""
    side = 1 if place < mesh.teeth else -1
    share = mesh.sliding.share[0 if side > 0 else 1]
    laws = laws_at(mesh.laws if side > 0 else mesh.back, share)
    stand, shift, before = mesh.stand, mesh.moved, committed[:POSES]
    angle = q[2] + mesh.ahead + stand.pitch * tooth
    rim = mesh.rim
    count = rim.shapes.shape[1]
    same = committed[at + TOOTH.number] == tooth
    trial[at + TOOTH.number] = tooth
    trial[at + TOOTH.touching] = 0.0
    for i in range(count):
        trial[at + TOOTH.moved + i] = rim.given[place, i]
        trial[at + TOOTH.moved + count + i] = 0.0
        trial[at + TOOTH.moved + 2 * count + i] = (
            committed[at + TOOTH.moved + count + i] if same else 0.0
        )
    shift[0], shift[2] = q[4], -q[1]
    place_worm(stand, q[0], shift, angle, q[3], side, mesh.rotation[1], mesh.translation[1])
    touched = same and committed[at + TOOTH.touching] > 0.0
    near = gathered_near(mesh, place, laws, committed, at, tooth, q, reach)
    if not near and not touched:
        rim.loads[place] = 0.0
        return
    shift[0], shift[2] = before[4], -before[1]
    place_worm(
        stand, before[0], shift, before[2] + mesh.ahead + stand.pitch * tooth, before[3], side,
        mesh.rotation[0], mesh.translation[0],
    )  # fmt: skip
    _drifted(mesh)
    own, answer = candidates_of(mesh.candidates, place), answer_of(mesh.answer, place)
    bring(mesh, place, committed, at, tooth, share)
    displace(
        mesh,
        place,
        committed,
        at,
        tooth,
        False,
        own.nodes,
        own.counts[1],
        mesh.history.displacement,
    )
    if count > 0:
        for i in range(own.counts[1]):
            j = 3 * own.nodes[i]
            answer.free[j] = answer.free[j + 1] = answer.free[j + 2] = 0.0
        moved_by(rim, rim.given[place], False, own.nodes, own.counts[1], answer.free)
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
    normal = _write(mesh, place, trial, at, tooth, side, share, q, v, dt, reach, out)
    for i in range(count):
        trial[at + TOOTH.moved + count + i] = rim.loads[place, i]
    out[AT.driving if side > 0 else AT.back] += normal
    to_space(angle, side, mesh.vectors)
    _act(mesh, mesh.vectors, q, mesh.damped)
    mesh.wrench[:] = 0.0
    wrench(mesh.body, own, answer, mesh.wrench)
    for c in range(3):
        mesh.vectors[0, c] = mesh.wrench[c]
        mesh.vectors[1, c] = mesh.wrench[3 + c]
    to_space(angle, side, mesh.vectors)
    _act(mesh, mesh.vectors, q, out[:POSES])


@kernel
def advance(mesh, committed, trial, q, v, dt, out):
    """Advance the mesh over a step, see `asperity.drive.interface`."""
    find_shares(mesh.sliding, v)
    solve_teeth(mesh, committed, trial, q, v, dt, out)


@kernel
def solve_teeth(mesh, committed, trial, q, v, dt, out):
    """Solve for all teeth at the end of a step; as `advance`, with friction as it was found."""
    block = block_of(mesh)
    rim, numbers, damped = mesh.rim, mesh.numbers, mesh.damped
    reach = reach_of(mesh, v, dt)
    for place in range(numbers.shape[0]):
        # The other flank's frame is turned about: its teeth follow one another the other way.
        numbers[place] = (1 if place < mesh.teeth else -1) * _number(mesh, place, q)
    _expect(mesh, committed, block, numbers)
    for sweep in range(_SWEEPS):
        out[:] = 0.0
        damped[:] = 0.0
        for place in range(numbers.shape[0]):
            first = 0 if place < mesh.teeth else mesh.teeth
            tooth = numbers[place] if first == 0 else -numbers[place]
            answered(rim, numbers, first, first + mesh.teeth, place, rim.given[place])
            at = HEAD + place * block
            _tooth(mesh, place, tooth, committed, trial, at, q, v, dt, reach, out)
        if rim.answers.shape[0] == 0:
            break
        apart = disagreement(rim, numbers, mesh.teeth, mesh.amplitude)
        if apart <= _AGREED * out[AT.stored]:
            break
        if sweep + 1 == _SWEEPS:
            out[AT.residual] = max(out[AT.residual], apart / out[AT.stored])
    mesh.moved[0] = mesh.moved[2] = 0.0
    for c in range(POSES):
        out[AT.damping] -= 0.5 * (committed[POSES + c] + damped[c]) * (q[c] - committed[c])
        trial[c] = q[c]
        trial[POSES + c] = damped[c]
        out[c] += damped[c]
