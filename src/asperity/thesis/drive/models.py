"""Figures 7.5, 7.6 and 7.7: the simulation's wheel, worm and asperity."""

import functools
import math
from typing import NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.flanks.export.worm import mounted_worm
from asperity.flanks.mesh.tooth import tooth
from asperity.flanks.wheel.enveloped import Wheel
from asperity.mesh import HexMesh
from asperity.results.dataset import described
from asperity.thesis.contact.derivatives import Before, scheme
from asperity.thesis.drive import drawings
from asperity.thesis.drive.claims import GEAR
from asperity.thesis.exhibits import Computed, figure
from asperity.thesis.flanks.meshing import pair_of
from asperity.thesis.flanks.shapes import Shape, joined

_INNER = ("inner",)
_OTHERS = (
    "flank_plus", "flank_minus", "fillet_plus", "fillet_minus", "tip", "face_low", "face_high",
)  # fmt: skip
_ELEMENT = 1.2  # mm
_TURNS, _POINTS = 9, 400


@functools.cache
def _wheel() -> Wheel:
    return Wheel.cut(pair_of(GEAR))


@functools.cache
def _ring() -> HexMesh:
    wheel = _wheel()
    return tooth(wheel, _ELEMENT, teeth=wheel.pair.geometry.wheel_teeth)


@figure("7.5", drawings.bore)
def _bore() -> Computed:
    ring = _ring()
    parts = [Shape.of_mesh(ring, sets, part) for part, sets in enumerate((_OTHERS, _INNER))]
    inner = parts[1].points
    angle = np.arctan2(inner[:, 0], inner[:, 1])
    linked = [int(np.argmin(np.abs(angle - a) + 0.05 * np.abs(inner[:, 2])))
              for a in np.linspace(-math.pi, math.pi, 24, endpoint=False)]  # fmt: skip
    dataset = described(
        **joined(parts).variables("ring"),
        linked=(("link", "xyz"), inner[linked], "mm", "some nodes that follow the centre point"),
        centre=(("xyz",), np.zeros(3), "mm", "the wheel's centre point"),
    )
    return dataset, [
        "asperity.flanks.mesh.tooth(wheel, 1.2, teeth=60) of gearset-3b, face set 'inner'"
    ]


def _spring(start: FloatArray, end: FloatArray, across: FloatArray) -> FloatArray:
    """Return a coil from one point to another."""
    along = end - start
    third = np.cross(along / np.linalg.norm(along), across)
    share = np.linspace(0.0, 1.0, _POINTS)
    # Straight at both ends.
    coil = np.clip((share - 0.15) / 0.7, 0.0, 1.0)
    size = 4.0 * ((coil > 0.0) & (coil < 1.0))
    turn = 2.0 * math.pi * _TURNS * coil
    return np.asarray(
        start
        + share[:, None] * along
        + (size * np.cos(turn))[:, None] * across
        + (size * np.sin(turn))[:, None] * third
    )


@figure("7.6", drawings.model)
def _model() -> Computed:
    pair = _wheel().pair
    worm = mounted_worm(pair)
    both = joined([Shape.of_mesh(_ring()), Shape.of_body(worm, 1, every=(2, 1))])
    across, upright, axis = pair.mounting.axes
    half = 0.5 * pair.geometry.worm_face_width
    middle = pair.mounting.origin
    a, b = middle + half * axis, middle + (half + 34.0) * axis
    dataset = described(
        **both.variables("gearset"),
        spring=(("along", "xyz"), _spring(a, b, across), "mm", "the shaft as a spring"),
        ends=(("end", "xyz"), np.array([a, b]), "mm", "A on the worm and B, which turns steadily"),
        axis=(("xyz",), axis, "1", "direction of the worm's axis, X of the thesis"),
        across=(
            ("side", "xyz"),
            np.array([across, upright]),
            "1",
            "directions across it, Y and Z",
        ),
    )
    return dataset, [
        f"{GEAR.command()} --out out/flank",
        "asperity.rating.shaft.torsional_stiffness(17.0, 150.0, 209000.0, 0.3)",
    ]


class Increment(NamedTuple):
    """Where body and asperity's root are in an increment of the scheme of 7.3, over s_max."""

    body: FloatArray  # N', N'', N'_1
    root: FloatArray  # M, M'1, M'2, M_1
    deflection: FloatArray  # s, s', s_1
    angles: FloatArray  # alpha, beta; rad


def increment(at: Before, x: float, y: float) -> Increment:
    """Return the places of an increment to a place of the body."""
    q = {name: value.real for name, value in scheme(at, x, y, 1.0).items()}
    s, s_1 = q["s"], q["s_1"]
    body = np.array([[0.0, at.n_y], [x, at.n_y], [x, y]])
    body[0, 0] = at.m_x + math.sqrt(at.s_0**2 - (at.n_y - at.m_y) ** 2)
    first = body[1] - s * np.array([q["cos_a"], q["sin_a"]])
    second = first + np.array([0.0, at.eta * (y - at.n_y)])
    last = body[2] - s_1 * np.array([q["cos_b"], q["sin_b"]])
    return Increment(
        body,
        np.array([[at.m_x, at.m_y], first, second, last]),
        np.array([at.s_0, s, s_1]),
        np.arctan2([q["sin_a"], q["sin_b"]], [q["cos_a"], q["cos_b"]]),
    )


@figure("7.7", drawings.increment)
def _increment() -> Computed:
    at = Before(0.0, 0.0, 0.3, 0.65, 1.0 - 0.71, 1.0)
    found = increment(at, 1.0, 0.85)
    dataset = described(
        axis=(("axis",), np.array(["x", "y"], dtype=object), "1", "axis"),
        body=(("place", "axis"), found.body, "1", "N', N'', N'_1 over s_max"),
        root=(("stop", "axis"), found.root, "1", "M, M'1, M'2, M_1 over s_max"),
        deflection=(("place",), found.deflection, "1", "s, s', s_1 over s_max"),
        angle=(("phase",), found.angles, "rad", "alpha, beta"),
    )
    return dataset, ["asperity.thesis.contact.derivatives.scheme"]
