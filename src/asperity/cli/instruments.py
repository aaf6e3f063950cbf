"""What ``asperity instruments`` does: the descriptions of instruments that ship."""

from typing import Any

from asperity.cli import show
from asperity.tribometer.instruments.described import Description, any_description, descriptions

_TABLES = {"supply": "supplies", "controller": "controller"}


def print_instrument(name: str, *, as_json: bool) -> None:
    """Print what is said to an instrument, as the table of a case file."""
    found = any_description(name)
    if as_json:
        show.print_json(_json(found) | {"words": dict(found.words)})
        return
    from asperity.casefile.written import toml

    words = (f"{key} = {toml(value)}" for key, value in found.words.items())
    head = [f"# {found.title}", f"# {found.source}", f"[{_TABLES[found.kind]}]"]
    show.print_text("\n".join([*head, *words]))


def print_instruments(*, as_json: bool) -> None:
    """Print the names of the descriptions, and what each is for."""
    listed = list(descriptions().values())
    if as_json:
        show.print_json({"instruments": [_json(one) for one in listed]})
        return
    widths = [max(map(len, column)) + 2 for column in zip(*map(_row, listed), strict=True)]
    rows = (
        "".join(f"{cell:{width}}" for cell, width in zip(_row(one), widths, strict=True)).rstrip()
        for one in listed
    )
    show.print_text("\n".join(rows))
    show.print_text(
        '\nname it in a case file: [supplies] instrument = "tti-pl", '
        '[controller] instrument = "siglent-sdg"; none of them has been tried on a device'
    )


def _row(description: Description) -> tuple[str, str, str, str]:
    return (
        description.name,
        description.kind,
        description.title,
        "off is read back" if description.proves_off else "NOT PROVEN OFF",
    )


def _json(description: Description) -> dict[str, Any]:
    return {
        "name": description.name,
        "kind": description.kind,
        "title": description.title,
        "source": description.source,
        "off_is_read_back": description.proves_off,
    }
