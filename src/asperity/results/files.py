"""The files of answers: JSON and pictures, each whole or not at all."""

import csv
import io
import json
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.errors import InputError, one_of
from asperity.files.store import write_atomically, write_text

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def write_json(answer: Mapping[str, Any], path: Path) -> Path:
    """Write one JSON object."""
    return write_text(path, json.dumps(answer, indent=2, allow_nan=False) + "\n")


def csv_text(rows: Iterable[Iterable[object]]) -> str:
    """Return rows as CSV, numbers to the last digit."""
    text = io.StringIO()
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue()


PICTURES = ("png", "svg", "pdf")
"""What a picture can be written as."""

# The same picture gives the same bytes: no date, no random names; texts of a PDF can be edited.
_UNDATED: Mapping[str, Mapping[str, None]] = {
    ".svg": {"Date": None},
    ".pdf": {"CreationDate": None},
}
_LASTING: dict[Any, Any] = {"svg.hashsalt": "asperity", "pdf.fonttype": 42}


def picture_format(name: str) -> str:
    """Return what pictures are to be written as; raises InputError for what they cannot be."""
    if name not in PICTURES:
        raise InputError(f"--format {name}: {one_of(PICTURES, name)}")
    return name


def write_picture(figure: "Figure", path: Path) -> Path:
    """Write a picture in the format its name ends with."""
    import matplotlib as mpl

    from asperity.results.figures import DOTS_PER_INCH, spoken_figure

    def write(target: Path) -> None:
        with mpl.rc_context(_LASTING):
            undated = _UNDATED.get(path.suffix)
            spoken_figure(figure).savefig(target, dpi=DOTS_PER_INCH, metadata=undated)

    return write_atomically(path, write)


def write_content(path: Path, content: bytes) -> Path:
    """Write bytes, whole or not at all."""
    return write_atomically(path, lambda target: target.write_bytes(content))
