"""What the thesis shows or says: a figure, a table or a claim, and the function that makes it here.

A function that makes an exhibit says so by a decorator; it may be said several times, with what the
function takes for each of them. What the page says beside it stands in ``said.toml`` and
``exhibits.toml``, see `asperity.thesis.said`. An `Exhibit` knows its module
alone, which is imported when it is made, so that a list of all costs nothing and one of them no
more than its own room.
"""

import dataclasses
import importlib
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

from asperity.runs.workers import Task
from asperity.thesis.products import Drawn, Finding, Grid, How
from asperity.thesis.said import words_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Function = TypeVar("Function", bound=Callable[..., Any])

Computed = tuple["xr.Dataset", Sequence[How]]
"""A figure's numbers, and how they are come by."""

FIGURE, TABLE, CLAIM = "figure", "table", "claim"


@dataclasses.dataclass(frozen=True)
class Maker:
    """How an exhibit is made."""

    name: str  # kind and number
    make: Callable[..., Drawn | Grid | Finding]

    @property
    def words(self) -> Mapping[str, Any]:
        """What the page says beside it."""
        return words_of(self.name)


_MAKERS: dict[str, Maker] = {}


def figure(
    number: str, draw: "Callable[[xr.Dataset], Figure]", *arguments: Any
) -> Callable[[Function], Function]:
    """Mark what computes a figure: its dataset, and the commands and functions that give it.

    It is drawn from its dataset alone. The function takes the arguments that follow, and ``full``
    if the figure can be made in full, on finer meshes or at more points.
    """

    def marked(compute: Function) -> Function:
        def make(**grade: bool) -> Drawn:
            return Drawn.by(draw, *compute(*arguments, **grade))

        _mark(f"{FIGURE} {number}", make)
        return compute

    return marked


def table(number: str, *arguments: Any) -> Callable[[Function], Function]:
    """Mark what calculates a table: a `Grid`; as `figure`."""

    def marked(compute: Function) -> Function:
        _mark(f"{TABLE} {number}", lambda: compute(*arguments))
        return compute

    return marked


def claim(number: str) -> Callable[[Function], Function]:
    """Mark what tests a claim, by a `Finding`; its number never changes."""

    def marked(compute: Function) -> Function:
        _mark(f"{CLAIM} {number}", compute)
        return compute

    return marked


def _mark(name: str, make: Callable[..., Any]) -> None:
    _MAKERS[name] = Maker(name, make)


class Part(Protocol):
    """Something an exhibit needs that is kept when it is made."""

    @property
    def task(self) -> Task:
        """To make it."""


def _no_parts(full: bool) -> Sequence[Part]:
    return ()


@dataclasses.dataclass(frozen=True)
class Exhibit:
    """Something of the thesis that is made here."""

    kind: str
    number: str
    module: str  # where the function stands that makes it
    cases: tuple[str, ...] = ()  # shipped ones it may use
    # What it shares with others, or what takes so long that several processes are to work at it;
    # takes whether it is made in full.
    parts: Callable[[bool], Sequence[Part]] = _no_parts
    calls_kernels: bool = True  # compiled functions
    seconds: float = 1.0  # that it takes, about, where its parts are there

    @property
    def name(self) -> str:
        """Its kind and number: ``figure 4.23``."""
        return f"{self.kind} {self.number}"

    @property
    def room(self) -> str:
        """The package its module stands in, which shares compiled code; empty without any."""
        return self.module.rpartition(".")[0] if self.calls_kernels else ""

    @property
    def has_full(self) -> bool:
        """Whether it can be made in full: what is drawn of other parts then."""
        return self.kind == FIGURE and list(self.parts(True)) != list(self.parts(False))

    @property
    def maker(self) -> Maker:
        """How it is made."""
        importlib.import_module(self.module)
        return _MAKERS[self.name]

    def make(self, *, full: bool = False) -> Any:
        """Make it: a `Drawn`, a `Grid` or a `Finding`."""
        return self.maker.make(full=True) if full and self.has_full else self.maker.make()
