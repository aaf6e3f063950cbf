"""The power ledger of a time integration, and what becomes of one that does not close."""

from collections.abc import Mapping
from typing import ClassVar

from asperity.errors import ConvergenceError
from asperity.results.quantity import Quantities, quantity

NOTED = 1e-3
REFUSED = 1e-2
_ROUNDING = 1e-9


class Ledger(Quantities):
    """Mean powers over a window: what is put in is lost, given away or stored.

    A class derived from it says which of its quantities are put in and which are not.
    """

    measure: ClassVar[str] = "what is put in"  #: What the residual is a share of.

    @property
    def _inputs(self) -> tuple[float, ...]:
        raise NotImplementedError

    @property
    def _outputs(self) -> tuple[float, ...]:
        raise NotImplementedError

    @property
    def residual(self) -> float:
        """What is missing from the balance, over the sum of what is put in."""
        put_in = sum(power for power in self._inputs if power > 0.0)
        return abs(self._missing) / (put_in or max(map(abs, self._outputs)) or 1.0)

    @property
    def _missing(self) -> float:
        return sum((*self._inputs, *(-power for power in self._outputs)))

    @property
    def closes(self) -> bool:
        """Whether what is missing is no more than rounding, however little is put in."""
        powers = self._inputs + self._outputs
        return abs(self._missing) <= _ROUNDING * max(map(abs, powers))


class PowerLedger(Ledger):
    """Mean powers over the window, W: drive + vibration = friction + damping + stored.

    Attributes
    ----------
    drive : float
        The drive force times v_d.
    vibration : float
        What the actuator puts in: friction on the transferred velocity of the vibration.
    friction : float
        Dissipated in the contact (elastic energy of the asperities not counted).
    damping : float
        Dissipated in the drive's damper.
    stored : float
        Rate of change of kinetic energy and of the energy in drive spring and asperities.
    untransferred : float
        What friction would do on the share 1 - eta_y of the lateral vibration that does not
        reach the contact. It does no work in this model and stands outside the balance.
    """

    drive: float = quantity("P_d", "W", "power of the drive")
    vibration: float = quantity("P_v", "W", "power of the vibration")
    friction: float = quantity("P_f", "W", "power lost to friction")
    damping: float = quantity("P_h", "W", "power lost to damping")
    stored: float = quantity("P_s", "W", "rate of change of stored energy")
    untransferred: float = quantity("P_u", "W", "friction on the untransferred vibration")

    measure: ClassVar[str] = "the drive's"

    @property
    def _inputs(self) -> tuple[float, ...]:
        return self.drive, self.vibration

    @property
    def _outputs(self) -> tuple[float, ...]:
        return self.friction, self.damping, self.stored

    @property
    def residual(self) -> float:
        """What is missing from the balance, over the drive power.

        Where the drive does less than a thousandth of friction's work, over that much.
        """
        scale = max(abs(self.drive), 1e-3 * abs(self.friction)) or 1.0
        return abs(self._missing) / scale


class PressedLedger(PowerLedger):
    """Mean powers of a body that is pressed: normal to the plane there are two more.

    Attributes
    ----------
    normal : float
        What the actuator puts in normal to the plane: the normal force on the base's rise.
    contact_damping : float
        Dissipated in the contact's damping.
    """

    normal: float = quantity("P_n", "W", "power of the vibration normal to the plane")
    contact_damping: float = quantity("P_c", "W", "power lost in the contact's damping")

    measure: ClassVar[str] = "what is put in"

    @property
    def _inputs(self) -> tuple[float, ...]:
        return *super()._inputs, self.normal

    @property
    def _outputs(self) -> tuple[float, ...]:
        return *super()._outputs, self.contact_damping

    @property
    def residual(self) -> float:
        """What is missing from the balance, over the sum of what is put in."""
        return super(PowerLedger, self).residual


def guard(
    ledger: Ledger,
    advice: str,
    *,
    reached: Mapping[str, float] | None = None,
    most: float = REFUSED,
) -> tuple[str, ...]:
    """Refuse an answer whose powers do not balance, and note one whose nearly do not.

    Parameters
    ----------
    ledger : Ledger
        The powers of the answer.
    advice : str
        What a user can do about it, as `asperity.results.settled.smaller_step` says it.
    reached : mapping of str to float, optional
        What else was reached, for the exception; the residual is added as ``power_residual``.

    most : float
        The residual above which there is no answer; infinite where a note alone will do.

    Returns
    -------
    tuple of str
        A note where the residual is above `NOTED`, else nothing.

    Raises
    ------
    ConvergenceError
        The residual is above ``most``.
    """
    residual = ledger.residual
    if ledger.closes:
        return ()
    if not residual <= most:
        raise ConvergenceError(
            f"the powers do not balance: {residual:.2g} of {ledger.measure} is missing, "
            f"at most {most:g} may be: {advice}",
            reached={**(reached or {}), "power_residual": residual},
        )
    if residual > NOTED:
        return (f"the powers balance only to {residual:.2g} of {ledger.measure}: {advice}",)
    return ()
