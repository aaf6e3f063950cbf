"""Worm and wheel in mesh and turning, as a GLB small enough to mail."""

import math
import os
from pathlib import Path

import numpy as np

from asperity.flanks.export import tooth, worm
from asperity.flanks.export.assembly import Assembly
from asperity.flanks.export.patch import Body
from asperity.flanks.export.turned import Beside, blanks_of
from asperity.flanks.wheel.enveloped import Wheel
from asperity.flanks.wheel.frame import turned
from asperity.gearset.blanks import wheel_section
from asperity.mesh.glb import Node, write_glb

STEEL, BRONZE = (0.68, 0.71, 0.75), (0.85, 0.66, 0.38)
"""Colours of worm and wheel: red, green and blue, 0 to 1."""

_SECONDS = 6.0
"""For a turn of the worm."""


def gearset_scene(wheel: Wheel, assembly: Assembly, beside: Beside = None) -> Node:
    """Return worm and whole wheel in mesh, upright, z being up.

    A tooth is there once. In a cycle the worm turns once, and the wheel by as many teeth as the
    worm has starts, so that the end is as the beginning.
    """
    pair = assembly.pair
    starts, teeth = pair.geometry.starts, pair.geometry.wheel_teeth
    one = tooth.shown_tooth(wheel).surface()
    section = wheel_section(pair.geometry, blanks_of(beside))
    ring = [
        Node(f"tooth {number + 1}", one, turned(2.0 * math.pi * number / teeth), colour=BRONZE)
        for number in range(teeth)
    ]
    hub = Node("hub", Body("hub", [], [], [section]).surface(), colour=BRONZE)
    own = worm.wheel_shaft(beside)
    if own is not None:
        ring.append(Node("shaft", own.surface(), assembly.shaft_turn, colour=STEEL))
    nodes = [
        Node(
            "worm",
            worm.whole_worm(pair, beside, worm.SHOWN).surface(),
            assembly.worm_rotation,
            assembly.worm_place,
            turns=1.0,
            colour=STEEL,
        ),
        Node(
            "wheel",
            rotation=assembly.wheel_rotation,
            place=np.zeros(3),
            children=[hub, *ring],
            turns=starts / teeth,
        ),
    ]
    # Upright, the worm above: the file's z is up, which in the gearset's own frame is y.
    upright = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    return Node("gearset", rotation=upright, children=nodes)


def write_gearset(path: str | os.PathLike[str], scene: Node) -> Path:
    """Write a scene as a GLB that turns worm and wheel by their ratio, atomically."""
    return write_glb(path, [scene], seconds=_SECONDS)
