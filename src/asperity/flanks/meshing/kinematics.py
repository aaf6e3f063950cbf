r"""Velocities and curvatures where a point of the wheel's flank comes nearest to the worm.

Every point of the flank has a phase of the worm at which it is nearest to it; with an identical hob
it then touches. All points with one phase are the contact line, and across it
(:math:`a`, in the tangent plane) the surfaces roll over it. The wheel's flank is enveloped by the
hob, so that its curvature is the hob's less a rank-one part, in closed form
(`asperity.flanks.meshing.kernels.kinematics`); no surface is differentiated numerically.

Vectors are in the standing frame of the wheel, lengths in mm, velocities in mm/s.
"""

import numpy as np
import numpy.typing as npt

from asperity.arrays import BoolArray, FloatArray
from asperity.errors import ConvergenceError
from asperity.flanks.meshing.kernels import kinematics as rows
from asperity.flanks.wheel.flank import MAP, RESOLVED, FlankGrid
from asperity.flanks.worm.setting import Pair
from asperity.results import Quantities, labelled, quantity


class Kinematics(Quantities):
    r"""What holds at each point of a flank while the worm turns at :math:`\omega_1`, rad/s.

    Arrays have the shape of the points given; vectors one more axis of 3. What is not described
    with its field:

    Attributes
    ----------
    reach : ndarray
        Negative where the nearest place is on the worm's tip, and the point never touches.
    gap, position, normal : ndarray
        The distance to the worm where it is nearest and the point in space then, mm; unit normal of
        the worm's surface, out of the worm.
    across, along : ndarray
        Unit vectors of the tangent plane, across and along the contact line.
    worm_curvature, wheel_curvature, relative_curvature : ndarray
        (..., 2): the larger one first; positive where convex. The relative ones are those of the
        sum of both.
    line_curvature : ndarray
        Its inverse is the radius of the Hertzian line contact.
    """

    phase: FloatArray = quantity(
        "", "rad", "angle of the worm at which the point is nearest to it", dims=MAP
    )
    reach: FloatArray = quantity(
        "", "mm", "nearest place below the end of the worm's flank", dims=MAP
    )
    sliding: FloatArray = quantity("", "mm/s", "sliding velocity of the worm", dims=(*MAP, "axis"))
    worm_rolling: FloatArray = quantity(
        "u_1", "mm/s", "worm's velocity over the contact line", dims=MAP
    )
    wheel_rolling: FloatArray = quantity(
        "u_2", "mm/s", "wheel's velocity over the contact line", dims=MAP
    )
    worm_curvature: FloatArray = quantity(
        "", "1/mm", "principal curvatures, worm", dims=(*MAP, "principal")
    )
    wheel_curvature: FloatArray = quantity(
        "", "1/mm", "principal curvatures, wheel", dims=(*MAP, "principal")
    )
    relative_curvature: FloatArray = quantity(
        "", "1/mm", "principal curvatures, relative", dims=(*MAP, "principal")
    )
    line_curvature: FloatArray = quantity("", "1/mm", "relative, across the contact line", dims=MAP)
    worm_speed: float
    gap: FloatArray
    position: FloatArray
    normal: FloatArray
    across: FloatArray
    along: FloatArray

    @property
    def on_flank(self) -> BoolArray:
        """Whether the nearest place is on the worm's flank, and not on its tip."""
        return self.reach >= -RESOLVED

    @property
    @labelled("", "mm/s", "size of the sliding velocity", dims=MAP)
    def sliding_speed(self) -> FloatArray:
        """Size of the sliding velocity, mm/s."""
        return np.asarray(np.linalg.norm(self.sliding, axis=-1))

    @property
    @labelled("u", "mm/s", "mean velocity over the contact line", dims=MAP)
    def entrainment(self) -> FloatArray:
        r"""Speed :math:`(u_1 + u_2)/2` that draws oil into the contact line, mm/s, not signed."""
        return np.abs(0.5 * (self.worm_rolling + self.wheel_rolling))


