"""Ways to less friction and what is reported of them, from ``data/methods.toml``."""

import functools
import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, SkipValidation

from asperity.casefile import Table
from asperity.errors import InputError, nearest, one_of, shown
from asperity.files import store
from asperity.gearset.materials import BaseOilName
from asperity.sources import Source
from asperity.vibration.shaking import Angle

OWN = Source(
    "sliding body of asperity",
    "one source",
    "dry friction; its use for a lubricated tooth contact is assumed",
)
"""Where the friction under an imposed vibration comes from."""

Kind = Literal["oil", "additive", "coating", "vibration"]

_SHIPPED = Path(__file__).parent / "data" / "methods.toml"
_LITERATURE = _SHIPPED.with_name("literature.toml")
_SECTIONS = ("source", "method")
_TEXT_ONLY = {"text_only": True}


class Method(Table):
    r"""A way to less friction between the teeth.

    Parameters
    ----------
    key, name : str
        Short name, and what it is.
    kind : {'oil', 'additive', 'coating', 'vibration'}
        Family.
    base_oil : str
        Takes the :math:`\mu_{0T}` of ISO/TR 14521 for this base oil. Exactly one of three.
    base_friction : float
        Takes this :math:`\mu_{0T}`.
    reduction : float
        Lowers :math:`\mu_{0T}` by this share of it.
    velocity_ratio : float, optional
        Of a vibration: peak velocity over the sliding velocity with which it was reported.
    direction : float or str, optional
        Of a vibration: angle from the sliding, rad.
    source : Source
        Who reports it.
    """

    table: ClassVar[str] = "method"
    required_alternatives: ClassVar[tuple[tuple[str, ...], ...]] = (
        ("base_oil", "base_friction", "reduction"),
    )

    key: str
    name: str
    kind: Kind
    base_oil: BaseOilName | None = None
    base_friction: Annotated[float, Field(gt=0.0, lt=1.0)] | None = None
    reduction: Annotated[float, Field(ge=0.0, lt=1.0)] | None = None
    velocity_ratio: Annotated[float, Field(gt=0.0)] | None = None
    direction: Angle | None = None
    source: SkipValidation[Source]


def more_methods(names: Sequence[str]) -> tuple[Method, ...]:
    """Return the methods that ship and more of them, the last of a key.

    Parameters
    ----------
    names : sequence of str
        Files of methods, or ``literature``: what else the thesis's chapter 2 reports in numbers.
    """
    found = {method.key: method for method in _shipped()}
    for name in names:
        path = _LITERATURE if name == "literature" else Path(name)
        found |= {method.key: method for method in _read(path)}
    return tuple(found.values())


def reported_methods(path: str | os.PathLike[str] | None = None) -> tuple[Method, ...]:
    """Return the methods of a data file; of the one that ships if none is named.

    Parameters
    ----------
    path : path, optional
        A TOML file such as ``studies/data/methods.toml``.

    Returns
    -------
    tuple of Method
        In the order of the file.

    Raises
    ------
    InputError
        The file cannot be read, or a method in it is wrong.
    """
    return _shipped() if path is None else _read(Path(path))


@functools.cache
def _shipped() -> tuple[Method, ...]:
    return _read(_SHIPPED)


def _read(path: Path) -> tuple[Method, ...]:
    raw = store.read_toml(path)
    sources = {}
    for section in raw:
        if section not in _SECTIONS:
            known = nearest(section, _SECTIONS)
            raise InputError(f"{path.name}: [{section}] is not a table of methods{known}")
        named = raw[section]
        if not isinstance(named, dict) or not all(isinstance(v, dict) for v in named.values()):
            raise InputError(
                f'{path.name}: [{section}] must hold tables with names, as in [{section}."x"]'
            )
    for key, values in raw.get("source", {}).items():
        try:
            sources[key] = Source(**values)
        except (TypeError, InputError) as error:
            raise InputError(f"{path.name}: [source.{key}]: {error}") from None
    return tuple(
        _method(path.name, key, values, sources) for key, values in raw.get("method", {}).items()
    )


def _method(file: str, key: str, values: Any, sources: Mapping[str, Source]) -> Method:
    given = dict(values)
    name = given.pop("from", None)
    if not isinstance(name, str) or name not in sources:
        raise InputError(f"{file}: [method.{key}]: from is {shown(name)}; {one_of(sources, name)}")
    try:
        return Method.model_validate(
            {**given, "key": key, "source": sources[name]}, context=_TEXT_ONLY
        )
    except InputError as error:
        raise InputError(f"{file}: [method.{key}]: {error}") from None
