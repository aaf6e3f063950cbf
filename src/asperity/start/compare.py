"""Cases side by side: what differs in what they ask and in what they come to."""

import dataclasses
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from asperity.casefile.case import Case
from asperity.casefile.written import worded
from asperity.commands import COMMANDS, Command
from asperity.drive.studies.gains import VELOCITY_RATIO, Gain, gain
from asperity.errors import InputError
from asperity.gearset import Gearset
from asperity.rating.power_words import load_drives, power_of
from asperity.rating.rated import Rated
from asperity.results import Result
from asperity.results.dataset import Described, described
from asperity.results.language import Spoken
from asperity.results.language import said as in_language
from asperity.results.quantity import unit_at_end
from asperity.results.settled import MARK, told, unsettled
from asperity.results.table import Table
from asperity.results.words import text_of
from asperity.units import quantity_of
from asperity.units.measures import measure

if TYPE_CHECKING:
    import xarray as xr

COMPARED = ("rate", "block", "slide")
"""Commands whose answers are compared, the first that all cases have the tables of."""

_SAME = 1e-9
_ENDS = re.compile(r"(.*) \(([^()]+)\)")
_SHAKEN = "screw.torque_ratio"
_LEFT_OUT = "-"
_SUMP, _HOTTEST = "iso14521.theta_S_degC", "iso14521.theta_S_max_degC"


class Comparison(Result):
    """Cases side by side.

    Attributes
    ----------
    command : str
        What was done with each.
    cases : tuple of str
        Their names.
    asked : tuple of (str, tuple)
        Each ``table.key`` that is not the same in all, with its text in each; None where it is left
        out and has no default.
    numbers : tuple of (str, str, tuple)
        Each number that differs: its key, what it is, and its value in each.
    said : tuple of (str, str)
        What is to be said, with the case that it is said of, empty where it is of all.
    settled : tuple of bool or None
        Whether the answer of each has settled; None of what is no march and no state.
    units : mapping of str to str
        Of the numbers that have one, by key.
    """

    title: ClassVar[str] = "Cases side by side"
    stem: ClassVar[str] = "compare"

    command: str
    cases: tuple[str, ...]
    asked: tuple[tuple[str, tuple[str | None, ...]], ...]
    numbers: tuple[tuple[str, str, tuple[float | None, ...]], ...]
    said: tuple[tuple[str, str], ...] = ()
    settled: tuple[bool | None, ...] = ()
    units: Mapping[str, str] = dataclasses.field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """Return what differs by key."""
        return {
            "command": self.command,
            "cases": list(self.cases),
            "inputs": {key: list(values) for key, values in self.asked},
            "results": {key: list(values) for key, _, values in self.numbers},
            **({"settled": list(self.settled)} if any(s is not None for s in self.settled) else {}),
            "notes": list(self.notes),
        }

    def to_dataset(self) -> "xr.Dataset":
        """Return what differs over the cases; a number that is left out is NaN, a text empty."""
        over, attributes = ("case",), {"command": self.command, "notes": "; ".join(self.notes)}
        columns: dict[str, Described] = {
            "case": (over, np.array(self.cases, dtype=object), "1", "case")
        }
        for (
            key,
            values,
        ) in self.asked:
            texts = np.array([value or "" for value in values], dtype=object)
            columns[f"inputs.{key}"] = over, texts, "1", f"{key}, as it is asked for"
        for key, what, numbers in self.numbers:
            unit = self.units.get(key, "1")
            columns[f"results.{key}"] = over, np.array(numbers, dtype=float), unit, what or key
        if any(stays is not None for stays in self.settled):
            stays = np.array(self.settled, dtype=float)
            columns["settled"] = over, stays, "1", "whether it has settled"
        return described(self.title, **columns).assign_attrs(attributes)

    def tables(self) -> tuple[Table, ...]:
        """Return a table of inputs and one of results."""
        inputs = [(key, *(value or _LEFT_OUT for value in values)) for key, values in self.asked]
        shown = [row for row in self.numbers if row[1]] or list(self.numbers)
        results = [(*_apart(what or key), *map(text_of, values)) for key, what, values in shown]
        remarks: list[str] = [
            Spoken(f"{name}: {in_language(text)}") if name else text for name, text in self.said
        ]
        if len(shown) < len(self.numbers):
            more = len(self.numbers) - len(shown)
            words = "number differs" if more == 1 else "numbers differ"
            remarks.append(f"{more} more {words}: --json")
        settled = self.settled or (None,) * len(self.cases)
        # A head is as wide as its column, which a path would be broken in.
        heads = [Path(case).name for case in self.cases]
        if len(set(heads)) < len(heads):
            heads = list(self.cases)
        cases = [
            f"{head} {MARK}" if stays is False else head
            for head, stays in zip(heads, settled, strict=True)
        ]
        alike = "They differ" if inputs else "They ask the same"
        return (
            Table.of(("asked", *heads), inputs, title=alike),
            Table.of(
                (f"asperity {self.command}", "unit", *cases), results, remarks=remarks, left=2
            ),
        )


