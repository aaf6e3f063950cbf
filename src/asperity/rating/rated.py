"""A worm gearset rated by up to three standards: what it comes to, shown and written."""

import dataclasses
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from asperity.files.store import harmless_cell, write_text
from asperity.gearset.geometry import Geometry
from asperity.gearset.parameters import Gearset
from asperity.gearset.tolerancing.backlash import Backlash
from asperity.rating.bs721.tables import Tables
from asperity.rating.duty import DutyPart, duty_mean, duty_parts, duty_table
from asperity.rating.duty_words import duty_lines, loads_line
from asperity.rating.endurance import Endurance, endurance, endurance_table
from asperity.rating.forces import Forces, forces
from asperity.rating.holding import Holding, held_table, holding
from asperity.rating.inputs import Inputs
from asperity.rating.iso14521.housed import uncounted
from asperity.rating.levers import Alternative, Lever
from asperity.rating.power_words import power_lines
from asperity.rating.result import Rating
from asperity.rating.self_locking import SelfLocking
from asperity.rating.standards import PROMISED, STANDARDS
from asperity.rating.starting import Starting, starting, starting_table
from asperity.rating.verdict import Verdict, screen
from asperity.rating.verdict_rows import Row, Shafts, beside
from asperity.results import Result
from asperity.results.nested import with_parts
from asperity.results.quantity import Entry, Label
from asperity.results.table import Table
from asperity.results.unit_systems import shown_frame

if TYPE_CHECKING:
    import xarray as xr

    from asperity.results.report import Heading, Section

_MOST_SHEETS = 100
"""Loads of a spectrum above which there is no workbook, which has cells for each of them."""


