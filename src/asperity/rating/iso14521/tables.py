"""Words and tables of ISO/TR 14521: what a formula may be asked for, and its constants."""

import dataclasses
import functools
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal, get_args

from asperity.errors import InputError, one_of
from asperity.files import store
from asperity.gearset.materials import BaseOilName, Family
from asperity.sources import Source

Edition = Literal["1998", "2010"]
Flank = Literal["ZA", "ZI", "ZN", "ZK", "ZC"]
Lubrication = Literal["bath", "spray"]

EDITIONS: Mapping[str, str] = MappingProxyType(
    {"1998": "DIN 3996:1998", "2010": "ISO/TR 14521:2010, DIN 3996:2012"}
)
"""Documents of each family of formulas."""


@dataclasses.dataclass(frozen=True)
class FrictionConstants:
    r"""Constants of the base coefficient of friction.

    :math:`\mu_{0T} = \min(a_0 + b_0/(v_{gm} + c_0)^n, \text{cap})` with ``offset`` :math:`a_0`,
    ``gain`` :math:`b_0`, ``shift`` :math:`c_0` in m/s and ``exponent`` :math:`n`.
    """

    offset: float
    gain: float
    shift: float
    exponent: float
    cap: float
    source: Source


@dataclasses.dataclass(frozen=True)
class WearConstants:
    r"""Constants of the reference wear intensity, :math:`J_{0T} = \min(A K_W^{-n}, \text{cap})`."""

    scale: float
    exponent: float
    cap: float
    source: Source


@functools.cache
def _tables() -> dict[str, Any]:
    return store.read_toml(Path(__file__).parents[1] / "data" / "iso14521.toml")


def _row(table: str, family: str, lubrication: str, base_oil: str) -> dict[str, Any]:
    for option, word, allowed in (
        ("family", family, get_args(Family)),
        ("lubrication", lubrication, get_args(Lubrication)),
        ("base_oil", base_oil, get_args(BaseOilName)),
    ):
        if word not in allowed:
            raise InputError(f"{option} is {word!r}; {one_of(allowed, word)}")
    content = _tables()[table]
    (row,) = (
        row
        for row in content["rows"]
        if family in row["family"]
        and row.get("lubrication", lubrication) == lubrication
        and row["base_oil"] == base_oil
    )
    numbers = {key: value for key, value in row.items() if isinstance(value, float)}
    return {**numbers, "source": Source(content["source"], content["confidence"])}


@functools.cache
def friction_constants(
    family: Family, lubrication: Lubrication, base_oil: BaseOilName
) -> FrictionConstants:
    """Return the `FrictionConstants` of a wheel's material under a lubricant.

    Raises
    ------
    InputError
        Unknown word.
    """
    return FrictionConstants(**_row("mu_0T", family, lubrication, base_oil))


@functools.cache
def wear_constants(
    family: Family, lubrication: Lubrication, base_oil: BaseOilName
) -> WearConstants:
    """Return the `WearConstants` of a wheel's material under a lubricant.

    Raises
    ------
    InputError
        Unknown word.
    """
    return WearConstants(**{"cap": float("inf"), **_row("J_0T", family, lubrication, base_oil)})
