"""The tables `[worm_shaft]` and `[wheel_shaft]` of a case file."""

import itertools
import math
from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, TypeVar

from pydantic import Field, ValidationInfo, model_validator

from asperity.casefile import Table
from asperity.errors import InputError, shown
from asperity.gearset.library import resolve
from asperity.shafts.bearing import RollingBearing
from asperity.shafts.elements import Element
from asperity.shafts.steel import ShaftSteel
from asperity.units import Quantity

_Length = Annotated[float, Quantity("m", what="a length", example="40 mm", gt=1e-6, le=100)]
_Place = Annotated[float, Quantity("m", what="a position", example="20 mm", ge=0, le=100)]
_Factor = Annotated[float, Quantity("", what="a factor", example="2.0", ge=1, le=20)]


class ShaftSection(Table):
    """A part of a shaft of one diameter.

    Parameters
    ----------
    length : float or str
        Along the axis, m.
    diameter : float or str, optional
        Outside, m. Left out: the worm's threads, whose root bears and which bend as 1.1 of it.
    fillet : float or str, optional
        Radius at its end, where the next section begins, m.
    notch : {'none', 'keyway', 'press fit', 'groove'}
        What weakens it over its length.
    groove_depth, groove_radius : float or str, optional
        Of a round groove, m.
    roughness : float or str
        Mean peak-to-valley height Rz, m.
    """

    table: ClassVar[str] = "section"

    length: _Length
    diameter: _Length | None = None
    fillet: _Length | None = None
    notch: Literal["none", "keyway", "press fit", "groove"] = "none"
    groove_depth: _Length | None = None
    groove_radius: _Length | None = None
    roughness: Annotated[
        float, Quantity("m", what="a roughness", example="6.3 um", gt=0, le=1e-3)
    ] = 6.3e-6

    @model_validator(mode="after")
    def _consistent(self) -> "ShaftSection":
        given = (self.groove_depth is not None, self.groove_radius is not None)
        if (self.notch == "groove") != all(given) or any(given) != all(given):
            raise InputError(
                "section.groove_depth and section.groove_radius belong to notch 'groove', which "
                "needs both"
            )
        diameter = self.diameter or math.inf
        if self.groove_depth is not None and 2.0 * self.groove_depth >= diameter:
            raise InputError(
                f"section.groove_depth is {1e3 * self.groove_depth:g} mm; it must be below half "
                f"the diameter, {1e3 * diameter:g} mm"
            )
        if self.notch != "none" and self.diameter is None:
            raise InputError(f"section.notch is '{self.notch}'; the worm's threads have none: "
                             "leave it out, or give the diameter")  # fmt: skip
        return self


class ShaftBearing(Table):
    """A bearing of a shaft.

    Parameters
    ----------
    at : float or str
        Position of its middle, or of its pressure centre, from the end, m.
    bearing : str or table, optional
        A name of a data file, or a table with the keys of
        `asperity.shafts.bearing.RollingBearing`. Left out: loads alone.
    arrangement : str
        'single'; 'pair back-to-back', 'pair face-to-face' or 'pair tandem', two side by side whose
        ratings are those of one; 'adjusted back-to-back' or 'adjusted face-to-face', one that is
        adjusted against that at the other place.
    carries : {'radial', 'both', 'towards end', 'away'}, optional
        The axial force it takes: none, either, towards the end that positions start from, or away
        from it. Left out: either by a pair, none by a single one; adjusted ones share it.
    stiffness : float or str, optional
        Radial, with its seat, N/m. Left out: rigid.
    """

    table: ClassVar[str] = "bearing"

    at: _Place
    bearing: RollingBearing | None = None
    arrangement: Literal[
        "single",
        "pair back-to-back",
        "pair face-to-face",
        "pair tandem",
        "adjusted back-to-back",
        "adjusted face-to-face",
    ] = "single"
    carries: Literal["radial", "both", "towards end", "away"] | None = None
    stiffness: (
        Annotated[float, Quantity("N/m", what="a stiffness", example="200 kN/mm", gt=0, le=1e15)]
        | None
    ) = None

    @model_validator(mode="before")
    @classmethod
    def _named(cls, data: Any, info: ValidationInfo[Any]) -> Any:
        if not isinstance(data, Mapping) or data.get("bearing") is None:
            return data
        return {**data, "bearing": resolve(RollingBearing, data["bearing"], info.context)}

    @model_validator(mode="after")
    def _possible(self) -> "ShaftBearing":
        rolling = self.bearing
        if rolling is None:
            return self
        if self.pair and rolling.kind not in ("angular contact", "taper"):
            raise InputError(
                f"bearing.arrangement is '{self.arrangement}'; a {rolling.kind} bearing is single"
            )
        if self.pair and rolling.kind == "taper":
            raise InputError(
                f"bearing.arrangement is '{self.arrangement}'; factors of pairs are known for "
                "angular contact bearings: give taper bearings as adjusted"
            )
        if self.adjusted and rolling.kind not in ("angular contact", "taper"):
            raise InputError(
                f"bearing.arrangement is '{self.arrangement}'; a {rolling.kind} bearing cannot be "
                "adjusted"
            )
        if self.arrangement == "single" and rolling.kind in ("angular contact", "taper"):
            raise InputError(
                f"bearing.arrangement is 'single'; one {rolling.kind} bearing alone does not "
                "locate a shaft: give it as adjusted against the other, or as a pair"
            )
        if self.arrangement == "pair tandem" and self.takes not in ("towards end", "away"):
            raise InputError(
                "bearing.arrangement is 'pair tandem', which carries one way: give "
                "bearing.carries as 'towards end' or 'away'"
            )
        if self.takes != "radial" and not rolling.carries_axial:
            raise InputError(
                f"bearing.carries is '{self.takes}'; a cylindrical bearing carries radial loads "
                "alone"
            )
        return self

    @property
    def pair(self) -> bool:
        """Whether it is two side by side."""
        return self.arrangement.startswith("pair")

    @property
    def opposed(self) -> bool:
        """Whether it is a pair that takes the axial load both ways."""
        return self.arrangement in ("pair back-to-back", "pair face-to-face")

    @property
    def adjusted(self) -> bool:
        """Whether it is adjusted against the other."""
        return self.arrangement.startswith("adjusted")

    @property
    def takes(self) -> str:
        """The axial force it takes, where that is left out as well."""
        return self.carries or ("both" if self.pair or self.adjusted else "radial")


