"""National Instruments' TDMS, by npTDMS, which is imported when such a file is read."""

import logging
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from asperity.errors import InputError, MissingExtraError, plain
from asperity.tribometer.importing.columns import Columns, unit_in
from asperity.tribometer.importing.dates import Moment, begun_by_stamp
from asperity.tribometer.importing.heads import Declaration

_INTERVAL, _UNIT, _START = "wf_increment", "unit_string", "wf_start_time"


def read_tdms(path: Path, name: str, declaration: Declaration = Declaration()) -> Columns:  # noqa: B008
    """Read the channels of all groups.

    Raises
    ------
    MissingExtraError
        npTDMS is not installed.
    InputError
        No interval, several that differ, or a damaged file.
    """
    try:
        from nptdms import TdmsFile
    except ImportError:
        raise MissingExtraError(
            "TDMS needs npTDMS; install it: pip install asperity[daq]"
        ) from None
    # What it tells the terminal of a file beside its errors is no line for a person.
    logging.getLogger("nptdms.reader").setLevel(logging.ERROR)
    try:
        file = TdmsFile.read(path)
        channels = [channel for group in file.groups() for channel in group.channels()]
        values = [np.asarray(channel[:]) for channel in channels]
        properties = [dict(channel.properties) for channel in channels]
    except Exception as error:
        raise InputError(f"{name} cannot be read: not a TDMS file, or damaged") from error
    kept = [n for n, one in enumerate(values) if one.dtype.kind in "fiu" and one.size > 1]
    steps = {properties[n].get(_INTERVAL) for n in kept}
    if steps == {None} and declaration.rate:
        steps = {1.0 / declaration.rate}
    if len(steps) != 1 or not isinstance(step := steps.pop(), int | float):
        raise InputError(
            f"{name}: its channels must share one {_INTERVAL}, the time between samples in s; "
            "where none has it, give --rate"
        )
    units = tuple(unit_in(str(properties[n].get(_UNIT, ""))) for n in kept)
    notes = () if all(units) else ("channels without a unit are taken as volts",)
    names = tuple(plain(str(channels[n].name)) for n in kept)
    return Columns(
        names,
        units,
        tuple(values[n] for n in kept),
        interval=float(step),
        notes=notes,
        program="TDMS",
        began=next((one for n in kept if (one := _began(properties[n]))), None),
    )


def _began(properties: Mapping[str, Any]) -> Moment | None:
    stamp = properties.get(_START)
    return None if stamp is None else begun_by_stamp(stamp, f"its {_START}")
