"""The `[drive]`, `[shaft]` and `[actuator]` tables: how a gearset is modelled and shaken."""

import math
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, field_validator, model_validator

from asperity.casefile import Table
from asperity.errors import InputError, shown
from asperity.rating.shaft import torsional_stiffness
from asperity.units import Quantity

STEEL_DENSITY = 7850.0
"""kg/m3, of a worm whose inertia is not given."""

STEEL_MODULUS, STEEL_POISSON = 209e9, 0.3
"""Pa and ratio, of a worm shaft whose stiffness is not given; thesis 7.2.2."""

_Inertia = Annotated[
    float,
    Quantity("kg m**2", what="a moment of inertia", example="3.2e-3 kg m**2", ge=1e-12, le=1e9),
]
_Stiffness = Annotated[
    float, Quantity("N/m", what="a stiffness", example="200 kN/mm", ge=1.0, le=1e15)
]
_Length = Annotated[float, Quantity("m", what="a length", example="17 mm", gt=1e-6, le=1e3)]
_LoadTorque = Annotated[float, Quantity("N m", what="a torque", example="366 N m", ge=1e-6, le=1e9)]
_Turn = Annotated[float, Quantity("rad", what="an angle", example="365 urad", ge=1e-12, le=1)]
_LEAST_POINTS = 2


