"""Which faces of a body are near its counter-surface."""

from asperity.contact.interface.rigid import distance
from asperity.kernels.compiled import kernel


@kernel
def own_distance(x, y, z, surface, r, translation):
    """Distance of a point to a surface where it stands, m."""
    x -= translation[0]
    y -= translation[1]
    z -= translation[2]
    return distance(
        r[0, 0] * x + r[1, 0] * y + r[2, 0] * z,
        r[0, 1] * x + r[1, 1] * y + r[2, 1] * z,
        r[0, 2] * x + r[1, 2] * y + r[2, 2] * z,
        surface,
    )[0]


@kernel
def least_gap(body, surface, rotation, translation):
    """Least distance of a body's undeformed points to a surface, m."""
    least = 1e300
    for q in range(body.places.shape[0]):
        p = body.places[q]
        least = min(least, own_distance(p[0], p[1], p[2], surface, rotation, translation))
    return least


@kernel
def collect(body, surface, rotation, translation, u, gap, candidates):
    """Gather the faces with a point nearer than ``gap``, m; the least distance of all points.

    ``u`` displaces the nodes, (3n,), m.
    """
    counts, seen, place = candidates.counts, candidates.seen, candidates.place
    width = body.faces.shape[1]
    rule = body.shapes.shape[0]
    for i in range(counts[1]):
        seen[candidates.nodes[i]] = 0
    faces = 0
    nodes = 0
    least = 1e300
    for k in range(body.faces.shape[0]):
        nearest = 1e300
        for at in range(rule):
            q = k * rule + at
            x = body.places[q, 0]
            y = body.places[q, 1]
            z = body.places[q, 2]
            for a in range(width):
                j = 3 * body.faces[k, a]
                x += body.shapes[at, a] * u[j]
                y += body.shapes[at, a] * u[j + 1]
                z += body.shapes[at, a] * u[j + 2]
            nearest = min(nearest, own_distance(x, y, z, surface, rotation, translation))
        least = min(least, nearest)
        place[k] = -1
        if nearest >= gap:
            continue
        place[k] = faces
        candidates.face[faces] = k
        for a in range(width):
            node = body.faces[k, a]
            candidates.faces[faces, a] = node
            if seen[node] == 0:
                seen[node] = 1
                candidates.nodes[nodes] = node
                nodes += 1
        for at in range(rule):
            q = k * rule + at
            to = faces * rule + at
            candidates.weights[to] = body.weights[q]
            for c in range(3):
                candidates.places[to, c] = body.places[q, c]
        faces += 1
    counts[0] = faces
    counts[1] = nodes
    return least
