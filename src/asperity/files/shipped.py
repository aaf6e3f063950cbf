"""The cases that ship, found without what it takes to read them."""

import os
from collections.abc import Mapping
from pathlib import Path

from asperity.errors import InputError, nearest, plain
from asperity.files import store

SPEAKING: Mapping[str, str] = {
    "body-shaken-along": "table-4.3",
    "body-shaken-across": "table-4.4",
    "rigid-drive-slow": "table-4.1-L1",
    "rigid-drive-fast": "table-4.1-L2",
    "pin-on-disc": "normal-pin",
    "pin-under-a-machine": "normal-machine",
    "conveyed-body": "oblique",
    "block-shaken-along": "block-longitudinal",
    "block-shaken-across": "block-transverse",
    "worm-15-to-1": "gearset-3",
    "worm-60-to-1": "gearset-2",
    "worm-flanks": "gearset-3b",
    "worm-shaken-as-a-screw": "drive-screw",
    "worm-shaken-along-its-axis": "drive-thesis",
    "valve-actuator": "drive-actuator",
    "disc-on-disc": "rig-final",
    "disc-on-disc-dry": "rig-preliminary",
    "worm-on-a-rig": "rig-gear",
}
"""Names that say what a case is, beside those by which the thesis's tables are found."""


def shipped_cases() -> dict[str, Path]:
    """Return the files of the cases that ship, by the name of the file."""
    return _shipped(".toml")


def shipped_points() -> dict[str, Path]:
    """Return the tables of points that ship, by the name of the file: that of their case."""
    return _shipped(".csv")


def _shipped(kind: str) -> dict[str, Path]:
    package = Path(__file__).parents[1]
    # In an editable checkout the folder stands at the root, beside `src`.
    folders = [package / "cases", package.parents[1] / "cases"]
    folder = next((folder for folder in folders if folder.is_dir()), None)
    if folder is None:
        return {}
    # Names, of which a run of the thesis asks hundreds of times: paths take five times as long.
    names = sorted(name for name in os.listdir(folder) if name.endswith(kind))
    return {name.removesuffix(kind): folder / name for name in names}


def shipped_case(name: str) -> Path | None:
    """Return the file of a case that ships, by either of its names; None for any other."""
    return shipped_cases().get(SPEAKING.get(name, name))


def case_file(name_or_path: str | os.PathLike[str]) -> Path:
    """Return the file that a case is read from: one of that path before one that ships."""
    shipped = shipped_case(str(name_or_path))
    path = Path(name_or_path)
    # In this order, since the system may refuse to look for a name.
    return path if shipped is None or path.is_file() else shipped


def points_file(name_or_path: str | os.PathLike[str]) -> Path:
    """Return the file that points of a sweep are read from: as `case_file`."""
    path = Path(name_or_path)
    shipped = shipped_points().get(str(name_or_path))
    return path if shipped is None or path.is_file() else shipped


def case_text(name: str) -> str:
    """Return the text of a case that ships; raises InputError for another name."""
    path = shipped_case(name)
    if path is None:
        known = nearest(name.removesuffix(".toml"), (*shipped_cases(), *SPEAKING))
        raise InputError(f"{plain(name)} is not a case that ships{known}")
    return store.read_text(path)


def describe(path: str | os.PathLike[str]) -> str:
    """Return the comment in the first line of a case file."""
    first, _, _ = store.read_text(path).partition("\n")
    return first.removeprefix("#").strip() if first.startswith("#") else ""
