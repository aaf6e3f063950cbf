"""A sliding body made ready to be solved: one object with everything in SI, and its scaled form."""

import dataclasses
import functools
import math
from collections.abc import Sequence
from typing import Self

import numpy as np

from asperity.casefile import Case, Table
from asperity.errors import InputError, require_fields, shown
from asperity.friction import Friction
from asperity.friction.springs import REFERENCE_INDENTATION, spring_profile
from asperity.normal import Normal
from asperity.slider.indentation import greatest_indentation
from asperity.slider.parameters import (
    FAR_APART,
    Slider,
    Solve,
    check_normal,
    check_scheme,
    in_proportion,
    unit_vector,
)
from asperity.slider.scaled import MODELS, NormalLoading, Parameters
from asperity.slider.substeps import parts_of
from asperity.slider.wear import Wear
from asperity.vibration import Vibration
from asperity.vibration.waveform import AT_REST, SAMPLED, SINE, Shape, Wave

_STEPS_A_CYCLE = 500
_WINDOW = 0.4
_WINDOW_RINGS = 20
_WINDOW_CYCLES = 2
WINDOW_SHARE = 0.75
# Springs are laid out to what the body comes to in so many cycles from rest and a little more.
_FIRST_CYCLES = 100
_MOST_FIRST_STEPS, _DEEPER = 1_000_000, 1.05
# Parts of a cycle by which steps may miss a corner of the wave; Coulomb's force jumps there.
_MISSED, _MISSED_BY_COULOMB = 1e-5, 5e-6
ASKEW = 1e-6
"""Angle by which a body is shaken off its way that leaves it by the least push, rad."""


