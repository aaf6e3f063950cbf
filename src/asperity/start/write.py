"""A commented case file: what is given as keys, and all that could be as comments."""

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

from asperity.casefile.case import Case, read_raw
from asperity.casefile.schema import Key, keys_of, table_schema
from asperity.casefile.table import Table, same_thing
from asperity.casefile.written import toml, written
from asperity.files.shipped import describe
from asperity.start.kinds import Values

_WIDTH = 98


def case_text(
    title: str,
    values: Values,
    tables: Mapping[str, type[Table]],
    names: Sequence[str],
    remarks: Sequence[str] = (),
    of_keys: Mapping[str, str] = MappingProxyType({}),
) -> str:
    """Return the text of a case file.

    Parameters
    ----------
    title : str
        Its first line, which says what it is.
    values : dict
        By table and key, as a file has them.
    tables : mapping of str to type of Table
        The tables that there are.
    names : sequence of str
        Of the tables in their order.
    remarks : sequence of str
        Sentences below the first line.
    of_keys : mapping
        What is said of a ``table.key`` behind its meaning.
    """
    lines = [f"# {title}", ""]
    for remark in remarks:
        lines += [*comment(remark), ""]
    for name in names:
        model, given = tables[name], values.get(name, {})
        heading = comment(table_schema(model)["description"])
        lines += [*heading, f"[{name}]" if given else f"#[{name}]"]
        keys = {key.name: key for key in keys_of(model)}
        for own, value in given.items():
            meaning = " ".join(filter(None, (keys[own].meaning, of_keys.get(f"{name}.{own}"))))
            lines += [*comment(meaning), f"{own} = {toml(value)}", ""]
        forms = {form for own in given for form in same_thing(model, own)}
        for key in keys.values():
            if key.name not in given:
                other = key.name in forms
                lines += list(_left_out(key, other=other))
        lines.append("")
    text = "\n".join(lines)
    while "\n\n\n" in text:
        text = text.replace("\n\n\n", "\n\n")
    return f"{text.rstrip()}\n"


def _left_out(key: Key, *, other: bool) -> Iterator[str]:
    written = f'"{key.default}"' if key.schema.get("type") == "string" else key.default
    value = (written if key.default not in ("", "required") else "") or key.example
    meaning = f"{key.meaning} (another form of what is given)" if other else key.meaning
    if value and key.default in ("", "required"):
        meaning = f"{meaning.rstrip()} For example:"
    yield from comment(meaning)
    if value:
        yield f"#{key.name} = {_toml_value(value)}"
    else:
        yield f"#{key.name} ="
    yield ""


def _toml_value(value: str) -> str:
    if value[:1] in '"[{' or value in ("true", "false"):
        return value
    if value[:1] == "(":
        return f"[{value[1:-1]}]"
    try:
        float(value)
    except ValueError:
        return f'"{value}"'
    return value


def comment(text: str) -> list[str]:
    """Return a text as lines of a file that count for nothing."""
    return textwrap.wrap(text, _WIDTH, initial_indent="# ", subsequent_indent="#   ")


def as_set(case: Case) -> str:
    """Return a case with its settings as the text of a file of the working directory."""
    raw = {name: dict(given) for name, given in case.raw.items()}
    for path in case.settings:
        name, _, key = path.partition(".")
        value = raw[name].get(key)
        if isinstance(value, str) and Path(value).is_relative_to(Path.cwd()):
            raw[name][key] = str(Path(value).relative_to(Path.cwd()))
    return written(raw, f"{case.source}, with what was set on the page" if case.settings else "")


def as_written(path: Path, tables: Mapping[str, type[Table]]) -> dict[str, Any]:
    """Return title, tables and text of a case file, whether or not it can be used.

    Values are texts, as a form has them.
    """
    case, text = read_raw(path, tables)
    texts = {
        name: {
            str(key): value if isinstance(value, str) else toml(value)
            for key, value in given.items()
        }
        for name, given in case.raw.items()
        if isinstance(given, Mapping)
    }
    return {"title": describe(path), "tables": texts, "toml": text}
