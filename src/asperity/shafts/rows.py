"""What shafts and bearings come to, a row each, as the screen of a rating has its safeties."""

from collections.abc import Iterator
from typing import Any

from asperity.arrays import first_least
from asperity.rating.rows import Row
from asperity.shafts.shaft import ShaftFound, least
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
    for key, found in study.found.items():
        rows += _strength(f"{NAMES[key]} shaft", found)
    if study.deflection_limit is not None and study.worm_deflection:
        rows.append(
            Row(
                "worm as a beam", "ISO/TR", study.deflection_limit / study.worm_deflection, 1.0, "",
                f"{study.worm_deflection:.3g} of {study.deflection_limit:.3g} um",
            )
        )  # fmt: skip
    return tuple(rows)


def _bearings(name: str, found: ShaftFound, asked: float) -> Iterator[Row]:
    for end, lives in zip(_ENDS, found.lives, strict=True):
        if lives is None:
            continue
        condition, worst = first_least(lives.items(), lambda pair: pair[1].told)
        by = [condition.short]
        if len(worst.damage) > 1:
            most = max(range(len(worst.damage)), key=worst.damage.__getitem__)
            torque = found.every[0][most].load.torque
            by.append(f"{torque:g} N m {100.0 * worst.damage[most]:.0f} %")
        if worst.a_iso is not None:
            by.append(f"a_ISO {worst.a_iso:.2g}")
        by.append(f"s0 {min(each.static_safety for each in lives.values()):.2g}")
        yield Row(f"{name} bearing {end}", "ISO 281", worst.told, asked, "h", ", ".join(by))


def _strength(name: str, found: ShaftFound) -> Iterator[Row]:
    if not found.sections:
        return
    worst = first_least(found.sections, lambda each: least(each.judged))
    kind = "fatigue" if worst.judged.fatigue_2 <= worst.judged.yielding else "yield"
    yield Row(
        name, "DIN 743", least(worst.judged), ASKED, "",
        f"{worst.detail.name}, {kind}; {worst.condition.short}",
    )  # fmt: skip
