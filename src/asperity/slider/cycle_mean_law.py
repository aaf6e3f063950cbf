r"""The cycle-mean friction law: what a body that moves slowly against the vibration feels.

Over one vibration cycle a body at the mean velocity :math:`v` feels the mean force :math:`F(v)`.
It is tabulated once from periodic states. The body's own answer to the vibration (it shakes a
little with the base) is in the table.
"""

import dataclasses
import functools
import math
from collections.abc import Callable, Iterator, Sequence
from typing import Any, overload

import numpy as np

from asperity.arrays import FloatArray
from asperity.errors import ConvergenceError, InputError
from asperity.formulas import real
from asperity.friction.lugre import stribeck_share
from asperity.results.settled import Standing
from asperity.slider.cycle_mean_normal import remarks_of, told_by
from asperity.slider.law_states import as_fine_as_asked, beside_rest, states
from asperity.slider.model import Model
from asperity.slider.parameters import in_proportion
from asperity.slider.periodic import solve_periodic
from asperity.slider.pieces import each, of_one
from asperity.slider.result import SlideResult
from asperity.slider.shooting import ACCEPTED

_POINTS_BELOW = 64
_POINTS_ABOVE = 56
_LEAST_PEAK = 1e-2  # of the drive velocity
_HIGHEST = 50.0
_LOWEST = 1e-4
_NAMED = 4
_SEE = "see solve.method 'periodic' and 'march'"

# Columns of the table.
(
    FORCE, HIGHEST_X, LOWEST_X, FORCE_Y, HIGHEST_Y, LOWEST_Y,
    POWER_IN, POWER_LOST, POWER_DAMPED, UNTRANSFERRED,
    COLUMNS,
) = range(11)  # fmt: skip
# F(-v) is -F(v) under a vibration turned by half a turn; what was highest is lowest there.
_SWAPPED = [
    FORCE, LOWEST_X, HIGHEST_X, FORCE_Y, LOWEST_Y, HIGHEST_Y,
    POWER_IN, POWER_LOST, POWER_DAMPED, UNTRANSFERRED,
]  # fmt: skip
_MIRROR = np.where(np.arange(COLUMNS) < POWER_IN, -1.0, 1.0)


