"""An answer: what it holds follows from its fields, what it can do is here once."""

import importlib
import json
import os
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from asperity.errors import AsperityError, InputError, StorageError
from asperity.results import dataset as datasets
from asperity.results.quantity import Entry, Label, Quantities
from asperity.results.table import Table, table_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from asperity.results.report import Heading, Picture, Section

_ANSWER, _OF = "answer", "answer_of"

_known: dict[str, "type[Result]"] = {}


def _path_of(cls: type) -> str:
    return f"{cls.__module__}:{cls.__qualname__}"


class Result(Quantities):
    """Base of every answer.

    A subclass declares its fields with :func:`quantity` and may name its pictures in `drawings`:
    functions of the dataset, so that a file can be drawn as well as the answer it came from.

    Attributes
    ----------
    title : str
        What it is an answer about.
    stem : str
        What its files are called.
    drawings : mapping of str to str
        Name of a picture's file to ``"module:function"``.
    captions : mapping of str to str
        What a report says below each of them.
    reported : bool
        Whether ``--out`` also leaves ``report.html``.
    whole : bool
        Whether of its files all stand in the folder or none: what is soon made again.
    labels : mapping
        Of dimensions: the names along them and what they are.
    notes : tuple of str
        What a reader of the numbers should know.
    """

    title: ClassVar[str] = ""
    stem: ClassVar[str] = "result"
    drawings: ClassVar[Mapping[str, str]] = {}
    labels: ClassVar[datasets.Labels] = {}

    captions: ClassVar[Mapping[str, str]] = {}
    reported: ClassVar[bool] = True
    whole: ClassVar[bool] = False

    notes: tuple[str, ...] = ()

    def __init_subclass__(cls, **options: Any) -> None:
        super().__init_subclass__(**options)
        _known[_path_of(cls)] = cls

    @property
    def kind(self) -> "type[Result]":
        """The class that says how it is drawn and what its files are called."""
        return type(self)

    @property
    def inputs(self) -> Mapping[str, Any]:
        """What was asked: values in SI and texts by ``table.key``."""
        return {}

    @property
    def failure(self) -> AsperityError | None:
        """What keeps the answer from being whole; shown and written all the same."""
        return None

    def to_json(self) -> dict[str, Any]:
        """Return the scalars by key, each key with its unit, and the notes."""
        return super().to_json() | {"notes": list(self.notes)}

    def to_dataset(self) -> "xr.Dataset":
        """Return everything as a labelled dataset, every variable with its unit in ``units``."""
        attributes = {"notes": "; ".join(self.notes), **self.inputs}
        return datasets.to_dataset(self, self.labels, attributes, title=self.title)

    def __repr__(self) -> str:
        text = super().__repr__()
        # What has not settled is no prediction, at Python's prompt as elsewhere.
        settled = getattr(self, "settled", True)
        loose = np.ndim(settled) == 0 and not settled
        return text.replace("(", "(not settled, ", 1) if loose else text

    def to_frame(self) -> Any:
        """Return the scalars as a data frame of pandas, indexed by key."""
        import pandas  # type: ignore[import-untyped]

        shown = [entry for entry in self.entries() if entry.in_json]
        rows = [
            {
                "symbol": entry.label.symbol,
                "value": entry.value,
                "unit": entry.label.unit,
                "meaning": entry.label.meaning,
            }
            for entry in shown
        ]
        index = pandas.Index([entry.key for entry in shown], name="key")
        return pandas.DataFrame(rows, index=index, columns=["symbol", "value", "unit", "meaning"])

    def heading(self) -> str:
        """Return the line above the tables."""
        return self.title

    def headline(self) -> tuple[str, ...]:
        """Return what the answer comes to, in few sentences above its tables."""
        return ()

    def traces(self, points: int) -> Mapping[str, Any]:
        """Return what is drawn of it at once, in so many numbers each, by name."""
        return {}

    def views(self) -> Mapping[str, str]:
        """Return drawings to scale of what it is about, as SVG by name."""
        return {}

    def attached(self) -> Mapping[str, bytes]:
        """Return files that a program draws from, by name; `write` leaves them out."""
        return {}

    def brief(self) -> str:
        """Return what a terminal shows in place of the tables unless all is asked for."""
        return ""

    def tables(self) -> tuple[Table, ...]:
        """Return what a person reads, whatever shows it."""
        return (table_of(self, remarks=self.notes),)

    def figure(self, name: str | None = None) -> "Figure":
        """Draw one of the pictures; the first if none is named.

        Parameters
        ----------
        name : str, optional
            A key of `drawings`.

        Returns
        -------
        matplotlib.figure.Figure
            Not shown yet.

        Raises
        ------
        InputError
            It has no picture of that name.
        """
        drawings = self.kind.drawings
        if not drawings:
            from asperity.results.figures import draw

            return draw(self.to_dataset())
        wanted = next(iter(drawings)) if name is None else name
        if wanted not in drawings:
            raise InputError(f"{wanted!r} is not a picture; there are {', '.join(drawings)}")
        module, _, function = drawings[wanted].partition(":")
        drawn: Figure = getattr(importlib.import_module(module), function)(self.to_dataset())
        return drawn

    plot = figure

    def sections(self, folder: Path | None = None) -> "tuple[Section, ...]":
        """Return what its report says.

        Parameters
        ----------
        folder : path, optional
            Where its pictures may stand already, which are not drawn again then.
        """
        from asperity.results.report import Section

        drawn = self.pictures(folder)
        return (
            Section(
                "", (*((self.heading(),) if self.heading() != self.title else ()), *self.headline())
            ),
            Section("Results", tables=self.tables()),
            *([Section("Pictures", pictures=drawn)] if drawn else []),
        )

    def pictures(self, folder: Path | None = None) -> "tuple[Picture, ...]":
        """Return its pictures for a page; those that stand in a folder are taken from there."""
        from asperity.results.report import Picture

        made = []
        for name in self.kind.drawings or (self.kind.stem,):
            own = name.replace("_", " ").replace("-", " ").capitalize()
            # The one that is called as its file says nothing of what it shows.
            title = self.kind.title if name == self.kind.stem else own
            caption = self.kind.captions.get(name, "")
            png = None if folder is None else folder / f"{name}.png"
            if png is not None and png.is_file():
                made.append(Picture(title, caption=caption, png=png))
            elif self.kind.drawings:
                made.append(Picture(title, self.figure(name), caption))
        return tuple(made)

    def to_html(self, heading: "Heading | None" = None, folder: Path | None = None) -> str:
        """Return its report: one page without requests, which prints on A4.

        Parameters
        ----------
        heading : Heading, optional
            For whom and by whom, and the case.
        folder : path, optional
            As of `sections`.

        Returns
        -------
        str
            The page.
        """
        from asperity.results.report import report

        return report(self.kind.title, self.sections(folder), heading)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write everything as netCDF, whole or not at all; :func:`read` gives it back.

        Parameters
        ----------
        path : path
            A file; one that is there is replaced.

        Returns
        -------
        path
            The same.
        """
        from asperity.files.store import write_dataset

        return write_dataset(self._with_answer(), path)

    def write(self, folder: Path, *, pictures: str = "png") -> list[str]:
        """Write JSON, netCDF and the pictures to a folder that exists.

        The numbers come first, so that a picture that fails costs the picture.

        Parameters
        ----------
        folder : path
            Where to.
        pictures : str
            What pictures are written as, png, svg or pdf; empty for none.

        Returns
        -------
        list of str
            Names of the files.
        """
        from asperity.results.files import write_json, write_picture

        kind = self.kind
        names = [f"{kind.stem}.json", f"{kind.stem}.nc"]
        write_json(self.to_json(), folder / names[0])
        self.save(folder / names[1])
        for name in (kind.drawings or [kind.stem]) if pictures else ():
            figure = self.figure(name if kind.drawings else None)
            write_picture(figure, folder / f"{name}.{pictures}")
            names.append(f"{name}.{pictures}")
        return names

    @classmethod
    def read(cls, path: str | os.PathLike[str]) -> "Saved":
        """Read an answer of this kind back from a file; raises InputError for another kind.

        Parameters
        ----------
        path : path
            As of :func:`read`.

        Returns
        -------
        Saved
            As of :func:`read`.
        """
        saved = read(path)
        if not issubclass(saved.of, cls):
            raise InputError(f"{path} holds {_path_of(saved.of)}, not {_path_of(cls)}")
        return saved

    def _repr_html_(self) -> str:
        from asperity.results.page import fragment

        return fragment(self.tables(), self.headline())

    def _with_answer(self) -> "xr.Dataset":
        answer = json.dumps(self.to_json(), allow_nan=False)
        return self.to_dataset().assign_attrs({_OF: _path_of(type(self)), _ANSWER: answer})


class Saved(Result):
    """An answer read back from its file.

    Attributes
    ----------
    of : type of Result
        What it was.
    dataset : xarray.Dataset
        What the file holds.
    """

    of: type[Result]
    dataset: "xr.Dataset"

    @property
    def kind(self) -> type[Result]:
        """What it was."""
        return self.of

    def to_json(self) -> dict[str, Any]:
        """Return the scalars by key, as they were."""
        answer: dict[str, Any] = json.loads(self.dataset.attrs[_ANSWER])
        return answer

    def to_dataset(self) -> "xr.Dataset":
        """Return what the file holds."""
        attributes = dict(self.dataset.attrs)
        del attributes[_OF], attributes[_ANSWER]
        return self.dataset.drop_attrs(deep=False).assign_attrs(attributes)

    def entries(self) -> Iterator[Entry]:
        """Yield what the class declares, with the values of the file."""
        answer = self.to_json()
        declared = list(self.of.declared())
        for entry in declared:
            if entry.in_json and entry.key in answer:
                yield Entry(entry.name, entry.label, answer[entry.key])
            elif entry.variable in self.dataset.variables:
                yield Entry(entry.name, entry.label, self.dataset[entry.variable].values)
        known = {entry.key for entry in declared}
        for key, value in answer.items():
            # What an answer puts together by itself has its unit in the key alone.
            if key not in known and isinstance(value, int | float | str):
                yield Entry(key, Label("", "", key.replace("_", " "), key=key), value)

    def heading(self) -> str:
        """Return the line above the tables."""
        return str(self.dataset.attrs.get("title", self.of.title))

    def _with_answer(self) -> "xr.Dataset":
        return self.dataset


def read(path: str | os.PathLike[str]) -> Saved:
    """Read an answer back from a file that :meth:`Result.save` or ``--out`` wrote.

    Parameters
    ----------
    path : path
        A netCDF file.

    Returns
    -------
    Saved
        What was saved, with tables, pictures and JSON as the answer had them.

    Raises
    ------
    StorageError
        The file cannot be read, is damaged, or holds no answer.
    """
    from asperity.files.store import read_dataset

    dataset = read_dataset(path)
    try:
        of = _class_of(str(dataset.attrs[_OF]))
        notes = tuple(json.loads(dataset.attrs[_ANSWER]).get("notes", ()))
    except (KeyError, ValueError, LookupError, ImportError, AttributeError):
        raise StorageError(f"{path} holds no answer that this version can read back") from None
    return Saved(of=of, dataset=dataset, notes=notes)


def _class_of(path: str) -> type[Result]:
    if path not in _known:
        module, _, _ = path.partition(":")
        # A file does not get to say what is imported.
        if not module.startswith("asperity."):
            raise LookupError(path)
        importlib.import_module(module)
    return _known[path]
