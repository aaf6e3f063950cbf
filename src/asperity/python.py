"""What asperity can do, for Python: each command as a function of a case or of its tables.

::

    import asperity

    asperity.rate("gearset-3").verdict.holds
    asperity.rate("gearset-3", settings=["operation.output_torque=300 N m"])
    asperity.slide(body, contact, shaking)
    asperity.slide(asperity.Model(body, contact, shaking))

A case is its name, a file, what :func:`read` gives, a `Model` of a sliding body, or tables in any
order.
"""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

from asperity.casefile.case import Case, read_case
from asperity.casefile.table import Table
from asperity.commands import COMMANDS, Command, case_tables
from asperity.errors import InputError, shown
from asperity.runs import Run

if TYPE_CHECKING:
    from asperity.casefile.check import Mistake
    from asperity.flanks.study.result import FlankStudy
    from asperity.rating.rated import Rated
    from asperity.results import Result
    from asperity.slider.model import Model
    from asperity.slider.result import SlideResult
    from asperity.start.compare import Comparison
    from asperity.studies.optimise import Optimum
    from asperity.studies.proposed import Proposals

What: TypeAlias = "str | os.PathLike[str] | Case | Table | Model"


def rate(*case: What, standard: str = "all", settings: Sequence[str] = ()) -> "Rated":
    """Rate a worm gearset.

    Parameters
    ----------
    *case : str, path, Case or tables
        A case, or its tables: a gearset and its operation.
    standard : {'all', 'iso14521', 'bs721', 'agma6034'}
        Which to apply.
    settings : sequence of str
        ``table.key=value`` to change, as with ``--set``.

    Returns
    -------
    Rated
        Its ``verdict`` says whether it holds; ``iso14521["S_H"]`` is a number of a standard.

    Raises
    ------
    InputError
        In one line: what was given, what is allowed, what to do.
    """
    return _answer("rate", case, settings, standard=standard)  # type: ignore[return-value]


def slide(*case: What, settings: Sequence[str] = ()) -> "SlideResult":
    """Pull a body over a vibrating base: its mean drive force, and how that compares.

    By ``solve.method`` the body is marched, solved for its periodic state, or under the
    homogenised law.

    Parameters
    ----------
    *case : str, path, Case or tables
        A case, a `Model`, or its tables: a `Slider`, a `Friction`, and as needed `Vibration`,
        `Normal`, `Wear` and `Solve`.
    settings : sequence of str
        ``table.key=value`` to change, as with ``--set``.

    Returns
    -------
    SlideResult
        ``ratio`` is the mean drive force over that without vibration, ``drive_force`` the force, N,
        ``ledger`` where the power goes, and ``settled`` whether it is a prediction.

    Raises
    ------
    InputError
        In one line: what was given, what is allowed, what to do.
    ConvergenceError
        No answer is found; what was reached is told.
    """
    return _answer("slide", case, settings)  # type: ignore[return-value]


def static(*case: What, settings: Sequence[str] = ()) -> "Result":
    """Find the largest force under which a body on a vibrating base holds.

    The body creeps back and forth at less; at more it slides away.

    Parameters
    ----------
    *case : str, path, Case or tables
        A case, a `Model`, or its tables, as of :func:`slide`.
    settings : sequence of str
        ``table.key=value`` to change, as with ``--set``.

    Returns
    -------
    Result
        The force, over that of static friction without vibration and in N.

    Raises
    ------
    InputError
        In one line: what was given, what is allowed, what to do.
    ConvergenceError
        No answer is found; what was reached is told.
    """
    return _answer("static", case, settings)


def sensitivity(*case: What, settings: Sequence[str] = ()) -> "Result":
    """Raise each input of a worm gearset alone and follow its efficiency.

    What raises it most comes first.

    Parameters
    ----------
    *case : str, path, Case or tables
        A case, or its tables: a gearset and its operation.
    settings : sequence of str
        ``table.key=value`` to change, as with ``--set``.

    Returns
    -------
    Result
        Of each input its range and the efficiencies over it.

    Raises
    ------
    InputError
        In one line: what was given, what is allowed, what to do.
    """
    return _answer("sensitivity", case, settings)