def _backwards(rows: FloatArray) -> FloatArray:
    """Turn rows at some velocities into those at the opposite ones."""
    turned = rows.copy()
    turned[..., :COLUMNS] = rows[..., _SWAPPED] * _MIRROR
    return turned


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class HomogenisedLaw:
    r"""Cycle-mean friction as a function of the mean velocity.

    Call it with a velocity in m/s, scalar or array, for the force in N. In a compiled model use
    `interpolate` with `arguments`, times ``full_friction``.

    Attributes
    ----------
    velocity : ndarray, shape (n,)
        Tabulated mean velocities, m/s, increasing, both signs; the drive velocity among them.
    table : ndarray, shape (n, 10 + len(pressed))
        Mean, highest and lowest friction along the drive, the same across, over
        :math:`\mu F_N`; power of the vibration, dissipated by friction, dissipated in the drive's
        damper by what the vibration shakes, and untransferred, W; then what ``pressed`` names.
    full_friction : float
        :math:`\mu F_N`, N; approached at velocities far above the vibration's.
    residual : float
        Largest change of a state over its cycle in the table.
    viscous : float
        Viscous friction over :math:`\mu F_N`, s/m, which adds to it at high velocities.
    missing : tuple of float
        Mean velocities without a periodic state, m/s, over which is interpolated; those next to
        the drive velocity first.
    unsettled : tuple of float
        Mean velocities whose states do not stay, m/s, in the same order: a disturbance grows.
    pressed : tuple of str
        What the table has of a body that is pressed: fields of
        `asperity.slider.space.NormalMotion` and the powers of
        `asperity.results.ledger.PressedLedger`, in SI.
    remarks : tuple of str
        What a reader should know of a pressed body's state at the drive velocity.
    step_error : float or None
        Of the ratio at the drive velocity, see `asperity.slider.step_error`.
    elsewhere : str
        What else a body from rest comes to at the drive velocity; empty where it comes to the
        state of the law.
    ratio_from_rest : float or None
        Its ratio there, where that is another and settles.
    """

    velocity: FloatArray = dataclasses.field(repr=False)
    table: FloatArray = dataclasses.field(repr=False)
    full_friction: float
    residual: float
    viscous: float = 0.0
    missing: tuple[float, ...] = ()
    unsettled: tuple[float, ...] = ()
    pressed: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()
    step_error: float | None = None
    elsewhere: str = ""
    ratio_from_rest: float | None = None

    @functools.cached_property
    def arguments(self) -> tuple[FloatArray, FloatArray, float]:
        """Breakpoints, coefficients and viscous part of the mean force, for `interpolate`."""
        return *self._pieces(FORCE), self.viscous

    @functools.cached_property
    def _one(self) -> Callable[[float], float]:
        return of_one(*self.arguments)

    def _pieces(self, column: int) -> tuple[FloatArray, FloatArray]:
        cubic = self._cubic(self.table[:, column])
        return np.ascontiguousarray(cubic.x), np.ascontiguousarray(cubic.c)

    def _cubic(self, values: FloatArray) -> Any:
        from scipy.interpolate import PchipInterpolator

        with in_proportion(), np.errstate(over="raise", divide="raise"):
            return PchipInterpolator(self.velocity, values)

    @overload
    def __call__(self, velocity: float) -> float: ...
    @overload
    def __call__(self, velocity: FloatArray) -> FloatArray: ...
    def __call__(self, velocity: float | FloatArray) -> float | FloatArray:
        """Mean friction force in N at mean velocities in m/s."""
        if isinstance(velocity, float) and math.isfinite(velocity):
            return self.full_friction * self._one(float(velocity))
        values = np.atleast_1d(real("the velocity", velocity))
        if not np.all(np.isfinite(values)):
            raise InputError("the velocity is not finite; give finite velocities in m/s")
        force = self.full_friction * each(values.ravel(), *self.arguments)
        return float(force[0]) if np.ndim(velocity) == 0 else force.reshape(values.shape)

    def __repr__(self) -> str:
        """Return how much is tabulated, and what the law says at its ends and in its middle."""
        low, high, front = float(self.velocity[0]), float(self.velocity[-1]), self.velocity > 0.0
        forces = self.full_friction * self.table[front, FORCE]
        held = f", {len(self.missing)} interpolated over" if self.missing else ""
        held += f", {len(self.unsettled)} not settled" if self.unsettled else ""
        return (
            f"HomogenisedLaw({self.velocity.size} mean velocities from {low:.3g} to {high:.3g} m/s"
            f"{held}: {forces[0]:.4g} N at {self.velocity[front][0]:.3g} m/s to {forces[-1]:.4g} N "
            f"at {high:.3g} m/s, full friction {self.full_friction:.4g} N)"
        )

    def column(self, column: int, velocity: FloatArray) -> FloatArray:
        """One column of the table at some velocities; beyond its ends, that of the end."""
        breaks, c = self._pieces(column)
        inside = np.clip(velocity, breaks[0], breaks[-1])
        return each(inside, breaks, c, 0.0)

    def normal_to_the_plane(self, velocity: FloatArray) -> dict[str, FloatArray]:
        """What ``pressed`` names at some velocities; beyond the table's ends, that of the end."""
        cubic = self._cubic(self.table[:, COLUMNS:])
        found = cubic(np.clip(velocity, self.velocity[0], self.velocity[-1]))
        return dict(zip(self.pressed, found.T, strict=True))

    def standing(self, velocity: float) -> Standing:
        """Return whether the law at the drive velocity is that of a state that a body stays in."""
        if velocity in self.missing:
            return Standing(False, "no periodic state was found at the drive velocity")
        if velocity in self.unsettled:
            return Standing(False, "the periodic state at the drive velocity does not stay")
        repeat = f"the law's states repeat themselves to {ACCEPTED:g}"
        if self.elsewhere:
            return Standing(False, f"{repeat}, but {self.elsewhere}")
        return Standing(True, repeat)

    @property
    def notes(self) -> tuple[str, ...]:
        """What a reader of the law's numbers should know."""
        there = f"at the drive velocity {self.elsewhere}: {_SEE}"
        return (*self._of_missing(), *self._of_unsettled(), *((there,) if self.elsewhere else ()))

    def _of_unsettled(self) -> Iterator[str]:
        if self.unsettled:
            tried = len(self.velocity) - 1
            yield (
                f"at {len(self.unsettled)} of {tried} mean velocities the periodic state does not "
                f"stay, among them {_places(self.unsettled)}: there the law is no prediction"
            )

    def _of_missing(self) -> Iterator[str]:
        if not self.missing:
            return
        tried = len({*self.velocity, *self.missing}) - 1
        yield (
            f"no periodic state was found at {len(self.missing)} of {tried} mean "
            f"velocities, which are interpolated over: {_places(self.missing)}"
        )


