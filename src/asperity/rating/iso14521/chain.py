"""ISO/TR 14521's way from the geometry to the efficiency, for one gearset or a million."""

import dataclasses
from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

from asperity.errors import InputError
from asperity.gearset.materials import BaseOilName, WheelMaterial, wheel_material
from asperity.rating.formula import Argument, FloatArray, Invalid, angle, positive
from asperity.rating.iso14521 import efficiency, film, friction, losses
from asperity.rating.iso14521.tables import Edition, Flank, Lubrication, friction_constants

NOT_ALLOWED, NO_WHEEL, NO_FILM, NOT_DRIVING = 1, 2, 3, 4

LEGEND: Mapping[int, str] = MappingProxyType(
    {
        0: "there is an answer",
        NOT_ALLOWED: "a number given is not finite or not allowed",
        NO_WHEEL: "the worm's pitch diameter reaches the wheel's axis",
        NO_FILM: "h* is not above zero",
        NOT_DRIVING: "lead angle and friction angle reach 90 deg, so the worm cannot drive",
    }
)
"""Reasons why there is no answer, by code."""

# Small enough for all the arrays of one block to stay in the processor's cache.
_BLOCK = 8192
