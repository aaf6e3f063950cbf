"""The `[block]` and `[contact]` tables: the elastic body and how its surface meets another."""

import math
from typing import Annotated, ClassVar, Literal, Self

from pydantic import Field, field_validator, model_validator

from asperity.casefile import Table
from asperity.errors import InputError
from asperity.units import Quantity

# Ten times as stiff as the layer of elements it stands on: the overclosure then adds a tenth to
# the squeeze of that layer, and the equations stay well conditioned.
_PENALTY = 10.0

# What lies outside is a slip of the pen, and beyond the digits of the arithmetic.
_LEAST_LENGTH, _MOST_LENGTH = 1e-6, 1e3
_MOST_MODULUS = 1e14
_MOST_STIFFNESS = 1e20
_MOST_ASPECT = 1e3
_MOST_OVERCLOSURE = 1.0

_Length = Annotated[
    float, Quantity("m", what="a length", example="40 mm", ge=_LEAST_LENGTH, le=_MOST_LENGTH)
]
_Overclosure = Annotated[
    float, Quantity("m", what="a length", example="1 nm", ge=0, le=_MOST_OVERCLOSURE)
]
_Stiffness = Annotated[
    float,
    Quantity(
        "Pa/m",
        what="a pressure per length",
        example="40 GPa/um",
        gt=0,
        le=_MOST_STIFFNESS,
    ),
]
_FinalStiffness = Annotated[
    float,
    Quantity(
        "Pa/m",
        what="'auto' or a pressure per length",
        example="40 GPa/um",
        gt=0,
        le=_MOST_STIFFNESS,
    ),
]
_Count = Annotated[int, Field(strict=True, ge=1, le=1000)]


class Block(Table):
    r"""An elastic block on a base, meshed with hexahedra; thesis 5.3.1.

    The mass is that of ``[slider]``: it makes the density.

    Parameters
    ----------
    size : sequence of 3 floats or str
        Edges along the drive (x), across it (y) and normal to the base (z), 1e-6 to 1000 m; those
        of an element may differ a thousandfold.
    youngs_modulus : float or str
        :math:`E`, above 0 to 1e14 Pa.
    poissons_ratio : float
        :math:`\nu`, 0 to below 0.5.
    elements : sequence of 3 int
        Elements along the three edges, 1 to 1000 each.
    element : {'hex27', 'hex8', 'hex8i'}
        27-node triquadratic (default), 8-node trilinear, or 8-node with incompatible modes.
    modes : int
        Fixed-interface modes that carry the inertia of the deformation (Craig-Bampton); 0 for
        none: the block deforms as in statics and moves as a rigid body.
    damping_ratio : float
        Damping of the modes over the critical one, 0 to below 1, the same for each; the motion as
        a rigid body is not damped. 0.002: some steel without joints.
    """

    table: ClassVar[str] = "block"

    size: tuple[_Length, _Length, _Length]
    youngs_modulus: Annotated[
        float, Quantity("Pa", what="a modulus", example="209 GPa", gt=0, le=_MOST_MODULUS)
    ]
    poissons_ratio: Annotated[float, Quantity("", what="a ratio", example="0.3", ge=0, lt=0.5)]
    elements: tuple[_Count, _Count, _Count] = (8, 6, 6)
    element: Literal["hex27", "hex8", "hex8i"] = "hex27"
    modes: Annotated[int, Field(strict=True, ge=0, le=1000)] = 0
    damping_ratio: Annotated[float, Quantity("", what="a ratio", example="0.002", ge=0, lt=1)] = (
        0.002
    )

    @field_validator("size", "elements", mode="before")
    @classmethod
    def _three(cls, value: object) -> object:
        if not isinstance(value, list | tuple) or len(value) != 3:
            raise ValueError("it must be a list of three: along the drive, across it, and upwards")
        return value

    @model_validator(mode="after")
    def _compact(self) -> Self:
        edges = [size / count for size, count in zip(self.size, self.elements, strict=True)]
        if max(edges) > _MOST_ASPECT * min(edges):
            given = " x ".join(f"{edge:.4g}" for edge in edges)
            raise InputError(
                f"block.size and block.elements make elements of {given} m; the longest edge may "
                f"be {_MOST_ASPECT:g} times the shortest: change the number of elements"
            )
        return self

    @property
    def area(self) -> float:
        """Nominal contact area, m^2."""
        return self.size[0] * self.size[1]

    @property
    def volume(self) -> float:
        """Volume, m^3."""
        return math.prod(self.size)

    def density(self, mass: float) -> float:
        """Density that gives the block a mass in kg, kg/m^3.

        Parameters
        ----------
        mass : float
            Of the block, kg.

        Returns
        -------
        float
            Mass over volume, kg/m3.
        """
        return mass / self.volume

    @property
    def order(self) -> int:
        """Polynomial order of the elements: 1 or 2."""
        return 2 if self.element == "hex27" else 1


