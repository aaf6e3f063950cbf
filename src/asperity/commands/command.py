"""What a command is: its name, what it reads, how it refuses and how it solves."""

import dataclasses
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from asperity.commands.place import loaded
from asperity.errors import InputError

if TYPE_CHECKING:
    from asperity.casefile import Case
    from asperity.results import Result
    from asperity.runs import Run


@dataclasses.dataclass(frozen=True)
class Option:
    """What a command takes beside a case.

    Attributes
    ----------
    name : str
        ``--name`` on the command line, and the keyword of ``prepare``.
    help : str
        In a line.
    metavar : str
        What stands for its value; empty for a switch.
    default : str, bool or None
        Where it is left out; None: it must be given.
    many : bool
        Whether it may be given several times.
    """

    name: str
    help: str
    metavar: str = ""
    default: str | bool | None = ""
    many: bool = False


@dataclasses.dataclass(frozen=True)
class Argument:
    """What a command takes in its place on the command line, before a case.

    Attributes
    ----------
    name : str
        The keyword of ``prepare``.
    metavar, help : str
        What stands for it, and what it is, in a line.
    many : bool
        Whether there may be several.
    """

    name: str
    metavar: str
    help: str
    many: bool = False


@dataclasses.dataclass(frozen=True)
class Command:
    """Something asperity can do with a case.

    Attributes
    ----------
    name : str
        On the command line, behind the name of its group if it has one: ``rig reduce``.
    summary, files : str
        What it does, and what ``--out`` leaves, in a sentence each.
    prepare, solve : str
        ``"module:function"``, imported where used.
    options : tuple of Option
        What it takes beside a case.
    counts : str
        What its progress counts; empty where it takes no time.
    read : str
        Reads the case where that takes more than a name and settings.
    needs : tuple of str
        Tables that its case must have.
    either : tuple of str
        Tables of which one makes a case that it takes as well.
    brief : bool
        Whether a terminal shows a screen of it unless ``--full`` is given.
    arguments : tuple of Argument
        What it takes before the case.
    case : str
        What the case is called; empty: it takes none, and ``read`` finds it by what it takes.
    out : str
        What ``--out`` is: ``DIR``, a folder for files, or the name of the one file that its answer
        is saved in.
    into : str
        The argument that names the folder its files go to where ``--out`` is left out.
    draws : bool
        Whether pictures are among its files, so that ``--format`` says what they are.
    """

    name: str
    summary: str
    files: str
    prepare: str
    solve: str
    options: tuple[Option, ...] = ()
    counts: str = ""
    read: str = ""
    needs: tuple[str, ...] = ()
    either: tuple[str, ...] = ()
    brief: bool = False
    arguments: tuple[Argument, ...] = ()
    case: str = "CASE"
    out: str = "DIR"
    into: str = ""
    draws: bool = True

    @property
    def stem(self) -> str:
        """What is kept of it on the way is called so."""
        return self.name.replace(" ", "-")

    def prepared(self, case: "Case", **options: Any) -> Any:
        """Return the problem of a case, refused if it cannot be solved."""
        if self.needs and case.raw and not any(name in case for name in self.needs + self.either):
            tables = " and ".join(f"[{name}]" for name in self.needs)
            tables += "".join(f" or [{name}]" for name in self.either)
            raise InputError(
                f"{case.source}: it is a case of another kind, without {tables}, which asperity "
                f"{self.name} needs; asperity check {case.source} tells which commands take it"
            )
        return loaded(self.prepare)(case, **options)

    def solved(self, problem: Any, run: "Run") -> "Result":
        """Return the answer to a problem."""
        answer: Result = loaded(self.solve)(problem, run)
        return answer

    @property
    def reader(self) -> Callable[..., "Case"] | None:
        """What reads its case, None for a name and settings."""
        return loaded(self.read) if self.read else None
