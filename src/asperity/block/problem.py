"""The elastic block pulled over a vibrating base: thesis 5.3, and 7.3 with the block vibrated.

A block of the case's size stands on a rigid plane, z up. Gravity and a uniform pressure on its top
press it down with the normal force of ``[slider]`` together; then spring and dashpot pull it by its
leading end (x = +size/2), evenly over that face: the force goes through the middle of the end, half
the height above the base. Time runs from there on as it does for ``asperity slide``: the drive's
far end moves from 0 s on, the vibration begins at ``[vibration].start``.

A free block may shift and turn as it will: friction, which acts below its centre of mass, tilts it
and presses its leading edge down. A guided block slides on a straight rail that lets it shift along
x and z alone, neither sideways nor turning. A rigid drive moves it along x at the drive velocity.
Rail and rigid drive act on the body as gravity does, on all of its mass, so that they deform
nothing.
"""

import dataclasses
import functools
import math
from collections.abc import Callable
from typing import Self

import numpy as np
import numpy.typing as npt

from asperity.arrays import FloatArray
from asperity.block.parameters import Block, Contact
from asperity.casefile import Case
from asperity.contact.compliance import BaseCompliance, base_compliance
from asperity.contact.elastic import (
    CondensedBody,
    ElasticBody,
    ElasticMaterial,
    Pressure,
    Traction,
    condense,
    elastic_body,
)
from asperity.contact.interface.friction import PointFriction
from asperity.contact.interface.normal import NormalLaw
from asperity.contact.interface.rigid import RigidSurface
from asperity.contact.interface.surface import ContactSurface, contact_surface
from asperity.contact.motion import mechanism as mo
from asperity.contact.motion.system import Shaking, System
from asperity.errors import InputError
from asperity.mesh import HexMesh, box
from asperity.slider.longer import lasting
from asperity.slider.model import Model
from asperity.slider.timetable import Timetable
from asperity.vibration import Vibration

STANDARD_GRAVITY = 9.80665
"""m/s^2."""

_GRAVITY, _PRESSURE, _DRIVE = "gravity_z", "pressure", "drive"


class UndividedModel(Model):
    """A sliding body whose steps are taken as they are given."""

    @property
    def substeps(self) -> int:
        """Parts of a step: the implicit solution takes it whole."""
        if self.solve.scheme == "two-phase":
            # The explicit scheme refuses a step it is unstable with.
            _ = super().substeps
        return 1


