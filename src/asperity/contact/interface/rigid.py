"""Rigid counter-surfaces as signed distance with gradient and Hessian, and where they stand.

Each surface has its own frame; a `Pose` puts it into space. The distance is positive outside the
rigid material, so that its gradient is the normal along which the surface pushes.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import InputError
from asperity.flanks.worm import distance as worm
from asperity.flanks.worm.curve import FORM, Thread
from asperity.kernels.compiled import kernel

if TYPE_CHECKING:
    # No kernel follows from it.
    from asperity.flanks.worm.helicoid import Helicoid

PLANE = 0
SPHERE = 1
CYLINDER = 2
WORM = 3

# The flanks are in mm.
_MM = 1e3

# Of a surface that is no worm.
_NO_WORM = Thread(np.zeros((), FORM)[()], np.empty((0, 3)))


class Numbers(NamedTuple):
    """A surface as the kernels take it."""

    kind: int  #: `PLANE`, `SPHERE`, `CYLINDER` or `WORM`
    #: radius, side: Of sphere and cylinder, m; -1 where the material is outside
    radius: float = 0.0
    side: float = 1.0
    worm: Thread = _NO_WORM  #: The worm, in mm


@kernel
def distance(x, y, z, surface):
    """Signed distance of a point in the surface's own frame, m, with gradient and Hessian.

    Ten floats: the distance, the gradient's three, and the Hessian's xx, yy, zz, xy, xz, yz, 1/m.
    """
    if surface.kind == SPHERE:
        size = math.sqrt(x * x + y * y + z * z)
        side = surface.side
        if size == 0.0:
            return -side * surface.radius, 0.0, 0.0, side, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        nx = x / size
        ny = y / size
        nz = z / size
        bend = side / size
        return (
            side * (size - surface.radius), side * nx, side * ny, side * nz,
            bend * (1.0 - nx * nx), bend * (1.0 - ny * ny), bend * (1.0 - nz * nz),
            -bend * nx * ny, -bend * nx * nz, -bend * ny * nz,
        )  # fmt: skip
    if surface.kind == CYLINDER:
        size = math.sqrt(x * x + y * y)
        side = surface.side
        if size == 0.0:
            return -side * surface.radius, side, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        nx = x / size
        ny = y / size
        bend = side / size
        return (
            side * (size - surface.radius), side * nx, side * ny, 0.0,
            bend * ny * ny, bend * nx * nx, 0.0, -bend * nx * ny, 0.0, 0.0,
        )  # fmt: skip
    if surface.kind == WORM:
        d, nx, ny, nz, hxx, hyy, hzz, hxy, hxz, hyz = worm.distance(
            _MM * x, _MM * y, _MM * z, surface.worm
        )
        return (
            d / _MM, nx, ny, nz,
            _MM * hxx, _MM * hyy, _MM * hzz, _MM * hxy, _MM * hxz, _MM * hyz,
        )  # fmt: skip
    return z, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0


@dataclass(frozen=True, eq=False)
class RigidSurface:
    """A rigid surface in its own frame."""

    name: str  #: What it is
    numbers: Numbers  #: As `distance` takes them

    @classmethod
    def plane(cls) -> RigidSurface:
        """Plane z = 0 with the material below."""
        return cls("plane", Numbers(PLANE))

    @classmethod
    def sphere(cls, radius: float, *, inside: bool = False) -> RigidSurface:
        """Sphere about the origin; ``inside``: a hollow, the material outside of it."""
        return cls("sphere", _round(SPHERE, radius, inside))

    @classmethod
    def cylinder(cls, radius: float, *, inside: bool = False) -> RigidSurface:
        """Cylinder about the z axis; ``inside``: a bore, the material outside of it."""
        return cls("cylinder", _round(CYLINDER, radius, inside))

    @classmethod
    def worm(cls, helicoid: Helicoid, *, side: int = 0) -> RigidSurface:
        """Worm about the z axis; ``side``: flank 1 or -1, 0 for the nearest."""
        return cls("worm", Numbers(WORM, worm=helicoid.facing(side)))


def _round(kind: int, radius: float, inside: bool) -> Numbers:
    if not (math.isfinite(radius) and radius > 0.0):
        raise InputError(f"radius is {radius:g} m; it must be positive")
    return Numbers(kind, float(radius), -1.0 if inside else 1.0)


@dataclass(frozen=True, eq=False)
class Pose:
    """Where a surface stands: ``x = rotation @ own + translation``."""

    rotation: FloatArray = field(default_factory=lambda: np.eye(3))  #: (3, 3): Proper rotation
    translation: FloatArray = field(default_factory=lambda: np.zeros(3))  #: (3,): m
