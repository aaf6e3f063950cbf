"""The tables of a case file, whichever command reads them."""

import importlib
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from asperity.casefile import Table

_TABLES = {
    "project": "asperity.casefile.project:Project",
    "slider": "asperity.slider.parameters:Slider",
    "friction": "asperity.friction.parameters:Friction",
    "vibration": "asperity.vibration:Vibration",
    "normal": "asperity.normal:Normal",
    "wear": "asperity.slider.wear:Wear",
    "solve": "asperity.slider.parameters:Solve",
    "gearset": "asperity.gearset.parameters:Gearset",
    "tolerances": "asperity.gearset.tolerancing.table:Tolerances",
    "operation": "asperity.rating.parameters:Operation",
    "rating": "asperity.rating.parameters:RatingOptions",
    "worm_shaft": "asperity.shafts.parameters:WormShaft",
    "wheel_shaft": "asperity.shafts.parameters:WheelShaft",
    "bearings": "asperity.shafts.options:BearingOptions",
    "spectrum": "asperity.rating.spectrum:Spectrum",
    "requirements": "asperity.studies.requirements:Requirements",
    "housing": "asperity.rating.housing:Housing",
    "block": "asperity.block.parameters:Block",
    "contact": "asperity.block.parameters:Contact",
    "hob": "asperity.flanks.parameters:Hob",
    "disc": "asperity.flanks.parameters:Disc",
    "modification": "asperity.flanks.parameters:Modification",
    "mount": "asperity.flanks.parameters:Mount",
    "blank": "asperity.gearset.blanks:Blanks",
    "measuring": "asperity.flanks.parameters:MeasuringOptions",
    "rig": "asperity.tribometer.parameters:Rig",
    "steel_disc": "asperity.tribometer.parameters:SteelDisc",
    "bronze_disc": "asperity.tribometer.parameters:BronzeDisc",
    "drives": "asperity.tribometer.parameters:Drives",
    "sonotrode": "asperity.tribometer.parameters:Sonotrode",
    "channels": "asperity.tribometer.channels:Channels",
    "lubricant": "asperity.tribometer.parameters:Lubricant",
    "limits": "asperity.tribometer.parameters:Limits",
    "plan": "asperity.tribometer.options:Plan",
    "twin": "asperity.tribometer.options:Twin",
    "reduction": "asperity.tribometer.options:Reduction",
    "scope": "asperity.tribometer.instruments.acquisition:Acquisition",
    "controller": "asperity.tribometer.instruments.parameters:Controller",
    "supplies": "asperity.tribometer.instruments.parameters:Supplies",
    "guardian": "asperity.tribometer.instruments.parameters:Guard",
    "conditions": "asperity.tribometer.parameters:Conditions",
    "package": "asperity.tribometer.deposit:Package",
    "drive": "asperity.drive.parameters:Drive",
    "shaft": "asperity.drive.parameters:Shaft",
    "actuator": "asperity.drive.parameters:Actuator",
    "control": "asperity.drive.control.parameters:Control",
}


def loaded(place: str) -> Any:
    """Return what stands at ``"module:name"`` of another room, imported when it is used."""
    module, _, name = place.partition(":")
    return getattr(importlib.import_module(module), name)


class _Tables(Mapping[str, "type[Table]"]):
    """The tables of a case file; the module of each is imported when it is asked for."""

    def __getitem__(self, name: str) -> "type[Table]":
        table: type[Table] = loaded(_TABLES[name])
        return table

    def __contains__(self, name: object) -> bool:
        return name in _TABLES

    def __iter__(self) -> Iterator[str]:
        return iter(_TABLES)

    def __len__(self) -> int:
        return len(_TABLES)


def case_tables() -> "Mapping[str, type[Table]]":
    """Return every table a case file may have, whichever command reads it, by name."""
    return _Tables()
