"""How far the numbers of the package can be trusted, counted where they stand.

Numbers of data files have a source each, formulas one together, those that stand in a rating's
list of entries alone among them; of tables and limits in the package `LISTED` says where they
stand and where their source does.
"""

import ast
import functools
import importlib
import math
import pkgutil
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import asperity
from asperity.drive.motor import Motor
from asperity.errors import InputError
from asperity.gearset.bearings import Bearings
from asperity.gearset.library import Sourced, every
from asperity.gearset.lubricants import BaseOil, Lubricant
from asperity.gearset.materials import Steel, WheelMaterial, WormMaterial
from asperity.rating.demands import DEMANDS
from asperity.shafts.steel import ShaftSteel
from asperity.sources import CONFIDENCES, Range, Source

PACKAGE = Path(asperity.__file__).parent

DATA = {
    "wheel materials": WheelMaterial, "worm materials": WormMaterial, "steels": Steel,
    "base oils": BaseOil, "oils": Lubricant, "arrangements of bearings": Bearings,
    "motors": Motor, "steels of shafts": ShaftSteel,
}  # fmt: skip
"""Kinds of things in data files."""

FORMULAS = {
    "formulas of iso14521": ("rating.iso14521",), "formulas of bs721": ("rating.bs721",),
    "formulas of agma6034": ("rating.agma6034",),
    "formulas of gearsets and oils": ("gearset",),
    "formulas of DIN 743": ("shafts.strength",),
    "formulas of rolling bearings": ("shafts.rolling",),
    "closed forms, wear and heat of a sliding body": ("slider.closed_forms", "slider.wear"),
    "formulas of a tribometer": ("tribometer",),
}  # fmt: skip
"""Kinds of formulas, and the rooms or modules they stand in."""

ENTRIES = Path("rating", "data", "entries.toml")
"""What a rating says of each number; some of its equations stand there alone."""

LIMITS = (
    "rating.iso14521.limits", "rating.bs721.limits", "rating.agma6034.limits", "gearset.oil",
)  # fmt: skip
"""Modules with ranges of validity."""

LISTED = (
    ("tooth proportions", "gearset.proportions:RULES", "gearset.proportions:SOURCES"),
    ("discs and hobs of flanks", "flanks.parameters:SOURCES", "flanks.parameters:SOURCES"),
    ("hobs of DIN 3976", "gearset.hob_shelf:PAIRS", "gearset.hob_shelf:PAIRS_SOURCE"),
    ("pins and balls", "flanks.measuring.measures:SIZES",
     "flanks.measuring.measures:SOURCES.measuring pins and balls"),
    ("tolerances: series 25", "gearset.tolerancing.thickness:TOLERANCES",
     "gearset.tolerancing.thickness:SOURCE"),
    ("tolerances: GOST 3675, grades", "gearset.tolerancing.grades:_WORM",
     "gearset.tolerancing.grades:GOST"),
    ("tolerances: GOST 3675, fits", "gearset.tolerancing.allowances:FITS",
     "gearset.tolerancing.allowances:FIT_SOURCE"),
    ("tolerances: ISO 1328, formulas", 2, "gearset.tolerancing.grades:ISO_1328"),
    ("films of teeth", "flanks.meshing.lubrication:SOURCES", "flanks.meshing.lubrication:SOURCES"),
    ("regimes of lubrication", "rating.regime:LIMITS", "rating.regime:LIMITS_SOURCE"),
    ("duties of valves", "rating.spectrum:_ENDURANCE", "rating.spectrum:VALVES"),
    ("keys of DIN 6885", "gearset.keys:_SIZES", "gearset.keys:SOURCE"),
    ("sizes of rolling bearings", "shafts.dimensions:DIMENSIONS", "shafts.dimensions:ISO_15"),
    ("lives at 96 % and more", 4, "shafts.symbols:ISO_281_MEMORY"),
    ("scales of drawings", "results.svg:SCALES", "results.svg:SCALES_SOURCE"),
    ("least safeties of shafts", "shafts.strength.din743:ASKED", "shafts.symbols:DIN_743_MEMORY"),
    ("densities, expansion, heat", "gearset.masses:DENSITY", "gearset.masses:DENSITY_SOURCE"),
    ("densities, expansion, heat", "gearset.tolerancing.warmth:EXPANSION",
     "gearset.tolerancing.warmth:EXPANSION_SOURCE"),
    ("densities, expansion, heat", "rating.housing:HEAT", "rating.housing:HEAT_SOURCE"),
    ("densities, expansion, heat", "drive.static.flash:HEAT", "drive.static.flash:THERMAL"),
    ("densities, expansion, heat", 1, "drive.static.flash:THERMAL"),
    ("flash temperature: its factor", 1, "drive.static.flash:BLOK"),
    ("supply and ultrasound of a drive", "drive.motor:LOWEST_VOLTAGE", "drive.motor:SUPPLY"),
    ("supply and ultrasound of a drive", 2, "drive.motor:ULTRASOUND"),
)  # fmt: skip
"""(kind, where the numbers stand or how many they are, where their source does)."""


