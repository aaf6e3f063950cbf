"""Metadata of a package: DataCite 4 for a DOI, and an RO-Crate 1.1 that describes every file."""

import dataclasses
import datetime
import importlib.metadata
import urllib.parse
from collections.abc import Iterator, Sequence
from typing import Any

from asperity.tribometer.deposit import Package, Person
from asperity.tribometer.package.instruments import Instrument

DATACITE, CRATE = "datacite.json", "ro-crate-metadata.json"
_SCHEMA = "http://datacite.org/schema/kernel-4"
_SPECIFICATION = "https://w3id.org/ro/crate/1.1"
_UNKNOWN = ":unav"  # by DataCite's appendix 3: value unavailable, possibly unknown
_ORCID, _DOI = "https://orcid.org/", "https://doi.org/"
_ROOT = "./"
_PROGRAM = "#asperity"
_CREATIVE = "CC-BY", "CC-BY-SA", "CC-BY-NC", "CC-BY-ND", "CC-BY-NC-SA", "CC-BY-NC-ND"
_KINDS = {
    ".nc": "application/x-netcdf", ".json": "application/json", ".jsonl": "application/jsonl",
    ".csv": "text/csv", ".toml": "application/toml", ".html": "text/html", ".txt": "text/plain",
}  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Item:
    """A file of a package.

    Attributes
    ----------
    path : str
        Within the package.
    meaning : str
        What it holds.
    size : int
        Bytes.
    sha256 : str
        Of its content.
    """

    path: str
    meaning: str
    size: int
    sha256: str

    @property
    def identifier(self) -> str:
        """As a URI has it."""
        return urllib.parse.quote(self.path)

    @property
    def kind(self) -> str:
        """Its media type."""
        return _KINDS.get(f".{self.path.rpartition('.')[2]}", "application/octet-stream")


def licence_url(licence: str) -> str:
    """Return where a licence stands.

    Examples
    --------
    >>> licence_url("CC-BY-4.0")
    'https://creativecommons.org/licenses/by/4.0/'
    """
    name, _, version = licence.rpartition("-")
    if licence == "CC0-1.0":
        return "https://creativecommons.org/publicdomain/zero/1.0/"
    if name in _CREATIVE and version == "4.0":
        return f"https://creativecommons.org/licenses/{name[3:].lower()}/4.0/"
    return f"https://spdx.org/licenses/{licence}.html"


@dataclasses.dataclass(frozen=True)
class About:
    """What metadata tell.

    Attributes
    ----------
    package : Package
        As the case has it.
    description : str
        What was measured.
    first, last : date
        Of the recordings.
    today : date
        Of the package.
    identifier : str
        A name of the content, where there is no DOI.
    instruments : tuple of Instrument
        What it was measured with.
    """

    package: Package
    description: str
    first: datetime.date
    last: datetime.date
    today: datetime.date
    identifier: str
    instruments: tuple[Instrument, ...]

    @property
    def published(self) -> datetime.date:
        """When it is published."""
        return self.package.date or self.today


def datacite(about: About, items: Sequence[Item]) -> dict[str, Any]:
    """Return what DataCite's schema asks for a DOI, with what it recommends."""
    package = about.package
    doi = {"identifier": package.doi, "identifierType": "DOI"}
    other = {"identifier": about.identifier, "identifierType": "URN"}
    made: dict[str, Any] = {
        "schemaVersion": _SCHEMA,
        "identifiers": [doi if package.doi else other],
        "creators": [_creator(one) for one in package.people],
        "titles": [{"title": package.title}],
        "publisher": package.publisher or _UNKNOWN,
        "publicationYear": str(about.published.year),
        "types": {"resourceType": "Tribometer recordings", "resourceTypeGeneral": "Dataset"},
        "subjects": [{"subject": word} for word in package.keywords],
        "dates": [
            {"date": f"{about.first}/{about.last}", "dateType": "Collected"},
            {"date": str(about.today), "dateType": "Created"},
        ],
        "rightsList": [
            {"rights": package.licence, "rightsUri": licence_url(package.licence),
             "rightsIdentifier": package.licence, "rightsIdentifierScheme": "SPDX",
             "schemeUri": "https://spdx.org/licenses/"},
        ],
        "descriptions": [{"description": about.description, "descriptionType": "Abstract"}],
        "formats": sorted({one.kind for one in items}),
        "sizes": [f"{sum(one.size for one in items)} bytes", f"{len(items)} files"],
        "relatedIdentifiers": [
            {"relatedIdentifier": doi, "relatedIdentifierType": "DOI",
             "relationType": "IsSupplementTo"} for doi in package.related
        ],
        "fundingReferences": [_funding(text) for text in package.funding],
    }  # fmt: skip
    return {key: value for key, value in made.items() if value}


