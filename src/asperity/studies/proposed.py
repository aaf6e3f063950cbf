"""Worm gearsets that are proposed, and how they are told."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from asperity.rating.demands import DEMANDS
from asperity.rating.standing import NAMES
from asperity.rating.verdict_rows import Row
from asperity.results import Result, quantity
from asperity.results.dataset import Described, described
from asperity.results.table import Table

if TYPE_CHECKING:
    import xarray as xr

_OF_SHAFTS = ("rows", "bearings")
# What files say of each proposal: the field with its unit and meaning.
_NUMBERS = {
    "starts": ("1", "threads of the worm"),
    "wheel_teeth": ("1", "teeth of the wheel"),
    "centre_distance_mm": ("mm", "centre distance"),
    "axial_module_mm": ("mm", "axial module"),
    "diameter_factor": ("1", "diameter factor"),
    "profile_shift": ("1", "profile shift of the wheel"),
    "efficiency": ("1", "efficiency of the gearbox by ISO/TR 14521"),
    "margin": ("1", "least of all safeties over what is asked"),
    "holds": ("1", "whether every safety is enough"),
    "mass_kg": ("kg", "mass of worm and wheel as full bodies"),
    "rim_kg": ("kg", "mass of the wheel's rim with its teeth"),
}
_TEXTS = {
    "limited_by": "safety that is the least",
    "locks_at_rest": "standards by which it locks itself at rest",
    "locks_in_motion": "standards by which it locks itself in motion",
    "locks": "whether it locks itself, by all standards",
    "hob": "hob of the shelf",
    "settings": "what makes a case it",
}
_LEADS_ON = "with --out FOLDER each is a case: asperity rate FOLDER/proposal-1.toml"
MOST = 20
"""Proposals that are shown."""


def gearset_keys(
    starts: float, teeth: float, distance: float, module: float, factor: float
) -> dict[str, Any]:
    """Return what a ``[gearset]`` table has of a macro-geometry, lengths in mm."""
    return {
        "starts": int(starts),
        "wheel_teeth": int(teeth),
        "centre_distance": f"{distance:.12g} mm",
        "axial_module": f"{module:.12g} mm",
        "diameter_factor": float(f"{factor:.12g}"),
    }


class Proposal(NamedTuple):
    """A gearset that is proposed.

    Attributes
    ----------
    starts, wheel_teeth : int
        Threads and teeth.
    centre_distance_mm, axial_module_mm, diameter_factor, profile_shift : float
        Its macro-geometry.
    efficiency : float
        Of the whole gearbox by ISO/TR 14521, worm driving.
    margin : float
        The least of all safeties over what is asked; 1 and more holds.
    limited_by : str
        The safety that has it, as ``standard.key``, or the shaft or bearing by its name.
    holds : bool
        Whether every safety is enough.
    locks_at_rest, locks_in_motion : tuple of str
        The standards by whose friction the worm locks itself, of those that have an answer.
    locks : str
        In a word or two, by all of them: ``in motion``, ``at rest``, ``by some`` or ``no``.
    hob : str
        Of the shelf, by its name; empty where any hob may be.
    mass_kg, rim_kg : float, optional
        Of worm and wheel as full bodies, and of the wheel's rim with its teeth.
    backlash_arcmin : tuple of float, optional
        Least and greatest at the wheel in the worst case, where there are tolerances.
    rows : tuple of Row, optional
        What its shafts and bearings come to, where the case has any.
    bearings : mapping of str to str, optional
        Names of those that are chosen from data files, by where they stand in the case.
    """

    starts: int
    wheel_teeth: int
    centre_distance_mm: float
    axial_module_mm: float
    diameter_factor: float
    profile_shift: float
    efficiency: float
    margin: float
    limited_by: str
    holds: bool
    locks_at_rest: tuple[str, ...] = ()
    locks_in_motion: tuple[str, ...] = ()
    locks: str = ""
    hob: str = ""
    mass_kg: float | None = None
    rim_kg: float | None = None
    backlash_arcmin: tuple[float, float] | None = None
    rows: tuple[Row, ...] = ()
    bearings: Mapping[str, str] = MappingProxyType({})

    @property
    def keys(self) -> dict[str, Any]:
        """What a ``[gearset]`` table has of it."""
        return gearset_keys(
            self.starts,
            self.wheel_teeth,
            self.centre_distance_mm,
            self.axial_module_mm,
            self.diameter_factor,
        )

    @property
    def settings(self) -> tuple[str, ...]:
        """What makes a case it, for ``--set``."""
        return tuple(f"gearset.{key}={value}" for key, value in self.keys.items())


class Proposals(Result):
    """Gearsets that are proposed for a ratio, a torque and a speed.

    Attributes
    ----------
    found : tuple of Proposal
        The best first.
    """

    title: ClassVar[str] = "Worm gearsets for what is asked"
    stem: ClassVar[str] = "size"

    rated: int = quantity("", "", "gearsets rated")
    holding: int = quantity("", "", "of them hold by every standard")
    ranked_by: str = quantity("", "", "ranked by")
    found: tuple[Proposal, ...]

    def to_json(self) -> dict[str, Any]:
        """Return the proposals, each with the settings that make it."""
        found = [
            {k: v for k, v in p._asdict().items() if k not in _OF_SHAFTS and v not in (None, "")}
            | ({"bearings": dict(p.bearings)} if p.bearings else {})
            | ({"rows": [row.to_json() for row in p.rows]} if p.rows else {})
            | {"settings": list(p.settings)}
            for p in self.found
        ]
        return super().to_json() | {"proposals": found}

    def to_dataset(self) -> "xr.Dataset":
        """Return the same over the proposals; a number that is not there is NaN, a text empty."""
        over, found = ("proposal",), self.found
        columns: dict[str, Described] = {}
        for name, (unit, meaning) in _NUMBERS.items():
            values = [getattr(p, name) for p in found]
            if any(value is not None for value in values):
                variable = name.removesuffix(f"_{unit}")
                columns[variable] = over, np.array(values, dtype=float), unit, meaning
        for name, meaning in _TEXTS.items():
            texts = [_joined(getattr(p, name)) for p in found]
            columns[name] = over, np.array(texts, dtype=object), "1", meaning
        if any(p.backlash_arcmin for p in found):
            ends = [p.backlash_arcmin or (np.nan, np.nan) for p in found]
            meaning = "least and greatest backlash at the wheel"
            columns["backlash"] = (*over, "end"), np.array(ends), "arcmin", meaning
        if any(p.bearings for p in found):
            named = [_joined(f"{k} = {name}" for k, name in p.bearings.items()) for p in found]
            columns["bearings"] = over, np.array(named, dtype=object), "1", "bearings of the shelf"
        return super().to_dataset().assign(described(**columns, **_rows_of(found)))

    def tables(self) -> tuple[Table, ...]:
        """Return a row for each proposal."""
        headings = ("", "a (mm)", "z_1", "z_2", "u", "m_x1 (mm)", "q_1", "x_2", "eta (%)", "margin",
                    "least safety", "locks")  # fmt: skip
        rows = [
            (str(place), f"{p.centre_distance_mm:g}", str(p.starts), str(p.wheel_teeth),
             f"{p.wheel_teeth / p.starts:.4g}",
             f"{p.axial_module_mm:g}", f"{p.diameter_factor:g}", f"{round(p.profile_shift, 3):g}",
             f"{100 * p.efficiency:.1f}", f"{p.margin:.2f}", _safety(p.limited_by), p.locks)
            for place, p in enumerate(self.found[:MOST], 1)
        ]  # fmt: skip
        best = self.found[0]
        said_above = not (self.holding and best.holds)
        first = " ".join(f'--set "{setting}"' for setting in best.settings)
        remarks = [
            f"{self.rated} gearset{'s' * (self.rated != 1)} rated, {self.holding} "
            f"hold{'s' * (self.holding == 1)} by every standard; shown are those "
            f"that no other beats in size, efficiency and margin, by {self.ranked_by}",
            # One that breaks is nobody's first one.
            *([f"the first one: {first}", _LEADS_ON] if best.holds else []),
            *(self.notes[:-1] if said_above else self.notes),
        ]
        if len(self.found) > MOST:
            remarks.insert(1, f"{len(self.found) - MOST} more with --json")
        title = self.notes[-1].capitalize() if said_above else ""
        table = Table.of(headings, rows, title=title, remarks=remarks)
        return (table, *self._borne(), *self._made())

    def _borne(self) -> Iterator[Table]:
        """Yield what shafts and bearings come to, where the case has any."""
        shown = self.found[:MOST]
        told = [_grouped(p.rows) for p in shown]
        if told[0]:
            heads = (
                "",
                *(f"{name} ({row.unit})" if row.unit else name for name, row in told[0].items()),
            )
            asked = ("asked", *(f"{row.asked:.4g}" for row in told[0].values()))
            rows = [
                (
                    str(place),
                    *(f"{row.value:.3g}{'' if row.holds else ' FAILS'}" for row in own.values()),
                )
                for place, own in enumerate(told, 1)
            ]
            yield Table.of(heads, [asked, *rows], title="Shafts and bearings")
        places = list(shown[0].bearings)
        if places:
            rows = [
                (str(place), *(p.bearings.get(where, "-") for where in places))
                for place, p in enumerate(shown, 1)
            ]
            yield Table.of(("", *places), rows, title="Bearings of the shelf")

    def _made(self) -> Iterator[Table]:
        """Yield what they weigh and, where it is asked, what cuts them and how they play."""
        shown = self.found[:MOST]
        if any(p.mass_kg is None for p in shown):
            return
        columns = {
            "": [str(place) for place, _ in enumerate(shown, 1)],
            "mass (kg)": [f"{p.mass_kg:.3g}" for p in shown],
            "rim (kg)": [f"{p.rim_kg:.3g}" for p in shown],
        }
        if any(p.hob for p in shown):
            columns["hob"] = [p.hob for p in shown]
        if any(p.backlash_arcmin for p in shown):
            columns["backlash (arcmin)"] = [_backlash(p) for p in shown]
        rows = list(zip(*columns.values(), strict=True))
        yield Table.of(tuple(columns), rows, title="Worm and wheel as full bodies")


def _joined(value: str | Iterable[str]) -> str:
    return value if isinstance(value, str) else "; ".join(value)


def _rows_of(found: Sequence[Proposal]) -> dict[str, Described]:
    """Return what files say of the shafts and bearings of proposals, as `described` takes it."""
    told = [{row.name: row for row in p.rows} for p in found]
    known = {name: row for rows in told for name, row in rows.items()}
    if not known:
        return {}

    def texts(values: Iterable[str]) -> Any:
        return np.array(list(values), dtype=object)

    def of_each(what: Callable[[Row], Any], absent: Any, kind: type) -> Any:
        values = [[what(rows[n]) if n in rows else absent for n in known] for rows in told]
        return np.array(values, dtype=kind)

    both, along = ("proposal", "row"), ("row",)
    units = texts(row.unit or "1" for row in known.values())
    in_its = "in the unit of the row"
    return {
        "row": (along, texts(known), "1", "shaft or bearing"),
        "row_standard": (along, texts(row.standard for row in known.values()), "1", "standard"),
        "row_unit": (along, units, "1", "unit: a life has h"),
        "row_value": (
            both,
            of_each(lambda row: row.value, np.nan, float),
            "",
            f"what is, {in_its}",
        ),
        "row_asked": (both, of_each(lambda row: row.asked, np.nan, float), "", f"asked, {in_its}"),
        "row_by": (both, of_each(lambda row: row.by, "", object), "1", "what decides on it"),
    }


def _grouped(rows: Sequence[Row]) -> dict[str, Row]:
    """Return the rows of shafts and bearings by what is told of them; of lives the least."""
    lives = [row for row in rows if row.unit]
    least = {"bearings": min(lives, key=lambda row: row.margin)} if lives else {}
    return {**least, **{row.name: row for row in rows if not row.unit}}


def _safety(path: str) -> str:
    """Return a safety as its symbol and the name of its standard."""
    demand = next((demand for demand in DEMANDS if demand.path == path), None)
    return path if demand is None else f"{demand.symbol} {NAMES[demand.standard]}"


def _backlash(proposal: Proposal) -> str:
    interval = proposal.backlash_arcmin
    return "-" if interval is None else f"{interval[0]:.3g} to {interval[1]:.3g}"
