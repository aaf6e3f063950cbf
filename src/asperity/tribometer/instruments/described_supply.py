"""An output of a supply that is described by what is said to it."""

from collections.abc import Mapping

from asperity.errors import InputError
from asperity.tribometer.instruments.lines import Line, SpokenDevice, opened_line
from asperity.tribometer.instruments.parameters import Output
from asperity.tribometer.instruments.protocols import InstrumentError, Reading
from asperity.tribometer.instruments.words import number_of

_SHARE, _STEP = 0.005, 0.02  # of what was told, and V or A of a coarse device


class DescribedSupply(SpokenDevice):
    """An output of a supply.

    Parameters
    ----------
    words : Output
        What is said to it.
    name : str
        What messages call it.
    line : Line
        To the device; its outputs share it.
    """

    def __init__(self, words: Output, name: str, line: Line) -> None:
        super().__init__(name, words, line)
        self._limited = words.current_limit is None

    def identify(self) -> str:
        """Return what the device says it is, and which output this is."""
        who = self._ask("identify") if self._words.identify else self._words.instrument
        return f"{who or self.name}, output {self._words.output}"

    def set(self, voltage: float) -> None:
        """Set the voltage, V; the current's limit before it, the first time."""
        with self._line.lock:
            if not self._limited:
                limit = self._words.current_limit
                assert limit is not None
                try:
                    self._set("current_limit", limit, "A")
                except InstrumentError as error:
                    if error.kind != "refused":
                        raise
                    raise InputError(
                        f"{self._words.table}.current_limit is refused: {error}"
                    ) from (None)
                self._limited = True
            self._set("voltage", voltage, "V")

    def on(self) -> None:
        """Give power."""
        self._tell("on")

    def off(self) -> None:
        """Give none."""
        self._tell("off")

    def reading(self) -> Reading:
        """Return what it measures; None where it cannot be asked."""
        with self._line.lock:
            return Reading(self._measured("voltage"), self._measured("current"))

    def output(self) -> bool | None:
        """Return whether the device says its output is on; None where it cannot be asked."""
        if not self._words.ask_output:
            return None
        on: bool = self._read("ask_output", self._words.is_on)[0]
        return on

    def _set(self, what: str, value: float, unit: str) -> None:
        self._tell(f"set_{what}", value=value)
        self._accepted(f"{value:g} {unit}")
        if getattr(self._words, f"ask_{what}"):
            found, _ = self._read(f"ask_{what}", number_of)
            if abs(found - value) > _STEP + _SHARE * abs(value):
                raise InstrumentError(
                    f"{self.name} was told {value:g} {unit} and is set to {found:g} {unit}",
                    kind="refused",
                )

    def _measured(self, what: str) -> float | None:
        key = f"measure_{what}"
        return self._read(key, number_of)[0] if getattr(self._words, key) else None

    def _tell(self, key: str, **given: float) -> None:
        with self._line.lock:
            self._select()
            self._line.tell(self._words.filled(key, **given))

    def _ask(self, key: str) -> str:
        with self._line.lock:
            self._select()
            return super()._ask(key)

    def _select(self) -> None:
        if self._words.select:
            self._line.tell(self._words.filled("select"))


def open_described(outputs: Mapping[str, Output]) -> dict[str, DescribedSupply]:
    """Return the outputs of one device by what they feed.

    Raises
    ------
    InstrumentError
        Its line cannot be opened.
    MissingExtraError
        What opens such a line is not installed.
    """
    first = next(iter(outputs.values()))
    line = opened_line(f"the supply at {first.where}", first)
    return {
        what: DescribedSupply(words, f"supply of {what}", line) for what, words in outputs.items()
    }
