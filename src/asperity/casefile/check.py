"""All mistakes of a case file at once, each with its line."""

import os
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import pydantic

from asperity.casefile.case import Case, read_raw
from asperity.casefile.setting import apply, listed
from asperity.casefile.table import Table
from asperity.errors import InputError, nearest

_KEY = re.compile(r"([A-Za-z_][\w-]*)\.([A-Za-z_][\w-]*)")
_MEANT = re.compile(r"\(did you mean '([^']*)'\?\)")
_HEADING = re.compile(r"\s*\[\[?\s*([^\[\]]+?)\s*\]")
_ENTRY = re.compile(r"""\s*["']?([\w-]+)["']?\s*(?:\.\s*["']?([\w-]+)["']?\s*)?[.=]""")
_NUMBERED = re.compile(r"number (\d+) of the list(?:: (?:\w+\.)*(\w+) )?")
_FENCES = ('"' * 3, "'" * 3)


class Mistake(NamedTuple):
    """Something that a case file cannot say.

    Attributes
    ----------
    line : int or None
        Of the file, from 1; None for what is not written there.
    key : str
        ``table.key``, or the table.
    text : str
        What was given, what is allowed, what to do.
    """

    line: int | None
    key: str
    text: str


def check_case(
    name_or_path: str | os.PathLike[str],
    tables: Mapping[str, type[Table]],
    settings: Sequence[str] = (),
) -> tuple[Case, tuple[Mistake, ...]]:
    """Read a case file and find all that is wrong with it, in the order of its lines.

    Parameters
    ----------
    name_or_path, tables, settings
        As in :func:`asperity.casefile.read_case`.

    Returns
    -------
    Case
        With the tables that have no mistake.
    tuple of Mistake
        Empty for a case that can be used.

    Raises
    ------
    InputError
        It cannot be read at all.
    """
    case, text = read_raw(name_or_path, tables)
    lines = lines_of(text)
    found: list[tuple[str, str]] = []
    for setting in listed(settings):
        try:
            case.settings[apply(case.raw, setting, tables)] = " ".join(setting.split())
        except InputError as error:
            found.append(("", str(error)))
    for name, entries in case.raw.items():
        if isinstance(entries, list):
            found.append((name, f"[{name}] is given as a list; write it once, as [{name}]"))
        elif not isinstance(entries, Mapping):
            found.append(
                (name, f"{name} stands outside a table; put it below a heading such as [slider]")
            )
        elif name not in tables:
            found.append((name, f"[{name}] is not a table of a case file{nearest(name, tables)}"))
        else:
            wrong = _without_echoes(mistakes_of(tables[name], entries))
            found += wrong
            if not wrong:
                case.tables[name] = tables[name].model_validate(
                    entries, context={"text_only": True}
                )
    made = []
    for key, sentence in found:
        line = None if key in case.settings else _line_of(key, sentence, lines)
        given = case.settings.get(key)
        made.append(Mistake(line, key, f"--set {given}: {sentence}" if given else sentence))
    return case, tuple(sorted(made, key=lambda mistake: mistake.line or 0))


def _line_of(key: str, sentence: str, lines: Mapping[str, int]) -> int | None:
    """Return the line of what is wrong, in a list of tables that of the one that is named."""
    places = [key, key.partition(".")[0]]
    if numbered := _NUMBERED.search(sentence):
        place = f"{key}.{numbered[1]}"
        places = [f"{place}.{numbered[2]}", place, *places]
    return next((lines[place] for place in places if place in lines), None)


