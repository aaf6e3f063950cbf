"""Units that gear standards calculate in, where they are not SI's."""

import math

RPM = 60.0 / (2.0 * math.pi)
"""Turns a minute in a radian a second."""

FROM_SI = {"mm": 1e3, "um": 1e6, "rpm": RPM, "MPa": 1e-6, "mm2/s": 1e6}
"""How many of each make the SI unit of its kind."""
