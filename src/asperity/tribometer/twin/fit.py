"""The simulated rig fitted to recordings of a real one."""

import dataclasses
import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from asperity.arrays import FloatArray
from asperity.casefile import Case
from asperity.errors import InputError, one_of
from asperity.tribometer.options import Twin
from asperity.tribometer.parameters import LONGITUDINAL
from asperity.tribometer.recording import Recording
from asperity.tribometer.reduction.result import REFUSED, SegmentResult
from asperity.tribometer.reduction.study import Reducible, reduce_recording
from asperity.tribometer.twin.chain import disc_velocity
from asperity.tribometer.twin.contact import Rotor, cycle_mean, share_at
from asperity.tribometer.twin.plant import Plant
from asperity.tribometer.twin.plants import plant_of

BOUNDS = {
    "mu": (0.01, 2.0),
    "mu_drop": (0.0, 0.95),
    "stribeck_velocity": (1e-4, 1.0),
    "motor_drag": (1e-3, 1.0),
    "gear_efficiency": (0.05, 1.0),
    "max_deflection": (1e-9, 1e-5),
}
"""Keys of ``[twin]`` that may be fitted, and between which values, in SI."""

USUAL = "mu", "mu_drop", "stribeck_velocity", "motor_drag"

# Shares that a level and a speed by an encoder are trusted to.
_TORQUE, _SPEED = 0.01, 0.04
_STUCK = 10.0
_TELLS_NOTHING = 1.0
_CYCLES = 4


@dataclasses.dataclass(frozen=True)
class Measured:
    """What a segment of a recording tells.

    Attributes
    ----------
    mode, waveform : str
        Of the vibration.
    frequency, steel_supply : float
        Hz and V.
    torques, sliding : tuple of 2 floats
        T_s in N m and v_sl in m/s, before and with vibration.
    """

    mode: str
    waveform: str
    frequency: float
    steel_supply: float
    torques: tuple[float, float]
    sliding: tuple[float, float]


@dataclasses.dataclass(frozen=True)
class TwinFit:
    """Parameters of the simulated rig as recordings have them.

    Attributes
    ----------
    values : dict of str to float
        By key of ``[twin]``, SI.
    deviations : dict of str to float or None
        Standard deviations as shares of the values; None where the recordings do not tell.
    misfit : float
        Root mean square of what is left, over what was trusted: 1 for a rig like this one.
    """

    values: dict[str, float]
    deviations: dict[str, float | None]
    misfit: float

    def applied(self, case: Case) -> Case:
        """Return a case whose simulated rig has these values.

        Parameters
        ----------
        case : Case
            The configuration of the rig.

        Returns
        -------
        Case
            Another one.
        """
        return case.replace_values({f"twin.{key}": value for key, value in self.values.items()})


def fit_twin(case: Case, recordings: Sequence[str | Path], free: Sequence[str] = USUAL) -> TwinFit:
    """Fit the simulated rig of a case to recordings.

    Parameters
    ----------
    case : Case
        The configuration, from whose values the fit begins.
    recordings : sequence of path
        They are reduced first; segments that are refused are left out.
    free : sequence of str
        Keys of `BOUNDS`.

    Returns
    -------
    TwinFit
        Values in SI, their standard deviations as shares of them, and the misfit.

    Raises
    ------
    InputError
        A key cannot be fitted, or the recordings hold fewer numbers than keys are free.
    StorageError
        A recording cannot be read.
    """
    opened = map(Recording.open, map(Path, recordings))
    segments = [
        segment
        for recording in opened
        for segment in reduce_recording(Reducible(recording, recording.case(case.known)))[1]
    ]
    return fit_states(case, [row for one in segments for row in _measured(one)], free)


def _measured(segment: SegmentResult) -> Iterator[Measured]:
    """Yield what a segment tells, if it was not refused."""
    frequency = segment.commanded or segment.frequency
    torques = segment.torque_before, segment.torque_with
    sliding = segment.sliding_velocity_before, segment.sliding_velocity_with
    numbers = [one.value for one in (*torques, *sliding) if one is not None]
    if segment.quality == REFUSED or frequency is None or len(numbers) < 4:
        return
    before, after, slow, fast = numbers
    yield Measured(
        segment.mode, segment.waveform, frequency, segment.motor_voltage, (before, after),
        (1e-3 * slow, 1e-3 * fast),
    )  # fmt: skip


