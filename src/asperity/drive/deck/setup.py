"""What a deck of loaded teeth says, whichever program reads it; SI throughout.

The sector of teeth of `asperity.drive.teeth`, held at its rim, and the flanks of the worm's threads
in its spaces as a rigid surface. Both are moved from where they hardly touch: first the rim turns
back against the worm, by as much as the load turns it; then it turns freely under the load as the
worm turns on, far enough that friction is that of sliding. What the program finds at the end stands
beside `TeethSetup.balance`: the worm's torque about its axis, and the wheel's turn from where the
flanks touch. Nodes of both flanks stand where the faces between them are on the exact ones
(`asperity.drive.deck.facets`).
"""

import dataclasses
import functools
import math

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.drive.deck.facets import on_faces, rows_of
from asperity.drive.problem import DriveProblem
from asperity.drive.solve import prepare
from asperity.drive.static.equilibrium import Balance, Equilibrium
from asperity.drive.static.solve import StaticModel
from asperity.drive.teeth.contact import CONTACT_STIFFNESS, TeethContact
from asperity.drive.teeth.sector import RIM
from asperity.errors import InputError
from asperity.flanks.worm.setting import Pair
from asperity.mesh import HexMesh
from asperity.runs import Run
from asperity.vibration import Vibration
from asperity.vibration.waveform import SINE

_MILLIMETRES = 1e3
SLID = 5e-3
"""Turn of the worm in the second step, rad: some fifty micrometres, many times the elastic slip."""

_APART = 15e-6  # m, of the flanks at the start
_SWEPT = math.radians(55.0)  # to both sides of the line of centres
PER_TURN, _ON_FLANK = 240, 12
_THICK = 0.3  # mm, of the layer that stands for a rigid thread
_STICK = 0.2  # of Coulomb's friction before it slides, over the contact's stiffness
FLANK, WORM, WHEEL = "wheel_flanks", "worm_flanks", "wheel"


