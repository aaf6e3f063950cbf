"""A worm gearset's drive made ready: the tables of a case, checked, and what follows from them."""

import dataclasses
import functools
import math
from pathlib import Path
from typing import Self

from asperity.casefile import Case, naming_source
from asperity.drive.friction import check_friction, mesh_friction
from asperity.drive.lacking import FREE_WORM, moved, require_all
from asperity.drive.parameters import Actuator, Drive, Shaft
from asperity.drive.point import MeshPoint
from asperity.drive.warmed import Warmed
from asperity.drive.worm_shaft import shaft_of
from asperity.errors import InputError
from asperity.flanks.parameters import Disc, Hob, Modification, Mount
from asperity.friction import Friction
from asperity.gearset import Gearset, Geometry
from asperity.gearset.blanks import Blanks, WheelBody
from asperity.rating import Operation, RatingOptions
from asperity.rating.driven import driven
from asperity.rating.tables import operation_of
from asperity.slider.parameters import Solve
from asperity.vibration import Vibration
from asperity.vibration.waveform import Shape

LARGEST_STEP = 0.5e-6
_LARGEST_TORQUE = 1e9  # N m: above that of any gear that was made
_FASTEST = 1e6 * math.pi / 30.0  # rad/s: no rim of metal is whole far below
STEPS_A_CYCLE = 100
PLACES = {
    "axial": ("worm", "seat"),
    "torsional": ("worm", "motor"),
    "wheel-axial": ("wheel",),
    "screw": ("worm", "seat"),
}
"""What each way of shaking can be applied to, the first where nothing is said."""

_ROUND = ("torsional", "screw")


