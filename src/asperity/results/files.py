"""The files of answers: JSON and pictures, each whole or not at all."""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.store import write_atomically, write_text

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def write_json(answer: Mapping[str, Any], path: Path) -> Path:
    """Write one JSON object."""
    return write_text(path, json.dumps(answer, indent=2, allow_nan=False) + "\n")


def write_picture(figure: "Figure", path: Path) -> Path:
    """Write a picture in the format its name ends with."""
    from asperity.results.figures import DOTS_PER_INCH

    return write_atomically(path, lambda target: figure.savefig(target, dpi=DOTS_PER_INCH))
