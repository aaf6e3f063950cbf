"""What a command is: its name, what it reads, how it refuses and how it solves."""

import dataclasses
import shlex
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from asperity.commands.tables import loaded
from asperity.errors import InputError, nearest, one_of, plain, shown

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
    one_of : str
        A name that it has in common with others of which one at least must be given.
    elsewhere : tuple of str, optional
        What of it may be asked from anywhere but a terminal, which has all; None: anything.
    choices : tuple of str
        What its text must be, where it is not left out; empty: anything.
    most : int
        The greatest whole number that it takes; 0: it takes a text.
    """

    name: str
    help: str
    metavar: str = ""
    default: str | bool | None = ""
    many: bool = False
    one_of: str = ""
    elsewhere: tuple[str, ...] | None = None
    choices: tuple[str, ...] = ()
    most: int = 0

    def read(self, value: Any) -> Any:
        """Return what a command is given for a text: of its choices, or a number.

        Raises
        ------
        InputError
            It is neither.
        """
        if self.most:
            text = str(value)
            digits = text.isascii() and text.isdecimal() and len(text) < 10
            if not (digits and int(text) <= self.most):
                raise InputError(
                    f"--{self.name} {plain(text)}: it must be a whole number, at most {self.most}"
                )
            return int(text)
        if self.choices and value not in (self.default, *self.choices):
            raise InputError(f"--{self.name} {plain(str(value))}: {one_of(self.choices, value)}")
        return value

    def allowed(self, value: object) -> None:
        """Refuse what may not be asked but from a terminal."""
        if self.elsewhere is None or value in self.elsewhere:
            return
        if not self.elsewhere:
            raise InputError(f"{self.name} is not for a page; a terminal has it")
        raise InputError(
            f"{self.name} is {shown(value)}; on a page it is {' or '.join(self.elsewhere)}: "
            "a terminal has the others"
        )


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
class Addition:
    """What a room above a command's adds to its answer.

    Attributes
    ----------
    place : str
        ``"module:name"`` of a function of the case, which refuses at no cost and returns what is
        called with answer and run, and returns the answer with what is added.
    tables : tuple of str
        Tables of which one asks for it.
    option : str
        The switch that asks for it.
    """

    place: str
    tables: tuple[str, ...] = ()
    option: str = ""

    def is_asked(self, case: "Case", options: Mapping[str, Any]) -> bool:
        """Whether a case or the options ask for it."""
        return any(name in case for name in self.tables) or bool(options.get(self.option))


@dataclasses.dataclass(frozen=True)
class Command:
    """Something asperity can do with a case.

    Attributes
    ----------
    name : str
        On the command line, behind the name of its group if it has one: ``rig reduce``.
    summary, files : str
        What it does, and what ``--out`` leaves, in a sentence each.
    module : str
        Where its ``prepare`` and ``answer`` stand, imported when they are used.
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
    additions : tuple of Addition
        What rooms above add to its answer.
    """

    name: str
    summary: str
    files: str
    module: str
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
    additions: tuple[Addition, ...] = ()

    @property
    def modules(self) -> tuple[str, ...]:
        """All that its answer comes from: its module, and those of what is added."""
        return self.module, *(each.place.partition(":")[0] for each in self.additions)

    @property
    def stem(self) -> str:
        """What is kept of it on the way is called so."""
        return self.name.replace(" ", "-")

    def prepared(self, case: "Case", **options: Any) -> Any:
        """Return the problem of a case, refused if it cannot be solved.

        Parameters
        ----------
        case : Case
            What it is asked of.
        **options
            Of the command, by name.

        Returns
        -------
        object
            For `solved`: what the command's ``prepare`` makes of it, and what adds to the answer.

        Raises
        ------
        InputError
            The case is of another kind, or cannot be solved.
        """
        if self.needs and case.raw and not any(name in case for name in self.needs + self.either):
            tables = " and ".join(f"[{name}]" for name in self.needs)
            tables += "".join(f" or [{name}]" for name in self.either)
            raise InputError(
                f"{case.source}: it is a case of another kind, without {tables}, which asperity "
                f"{self.name} needs; asperity check {case.source} tells which commands take it"
            )
        switches = {each.option for each in self.additions}
        own = {n: value for n, value in self._read(options).items() if n not in switches}
        problem = loaded(f"{self.module}:prepare")(case, **own)
        asked = [each for each in self.additions if each.is_asked(case, options)]
        return problem, [loaded(each.place)(case) for each in asked]

    def solved(self, problem: Any, run: "Run") -> "Result":
        """Return the answer to a problem.

        Parameters
        ----------
        problem : object
            From `prepared`.
        run : Run
            Where its state is kept and who is told how far it is.

        Returns
        -------
        Result
            Of the command's class.
        """
        problem, additions = problem
        answer: Result = loaded(f"{self.module}:answer")(problem, run)
        for add in additions:
            answer = add(answer, run)
        return answer

    @property
    def defaults(self) -> dict[str, Any]:
        """What it does if nothing is said, by option."""
        return {one.name: None if one.many else one.default for one in self.options}

    def case_of(self, name: str, settings: Sequence[str], **options: Any) -> "Case":
        """Return the case it is asked for, read as it reads cases.

        Parameters
        ----------
        name : str
            A file, or a case that ships.
        settings : sequence of str
            As with ``--set``.
        **options
            Of the command, which one that reads in its own way is given.

        Returns
        -------
        Case
            Read and validated.
        """
        from asperity.casefile import read_case
        from asperity.commands.tables import case_tables

        read: Callable[..., Case] = loaded(self.read) if self.read else read_case
        own = self._read(options)
        return read(name, case_tables(), settings, **(own if self.read else {}))

    def _read(self, options: Mapping[str, Any]) -> dict[str, Any]:
        """Return options and arguments as ``read`` and ``prepare`` take them."""
        known = {each.name: each for each in self.options}
        return {n: known[n].read(value) if n in known else value for n, value in options.items()}

    def given(self, arguments: Mapping[str, Any], options: Mapping[str, Any]) -> dict[str, Any]:
        """Return what is given beside a case from a page, as the command line would have read it.

        Parameters
        ----------
        arguments : mapping of str to object
            By name: a text, or a list of them.
        options : mapping of str to object
            By name: a text, a number or a truth.

        Returns
        -------
        dict of str to object
            Both by name, as of the kind that the command takes.

        Raises
        ------
        InputError
            A name means nothing here, a value is of another kind or for a terminal alone, or
            something is missing.
        """
        places = {argument.name: argument for argument in self.arguments}
        known = {option.name: option for option in self.options}
        for names, what in ((arguments, places), (options, known)):
            for name in names:
                if name not in what:
                    kind = "arguments" if what is places else "options"
                    raise InputError(
                        f"{shown(name)} is none of the {kind} of {self.name}{nearest(name, what)}"
                    )
        made: dict[str, Any] = {}
        for name, argument in places.items():
            made[name] = _texts(name, arguments.get(name), argument.help, many=argument.many)
            if not made[name]:
                raise InputError(f"{name} is empty: {argument.help}")
        for name, value in options.items():
            option = known[name]
            option.allowed(value)
            if option.metavar:
                made[name] = _texts(name, value, option.help, many=option.many)
            elif isinstance(value, bool):
                made[name] = value
            else:
                raise InputError(f"{name} is {shown(value)}; it must be true or false")
        missing = [o for o in self.options if o.default is None and not made.get(o.name)]
        if missing:
            raise InputError(f"{self.name} needs {missing[0].name}: {missing[0].help}")
        return made

    def line(self, case: str, settings: Iterable[str], arguments: Mapping[str, Any]) -> str:
        """Return what does the same on a terminal, and prints it as JSON.

        Parameters
        ----------
        case : str
            The case's name.
        settings : iterable of str
            As with ``--set``.
        arguments : mapping of str to object
            Arguments and options by name, as from `arguments`.

        Returns
        -------
        str
            A line for a shell.
        """
        words = ["asperity", *self.name.split()]
        for argument in self.arguments:
            words += arguments[argument.name] if argument.many else [arguments[argument.name]]
        words += [case] if self.case else []
        for setting in settings:
            words += ["--set", setting]
        for option in self.options:
            value = arguments.get(option.name, False)
            for each in value if isinstance(value, list) else [value]:
                if each not in (False, ""):
                    words += [
                        f"--{option.name.replace('_', '-')}",
                        *([] if each is True else [each]),
                    ]
        return shlex.join([*words, "--json"])


def _texts(name: str, value: object, about: str, *, many: bool) -> Any:
    """Return a text, or some where there may be several; refuses anything else."""
    if many and isinstance(value, str):
        return [value]
    if isinstance(value, list) if many else isinstance(value, str):
        each = value if isinstance(value, list) else [value]
        if all(isinstance(one, str) for one in each):
            return value
    kind = "a list of texts" if many else "a text"
    raise InputError(f"{name} is {shown(value)}; it must be {kind}: {about}")
