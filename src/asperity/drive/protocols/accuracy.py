r"""The error that a march's step makes: its last cycles marched once more in steps twice as long.

From where the last block began, the same cycles are marched again with all bounds of the step
doubled. The scheme's error falls with the step at least as fast as the step does, so that what the
two differ by is no less than what the first is off by. Compared are means over the same cycles from
the same state: how the worm's torque stands to the wheel's then tells the ratio's error, while the
wheel is still where it was. A motion that never repeats parts from any other in a few cycles,
however short the steps: what it is then told to be off by is its own.
"""

import dataclasses
import math

from asperity.drive.protocols.march import March, Records, mean

WANTED = 1e-3
"""Of the ratio: what a step that is not given is chosen to stay below."""

_OF_POWERS = 2.5e-3  # of the largest power: the same of each of them
# Of all cycles, the share that is marched again at most: it adds an eighth to the time.
_SHARE = 4
_COARSER = 2.0
# What a shorter step aims at, the shortest, and what is to be left of the error after each.
_AIM, _FINEST, _GAINS = 0.7, 1.0 / 32.0, 0.75
# Of the wheel's speed, and what a motion parts by after it, of what a step may make wrong.
_NUDGE, _PARTED = 1e-8, 0.1
# Of what a step was told to make wrong, what a shorter one may change at most.
_EXPECTED = 3.0
_POWERS = ("drive", "actuator", "friction", "contact_damping", "shaft_damping")


@dataclasses.dataclass(frozen=True)
class StepError:
    """What the step makes wrong.

    Attributes
    ----------
    ratio : float
        Of what is told, over it.
    powers : float
        Of the powers, over the largest of them.
    advantage : float
        Of the worm's torque by the mesh over the wheel's, over that.
    actuator : float
        Of the actuator's power, W.
    elsewhere : float or None
        What is told of another state, to which it came in longer steps, over what is told of this.
    """

    ratio: float
    powers: float
    advantage: float = math.inf
    actuator: float = math.inf
    elsewhere: float | None = None

    @property
    def off(self) -> float:
        """The larger of both, over what a chosen step may make wrong."""
        return max(self.ratio / WANTED, self.powers / _OF_POWERS)

    def finer(self, fineness: float, before: float) -> float | None:
        """Return the factor of a step that is short enough; None where it is, or none would be.

        Parameters
        ----------
        fineness : float
            Of the step, over the one that the march began with.
        before : float
            What `off` was before the step was made so short; infinite where it never was longer.
        """
        if self.off <= 1.0 or fineness <= _FINEST or self.off > _GAINS * before:
            return None
        return max(_FINEST / fineness, min(0.5, _AIM / self.off))


def step_error(march: March, measure: str, scale: float, power: float) -> StepError | None:
    """Return what the step makes wrong; None where too few cycles were marched to spare one.

    Parameters
    ----------
    march : March
        At its end; it is left as it is.
    measure, scale : str, float
        What is told, by the name of its sum, and what it is told over.
    power : float
        Of the motor without vibration, W.
    """
    marked = march.marked.row
    last = march.rows[marked:]
    count = min(march.rows.size // _SHARE, last.size)
    if not count:
        return None
    return _apart(last[:count], march.again(_COARSER, count), measure, scale, power)


def beside(off: StepError, march: March, measure: str, spread: float) -> StepError:
    """Return what the step makes wrong, or by how much a march in longer steps came elsewhere.

    Two marches from the same start may come to two states that last, whose steps are both short
    enough; no error of either tells of that.

    Parameters
    ----------
    off : StepError
        At the end of a march that was begun anew in shorter steps.
    march : March
        That march.
    measure : str
        As of `step_error`.
    spread : float
        Of the blocks that it is judged by.
    """
    if not math.isfinite(march.told):
        return off
    other = march.told / measure_of(march, measure)
    if abs(other - 1.0) <= _EXPECTED * WANTED * march.off + 2.0 * spread:
        return off
    return dataclasses.replace(off, ratio=max(off.ratio, abs(other - 1.0)), elsewhere=other)


def measure_of(march: March, measure: str) -> float:
    """Return what is told of a march by its last blocks; NaN of a wheel that should stand."""
    return math.nan if measure == "rolled" else _reading(march.rows[march.marked.row :], measure)


def sensitive(march: March, measure: str, scale: float, power: float) -> bool:
    """Return whether a motion parts from its like by itself; parameters as of `step_error`."""
    marked = march.marked.row
    one = march.rows[marked:]
    return _apart(one, march.again(1.0, one.size, _NUDGE), measure, scale, power).off > _PARTED


def _apart(
    one: Records, other: Records | None, measure: str, scale: float, power: float
) -> StepError:
    """What the same cycles differ by."""
    if other is None or not mean(other, "wheel_torque") > 0.0 < mean(one, "wheel_torque"):
        # It left the finite numbers, or its flanks each other.
        return StepError(math.inf, math.inf)
    if measure == "rolled":
        before = mean(one, measure)
        ratio = (mean(other, measure) - before) / max(scale, abs(before))
    else:
        ratio = _reading(other, measure) / _reading(one, measure) - 1.0
    most = max(*(abs(float(one[name].sum())) for name in _POWERS), power * one["time"].sum())
    powers = max(abs(float(other[name].sum() - one[name].sum())) for name in _POWERS)
    found = StepError(abs(ratio), float(powers / most))
    if measure != "torque":
        return found
    return dataclasses.replace(
        found,
        advantage=abs(advantage(other) / advantage(one) - 1.0),
        actuator=abs(mean(other, "actuator") - mean(one, "actuator")),
    )


def advantage(rows: Records) -> float:
    """Return what the mesh takes of the worm over what it gives the wheel."""
    return -mean(rows, "worm_torque") / mean(rows, "wheel_torque")


def _reading(rows: Records, measure: str) -> float:
    """What is told of rows; of the worm's torque what it is over the wheel's."""
    found = mean(rows, measure)
    return found / mean(rows, "wheel_torque") if measure == "torque" else found
