"""The inside of a rim moves as a wheel does whose every tooth answers as one does."""

import numpy as np
import pytest

from asperity.drive.teeth.rim_moves import MovingRim

PITCH = 0.2
ALONG, OUT, ASIDE = np.array([0.4, -0.2, 0.1]), np.array([0.1, 1.0, 0.3]), np.array([0.0, 0.2, 0.8])


def answer(angle, z, force):
    """A field along, outwards and aside, that fades within some teeth of the one loaded."""
    fades = np.exp(-0.5 * (angle / PITCH) ** 2) * (1.0 + 30.0 * z)
    # No two directions alike, nor the two ways round.
    one = fades * (1.0 + 0.3 * angle / PITCH)
    return np.stack([one * (way @ force) for way in (ALONG, OUT, ASIDE)], axis=-1)


def turned(field, angle):
    along, out, aside = field.T
    return np.stack(
        [along * np.cos(angle) + out * np.sin(angle),
         out * np.cos(angle) - along * np.sin(angle), aside], axis=-1,
    )  # fmt: skip


@pytest.fixture(scope="module")
def rim():
    rng = np.random.default_rng(7)
    angle = np.repeat((np.arange(12) + 0.5) / 12.0 * PITCH - 0.5 * PITCH, 5)
    z = np.tile(np.linspace(-6e-3, 6e-3, 5), 12)
    order = rng.permutation(angle.size)
    angle, z = angle[order], z[order]
    blocks = {
        m: np.stack(
            [turned(answer(angle + m * PITCH, z, force), angle).ravel() for force in np.eye(3)],
            axis=1,
        )
        for m in range(-4, 5)
    }  # fmt: skip
    return MovingRim(PITCH, angle, z, blocks)


@pytest.mark.parametrize(
    "forces",
    [
        {0: [3.0, -2.0, 1.0]},
        {1: [0.0, 4.0, 0.0]},
        {-1: [1.0, 5.0, -2.0], 0: [0.0, 1.0, 0.0], 2: [2.0, 0.0, 3.0]},
    ],
    ids=["own", "next", "three"],
)
def test_between_its_nodes_and_over_teeth_it_moves_as_the_field_it_is_made_of(rim, forces):
    phi = np.array([-1.4, -0.5, -0.31, 0.0, 0.2, 0.5, 0.77, 1.5]) * PITCH
    z = np.array([-6e-3, -1e-3, 0.5e-3, 2e-3, 6e-3, -4e-3, 3.3e-3, 0.0])
    points = np.stack([30e-3 * np.sin(phi), 30e-3 * np.cos(phi), z], axis=1)
    found = rim.at(points, {m: np.array([force]) for m, force in forces.items()})
    expected = sum(
        # A tooth's force is in its own frame, and so is its answer along the rim and outwards.
        turned(answer(phi - m * PITCH, z, np.array(force)), phi)
        for m, force in forces.items()
    )
    assert found == pytest.approx(expected, abs=2e-3 * np.abs(expected).max())


def test_beyond_the_face_it_moves_as_at_its_end_and_without_a_web_not_at_all(rim):
    points = np.array([[1e-3, 30e-3, 6e-3], [1e-3, 30e-3, 7e-3]])
    force = {0: np.array([[1.0, 2.0, 3.0]])}
    at_end, beyond = rim.at(points, force)
    assert beyond == pytest.approx(at_end, rel=1e-12)
    rigid = MovingRim(PITCH, np.zeros(0), np.zeros(0), {})
    assert not rigid.at(points, force).any()
