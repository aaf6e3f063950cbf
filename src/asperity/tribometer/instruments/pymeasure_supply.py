"""Bench supplies through PyMeasure's drivers."""

import contextlib
import importlib
import inspect
import warnings
from collections.abc import Callable
from typing import Any

from asperity.errors import InputError, MissingExtraError
from asperity.tribometer.instruments.parameters import Supplies
from asperity.tribometer.instruments.protocols import InstrumentError, Reading, Supply, one_line

_DRIVERS = "pymeasure.instruments"


_LIMITS = "current_limit", "current_setpoint"
_MEASURED = "measured_{}", "measure_{}", "{}_measured", "output_{}"


class PyMeasureSupply(Supply):
    """An output of a supply that PyMeasure has a driver for.

    Drivers name things differently: what sets the voltage is ``voltage_setpoint`` or ``voltage``,
    what is measured ``measured_voltage`` or, where it cannot be set, ``voltage``; the limit is
    ``current_limit``, ``current_setpoint`` or a ``current`` that can be set; the switch is
    ``output_enabled`` or ``enable_output()``. A value that was set is never taken for a measured
    one.

    Parameters
    ----------
    output : object
        Driver, or channel of one.
    name : str
        What messages call it.
    current_limit : float, optional
        A; left out, what the supply is set to stands.
    """

    def __init__(self, output: Any, name: str, current_limit: float | None = None) -> None:
        self.name = name
        self._output = output
        self._limit = current_limit
        for names in (("voltage_setpoint", "voltage"), ("output_enabled", "enable_output")):
            if not any(hasattr(type(output), one) for one in names):
                raise InputError(
                    f"{name}: the driver {type(output).__name__} has neither {' nor '.join(names)};"
                    " choose another"
                )
        self._measures = {what: self._measured_by(what) for what in ("voltage", "current")}

    def _measured_by(self, what: str) -> str:
        """Return the name of what is measured; empty where there is none."""
        driver = type(self._output)
        named = next((key for n in _MEASURED if hasattr(driver, key := n.format(what))), "")
        if named or not hasattr(driver, what):
            return named
        return "" if _settable(driver, what) else what

    def identify(self) -> str:
        """Return what the device says it is, or the driver's name for it."""
        told = ""
        # Not every device knows the question; one that is lost is found out by what is told it.
        with contextlib.suppress(Exception):
            told = " ".join(str(getattr(self._output, "parent", self._output).id).split())
        return f"{told or self.name} ({type(self._output).__name__})"

    def set(self, voltage: float) -> None:
        """Set the voltage, V; the current's limit before it, the first time."""
        if self._limit is not None:
            self._send_limit(self._limit)
            self._limit = None
        two = hasattr(type(self._output), "voltage_setpoint")
        key = "voltage_setpoint" if two else "voltage"
        self._done(lambda: setattr(self._output, key, voltage))

    def _send_limit(self, limit: float) -> None:
        driver = type(self._output)
        names = [one for one in _LIMITS if hasattr(driver, one)]
        if not names and _settable(driver, "current"):
            names = ["current"]
        refused = f"supplies.current_limit is {limit:g} A"
        if not names:
            raise InputError(
                f"{refused}; {driver.__name__} has nothing that sends it: leave it out and set it "
                "by hand, or describe the supply by its lines"
            )
        try:
            setattr(self._output, names[0], limit)
            told = getattr(self._output, names[0])
        except ValueError as error:
            raise InputError(f"{refused}; {driver.__name__} refuses it: {one_line(error)}") from (
                None
            )
        except Exception as error:
            raise self._failed(error) from error
        # A driver may cut what is too large to what it takes, without a word.
        if not isinstance(told, int | float) or abs(told - limit) > 0.02 + 0.005 * limit:
            raise InputError(f"{refused}; {driver.__name__} is set to {told} A")

    def on(self) -> None:
        """Give power."""
        self._switch(True)

    def off(self) -> None:
        """Give none."""
        self._switch(False)

    def reading(self) -> Reading:
        """Return what it measures; None where the driver only tells what was set."""
        return Reading(self._measured("voltage"), self._measured("current"))

    def _measured(self, what: str) -> float | None:
        key = self._measures[what]
        if not key:
            return None
        value: float = self._done(lambda: float(getattr(self._output, key)))
        return value

    def output(self) -> bool | None:
        """Return whether the device says its output is on; None where the driver cannot ask."""
        if not hasattr(type(self._output), "output_enabled"):
            return None

        def asked() -> bool | None:
            try:
                return bool(self._output.output_enabled)
            except LookupError:  # of a property that can only be set
                return None

        on: bool | None = self._done(asked)
        return on

    def _switch(self, on: bool) -> None:
        if hasattr(type(self._output), "output_enabled"):
            self._done(lambda: setattr(self._output, "output_enabled", on))
        else:
            self._done(lambda: self._output.enable_output(on))

    def _done(self, act: Callable[[], Any]) -> Any:
        try:
            return act()
        except Exception as error:
            raise self._failed(error) from error

    def _failed(self, error: Exception) -> InstrumentError:
        # A driver raises what the line, the library below it or its own reading of an answer
        # raise; whatever it is, the supply did not do what it was told.
        return InstrumentError(
            f"{self.name} did not do as it was told: {type(error).__name__}: {one_line(error)}",
            kind="half an answer" if isinstance(error, ValueError) else "line lost",
        )


