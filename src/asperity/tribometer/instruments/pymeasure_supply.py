"""Bench supplies through PyMeasure's drivers."""

import importlib
import warnings
from collections.abc import Callable
from typing import Any

from asperity.errors import InputError, MissingExtraError
from asperity.tribometer.instruments.parameters import Supplies
from asperity.tribometer.instruments.protocols import InstrumentError, Reading

_DRIVERS = "pymeasure.instruments"


class PyMeasureSupply:
    """An output of a supply that PyMeasure has a driver for.

    The driver's names are those most of them share: ``voltage_setpoint`` and ``voltage`` (or
    ``voltage`` alone), ``current``, ``current_limit``, and ``output_enabled`` or
    ``enable_output()``.

    Parameters
    ----------
    output : object
        Driver, or channel of one.
    name : str
        What messages call it.
    current_limit : float, optional
        A.
    """

    by_hand = False

    def __init__(self, output: Any, name: str, current_limit: float | None = None) -> None:
        self.name = name
        self._output = output
        for names in (("voltage_setpoint", "voltage"), ("output_enabled", "enable_output")):
            if not any(hasattr(type(output), one) for one in names):
                raise InputError(
                    f"{name}: the driver {type(output).__name__} has neither {' nor '.join(names)};"
                    " choose another"
                )
        if current_limit is not None and hasattr(type(output), "current_limit"):
            self._done(lambda: setattr(output, "current_limit", current_limit))

    def identify(self) -> str:
        """Return the driver's name for it."""
        return f"{self.name} ({type(self._output).__name__})"

    def set(self, voltage: float) -> None:
        """Set the voltage, V."""
        two = hasattr(type(self._output), "voltage_setpoint")
        key = "voltage_setpoint" if two else "voltage"
        self._done(lambda: setattr(self._output, key, voltage))

    def on(self) -> None:
        """Give power."""
        self._switch(True)

    def off(self) -> None:
        """Give none."""
        self._switch(False)

    def safe(self) -> None:
        """Give none."""
        self.off()

    def reading(self) -> Reading:
        """Return what it gives."""
        return Reading(
            self._done(lambda: float(self._output.voltage)),
            self._done(lambda: float(self._output.current)),
        )

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

    def close(self) -> None:
        """Let go of it; the line is that of the driver."""

    def _switch(self, on: bool) -> None:
        if hasattr(type(self._output), "output_enabled"):
            self._done(lambda: setattr(self._output, "output_enabled", on))
        else:
            self._done(lambda: self._output.enable_output(on))

    def _done(self, act: Callable[[], Any]) -> Any:
        try:
            return act()
        except Exception as error:
            # A driver raises what the line, the library below it or its own reading of an answer
            # raise; whatever it is, the supply did not do what it was told.
            raise InstrumentError(
                f"{self.name} did not do as it was told: {type(error).__name__}: {error}",
                kind="half an answer" if isinstance(error, ValueError) else "line lost",
            ) from error


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
    for what in ("steel", "bronze", "amplifier"):
        key = getattr(table, what)
        if not key:
            continue
        output = device if key == "." else getattr(device, key, None)
        if output is None:
            raise InputError(f"supplies.{what} is {key!r}; {table.driver} has no such output")
        limit = None if what == "amplifier" else table.current_limit
        found[what] = PyMeasureSupply(output, f"supply of {what}", limit)
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
            return driver(table.address)
    except Exception as error:
        raise InstrumentError(
            f"the supply at {table.address} does not answer: {error}", kind="line lost"
        ) from error