@dataclasses.dataclass(frozen=True)
class TeethSetup:
    """Teeth under load, ready to be written.

    Attributes
    ----------
    name : str
        Of the case.
    problem : DriveProblem
        The drive.
    model : StaticModel
        Its loaded contact, as the package itself solves it.
    shaken : DriveProblem, optional
        The same under its vibration, where a deck of it can be written.
    unshaken : str
        Why it cannot, else empty.
    ends : float
        Angle of the worm at the end of the second step, rad.
    """

    name: str
    problem: DriveProblem
    model: StaticModel
    shaken: DriveProblem | None = None
    unshaken: str = ""
    ends: float = 0.0

    @classmethod
    def from_case(cls, case: Case, run: Run | None = None) -> "TeethSetup":
        """Gather the tables of a case; its teeth are condensed if none are kept.

        The worm is rigid, whatever ``drive.threads`` says: a deck has its flanks as a surface.

        Raises
        ------
        InputError
            The case makes no drive, or its teeth cannot carry the torque.
        """
        problem = _with_rigid_threads(prepare(case, static=True))
        if problem.wheel_body is not None:
            raise InputError(
                "drive.wheel_body is 'web'; a deck holds the inside of the rim: leave it out, or "
                "take 'rim'"
            )
        model = StaticModel(problem, run or Run(), phases=1)
        return cls(case.source, problem, model, *_shaken(case))

    def at(self, angle: float) -> "TeethSetup":
        """Return the same with the worm at an angle at the end, rad.

        Decks at angles over a pitch are the worm's turning in steps without inertia: after a pitch
        the next tooth is where this one was, and a revolution of the worm is as many pitches as it
        has starts, one of the wheel as many as it has teeth.

        Raises
        ------
        InputError
            It is more than half a pitch from the middle tooth's, or no number.
        """
        pitch = self.model.sector.pitch * self.pair.ratio
        # As much room as the last digits of a half pitch take.
        if not abs(angle) <= (0.5 + 1e-9) * pitch:
            raise InputError(
                f"angle is {angle:.6g} rad; the sector's middle tooth meshes from {-pitch / 2:.6g} "
                f"to {pitch / 2:.6g} rad: after a pitch of {pitch:.6g} rad all repeats, take whole "
                "pitches away"
            )
        return dataclasses.replace(self, ends=angle)

    @property
    def pair(self) -> Pair:
        """Worm and wheel, right-handed: a left-handed gearset is its mirror image."""
        return dataclasses.replace(self.model.sector.wheel.pair, hand="right")

    @functools.cached_property
    def balance(self) -> Balance:
        """The package's own balance at the end of the deck's second step, the shaft rigid."""
        return Equilibrium(self.model.contact).balance(self.ends, self.problem.load)

    @functools.cached_property
    def touching(self) -> float:
        """Angle of the wheel that touches the worm where the second step ends, rad."""
        return self.model.contact.touching_angle(self.ends, np.zeros(3))

    @property
    def wheel_angles(self) -> tuple[float, float, float]:
        """Of the wheel before and after the first step, and at the end by the package, rad."""
        end = self.balance.wheel_angle
        back = SLID / self.pair.ratio
        radius = 0.5e-3 * self.pair.geometry.wheel_mean_diameter
        return self.touching - back + _APART / radius, end - back, end

    @property
    def worm_angles(self) -> tuple[float, float, float]:
        """Of the worm before and after both steps, rad."""
        return self.ends - SLID, self.ends - SLID, self.ends

    @property
    def axis(self) -> FloatArray:
        """Unit vector of the worm's axis, about which it turns in the positive sense."""
        return np.asarray(self.model.contact.stand.axes[2])

    @property
    def origin(self) -> FloatArray:
        """A place on the worm's axis, m."""
        return np.asarray(self.model.contact.stand.origin)

    @functools.cached_property
    def wheel(self) -> HexMesh:
        """The sector before the first step, m: sets `RIM` of nodes and `FLANK` of faces."""
        mesh = self.model.sector.mesh
        teeth = self.model.sector.teeth
        names = ["flank_plus"] if teeth == 1 else [f"flank_plus_{k}" for k in range(teeth)]
        faces = np.concatenate([mesh.face_sets[name] for name in names])
        places = mesh.points.copy()
        for name in names:
            flank = rows_of(mesh.face_nodes(name)[:, :4])
            places[flank] = on_faces(places[flank])
        points = turned_about(
            places / _MILLIMETRES, np.array([0.0, 0.0, 1.0]), np.zeros(3), self.wheel_angles[0]
        )
        rim = mesh.node_set(RIM)
        return HexMesh(points, mesh.cells, node_sets={RIM: rim}, face_sets={FLANK: faces})

    @functools.cached_property
    def worm(self) -> HexMesh:
        """Layers of hexahedra under the worm's flanks before the first step, m; faces `WORM`."""
        layers = [self._layer(space) for space in self._spaces]
        sizes = np.cumsum([0, *(len(layer.points) for layer in layers)])
        cells = [layer.cells + first for layer, first in zip(layers, sizes, strict=False)]
        points = np.concatenate([layer.points for layer in layers])
        moved = turned_about(points, self.axis, self.origin, self.worm_angles[0])
        count = sum(len(layer.cells) for layer in layers)
        # The lower side of every cell is on the flank.
        faces = np.stack([np.arange(count), np.full(count, 4)], axis=1)
        return HexMesh(
            moved,
            np.concatenate(cells),
            node_sets={"worm": np.arange(len(moved))},
            face_sets={WORM: faces},
        )

    @property
    def _spaces(self) -> range:
        half = self.model.sector.teeth // 2
        return range(-half, half + 1)

    def _layer(self, space: int) -> HexMesh:
        """The thread beside a space of the worm, under the flank that drives."""
        worm = self.pair.worm
        # Denser towards the root, where the flank bends.
        rho, axial = worm.curve(np.linspace(0.0, 1.0, _ON_FLANK) ** 2)[:2]
        count = 1 + math.ceil(2.0 * _SWEPT * PER_TURN / (2.0 * math.pi))
        # Turned by the worm's angle it is about the line of centres again.
        turn = np.linspace(-_SWEPT, _SWEPT, count) - self.ends
        place = 2.0 * worm.half_pitch * space
        z = axial[:, None] + worm.reduced_lead * turn + place
        flank = on_faces(
            np.stack(
                np.broadcast_arrays(rho[:, None] * np.cos(turn), rho[:, None] * np.sin(turn), z),
                axis=-1,
            )
        )
        points = np.stack([flank, flank + np.array([0.0, 0.0, _THICK])], axis=2)
        number = np.arange(points[..., 0].size).reshape(points.shape[:3])
        corners = [
            number[i : i + len(rho) - 1, j : j + count - 1, k]
            for k in (0, 1)
            for i, j in ((0, 0), (1, 0), (1, 1), (0, 1))
        ]
        cells = np.stack(corners, axis=-1).reshape(-1, 8)
        there = self.pair.mounting.to_wheel(points.reshape(-1, 3)) / _MILLIMETRES
        return HexMesh(there, cells)

    @property
    def stiffness(self) -> float:
        """Pressure per overclosure of the flanks, Pa/m."""
        return CONTACT_STIFFNESS

    @functools.cached_property
    def stick(self) -> float:
        r"""Shear stress per slip of flanks before they slide, Pa/m.

        Of a law with an elastic deflection its slope at rest, :math:`\mu p/s_{max}`, at the mean
        pressure, weighted by the force that it carries; of Coulomb's a fifth of the contact's. The
        pressure is that of the deck's own teeth under all of the load.
        """
        friction = self.problem.friction
        if friction.model == "coulomb":
            return _STICK * self.stiffness
        sector = self.model.sector
        # Of its own: that of the model is another's as soon as another angle is balanced.
        contact = TeethContact(sector, self.model.friction, most=sector.teeth)
        end = Equilibrium(contact).balance(self.ends, self.problem.load)
        force, pressed = 0.0, 0.0
        for k, number in enumerate(4 * end.contact.candidates.counts[:, 0]):
            pressure = end.contact.answer.pressure[k, :number]
            own = pressure * end.contact.candidates.weights[k, :number]
            force, pressed = force + float(own.sum()), pressed + float(own @ pressure)
        return float(self.model.friction * pressed / force / friction.deflection_limit(force))

    def notes(self) -> list[str]:
        """Return what stands at the head of a deck."""
        end = self.balance
        teeth, sharing = self.model.sector.teeth, np.count_nonzero(end.action.normal)
        alone = (
            f" Its load is shared by {sharing} teeth, and this deck has {teeth}, which bear it "
            "alone: only the ratio of torques may be compared."
        )
        return [
            "SI units: m, kg, s, N, Pa. The wheel's axis is Z through the origin, its middle tooth "
            "about +Y.",
            f"The worm's axis goes through ({', '.join(f'{x:.6g}' for x in self.origin)}) along "
            f"({', '.join(f'{x:.6g}' for x in self.axis)}).",
            "Step 1: the rim turns back against the worm. Step 2: it turns freely under the load "
            "as the worm turns on, until friction is that of sliding.",
            f"asperity itself, on exact flanks, shaft rigid: {self.problem.load:.6g} N m on the "
            f"wheel, {end.worm_torque:.6g} N m on the worm, ratio "
            f"{self.problem.load / end.worm_torque:.5g}, the wheel "
            f"{1e6 * (self.touching - end.wheel_angle):.5g} urad from where the flanks touch."
            + (alone if teeth < sharing else ""),
        ]