def _apart(what: str) -> tuple[str, str]:
    """Return what a number is, and its unit, which stands in brackets at the end."""
    found = _ENDS.fullmatch(what)
    if found is None or measure(found[2]) is None:
        return what, ""
    return found[1], found[2]


def compare(cases: Sequence[Case], answer: Callable[[Command, Case], Result]) -> Comparison:
    """Answer cases and return what differs.

    Parameters
    ----------
    cases : sequence of Case
        Two or more.
    answer : callable
        Does what a command does with a case.

    Raises
    ------
    InputError
        Fewer than two, or cases that no command takes all of.
    """
    if len(cases) < 2:
        raise InputError("one case is given; name two or more to compare")
    command = _command(cases)
    answers = [answer(command, case) for case in cases]
    names = [case.source for case in cases]
    if len(set(names)) < len(names):
        names = [f"{place}: {name}" for place, name in enumerate(names, 1)]
    flat = [dict(_numbers(result.to_json())) for result in answers]
    meanings = {key: what for result in answers for key, what in _meanings(result)}
    if any(_HOTTEST in numbers for numbers in flat):
        for numbers in flat:
            if _SUMP in numbers:
                numbers.setdefault(_HOTTEST, numbers[_SUMP])
        meanings.pop(_SUMP, None)
        meanings[_HOTTEST] = "sump, in the hottest part of a duty cycle (degC)"
    if any(map(_load_drives, answers)):
        for numbers, result in zip(flat, answers, strict=True):
            numbers |= dict(_by_who_drives(result))
        meanings = {_OF_WHO_DRIVES.get(key, key): what for key, what in meanings.items()}
    gains = [_gain(case, numbers) for case, numbers in zip(cases, flat, strict=True)]
    for numbers, gained in zip(flat, gains, strict=True):
        if gained is not None:
            numbers[_SHAKEN] = gained.torque_ratio
    said = [
        (name, sentence)
        for name, result in zip(names, answers, strict=True)
        for sentence in _verdict(result)
    ]
    said += [
        (name, sentence)
        for name, result in zip(names, answers, strict=True)
        for sentence in _who_drives(result)
    ]
    said += [
        (f"{MARK} {name}", sentence)
        for name, result in zip(names, answers, strict=True)
        for sentence in (told(result) if unsettled(result) else ())
    ]
    said += _most_to_gain(names, gains)
    return Comparison(
        command=command.name,
        cases=tuple(names),
        asked=tuple(_inputs(cases)),
        numbers=tuple(_differing(flat, meanings)),
        said=tuple(said),
        settled=tuple(getattr(result, "settled", None) for result in answers),
        units=_units(answers, flat),
    )


def _units(answers: Sequence[Result], flat: Sequence[Mapping[str, Any]]) -> dict[str, str]:
    """Return the units of numbers, by key: what an answer puts together has its in that alone."""
    own = {key: entry.label.unit for result in answers for key, entry in result.keyed()}
    units = dict.fromkeys((*own.values(), "mm", "mm/rad", "um", "deg"))
    for key in dict.fromkeys(key for numbers in flat for key in numbers):
        if key not in own:
            own[key] = unit_at_end(key, units)
    return {key: unit for key, unit in own.items() if unit}


def _command(cases: Sequence[Case]) -> Command:
    for name in COMPARED:
        command = next(command for command in COMMANDS if command.name == name)
        if all(table in case for case in cases for table in command.needs):
            return command
    listed = ", ".join(f"{case.source} has [{'], ['.join(case.tables)}]" for case in cases)
    raise InputError(f"these cases are not of one kind: {listed}")


def _inputs(cases: Sequence[Case]) -> Iterator[tuple[str, tuple[str | None, ...]]]:
    for table, model in cases[0].known.items():
        for key in model.model_fields if any(table in case for case in cases) else ():
            texts = tuple(_text(case, table, key) for case in cases)
            held = [getattr(case.tables[table], key) if table in case else None for case in cases]
            # Of a long list the text is not all.
            if len(set(texts)) > 1 or any(value != held[0] for value in held):
                yield f"{table}.{key}", texts


def _text(case: Case, table: str, key: str) -> str | None:
    if table not in case:
        return None
    held = case.tables[table]
    value, quantity = getattr(held, key), quantity_of(type(held), key)
    return None if value is None else worded(value, quantity)


def _numbers(answer: Mapping[str, Any], prefix: str = "") -> Iterator[tuple[str, float | None]]:
    for key, value in answer.items():
        if isinstance(value, Mapping):
            yield from _numbers(value, f"{prefix}{key}.")
        elif isinstance(value, int | float) and not isinstance(value, bool):
            yield prefix + key, float(value)