def _settable(driver: type, key: str) -> bool:
    """Whether a property of a driver can be set: of PyMeasure's, whether it has such a command."""
    held = inspect.getattr_static(driver, key, None)
    setter = getattr(held, "fset", None)
    if setter is None:
        return False
    command = inspect.signature(setter).parameters.get("set_command")
    return command is None or command.default is not None


def open_supplies(table: Supplies) -> dict[str, PyMeasureSupply]:
    """Return the outputs of a supply by what they feed: ``steel``, ``bronze``, ``amplifier``.

    Raises
    ------
    MissingExtraError
        PyMeasure is not installed.
    InputError
        It has no such driver, or the driver no such output.
    InstrumentError
        Nothing answers at the address.
    """
    device = _device(table)
    found = {}
    for what, words in table.outputs.items():
        key = words.output
        output = device if key == "." else getattr(device, key, None)
        if output is None:
            raise InputError(f"supplies.{what} is {key!r}; {table.driver} has no such output")
        found[what] = PyMeasureSupply(output, f"supply of {what}", words.current_limit)
    return found


def _device(table: Supplies) -> Any:
    try:
        importlib.import_module(_DRIVERS)
    except ImportError:
        raise MissingExtraError("a supply needs PyMeasure; install asperity[daq]") from None
    module, _, name = table.driver.rpartition(".")
    try:
        # The name comes from a file; only what stands below the drivers is imported.
        driver = getattr(importlib.import_module(f"{_DRIVERS}.{module}".rstrip(".")), name)
    except (ImportError, AttributeError, ValueError):
        raise InputError(
            f"supplies.driver is {table.driver!r}; it must be a module and class below "
            f"{_DRIVERS}, such as 'aimtti.aimttiPL.PL303QMDP'"
        ) from None
    try:
        with warnings.catch_warnings():
            # Drivers ask to tell their authors about devices they have not seen.
            warnings.simplefilter("ignore", FutureWarning)
            device = driver(table.address)
    except Exception as error:
        raise InstrumentError(
            f"the supply at {table.address} does not answer: {error}", kind="line lost"
        ) from error
    # A device that is silent costs five seconds else.
    connection: Any = getattr(getattr(device, "adapter", None), "connection", None)
    if hasattr(connection, "timeout"):
        connection.timeout = 1e3 * table.timeout
    return device