def methods(*case: What, settings: Sequence[str] = ()) -> "Result":
    """Compare oils, additives, coatings and vibration by a worm gearset's efficiency.

    The vibration is that of the case's ``[vibration]``, with the law of ``[friction]``.

    Parameters
    ----------
    *case : str, path, Case or tables
        A case, or its tables: a gearset and its operation, vibration and friction.
    settings : sequence of str
        ``table.key=value`` to change, as with ``--set``.

    Returns
    -------
    Result
        Of each way the efficiency with and without it.

    Raises
    ------
    InputError
        In one line: what was given, what is allowed, what to do.
    """
    return _answer("methods", case, settings)


def optimise(*case: What, settings: Sequence[str] = ()) -> "Optimum":
    """Find the most efficient design of a worm gearset that keeps its load capacity.

    Ratio, torque and speed stay; what varies is told by ``[optimise]``.

    Parameters
    ----------
    *case : str, path, Case or tables
        A case, or its tables: a gearset and its operation.
    settings : sequence of str
        ``table.key=value`` to change, as with ``--set``.

    Returns
    -------
    Optimum
        The design, what it gains, and what bounds it.

    Raises
    ------
    InputError
        In one line: what was given, what is allowed, what to do.
    ConvergenceError
        No answer is found; what was reached is told.
    """
    return _answer("optimise", case, settings)  # type: ignore[return-value]


def flank(
    *case: What, density: str | float = "intermediate", settings: Sequence[str] = ()
) -> "FlankStudy":
    """Cut a worm wheel exactly, by the envelope of its hob, and let it mesh.

    Transmission error, contact pattern and lines, ease-off, backlash, and the mesh's files.

    Parameters
    ----------
    *case : str, path, Case or tables
        A case, or its tables: a gearset, and as needed `Hob`, `Disc`, `Modification`, `Mount`.
    density : str or float
        Of the mesh: ``"coarse"``, ``"intermediate"``, ``"fine"``, or an element's size, mm.
    settings : sequence of str
        ``table.key=value`` to change, as with ``--set``.

    Returns
    -------
    FlankStudy
        Both flanks' analysis, and the wheel to be written to files.

    Raises
    ------
    InputError
        In one line: what was given, what is allowed, what to do.
    ConvergenceError
        No answer is found; what was reached is told.
    """
    return _answer("flank", case, settings, density=density)  # type: ignore[return-value]


def size(
    ratio: float | None = None,
    output_torque: Any = None,
    worm_speed: Any = None,
    *,
    case: str = "",
    rank: str = "size",
    settings: Sequence[str] = (),
    cut: bool = True,
    locks: str = "",
) -> "Proposals":
    """Propose worm gearsets for a ratio, a torque and a speed.

    Parameters
    ----------
    ratio : float, optional
        Of the speeds; left out: that of ``requirements.ratio`` in the case or among the settings.
    output_torque, worm_speed : str or quantity of pint, optional
        Of the wheel and of the worm: ``"300 N m"``, ``"1500 rpm"``. Left out: those of the case,
        or of the greatest load of its spectrum.
    case : str
        A case file that says all but the gearset, as ``asperity new duty`` begins it.
    rank : {'size', 'efficiency', 'margin'}
        What the first one is best in.
    settings : sequence of str
        Of materials, lubricant and life, as with ``--set``; what they say of starts, teeth, centre
        distance, module, diameter factor or profile shift is held.
    cut : bool
        Whether to leave out what no hob cuts.
    locks : {'', 'rest', 'motion'}
        Whether the worm must lock itself, at rest or in motion.

    Returns
    -------
    Proposals
        The best first.

    Raises
    ------
    InputError
        A value without a unit or out of bounds, no ratio, or no gearset that does what is asked.
    """
    from asperity.casefile.setting import apply, listed
    from asperity.start.duty import complete, duty, run_at
    from asperity.start.gear import drop_begun_life, proposals, ratio_of

    values = duty(case)
    run_at(values, output_torque=output_torque, worm_speed=worm_speed)
    given = {apply(values, setting, case_tables()) for setting in listed(settings)}
    drop_begun_life(values, given)
    complete(values)
    wanted = None if ratio is None else ratio_of(ratio)
    return proposals(values, wanted, rank, cut=cut, locks=locks)


