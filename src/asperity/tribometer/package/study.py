"""The command ``asperity rig package``: a folder of recordings as a repository takes it."""

import dataclasses
import datetime
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from typing import Any

from asperity.casefile import Case
from asperity.casefile.written import written
from asperity.errors import InputError, plain
from asperity.results.report import Heading
from asperity.runs import Run
from asperity.tribometer.deposit import Package
from asperity.tribometer.journal_lines import NAME
from asperity.tribometer.package.instruments import instruments
from asperity.tribometer.package.metadata import CRATE, DATACITE, About
from asperity.tribometer.package.result import SUMS, ZIPPED, Content, Packaged
from asperity.tribometer.parameters import Conditions
from asperity.tribometer.report import study as report
from asperity.tribometer.report.result import Report
from asperity.tribometer.report.study import Gathered

_RECORDINGS, _RESULTS = "recordings", "results"
_OWN = NAME, _RECORDINGS, _RESULTS, DATACITE, CRATE, SUMS, ZIPPED  # of a package, or of a run
_MEANINGS = {
    "reduce.json": "What vibration did in each segment: numbers with units in their names.",
    "reduce.nc": "The same, with units, meanings and uncertainties of every number.",
    "reduce.csv": "The same, a row a segment.",
    "measurements.csv": "Ratios of torque with their conditions, as a fit takes them.",
    "budget.csv": "What each number is uncertain by, after the GUM.",
}


@dataclasses.dataclass(frozen=True)
class Packing:
    """What is packed.

    Attributes
    ----------
    gathered : Gathered
        The recordings.
    zipped : bool
        Whether one file is made of it.
    """

    gathered: Gathered
    zipped: bool


def prepare(case: Case, archive: bool = False, **_: Any) -> Packing:
    """Refuse what no repository would take."""
    gathered = report.prepare(case)
    gathered.get(Package, Package()).complete()
    return Packing(gathered, archive)


def answer(problem: Packing, run: Run) -> Packaged:
    """Reduce the recordings and lay the package out."""
    if run.folder is None:
        raise InputError("a package needs --out DIR: a new or empty folder")
    if there := [name for name in _OWN if (run.folder / name).exists()]:
        raise InputError(
            f"{plain(str(run.folder))} has {there[0]} already; give --out a new or empty folder"
        )
    gathered = problem.gathered
    found = report.answer(gathered, run)
    package = gathered.get(Package, Package())
    recordings = [one.recording for one in gathered.reducible]
    folder = recordings[0].path.parent
    used = instruments(gathered, recordings)
    days = sorted(one.start.date() for one in recordings)
    today = datetime.datetime.now(datetime.UTC).date()
    about = About(
        package, package.description or _description(found, gathered), days[0], days[-1], today,
        "", used,
    )  # fmt: skip
    contents = [
        *(Content(f"{_RECORDINGS}/{one.path.name}", f"Recording begun {one.start.isoformat()}.",
                  one.path) for one in recordings),
        *_beside(folder),
        Content("case.toml", "Configuration of the first recording; each holds its own.",
                _case(gathered).encode()),
    ]  # fmt: skip
    # Whose folder it was is nobody's business but theirs.
    named = dataclasses.replace(gathered, source=plain(folder.absolute().name))
    heading = Heading.of(named, version("asperity"))
    return Packaged(
        report=found, head=heading, about=about, contents=tuple(contents),
        zipped=problem.zipped, notes=tuple(_notes(gathered, found, about)),
        meanings=tuple(_MEANINGS.items()), results=_RESULTS,
    )  # fmt: skip


def _beside(folder: Path) -> Iterator[Content]:
    if (folder / NAME).is_file():
        yield Content(NAME, "Journal of the run: every step, a line each.", folder / NAME)


def _case(case: Case) -> str:
    return written(case.raw, "Configuration of the first recording")


def _description(report: Report, case: Case) -> str:
    told = "; ".join(f"{name}: {value}" for name, value in report.conditions)
    return (
        f"Recordings of a disc-on-disc tribometer with imposed vibration, and their reduction: "
        f"{report.recordings} recordings, {report.measured} segments. {told}."
    )


def _notes(case: Case, report: Report, about: About) -> Iterator[str]:
    yield from report.notes
    yield from (f"{what} is left out: {why}" for what, why in report.refused)
    package = about.package
    if not package.publisher:
        yield "package.publisher is not told; DataCite's word for that is in its place (:unav)"
    if not package.doi:
        yield "no DOI is reserved (package.doi); a name of the content stands in its place"
    nameless = [one.use for one in about.instruments if not one.serial]
    if nameless:
        yield f"no serial number is told of: {', '.join(nameless)}"
    if Conditions.table not in case:
        yield "no [conditions] are told: neither laboratory nor air"
