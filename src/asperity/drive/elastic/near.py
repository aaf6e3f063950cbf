"""Which faces of a tooth are near the worm, looked up anew as it has come closer."""

import math

from asperity.contact.candidates.faces import collect
from asperity.contact.candidates.records import candidates_of
from asperity.drive.elastic.memory import displace
from asperity.drive.elastic.rim import way_of
from asperity.drive.interface import POSES
from asperity.kernels.compiled import kernel

AHEAD = 4.0  # steps in which surfaces are about to touch
_NEAR = 3e-6  # to the worm, within which faces are looked at, m


@kernel
def _travelled(mesh, seen, q):
    """By how much a point of a tooth may have come closer since its faces were gathered, m.

    A worm's turn is a shift along its axis; of the wheel's turn the part at the middle of the
    flank goes along with it.
    """
    places = mesh.body.places
    middle = places[places.shape[0] // 2, 1]
    was = seen.poses
    worm = mesh.stand.lead * (q[0] - was[0]) + (q[1] - was[1])
    wheel = q[2] - was[2]
    # Half the height of a tooth and how far it stands from the middle of the mesh: of its pitch.
    reach = 3.0 * mesh.stand.pitch * middle
    across = abs(q[3] - was[3]) + abs(q[4] - was[4])
    return abs(worm - middle * wheel) + reach * abs(wheel) + across


@kernel
def reach_of(mesh, v, dt):
    """How near to the worm a tooth's points may touch or be about to, m."""
    middle = mesh.body.places[mesh.body.places.shape[0] // 2, 1]
    # The thread's slope brings the worm closer as the wheel shifts: less than its whole way.
    rate = abs(mesh.stand.lead * v[0] + v[1] - middle * v[2]) + abs(v[3]) + abs(v[4])
    return max(_NEAR, AHEAD * rate * dt)


@kernel
def gathered_near(mesh, k, laws, committed, at, tooth, q, reach):
    """Gather a tooth's faces near the worm, unless those there are will do; if any are near."""
    seen = mesh.gathered[k]
    if seen.tooth == tooth:
        way = _travelled(mesh, seen, q) + seen.way + way_of(mesh.rim, k)
        if way + reach <= seen.reach:
            return mesh.candidates.counts[k, 0] > 0
        if seen.least_gap - way > reach:
            return False
    u = mesh.shape[k]
    own = candidates_of(mesh.candidates, k)
    displace(mesh, k, committed, at, tooth, True, own.nodes, 0, u)
    seen.least_gap = collect(
        mesh.body, laws.interface.counter, mesh.rotation[1], mesh.translation[1], u, 2.0 * reach,
        own,
    )  # fmt: skip
    seen.tooth = tooth
    for c in range(POSES):
        seen.poses[c] = q[c]
    seen.reach = 2.0 * reach
    seen.way = 0.0
    rim, same = mesh.rim, committed[at] == tooth
    for i in range(rim.seen.shape[1]):
        rim.seen[k, i] = committed[at + 2 + i] if same else rim.given[k, i]
    return own.counts[0] > 0


@kernel
def forget(mesh):
    """Forget what earlier steps left for those after them, so that a march goes on from its state.

    Which faces were gathered and by which inverse a tooth was solved shows in the last digits.
    """
    for k in range(mesh.gathered.size):
        mesh.gathered[k].tooth = math.inf
    mesh.kept.size[:] = 0