class Contact(Table):
    """How pressure grows where a surface meets another.

    Parameters
    ----------
    normal : {'linear', 'two-stage', 'hard'}
        Pressure in proportion to the overclosure (default); soft, then stiff, as in the thesis's
        Figure 5.3; no overclosure (augmented Lagrangian).
    stiffness : float or str, optional
        Pressure per overclosure, Pa/m: of the straight line, of the final stage, or the penalty
        the augmented Lagrangian starts from; at most 1e20. Left out or ``"auto"``: see
        `normal_stiffness`.
    initial_stiffness : float or str, optional
        ``two-stage``: that of the first stage, Pa/m; a millionth of the final one to all of it.
        Left out: a tenth.
    transition : sequence of 2 floats or str, optional
        ``two-stage``: overclosures where the first stage ends and the last begins, m, 0 to 1 m;
        between them the stiffness rises evenly. Left out: 1 % and 3 % of the longer edge of an
        element in contact.
    damping_ratio : float
        Damping of the block's bounce on its contact over the critical one, 0 to below 1, by
        dashpots spread evenly over the contact, which damp its rocking too.
    """

    table: ClassVar[str] = "contact"

    normal: Literal["linear", "two-stage", "hard"] = "linear"
    stiffness: _FinalStiffness | None = None

    initial_stiffness: _Stiffness | None = None
    transition: tuple[_Overclosure, _Overclosure] | None = None
    damping_ratio: Annotated[float, Quantity("", what="a ratio", example="0.05", ge=0, lt=1)] = 0.0

    @field_validator("transition", mode="before")
    @classmethod
    def _two(cls, value: object) -> object:
        if value is not None and (not isinstance(value, list | tuple) or len(value) != 2):
            raise ValueError(
                "it must be a list of two overclosures: where the first stage ends, and where the "
                "last begins"
            )
        return value

    @model_validator(mode="after")
    def _staged(self) -> Self:
        if self.normal != "two-stage":
            for key in ("initial_stiffness", "transition"):
                if getattr(self, key) is not None:
                    raise InputError(
                        f"contact.{key} is given, and contact.normal is '{self.normal}', which "
                        "has no stages: leave it out, or give contact.normal 'two-stage'"
                    )
        if self.transition is not None and not self.transition[0] < self.transition[1]:
            first, last = self.transition
            raise InputError(
                f"contact.transition is from {first:g} to {last:g} m; the second must be greater "
                "than the first"
            )
        return self

    @field_validator("stiffness", mode="before")
    @classmethod
    def _automatic(cls, value: object) -> object:
        return None if isinstance(value, str) and value.strip() == "auto" else value

    def normal_stiffness(self, youngs_modulus: float, element_height: float) -> float:
        """Pressure per overclosure, Pa/m: as given, or 10 E/h of the elements in contact.

        Parameters
        ----------
        youngs_modulus : float
            Of the softer body, Pa.
        element_height : float
            Of that body's elements normal to the contact, m.

        Returns
        -------
        float
            Pa/m.

        Raises
        ------
        InputError
            A number that is not positive, where it is needed.
        """
        if self.stiffness is not None:
            return self.stiffness
        if not (youngs_modulus > 0.0 and element_height > 0.0):
            raise InputError(
                f"youngs_modulus is {youngs_modulus:g} Pa and element_height {element_height:g} m; "
                "both must be positive"
            )
        return _PENALTY * youngs_modulus / element_height
