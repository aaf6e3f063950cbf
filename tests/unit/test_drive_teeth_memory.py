"""What elastic teeth remember comes back to the points it was of, and nothing to the others."""

from types import SimpleNamespace

import numpy as np
import pytest

from asperity.drive.elastic import memory
from asperity.drive.elastic.memory import POINT, TOOTH

_AT, _SHARE = 5, 0.8


def remembered(tooth, points):
    """Memory of one tooth, by number of the point: deflection, size, force, force before."""
    shapes = 2
    committed = np.full(_AT + TOOTH.moved + 3 * shapes + POINT.end * (len(points) + 1), 7.0)
    committed[_AT + TOOTH.number], committed[_AT + TOOTH.touching] = tooth, len(points)
    for i, (number, (deflection, size, force, earlier)) in enumerate(points.items()):
        entry = _AT + TOOTH.moved + 3 * shapes + POINT.end * i
        committed[entry : entry + POINT.end] = number, *deflection, size, *force, *earlier
    return committed


def brought(monkeypatch, committed, tooth):
    # Faces 0 to 3, of which 1 and 3 are near enough to touch: points 4 to 7 and 12 to 15.
    own = SimpleNamespace(counts=[2], place=np.array([-1, 0, -1, 1]))
    monkeypatch.setattr(memory, "candidates_of", lambda candidates, k: own)
    monkeypatch.setattr(memory, "points_at", memory.points_at._function)
    rng = np.random.default_rng(37)
    mesh = SimpleNamespace(
        candidates=None, rim=SimpleNamespace(shapes=np.zeros((1, 2))),
        history=SimpleNamespace(size=rng.normal(size=9), deflection=rng.normal(size=(9, 3))),
        answer=SimpleNamespace(force=rng.normal(size=(2, 9, 3))), earlier=rng.normal(size=(9, 3)),
    )  # fmt: skip
    of_others = mesh.answer.force[0].copy(), mesh.history.size[8]
    count = memory.bring._function(mesh, 1, committed, _AT, tooth, _SHARE)
    # Another flank's forces, and what lies behind the points, are nobody's business.
    assert np.array_equal(mesh.answer.force[0], of_others[0])
    assert mesh.history.size[8] == of_others[1]
    return (
        count,
        mesh.history.size[:8],
        mesh.history.deflection[:8],
        mesh.answer.force[1, :8],
        (mesh.earlier[:8]),
    )


def test_points_that_touched_go_on_and_the_others_begin_with_nothing(monkeypatch):
    rng = np.random.default_rng(36)
    points = {
        number: (rng.normal(size=3), rng.uniform(1.0, 2.0), *rng.normal(size=(2, 3)))
        for number in (6, 9, 13)
    }
    count, size, deflection, force, earlier = brought(monkeypatch, remembered(3, points), 3)
    assert count == 3
    # Point 6 is the third of the first face that is near; 9 is of a face that is not.
    for q, number in {2: 6, 5: 13}.items():
        bent, limit, now, before = points[number]
        assert size[q] == pytest.approx(limit / _SHARE)
        assert deflection[q] == pytest.approx(bent)
        assert force[q] == pytest.approx(now + (now - before))
        assert earlier[q] == pytest.approx(now)
    others = [0, 1, 3, 4, 6, 7]
    for part in (size, deflection, force, earlier):
        assert not part[others].any()


def test_a_tooth_that_comes_new_remembers_nothing_of_the_one_before(monkeypatch):
    points = {6: (np.ones(3), 1.0, np.ones(3), np.ones(3))}
    count, *parts = brought(monkeypatch, remembered(3, points), 4)
    assert count == 0
    assert not any(part.any() for part in parts)