@dataclasses.dataclass(frozen=True)
class Model:
    """A body pulled over a vibrating base.

    Attributes
    ----------
    slider, friction : Slider, Friction
        The tables of the case.
    vibration : Vibration or None
        None: the base is at rest.
    solve : Solve
        How it is solved.
    shape : Shape or None
        The vibration's waveform.
    normal : Normal or None
        What is normal to the plane; None: the normal force is a constant.
    wear : Wear or None
        What the contact wears and heats by; it goes with ``normal``.
    finer : int
        How many times finer than by its bounds a step is divided, for the error it makes.
    askew : float
        How a push across grows a cycle, for which the body is shaken a little askew; 0: it is not.
    """

    slider: Slider
    friction: Friction
    vibration: Vibration | None = None
    solve: Solve = dataclasses.field(default_factory=Solve)
    shape: Shape | None = dataclasses.field(default=None, repr=False)
    normal: Normal | None = None
    wear: Wear | None = None
    finer: int = dataclasses.field(default=1, repr=False)
    askew: float = dataclasses.field(default=0.0, repr=False)

    def __post_init__(self) -> None:
        require_fields(self)
        if self.vibration is not None and self.shape is None:
            object.__setattr__(self, "shape", self.vibration.shape())
        if self.normal is not None and self.normal.law == "constant":
            object.__setattr__(self, "normal", None)
        if self.normal is None and self.wear is not None:
            raise InputError(
                "[wear] follows the feet of the asperities, which are counted under a normal.law "
                "that is not 'constant': describe the contact in [normal] (law = 'linear', "
                "stiffness), or leave [wear] out"
            )
        check_normal(self.slider, self.friction, self.vibration, self.normal, self.solve)
        check_scheme(self.friction, self.solve)

    @classmethod
    def from_case(cls, case: Case) -> Self:
        """Gather the tables of a case; [vibration] and [solve] may be missing.

        Parameters
        ----------
        case : Case
            With ``[slider]`` and ``[friction]``.

        Returns
        -------
        Model
            The body of the case.

        Raises
        ------
        InputError
            A table is missing, or two of them do not go together.
        """
        given = case.get(Vibration)
        vibration = given.of_body() if given else None
        shape = vibration.shape(case.folder) if vibration is not None else None
        solve = case.get(Solve, Solve())
        tables = case.require(Slider), case.require(Friction), vibration, solve, shape
        return cls(*tables, case.get(Normal), case.get(Wear))

    @property
    def tables(self) -> list[Table]:
        """The tables of a case of this body."""
        given = self.slider, self.friction, self.vibration, self.normal, self.wear, self.solve
        return [table for table in given if table is not None]

    @property
    def full_friction(self) -> float:
        r""":math:`\mu F_N`, N: the drive force without vibration."""
        return self.friction.mu * self.slider.normal_force

    @property
    def vibrates(self) -> bool:
        """Whether anything is shaken."""
        return self.shape is not None and self.peak_velocity > 0.0

    @functools.cached_property
    def frequency(self) -> float:
        """Vibration frequency, Hz; 0 without vibration."""
        return self.shape.frequency if self.shape is not None else 0.0

    @functools.cached_property
    def peak_velocity(self) -> float:
        """v_a, m/s; 0 without vibration."""
        if self.vibration is None or self.shape is None:
            return 0.0
        return self.vibration.velocity(self.shape, self.slider.drive_velocity)

    @functools.cached_property
    def amplitude(self) -> float:
        """u_a, m; 0 without vibration."""
        if self.vibration is None or self.shape is None:
            return 0.0
        return self.vibration.displacement(self.shape, self.slider.drive_velocity)

    @functools.cached_property
    def start(self) -> float:
        """Start of the vibration, s; of a wave with corners, on which steps end, a whole step."""
        given = self.vibration.start if self.vibration is not None else 0.0
        return round(given / self.step) * self.step if self.meets_corners else given

    @functools.cached_property
    def meets_corners(self) -> bool:
        """Whether there are corners in the wave, and steps end on them."""
        cornered = self.shape is not None and self.shape.cornered
        return cornered and self.vibrates and self.solve.scheme != "two-phase"

    @property
    def ramp(self) -> float:
        """Time in which the vibration grows, s."""
        return self.vibration.ramp if self.vibration is not None else 0.0

    @property
    def direction(self) -> float:
        """Angle between vibration and drive, rad."""
        return self.vibration.direction if self.vibration is not None else 0.0

    @property
    def elevation(self) -> float:
        """Angle between vibration and plane of contact, rad."""
        return self.vibration.elevation if self.vibration is not None else 0.0

    @functools.cached_property
    def unit_direction(self) -> tuple[float, float, float]:
        """Direction of the vibration: along the drive, across it, up."""
        flat, up = unit_vector(self.elevation)
        along, across = unit_vector(self.direction)
        return flat * along, flat * across, up

    @property
    def normal_lead(self) -> float:
        """How far the normal part of the vibration leads the part in the plane, in cycles."""
        phase = self.vibration.normal_phase if self.vibration is not None else 0.0
        return phase / (2.0 * math.pi)

    @property
    def normal_length(self) -> float:
        """Length the penetration is measured by, W/k_z, m; see `asperity.normal`."""
        load = self.slider.normal_force
        return 0.0 if self.normal is None else load / self.normal.slope(load)

    def normal_unit(self, step: float) -> float:
        """Load times that length, in the unit of energy in the plane."""
        return self.normal_length / (self.friction.mu * self.length(step))

    @property
    def on_body(self) -> bool:
        """Whether the body, not the base, is shaken."""
        return self.vibration is not None and self.vibration.applied_to == "body"

    @functools.cached_property
    def ring_period(self) -> float:
        """Period in which the body rings on its drive, s; 0 for a rigid drive."""
        if self.slider.drive_stiffness is None or self.slider.mass is None:
            return 0.0
        return 2.0 * math.pi * math.sqrt(self.slider.mass / self.slider.drive_stiffness)

    @functools.cached_property
    def window(self) -> float:
        """Length the means are taken over, s, before it is cut to whole cycles."""
        least = _WINDOW_CYCLES / self.frequency if self.vibrates else 0.0
        return max(_WINDOW, _WINDOW_RINGS * self.ring_period, least)

    @property
    def duration(self) -> float:
        """Simulated time, s."""
        given = self.solve.duration
        return given if given is not None else self.usual_duration

    @property
    def usual_duration(self) -> float:
        """Simulated time where none is given, s."""
        return self.start + self.ramp + 2.0 * self.window

    @functools.cached_property
    @in_proportion()
    def step(self) -> float:
        """Time step as asked for, s; refused if it is too coarse for the waveform.

        Where the waveform has corners, the next smaller one that ends on them, in whole steps of a
        cycle.
        """
        given = self.solve.step
        if self.shape is None or not self.vibrates:
            return given if given is not None else 1e-6
        most = 1.0 / (self.shape.least_steps * self.frequency)
        if given is None:
            asked = min(1.0 / (_STEPS_A_CYCLE * self.frequency), most)
        elif given > most * (1.0 + 1e-9):
            raise InputError(
                f"solve.step is {given:g} s, too coarse for the vibration of {self.frequency:g} Hz;"
                f" it must be at most {most:.3g} s"
            )
        else:
            asked = given
        if not self.meets_corners:
            return asked
        return 1.0 / (self.steps_to_corners(1.0 / (asked * self.frequency)) * self.frequency)

    def wave(self, step: float, *, lead: float = 0.0) -> Wave:
        """Return the wave as a march with steps in s meets it: its corners are put on the steps.

        They are next to them anyway, by `steps_to_corners`: those of a wave that begins at phase 0.
        A wave up that is ahead by itself has its corners elsewhere, and is met as it is.
        """
        if self.shape is None:
            return AT_REST
        shape = self.shape
        if self.meets_corners and 0.0 in self._leads:
            shape = shape.on_corners(round(1.0 / (self.frequency * step)))
        return shape.wave(lead=lead)

    def steps_to_corners(self, least: float) -> int:
        """Equal steps of a cycle that end on the corners of its waves, in the plane and up."""
        if self.shape is None:
            raise InputError("nothing vibrates")
        missed = _MISSED_BY_COULOMB if self.friction.model == "coulomb" else _MISSED
        return self.shape.steps_to_corners(least, missed, self._leads)

    @property
    def _leads(self) -> tuple[float, ...]:
        """By how many cycles the waves that act are ahead, in the plane and up."""
        along, across, up = self.unit_direction
        in_plane = (0.0,) if along != 0.0 or across != 0.0 else ()
        return (*in_plane, *((self.normal_lead,) if up != 0.0 else ()))

    @functools.cached_property
    @in_proportion()
    def substeps(self) -> int:
        """Parts each step is divided into, see `asperity.slider.substeps`."""
        return self.finer * parts_of(self)

    def length(self, step: float) -> float:
        """Unit of length of the scaled problem, m."""
        if self.friction.model == "coulomb":
            return self.slider.drive_velocity * step
        return self.friction.deflection_limit(self.slider.normal_force)

    @in_proportion()
    def parameters(self, step: float) -> Parameters:
        """Return what the kernels are given for a time step in s, see `asperity.slider.scaled`."""
        slider, friction = self.slider, self.friction
        length = self.length(step)
        force = self.full_friction
        mobility = step * step * force / (slider.mass * length) if slider.mass is not None else 0.0
        stiffness = damping = lost = 0.0
        if slider.drive_stiffness is not None:
            stiffness = slider.drive_stiffness * length / force
            damping = slider.drive_damping * length / (step * force)
            lost = 0.5 * mobility * damping
        cos, sin, _ = self.unit_direction
        sign = -1.0 if self.on_body else 1.0
        transfer, sin = (1.0, ASKEW) if self.askew else (friction.transfer, sin)
        scaled = Parameters(
            drive=slider.drive_velocity * step / length,
            pull=0.0,
            stiffness=stiffness,
            damping=damping,
            retained=(1.0 - lost) / (1.0 + lost),
            mobility_x=0.0 if slider.rigid else mobility / (1.0 + lost),
            mobility_y=mobility if slider.free else 0.0,
            base_x=sign * self.amplitude * cos / length,
            base_y=sign * transfer * self.amplitude * sin / length,
            own_1=0.0 if self.on_body else 1.0,
            own_2=friction.transfer if self.on_body else 0.0,
            exponent=friction.exponent,
            rate_damping=friction.contact_damping * length / (step * force),
            slip_damping=friction.viscous_damping * length / (step * force),
            static_ratio=(friction.static_mu or friction.mu) / friction.mu,
            stribeck=friction.stribeck_velocity * step / length,
            rigid=slider.rigid,
            smooth=self.shape is None or self.shape.code in (SINE, SAMPLED),
            model=MODELS[friction.model],
            law=friction.law_code,
        )
        if not all(map(math.isfinite, scaled)):
            raise InputError(FAR_APART)
        return scaled

    def pressing(self, step: float) -> NormalLoading:
        """Return what the kernels are given of the normal direction for a time step in s."""
        scaled = self.rigid_pressing(step)
        if self.friction.model != "springs" or self.normal is None:
            return scaled
        heights, weights = spring_profile(self.normal.law, self.friction.springs, self.deepest)
        return scaled._replace(heights=heights, weights=weights)

    @functools.cached_property
    def deepest(self) -> float:
        """Indentation the springs are laid out to, in units of `asperity.normal`.

        A little more than the body comes to from rest, in its first cycles under all of the
        vibration.
        """
        q = self.rigid_pressing(self.step / self.substeps)
        if self.shape is None or q.base == 0.0:
            return _DEEPER * max(q.reference, 1.0)
        rate = self.frequency * self.step / self.substeps
        wave = self.shape.wave(lead=self.normal_lead)._replace(ramp=0.0)
        steps = min(round(_FIRST_CYCLES / rate), _MOST_FIRST_STEPS)
        return _DEEPER * float(greatest_indentation(q, wave, rate, steps))

    @in_proportion()
    def rigid_pressing(self, step: float) -> NormalLoading:
        """Numbers of the normal direction without springs."""
        if self.normal is None:
            raise InputError("the normal force of this body is a constant")
        load, mass = self.slider.normal_force, self.slider.mass
        length = self.normal_length
        dead = self.normal.control == "force" and mass is not None
        reference = REFERENCE_INDENTATION[self.normal.law]
        base = (-1.0 if self.on_body else 1.0) * self.amplitude * self.unit_direction[2] / length
        scaled = NormalLoading(
            law=self.normal.code,
            reference=reference,
            base=base,
            mobility=step * step * load / (mass * length) if dead and mass is not None else 0.0,
            damping=self.normal.loss(load, mass) * length / step,
            load_power=self.friction.load_exponent,
            keeps=self.friction.keeps_code,
            heights=np.zeros(0),
            weights=np.zeros(0),
        )
        if not all(map(math.isfinite, scaled[:6])):
            raise InputError(FAR_APART)
        return scaled


def require_models(models: Sequence[object]) -> "Sequence[Model]":
    """Return models as they are; InputError where there is anything else among them."""
    found = []
    for place, model in enumerate(models):
        if not isinstance(model, Model):
            raise InputError(
                f"models[{place}] is {shown(model)}; it must be a Model, as Model.from_case makes "
                "one"
            )
        found.append(model)
    return found
