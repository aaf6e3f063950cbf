r"""One point that stands for the mesh: the closed form of an involute worm at a radius.

With the reduced lead :math:`p`, the radius :math:`r_e` on the worm, :math:`L = \sqrt{r_e^2 + p^2}`
and the base lead angle :math:`\gamma_b`, the normal's axial part is :math:`n_z = \cos\gamma_b` at
every radius, its part along the worm's turning :math:`n_t = n_z p/r_e`, the rest is radial. The
worm slides along :math:`(r_e, -p)/L`, so that with friction :math:`\mu N` and the wheel's torque
:math:`T = i p N (n_z - \mu p/L)` the worm's is :math:`T_B = r_e N (n_t + \mu r_e/L)`.
"""

import dataclasses
import math

from asperity.errors import InputError
from asperity.gearset import Geometry


@dataclasses.dataclass(frozen=True)
class MeshPoint:
    """Where the reduced mesh touches; lengths in m.

    Attributes
    ----------
    lead : float
        Reduced lead :math:`p`, m/rad.
    radius : float
        :math:`r_e`, m.
    ratio : float
        Gear ratio :math:`i`.
    normal_z : float
        Axial part of the normal.
    """

    lead: float
    radius: float
    ratio: float
    normal_z: float

    @classmethod
    def of(cls, geometry: Geometry, radius: float) -> "MeshPoint":
        """Return the point of a gearset at a radius in m.

        Flanks of other types have the normal of the involute flank with their lead and pressure
        angle: on the reference cylinder they are the same.

        Raises
        ------
        InputError
            The radius is not on the threads.
        """
        least, most = 5e-4 * geometry.worm_root_diameter, 5e-4 * geometry.worm_tip_diameter
        if not least <= radius <= most:
            raise InputError(
                f"drive.effective_radius is {1e3 * radius:.4g} mm; the worm's threads reach from "
                f"{1e3 * least:.4g} to {1e3 * most:.4g} mm"
            )
        normal_z = math.cos(geometry.lead_angle) * math.cos(geometry.pressure_angle)
        point = cls(1e-3 * geometry.reduced_lead, radius, geometry.gear_ratio, normal_z)
        if not point.normal_z * point.length < point.radius:
            raise InputError(
                f"drive.effective_radius is {1e3 * radius:.4g} mm, inside the base cylinder of the "
                "worm: there is no flank there"
            )
        return point

    @property
    def length(self) -> float:
        """Way of the thread in a turn of a radian, m."""
        return math.hypot(self.radius, self.lead)

    @property
    def normal_across(self) -> float:
        """Part of the normal across the sliding in the tangent plane of the worm's cylinder."""
        return self.normal_z * self.length / self.radius

    @property
    def normal_radial(self) -> float:
        """Radial part of the normal."""
        return math.sqrt(1.0 - self.normal_across**2)

    @property
    def arm(self) -> float:
        """Lever of the wheel, :math:`i p`, m."""
        return self.ratio * self.lead

    def normal_force(self, wheel_torque: float, friction: float) -> float:
        r"""Normal force under a wheel torque, N.

        Parameters
        ----------
        wheel_torque : float
            N m.
        friction : float
            :math:`\mu` while the worm drives, 0 without friction, below 0 reversed.
        """
        share = self.normal_z - friction * self.lead / self.length
        if share <= 0.0:
            raise InputError(
                f"friction.mu is {friction:g}, so much that the worm cannot turn the wheel however "
                f"hard it pushes; it must be below {self.normal_z * self.length / self.lead:.4g}"
            )
        return wheel_torque / (self.arm * share)

    def worm_torque(self, wheel_torque: float, friction: float) -> float:
        """Torque of the worm that carries a wheel torque, N m; parameters as `normal_force`."""
        force = self.normal_force(wheel_torque, friction)
        along = self.normal_z * self.lead / self.radius + friction * self.radius / self.length
        return self.radius * force * along

    def sliding_speed(self, worm_speed: float) -> float:
        """Speed at which the worm slides, m/s, turning at a speed in rad/s."""
        return worm_speed * self.length

    def holding_share(self, friction: float) -> float:
        r"""Share of full friction that holds the worm without a torque while the wheel pushes.

        :math:`\phi = \cos\gamma_b\,(p/r_e)\,L/(\mu r_e)`: the gearset locks itself where it is
        below 1.
        """
        return self.normal_z * self.lead * self.length / (friction * self.radius**2)
