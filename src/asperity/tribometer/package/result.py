"""The answer of ``asperity rig package``: what is in it, and how it comes to the disk."""

import contextlib
import dataclasses
import functools
import hashlib
import json
import shutil
import tempfile
import uuid
import zipfile
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from asperity.files.store import write_atomically
from asperity.results import Result
from asperity.results.report import Heading
from asperity.results.table import Table
from asperity.tribometer.package.metadata import (
    CRATE,
    DATACITE,
    About,
    Item,
    crate,
    datacite,
    licence_url,
)
from asperity.tribometer.report.result import Report

SUMS, ZIPPED = "manifest-sha256.txt", "package.zip"
_EPOCH = (1980, 1, 1, 0, 0, 0)  # of files in an archive, so that the same content is the same file


@dataclasses.dataclass(frozen=True)
class Content:
    """A file on its way into a package: where it goes, what it holds, and that or where it is."""

    path: str
    meaning: str
    of: Path | bytes

    def item(self) -> Item:
        """Return what metadata tell of it."""
        if isinstance(self.of, bytes):
            digest, size = hashlib.sha256(self.of).hexdigest(), len(self.of)
        else:
            with self.of.open("rb") as file:
                digest = hashlib.file_digest(file, "sha256").hexdigest()
            size = self.of.stat().st_size
        return Item(self.path, self.meaning, size, digest)


class Packaged(Result):
    """A package of data.

    Attributes
    ----------
    report : Report
        The recordings, reduced.
    head : Heading
        Of its page.
    about : About
        What metadata tell.
    contents : tuple of Content
        What is packed beside results and metadata.
    zipped : bool
        Whether one file is made of it.
    meanings : tuple of (str, str)
        What the files of the results hold.
    results : str
        The folder of these.
    """

    title = "Package of a series of tests"
    stem = "package"
    # It stands among the results in it.
    reported = False

    report: Report
    head: Heading
    about: About
    contents: tuple[Content, ...]
    zipped: bool
    meanings: tuple[tuple[str, str], ...]
    results: str

    def to_json(self) -> dict[str, Any]:
        """Return what it is called, by whom, under which licence, and what is measured with."""
        package = self.about.package
        return {
            "title": package.title, "authors": [one.name for one in package.people],
            "licence": package.licence, "licence_url": licence_url(package.licence),
            "recordings": self.report.recordings, "segments": self.report.measured,
            "instruments": [one.to_json() for one in self.about.instruments],
            "notes": list(self.notes),
        }  # fmt: skip

    def tables(self) -> tuple[Table, ...]:
        """Return what stands on it, and the instruments."""
        package = self.about.package
        rows = (
            ("title", package.title),
            ("authors", "; ".join(one.name for one in package.people)),
            ("licence", package.licence), ("DOI", package.doi or "not reserved"),
            ("recordings", self.report.recordings), ("segments", self.report.measured),
        )  # fmt: skip
        devices = [
            (one.name or "not recorded", one.serial or "not recorded", one.use)
            for one in self.about.instruments
        ]
        return (
            Table.of(("", ""), rows, left=2),
            Table.of(("instrument", "serial number", "use"), devices, left=3, title="Instruments",
                     remarks=self.notes),
        )  # fmt: skip

    def write(self, folder: Path, *, pictures: str = "png") -> list[str]:
        """Write the package; the check sums last."""
        with tempfile.TemporaryDirectory() as made:
            contents = [*self.contents, *self._results(Path(made))]
            contents += self._metadata(contents)
            if self.zipped:
                write_atomically(folder / ZIPPED, lambda target: _zip(contents, target))
                return [ZIPPED]
            with _whole(folder) as written:
                for one in contents:
                    path = folder / one.path
                    path.parent.mkdir(exist_ok=True)
                    written.append(path)
                    write_atomically(path, functools.partial(_put, one.of))
        return [one.path for one in contents]

    def _results(self, folder: Path) -> Iterator[Content]:
        meanings = dict(self.meanings)
        for name in self.report.write(folder):
            yield Content(f"{self.results}/{name}", meanings.get(name, ""), folder / name)
        page = self.report.to_html(self.head).encode()
        yield Content(f"{self.results}/report.html", "All of it on one page.", page)

    def _metadata(self, contents: Sequence[Content]) -> list[Content]:
        devices = [one.to_json() for one in self.about.instruments]
        made = [
            Content("instruments.json", "What was measured with, and the calibrations.",
                    _json(devices)),
            Content("LICENSE.txt", "Under which terms these data may be used.", self._licence()),
            Content("README.txt", "What is here.", self._readme()),
        ]  # fmt: skip
        items = [one.item() for one in (*contents, *made)]
        # One name for one content, whenever it is packed.
        sums = "".join(sorted(one.sha256 for one in items))
        name = uuid.uuid5(uuid.NAMESPACE_OID, sums).urn
        about = dataclasses.replace(self.about, identifier=name)
        cited = Content(DATACITE, "What a DOI is registered with.", _json(datacite(about, items)))
        items.append(cited.item())
        described = Content(CRATE, "What every file is.", _json(crate(about, items)))
        items.append(described.item())
        sums = "".join(f"{one.sha256}  {one.path}\n" for one in items)
        return [*made, cited, described, Content(SUMS, "Check sums.", sums.encode())]

    def _licence(self) -> bytes:
        licence = self.about.package.licence
        return f"{licence}\n{licence_url(licence)}\n".encode()

    def _readme(self) -> bytes:
        package = self.about.package
        lines = (
            package.title, "", "; ".join(one.name for one in package.people),
            f"Licence: {package.licence}, {licence_url(package.licence)}", "",
            self.about.description, "",
            "recordings/  netCDF-4 files: counts of every channel, events, configuration;",
            "             the package's documentation has their layout and a short reader",
            f"{self.results}/     the same reduced, with intervals and budgets of uncertainty",
            "case.toml    the rig's configuration",
            f"Check sums: sha256sum -c {SUMS}", "",
            *(f"Note: {one}" for one in self.notes),
        )  # fmt: skip
        return ("\n".join(lines) + "\n").encode()


@contextlib.contextmanager
def _whole(package: Path) -> Iterator[list[Path]]:
    """Leave nothing of a package that could not be written: another attempt would refuse it."""
    written: list[Path] = []
    try:
        yield written
    except BaseException:
        with contextlib.suppress(OSError):
            for path in written:
                path.unlink(missing_ok=True)
        for folder in {path.parent for path in written} - {package}:
            # One that holds something else, or all of it, stays.
            with contextlib.suppress(OSError):
                folder.rmdir()
        raise


def _json(value: Any) -> bytes:
    return (json.dumps(value, indent=2, ensure_ascii=False, allow_nan=False) + "\n").encode()


def _put(of: Path | bytes, target: Path) -> None:
    if isinstance(of, bytes):
        target.write_bytes(of)
    else:
        shutil.copyfile(of, target)


def _zip(contents: Sequence[Content], target: Path) -> None:
    with zipfile.ZipFile(target, "w", zipfile.ZIP_DEFLATED) as archive:
        for one in contents:
            entry = zipfile.ZipInfo(one.path, _EPOCH)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            with archive.open(entry, "w", force_zip64=True) as into:
                if isinstance(one.of, bytes):
                    into.write(one.of)
                else:
                    with one.of.open("rb") as file:
                        shutil.copyfileobj(file, into)
