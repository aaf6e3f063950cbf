"""A linear elastic, isotropic material."""

import math
from dataclasses import dataclass

from asperity.errors import InputError


@dataclass(frozen=True)
class ElasticMaterial:
    r"""A linear elastic, isotropic material.

    Parameters
    ----------
    youngs_modulus : float
        :math:`E > 0`, Pa.
    poissons_ratio : float
        :math:`\nu`, above -1 and below 0.5.
    density : float
        :math:`\rho > 0`, kg/m^3.

    Raises
    ------
    InputError
        A value outside its range.
    """

    youngs_modulus: float
    poissons_ratio: float
    density: float

    def __post_init__(self) -> None:
        for name in ("youngs_modulus", "density"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise InputError(f"{name} is {value:g}; it must be positive")
        if not -1.0 < self.poissons_ratio < 0.5:
            raise InputError(
                f"poissons_ratio is {self.poissons_ratio:g}; it must be above -1 and below 0.5"
            )

    @property
    def lame(self) -> tuple[float, float]:
        r"""Lamé's constants :math:`\lambda` and :math:`\mu`, Pa."""
        e, nu = self.youngs_modulus, self.poissons_ratio
        return e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu))