class Drive(Table):
    r"""How a worm gearset is loaded and followed through time.

    Parameters
    ----------
    protocol : {'steady', 'window', 'tangential', 'held-wheel', 'back-drive', 'on-demand'}
        What is asked: the periodic state; the mean over the first cycles, as the thesis reads it;
        the periodic state under the vibration's part along the flank alone; the torque that turns
        the worm while the wheel is held; whether the load drives the worm, the motor off;
        vibration for a while and what holds after it.
    model : {'reduced', 'teeth'}
        The mesh as a closed form at one radius, or as elastic teeth in contact.
    load_inertia : float or str, optional
        :math:`J_2`, of wheel and load about the wheel's axis, kg m2. Needed with a vibration: no
        result is independent of it.
    worm_inertia : float or str, optional
        :math:`J_1`, of worm and shaft about their axis, kg m2. Left out: that of steel cylinders
        of the threads' and the shaft's size.
    worm_mass : float or str, optional
        Of worm and shaft, kg; counts where bearings or a seat are given, or a shaft that bends.
        Left out: as the inertia.
    contact_damping : float or str, optional
        :math:`c` in :math:`N = f(d)(1 + c\dot d)`, s/m. Needed with a vibration.
    flanks : {'both', 'driving'}
        Whether the teeth may touch with the flanks that do not drive.
    teeth : int
        Teeth of the sector that is condensed, 1, 3, 5, 7 or 9.
    density : {'coarse', 'intermediate', 'fine'}
        Of the teeth's mesh.
    wheel_body : {'rim', 'web'}
        What of the wheel gives beside its teeth: the rim of the sector, its inside held; or rim and
        web of the whole wheel, held at its hub, as ``[blank]`` has them or as is usual.
    threads : {'elastic', 'rigid'}
        Whether the worm's threads give where they are pressed, as a half-space of their steel, as
        they do in the resolved pressures; rigid ones deflect a fifth less, as models with a rigid
        worm do.
    plastic : bool
        Whether pressures of loaded teeth end at the hardness of the wheel, as its edges flow; false
        for elastic ones.
    warm : bool
        Whether the gearset is loaded, and shaken, as it stands at ``tolerances.temperatures``: what
        housing and gears grow by is put into centre distance and lead. Left out it is cold.
    phases : int
        Positions of the worm over a pitch, 1 to 360.
    friction : {'constant', 'iso14521'}
        The coefficient of ``[friction]``, or that of ISO/TR 14521 at the local speed and
        temperature; with it ``[friction]`` may be left out, and its ``mu`` counts for nothing.
    stroke, stroke_seat : float or str
        Turn of the wheel in a stroke of protocol ``on-demand``, a quarter for a ball or butterfly
        valve, and of it at either seat with ``operation.output_torque``, rad; between them it is
        ``operation.through_travel_torque``.
    stroke_rest : float or str
        From one stroke to the next, s.
    window : int
        Cycles of protocol ``window``, and at least of each of the three blocks that a periodic
        state is judged by, 1 to 1000.
    deflection : list of pairs, optional
        Torque of the wheel and the angle that it turns by against a held worm, such as
        ``[["23 N m", "47.6 urad"], ["366 N m", "365 urad"]]``: measured or calculated elsewhere, in
        place of the static solution of the teeth.
    effective_radius : float or str, optional
        :math:`r_e`, radius on the worm at which the reduced mesh touches, m. Left out: that of the
        static solution.
    tangential_compliance : float or str, optional
        Of the teeth along the flank, m/N. Left out: that of the static solution.
    """

    table: ClassVar[str] = "drive"

    protocol: Literal["steady", "window", "tangential", "held-wheel", "back-drive", "on-demand"] = (
        "steady"
    )
    model: Literal["reduced", "teeth"] = "reduced"
    load_inertia: _Inertia | None = None
    worm_inertia: _Inertia | None = None
    worm_mass: (
        Annotated[float, Quantity("kg", what="a mass", example="0.3 kg", ge=1e-9, le=1e9)] | None
    ) = None
    contact_damping: (
        Annotated[float, Quantity("s/m", what="a damping", example="0.01 s/m", ge=0, le=1e3)] | None
    ) = None
    flanks: Literal["both", "driving"] = "both"
    teeth: Annotated[int, Field(strict=True, ge=1, le=9)] = 5
    density: Literal["coarse", "intermediate", "fine"] = "coarse"
    wheel_body: Literal["rim", "web"] = "rim"
    threads: Literal["rigid", "elastic"] = "elastic"
    plastic: bool = True
    warm: bool = False
    phases: Annotated[int, Field(strict=True, ge=1, le=360)] = 24
    friction: Literal["constant", "iso14521"] = "constant"
    stroke: Annotated[
        float, Quantity("rad", what="an angle", example="90 deg", gt=1e-6, le=1e6)
    ] = 0.5 * math.pi
    stroke_seat: Annotated[
        float, Quantity("rad", what="an angle", example="4.5 deg", gt=1e-9, le=1e6)
    ] = math.radians(4.5)
    stroke_rest: Annotated[float, Quantity("s", what="a time", example="60 s", ge=0, le=1e9)] = 0.0
    window: Annotated[int, Field(strict=True, ge=1, le=1000)] = 3
    deflection: tuple[tuple[_LoadTorque, _Turn], ...] | None = None
    effective_radius: _Length | None = None
    tangential_compliance: (
        Annotated[float, Quantity("m/N", what="a compliance", example="2.9 nm/N", ge=0, le=1e-3)]
        | None
    ) = None

    @field_validator("deflection", mode="before")
    @classmethod
    def _pairs(cls, value: Any) -> Any:
        if value is None:
            return value
        listed = isinstance(value, list | tuple) and len(value) >= _LEAST_POINTS
        if not listed or not all(
            isinstance(pair, list | tuple) and len(pair) == 2 for pair in value
        ):
            raise InputError(
                f"drive.deflection is {shown(value)}; it must be a list of at least two pairs of a "
                'torque and an angle, such as [["23 N m", "47.6 urad"], ["366 N m", "365 urad"]]'
            )
        return value

    @model_validator(mode="after")
    def _consistent(self) -> "Drive":
        if self.teeth % 2 == 0:
            raise InputError(
                f"drive.teeth is {self.teeth}; it must be odd, so that there is a middle tooth: "
                "take 1, 3, 5, 7 or 9"
            )
        if not 2.0 * self.stroke_seat < self.stroke:
            raise InputError(
                f"drive.stroke_seat is {math.degrees(self.stroke_seat):.4g} deg and drive.stroke "
                f"{math.degrees(self.stroke):.4g} deg; both seats must leave some of the stroke: "
                "give a smaller stroke_seat"
            )
        if self.deflection is not None:
            rising = all(
                one[0] < next_[0] and one[1] < next_[1]
                for one, next_ in zip(self.deflection, self.deflection[1:], strict=False)
            )
            if not rising:
                raise InputError(
                    "drive.deflection does not rise from pair to pair; list larger torques with "
                    "larger angles, each once"
                )
            if self.model == "teeth":
                raise InputError(
                    "drive.deflection is for drive.model 'reduced'; the model is 'teeth', which "
                    "deflects by itself: leave it out"
                )
        return self


