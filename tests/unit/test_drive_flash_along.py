"""Flash temperatures along a contact: each band by its own load, width, place and speeds."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.resolved.strip import FLANK, WHEEL_TIP
from asperity.drive.static.flash import SHARE, Flash
from asperity.drive.static.reduction import _along

ACROSS, ALONG = 2e-4, 1e-3
SLIDING, WORM, WHEEL = np.array([3.0, 5.0]), np.array([-0.4, 0.9]), np.array([0.16, 0.25])
WORM_ALONG, WHEEL_ALONG = np.array([2.0, -4.0]), np.array([0.5, 0.0])
LENGTH = 5e-3


def flash():
    # A flank of two points, below half of its height and above.
    asked = []

    def nearest(share, z):
        asked.append((share, z))
        return (share > 0.5).astype(int)

    wheel = SimpleNamespace(family="tin bronze")
    problem = SimpleNamespace(worm_speed=150.0, gearset=SimpleNamespace(wheel_material=wheel))
    one = Flash(problem, SimpleNamespace(nearest=nearest), 0.05)
    one._effusivities = 2e4, 9e3
    one.__dict__["_motion"] = np.array([SLIDING, WORM, WHEEL, WORM_ALONG, WHEEL_ALONG])
    return one, asked


def tooth(force, share, zone=FLANK):
    rows, columns = np.shape(force)
    z = np.tile(np.arange(columns) * ALONG, (rows, 1))
    z[-1] += 0.3e-3
    points = np.stack([np.zeros(z.size), np.ones(z.size), z.ravel()], axis=1)
    frame = SimpleNamespace(shape=(rows, columns), spacing=(ACROSS, ALONG))
    strip = SimpleNamespace(frame=frame, points=points, share=np.ravel(share))
    strip.zone = np.ravel(np.broadcast_to(zone, (rows, columns)))
    return SimpleNamespace(
        force=np.ravel(np.array(force, dtype=float)), strip=strip, extent=lambda: (LENGTH, ACROSS)
    )


def test_a_band_is_as_hot_as_blok_has_it():
    one, asked = flash()
    force = [[1.0, 0.0, 4.0], [3.0, 0.0, 0.0], [0.0, 0.0, 4.0]]
    share = [[0.2, 0.9, 0.6], [0.4, 0.9, 0.9], [0.9, 0.9, 0.8]]
    line = one._along(tooth(force, share))
    # Columns that bear nothing are left out; the others stand where their forces' middle is.
    assert line.face == pytest.approx([0.0, 2e-3 + 0.5 * 0.3e-3])
    assert asked[0][0] == pytest.approx([0.25 * 0.2 + 0.75 * 0.4, 0.7])
    assert asked[0][1] == pytest.approx(line.face)
    for n, (whole, wide, at) in enumerate(((4.0, 2, 0), (8.0, 2, 1))):
        slender = wide * ACROSS / LENGTH
        worm, wheel = (
            (across[at] ** 2 + (slender * along[at]) ** 2) ** 0.25
            for across, along in ((WORM, WORM_ALONG), (WHEEL, WHEEL_ALONG))
        )
        carried = 2e4 * worm + 9e3 * wheel
        rise = SHARE * 0.05 * whole / ALONG * SLIDING[at] / carried / (wide * ACROSS) ** 0.5
        assert line.rise[n] == pytest.approx(rise)


def test_the_hottest_tooth_of_a_phase_counts_and_the_hottest_phase_is_kept():
    one, _ = flash()
    share = [[0.2], [0.2], [0.2]]
    mild, hot = tooth([[1.0], [0.0], [0.0]], share), tooth([[4.0], [0.0], [0.0]], share)
    none = tooth([[0.0], [0.0], [0.0]], share)
    for teeth in ([mild, none], [mild, hot], [none], [mild]):
        one.take(SimpleNamespace(teeth=teeth))
    assert one.course[1] == pytest.approx(4.0 * one.course[0])
    assert one.course[2:] == [0.0, one.course[0]]
    assert one.worst.rise == pytest.approx([one.course[1]])


def test_what_an_edge_bears_counts_for_the_largest_and_not_for_the_flank_s():
    one, _ = flash()
    share = [[0.2, 0.2]]
    # The last place bears on the wheel's tip, four times as much.
    whole = tooth([[1.0, 4.0]], share, [[FLANK, WHEEL_TIP]])
    one.take(SimpleNamespace(teeth=[whole]))
    assert one.worst.on_edge.tolist() == [False, True]
    assert one.course == [pytest.approx(4.0 * one.on_flank)]
    assert one.worst.hottest == pytest.approx(ALONG, rel=0.5)
    # Of no flank there is none.
    edge, _ = flash()
    edge.take(SimpleNamespace(teeth=[tooth([[1.0]], [[0.2]], WHEEL_TIP)]))
    assert edge.on_flank == 0.0 < edge.course[0]


def test_friction_s_work_is_of_what_lies_in_the_surface_alone():
    # Teeth of a body of three nodes, each its own spring for each direction.
    compliances = np.arange(1.0, 10.0)
    force, normal = np.zeros((3, 8, 3)), np.zeros((3, 8, 3))
    normal[..., 2] = 1.0
    force[0, 0], force[0, 1] = (3.0, 0.0, 50.0), (1.0, 4.0, 20.0)
    force[2, :4] = 0.0, 0.0, 9.0

    def spread(k, along, nodal):
        nodal.reshape(-1, 3)[k] += along.sum(axis=0)

    contact = SimpleNamespace(
        slots=3, sector=SimpleNamespace(
            body=SimpleNamespace(nodes=3, flexibility=np.diag(compliances))
        ),
        candidates=SimpleNamespace(counts=np.array([[2], [0], [1]])),
        answer=SimpleNamespace(force=force, normal=normal), spread=spread,
    )  # fmt: skip
    work, squares = _along(contact)
    assert work == pytest.approx(1.0 * 4.0**2 + 2.0 * 4.0**2)
    assert squares == pytest.approx(4.0**2 + 4.0**2)
    force[1] = force[0]
    contact.candidates.counts[1] = 1
    # Teeth that share the friction: its square is of the sum.
    work, squares = _along(contact)
    assert work == pytest.approx(48.0 + (4.0 + 5.0) * 4.0**2)
    assert squares == pytest.approx(4.0 * 32.0)