def mistakes_of(model: type[Table], entries: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield every mistake of a table as its key and a sentence.

    What is wrong is left out and the rest looked at again, so that one mistake hides no other.
    """
    left, taken = dict(entries), set[str]()
    for sentence in model.forms(entries):
        key = _key_of(sentence, model)
        yield key, sentence
        others = {k for group in model.required_alternatives for k in group}
        for path in _KEY.findall(sentence):
            left.pop(path[1], None)
            taken |= {path[1]} | others
    told = set[str]()
    while True:
        wrong = False
        for key, sentence, of_all in _errors(model, left):
            field = key.rpartition(".")[2]
            if field in taken and field not in left:
                continue
            if of_all and taken and not _alone(model, left, field, sentence):
                continue
            if sentence not in told:
                told.add(sentence)
                yield key, sentence
            if field in left:
                del left[field]
                taken.add(field)
                wrong = True
        if not wrong:
            return


def _without_echoes(errors: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    """Leave out keys that are missing because they are misspelt."""
    listed = list(errors)
    meant = {word for _, sentence in listed for word in _MEANT.findall(sentence)}
    return [
        (key, sentence)
        for key, sentence in listed
        if not (sentence.startswith(f"{key} is missing") and key.partition(".")[2] in meant)
    ]


def _errors(model: type[Table], entries: Mapping[str, Any]) -> list[tuple[str, str, bool]]:
    """Return key and sentence of what is refused, and whether the table as a whole was."""
    try:
        # Not the table's own, which tells one mistake.
        model.built()
        model.__pydantic_validator__.validate_python(entries, context={"text_only": True})
    except pydantic.ValidationError as error:
        found = []
        for detail in error.errors(include_url=False):
            sentence = model.sentence(detail)
            key = f"{model.table}.{detail['loc'][0]}" if detail["loc"] else ""
            found.append((key or _key_of(sentence, model), sentence, not detail["loc"]))
        return found
    except InputError as error:
        return [(_key_of(str(error), model), str(error), True)]
    return []


def _alone(model: type[Table], entries: Mapping[str, Any], field: str, sentence: str) -> bool:
    """Whether a key is refused for itself, and not for what has been left out beside it."""
    if field not in entries:
        return False
    return any(said == sentence for _, said, _ in _errors(model, {field: entries[field]}))


def _key_of(sentence: str, model: type[Table]) -> str:
    # A table within a table has a dot in its name.
    within = sentence.startswith(f"{model.table}.")
    start = model.table.rpartition(".")[0] if within else ""
    found = _KEY.match(sentence, len(start) + 1 if start else 0)
    return f"{start}.{found.group()}".lstrip(".") if found else model.table


def lines_of(text: str) -> dict[str, int]:
    """Return in which line of a TOML text each table and each ``table.key`` begins.

    Of a list of tables as well each ``table.key.number`` and each key in it, the first number 1.
    """
    lines: dict[str, int] = {}
    counts: dict[str, int] = {}
    table, fence, depth = "", "", 0
    place = ""  # in a list of tables
    for number, line in enumerate(text.splitlines(), 1):
        if fence:
            fence = "" if fence in line else fence
            continue
        if depth <= 0 and (heading := _HEADING.match(line)):
            table = heading[1].strip("[] \"'").partition(".")[0].strip(" \"'")
            lines.setdefault(table, number)
            inner = heading[1].partition(".")[2].strip(" \"'")
            place = ""
            if inner:
                path = f"{table}.{inner.partition('.')[0]}"
                lines.setdefault(path, number)
                if line.lstrip().startswith("[["):
                    counts[path] = counts.get(path, 0) + 1
                if path in counts:
                    place = f"{path}.{counts[path]}"
                    lines.setdefault(place, number)
            continue
        if depth <= 0 and (entry := _ENTRY.match(line)):
            path = f"{table}.{entry[1]}" if table else ".".join(filter(None, entry.groups()))
            path = f"{place}.{entry[1]}" if place else path
            lines.setdefault(path, number)
            lines.setdefault(path.partition(".")[0], number)
        bare = re.sub(r"""\"[^\"]*\"|'[^']*'|#.*""", "", line)
        depth += sum(map(bare.count, "[{")) - sum(map(bare.count, "]}"))
        for mark in _FENCES:
            if line.count(mark) % 2:
                fence = mark
    return lines


def missing(case: Case, needs: Collection[str]) -> list[str]:
    """Return the tables that a case does not have."""
    return [name for name in needs if name not in case.raw]