def kinematics(
    pair: Pair, grid: FlankGrid, side: int, worm_speed: float = 1.0, ahead: float = 0.0
) -> Kinematics:
    r"""Return velocities and curvatures of the mesh at points of the wheel's flank ``side``.

    The worm turns at a speed of :math:`\omega_1`, rad/s; the wheel is turned ``ahead`` of
    :math:`\varphi_1 z_1/z_2` by the transmission error, rad.

    Raises
    ------
    ConvergenceError
        A point has no phase at which it is nearest to the worm.
    """
    shape = grid.phase.shape
    points = np.ascontiguousarray(grid.points.reshape(-1, 3))
    own = np.ascontiguousarray(grid.phase.reshape(-1))
    made = np.empty(own.size, rows.MEETING)
    rows.meet_each(points, own, 0.0, pair.cut, pair.hob.facing(side), made)
    met = np.empty_like(made)
    guess = own - pair.ratio * ahead
    rows.approach_each(points, guess, ahead, pair.mount, pair.worm.facing(side), met)
    lost = int(np.count_nonzero(~met["converged"] & (met["reach"] > 0.0)))
    if lost:
        raise ConvergenceError(
            f"{lost} of {own.size} points of the flank have no phase at which the worm is nearest; "
            "the mount is too far from where it should be",
            reached={"points": float(own.size - lost)},
        )

    axes = pair.mounting.axes
    g = met["gradient"]
    w = met["velocity"]
    change = _tangential(met["change"], g)
    steep = np.linalg.norm(change, axis=1)
    a = change / steep[:, None]
    b = np.cross(g, a)
    turn = met["phase"] / pair.ratio + ahead - own / pair.ratio
    worm = _in_plane(_square(met["hessian"]), a, b)
    wheel = _in_plane(_carried(_enveloped(made), pair.cutting.axes, turn, axes), a, b)
    wheel_rolls = worm_speed * met["second"] / steep
    worm_rolls = wheel_rolls - worm_speed * np.sum(w * a, axis=1)
    relative = worm - wheel

    def out(values: FloatArray) -> FloatArray:
        return values.reshape(*shape, *values.shape[1:])

    return Kinematics(
        worm_speed=worm_speed,
        phase=out(met["phase"]),
        gap=out(met["distance"]),
        reach=out(met["reach"]),
        position=out(pair.mounting.to_wheel(met["place"])),
        normal=out(g @ axes),
        sliding=out(-worm_speed * (w @ axes)),
        across=out(a @ axes),
        along=out(b @ axes),
        worm_rolling=out(worm_rolls),
        wheel_rolling=out(wheel_rolls),
        worm_curvature=out(_principal(worm)),
        wheel_curvature=out(_principal(-wheel)),
        relative_curvature=out(_principal(relative)),
        line_curvature=out(relative[:, 0, 0]),
    )


def _tangential(vectors: FloatArray, normals: FloatArray) -> FloatArray:
    return np.asarray(vectors - np.sum(vectors * normals, axis=1, keepdims=True) * normals)


def _square(six: FloatArray) -> FloatArray:
    return six[:, [0, 3, 4, 3, 1, 5, 4, 5, 2]].reshape(-1, 3, 3)


def _enveloped(made: npt.NDArray[np.void]) -> FloatArray:
    """Second fundamental form that the hob leaves, in its own axes, its tangent plane only."""
    g = made["gradient"]
    f = made["change"]
    form = _square(made["hessian"])
    form = form - f[:, :, None] * f[:, None, :] / made["second"][:, None, None]
    plane = np.eye(3) - g[:, :, None] * g[:, None, :]
    return np.asarray(plane @ form @ plane)


def _carried(form: FloatArray, start: FloatArray, turn: FloatArray, end: FloatArray) -> FloatArray:
    """Tensors in the axes ``start``, turned about Z with the wheel, in the axes ``end``."""
    c, s = np.cos(turn), np.sin(turn)
    whole = np.zeros((turn.size, 3, 3))
    whole[:, 0, 0] = whole[:, 1, 1] = c
    whole[:, 1, 0], whole[:, 0, 1] = s, -s
    whole[:, 2, 2] = 1.0
    way = end @ whole @ start.T
    return np.asarray(way @ form @ np.swapaxes(way, 1, 2))


def _in_plane(form: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    basis = np.stack([a, b], axis=1)
    return np.asarray(basis @ form @ np.swapaxes(basis, 1, 2))


def _principal(form: FloatArray) -> FloatArray:
    return np.asarray(np.linalg.eigvalsh(form)[:, ::-1])
