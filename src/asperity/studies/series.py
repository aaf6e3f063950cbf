"""All gearsets of the standard series for a ratio, with what is held of them as it is given."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

import numpy as np

from asperity.errors import InputError
from asperity.gearset.hob_shelf import Blank
from asperity.gearset.sizing import possible_starts
from asperity.studies.requirements import RATIO_OFF

DISTANCES = (25, 31.5, 40, 50, 63, 80, 100, 125, 140, 160, 180, 200, 225, 250, 280, 315, 355, 400,
             450, 500)  # fmt: skip
"""Centre distances, mm: R10 of ISO 3, and R20 from 125, as catalogues have them."""

MODULES = (1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8, 10, 12.5, 16, 20)
"""Axial modules, mm: R10 of ISO 3, as DIN 780-2 has them (one source)."""

MOST_SHIFT = 0.5
"""Greatest profile shift of the wheel to either side, where none is held."""

FACTORS = (6.0, 20.0)
"""Least and greatest diameter factor; between them every half one is tried."""

_SAME = 1e-9

Row = tuple[float, ...]
"""Starts, teeth, centre distance and module in mm, diameter factor and profile shift."""


def grid(
    gear_ratio: float,
    held: Mapping[str, float],
    *,
    exact: bool,
    off: float = RATIO_OFF,
    hobs: Sequence[Blank] | None = None,
) -> list[Row]:
    """Return all gearsets of the series.

    Parameters
    ----------
    gear_ratio : float
        Of the speeds.
    held : mapping of str to float
        What is not proposed but given, by its key of a gearset, in mm: ``starts``,
        ``wheel_teeth``, ``centre_distance``, ``axial_module``, ``diameter_factor``,
        ``worm_pitch_diameter``, ``profile_shift``. A profile shift that is held is met by the
        diameter factor, or where that is held by the centre distance, or the module.
    exact : bool
        Whether the teeth must give the ratio as nearly as they can.
    off : float
        By how much they may miss it.
    hobs : sequence of Blank, optional
        What the wheel may be cut with; left out: a hob of any series' module and diameter factor.

    Raises
    ------
    InputError
        Nothing has the ratio with what is held.
    """
    rows = (row for row in _all(gear_ratio, held, exact, off, hobs) if _keeps(row, held))
    # A centre distance or module that follows comes from many of the series.
    found = list(dict.fromkeys(rows))
    if not found:
        given = ", ".join(f"gearset.{key} {value:.6g}" for key, value in held.items())
        held_too = f", with {given} (lengths in mm), which --set holds" if held else ""
        cut = "" if hobs is None else ", cut with the hobs that requirements.hobs names"
        raise InputError(
            f"ratio is {gear_ratio:g}, which no gearset of the series has within "
            f"{100 * off:g} %{held_too}{cut}; choose another"
            f"{', or hold less' if held else ''}"
        )
    return found


def _all(
    gear_ratio: float, held: Mapping[str, float], exact: bool, off: float,
    hobs: Sequence[Blank] | None,
) -> Iterator[Row]:  # fmt: skip
    for distance in _of(held, "centre_distance", DISTANCES):
        for starts, teeth in _teeth(distance, gear_ratio, held, exact, off):
            for module, factor in _threads(distance, starts, teeth, held, hobs):
                yield from _with_shift(starts, teeth, distance, module, factor, held)


def _threads(
    distance: float, starts: int, teeth: int, held: Mapping[str, float],
    hobs: Sequence[Blank] | None,
) -> Iterator[tuple[float, float]]:  # fmt: skip
    """Yield the modules and diameter factors that are tried."""
    if hobs is not None:
        yield from (
            (hob.module, hob.factor)
            for hob in hobs
            if hob.starts in (None, starts) and _keeps_thread(hob, held)
        )
        return
    for module in _of(held, "axial_module", MODULES):
        for factor in _factors(distance, teeth, module, held):
            yield module, factor


def _keeps_thread(hob: Blank, held: Mapping[str, float]) -> bool:
    own = {
        "axial_module": hob.module,
        "diameter_factor": hob.factor,
        "worm_pitch_diameter": hob.module * hob.factor,
    }
    return all(math.isclose(held.get(key, value), value) for key, value in own.items())


def _of(held: Mapping[str, float], key: str, series: Iterable[float]) -> Iterable[float]:
    return (held[key],) if key in held else series


def _teeth(
    distance: float, gear_ratio: float, held: Mapping[str, float], exact: bool, off: float
) -> Iterator[tuple[int, int]]:
    if "starts" in held:
        possible: tuple[int, ...] = (int(held["starts"]),)
    elif "wheel_teeth" in held:
        near = held["wheel_teeth"] / gear_ratio
        possible = tuple(n for n in (math.floor(near), math.ceil(near)) if n >= 1)
    else:
        possible = possible_starts(distance, gear_ratio)
    for starts in dict.fromkeys(possible):
        near = round(starts * gear_ratio)
        # Where little else is free, each that the ratio leaves is tried.
        most = math.floor(off * starts * gear_ratio) + 1 if off > RATIO_OFF else 1
        whole = (near,) if exact else range(near - most, near + most + 1)
        for teeth in _of(held, "wheel_teeth", whole):
            if abs(teeth / starts / gear_ratio - 1.0) <= off:
                yield starts, int(teeth)


def _factors(
    distance: float, teeth: float, module: float, held: Mapping[str, float]
) -> Iterable[float]:
    if "diameter_factor" in held:
        return (held["diameter_factor"],)
    if "worm_pitch_diameter" in held:
        return (held["worm_pitch_diameter"] / module,)
    if "profile_shift" in held:
        factor = 2.0 * (distance / module - held["profile_shift"]) - teeth
        return (factor,) if FACTORS[0] <= factor <= FACTORS[1] else ()
    tried: list[float] = np.arange(FACTORS[0], FACTORS[1] + 0.25, 0.5).tolist()
    return tried


def _with_shift(
    starts: float, teeth: float, distance: float, module: float, factor: float,
    held: Mapping[str, float],
) -> Iterator[Row]:  # fmt: skip
    if "profile_shift" in held:
        whole = factor + teeth + 2.0 * held["profile_shift"]
        if "centre_distance" not in held:
            distance = float(f"{0.5 * module * whole:.12g}")
        elif "axial_module" not in held:
            module = float(f"{2.0 * distance / whole:.12g}")
    yield starts, teeth, distance, module, factor, distance / module - 0.5 * (factor + teeth)


def _keeps(row: Row, held: Mapping[str, float]) -> bool:
    wanted = held.get("profile_shift")
    if wanted is None:
        return abs(row[5]) <= MOST_SHIFT
    return abs(row[5] - wanted) <= _SAME * max(1.0, row[2] / row[3])
