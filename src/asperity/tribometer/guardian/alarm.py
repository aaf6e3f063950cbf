"""What is done where something was not read back to be off: power is cut, and a person is told."""

from collections.abc import Callable, Sequence

from asperity.tribometer.guardian.relay import Relay
from asperity.tribometer.instruments.off import Off


class Alarm:
    """A relay that cuts the power, and a person at the terminal.

    Parameters
    ----------
    say : callable
        Tells the person; must not wait.
    relay : Relay, optional
        Cuts the power.

    Attributes
    ----------
    cut : str
        That it was told to; empty where it was not. No relay answers that it has.
    """

    def __init__(self, say: Callable[[str], None], relay: Relay | None) -> None:
        self._say = say
        self._relay = relay
        self.cut = ""

    def pulse(self) -> None:
        """Show a watchdog that somebody is there."""
        if self._relay is not None:
            self._relay.pulse()

    def name(self, named: Sequence[Off], *, cut: bool = True, on: str = "") -> None:
        """Name what was not read back to be off, at once without power; ``on``: what goes on."""
        if not named:
            return
        if self._relay is not None and cut:
            self.cut = f"{self._relay.name} was told to cut the power of what was on"
            try:
                self._relay.open()
            except Exception as error:
                self.cut = f"{self._relay.name} could not be told to cut the power: {error}"
                self._say(self.cut)
        names = "; ".join(map(str, named))
        self._say(f"NOT READ BACK TO BE OFF: {names}. SWITCH IT OFF BY HAND.{on}")

    def close(self) -> None:
        """Cut the power, in the end."""
        if self._relay is not None:
            self._relay.close()