def turned_about(
    points: FloatArray, axis: FloatArray, origin: FloatArray, angle: float
) -> FloatArray:
    """Return places turned about an axis through a place, m."""
    away = points - origin
    cosine, sine = math.cos(angle), math.sin(angle)
    along = (away @ axis)[:, None] * axis
    return np.asarray(
        origin
        + along
        + cosine * (away - along)
        + sine * np.cross(np.broadcast_to(axis, away.shape), away)
    )


def _with_rigid_threads(problem: DriveProblem) -> DriveProblem:
    drive = problem.drive.model_copy(update={"threads": "rigid"})
    return dataclasses.replace(problem, drive=drive)


def _shaken(case: Case) -> tuple[DriveProblem | None, str]:
    """Return a case's drive under a vibration that a deck can make, or why there is none."""
    if Vibration.table not in case:
        return None, ""
    try:
        problem = _with_rigid_threads(DriveProblem.from_case(case))
    except InputError as error:
        return None, str(error)
    vibration, shape = problem.vibrated
    if problem.mode != "axial" or vibration.applied_to != "worm" or shape.code != SINE:
        return None, "it is of a worm that a sine shakes along its axis (vibration.mode = 'axial')"
    if problem.shaft.torsion is None:
        return None, "it takes the torsion of the shaft (shaft.torsional_stiffness)"
    return problem, ""
