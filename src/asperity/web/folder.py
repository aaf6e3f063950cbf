"""The one folder of a page: its cases, its uploads and its jobs, and nothing outside it."""

import re
from pathlib import Path

from asperity.errors import InputError, shown
from asperity.files.shipped import shipped_case
from asperity.files.store import portable, require_portable

CASE = ".toml"
ENDINGS = (
    CASE,
    ".csv",
    ".txt",
    ".asc",
    ".lvm",
    ".dat",
    ".nc",
    ".mat",
    ".tdms",
    ".wav",
    ".sr",
    ".mf4",
)
"""Of files that a browser may put there: cases, and what oscilloscopes write."""

MOST_FILE = 256_000_000
"""Bytes of a file that is put there."""

STATE, REQUEST, ANSWER, SO_FAR = "state.json", "request.json", "answer.json", "so-far.nc"
"""A job's own files, beside those of its answer."""

_JOB = re.compile(r"[0-9a-f]{32}")


class Folder:
    """A folder and what may be named in it.

    Parameters
    ----------
    path : path
        The folder, which exists.
    """

    def __init__(self, path: Path) -> None:
        self.path = path.resolve()

    def file(self, name: str) -> Path:
        """Return a file of the folder by its name, there or not; refuses any other name."""
        require_portable(name)
        if not name.lower().endswith(ENDINGS):
            raise InputError(f"{name}: it must end in {', '.join(ENDINGS)}")
        return self.inside(name)

    def inside(self, name: str | Path) -> Path:
        """Return what a name means in the folder; refuses what lies outside, also by a link."""
        try:
            path = (self.path / name).resolve()
        except (OSError, ValueError, RuntimeError):
            raise InputError(f"{shown(str(name))} is not the name of a file") from None
        if not path.is_relative_to(self.path):
            raise InputError(
                f"{shown(str(name))} lies outside the folder of this page; put it there first"
            )
        return path

    @property
    def jobs(self) -> Path:
        """Where jobs are."""
        return self.inside("jobs")

    def job(self, identity: str) -> Path:
        """Return the folder of a job, there or not; refuses what is no job's name."""
        if not _JOB.fullmatch(identity):
            raise InputError(f"{shown(identity)} is not the name of a job")
        return self.inside(self.jobs / identity)

    def files(self) -> list[str]:
        """Return the names of its files that may be opened."""
        return sorted(
            path.name
            for path in self.path.iterdir()
            if path.name.lower().endswith(ENDINGS)
            and portable(path.name)
            and not path.is_symlink()
            and path.is_file()
        )

    def case(self, name: str) -> Path:
        """Return the file of a case: one that ships, or one of the folder."""
        shipped = shipped_case(name)
        if shipped is not None:
            return shipped
        path = self.file(name if name.endswith(CASE) else f"{name}{CASE}")
        if not path.is_file():
            raise InputError(f"{name} is neither a case that ships nor a file of this folder")
        return path

    def case_name(self, name: str) -> str:
        """Return by what a case is read: the name of one that ships, or of a file of the folder."""
        path = self.case(name)
        return path.name if path.parent == self.path else name

    @property
    def thesis(self) -> Path:
        """Where ``asperity thesis`` writes if it is not told otherwise."""
        return self.inside("out/thesis")

    def thesis_file(self, name: str) -> Path:
        """Return a file that ``asperity thesis`` left, there or not."""
        require_portable(name)
        return self.inside(self.thesis / name)
