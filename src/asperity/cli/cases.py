"""What ``asperity cases`` does."""

from asperity.cli import show
from asperity.files.shipped import SPEAKING, case_text, describe, shipped_cases


def print_case(name: str, *, as_json: bool) -> None:
    """Print the text of a case that ships."""
    text = case_text(name)
    if as_json:
        show.print_json({"name": name, "text": text})
    else:
        show.print_text(text.rstrip("\n"))


def print_cases(*, as_json: bool) -> None:
    """Print the names of the cases that ship, and what each is."""
    speaking = {name: says for says, name in SPEAKING.items()}
    listed = [
        {"name": name, "also": speaking.get(name), "description": describe(path)}
        for name, path in shipped_cases().items()
    ]
    if as_json:
        show.print_json({"cases": listed})
        return
    # Without the tables of answers, which take numpy.
    widths = [max(len(case[key] or "") for case in listed) + 2 for key in ("name", "also")]
    show.print_text(
        "\n".join(
            f"{case['name']:{widths[0]}}{case['also'] or '':{widths[1]}}{case['description']}"
            for case in listed
        )
    )