@dataclasses.dataclass(frozen=True)
class DriveProblem:
    """A gearset that is driven, loaded and perhaps shaken.

    Attributes
    ----------
    gearset, operation, friction, drive, shaft, solve
        The tables of the case.
    vibration : Vibration or None
        None: nothing is shaken.
    shape : Shape or None
        Its waveform.
    actuator : Actuator or None
        None: nothing is said of the electrical side.
    hob, mount, modification, disc
        How the flanks are made and mounted, warm with ``drive.warm``; None: as they should be.
    blank : Blanks or None
        Web and hub, where they count; None: as is usual.
    case : Case or None
        Where it comes from.
    """

    gearset: Gearset
    operation: Operation
    friction: Friction
    drive: Drive
    shaft: Shaft = dataclasses.field(default_factory=Shaft)
    solve: Solve = dataclasses.field(default_factory=Solve)
    vibration: Vibration | None = None
    shape: Shape | None = None
    actuator: Actuator | None = None
    hob: Hob | None = None
    mount: Mount | None = None
    modification: Modification | None = None
    disc: Disc | None = None
    blank: Blanks | None = None
    case: Case | None = None

    def __post_init__(self) -> None:
        check_friction(self.friction)
        if self.solve.method != "march" or self.solve.scheme != "exponential":
            raise InputError(
                f"solve.method is '{self.solve.method}' and solve.scheme '{self.solve.scheme}'; a "
                "gearset is marched: leave both out"
            )
        if not abs(self.load) <= _LARGEST_TORQUE:
            raise InputError(
                f"operation.output_torque is {self.load:.4g} N m; a drive carries at most "
                f"{_LARGEST_TORQUE:.0e} N m"
            )
        if self.vibration is not None:
            self._check_vibration(self.vibration)
        _ = self.wheel_body  # A hub that leaves no rim is refused before anything is solved.

    @classmethod
    def from_case(cls, case: Case, *, shaken: bool = True) -> Self:
        """Gather the tables of a case; ``shaken`` says whether its vibration counts.

        Raises
        ------
        InputError
            They do not make a gearset's drive.
        """
        require_all(case, shaken=shaken)
        with naming_source(case):
            run = operation_of(case)
            operation = driven(case.require(Gearset), run, case.get(RatingOptions))
            vibration = shape = None
            if shaken and Vibration.table in case:
                vibration = case.require(Vibration).of_gearset(PLACES)
                turns = operation.worm_speed / (2.0 * math.pi)
                shape = vibration.shape(case.folder, turns=turns)
            gearset, drive = case.require(Gearset), case.get(Drive, Drive())
            mount, modification = case.get(Mount), case.get(Modification)
            if drive.warm:
                warm = Warmed.asked(case, gearset, mount, modification)
                mount, modification = warm.mount, warm.modification
            return cls(
                gearset=gearset,
                operation=operation,
                friction=mesh_friction(case, gearset, operation, drive),
                drive=drive,
                shaft=shaft_of(case),
                solve=case.get(Solve, Solve()),
                vibration=vibration,
                shape=shape,
                actuator=case.get(Actuator),
                hob=case.get(Hob),
                mount=mount,
                modification=modification,
                disc=case.get(Disc),
                blank=case.get(Blanks),
                case=case,
            )

    @functools.cached_property
    def geometry(self) -> Geometry:
        """Of the gearset, mm."""
        return self.gearset.require_consistent().geometry

    @functools.cached_property
    def wheel_body(self) -> WheelBody | None:
        """Web and hub of the wheel; None where its rim's inside is held."""
        if self.drive.wheel_body == "rim":
            return None
        return WheelBody.of(self.geometry, self.blank)

    @property
    def warmer(self) -> Warmed | None:
        """How it would stand warm; None where it does, or no temperatures are given."""
        if self.case is None or self.drive.warm:
            return None
        return Warmed.of(self.case, self.gearset, self.mount, self.modification)

    @property
    def warmed(self) -> Warmed | None:
        """How it stands warm, over how its case is cold; None where it is cold."""
        if self.case is None or not self.drive.warm:
            return None
        case = self.case
        return Warmed.of(case, self.gearset, case.get(Mount), case.get(Modification))

    @property
    def folder(self) -> Path | None:
        """Where relative file names start."""
        return None if self.case is None else self.case.folder

    @property
    def worm_speed(self) -> float:
        """Of the worm, rad/s."""
        return self.operation.worm_speed

    @property
    def load(self) -> float:
        """Torque of the wheel, N m."""
        return self.operation.output_torque

    @property
    def flow_pressure(self) -> float | None:
        """Pressure at which the wheel flows, Pa; None where it stays elastic."""
        return self.gearset.wheel_material.flow_pressure if self.drive.plastic else None

    @property
    def reference_radius(self) -> float:
        """Of the worm's reference circle, m."""
        return 0.5e-3 * self.geometry.worm_pitch_diameter

    @property
    def sliding_speed(self) -> float:
        """Of the flanks on the reference circle, v_g, m/s."""
        return self.worm_speed * self.reference_radius / math.cos(self.geometry.lead_angle)

    def shaken(self, mode: str, amplitude: float) -> Self:
        """Return it shaken another way, with an amplitude of the displacement in m."""
        vibration, _ = self.vibrated
        changed = vibration.model_copy(
            update={
                "mode": mode,
                "applied_to": vibration.applied_to if mode == self.mode else PLACES[mode][0],
                "velocity_ratio": None,
                "velocity_amplitude": None,
                "displacement_amplitude": amplitude,
            },
            units="SI",
        )
        return dataclasses.replace(self, vibration=changed)

    def point(self, radius: float | None) -> MeshPoint:
        """Return where the reduced mesh touches; on the reference circle if no radius is known."""
        return MeshPoint.of(self.geometry, self.reference_radius if radius is None else radius)

    @functools.cached_property
    def worm_inertia(self) -> float:
        """Of worm and shaft, kg m2."""
        return self._of_worm(self.drive.worm_inertia, self.shaft.inertia, "worm_inertia")

    @functools.cached_property
    def worm_mass(self) -> float:
        """Of worm and shaft, kg."""
        return self._of_worm(self.drive.worm_mass, self.shaft.mass, "worm_mass")

    @property
    def backlash(self) -> float:
        """Normal play between the flanks, m; raises InputError where it is not known."""
        if self.mount is None or self.mount.backlash is None:
            raise InputError(
                "mount.backlash is missing; both flanks may touch, and how far they are apart is "
                "not known: give it, or drive.flanks = 'driving'"
            )
        return self.mount.backlash

    def _of_worm(self, given: float | None, cylinders: object, key: str) -> float:
        if given is not None:
            return given
        assert callable(cylinders)
        g = self.geometry
        found: float | None = cylinders(1e-3 * g.worm_pitch_diameter, 1e-3 * g.worm_face_width)
        if found is None:
            raise InputError(
                f"drive.{key} is missing; give it, or shaft.diameter and shaft.span, of which it "
                "is estimated"
            )
        return found

    @functools.cached_property
    def vibrated(self) -> tuple[Vibration, Shape]:
        """Vibration and waveform; raises InputError where nothing is shaken."""
        if self.vibration is None or self.shape is None:
            raise InputError(
                "the table [vibration] is missing; add it (mode, frequency and an amplitude)"
            )
        return self.vibration, self.shape

    @functools.cached_property
    def mode(self) -> str:
        """Which way it is shaken."""
        return str(self.vibrated[0].mode)

    @functools.cached_property
    def reference_speed(self) -> float:
        """Speed that the vibration's is a ratio of, m/s.

        Of a turning motion that of the reference circle, which stands still at a ratio of 1; of
        others the sliding speed there.
        """
        if self.mode in _ROUND:
            return self.worm_speed * self.reference_radius
        return self.sliding_speed

    @functools.cached_property
    def amplitude(self) -> float:
        """Of the vibration's displacement, m; of a turning motion that of the reference circle."""
        vibration, shape = self.vibrated
        return vibration.displacement(shape, self.reference_speed)

    @functools.cached_property
    def velocity(self) -> float:
        """Peak velocity of the vibration, m/s."""
        vibration, shape = self.vibrated
        return vibration.velocity(shape, self.reference_speed)

    @property
    def velocity_ratio(self) -> float:
        """Of the vibration, k_w."""
        return self.velocity / self.reference_speed

    def _check_vibration(self, vibration: Vibration) -> None:
        if not self.worm_speed <= _FASTEST:
            raise InputError(
                f"operation.worm_speed is {self.worm_speed * 30.0 / math.pi:.4g} rpm; a drive is "
                "marched at 1e6 rpm at most"
            )
        if self.friction.model == "lugre" and self.drive.model == "teeth":
            raise InputError(
                "friction.model is 'lugre', which drive.model 'reduced' takes; points of elastic "
                "teeth that lose static friction jump, which a step's equilibrium does not "
                "follow: march teeth with 'coulomb' or 'dahl' (--static takes it)"
            )
        for key, what in (("load_inertia", "inertia of the load"), ("contact_damping", "damping")):
            if getattr(self.drive, key) is None:
                example = "3.2e-3 kg m**2" if key == "load_inertia" else "0.01 s/m"
                raise InputError(
                    f"drive.{key} is missing; under vibration every number depends on the {what}: "
                    f"give one such as '{example}'"
                )
        places = PLACES[str(vibration.mode)]
        if vibration.applied_to not in places:
            raise InputError(
                f"vibration.applied_to is '{vibration.applied_to}'; vibration.mode "
                f"'{vibration.mode}' is applied to {' or '.join(map(repr, places))}"
            )
        if vibration.applied_to == "motor" and self.shaft.torsion is None:
            raise InputError(
                "vibration.applied_to is 'motor', but the shaft is rigid, so that the worm itself "
                "is shaken: give shaft.torsional_stiffness, or apply it to 'worm'"
            )
        self._check_protocol(vibration)
        self._check_amplitude()
        self._check_step()
        self._check_moved()
        if self.drive.flanks == "both":
            _ = self.backlash

    def _check_protocol(self, vibration: Vibration) -> None:
        protocol, place = self.drive.protocol, vibration.applied_to
        if place == "motor" and protocol in FREE_WORM:
            raise InputError(
                f"vibration.applied_to is 'motor', but with drive.protocol '{protocol}' "
                f"{FREE_WORM[protocol]}, so that nothing of it comes to the worm: apply it to "
                "'worm'"
            )
        if protocol == "tangential" and place in ("seat", "motor"):
            raise InputError(
                f"vibration.applied_to is '{place}', but drive.protocol 'tangential' moves the "
                "worm itself along its flank: apply it to 'worm'"
            )

    def _check_moved(self) -> None:
        """Refuse a worm whose inertia or mass counts and is not known."""
        actuated = self.actuator is not None and self.amplitude > 0.0
        turns, shifts = moved(self.drive, self.shaft, self.mode, actuated)
        if turns:
            _ = self.worm_inertia
        if shifts:
            _ = self.worm_mass

    def _check_amplitude(self) -> None:
        g, amplitude = self.geometry, self.amplitude
        if self.mode == "wheel-axial":
            room, what = 0.5e-3 * g.wheel_face_width, "half the face width of the wheel"
        else:
            room, what = 0.25e-3 * g.axial_pitch, "a quarter of the axial pitch"
        way = amplitude
        if self.mode in _ROUND:
            way *= 1e-3 * g.reduced_lead / self.reference_radius
        if not way <= room:
            raise InputError(
                f"the vibration's amplitude of {1e3 * amplitude:.4g} mm shifts the threads by "
                f"{1e3 * way:.4g} mm and lifts the worm out of mesh; at most {1e3 * room:.4g} mm "
                f"are allowed, {what}: give a smaller amplitude or a higher frequency"
            )

    @property
    def approach_speed(self) -> float:
        """Largest speed along the normal that the vibration alone makes, m/s."""
        point = self.point(self.drive.effective_radius)
        share = {
            "axial": point.normal_z,
            "torsional": point.normal_z * point.lead / self.reference_radius,
            "wheel-axial": point.normal_z * point.lead / point.radius,
            "screw": 0.0,
        }
        return share[self.mode] * self.velocity

    @property
    def step(self) -> float:
        """Longest step, s."""
        _, shape = self.vibrated
        cycle = 1.0 / shape.frequency
        if self.solve.step is not None:
            return self.solve.step
        return min(LARGEST_STEP, cycle / max(STEPS_A_CYCLE, shape.least_steps))

    def _check_step(self) -> None:
        given, (_, shape) = self.solve.step, self.vibrated
        if given is None:
            return
        longest = 1.0 / (max(STEPS_A_CYCLE, shape.least_steps) * shape.frequency)
        if given > longest:
            raise InputError(
                f"solve.step is {given:g} s, too coarse for a vibration of {shape.frequency:g} Hz; "
                f"it may be at most {longest:.3g} s"
            )