@dataclasses.dataclass(frozen=True)
class BlockProblem:
    """An elastic block to be solved.

    Attributes
    ----------
    model : UndividedModel
        The sliding body the block is: drive, friction, vibration, times.
    block, contact : Block, Contact
        The tables of the case.
    notify : callable, optional
        Takes one line about what was found damaged on the way.
    """

    model: UndividedModel
    block: Block
    contact: Contact = dataclasses.field(default_factory=Contact)
    notify: Callable[[str], None] | None = dataclasses.field(
        default=None, compare=False, repr=False
    )

    def __post_init__(self) -> None:
        model, slider = self.model, self.model.slider
        if model.solve.method not in ("march", "settled"):
            raise InputError(
                f"solve.method is '{model.solve.method}'; an elastic block is solved by 'march' "
                "or, for its steady state under vibration, by 'settled'"
            )
        if model.solve.method == "settled" and not model.vibrates:
            raise InputError(
                "solve.method is 'settled', which is for a block that is vibrated, and nothing "
                "vibrates: take 'march'"
            )
        if slider.mass is None:
            raise InputError("slider.mass is missing; it makes the density of the block")
        weight = slider.mass * STANDARD_GRAVITY
        if weight > slider.normal_force:
            raise InputError(
                f"slider.normal_force is {slider.normal_force:g} N; it must be at least the weight "
                f"of the block, {weight:.4g} N, the rest is pressure on its top: give a smaller "
                "slider.mass"
            )

    @classmethod
    def from_case(cls, case: Case) -> Self:
        """Gather the tables of a case; [contact] may be missing.

        Parameters
        ----------
        case : Case
            With the tables of a sliding body and ``[block]``.

        Returns
        -------
        BlockProblem
            Checked, and not yet meshed.

        Raises
        ------
        InputError
            A table is missing, two do not go together, or a block cannot be solved this way.
        """
        contact = case.get(Contact, Contact())
        vibration = case.get(Vibration)
        elevation = vibration.elevation if vibration else 0.0
        if elevation != 0.0:
            raise InputError(
                f"vibration.elevation is {math.degrees(elevation):g} deg; a block is shaken in the "
                "plane of contact only: leave it out, or take `asperity slide`"
            )
        # A block's normal contact is that of its faces, in [contact].
        model = dataclasses.replace(UndividedModel.from_case(case), normal=None, wear=None)
        return cls(model, case.require(Block), contact)

    @functools.cached_property
    def timetable(self) -> Timetable:
        """Steps, window and finely recorded tail of the march."""
        return Timetable(self.model)

    def lasting(self, duration: float) -> Self:
        """Return the same block marched for a duration in s, with what has been made of it.

        Parameters
        ----------
        duration : float
            s, from the start of the march.

        Returns
        -------
        BlockProblem
            Another one, which shares meshes and condensed bodies with this one.
        """
        made = {name: value for name, value in vars(self).items() if name != "timetable"}
        longer = dataclasses.replace(self, model=lasting(self.model, duration))
        vars(longer).update({**made, "model": longer.model})
        return longer

    @property
    def nodes(self) -> int:
        """Number of nodes of the mesh."""
        return math.prod(self.block.order * count + 1 for count in self.block.elements)

    @property
    def tips(self) -> bool:
        """Whether the block tips over its leading edge before it slides.

        The drive pulls at half the height: full friction moves the middle of the pressure forward
        by mu h/2, which at half the length is its edge.
        """
        slider, size = self.model.slider, self.block.size
        return slider.free and self.friction.mu * size[2] > size[0]

    @property
    def mass(self) -> float:
        """Of the block, kg; 0 where none is given."""
        return self.model.slider.mass or 0.0

    @property
    def mean_pressure(self) -> float:
        """Nominal mean pressure of the contact, Pa."""
        return self.model.slider.normal_force / self.block.area

    @property
    def top_pressure(self) -> float:
        """Pressure on the top that adds to gravity what is missing from the normal force, Pa."""
        return (self.model.slider.normal_force - self.mass * STANDARD_GRAVITY) / self.block.area

    @functools.cached_property
    def mesh(self) -> HexMesh:
        """Hexahedra of the block, standing on z = 0."""
        return box(self.block.size, self.block.elements, self.block.order)

    @property
    def material(self) -> ElasticMaterial:
        """What the block is made of."""
        block = self.block
        return ElasticMaterial(block.youngs_modulus, block.poissons_ratio, block.density(self.mass))

    @functools.cached_property
    def body(self) -> CondensedBody:
        """The block condensed to the nodes of its bottom."""
        return condense(
            self.mesh,
            self.material,
            "bottom",
            element=self.block.element,
            loads={_PRESSURE: Pressure("top"), _DRIVE: _pull()},
            modes=self.block.modes,
            notify=self.notify,
        )

    @functools.cached_property
    def uncondensed(self) -> ElasticBody:
        """The block with all its nodes, for pictures of the whole of it."""
        return elastic_body(self.mesh, self.material, element=self.block.element)

    @functools.cached_property
    def nodal_loads(self) -> FloatArray:
        """Nodal forces of gravity and pressure on the whole block, shape (3 N,), N."""
        _, _, upwards, *_ = self.uncondensed.inertia.T
        down: FloatArray = -STANDARD_GRAVITY * upwards
        return down + self.top_pressure * Pressure("top").forces(self.mesh).ravel()

    @functools.cached_property
    def nodal_drive(self) -> FloatArray:
        """Nodal forces of a drive force of 1 N, shape (3 N,)."""
        return _pull().forces(self.mesh).ravel()

    @functools.cached_property
    def surface(self) -> ContactSurface:
        """The bottom, integrated over."""
        return contact_surface(self.mesh, "bottom")

    @functools.cached_property
    def normal(self) -> NormalLaw:
        """Pressure against overclosure."""
        height = self.block.size[2] / self.block.elements[2]
        stiffness = self.contact.normal_stiffness(self.block.youngs_modulus, height)
        if self.contact.normal != "two-stage":
            return NormalLaw(self.contact.normal, stiffness)
        edge = max(self.block.size[i] / self.block.elements[i] for i in (0, 1))
        law = NormalLaw.two_stage(stiffness, edge)
        start, end = self.contact.transition or (law.start, law.end)
        initial = self.contact.initial_stiffness or law.initial
        return NormalLaw("two-stage", stiffness, initial, start, end)

    @functools.cached_property
    def friction(self) -> PointFriction:
        """Friction at a point of the contact."""
        slider, solve = self.model.slider, self.model.solve
        return PointFriction.of(
            self.model.friction,
            slider.normal_force,
            area=self.block.size[0] * self.block.size[1],
            two_phase=solve.scheme == "two-phase",
        )

    @functools.cached_property
    def loads(self) -> tuple[mo.Port, mo.Port]:
        """Gravity; gravity and pressure."""
        gravity = _combined(self.body, {_GRAVITY: -STANDARD_GRAVITY})
        both = _combined(self.body, {_GRAVITY: -STANDARD_GRAVITY, _PRESSURE: self.top_pressure})
        return gravity, both

    @functools.cached_property
    def system(self) -> System:
        """Body, base, drive and vibration, as `asperity.contact.motion.system` takes them."""
        model, slider = self.model, self.model.slider
        return System(
            mechanism=mechanism(
                self.body,
                drive=(slider.drive_stiffness, slider.drive_damping),
                load=self.loads[1],
                held=held_coordinates(self.body, rigid=slider.rigid, guided=not slider.free),
                damping_ratio=self.block.damping_ratio,
                dashpots=self._dashpots,
            ),
            surface=self.surface,
            counter=RigidSurface.plane(),
            normal=self.normal,
            friction=self.friction,
            shaking=shaking(model),
            drive_velocity=slider.drive_velocity,
            full_friction=model.full_friction if not slider.rigid else math.inf,
        )

    @property
    def _dashpots(self) -> FloatArray:
        """Damping of the rigid body's six coordinates by its contact, SI."""
        ratio, surface = self.contact.damping_ratio, self.surface
        stiffness = surface.area * self.normal.slope_at(self.mean_pressure)
        by_area = 2.0 * ratio * math.sqrt(stiffness * self.mass) / surface.area
        along, across, _ = np.moveaxis(surface.points, -1, 0)
        moments = [surface.integral(lever**2) for lever in (np.ones_like(along), across, along)]
        return by_area * np.array([0.0, 0.0, *map(float, moments), 0.0])

    @functools.cached_property
    def compliance(self) -> BaseCompliance:
        """How the bottom gives under friction spread evenly over it, at the mean pressure."""
        mechanism = self.system.mechanism
        return base_compliance(mechanism, self.surface, self.normal, self.mean_pressure)


