r"""Forces of the teeth on worm, wheel and the worm's bearings, by the direction of rotation.

The worm drives. Axes: x along the worm, towards the end it is driven at; y from the wheel's axis to
the worm's; z completes them to a right-handed system. A worm of right hand that turns clockwise,
seen from the end it is driven at, pushes the wheel's teeth towards that end, as a screw pulls its
nut. What the worm puts on the wheel, the wheel puts on the worm, turned round.

The wheel sits in the middle between the worm's bearings, which are a span :math:`l_1` apart: each
carries half of what is across the worm, and the moment of the axial force adds to one and relieves
the other by :math:`F_x d_{m1}/(2 l_1)`.
"""

import math
from typing import Any, Literal, NamedTuple

from asperity.rating.inputs import Inputs
from asperity.rating.result import Rating

Rotation = Literal["clockwise", "anticlockwise"]
Vector = tuple[float, float, float]


class Forces(NamedTuple):
    """Forces for one direction of rotation, N; vectors by x, y and z.

    Attributes
    ----------
    rotation : {'clockwise', 'anticlockwise'}
        Of the worm, seen from the end it is driven at.
    worm, wheel : tuple of float
        What the teeth put on each.
    driven_end, free_end : tuple of float
        What the bearing at that end of the worm carries of y and z; the axial force is carried by
        the one that is fixed.
    """

    rotation: Rotation
    worm: Vector
    wheel: Vector
    driven_end: tuple[float, float]
    free_end: tuple[float, float]

    def to_json(self) -> dict[str, Any]:
        """Return it by key, resultants of the bearings too."""
        (fx, fy, fz), (gx, gy, gz) = self.worm, self.wheel
        return {
            "rotation": self.rotation,
            "standard": "ISO/TR 14521",
            "worm_axial_N": fx,
            "worm_radial_N": fy,
            "worm_tangential_N": fz,
            "wheel_tangential_N": gx,
            "wheel_radial_N": gy,
            "wheel_axial_N": gz,
            "driven_end_y_N": self.driven_end[0],
            "driven_end_z_N": self.driven_end[1],
            "driven_end_radial_N": math.hypot(*self.driven_end),
            "free_end_y_N": self.free_end[0],
            "free_end_z_N": self.free_end[1],
            "free_end_radial_N": math.hypot(*self.free_end),
            "fixed_bearing_axial_N": fx,
        }


def forces(inputs: Inputs, iso: Rating) -> tuple[Forces, ...]:
    """Return the forces of both directions of rotation, by a rating by ISO/TR 14521."""
    tangential, axial, radial = (float(iso[f"F_{name}_N"]) for name in ("tm1", "tm2", "rm"))
    hand = 1.0 if inputs.gearset.hand == "right" else -1.0
    arm = float(inputs.worm_pitch_diameter) / 2.0
    span = float(inputs.bearing_span)
    made = []
    for rotation, turn in (("clockwise", -1.0), ("anticlockwise", 1.0)):
        # The worm turns by `turn` about +x; its teeth touch the wheel at y = -arm.
        worm = hand * turn * axial, radial, turn * tangential
        tilt = worm[0] * arm / span
        made.append(
            Forces(
                rotation,  # type: ignore[arg-type]
                worm,
                (-worm[0], -worm[1], -worm[2]),
                (worm[1] / 2.0 + tilt, worm[2] / 2.0),
                (worm[1] / 2.0 - tilt, worm[2] / 2.0),
            )
        )
    return tuple(made)


MEANINGS = {
    "worm_axial_N": ("worm, axial", "F_x1", "hand and rotation by F_tm2"),
    "worm_radial_N": ("worm, radial, away from the wheel", "F_y1", "F_rm"),
    "worm_tangential_N": ("worm, tangential", "F_z1", "rotation by F_tm1"),
    "wheel_tangential_N": ("wheel, tangential", "F_x2", "-F_x1"),
    "wheel_radial_N": ("wheel, radial", "F_y2", "-F_y1"),
    "wheel_axial_N": ("wheel, axial", "F_z2", "-F_z1"),
    "driven_end_y_N": ("bearing at the driven end", "F_yA", "F_y1/2 + F_x1 d_m1/(2 l_1)"),
    "driven_end_z_N": ("", "F_zA", "F_z1/2"),
    "driven_end_radial_N": ("radial load of it", "F_A", "sqrt(F_yA^2 + F_zA^2)"),
    "free_end_y_N": ("bearing at the free end", "F_yB", "F_y1/2 - F_x1 d_m1/(2 l_1)"),
    "free_end_z_N": ("", "F_zB", "F_z1/2"),
    "free_end_radial_N": ("radial load of it", "F_B", "sqrt(F_yB^2 + F_zB^2)"),
    "fixed_bearing_axial_N": ("axial load of the fixed one", "F_ax", "F_x1"),
}
"""What each is, its symbol and its equation, by its key."""