class ShaftLoad(Table):
    """A load on a shaft besides that of the teeth.

    Parameters
    ----------
    at : float or str
        Position from the end, m.
    radial : float or str, optional
        Force across the axis, N. Give this or ``element``.
    element : str, optional
        What sits there and pulls by the shaft's torque, as 'v-belt': see the factors of
        `asperity.shafts.elements`.
    diameter : float or str, optional
        Effective diameter of the element, m.
    direction : float or str
        From y towards z, rad: 0 deg away from the wheel, seen on the worm's shaft.
    """

    table: ClassVar[str] = "load"
    required_alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (("radial", "element"),)

    at: _Place
    radial: (
        Annotated[float, Quantity("N", what="a force", example="500 N", ge=0, le=1e9)] | None
    ) = None
    element: Element | None = None
    diameter: _Length | None = None
    direction: Annotated[float, Quantity("rad", what="an angle", example="90 deg", ge=-7, le=7)] = (
        0.0
    )

    @model_validator(mode="after")
    def _sized(self) -> "ShaftLoad":
        if (self.element is None) != (self.diameter is None):
            raise InputError(
                "load.diameter and load.element belong together: the pull follows from torque and "
                "diameter"
            )
        return self


P = TypeVar("P", bound=Table)


def _listed(model: type[P], path: str, value: Any, context: Any) -> tuple[P, ...]:
    wanted = isinstance(value, list | tuple) and len(value) > 0
    if not wanted or not all(isinstance(each, Mapping | model) for each in value):
        raise InputError(f"{path} is {shown(value)}; it must be a list of tables, as [[{path}]]")
    return model.each_of(value, context, path)


