"""What shafts and bearings come to, a row each, as the screen of a rating has its safeties."""

import math
from collections.abc import Iterator, Mapping
from typing import Any

from asperity.arrays import first_least
from asperity.rating.verdict_rows import Row
from asperity.shafts.shaft import LoadedShaft, least
from asperity.shafts.strength.din743 import ASKED

Study = Any
"""A `asperity.shafts.result.ShaftStudy`, whose module imports this one."""

NAMES = {"worm_shaft": "worm", "wheel_shaft": "wheel"}
_ENDS = ("A", "B")


def rows_of(study: Study) -> tuple[Row, ...]:
    """Return a row for each bearing and shaft, and the worm's deflection."""
    rows: list[Row] = []
    for key, found in study.found.items():
        rows += _bearings(NAMES[key], found, study.life)
    rows += _at_rest(study.found, study.application_factor)
    for key, found in study.found.items():
        rows += _strength(f"{NAMES[key]} shaft", found)
    if study.deflection_limit is not None and study.worm_deflection is not None:
        bent = study.worm_deflection
        value = study.deflection_limit / bent if bent else math.inf
        rows.append(
            Row(
                "worm as a beam", "ISO/TR", value, 1.0, "",
                f"{study.worm_deflection:.3g} um of {study.deflection_limit:.3g} um",
            )
        )  # fmt: skip
    return tuple(rows)


def _bearings(name: str, shaft: LoadedShaft, asked: float) -> Iterator[Row]:
    for end, lives in zip(_ENDS, shaft.lives, strict=True):
        if lives is None:
            continue
        condition, worst = first_least(lives.items(), lambda pair: pair[1].judged_hours)
        by = [condition.short]
        if len(worst.damage) > 1:
            most = max(range(len(worst.damage)), key=worst.damage.__getitem__)
            torque = shaft.every[0][most].load.torque
            by.append(f"{torque:g} N m {100.0 * worst.damage[most]:.0f} %")
        life = worst.judged_hours
        if any(one.end == end for one in shaft.model.misseated):
            by = ["cannot sit there", *by]
            # What cannot be mounted lives for no time.
            life = 0.0
        yield Row(f"{name} bearing {end}", "ISO 281", life, asked, "h", ", ".join(by))


def _at_rest(shafts: Mapping[str, LoadedShaft], factor: float) -> Iterator[Row]:
    """Yield the static safety of the bearing that is nearest to what is asked of it."""
    every = [
        (life.static_safety, shaft.options.at_rest(place.bearing.elements), key, end, condition)
        for key, shaft in shafts.items()
        for end, place, lives in zip(_ENDS, shaft.model.places, shaft.lives, strict=True)
        if lives is not None and place.bearing is not None
        for condition, life in lives.items()
    ]
    if not every:
        return
    value, asked, key, end, condition = first_least(every, lambda one: one[0] / one[1])
    peak, torque = shafts[key].model.table.peak, "T_2" if factor == 1.0 else "K_A T_2"
    under = "" if peak == 1.0 else f", at {peak:g} {torque}"
    by = f"{NAMES[key]} bearing {end}, {condition.short}{under}"
    yield Row("bearings at rest", "ISO 76", value, asked, "", by)


def _strength(name: str, shaft: LoadedShaft) -> Iterator[Row]:
    if not shaft.sections:
        return
    worst = first_least(shaft.sections, lambda each: least(each.judged))
    kind = "fatigue" if worst.judged.fatigue_2 <= worst.judged.yielding else "yield"
    yield Row(
        name, "DIN 743", least(worst.judged), ASKED, "",
        f"{worst.detail.name}, {kind}; {worst.condition.short}",
    )  # fmt: skip
