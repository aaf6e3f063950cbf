"""What the roots of a loaded wheel's teeth bear."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, NamedTuple, Self

import numpy as np

from asperity.arrays import FloatArray, IntArray
from asperity.drive.driven import OfDrive
from asperity.drive.problem import DriveProblem
from asperity.drive.root_stress.loads import Load
from asperity.drive.root_stress.model import RootModel, Roots
from asperity.drive.static.notes import read_with_care
from asperity.drive.warmed import warmth
from asperity.results import quantity
from asperity.results.table import Table
from asperity.results.words import Number

_MEGA, _MILLI, _PERCENT = 1e-6, 1e3, 100.0
_PHASE, _FILLET = ("phase",), ("row", "column")
_NEAR = 0.1  # of a tooth's force beside the fillet, above which it is told
_CLOSE = 0.05  # of the stress, above which the mesh is told to be too coarse


class Largest(NamedTuple):
    """The largest stresses of some loads."""

    tension: float  #: Largest principal stress at the loaded side's fillet, Pa
    load: int  #: Under which load
    node: int  #: At which node of that fillet
    compression: float  #: Least principal stress at the other side's, Pa
    equivalent: float  #: Largest by von Mises at either, Pa
    shear: float  #: Largest shear stress at the loaded side's, Pa
    jump: float  #: What elements differ by where the tension is largest, Pa

    @classmethod
    def of(cls, found: Roots) -> Self:
        """Return those of stresses."""
        loaded, other = found.principal(0), found.principal(1)
        load, node = np.unravel_index(np.argmax(loaded[..., 2]), loaded.shape[:2])
        both = np.concatenate([loaded, other], axis=1)
        first, second, third = np.moveaxis(both, -1, 0)
        squares = (first - second) ** 2 + (second - third) ** 2 + (third - first) ** 2
        return cls(
            float(loaded[load, node, 2]),
            int(load),
            int(node),
            float(other[..., 0].min()),
            float(np.sqrt(0.5 * squares.max())),
            float(0.5 * (loaded[..., 2] - loaded[..., 0]).max()),
            float(found.jump[0][load, node]),
        )


class RootStress(OfDrive):
    """Stresses at the fillets of a wheel's teeth over a pitch."""

    title: ClassVar[str] = "Roots of a loaded worm wheel"
    stem: ClassVar[str] = "roots"
    drawings: ClassVar[Mapping[str, str]] = {
        "roots": "asperity.drive.root_stress.plots:over_pitch",
        "roots_fillet": "asperity.drive.root_stress.plots:fillet",
    }
    captions: ClassVar[Mapping[str, str]] = {
        "roots": "The largest stresses at both fillets over a pitch of the worm.",
        "roots_fillet": "The largest tension of a pitch over the loaded side's fillet.",
    }
    reported: ClassVar[bool] = True

    output_torque: float = quantity("T_R", "N m", "torque of the wheel", key="output_torque_Nm")
    tension: float = quantity(
        "sigma_1", "MPa", "largest tension at the loaded side's fillet", key="tension_MPa"
    )
    tension_radius: float = quantity("r", "mm", "there: distance from the wheel's axis")
    tension_face: float = quantity("z", "mm", "there: place over the face, 0 in its middle")
    tension_force: float = quantity("N", "N", "there: normal force on the tooth")
    tension_foot: float = quantity("", "", "there: part of it on the lowest fifth of the flank")
    tension_jump: float = quantity(
        "", "MPa", "there: what hexahedra that meet differ by", key="tension_jump_MPa"
    )
    mesh_change: float = quantity("", "", "the same of a coarser mesh, over it, less 1")
    compression: float = quantity(
        "sigma_3", "MPa", "largest compression at the other side's fillet", key="compression_MPa"
    )
    equivalent: float = quantity(
        "sigma_v", "MPa", "largest stress by von Mises at either", key="equivalent_MPa"
    )
    shear: float = quantity(
        "tau", "MPa", "largest shear stress at the loaded side's fillet", key="shear_MPa"
    )
    nominal_shear: float | None = quantity(
        "tau_F", "MPa", "nominal shear stress at the root by ISO/TR 14521",
        key="nominal_shear_MPa", default=None,
    )  # fmt: skip
    nominal_safety: float | None = quantity(
        "S_F", "", "root safety by ISO/TR 14521, of that stress", default=None
    )
    residual: float = quantity("", "", "largest residual of the bodies", shown=False)
    nodes: int = quantity("", "", "nodes of the mesh", shown=False)
    teeth: int = quantity("", "", "teeth of the mesh", shown=False)

    worm_angle: FloatArray = quantity(
        "beta", "rad", "angle of the worm", dims=_PHASE, coordinate=True, variable="phase"
    )
    tension_course: FloatArray = quantity(
        "sigma_1", "Pa", "largest tension at the loaded sides' fillets", dims=_PHASE
    )
    compression_course: FloatArray = quantity(
        "sigma_3", "Pa", "largest compression at the other sides' fillets", dims=_PHASE
    )
    tooth_course: IntArray = quantity(
        "", "", "number of the tooth with the largest tension", dims=_PHASE
    )
    fillet_tension: FloatArray = quantity(
        "sigma_1", "Pa", "largest tension of a pitch at the loaded side's fillet", dims=_FILLET
    )
    fillet_way: FloatArray = quantity(
        "", "m", "way along the fillet and the root from the foot of the flank", dims=_FILLET
    )
    fillet_radius: FloatArray = quantity("r", "m", "distance from the wheel's axis", dims=_FILLET)
    fillet_face: FloatArray = quantity("z", "m", "place along the wheel's axis", dims=_FILLET)

    @classmethod
    def of(
        cls,
        problem: DriveProblem,
        model: RootModel,
        found: Roots,
        loads: Sequence[Load],
        worst: Largest,
        mesh_change: float,
        worm_angle: FloatArray,
        nominal_shear: float | None,
        nominal_safety: float | None,
    ) -> Self:
        """Return it of the stresses under all loads of a pitch."""
        fillet = model.fillets[0]
        tension, compression = found.principal(0)[..., 2], found.principal(1)[..., 0]
        phases = np.array([load.phase for load in loads])
        most = [np.flatnonzero(phases == n) for n in range(len(worm_angle))]
        least = [compression[rows].min() for rows in most]
        rows_max = [rows[int(np.argmax(tension[rows].max(axis=1)))] for rows in most]
        places = fillet.places[fillet.grid]
        steps = np.linalg.norm(np.diff(places[..., :2], axis=0), axis=2)
        way = np.concatenate([np.zeros((1, steps.shape[1])), np.cumsum(steps, axis=0)])
        there, load = fillet.places[worst.node], loads[worst.load]
        hand = problem.gearset.hand_sign
        return cls(
            problem=problem,
            output_torque=problem.load,
            tension=_MEGA * worst.tension,
            tension_radius=_MILLI * float(np.hypot(there[0], there[1])),
            tension_face=hand * _MILLI * float(there[2]),
            tension_force=load.normal,
            tension_foot=load.foot,
            tension_jump=_MEGA * worst.jump,
            mesh_change=mesh_change,
            compression=_MEGA * worst.compression,
            equivalent=_MEGA * worst.equivalent,
            shear=_MEGA * worst.shear,
            nominal_shear=None if nominal_shear is None else _MEGA * nominal_shear,
            nominal_safety=nominal_safety,
            residual=found.residual,
            nodes=len(model.mesh.points),
            worm_angle=worm_angle,
            tension_course=np.array([tension[row].max() for row in rows_max]),
            compression_course=np.array(least),
            tooth_course=np.array([loads[row].tooth for row in rows_max]),
            fillet_tension=tension.max(axis=0)[fillet.grid],
            fillet_way=way,
            fillet_radius=np.hypot(places[..., 0], places[..., 1]),
            fillet_face=hand * places[..., 2],
            teeth=model.teeth,
            notes=(
                *_notes(model.teeth, load.foot, mesh_change),
                *warmth(problem),
            ),
        )

    def heading(self) -> str:
        """Return what was solved."""
        rim = "that its web moves" if self.problem.wheel_body else "that is held at its inside"
        return (
            f"{len(self.worm_angle)} phases; {self.nodes} nodes, teeth: {self.teeth}, a rim {rim}"
        )

    def headline(self) -> tuple[str, ...]:
        """Return the largest stress, and the standard's own."""
        own = (
            f"; ISO/TR 14521: tau_F {self.nominal_shear:.4g} MPa, S_F {self.nominal_safety:.3g}"
            if self.nominal_shear is not None and self.nominal_safety is not None
            else ""
        )
        return (
            f"the fillet of the loaded side bears up to {self.tension:.4g} MPa of tension, "
            f"{self.tension_face:.2g} mm from the middle of the face{own}",
            *read_with_care(self.problem),
        )

    @property
    def rows(self) -> list[dict[str, float | int]]:
        """One mapping a phase."""
        courses = self.worm_angle, self.tooth_course, self.tension_course, self.compression_course
        return [
            {
                "worm_angle_rad": float(angle),
                "tooth": int(tooth),
                "tension_MPa": _MEGA * float(tension),
                "compression_MPa": _MEGA * float(compression),
            }
            for angle, tooth, tension, compression in zip(*courses, strict=True)
        ]

    def to_json(self) -> dict[str, Any]:
        """Return every number, and those of each phase."""
        return super().to_json() | {"phases": self.rows}

    def tables(self) -> tuple[Table, ...]:
        """Return the numbers, and a row a phase."""
        rows = [
            (
                Number.of(row["worm_angle_rad"], ".4g", f"phases.{n}.worm_angle_rad"),
                str(row["tooth"]),
                Number.of(row["tension_MPa"], ".1f", f"phases.{n}.tension_MPa"),
                Number.of(row["compression_MPa"], ".1f", f"phases.{n}.compression_MPa"),
            )
            for n, row in enumerate(self.rows)
        ]
        course = Table.of(
            ("worm (rad)", "tooth", "tension (MPa)", "compression (MPa)"), rows, left=0
        )
        return (*super().tables(), course)


def _notes(teeth: int, foot: float, change: float) -> tuple[str, ...]:
    """What a reader should know of the numbers."""
    notes = [
        "stresses of the elastic body at its fillets, which yielding would spread; tau_F is a mean "
        "over the root's section, and its limit is made for it: they have no safety in common",
    ]
    if teeth == 1:
        notes.append(
            "one tooth alone, whose root ends in the air: beside others it bears about twice as "
            "much; drive.teeth=3 or more has them"
        )
    if foot > _NEAR:
        notes.append(
            f"{_PERCENT * foot:.2g} % of the tooth's force is on the lowest fifth of its flank, "
            "beside the fillet: the stress there follows how that is spread, by up to a tenth; "
            "modification.tip_relief of the worm moves it outwards"
        )
    if abs(change) > _CLOSE:
        way = "more" if change > 0.0 else "less"
        notes.append(
            f"a coarser mesh has {_PERCENT * abs(change):.2g} % {way}: the stress is known no "
            "better than that"
        )
    return tuple(notes)