def _places(velocities: Sequence[float]) -> str:
    places = ", ".join(f"{velocity:.3g}" for velocity in velocities[:_NAMED])
    more = f" and {len(velocities) - _NAMED} more" if len(velocities) > _NAMED else ""
    return f"{places} m/s{more}"


def homogenise(model: Model) -> HomogenisedLaw:
    """Tabulate the cycle-mean friction of a body with its mass, drive and vibration.

    Without vibration it is the friction of steady sliding. Single mean velocities without a
    periodic state are interpolated over.

    Parameters
    ----------
    model : Model
        The body, with its vibration.

    Returns
    -------
    HomogenisedLaw
        Mean friction force by mean velocity, both ways.

    Raises
    ------
    InputError
        The case cannot be solved for its periodic state.
    ConvergenceError
        More than a fifth of the mean velocities have no periodic state, or the drive velocity is
        not between those that have one.
    """
    if not model.vibrates:
        return _without_vibration(model)
    speeds = _grid(model)
    # A wave whose halves mirror each other does not notice half a turn, unless it lifts as well.
    along, across, up = model.unit_direction
    oblique = up != 0.0 and (along != 0.0 or across != 0.0)
    sampled = model.vibration is not None and model.vibration.waveform == "sampled"
    symmetric = not (oblique or sampled)
    tried = speeds if symmetric else np.concatenate([speeds, -speeds])
    answers, missing = states(as_fine_as_asked(model), tried)
    rows = {v: _row(model, answer) for v, answer in answers.items()}
    front = {v: row for v, row in rows.items() if v > 0.0}
    back = {v: _backwards(row) for v, row in rows.items() if v < 0.0}
    loose = [v for v, answer in answers.items() if not answer.settled]
    if symmetric:
        back = {-v: _backwards(row) for v, row in front.items()}
        missing += [-v for v in missing]
        loose += [-v for v in loose]
    drive = model.slider.drive_velocity
    if not front or not back or not drive <= max(front):
        raise ConvergenceError(
            f"slider.drive_velocity is {drive:g} m/s and no periodic state was found at or above "
            "it; solve.method 'march' shows what the body does"
        )
    _reach_to_rest(front, [v for v in missing if v > 0.0])
    _reach_to_rest(back, [v for v in missing if v < 0.0])
    found = np.array(sorted([*back, 0.0, *front]))
    rest = 0.5 * (front[min(front)] + back[max(back)])
    beside = beside_rest(answers.get(drive))
    return HomogenisedLaw(
        velocity=found,
        table=np.array([(rest if v == 0.0 else front[v] if v > 0.0 else back[v]) for v in found]),
        full_friction=model.full_friction,
        residual=max(answer.residual for answer in answers.values()),
        step_error=answers[drive].step_error if drive in answers else None,
        viscous=model.friction.viscous_damping / model.full_friction,
        missing=tuple(sorted(missing, key=lambda v: abs(v - drive))),
        unsettled=tuple(sorted(loose, key=lambda v: abs(v - drive))),
        pressed=tuple(told_by(answers[max(front)])),
        remarks=remarks_of(answers[drive]) + beside.remarks if drive in answers else (),
        elsewhere=beside.otherwise,
        ratio_from_rest=beside.ratio,
    )


