"""What ``asperity size`` does."""

import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path

from asperity import __version__
from asperity.casefile.case import Case, naming_source, read_raw
from asperity.casefile.overruled import overruled
from asperity.casefile.project import Project
from asperity.cli import show
from asperity.cli.new import OTHER_FORMS, given_to
from asperity.commands import case_tables
from asperity.commands.shown import check_shown, shown_as
from asperity.files.store import output_folder, write_text
from asperity.results.report import Heading
from asperity.start.borne import with_bearings
from asperity.start.duty import complete, duty
from asperity.start.gear import proposals, ratio_of
from asperity.start.kinds import kind_of
from asperity.start.write import case_text
from asperity.studies.proposed import Proposals


def size(
    case: str,
    ratio: str,
    operation_options: Mapping[str, str | None],
    settings: Sequence[str],
    rank: str,
    locks: str,
    shown: tuple[str, str],
    *,
    cut: bool,
    as_json: bool,
    out: Path | None,
) -> None:
    """Print gearsets for a duty, and write each one as a case.

    The duty is that of a case, if one is named, with what is asked by key of the operation and set
    in its place. An empty ratio is that of ``requirements``; ``cut`` leaves out what no hob cuts;
    units and language, where they are ``shown``, take the place of the project's.
    """
    check_shown(*shown)
    values = duty(case)
    given_to(values, operation_options, settings)
    wanted = ratio_of(ratio) if ratio else None
    origin = {setting.partition("=")[0].strip(): setting for setting in settings}
    known = case_tables()
    written = read_raw(case, known)[0].written if case else frozenset()
    asking = Case(case or "size", Path(), {}, values, known, origin, written=written)
    options = {
        f"operation.{key}": f"--{key.replace('_', '-')} {text}"
        for key, text in operation_options.items()
        if text is not None
    }
    for line in overruled(asking, options):
        show.note(line)
    with naming_source(asking):
        complete(values)
        found = proposals(values, wanted, rank, cut=cut, locks=locks)
    folder = Path(case).parent if case else Path()

    def saved(to: Path) -> None:
        show.note(show.said(_written(found, asking, to, ratio)))

    with (
        shown_as(Project.model_validate(values.get("project", {})), folder, *shown),
        show.files_first(None if out is None else lambda: saved(out)),
    ):
        if as_json:
            show.print_json(found.to_json())
        else:
            show.print_tables(found.tables())


def _written(proposals: Proposals, asking: Case, out: Path, ratio: str) -> str:
    """Write proposals to a folder, each also as a case; returns what is to be said of it."""
    folder, values = output_folder(out), asking.raw
    kind, names = kind_of("gear"), proposals.write(folder, pictures="")
    for place, proposal in enumerate(proposals.found, 1):
        kept = {k: v for k, v in values["gearset"].items() if k not in OTHER_FORMS}
        mine = {**with_bearings(values, proposal.bearings), "gearset": {**kept, **proposal.keys}}
        tables = (*kind.tables, *(name for name in mine if name not in kind.tables))
        text = case_text(f"Proposal {place}", mine, case_tables(), tables)
        names.append(write_text(folder / f"proposal-{place}.toml", text).name)
    heading = Heading.of(asking, __version__)
    given = {"ratio": ratio, **heading.given} if ratio else heading.given
    report = proposals.to_html(dataclasses.replace(heading, given=given), folder)
    names.append(write_text(folder / "report.html", report).name)
    return f"written to {folder}: {', '.join(names)}"
