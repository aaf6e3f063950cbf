"""What a loaded gearset comes to in few numbers, for studies that ask for it many times over."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any, Self

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.problem import DriveProblem
from asperity.drive.resolved.strip import FACE_END, FLANK, WHEEL_TIP, WORM_TIP
from asperity.drive.static.recorder import PhaseRecord
from asperity.drive.static.solve import StaticModel
from asperity.drive.static.spread import LOADED, k_h_alpha, shares
from asperity.drive.static.sweep import LoadCase
from asperity.runs import Run


@dataclasses.dataclass(frozen=True, eq=False)
class Loaded:
    """Numbers of a pitch under load, in SI, and where the flank bears."""

    pressure_flank: float  #: Largest resolved pressure on the flank, Pa
    pressure_worm_tip: float  #: At the worm's tip edge, Pa
    pressure_wheel_tip: float  #: At the wheel's tip edge, Pa
    pressure_face_end: float  #: At the ends of the face, Pa
    pressure_mean: float  #: Normal force over the area that bears, Pa
    force_worm_tip: float  #: Largest force there, N
    force_wheel_tip: float  #: N
    force_face_end: float  #: N
    normal_force: float  #: Of all teeth, mean, N
    flow_depth: float  #: Pressed in at the pressure of plastic flow, m
    transmission_error: float  #: Under load, peak to peak, rad
    deflection: float  #: Mean over the pitch, rad
    input_torque: float  #: Of the worm, mean, N m
    load_share: float  #: Largest of a tooth
    loaded_teeth: float  #: Mean
    k_h_beta: float
    k_h_alpha: float
    line_load: float  #: N/m
    centre_face: float  #: Of the forces, from mid-face, m
    centre_radial: float  #: From the mean circle outwards, m
    pattern: FloatArray  #: (n,): Largest pressure over the pitch at the points of the flank, Pa

    @property
    def edge_force(self) -> float:
        """Largest force on any edge, N."""
        return max(self.force_worm_tip, self.force_wheel_tip, self.force_face_end)

    def to_tree(self) -> dict[str, Any]:
        """Return it as a tree of arrays."""
        return {name: np.asarray(value) for name, value in vars(self).items()}

    @classmethod
    def from_tree(cls, tree: Mapping[str, Any]) -> Self:
        """Return it of such a tree."""
        pattern = np.asarray(tree["pattern"])
        return cls(**{k: float(v) for k, v in tree.items() if k != "pattern"}, pattern=pattern)


def loaded(problem: DriveProblem, run: Run) -> Loaded:
    """Return what a gearset comes to under its load, the worm driving, over a pitch.

    Raises
    ------
    InputError
        There is no such wheel or mesh, or the teeth cannot carry the torque.
    ConvergenceError
        No balance was found.
    """
    return loaded_of(StaticModel(problem, run))


def loaded_of(model: StaticModel) -> Loaded:
    """Return the same of a model that stands already."""
    seen = PhaseRecord(model.resolved)
    (pitch_sweep,) = model.sweeps([LoadCase(model.problem.load, evaluate=seen.evaluate)])
    peaks, forces = np.max(seen.peaks, axis=0), np.max(seen.forces, axis=0)
    share = shares(seen.tooth_force)
    face, radial = seen.spread.centre
    return Loaded(
        pressure_flank=float(peaks[FLANK]),
        pressure_worm_tip=float(peaks[WORM_TIP]),
        pressure_wheel_tip=float(peaks[WHEEL_TIP]),
        pressure_face_end=float(peaks[FACE_END]),
        pressure_mean=float(seen.mean),
        force_worm_tip=float(forces[WORM_TIP]),
        force_wheel_tip=float(forces[WHEEL_TIP]),
        force_face_end=float(forces[FACE_END]),
        normal_force=float(seen.tooth_force.sum(axis=1).mean()),
        flow_depth=max(seen.depths),
        transmission_error=float(np.ptp(pitch_sweep.error)),
        deflection=pitch_sweep.mean_deflection,
        input_torque=float(pitch_sweep.worm_torque.mean()),
        load_share=float(share.max()),
        loaded_teeth=float((share > LOADED).sum(axis=1).mean()),
        k_h_beta=seen.spread.k_h_beta,
        k_h_alpha=k_h_alpha(seen.tooth_force),
        line_load=seen.spread.line_load,
        centre_face=face,
        centre_radial=radial,
        pattern=seen.pattern.largest,
    )
