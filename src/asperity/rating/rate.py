"""Rate a worm gearset by up to three standards."""

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

from asperity.casefile import Case, told
from asperity.errors import InputError, choices, require_types, suggestion
from asperity.gearset.geometry import Geometry
from asperity.gearset.library import find
from asperity.gearset.lubricants import Lubricant
from asperity.gearset.materials import WheelMaterial
from asperity.gearset.parameters import Gearset
from asperity.gearset.tolerancing.backlash import Backlash, backlash
from asperity.gearset.tolerancing.table import Tolerances
from asperity.rating.alternatives import Alternative, alternatives
from asperity.rating.bs721.tables import Tables
from asperity.rating.by_standard import PROMISED, judge_of, rate_by
from asperity.rating.changes import changed_words
from asperity.rating.driven import driven, told_of
from asperity.rating.duty import DutyPart, duty_parts, duty_table
from asperity.rating.entries import assumptions
from asperity.rating.forces import Forces, forces
from asperity.rating.holding import Holding, held_table, holding
from asperity.rating.inputs import Inputs, inputs
from asperity.rating.levers import Lever, levers
from asperity.rating.parameters import Operation, RatingOptions
from asperity.rating.result import Rating
from asperity.rating.self_locking import SelfLocking, self_locking
from asperity.rating.verdict import Verdict, screen
from asperity.rating.wanted import STANDARDS, known_standards, require_consistent, tables_of
from asperity.results import Result
from asperity.results.quantity import Entry, Label
from asperity.results.system import converted, system
from asperity.results.table import Column, Table
from asperity.runs import Run
from asperity.store import harmless_cell, write_text

if TYPE_CHECKING:
    from asperity.results.report import Heading, Section

ALL = "all"


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
    given : Inputs
        What the formulas started from.
    tables_bs721 : Tables
        Those of BS 721.
    unanswered : mapping of str to str
        Why a standard that was asked for could not be applied.
    contact : Section or None
        What its report shows of how the flanks touch, where that was asked for.
    backlash : Backlash or None
        What the tolerances leave of it, where there are any.
    """

    title: ClassVar[str] = "Worm gearset, rated"
    stem: ClassVar[str] = "rate"
    reported: ClassVar[bool] = True

    gearset: Gearset
    geometry: Geometry
    iso14521: Rating | None
    bs721: Rating | None
    agma6034: Rating | None
    self_locking: SelfLocking
    assumed: Mapping[str, str]
    levers: tuple[Lever, ...] = ()
    alternatives: tuple[Alternative, ...] = ()
    given: Inputs
    tables_bs721: Tables
    unanswered: Mapping[str, str] = dataclasses.field(default_factory=dict)
    contact: "Section | None" = None
    backlash: Backlash | None = None

    @property
    def verdict(self) -> Verdict:
        """Whether it holds by each standard, and what fails first."""
        return Verdict.of(
            self.found,
            self.levers,
            self.alternatives,
            self.given.operation.wear_assumed,
            self.unanswered,
        )

    @property
    def forces(self) -> tuple[Forces, ...]:
        """What shafts and bearings carry in each direction of rotation, by ISO/TR 14521."""
        return () if self.iso14521 is None else forces(self.given, self.iso14521)

    @property
    def holding(self) -> tuple[Holding, ...]:
        """What a brake on the worm must bring to hold the load when the motor stops."""
        return holding(self.given, self.self_locking)

    @property
    def duty_cycle(self) -> tuple[DutyPart, ...]:
        """What each part of a duty cycle has in wear and heat, by ISO/TR 14521."""
        return () if self.iso14521 is None else duty_parts(self.given, self.iso14521)

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
        }

    def entries(self) -> Iterator[Entry]:
        """Yield every number of every rating, by ``standard.key``."""
        for standard, rating in self.found.items():
            for number in rating:
                label = Label(
                    number.symbol,
                    number.unit,
                    number.meaning,
                    key=f"{standard}.{number.key}",
                    variable=f"{standard}_{number.key}",
                )
                name = f"{standard}.{number.symbol or number.key}"
                yield Entry(name, label, number.value, origin=number)

    def views(self) -> dict[str, str]:
        """Return the gearset drawn to scale."""
        from asperity.gearset.drawing import along_the_wheel, through_the_wheel

        along, through = along_the_wheel(self.geometry), through_the_wheel(self.geometry)
        return {"gearset": along[0], "section": through[0]}

    def heading(self) -> str:
        """Return the gearset's name."""
        return self.gearset.name or "worm gearset"

    def __repr__(self) -> str:
        return f"{self.heading()}\n{self.verdict!r}"

    def brief(self) -> str:
        """Return the verdict on one screen."""
        return screen(
            self.verdict,
            self.found,
            self.self_locking,
            len(self.assumed),
            self.notes,
            () if self.backlash is None else (self.backlash.sentence(),),
        )

    def tables(self, *, sources: bool = False) -> tuple[Table, ...]:
        """Return a table a standard, the self-locking and the notes."""
        tables = [rating.table(sources=sources) for rating in self.ratings]
        if self.duty_cycle:
            tables.append(duty_table(self.duty_cycle))
        rows = self.self_locking.to_rows()
        if rows:
            degrees = self.self_locking.to_json()["lead_angle_deg"]
            columns = tuple(Column(name) for name in rows[0])
            title = f"Self-locking at a lead angle of {degrees:.4g} deg"
            tables.append(Table(columns, tuple(tuple(row.values()) for row in rows), title))
        if self.holding:
            tables.append(held_table(self.holding))
        if self.backlash is not None:
            tables.append(self.backlash.table())
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

        names = super().write(folder, pictures="")
        frame = self.to_frame()
        if system() == "us":
            pairs = zip(frame["value"], frame["unit"], strict=True)
            frame[["value", "unit"]] = [converted(value, unit) for value, unit in pairs]
        table = frame.map(harmless_cell)
        write_text(folder / "rate.csv", table.to_csv(lineterminator="\n"))
        write_rating(self.given, self.tables_bs721, self.found, folder / "rate.xlsx")
        return [*names, "rate.csv", "rate.xlsx"]