class Shaft(Table):
    r"""What holds and turns the worm; what is left out is rigid.

    Parameters
    ----------
    torsional_stiffness : float or str, optional
        Between the worm and where the motor's speed is imposed, :math:`k_p`, N m/rad; thesis
        7.2.2. Left out: of a steel shaft of ``diameter`` over ``span``, or rigid without these.
    diameter, span : float or str, optional
        Of the shaft, and between the worm's bearings, m: it bends, with the worm's mass.
    bearing_axial, bearing_radial : float or str, optional
        Stiffness of the worm's bearings, N/m; of the radial ones with their seats.
    seat : float or str, optional
        Stiffness along the axis of what the axial bearing sits in, N/m: in series with it. A
        vibration ``applied_to`` the seat moves what is behind both.
    housing : float or str, optional
        Stiffness of the housing along the centre distance, N/m: the force that takes the seats of
        worm and wheel so far apart. A march has it where the shaft bends or radial bearings yield.
    damping_ratio : float
        Of the shaft's torsion with the worm's inertia, of seat and bending with its mass, 0..1.
    """

    table: ClassVar[str] = "shaft"

    torsional_stiffness: (
        Annotated[
            float,
            Quantity("N m/rad", what="a stiffness", example="4394 N m/rad", ge=1e-6, le=1e12),
        ]
        | None
    ) = None
    diameter: _Length | None = None
    span: _Length | None = None
    bearing_axial: _Stiffness | None = None
    bearing_radial: _Stiffness | None = None
    seat: _Stiffness | None = None
    housing: _Stiffness | None = None
    damping_ratio: Annotated[
        float, Quantity("", what="a damping ratio", example="0.03", ge=0, le=1)
    ] = 0.03

    @model_validator(mode="after")
    def _consistent(self) -> "Shaft":
        if self.bearing_radial is not None and self.span is None:
            raise InputError(
                "shaft.span is missing; radial bearings yield over the way between them: give it, "
                "or leave shaft.bearing_radial out"
            )
        return self

    @property
    def axial(self) -> float | None:
        """Stiffness between worm and housing along the axis, N/m; None where it is rigid."""
        give = [1.0 / each for each in (self.bearing_axial, self.seat) if each is not None]
        return 1.0 / sum(give) if give else None

    @property
    def torsion(self) -> float | None:
        """Torsional stiffness, N m/rad; None where it is rigid."""
        if self.torsional_stiffness is not None:
            return self.torsional_stiffness
        if self.diameter is None or self.span is None:
            return None
        return float(
            torsional_stiffness(
                1e3 * self.diameter, 1e3 * self.span, 1e-6 * STEEL_MODULUS, STEEL_POISSON
            )
        )

    def inertia(self, thread_diameter: float, thread_length: float) -> float | None:
        """Moment of inertia of worm and shaft as steel cylinders, kg m2; None without its size.

        Parameters
        ----------
        thread_diameter, thread_length : float
            Of the cylinder that stands for the worm's thread, m.

        Returns
        -------
        float or None
            kg m2, by the density of steel.
        """
        return self._cylinders(thread_diameter, thread_length, math.pi / 32.0, 4)

    def mass(self, thread_diameter: float, thread_length: float) -> float | None:
        """Mass of worm and shaft as steel cylinders, kg; None without its size.

        Parameters
        ----------
        thread_diameter, thread_length : float
            As of `inertia`, m.

        Returns
        -------
        float or None
            kg, by the density of steel.
        """
        return self._cylinders(thread_diameter, thread_length, math.pi / 4.0, 2)

    def _cylinders(self, diameter: float, length: float, share: float, power: int) -> float | None:
        if self.diameter is None or self.span is None:
            return None
        plain = max(self.span - length, 0.0)
        return STEEL_DENSITY * share * (self.diameter**power * plain + diameter**power * length)


class Actuator(Table):
    r"""The electrical side of what shakes.

    Parameters
    ----------
    coupling : float
        Electromechanical coupling factor :math:`k` of the piezoelectric transducer, 0..1: the
        square of it is the share of the electrical energy that turns mechanical.
    quality_factor : float
        Mechanical quality :math:`Q_m` of the transducer at resonance.
    efficiency : float
        Of the amplifier, 0..1: real power at the actuator over that from the mains.
    resonance : float or str, optional
        Natural frequency of the transducer with what it moves, Hz: where it is short-circuited,
        the series resonance. Left out: that of the vibration, to which it is tuned.
    """

    table: ClassVar[str] = "actuator"

    coupling: Annotated[
        float, Quantity("", what="a coupling factor", example="0.3", ge=1e-3, lt=1)
    ] = 0.3
    quality_factor: Annotated[
        float, Quantity("", what="a quality factor", example="500", ge=1, le=1e7)
    ] = 500.0
    efficiency: Annotated[
        float, Quantity("", what="an efficiency", example="0.9", ge=1e-3, le=1)
    ] = 0.9
    resonance: (
        Annotated[float, Quantity("Hz", what="a frequency", example="20 kHz", ge=1e-3, le=1e9)]
        | None
    ) = None