def compare(*cases: str | os.PathLike[str] | Case) -> "Comparison":
    """Put cases side by side: what differs in what is asked and in what comes of it.

    Parameters
    ----------
    *cases : path or Case
        Two or more: files, names of cases that ship, or cases.

    Returns
    -------
    Comparison
        Rows of what differs, a column a case.

    Raises
    ------
    InputError
        Fewer than two cases, of other kinds, or one that cannot be read.
    """
    from asperity.start.compare import compare as side_by_side

    def answered(command: Command, case: Case) -> "Result":
        return _answer(command.name, [case], ())

    return side_by_side([as_case([case]) for case in cases], answered)


def check(case: str | os.PathLike[str], settings: Sequence[str] = ()) -> "tuple[Mistake, ...]":
    """Return all mistakes of a case file, each with its line; none for one that can be used.

    Parameters
    ----------
    case : path
        A TOML file, or the name of a case that ships.
    settings : sequence of str
        Changes of the case, as with ``--set``.

    Returns
    -------
    tuple of Mistake
        Line, key and a sentence of each.
    """
    from asperity.casefile.check import check_case

    return check_case(case, case_tables(), settings)[1]


def read(path: str | os.PathLike[str], settings: Sequence[str] = ()) -> "Case | Result":
    """Read a case, by its file or the name of one that ships, or an answer that was written.

    Parameters
    ----------
    path : path
        ``.nc`` is an answer, which can be drawn and shown again; everything else a case.
    settings : sequence of str
        Changes of a case, as with ``--set``.

    Returns
    -------
    Case or Result
        By the ending of the file.
    """
    if Path(path).suffix == ".nc":
        from asperity.results import read as read_answer

        return read_answer(path)
    return read_case(path, case_tables(), settings)


def as_case(what: Sequence[What], settings: Sequence[str] = ()) -> Case:
    """Return one case of what was given: its name, its file, itself, or its tables."""
    if len(what) == 1 and isinstance(what[0], Case):
        return what[0].replace(settings) if settings else what[0]
    if len(what) == 1 and isinstance(what[0], str | os.PathLike):
        return read_case(what[0], case_tables(), settings)
    known = case_tables()
    tables: dict[str, Table] = {}
    for given in _tables(what):
        if not isinstance(given, Table) or given.table not in known:
            raise InputError(
                f"{shown(given)} is neither the name of a case, nor its file, nor one of its tables"
            )
        if given.table in tables:
            raise InputError(f"[{given.table}] is given twice; keep one of them")
        tables[given.table] = given
    if not tables:
        raise InputError("nothing is given; name a case such as 'gearset-3', a file, or tables")
    if settings:
        raise InputError("settings change a case; change a table with its model_copy(update=...)")
    return Case("the tables given", Path().absolute(), tables, {}, known)


def _tables(what: Sequence[What]) -> "list[Any]":
    """Return the tables given, with those that models of sliding bodies hold."""
    from asperity.slider.model import Model

    return [t for given in what for t in (given.tables if isinstance(given, Model) else [given])]


def _answer(name: str, what: Sequence[What], settings: Sequence[str], **options: Any) -> "Result":
    command = next(command for command in COMMANDS if command.name == name)
    problem = command.prepared(as_case(what, settings), **command.defaults | options)
    return command.solved(problem, Run())