class _Shaft(Table):
    """What both shafts have; see `WormShaft`."""

    material: ShaftSteel | None = None
    mesh: _Length
    section: Annotated[tuple[ShaftSection, ...], Field(min_length=1)]
    bearing: Annotated[tuple[ShaftBearing, ...], Field(min_length=1)]
    load: tuple[ShaftLoad, ...] = ()
    torque: Literal["constant", "pulsating", "reversing"] = "constant"
    peak: _Factor = 1.0
    hardening: Annotated[
        float, Quantity("", what="a factor", example="1.0", ge=0.5, le=3)
    ] = 1.0  # fmt: skip
    thread_notch_bending: _Factor = 2.0
    thread_notch_torsion: _Factor = 1.7

    @model_validator(mode="before")
    @classmethod
    def _parts(cls, data: Any, info: ValidationInfo[Any]) -> Any:
        if not isinstance(data, Mapping):
            return data
        made = dict(data)
        for key, model in (
            ("section", ShaftSection),
            ("bearing", ShaftBearing),
            ("load", ShaftLoad),
        ):
            if made.get(key) is not None and not (key == "load" and made[key] in ((), [])):
                made[key] = _listed(model, f"{cls.table}.{key}", made[key], info.context)
        if made.get("material") is not None:
            try:
                made["material"] = resolve(ShaftSteel, made["material"], info.context)
            except InputError as error:
                raise InputError(f"{cls.table}.material: {error}") from None
        return made

    @model_validator(mode="after")
    def _consistent(self) -> "_Shaft":
        name, length = self.table, self.length
        if len(self.bearing) != 2:
            raise InputError(
                f"{name}.bearing has {len(self.bearing)} places; a shaft has two: give a pair side "
                "by side as one, with its arrangement"
            )
        for key, places in (
            ("mesh", [self.mesh]),
            ("bearing", [each.at for each in self.bearing]),
            ("load", [each.at for each in self.load]),
        ):
            for at in places:
                if at > length * (1.0 + 1e-9):
                    where = f"{name}.{key}" + ("" if key == "mesh" else ".at")
                    raise InputError(
                        f"{where} is {1e3 * at:g} mm; the sections end at {1e3 * length:g} mm"
                    )
        first, second = self.bearing
        if abs(first.at - second.at) < 1e-6:
            raise InputError(
                f"{name}.bearing.at is {1e3 * first.at:g} mm twice; the bearings must stand apart"
            )
        if first.adjusted != second.adjusted or (
            first.adjusted and first.arrangement != second.arrangement
        ):
            raise InputError(
                f"{name}.bearing.arrangement is '{first.arrangement}' and '{second.arrangement}'; "
                "bearings are adjusted against each other, both the same way"
            )
        if first.adjusted and ((first.bearing is None) or (second.bearing is None)):
            raise InputError(
                f"{name}.bearing.bearing is missing; how adjusted bearings share the axial load "
                "follows from both"
            )
        if not first.adjusted:
            for way in ("towards end", "away"):
                able = [each for each in self.bearing if each.takes in ("both", way)]
                if len(able) > 1:
                    raise InputError(
                        f"{name}.bearing.carries: both bearings carry the axial force '{way}'; "
                        "one must be free of it"
                    )
        if self.table != WormShaft.table and any(s.diameter is None for s in self.section):
            raise InputError(f"{name}.section.diameter is missing; only a worm has threads")
        if self.table == WormShaft.table:
            self._require_meshing()
        return self

    def _require_meshing(self) -> None:
        """Refuse a worm whose mesh is off its threads, or on a bearing."""
        ends = [*itertools.accumulate((each.length for each in self.section), initial=0.0)]
        threads = [
            span
            for section, span in zip(self.section, itertools.pairwise(ends), strict=True)
            if section.diameter is None
        ]
        if threads and not any(a - 1e-9 <= self.mesh <= b + 1e-9 for a, b in threads):
            there = " and ".join(f"{1e3 * a:g} to {1e3 * b:g} mm" for a, b in threads)
            raise InputError(
                f"{self.table}.mesh is {1e3 * self.mesh:g} mm; its threads are at {there} from the "
                "end, and the teeth touch between"
            )
        if any(abs(self.mesh - each.at) < 1e-6 for each in self.bearing):
            raise InputError(
                f"{self.table}.mesh is {1e3 * self.mesh:g} mm, where a bearing stands; the teeth "
                "touch between both, or beyond them"
            )

    @property
    def length(self) -> float:
        """Of all sections, m."""
        return sum(each.length for each in self.section)

    @property
    def bearing_span(self) -> float:
        """Between its bearings, m."""
        first, second = self.bearing
        return float(f"{abs(second.at - first.at):.12g}")

    @property
    def assumed(self) -> Mapping[str, str]:
        """Which keys were left out, and what was assumed for them."""
        words = {"torque": "constant", "peak": "1, the greatest torque of the load"}
        words["hardening"] = "1"
        return {key: text for key, text in words.items() if key not in self.model_fields_set}


_SHAFT = """
    Parameters
    ----------
    material : str or table, optional
        A steel of a data file, or a table with the keys of `asperity.shafts.steel.ShaftSteel`. Left
        out: no strength is judged.
    mesh : float or str
        Position of the mesh from the end, m.
    section : list of table
        The parts of the shaft from the end on, each a `ShaftSection`.
    bearing : list of table
        Its two bearings, each a `ShaftBearing`.
    load : list of table, optional
        What else pulls at it, each a `ShaftLoad`.
    torque : {'constant', 'pulsating', 'reversing'}
        How the torque counts in fatigue: as mean stress, half as amplitude, or all.
    peak : float
        Greatest torque over K_A times that of the load, for yield and for static safety.
    hardening : float
        Factor :math:`K_V` of DIN 743, above 1 for a surface that is hardened or rolled.
    thread_notch_bending, thread_notch_torsion : float
        Notch factors of the threads' root, which no open standard has; 2.0 and 1.7 are assumed.
    """


class WormShaft(_Shaft):
    """The worm's shaft, from the end it is driven at."""

    table: ClassVar[str] = "worm_shaft"


class WheelShaft(_Shaft):
    """The wheel's shaft, from the end it drives with."""

    table: ClassVar[str] = "wheel_shaft"


for _model in (WormShaft, WheelShaft):
    _model.__doc__ = f"{_model.__doc__}\n{_SHAFT}"