class Rated(Result):
    """A worm gearset rated by one or more standards.

    Attributes
    ----------
    gearset : Gearset
        What was rated.
    geometry : Geometry
        What follows from its numbers.
    iso14521, bs721, agma6034 : Rating or None
        Its rating by each standard; None if it was not asked for or cannot be applied.
    self_locking : SelfLocking
        Whether the worm locks itself, by the friction of each of them.
    notes : tuple of str
        Why a standard could not be applied, and what a steel was taken for.
    assumed : mapping of str to str
        What was assumed for the keys of a case file that were left out, by ``table.key``.
    levers : tuple of Lever
        What moves the least safety most, where it was asked for, as ``asperity rate`` does.
    alternatives : tuple of Alternative
        The oil and the wheel material of those with a name that bring most of it, likewise.
    rating_inputs : Inputs
        What the formulas started from.
    tables_bs721 : Tables
        Those of BS 721.
    unanswered : mapping of str to str
        Why a standard that was asked for could not be applied.
    contact : Section or None
        What its report shows of how the flanks touch, where that was asked for.
    backlash : Backlash or None
        What the tolerances leave of it, where there are any.
    rows : tuple of Row
        What others than the standards say of the same gearbox, for its verdict.
    shafts : Shafts, optional
        What draws its shafts, and works them out in the workbook.
    """

    title: ClassVar[str] = "Worm gearset, rated"
    stem: ClassVar[str] = "rate"

    gearset: Gearset
    geometry: Geometry
    iso14521: Rating | None
    bs721: Rating | None
    agma6034: Rating | None
    self_locking: SelfLocking
    assumed: Mapping[str, str]
    levers: tuple[Lever, ...] = ()
    alternatives: tuple[Alternative, ...] = ()
    rating_inputs: Inputs
    tables_bs721: Tables
    unanswered: Mapping[str, str] = dataclasses.field(default_factory=dict)
    contact: "Section | None" = None
    backlash: Backlash | None = None
    rows: tuple[Row, ...] = ()
    shafts: Shafts | None = None

    @property
    def verdict(self) -> Verdict:
        """Whether it holds by each standard, and what fails first."""
        return Verdict.of(
            self.found,
            self.levers,
            self.alternatives,
            self.rating_inputs.operation.wear_assumed,
            self.unanswered,
            self.rows,
            uncounted(self.rating_inputs),
        )

    @property
    def forces(self) -> tuple[Forces, ...]:
        """What shafts and bearings carry in each direction of rotation, by ISO/TR 14521."""
        return () if self.iso14521 is None else forces(self.rating_inputs, self.iso14521)

    @property
    def holding(self) -> tuple[Holding, ...]:
        """What a brake on the worm must bring to hold the load when the motor stops."""
        return holding(self.rating_inputs, self.self_locking)

    @property
    def duty_cycle(self) -> tuple[DutyPart, ...]:
        """What each part of a duty cycle has in wear and heat, by ISO/TR 14521."""
        return () if self.iso14521 is None else duty_parts(self.rating_inputs, self.iso14521)

    @property
    def endurance(self) -> tuple[Endurance, ...]:
        """How long it runs until each limit of ISO/TR 14521 and BS 721, the shortest first."""
        return endurance(self.rating_inputs, self.found)

    @property
    def starting(self) -> tuple[Starting, ...]:
        """What starting takes, where the spectrum has starts."""
        return starting(self.rating_inputs, self.iso14521, self.self_locking, self.holding)

    @property
    def of_power(self) -> tuple[str, ...]:
        """What the verdict says of efficiency and losses."""
        iso = self.iso14521
        return () if iso is None else tuple(power_lines(self.rating_inputs, iso))

    @property
    def of_duty(self) -> tuple[str, ...]:
        """What the verdict says of spectrum and housing."""
        inputs = self.rating_inputs
        lasts = self.endurance if inputs.operation.steps is not None else ()
        return tuple(duty_lines(inputs, self.found, self.duty_cycle, lasts, self.starting))

    @property
    def found(self) -> dict[str, Rating]:
        """The ratings that there are, by standard."""
        ratings = {name: getattr(self, name) for name in STANDARDS}
        return {name: rating for name, rating in ratings.items() if rating is not None}

    @property
    def ratings(self) -> tuple[Rating, ...]:
        """The ratings that there are."""
        return tuple(self.found.values())

    def to_json(self) -> dict[str, Any]:
        """Return everything by key; the units are part of the keys."""
        found = {
            name: dict.fromkeys(PROMISED[name]) | rating.to_json()
            for name, rating in self.found.items()
        }
        parts = [part.to_json() for part in self.duty_cycle]
        return {
            "name": self.gearset.name,
            "geometry": self.geometry.to_json(),
            **{name: found.get(name) for name in STANDARDS},
            "self_locking": self.self_locking.to_json(),
            "assumed": dict(self.assumed),
            "notes": list(self.notes),
            "verdict": self.verdict.to_json(),
            "forces": {one.rotation: one.to_json() for one in self.forces} or None,
            "holding": [one.to_json() for one in self.holding],
            **({"duty_cycle": parts} if parts else {}),
            **({} if self.backlash is None else {"backlash": self.backlash.to_json()}),
            **self._of_spectrum(),
        }

    def _of_spectrum(self) -> dict[str, Any]:
        if self.rating_inputs.operation.steps is None:
            return {}
        mean = duty_mean(self.rating_inputs, self.duty_cycle)
        return {
            **({} if mean is None else {"duty_mean": mean.to_json()}),
            "endurance": [one.to_json() for one in self.endurance],
            "starting": [one.to_json() for one in self.starting],
        }

    def to_dataset(self) -> "xr.Dataset":
        """Return every number of every rating, and what else JSON holds."""
        parts = self.to_json()
        numbers = {entry.key for entry in self.entries()}
        for standard in self.found:
            own = parts[standard].items()
            parts[standard] = {key: v for key, v in own if f"{standard}.{key}" not in numbers}
        parts.pop("notes")
        return with_parts(super().to_dataset(), parts, over=("forces",))

    def entries(self) -> Iterator[Entry]:
        """Yield every number of every rating, by ``standard.key``."""
        for standard, rating in self.found.items():
            for number in rating:
                key, name = f"{standard}.{number.key}", f"{standard}_{number.key}"
                of = number.symbol, number.unit, number.meaning
                label = Label(*of, key=key, variable=name)
                name = f"{standard}.{number.symbol or number.key}"
                yield Entry(name, label, number.value, origin=number)

    def views(self) -> dict[str, str]:
        """Return the gearset drawn to scale."""
        from asperity.rating.report import both_views

        along, through = both_views(self)
        return {"gearset": along[0], "section": through[0]}

    def heading(self) -> str:
        """Return the gearset's name, and how it is loaded."""
        name = self.gearset.name or "worm gearset"
        inputs = self.rating_inputs
        return name if inputs.operation.steps is None else f"{name}: {loads_line(inputs)}"

    def __repr__(self) -> str:
        return f"{self.heading()}\n{self.verdict!r}"

    def brief(self) -> str:
        """Return the verdict on one screen."""
        play: tuple[str, ...] = () if self.backlash is None else (self.backlash.sentence(),)
        play += self.shafts.lacking if self.shafts else ()
        shown = self.verdict, self.found, self.self_locking, len(self.assumed), self.notes
        return screen(*shown, power=self.of_power, duty=self.of_duty, play=play)

    def tables(self, *, sources: bool = False) -> tuple[Table, ...]:
        """Return a table a standard, the self-locking and the notes."""
        tables = [rating.table(sources=sources) for rating in self.ratings]
        if self.duty_cycle:
            tables.append(duty_table(self.duty_cycle))
        if self.self_locking.verdicts:
            tables.append(self.self_locking.table())
        tables += beside(self.rows)
        if self.holding:
            tables.append(held_table(self.holding))
        if self.rating_inputs.operation.steps is not None and self.endurance:
            tables.append(endurance_table(self.endurance))
        tables += [starting_table(self.starting)] if self.starting else []
        tables += [] if self.backlash is None else [self.backlash.table()]
        if self.notes:
            tables.append(Table((), (), remarks=self.notes))
        return tuple(tables)

    def sections(self, folder: Path | None = None) -> "tuple[Section, ...]":
        """Return what its report says."""
        from asperity.rating.report import sections

        return tuple(sections(self))

    def to_html(self, heading: "Heading | None" = None, folder: Path | None = None) -> str:
        """Return its report: one page without requests, which prints on A4."""
        from asperity.results.report import report

        return report(f"{self.heading()}, rated", self.sections(folder), heading)

    def to_frame(self) -> Any:
        """Return a pandas data frame of all ratings, indexed by standard and key."""
        import pandas  # type: ignore[import-untyped]

        frames = {name: rating.to_frame() for name, rating in self.found.items()}
        # Attributes are compared when frames are joined, and lists in them have no equality.
        for frame in frames.values():
            frame.attrs = {}
        return pandas.concat(frames, names=["standard", "key"]) if frames else pandas.DataFrame()

    def write(self, folder: Path, *, pictures: str = "png") -> list[str]:
        """Write JSON, netCDF, and for spreadsheets a table and live formulas."""
        from asperity.rating.workbook import write_rating

        names, inputs = super().write(folder, pictures=""), self.rating_inputs
        table = shown_frame(self.to_frame()).map(harmless_cell)
        write_text(folder / "rate.csv", table.to_csv(lineterminator="\n"))
        if len(inputs.duty) > _MOST_SHEETS:
            return [*names, "rate.csv"]
        write_rating(inputs, self.tables_bs721, self.found, folder / "rate.xlsx", self.shafts)
        return [*names, "rate.csv", "rate.xlsx"]