def _creator(person: Person) -> dict[str, Any]:
    made: dict[str, Any] = {"name": person.name}
    if person.given:
        made |= {"nameType": "Personal", "familyName": person.family, "givenName": person.given}
    if person.orcid:
        made["nameIdentifiers"] = [
            {"nameIdentifier": _ORCID + person.orcid, "nameIdentifierScheme": "ORCID",
             "schemeUri": "https://orcid.org"},
        ]  # fmt: skip
    if person.affiliation:
        made["affiliation"] = [{"name": person.affiliation}]
    return made


def _funding(text: str) -> dict[str, str]:
    funder, _, number = (part.strip() for part in text.partition(";"))
    return {"funderName": funder} | ({"awardNumber": number} if number else {})


def crate(about: About, items: Sequence[Item]) -> dict[str, Any]:
    """Return an RO-Crate: its descriptor, the package, every file, people, devices, licence."""
    return {"@context": f"{_SPECIFICATION}/context", "@graph": list(_graph(about, items))}


def _graph(about: About, items: Sequence[Item]) -> Iterator[dict[str, Any]]:
    package = about.package
    licence = licence_url(package.licence)
    people = {_id_of(one, place): one for place, one in enumerate(package.people)}
    devices = {f"#instrument-{n}": one for n, one in enumerate(about.instruments, start=1)}
    recordings = [_of(one.identifier) for one in items if one.path.startswith("recordings/")]
    results = [_of(one.identifier) for one in items if one.path.startswith("results/")]
    yield {
        "@id": CRATE, "@type": "CreativeWork", "conformsTo": _of(_SPECIFICATION),
        "about": _of(_ROOT),
    }  # fmt: skip
    root = {
        "@id": _ROOT, "@type": "Dataset", "name": package.title, "description": about.description,
        "datePublished": str(about.published), "license": _of(licence),
        "author": [_of(one) for one in people], "keywords": ", ".join(package.keywords),
        "identifier": _DOI + package.doi if package.doi else about.identifier,
        "publisher": package.publisher, "temporalCoverage": f"{about.first}/{about.last}",
        "citation": [_of(_DOI + doi) for doi in package.related],
        "hasPart": [_of(one.identifier) for one in items],
        "mentions": [_of(one) for one in ("#measuring", "#reducing")],
    }  # fmt: skip
    yield {key: value for key, value in root.items() if value}
    for item in items:
        yield {
            "@id": item.identifier, "@type": "File", "name": item.path.rpartition("/")[2],
            "description": item.meaning, "encodingFormat": item.kind,
            "contentSize": str(item.size), "sha256": item.sha256,
        }  # fmt: skip
    yield {
        "@id": licence, "@type": "CreativeWork", "name": package.licence,
        "description": f"Licence of these data, {package.licence} by its SPDX identifier.",
    }  # fmt: skip
    for name, person in people.items():
        told = {
            "@id": name, "@type": "Person", "name": f"{person.given} {person.family}".strip(),
            "familyName": person.family, "givenName": person.given,
            "affiliation": person.affiliation and _of(_institute(person)),
        }  # fmt: skip
        yield {key: value for key, value in told.items() if value}
    for institute in {_institute(one): one.affiliation for one in people.values()
                      if one.affiliation}.items():  # fmt: skip
        yield {"@id": institute[0], "@type": "Organization", "name": institute[1]}
    for name, device in devices.items():
        told = {
            "@id": name, "@type": "IndividualProduct", "name": device.name or "not recorded",
            "serialNumber": device.serial, "description": device.use,
        }  # fmt: skip
        yield {key: value for key, value in told.items() if value}
    yield {
        "@id": _PROGRAM, "@type": "SoftwareApplication", "name": "asperity",
        "version": importlib.metadata.version("asperity"),
    }  # fmt: skip
    agent = {"agent": [_of(one) for one in people]}
    yield {
        "@id": "#measuring", "@type": "CreateAction", "name": "Tests on the rig", **agent,
        "startTime": str(about.first), "endTime": str(about.last),
        "instrument": [_of(one) for one in devices], "result": recordings,
    }  # fmt: skip
    yield {
        "@id": "#reducing", "@type": "CreateAction", "name": "Reduction of the recordings",
        **agent, "endTime": str(about.today), "instrument": _of(_PROGRAM), "object": recordings,
        "result": results,
    }  # fmt: skip
    for doi in package.related:
        yield {"@id": _DOI + doi, "@type": "CreativeWork", "name": doi}


def _of(identifier: str) -> dict[str, str]:
    return {"@id": identifier}


def _id_of(person: Person, index: int) -> str:
    return _ORCID + person.orcid if person.orcid else f"#author-{index + 1}"


def _institute(person: Person) -> str:
    return "#" + urllib.parse.quote(person.affiliation.replace(" ", "-"), safe="")