def _reach_to_rest(rows: dict[float, FloatArray], missing: list[float]) -> None:
    """Continue the rows of a side to the slowest velocity, if it is among those without a state.

    Friction may jump at rest, and what the other side has is then no neighbour.
    """
    slowest = min(missing, key=abs, default=math.inf)
    if len(rows) < 2 or abs(slowest) > min(map(abs, rows)):
        return
    near, far = sorted(rows, key=abs)[:2]
    row = rows[near] + (slowest - near) / (far - near) * (rows[far] - rows[near])
    # Losses and loads do not change their sign on the way.
    row[POWER_LOST:] = np.where(rows[near] >= 0.0, np.maximum(row, 0.0), row)[POWER_LOST:]
    rows[slowest] = row


def _grid(model: Model) -> FloatArray:
    drive = model.slider.drive_velocity
    # Of next to no vibration, the law near rest is of no drive that it is asked for.
    peak = max(model.peak_velocity, _LEAST_PEAK * drive)
    # Rigid friction goes as asin(v/v_a): even spacing in the angle follows its steep end.
    below = peak * np.sin(0.5 * math.pi * np.arange(1, _POINTS_BELOW + 1) / _POINTS_BELOW)
    highest = max(_HIGHEST * peak, 4.0 * drive, 4.0 * model.friction.stribeck_velocity)
    above = np.geomspace(peak, highest, _POINTS_ABOVE + 1)[1:]
    # Near rest Coulomb's force is proportional to the velocity, and a cycle takes many steps.
    first = [] if model.friction.model == "coulomb" else [_LOWEST * peak]
    return _with_drive(np.concatenate([first, below, above]), drive)


def _with_drive(speeds: FloatArray, drive: float) -> FloatArray:
    # A steady march ends at the drive velocity, where the table is then exact.
    speeds[np.argmin(np.abs(speeds - drive))] = drive
    return speeds


def _row(model: Model, answer: SlideResult) -> FloatArray:
    force = model.full_friction
    if (ledger := answer.ledger) is None:
        raise ConvergenceError("a periodic state came without its ledger")
    row = np.empty(COLUMNS)
    row[[FORCE, FORCE_Y]] = answer.ratio, answer.friction_mean[1] / force
    row[[HIGHEST_X, HIGHEST_Y]] = np.array(answer.friction_max) / force
    row[[LOWEST_X, LOWEST_Y]] = np.array(answer.friction_min) / force
    row[[POWER_IN, POWER_LOST]] = ledger.vibration, ledger.friction
    # The drive of a periodic state goes at the body's mean velocity: its damper takes the shaking
    # alone. What a slow motion against the drive loses there comes on top.
    row[[POWER_DAMPED, UNTRANSFERRED]] = ledger.damping, ledger.untransferred
    return np.append(row, list(told_by(answer).values()))


def _without_vibration(model: Model) -> HomogenisedLaw:
    friction, drive = model.friction, model.slider.drive_velocity
    force = model.full_friction
    scales = [v for v in (drive, friction.stribeck_velocity) if v > 0.0]
    ends, points = (_LOWEST * min(scales), _HIGHEST * max(scales)), _POINTS_BELOW + _POINTS_ABOVE
    speeds = _with_drive(np.geomspace(*ends, points), drive)
    ratio = (friction.static_mu or friction.mu) / friction.mu
    viscous = friction.viscous_damping / force
    share = np.array([stribeck_share(v, ratio, friction.stribeck_velocity) for v in speeds])
    share += viscous * speeds
    front = np.zeros((points, COLUMNS))
    front[:, [FORCE, HIGHEST_X, LOWEST_X]] = share[:, None]
    front[:, POWER_LOST] = share * force * speeds
    rest = np.zeros(COLUMNS)
    told: dict[str, float] = {}
    if model.normal is not None:
        # What lies still normal to the plane does so at any speed; the feet wear by theirs.
        told = told_by(solve_periodic(model, history=False))
        rest = np.append(rest, list((told | {"wear_integral": 0.0}).values()))
        worn = np.multiply.outer(speeds / drive, np.array(list(told.values())) - rest[COLUMNS:])
        front = np.hstack([front, rest[COLUMNS:] + worn])
    return HomogenisedLaw(
        velocity=np.concatenate([-speeds[::-1], [0.0], speeds]),
        table=np.concatenate([_backwards(front[::-1]), rest[None], front]),
        full_friction=force,
        residual=0.0,
        step_error=0.0,
        viscous=viscous,
        pressed=tuple(told),
    )