def rate(
    gearset: Gearset,
    operation: Operation,
    options: RatingOptions | None = None,
    standards: Sequence[str] = STANDARDS,
    *,
    folder: Path | None = None,
    tolerances: Tolerances | None = None,
) -> Rated:
    """Rate a worm gearset.

    Parameters
    ----------
    gearset : Gearset
        The ``[gearset]`` table.
    operation : Operation
        The ``[operation]`` table.
    options : RatingOptions, optional
        The ``[rating]`` table.
    standards : sequence of {'iso14521', 'bs721', 'agma6034'}
        Which to apply.
    folder : path, optional
        Where a relative file name among the options starts.
    tolerances : Tolerances, optional
        The ``[tolerances]`` table, which leaves a backlash.

    Returns
    -------
    Rated
        A standard that cannot be applied is None, and the notes say why.

    Raises
    ------
    InputError
        The gearset's numbers do not belong together, or the only standard asked for cannot be
        applied; `asperity.rating.iso14521.film_failure.FilmParameterError` where h* is
        not above zero.
    """
    require_types(
        "rate",
        gearset=(gearset, Gearset),
        operation=(operation, Operation),
        options=(options, RatingOptions | None),
        tolerances=(tolerances, Tolerances | None),
    )
    options = options or RatingOptions()
    wanted = known_standards(standards)
    asked = operation
    operation = driven(gearset, operation, options)
    given = inputs(gearset, operation, options)
    require_consistent(given, "iso14521" in wanted)
    tables = tables_of(given.options, folder)
    found: dict[str, Rating] = {}
    unanswered: dict[str, str] = {}
    steel = gearset.worm_material.taken_for
    notes = (
        []
        if steel is None
        else [f"worm material: {steel.note}, by {steel.name} ({steel.confidence})"]
    )
    for name in wanted:
        try:
            found[name] = rate_by(name, given, tables)
        except InputError as error:
            if len(wanted) == 1:
                raise
            notes.append(f"{name}: {error}")
            unanswered[name] = str(error)
    return Rated(
        levers=(),
        alternatives=(),
        unanswered=unanswered,
        contact=None,
        backlash=None if tolerances is None else backlash(gearset, tolerances, worn(found)),
        given=given,
        tables_bs721=tables,
        gearset=gearset,
        geometry=gearset.geometry,
        **{name: found.get(name) for name in STANDARDS},
        self_locking=self_locking(given, found, tables),
        notes=(*told_of(asked, operation), *notes),
        assumed=assumptions(given),
    )


def rate_case(case: Case, standards: Sequence[str] = STANDARDS) -> Rated:
    """Rate the worm gearset of a case file; as `rate`."""
    options = case.get(RatingOptions)
    gearset, operation = case.require(Gearset), case.require(Operation)
    with told(case):
        return rate(
            gearset,
            operation,
            options,
            standards,
            folder=case.folder,
            tolerances=case.get(Tolerances),
        )


def worn(found: Mapping[str, Rating]) -> float | None:
    """Return how deep the wheel's flanks are worn at the end of the life by ISO/TR 14521, um."""
    iso = found.get("iso14521")
    return None if iso is None or "delta_Wn_mm" not in iso else 1e3 * float(iso["delta_Wn_mm"])


def prepare(case: Case, *, standard: str = ALL) -> tuple[Case, tuple[str, ...]]:
    """Return what the command rates; raises InputError for a standard that is not known."""
    allowed = (*STANDARDS, ALL)
    if standard not in allowed:
        raise InputError(
            f"--standard {standard}: it must be one of {choices(allowed)}"
            f"{suggestion(standard, allowed)}"
        )
    gearset, operation = case.require(Gearset), case.require(Operation)
    options = case.get(RatingOptions, RatingOptions())
    wanted = STANDARDS if standard == ALL else (standard,)
    with told(case):
        operation = driven(gearset, operation, options)
    require_consistent(inputs(gearset, operation, options), "iso14521" in wanted)
    return case, wanted


def answer(problem: tuple[Case, tuple[str, ...]], _: Run) -> Rated:
    """Rate the gearset of a case, and find what moves the least safety."""
    case, standards = problem
    rated = rate_case(case, standards)
    first, given = rated.verdict.first, rated.given
    if first is None:
        return rated
    judge = judge_of(first.demand, given.options, rated.tables_bs721)
    others = alternatives(judge, given.gearset, given.operation)
    return dataclasses.replace(
        rated,
        levers=levers(judge, given.gearset, given.operation),
        alternatives=tuple(_with_changes(rated, one, standards, case.folder) for one in others),
    )


def _with_changes(
    rated: Rated, other: Alternative, standards: Sequence[str], folder: Path | None
) -> Alternative:
    """Return an alternative with what else it changes in the words of the verdict."""
    given, (table, _, key) = rated.given, other.key.partition(".")
    thing = find(Lubricant if key == "lubricant" else WheelMaterial, other.value)
    tables: dict[str, Any] = {"gearset": given.gearset, "operation": given.operation}
    tables[table] = tables[table].model_copy(update={key: thing})
    changed = rate(tables["gearset"], tables["operation"], given.options, standards, folder=folder)
    return other._replace(changes=changed_words(rated, changed))
