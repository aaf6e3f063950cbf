"""The table ``[package]``: what a repository asks of whoever deposits data."""

import dataclasses
import datetime
import re
from typing import ClassVar

from pydantic import model_validator

from asperity.casefile import Table
from asperity.errors import InputError, nearest, shown

_ORCID = re.compile(r"(?:https?://orcid\.org/)?(\d{4}-\d{4}-\d{4}-\d{3}[\dX])")
_LICENCES = (
    "CC-BY-4.0", "CC0-1.0", "CC-BY-SA-4.0", "CC-BY-NC-4.0", "CC-BY-NC-SA-4.0", "CC-BY-ND-4.0",
    "CC-BY-NC-ND-4.0", "CC-BY-3.0", "CC-BY-SA-3.0", "PDDL-1.0", "ODbL-1.0", "ODC-By-1.0",
    "CDLA-Permissive-2.0", "CDLA-Sharing-1.0", "etalab-2.0", "OGL-UK-3.0", "DL-DE-BY-2.0",
    "DL-DE-ZERO-2.0", "MIT", "Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "MPL-2.0", "EUPL-1.2",
    "GPL-2.0-only", "GPL-2.0-or-later", "GPL-3.0-only", "GPL-3.0-or-later", "LGPL-3.0-only",
    "LGPL-3.0-or-later", "AGPL-3.0-only", "AGPL-3.0-or-later", "Unlicense",
)  # fmt: skip
# What `asperity new` writes until somebody replaces it; a licence it leaves open, for who chooses.
BEGUN_TITLE = "(title of these data)"
BEGUN_AUTHORS = ("Doe, Jane",)
_DOI = re.compile(r"10\.\d{4,9}/\S+")
_AUTHOR = '"Doe, Jane; 0000-0002-1825-0097; University of Somewhere"'


@dataclasses.dataclass(frozen=True)
class Person:
    """Somebody who made data.

    Attributes
    ----------
    family, given : str
        The name; of a group all of it is in the first.
    orcid, affiliation : str
        As far as they are told.
    """

    family: str
    given: str = ""
    orcid: str = ""
    affiliation: str = ""

    @property
    def name(self) -> str:
        """Family name first."""
        return f"{self.family}, {self.given}" if self.given else self.family

    @classmethod
    def read(cls, text: str) -> "Person":
        """Return who is told as "Family, Given; ORCID; affiliation", the last two at will.

        Raises
        ------
        InputError
            There is no name, or an ORCID whose check digit is wrong.
        """
        name, *others = (part.strip() for part in text.split(";"))
        family, _, given = (part.strip() for part in name.partition(","))
        if not family:
            raise InputError(f"{shown(text)} has no name; give it as {_AUTHOR}")
        orcid = affiliation = ""
        for part in filter(None, others):
            found = _ORCID.fullmatch(part)
            if found is None:
                affiliation = f"{affiliation}; {part}" if affiliation else part
            elif not _is_orcid(found[1]):
                raise InputError(f"{shown(part)} is no ORCID: its last digit does not fit")
            else:
                orcid = found[1]
        return cls(family, given, orcid, affiliation)


def _is_orcid(text: str) -> bool:
    """Return whether the check digit fits, by ISO 7064 (11, 2)."""
    total = 0
    for digit in text.replace("-", "")[:-1]:
        total = 2 * (total + int(digit))
    return text[-1] == "0123456789X"[(12 - total % 11) % 11]


class Package(Table):
    """What stands on a package of data.

    Parameters
    ----------
    title : str
        Of the data.
    authors : list of str
        Each as "Family, Given; ORCID; affiliation", the last two at will.
    licence : str
        Its identifier by SPDX, such as "CC-BY-4.0"; one of those that are common.
    description : str
        What was measured, and what for.
    keywords : list of str
        To find it by.
    publisher : str
        The repository; left out where it is not known yet.
    date : date, optional
        Of publication; left out, that of the package.
    doi : str
        Of the data, where one is reserved.
    related : list of str
        DOIs of what belongs to it, such as a paper.
    funding : list of str
        Funder, or "funder; number of the grant".
    instruments : list of str
        What no channel names, as "PicoScope 4824A; serial number; what it does".
    """

    table: ClassVar[str] = "package"
    counts: ClassVar[bool] = False

    title: str = ""
    authors: tuple[str, ...] = ()
    licence: str = ""
    description: str = ""
    keywords: tuple[str, ...] = ()
    publisher: str = ""
    date: datetime.date | None = None
    doi: str = ""
    related: tuple[str, ...] = ()
    funding: tuple[str, ...] = ()
    instruments: tuple[str, ...] = ()

    @model_validator(mode="after")
    def _reads(self) -> "Package":
        if self.licence and self.licence not in _LICENCES:
            near = nearest(self.licence, _LICENCES)
            raise InputError(
                f"package.licence is {shown(self.licence)}, no identifier of SPDX that is known "
                f"here{near}"
            )
        for text in self.authors:
            try:
                Person.read(text)
            except InputError as error:
                raise InputError(f"package.authors: {error}") from None
        for key, dois in (("doi", (self.doi,)), ("related", self.related)):
            for doi in filter(None, dois):
                if not _DOI.fullmatch(doi):
                    raise InputError(
                        f"package.{key} is {shown(doi)}; a DOI begins with 10., as "
                        "10.5281/zenodo.1234"
                    )
        return self

    @property
    def people(self) -> tuple[Person, ...]:
        """The authors."""
        return tuple(map(Person.read, self.authors))

    def complete(self) -> None:
        """Refuse a package that no repository would take; raises InputError."""
        wanted = {
            "title": '"Friction under vibration"', "authors": f"[{_AUTHOR}]",
            "licence": '"CC-BY-4.0"',
        }  # fmt: skip
        missing = [name for name in wanted if not getattr(self, name)]
        begun = []
        if self.title == BEGUN_TITLE:
            begun.append("title")
        if set(self.authors) & set(BEGUN_AUTHORS):
            begun.append("authors")
        if missing or begun:
            said = []
            if begun:
                said.append(f"{_keys(begun)} what asperity new wrote for an example")
            if missing:
                said.append(f"{_keys(missing)} missing")
            told = ", ".join(
                f"{name} = {wanted[name]}" for name in wanted if name in begun + missing
            )
            raise InputError(
                f"{', and '.join(said)}, without which no repository takes data; give them in a "
                f"case by --config, as in {told}"
            )


def _keys(names: list[str]) -> str:
    """Return keys as the beginning of a sentence, with its verb."""
    *others, last = (f"package.{name}" for name in names)
    return f"{', '.join(others)} and {last} are" if others else f"{last} is"
