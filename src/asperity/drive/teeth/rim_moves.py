r"""How the inside of a rim moves that is held by its web, under what the teeth bear.

A mesh of some teeth on their rim, such as stresses at the fillets are found on, has no web: its rim
stands on the rim's inside. On a wheel with a web that moves, by what the whole wheel
(`asperity.drive.teeth.whole`) says, and the smaller mesh moves with it.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.contact.elastic import ElasticMaterial
from asperity.contact.interface.surface import ContactSurface
from asperity.drive.teeth.whole import FURTHER, kept_blocks, with_web
from asperity.gearset.blanks import WheelBody
from asperity.gearset.geometry import Geometry
from asperity.mesh import HexMesh


@dataclasses.dataclass(frozen=True, eq=False)
class MovingRim:
    """What the inside of a rim does under forces on the flanks of teeth.

    Attributes
    ----------
    pitch : float
        Of the teeth, rad.
    angle, z : ndarray, shape (i,)
        Places on the inside, as the tooth has them that is loaded: rad from +Y towards +X, m.
    blocks : tuple of ndarray, shape (3i, 3n)
        Their displacement on the teeth 0, 1, -1, 2, -2 .. places further in the mesh, towards +X,
        under forces on the tooth 0; each in its own frame, m/N.
    """

    pitch: float
    angle: FloatArray
    z: FloatArray
    blocks: dict[int, FloatArray]

    @classmethod
    def of(
        cls, one: HexMesh, surface: ContactSurface, body: WheelBody, geometry: Geometry,
        material: ElasticMaterial, notify: Callable[[str], None] | None = None,
    ) -> MovingRim:  # fmt: skip
        """Return it of a wheel; parameters as of `asperity.drive.teeth.whole.whole_wheel`."""
        mesh, held = with_web(one, body, geometry)
        cuts = np.union1d(one.node_sets["cut_minus"], one.node_sets["cut_plus"])
        inside: IntArray = np.setdiff1d(one.node_sets["inner"], np.union1d(cuts, held))
        x, y, z = one.converted("m").points[inside].T
        pitch = 2.0 * np.pi / geometry.wheel_teeth
        if not len(inside):
            return cls(pitch, x, z, {})
        kept = np.concatenate([surface.nodes, inside])
        made = kept_blocks(mesh, held, kept, material, geometry.wheel_teeth, notify)
        n = 3 * len(surface.nodes)
        # Blocks are of teeth further about +Z, which in the mesh are further towards -X.
        blocks = {-m: block[n:, :n] for m, block in enumerate(made)}
        blocks |= {m: made[m][:n, n:].T for m in range(1, len(made))}
        return cls(pitch, np.arctan2(x, y), z, blocks)

    def at(self, points: FloatArray, forces: dict[int, FloatArray]) -> FloatArray:
        """Return the displacement of points on the inside, (k, 3), m.

        Parameters
        ----------
        points : ndarray, shape (k, 3)
            In the frame of the tooth 0, m.
        forces : mapping of int to ndarray, shape (n, 3)
            On the flanks of teeth, by how many places they are further towards +X, each in its own
            frame, N.
        """
        from scipy.interpolate import CubicSpline

        if not self.blocks:
            return np.zeros_like(points)
        columns = np.unique(np.round(self.z, 9))
        order = np.lexsort((self.angle, np.round(self.z, 9)))
        angle = self.angle[order]
        asked = np.arctan2(points[:, 0], points[:, 1])
        reach = int(np.ceil(np.abs(asked).max() / self.pitch)) + 1
        places, moved = [], []
        for place in range(-reach, reach + 1):
            own = np.zeros(3 * len(order))
            for loaded, force in forces.items():
                if abs(place - loaded) <= FURTHER:
                    own += self.blocks[place - loaded] @ force.reshape(-1)
            # Along the rim and outwards they are smooth from tooth to tooth.
            own = _polar(own.reshape(-1, 3)[order], angle)
            places.append((angle + place * self.pitch).reshape(len(columns), -1))
            moved.append(own.reshape(len(columns), -1, 3))
        known, values = np.concatenate(places, axis=1), np.concatenate(moved, axis=1)
        rows = np.stack(
            [CubicSpline(at, own)(asked) for at, own in zip(known, values, strict=True)]
        )
        z = np.clip(points[:, 2], columns[0], columns[-1])
        over = CubicSpline(columns, np.eye(len(columns)))(z)
        return _polar(np.einsum("kc,cki->ki", over, rows), -asked)


def _polar(vectors: FloatArray, angle: FloatArray) -> FloatArray:
    """Return vectors, (k, 3), along the rim and outwards in place of X and Y."""
    x, y, z = vectors.T
    cosine, sine = np.cos(angle), np.sin(angle)
    return np.stack([cosine * x - sine * y, sine * x + cosine * y, z], axis=-1)
