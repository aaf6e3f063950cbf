"""What a gearset is sized for: a case file that says everything but the gearset."""

import copy
from typing import Any

from asperity.casefile.case import Case, read_raw
from asperity.casefile.table import names_file, same_thing
from asperity.commands import case_tables
from asperity.errors import InputError, nearest, shown
from asperity.rating.load_steps import LOADS
from asperity.rating.parameters import Operation
from asperity.rating.spectrum import Spectrum
from asperity.start.gear import begun, drop_begun_life, proposals
from asperity.start.kinds import Values
from asperity.studies.proposed import Proposals
from asperity.units import Named, quantity_of

_ASKED = {"output_torque": "300 N m", "worm_speed": "1500 rpm"}


def duty(name: str = "") -> Values:
    """Return the tables that a gearset is sized by, without torque and speed that nobody gave.

    Parameters
    ----------
    name : str
        A case file, or the name of a case that ships; left out: materials, oil and life are
        assumed and all else is to be given.

    Raises
    ------
    InputError
        The file cannot be read or has a table that no case has.
    """
    if name:
        return _laid_over(read_raw(name, case_tables())[0])
    values = begun()
    for key in _ASKED:
        values["operation"].pop(key)
    return values


def sized(case: Case) -> Proposals:
    """Return what ``size`` proposes for a duty, without cutting a wheel; it refuses what that does.

    Parameters
    ----------
    case : Case
        Its tables as a file has them; whether they are validated does not matter.

    Raises
    ------
    InputError
        As ``size`` does.
    """
    values = copy.deepcopy(_laid_over(case))
    complete(values)
    return proposals(values)


def _laid_over(case: Case) -> Values:
    """Return the tables of a case over what is assumed where it says nothing."""
    values = duty()
    known = case_tables()
    given = set[str]()
    for table, entries in case.raw.items():
        if table not in known:
            raise InputError(f"{case.source}: [{table}] is not a table of a case file"
                             f"{nearest(table, known)}")  # fmt: skip
        if not isinstance(entries, dict):
            raise InputError(f"{case.source}: {table} must be one table; write it as [{table}]")
        mine = values.setdefault(table, {})
        # What is assumed gives way to any form of the same thing.
        for other in {form for key in entries for form in same_thing(known[table], key)}:
            mine.pop(other, None)
        for key, value in entries.items():
            named = isinstance(value, str) and names_file(known[table], key)
            mine[key] = str(case.folder / value) if named else value
            given.add(f"{table}.{key}")
    drop_begun_life(values, given)
    return values


def complete(values: Values) -> None:
    """Fill in torque and speed that the greatest load of a spectrum says.

    Parameters
    ----------
    values : dict
        As `duty` returns them, with what was set; changed in place.

    Raises
    ------
    InputError
        Neither is given nor follows.
    """
    operation = values["operation"]
    loaded = any(form in operation for form in LOADS)
    if not (loaded and "worm_speed" in operation) and "spectrum" in values:
        spectrum = Spectrum.model_validate(values["spectrum"], context={"text_only": True})
        steps = [step for step in spectrum.step or () if step.output_torque is not None]
        if steps and len(steps) == len(spectrum.step or ()):
            greatest = max(steps, key=lambda step: step.torque)
            if not loaded:
                operation["output_torque"] = f"{greatest.torque!r} N m"
            if greatest.worm_speed is not None:
                operation.setdefault("worm_speed", f"{greatest.worm_speed!r} rad/s")
    loaded = any(form in operation for form in LOADS)
    for key, example in _ASKED.items():
        if not (loaded if key == "output_torque" else key in operation):
            raise InputError(
                f"operation.{key} is missing; give it, as --{key.replace('_', '-')} '{example}', "
                "or in a case file (asperity new duty begins one)"
            )


def run_at(values: Values, **given: Any) -> None:
    """Set torque and speed that are texts or quantities of pint; None leaves what is there.

    Parameters
    ----------
    values : dict
        As `duty` returns them, changed in place.
    **given
        By key of the operation.

    Raises
    ------
    InputError
        One without a unit, or out of bounds.
    """
    for key, value in given.items():
        if value is not None:
            quantity = quantity_of(Operation, key)
            assert quantity is not None
            try:
                number = quantity.check(value, named=Named(), key=key)
            except InputError as error:
                raise InputError(f"{key} is {shown(value)}; {error}") from None
            values["operation"][key] = f"{number!r} {quantity.unit}"
