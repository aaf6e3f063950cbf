"""The cases that ship, found without what it takes to read them."""

import os
from pathlib import Path

from asperity import store


def shipped_cases() -> dict[str, Path]:
    """Return the files of the cases that ship, by name."""
    package = Path(__file__).parent
    # In an editable checkout the folder stands at the root, beside `src`.
    folders = [package / "cases", package.parents[1] / "cases"]
    folder = next((folder for folder in folders if folder.is_dir()), folders[0])
    return {path.stem: path for path in sorted(folder.glob("*.toml"))}


def describe(path: str | os.PathLike[str]) -> str:
    """Return the comment in the first line of a case file."""
    first, _, _ = store.read_text(path).partition("\n")
    return first.removeprefix("#").strip() if first.startswith("#") else ""
