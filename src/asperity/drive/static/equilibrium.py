r"""Worm, wheel and shaft in balance under a torque, at one angle of the worm.

Unknown are the wheel's angle and how far the worm gives way: its turn and the three shifts of the
point of contact, in the coordinates of `asperity.drive.shafts`. A few Newton steps with the slope
of the contact solve for both.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from asperity.arrays import FloatArray
from asperity.drive.shafts import COORDINATES
from asperity.drive.teeth.contact import Action, FullError, TeethContact
from asperity.errors import ConvergenceError

_STEPS = 40
_CLOSE = 1e-7
# Of the torque: a change this small tells of the slope, and not of its change.
_SMALL = 0.05
# By so much what is known of the slope may change at once.
_CHANGED = 0.7, 1.4
# Agreement of teeth that give way to each other: of what is missing, and its bounds.
_AGREED, _LEAST, _MOST = 1e-2, 1e-8, 1e-4
# Of a change of the wheel's angle in a step, as a part of the deflection so far.
_FURTHEST = 0.7
# So often a step may lead to where more of the teeth touches than could be.
_FULL = 4
# Of the axial module: beyond it elastic flanks mean nothing.
_DEEPEST = 0.1


class TooDeepError(ConvergenceError):
    """The torque presses the worm further into the teeth than elastic ones could give.

    Parameters
    ----------
    message : str
        What is too much.
    full : bool
        Whether more of the flanks would bear than the contact has room for, rather than that worm
        and teeth overlap too deeply.
    """

    def __init__(self, message: str, *, full: bool, deflection: float) -> None:
        super().__init__(message, reached={"deflection_rad": deflection})
        self.full = full


@dataclasses.dataclass(frozen=True, eq=False)
class Balance:
    """The drive in balance at one angle of the worm."""

    worm_angle: float  #: Of the motor's end of the shaft, rad
    wheel_angle: float  #: rad
    worm_torque: float  #: Needed on the worm, N m
    yielded: FloatArray  #: (4,): How far the worm gave way, rad, m, m, m
    turns: FloatArray  #: (4,): Turn of the wheel that makes up for a unit of the worm's yielding
    action: Action  #: Of the worm on the wheel
    contact: TeethContact  #: Holds the fields of this balance until it solves another
    residual: float  #: Of torque and of the worm's place, relative

    @property
    def shift(self) -> FloatArray:
        """Of the worm along the axes of its own frame, (3,), m."""
        return shift_of(self.yielded)


class Equilibrium:
    """Finds the balance of a drive.

    Parameters
    ----------
    contact : TeethContact
        Worm against teeth.
    compliance : ndarray, shape (4, 4), optional
        Of the worm at the point of contact, as `asperity.drive.shafts.compliances`; rigid if left
        out.
    """

    def __init__(self, contact: TeethContact, compliance: FloatArray | None = None) -> None:
        self.contact = contact
        self.compliance = np.zeros((4, 4)) if compliance is None else compliance
        self._twists = _twists(contact, np.zeros(4))
        module = contact.sector.wheel.pair.geometry.axial_module
        self._deepest = _DEEPEST * 1e-3 * module
        self._arm = float(contact.sector.body.places[:, 1].max())
        self._last: dict[int, tuple[float, FloatArray]] = {}
        # Change of the torque over what the slope says, which leaves out that teeth give way to
        # each other.
        self._softer = 1.0

    def on_worm(self, wrench: FloatArray) -> FloatArray:
        """Return what wrenches (..., 6) on the wheel are on the worm, (..., 4), N m and N.

        Its turn is about its axis as it stands without load.
        """
        return -wrench @ self._twists.T

    def balance(
        self, beta: float, torque: float, *, sense: int = 1, touching: float | None = None
    ) -> Balance:
        """Return the balance at an angle of the worm.

        Parameters
        ----------
        beta : float
            Of the motor's end of the shaft, rad.
        torque : float
            Of the load on the wheel, N m, above 0: it holds back a wheel that the worm's flank
            pushes forwards, and of flank -1 one that it pushes backwards.
        sense : int
            1: the drive runs forwards, -1: backwards, 0: without friction.
        touching : float, optional
            The wheel's angle without load, rad, if it is known.

        Raises
        ------
        TooDeepError
            The torque is beyond what elastic teeth carry.
        ConvergenceError
            No balance was found.
        """
        contact, side = self.contact, self.contact.side
        free = contact.touching_angle(beta, np.zeros(3)) if touching is None else touching
        behind, yielded = self._guess(torque, sense)
        size = float(np.abs(self.compliance).max()) or 1.0
        residual = np.inf
        before, promised = np.nan, np.nan
        full = 0
        for _ in range(_STEPS):
            phi = free - side * behind
            if self._too_deep(beta, phi, yielded):
                raise TooDeepError(
                    "the load presses the worm further into the teeth than they can give",
                    full=False, deflection=behind,
                )  # fmt: skip
            # Far from the balance teeth need not agree well with each other.
            tolerance = min(max(_AGREED * residual, _LEAST), _MOST)
            try:
                action = contact.act(
                    beta + yielded[0], phi, shift_of(yielded), sense=sense, tolerance=tolerance
                )
            except FullError:
                full += 1
                if full > _FULL:
                    raise TooDeepError(
                        "more of the teeth bears than could be", full=True, deflection=behind
                    ) from None
                behind, yielded = 0.5 * behind, 0.5 * yielded
                before = promised = np.nan
                continue
            except np.linalg.LinAlgError:
                break
            # The worm turns about its axis where that has gone.
            twists = _twists(contact, yielded)
            on_worm, pushed = -twists @ action.wrench, side * float(action.wrench[5])
            if _LEAST * torque < abs(promised) < _SMALL * torque:
                self._softer *= float(np.clip((pushed - before) / promised, *_CHANGED))
            missing = np.concatenate([[pushed - torque], yielded - self.compliance @ on_worm])
            residual = max(
                abs(missing[0]) / torque,
                float(np.abs(missing[1:]).max()) / (size * (1.0 + float(np.abs(on_worm).max()))),
            )
            if residual <= _CLOSE:
                # The wheel's turn by which the worm's yielding is made up for.
                turns = twists @ action.slope[5] / action.slope[5, 5]
                by_worm = -side * float(turns @ yielded)
                self._last[sense] = torque, np.array([behind - by_worm, by_worm, *yielded])
                return Balance(
                    beta, phi, -float(on_worm[0]), yielded, turns, action, contact,
                    residual,
                )  # fmt: skip
            slope = self._slope(action, twists)
            try:
                move = self._move(slope, missing, behind, yielded, pushed)
            except np.linalg.LinAlgError:
                break
            bound = _FURTHEST * max(abs(behind), 1e-6)
            share = min(1.0, bound / max(abs(move[0]), 1e-300))
            before, promised = pushed, share * float(slope[0] @ move)
            behind -= share * move[0]
            yielded = yielded + share * move[1:]
        raise ConvergenceError(
            f"worm and wheel found no balance at {np.degrees(beta):.4g} deg of the worm",
            reached={"residual": residual},
        )

    @staticmethod
    def _move(
        slope: FloatArray,
        missing: FloatArray,
        behind: float,
        yielded: FloatArray,
        pushed: float,
    ) -> FloatArray:
        """Return Newton's step; out of touch, without a slope, the worm comes back and nearer."""
        if pushed > 0.0:
            return np.asarray(np.linalg.solve(slope, -missing))
        return np.concatenate([[-0.5 * max(behind, 1e-5)], -0.5 * yielded])

    def _guess(self, torque: float, sense: int) -> tuple[float, FloatArray]:
        last = self._last.get(sense) or next(iter(self._last.values()), None)
        if last is not None:
            old, values = last
            share = torque / old
            teeth, worm = values[:2]
            return float(teeth * share ** (2.0 / 3.0) + worm * share), share * values[2:]
        sector = self.contact.sector
        arm = float(sector.body.places[:, 1].min())
        return 2.0 * sector.mean_compliance * torque / arm**2, np.zeros(4)

    def _too_deep(self, beta: float, phi: float, yielded: FloatArray) -> bool:
        """Whether undeformed worm and teeth overlap too much."""
        if self._deepest > self._arm * abs(beta / self.contact.stand.ratio - phi):
            return False
        shift = shift_of(yielded)
        return self.contact.least_gap(beta + float(yielded[0]), phi, shift) < -self._deepest

    def _slope(self, action: Action, twists: FloatArray) -> FloatArray:
        """Derivative of what is missing by the wheel's angle and the worm's yielding."""
        slope = self._softer * action.slope
        matrix = np.zeros((5, 5))
        matrix[0, 0] = -slope[5, 5]
        side = self.contact.side
        matrix[0, 1:] = side * slope[5] @ twists.T
        # On the worm the forces are opposite; the wheel's turn is the worm's about Z, turned round.
        on_worm = -twists @ slope
        matrix[1:, 0] = side * self.compliance @ on_worm[:, 5]
        matrix[1:, 1:] = np.eye(4) - self.compliance @ on_worm @ twists.T
        return matrix


def shift_of(yielded: FloatArray) -> FloatArray:
    """Return the worm's shift along the axes of its own frame where it gave way, m."""
    _, axial, tangential, radial = yielded
    return np.array([radial, tangential, -axial])


def _twists(contact: TeethContact, yielded: FloatArray) -> FloatArray:
    """Motions of a yielded worm as shift and turn about the wheel's centre, (4, 6)."""
    (radial, tangential, axis) = contact.stand.axes
    origin = contact.stand.origin + shift_of(yielded) @ contact.stand.axes
    none = np.zeros(3)
    found = {
        "turn": np.concatenate([np.cross(origin, axis), axis]),
        "axial": np.concatenate([-axis, none]),
        "tangential": np.concatenate([tangential, none]),
        "radial": np.concatenate([radial, none]),
    }
    return np.array([found[name] for name in COORDINATES])
