"""What shafts and bearings come to, a row each, as the screen of a rating has its safeties."""

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from asperity.shafts.shaft import ShaftFound, least
from asperity.shafts.strength.din743 import ASKED

if TYPE_CHECKING:
    from asperity.shafts.result import ShaftStudy

NAMES = {"worm_shaft": "worm", "wheel_shaft": "wheel"}
_ENDS = ("A", "B")


class ShaftRow(NamedTuple):
    """What there is of what is asked.

    Attributes
    ----------
    name : str
        Of the part.
    standard : str
        By which.
    value, asked : float
        A safety, or a life in h.
    unit : str
        ``"h"`` of a life.
    by : str
        Where and in which case.
    """

    name: str
    standard: str
    value: float
    asked: float
    unit: str
    by: str

    @property
    def holds(self) -> bool:
        """Whether it is enough."""
        return self.value >= self.asked

    def to_json(self) -> dict[str, Any]:
        """Return it by key."""
        key = "life_h" if self.unit else "safety"
        return {
            "name": self.name,
            "standard": self.standard,
            key: self.value if math.isfinite(self.value) else None,
            f"asked{'_h' if self.unit else ''}": self.asked,
            "holds": self.holds,
            "by": self.by,
        }


def rows_of(study: "ShaftStudy") -> tuple[ShaftRow, ...]:
    """Return a row for each bearing and shaft, and the worm's deflection."""
    rows: list[ShaftRow] = []
    for key, found in study.found.items():
        rows += _bearings(NAMES[key], found, study.life)
    for key, found in study.found.items():
        rows += _strength(f"{NAMES[key]} shaft", found)
    if study.deflection_limit is not None and study.worm_deflection:
        rows.append(
            ShaftRow(
                "deflection", "ISO limit", study.deflection_limit / study.worm_deflection, 1.0, "",
                f"{study.worm_deflection:.3g} of {study.deflection_limit:.3g} um as a beam",
            )
        )  # fmt: skip
    return tuple(rows)


def _bearings(name: str, found: ShaftFound, asked: float) -> Iterator[ShaftRow]:
    for end, lives in zip(_ENDS, found.lives, strict=True):
        if lives is None:
            continue
        condition, worst = min(lives.items(), key=lambda pair: pair[1].told)
        by = [condition.text]
        if len(worst.damage) > 1:
            most = max(range(len(worst.damage)), key=worst.damage.__getitem__)
            torque = found.every[0][most].load.torque
            by.append(f"{torque:g} N m does {100.0 * worst.damage[most]:.0f} % of the damage")
        if worst.a_iso is not None:
            by.append(f"a_ISO {worst.a_iso:.2g}")
        by.append(f"s0 {min(each.static_safety for each in lives.values()):.3g}")
        yield ShaftRow(f"{name} bearing {end}", "ISO 281", worst.told, asked, "h", "; ".join(by))


def _strength(name: str, found: ShaftFound) -> Iterator[ShaftRow]:
    if not found.sections:
        return
    worst = min(found.sections, key=lambda each: least(each.judged))
    kind = "fatigue" if worst.judged.fatigue_2 <= worst.judged.yielding else "yield"
    yield ShaftRow(
        name, "DIN 743", least(worst.judged), ASKED, "",
        f"{worst.detail.name}, {kind}; {worst.condition.text}",
    )  # fmt: skip