def fit_states(case: Case, rows: Sequence[Measured], free: Sequence[str] = USUAL) -> TwinFit:
    """Fit the simulated rig of a case to torques and sliding velocities.

    Least squares of their relative errors over what they are trusted to, in the logarithms of the
    parameters (a share in itself); deviations follow from the curvature and the misfit.

    Raises
    ------
    InputError
        A key cannot be fitted, or there are fewer numbers than keys are free.
    """
    from scipy.optimize import least_squares

    for key in free:
        if key not in BOUNDS:
            raise InputError(f"twin.{key} cannot be fitted; {one_of(BOUNDS, key)}")
    if 4 * len(rows) < len(free) + 1:
        raise InputError(
            f"{len(rows)} segments hold too few numbers for {len(free)} parameters; give more "
            "recordings"
        )
    twin = case.require(Twin)
    scale = [1.0 if key == "mu_drop" else None for key in free]
    bounds = np.array([BOUNDS[key] for key in free]).T
    lower, upper = (
        np.array([_to(value, one) for value, one in zip(row, scale, strict=True)]) for row in bounds
    )
    begun = np.array([_to(getattr(twin, key), one) for key, one in zip(free, scale, strict=True)])

    def values(x: FloatArray) -> dict[str, float]:
        pairs = zip(free, x, scale, strict=True)
        return {key: float(at if one else math.exp(at)) for key, at, one in pairs}

    def errors(x: FloatArray) -> FloatArray:
        changed = case.replace_values({f"twin.{key}": one for key, one in values(x).items()})
        plant = plant_of(changed)
        supply = plant.pair.drives.bronze_supply
        return np.concatenate([_errors(plant, row, supply) for row in rows])

    inside = np.clip(begun, lower + 1e-6, upper - 1e-6)
    found = least_squares(errors, inside, bounds=(lower, upper), diff_step=1e-3)
    fitted = values(found.x)
    freedom = max(1, found.fun.size - len(free))
    misfit = math.sqrt(2.0 * found.cost / freedom)
    spread = _spread(found.jac) * max(misfit, 1.0)
    deviations = {
        key: None if not share < _TELLS_NOTHING else float(share)
        for key, share in zip(
            free,
            (one / (fitted[key] if linear else 1.0)
             for key, one, linear in zip(free, spread, scale, strict=True)),
            strict=True,
        )
    }  # fmt: skip
    return TwinFit(fitted, deviations, misfit)


def _to(value: float, linear: float | None) -> float:
    return float(value) if linear else math.log(value)


def _spread(jacobian: FloatArray) -> FloatArray:
    """Standard deviations of parameters; infinite along what the data do not tell."""
    _, sizes, rows = np.linalg.svd(jacobian, full_matrices=False)
    telling = sizes > 1e-6 * sizes[0]
    spread = np.sqrt(np.sum((rows[telling].T / sizes[telling]) ** 2, axis=1))
    spread[np.any(np.abs(rows[~telling]) > 1e-3, axis=0)] = math.inf
    return np.asarray(spread)


def _errors(plant: Plant, row: Measured, bronze: float) -> FloatArray:
    """Relative errors of a segment's numbers over what they are trusted to."""
    shaken = disc_velocity(plant.sonotrode, row.mode, row.waveform, row.frequency)
    surface, along = plant.surface, row.mode == LONGITUDINAL
    rotor = plant.rotor if along else Rotor()

    # Only a few velocities are asked for, and no table is needed.
    def alone(velocity: float) -> float:
        return math.copysign(surface.full * share_at(surface, abs(velocity)), velocity)

    def with_vibration(velocity: float) -> float:
        mean, _ = cycle_mean(
            surface, rotor, abs(velocity), shaken, float(along), float(not along),
            1.0 / row.frequency, _CYCLES, 400 if rotor.mass else 4 * _CYCLES, 2e-3,
        )  # fmt: skip
        return math.copysign(surface.full * mean, velocity)

    found = []
    for friction, torque, sliding in zip(
        (alone, with_vibration), row.torques, row.sliding, strict=True
    ):
        try:
            state = plant.steady(row.steel_supply, bronze, friction)
        except InputError:
            # A motor that does not turn is far from one that did.
            return np.full(4, _STUCK)
        found += [
            (state.torque / torque - 1.0) / _TORQUE, (state.sliding / sliding - 1.0) / _SPEED
        ]  # fmt: skip
    return np.array(found)
