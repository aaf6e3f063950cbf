"""A REXS model: components with attributes, relations between them, load cases; as XML.

The layout is that of the files of FVA's reference implementation. Attributes have units of the
format's own list, which a file names; what is read is returned in SI.
"""

import datetime
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import NamedTuple

from asperity.errors import InputError, plain, shown
from asperity.files.store import read_bytes
from asperity.units import to_si

VERSION = "1.5"
"""Of the format, as it is written."""

_READ = ("1.0", "1.1", "1.2", "1.3", "1.4", "1.5", "1.6", "1.7", "2.0")
_LARGEST = 64_000_000
# Units of the format by what pint calls them.
_UNITS = {
    "1 / min": "rpm", "C": "degC", "mum": "um", "N / mm^2": "N/mm^2", "kg / dm^3": "kg/dm^3",
    "mm^2 / s": "mm^2/s", "\u00b0": "deg", "none": "",
}  # fmt: skip
_SI = {
    "mm": "m", "deg": "rad", "\u00b0": "rad", "1 / min": "rad/s", "h": "s", "C": "K", "mum": "m",
    "N m": "N m", "N": "N", "kN": "N", "N / mm^2": "Pa", "kg / dm^3": "kg/m^3", "mm^2 / s": "m^2/s",
    "none": "", "%": "", "kW": "W", "W": "W",
}  # fmt: skip

Attributes = Mapping[str, tuple[object, str]]
"""Value and unit by the attribute's name."""


class Component(NamedTuple):
    """A component: its number, type, name and attributes as they stand in the file."""

    number: int
    type: str
    name: str
    attributes: Attributes

    def text(self, key: str) -> str:
        """Return an attribute as it stands; empty where it is missing."""
        return str(self.attributes[key][0]).strip() if key in self.attributes else ""

    def value(self, key: str) -> float | None:
        """Return an attribute in SI, None where it is missing or empty; raises InputError."""
        text = self.text(key)
        if not text:
            return None
        unit = self.attributes[key][1] or "none"
        if unit not in _SI:
            raise InputError(
                f"{self.type} {self.number} has {key} in {shown(unit)}, which is not read"
            )
        try:
            return to_si(f"{text} {_UNITS.get(unit, unit)}".strip(), _SI[unit])
        except InputError:
            raise InputError(
                f"{self.type} {self.number} has {key} = {shown(text)}; it must be a number"
            ) from None


class Relation(NamedTuple):
    """A relation: its type, the numbers of components by role, and its place among its kind."""

    type: str
    roles: Mapping[str, int]
    order: int | None = None


class Document(NamedTuple):
    """A model.

    Attributes
    ----------
    components : tuple of Component
        Each with a number of its own.
    relations : tuple of Relation
        Between them.
    load_cases : tuple of tuple of Component
        What differs from the components in each, of one load spectrum.
    version : str
        Of the format.
    """

    components: tuple[Component, ...]
    relations: tuple[Relation, ...]
    load_cases: tuple[tuple[Component, ...], ...] = ()
    version: str = VERSION

    def of_type(self, type_: str) -> Iterator[Component]:
        """Yield the components of a type."""
        return (one for one in self.components if one.type == type_)

    def number(self, number: int) -> Component:
        """Return a component by its number; raises InputError."""
        for one in self.components:
            if one.number == number:
                return one
        raise InputError(f"a relation names component {number}, which there is not")

    def related(self, type_: str, role: str, number: int, other: str) -> Iterator[Component]:
        """Yield what stands in another role of the relations of a component in a role."""
        for one in self.relations:
            if one.type == type_ and one.roles.get(role) == number and other in one.roles:
                yield self.number(one.roles[other])

    def xml(self, application: str, version: str) -> str:
        """Return it as the text of a file, written by an application."""
        now = datetime.datetime.now(datetime.UTC).isoformat(timespec="seconds")
        head = {
            "version": self.version, "applicationId": application, "applicationVersion": version,
            "date": now,
        }  # fmt: skip
        root = ElementTree.Element("model", head)
        kinds = {one.number: one.type for one in self.components}
        relations = ElementTree.SubElement(root, "relations")
        for number, relation in enumerate(self.relations, 1):
            about = {"id": str(number), "type": relation.type}
            if relation.order is not None:
                about["order"] = str(relation.order)
            made = ElementTree.SubElement(relations, "relation", about)
            for role, of in relation.roles.items():
                ElementTree.SubElement(
                    made, "ref", {"id": str(of), "role": role, "hint": kinds[of]}
                )
        components = ElementTree.SubElement(root, "components")
        for one in self.components:
            _add(components, one)
        if self.load_cases:
            spectrum = ElementTree.SubElement(root, "load_spectrum", {"id": "1"})
            for number, case in enumerate(self.load_cases, 1):
                made = ElementTree.SubElement(spectrum, "load_case", {"id": str(number)})
                for one in case:
                    _add(made, one)
        ElementTree.indent(root)
        body = ElementTree.tostring(root, encoding="unicode")
        return f'<?xml version="1.0" encoding="UTF-8"?>\n{body}\n'