def _pull() -> Traction:
    return Traction("right", (1.0, 0.0, 0.0))


def mechanism(
    body: CondensedBody,
    *,
    drive: tuple[float | None, float],
    load: mo.Port,
    held: npt.NDArray[np.bool_],
    damping_ratio: float = 0.0,
    dashpots: npt.ArrayLike = 0.0,
) -> mo.Mechanism:
    """Return a free condensed body with its drive's stiffness and damping, load and guides.

    ``damping_ratio`` is that of the modes, over the critical damping of each; ``dashpots`` are
    those of the six coordinates of the rigid body, SI.
    """
    modes = len(body.mode_frequency)
    size = 6 + modes
    mass, stiffness = np.eye(size), np.zeros((size, size))
    mass[:6, :6] = body.mass
    stiffness[6:, 6:] = np.diag(body.mode_stiffness)
    resistance = np.zeros(size)
    resistance[:6] = dashpots
    resistance[6:] = 2.0 * damping_ratio * np.sqrt(body.mode_stiffness)
    pull, damping = drive
    port = _combined(body, {_DRIVE: 1.0})
    return mo.Mechanism(
        flexibility=body.residual_flexibility,
        shapes=np.hstack([body.rigid, body.modes]),
        mass=mass,
        stiffness=stiffness,
        held=held,
        drive=None if pull is None else mo.Drive(port, pull, damping),
        load=load,
        damping=resistance,
    )


def held_coordinates(body: CondensedBody, *, rigid: bool, guided: bool) -> npt.NDArray[np.bool_]:
    """Return which coordinates a rigid drive and a guide hold."""
    shifts, turns = (rigid, guided, False), (guided, guided, guided)
    return np.array([*shifts, *turns, *np.zeros(len(body.mode_frequency), dtype=bool)])


def shaking(model: Model) -> Shaking | None:
    """Return the vibration of a sliding body as a contact sees it; None where nothing is shaken."""
    if model.shape is None or not model.vibrates:
        return None
    along, across, _ = model.unit_direction
    return Shaking(
        model.shape,
        (model.amplitude * along, model.amplitude * across, 0.0),
        model.start,
        model.friction.transfer,
        model.on_body,
    )


def _combined(body: CondensedBody, sizes: dict[str, float]) -> mo.Port:
    vector = body.loads(sizes)
    return mo.Port(
        generalised=np.concatenate([body.load_rigid @ vector, body.load_modes @ vector]),
        response=body.residual_load_flexibility @ vector,
        own=float(vector @ body.residual_load_compliance @ vector),
    )
