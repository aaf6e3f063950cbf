"""Quantities that the tables of a rig share."""

from typing import Annotated

from pydantic import Field

from asperity.units import Quantity

Length = Annotated[float, Quantity("m", "a length", "60 mm", gt=0)]
Mass = Annotated[float, Quantity("kg", "a mass", "9.0718 kg", ge=0)]
Force = Annotated[float, Quantity("N", "a force", "141.6 N", gt=0)]
Voltage = Annotated[float, Quantity("V", "a voltage", "1 V", ge=0)]
AnyVoltage = Annotated[float, Quantity("V", "a voltage", "-20 V")]
Current = Annotated[float, Quantity("A", "a current", "2 A", ge=0)]
Torque = Annotated[float, Quantity("N m", "a torque", "0.1 N m", ge=0)]
Frequency = Annotated[float, Quantity("Hz", "a frequency", "750 Hz", gt=0)]
Speed = Annotated[float, Quantity("rad/s", "a speed", "30 rpm", ge=0)]
Velocity = Annotated[float, Quantity("m/s", "a velocity", "59 mm/s", ge=0)]
Duration = Annotated[float, Quantity("s", "a time", "10 s", ge=0)]
Span = Annotated[float, Quantity("s", "a time", "20 ms", gt=0)]
Ratio = Annotated[float, Quantity("", "a ratio", "30", gt=0, le=1e6)]
Share = Annotated[float, Quantity("", "a share", "0.1", ge=0, le=1)]
Tolerance = Annotated[float, Quantity("", "a share", "0.1", ge=0, lt=1)]
Temperature = Annotated[float, Quantity("K", "a temperature", "20 degC", gt=0)]
Modulus = Annotated[float, Quantity("Pa", "a modulus", "210 GPa", gt=0)]
Count = Annotated[int, Field(strict=True, ge=1, le=100_000)]