def _add(parent: ElementTree.Element, component: Component) -> None:
    about = {"id": str(component.number), "type": component.type}
    if component.name:
        about["name"] = plain(component.name)
    made = ElementTree.SubElement(parent, "component", about)
    for key, (value, unit) in component.attributes.items():
        attribute = ElementTree.SubElement(made, "attribute", {"id": key, "unit": unit})
        if isinstance(value, tuple):
            array = ElementTree.SubElement(attribute, "array")
            for each in value:
                ElementTree.SubElement(array, "c").text = written_as(each)
        else:
            attribute.text = written_as(value)


def written_as(value: object) -> str:
    """Return a value as the text that a file has for it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value) if isinstance(value, float) else plain(str(value))


def read_document(path: Path) -> Document:
    """Read a model from an XML file.

    Raises
    ------
    InputError
        It is no REXS file, or one of a version that is not known, with the reason.
    StorageError
        The file cannot be read.
    """
    name = plain(str(path))
    content = read_bytes(path)
    if len(content) > _LARGEST:
        raise InputError(f"{name} is larger than {_LARGEST // 1_000_000} MB; no gearbox is")
    # A model has no document type; entities in one could grow without end.
    if b"<!DOCTYPE" in content[:100_000] or b"<!ENTITY" in content:
        raise InputError(f"{name} has a document type, which no REXS file has; it is not read")
    try:
        root = ElementTree.fromstring(content)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise InputError(
            f"{name} is no REXS file: it is no XML ({plain(str(error))}); a packed file (.rexsz) "
            "has to be unpacked, and JSON (.rexsj) to be saved as XML"
        ) from None
    for element in root.iter():
        element.tag = str(element.tag).rpartition("}")[2]
    if root.tag != "model":
        raise InputError(f"{name} is no REXS file: its root is {shown(root.tag)}, not 'model'")
    version = root.get("version", "")
    if not version.startswith(_READ):
        raise InputError(
            f"{name} is of REXS {shown(version)}; versions {_READ[0]} to {_READ[-1]} are read"
        )
    try:
        return _document(root, version)
    except (KeyError, ValueError) as error:
        raise InputError(
            f"{name} is a damaged REXS file: {plain(str(error))} is missing or no number"
        ) from None


def _document(root: ElementTree.Element, version: str) -> Document:
    components = tuple(map(_component, root.iterfind("components/component")))
    relations = tuple(
        Relation(
            one.attrib["type"],
            {ref.attrib["role"]: int(ref.attrib["id"]) for ref in one.iterfind("ref")},
            int(one.attrib["order"]) if "order" in one.attrib else None,
        )
        for one in root.iterfind("relations/relation")
    )
    spectrum = root.find("load_spectrum")
    cases = () if spectrum is None else spectrum.iterfind("load_case")
    loads = tuple(tuple(map(_component, case.iterfind("component"))) for case in cases)
    return Document(components, relations, loads, version)


def _component(element: ElementTree.Element) -> Component:
    found: dict[str, tuple[object, str]] = {}
    for one in element.iterfind("attribute"):
        array = one.find("array")
        value: object = one.text or ""
        if array is not None:
            value = tuple(cell.text or "" for cell in array.iterfind("c"))
        found[one.attrib["id"]] = (value, one.get("unit", "none"))
    about = element.attrib
    return Component(int(about["id"]), about.get("type", ""), about.get("name", ""), found)