class Trust(NamedTuple):
    """How many numbers of a kind are verified, of one source, of our own, and from memory."""

    kind: str
    verified: int
    one_source: int
    own: int
    from_memory: int


def trust():
    """Yield how far the numbers can be trusted, counted where they stand."""
    yield _tables_of_bs721()
    for kind, model in DATA.items():
        yield _counted(kind, [s for thing in every(model) for s in _sources(model, thing)])
    for kind, rooms in FORMULAS.items():
        made = [formula.source.confidence for formula in _formulas(rooms) if formula.source]
        yield _counted(kind, made + list(_of_entries(kind.removeprefix("formulas of "))))
    yield _counted("limits of validity, each end", _ends())
    yield _counted("safeties asked for", [demand.source.confidence for demand in DEMANDS])
    for kind in dict.fromkeys(kind for kind, *_ in LISTED):
        yield _counted(kind, [c for one in LISTED if one[0] == kind for c in _listed(*one[1:])])


def _tables_of_bs721():
    all_, checked = 0, 0
    path = PACKAGE / "rating" / "data" / "bs721.toml"
    about = "checked", "doubted", "x", "diameter_factor"
    for table in tomllib.loads(path.read_text("utf-8")).values():
        checked += sum(map(len, table.get("checked", {}).values()))
        all_ += _count_numbers({k: v for k, v in table.items() if k not in about})
    return Trust("tables of BS 721", 0, checked, 0, all_ - checked)


def _of_entries(standard):
    """Yield the trust of what a rating has by an equation of its list of entries alone.

    What comes of a table is counted there, and a definition needs no document.
    """
    listed = tomllib.loads((PACKAGE / ENTRIES).read_text("utf-8"))
    for values in listed.get(standard, {}).values():
        source = values.get("from", "definition")
        if not ("formula" in values or values.get("equation") == "table" or source == "definition"):
            yield listed["source"][source]["confidence"]


def _count_numbers(value):
    if isinstance(value, Mapping):
        return sum(map(_count_numbers, value.values()))
    if isinstance(value, list | tuple):
        return sum(map(_count_numbers, value))
    return int(isinstance(value, int | float) and not isinstance(value, bool))


def _sources(model, thing):
    for key in model.model_fields.keys() - Sourced.model_fields.keys():
        value = getattr(thing, key, None)
        if isinstance(value, int | float | dict) and not isinstance(value, bool):
            count = len(value) if isinstance(value, dict) else 1
            try:
                yield from [thing.source(key).confidence] * count
            except (InputError, KeyError):
                continue
    if model is Steel:
        yield thing.source("number").confidence


def _ends():
    found = {}
    for name in LIMITS:
        for value in vars(_module(name)).values():
            for span in value.values() if isinstance(value, Mapping) else (value,):
                if isinstance(span, Range):
                    found[span.name] = span
    for span in found.values():
        yield from [span.source.confidence] * sum(map(math.isfinite, (span.lower, span.upper)))


def _listed(numbers, source):
    """Yield the trust of each number, or of each rule that has a source of its own."""
    sources = _at(source)
    if isinstance(sources, Mapping):
        yield from (each.confidence for each in sources.values())
    else:
        count = numbers if isinstance(numbers, int) else _count_numbers(_at(numbers))
        yield from [sources.confidence] * count


def _at(place):
    module, _, name = place.partition(":")
    name, _, key = name.partition(".")
    value = getattr(_module(module), name)
    return value[key] if key else value


def _counted(kind, confidences):
    confidences = list(confidences)
    return Trust(kind, *map(confidences.count, CONFIDENCES))


def _module(name):
    return importlib.import_module(f"asperity.{name}")


@functools.cache
def _formulas(rooms):
    """Formulas of modules, each once."""
    found = {}
    for room in rooms:
        package = _module(room)
        names = [package.__name__]
        if hasattr(package, "__path__"):
            prefix = f"{package.__name__}."
            names += [m.name for m in pkgutil.walk_packages(package.__path__, prefix)]
        for name in names:
            here = importlib.import_module(name)
            for one in vars(here).values():
                made = hasattr(one, "equation") and isinstance(getattr(one, "source", None), Source)
                if made and getattr(one, "__module__", "") == name:
                    found[name, one.symbol, one.equation] = one
    return tuple(found.values())


def from_memory():
    """Yield each source from memory that the package names: module or data file, and words."""
    for path in sorted(PACKAGE.rglob("*.toml")):
        data = tomllib.loads(path.read_text("utf-8"))
        named = data.get("source", {})
        for name, values in {**data, **(named if isinstance(named, dict) else {})}.items():
            if isinstance(values, dict) and values.get("confidence") == "from memory":
                yield path.relative_to(PACKAGE).as_posix(), f"[{name}]"
    for path in sorted(PACKAGE.rglob("*.py")):
        text = path.read_text("utf-8")
        if "from memory" not in text:
            continue
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Source":
                words = [getattr(each, "value", None) for each in node.args]
                if "from memory" in words:
                    module = path.relative_to(PACKAGE).with_suffix("").as_posix()
                    yield module.replace("/", "."), ast.unparse(node)