def _load_drives(result: Result) -> bool:
    return isinstance(result, Rated) and load_drives(result.rating_inputs)


def _who_drives(result: Result) -> Iterator[str]:
    """Say whose efficiency and losses a rating's are, where they are not the worm's."""
    if not isinstance(result, Rated) or not load_drives(result.rating_inputs):
        return
    iso = result.iso14521
    if iso is not None and power_of(result.rating_inputs, iso).gearbox is None:
        yield "the load is to drive and cannot: it has no efficiency and no losses"
    else:
        yield "the load drives: efficiency, input power and losses are those of the load"


def _by_who_drives(result: Result) -> Iterator[tuple[str, float]]:
    """Yield efficiency and losses of a rating, by the load where that drives."""
    if isinstance(result, Rated) and result.iso14521 is not None:
        power = power_of(result.rating_inputs, result.iso14521)
        for key, value in zip(_OF_WHO_DRIVES.values(), power, strict=True):
            if value is not None:
                yield key, value


def _differing(
    flat: Sequence[Mapping[str, float | None]], meanings: Mapping[str, str]
) -> Iterator[tuple[str, str, tuple[float | None, ...]]]:
    for key in dict.fromkeys(key for numbers in flat for key in numbers):
        values = tuple(numbers.get(key) for numbers in flat)
        known = [value for value in values if value is not None]
        same = len(known) == len(values) and all(
            math.isclose(value, known[0], rel_tol=_SAME) for value in known
        )
        if not same:
            yield key, meanings.get(key, ""), values


def _gain(case: Case, numbers: Mapping[str, float | None]) -> Gain | None:
    """What vibration saves in a gearset with the friction of its rating; None without one."""
    friction = numbers.get("iso14521.mu_zm")
    if friction is None:
        return None
    try:
        return gain(case.require(Gearset).geometry, friction)
    except InputError:
        return None  # it cannot drive


def _most_to_gain(names: Sequence[str], gains: Sequence[Gain | None]) -> Iterator[tuple[str, str]]:
    known = [(each, name) for name, each in zip(names, gains, strict=True) if each is not None]
    if not known:
        return
    least, name = min(known, key=lambda pair: pair[0].torque_ratio)
    yield (
        "",
        f"most to gain from vibration: {name}, whose torque a fast screw at k_w = "
        f"{VELOCITY_RATIO:g} leaves {least.torque_ratio:.3g} of, in balance with its load, and "
        f"no friction at all {least.least_ratio:.3g} (closed forms; asperity drive has its "
        "resonances)",
    )
    for each, name in known:
        if each.locks:
            word = "still holds" if each.locks_shaken else "does not hold"
            yield name, f"locks itself at rest; it {word} under that screw"


def _meanings(result: Result) -> Iterator[tuple[str, str]]:
    """Yield what is shown of an answer, by key: of a rating what it comes to, of others all."""
    verdict = getattr(result, "verdict", None)
    if verdict is None:
        for entry in result.entries():
            if entry.in_json and entry.label.shown:
                unit = f" ({entry.label.unit})" if entry.label.unit else ""
                yield entry.key, f"{entry.label.meaning}{unit}"
        return
    for safety in verdict.safeties:
        d = safety.demand
        yield d.path, f"{d.path} {d.symbol} (asked {d.asked:g})"
    yield from _OF_A_RATING.items()


_OF_A_RATING = {
    "geometry.centre_distance_mm": "centre distance (mm)",
    "geometry.gear_ratio": "gear ratio",
    "iso14521.eta_ges": "efficiency of the gearbox",
    "iso14521.eta_z1_2": "efficiency of the teeth",
    "iso14521.input_power_W": "input power (W)",
    "iso14521.loss_total_W": "losses (W)",
    "iso14521.theta_S_degC": "sump (degC)",
    "bs721.M_permissible_Nm": "torque permitted by BS 721 (N m)",
    "agma6034.allowable_torque_Nm": "torque allowed by AGMA 6034 (N m)",
    _SHAKEN: f"torque under a fast screw, k_w = {VELOCITY_RATIO:g}, over that without, in balance",
}


# In the order of `power_of`.
_OF_WHO_DRIVES = {
    "iso14521.eta_ges": "by_who_drives.efficiency",
    "iso14521.eta_z1_2": "by_who_drives.teeth_efficiency",
    "iso14521.input_power_W": "by_who_drives.input_power_W",
    "iso14521.loss_total_W": "by_who_drives.loss_total_W",
}


def _verdict(result: Result) -> list[str]:
    verdict = getattr(result, "verdict", None)
    return [] if verdict is None else list(verdict.stands())
