"""The descriptions of instruments that ship: what is said to a make, and the manual it is from."""

import dataclasses
import functools
import tomllib
from collections.abc import Mapping
from importlib import resources
from typing import Any

from asperity.errors import InputError, nearest, one_of

_FOLDER = "descriptions"


@dataclasses.dataclass(frozen=True)
class Description:
    """What is said to instruments of a make.

    Attributes
    ----------
    name : str
        What a case calls it.
    kind : {'supply', 'controller'}
        A supply, or what drives the vibration: a controller or a signal generator.
    title, source : str
        Makes and models, and the manual.
    words : mapping of str to object
        Keys of the table that is described.
    """

    name: str
    kind: str
    title: str
    source: str
    words: Mapping[str, Any]

    @property
    def proves_off(self) -> bool:
        """Whether what is said reads back that it is off."""
        asked = "ask_output" in self.words
        if self.kind == "controller":
            return asked
        return "measure_current" in self.words and (asked or "measure_voltage" in self.words)


@functools.cache
def descriptions() -> Mapping[str, Description]:
    """Return the descriptions that ship, by name."""
    folder = resources.files(__package__) / _FOLDER
    found = {}
    for file in sorted(folder.iterdir(), key=lambda one: one.name):
        name, _, end = file.name.rpartition(".")
        if end == "toml":
            raw = tomllib.loads(file.read_text(encoding="utf-8"))
            about = {key: str(raw.pop(key)) for key in ("kind", "title", "source")}
            found[name] = Description(name, **about, words=raw)
    return found


def any_description(name: str) -> Description:
    """Return a description by its name; raises InputError where there is none."""
    known = descriptions()
    if name not in known:
        raise InputError(f"{name} is not an instrument that ships{nearest(name, known)}")
    return known[name]


def description(name: str, kind: str) -> Description:
    """Return the description of that name and kind; raises InputError where there is none."""
    known = {one.name: one for one in descriptions().values() if one.kind == kind}
    if name not in known:
        raise InputError(one_of(known, name))
    return known[name]
