"""A data file with one entry, begun for whoever has a table at hand."""

from collections.abc import Iterator, Mapping, Sequence

from asperity.casefile.schema import Key, keys_of
from asperity.casefile.table import Table
from asperity.start.write import comment


def data_text(
    remarks: Sequence[str],
    source: tuple[str, str],
    entry: tuple[str, str],
    table: type[Table],
    given: Mapping[str, str],
) -> str:
    """Return a commented data file.

    Parameters
    ----------
    remarks : sequence of str
        What stands at its head.
    source : tuple of str
        Key and name of the source of all numbers.
    entry : tuple of str
        Kind and name of the entry.
    table : type of Table
        Whose keys it has.
    given : mapping of str to str
        Values as they are written; other keys stand behind a #.
    """
    key, name = source
    lines = [line for remark in remarks for line in (*comment(remark), "")]
    lines += [
        f"[source.{key}]",
        f'name = "{name}"',
        'confidence = "one source"',
        "",
        f'[{entry[0]}."{entry[1]}"]',
    ]
    for each in keys_of(table):
        lines += _of(each, given)
    lines.append(f'from = {{ "*" = "{key}" }}')
    return "\n".join(lines) + "\n"


def _of(key: Key, given: Mapping[str, str]) -> Iterator[str]:
    if key.name == "name":
        return
    yield from comment(key.meaning)
    value = given.get(key.name)
    yield f"{key.name} = {value}" if value else f"#{key.name} ="
    yield ""
