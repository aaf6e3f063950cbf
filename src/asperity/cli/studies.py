"""What ``asperity sensitivity``, ``asperity methods`` and ``asperity optimise`` do."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.casefile import Case, read_case
from asperity.cli import show
from asperity.commands import case_tables
from asperity.errors import ConvergenceError
from asperity.gearset import Gearset
from asperity.rating import Operation, RatingOptions
from asperity.results.files import write_json, write_picture
from asperity.store import output_folder, write_dataset
from asperity.studies import compare_case, optimise, sensitivity, trade_off

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


def run_sensitivity(case: str, settings: Sequence[str], *, as_json: bool, out: Path | None) -> None:
    """Raise one input after the other, print the efficiencies and write them to files."""
    folder = _folder(out)
    read = read_case(case, case_tables(), settings)
    study = sensitivity(*_gearset(read))
    answer = study.to_json()
    if folder is not None:
        _write(folder, "sensitivity", answer, study.to_dataset(), study.plot())
    _show(case, answer, [study.to_rich()], as_json=as_json)


def run_methods(case: str, settings: Sequence[str], *, as_json: bool, out: Path | None) -> None:
    """Compare ways to less friction, print what they are worth and write it to files."""
    folder = _folder(out)
    try:
        study = compare_case(read_case(case, case_tables(), settings))
    except ConvergenceError as error:
        if as_json:
            show.print_json({"error": str(error), "reached": error.reached})
        raise
    answer = study.to_json()
    if folder is not None:
        _write(folder, "methods", answer, study.to_dataset(), study.plot())
    _show(case, answer, [study.to_rich()], as_json=as_json)


def run_optimise(case: str, settings: Sequence[str], *, as_json: bool, out: Path | None) -> None:
    """Find the most efficient design and what torque costs, print both and write them to files."""
    folder = _folder(out)
    read = read_case(case, case_tables(), settings)
    subject = _gearset(read)
    best = optimise(*subject, folder=read.folder)
    curve = trade_off(*subject, folder=read.folder)
    answer = {**best.to_json(), "trade_off": curve.to_json()}
    if folder is not None:
        _write(folder, "optimise", answer, curve.to_dataset(), curve.plot(best))
    _show(case, answer, [best.to_rich(), curve.to_rich()], as_json=as_json)


def _folder(out: Path | None) -> Path | None:
    return None if out is None else output_folder(out)


def _gearset(case: Case) -> tuple[Gearset, Operation, RatingOptions | None]:
    options = case.require(RatingOptions) if RatingOptions.table in case else None
    return case.require(Gearset), case.require(Operation), options


def _write(
    folder: Path, name: str, answer: Mapping[str, Any], dataset: "xr.Dataset", figure: "Figure"
) -> None:
    write_dataset(dataset, folder / f"{name}.nc")
    write_picture(figure, folder / f"{name}.png")
    write_json(answer, folder / f"{name}.json")
    show.note(f"written to {folder}: {name}.nc, {name}.png, {name}.json")


def _show(case: str, answer: Mapping[str, Any], parts: Sequence[Any], *, as_json: bool) -> None:
    if as_json:
        show.print_json(answer)
        return
    from rich.console import Console

    console = Console(highlight=False, markup=False)
    show.print_text(f"{case}: {answer['name'] or 'worm gearset'}")
    for part in parts:
        with console.capture() as capture:
            console.print(part)
        show.print_text("\n" + "\n".join(line.rstrip() for line in capture.get().splitlines()))
