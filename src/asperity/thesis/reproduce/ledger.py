"""What of the thesis is reproduced, without making any of it: what runs have left, and what not."""

from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from asperity.results.table import Table
from asperity.thesis import contents
from asperity.thesis.contents import chapter_of
from asperity.thesis.exhibits import CLAIM, FIGURE
from asperity.thesis.products import DIFFERS, Plain
from asperity.thesis.reproduce.files import Collection, Shown
from asperity.thesis.said import read_by_a_machine

if TYPE_CHECKING:
    from asperity.results.report import Section

_CAME_OF_IT = "verdict", "ours", "why"


def ledger(
    folder: Path, elsewhere: Mapping[str, Mapping[str, Any]] | None = None
) -> dict[str, Any]:
    """Return chapters, claims and figures, with what a run left of each in a folder.

    Parameters
    ----------
    folder : path
        What ``asperity thesis --out`` was given; it need not be there.
    elsewhere : mapping, optional
        By number of a claim: what came of it where it was made, told of one that was not made here.

    Returns
    -------
    dict
        ``chapters``, ``claims`` and ``figures``; ``kept`` says of each whether it was made by this
        version and is whole, and ``line`` what makes it otherwise.
    """
    collection = Collection(folder)
    claims, figures = [], []
    for exhibit in contents.everything():
        if exhibit.kind not in (CLAIM, FIGURE):
            continue
        found = collection.find(exhibit)
        told = {
            "number": exhibit.number,
            "chapter": chapter_of(exhibit.number),
            "kept": found is not None,
            "line": f"asperity thesis --only {exhibit.number}",
        }
        if exhibit.kind == CLAIM:
            own = told | {"id": exhibit.number} | _claimed(found, exhibit.maker.words)
            known = {} if found else (elsewhere or {}).get(exhibit.number, {})
            claims.append(own | {key: known[key] for key in _CAME_OF_IT if key in known})
        else:
            words = exhibit.maker.words
            picture = found.files[".png"].name if found else ""
            how = list(found.plain["how"]) if found else []
            figures.append(told | {**words, "picture": picture, "how": how})
    chapters = [{"number": c.number, "title": c.title, "text": c.text} for c in contents.CHAPTERS]
    return {
        "read": read_by_a_machine(),
        "chapters": chapters,
        "claims": claims,
        "figures": figures,
        "folder": str(folder),
    }


def reported(told: Mapping[str, Any], folder: Path) -> str:
    """Return a ledger as a page that prints: claims by chapter, and the figures that were made.

    Parameters
    ----------
    told : mapping
        From `ledger`.
    folder : path
        The same.
    """
    from asperity import __version__
    from asperity.results.report import Heading, Section, report

    claims = told["claims"]
    count = Counter(one["verdict"] or "not made" for one in claims)
    said = ", ".join(f"{verdict} {number}" for verdict, number in count.most_common())
    kept = sum(one["kept"] for one in claims)
    first = Section(
        "",
        (
            f"Of {len(claims)} claims: {said}.",
            f"{kept or 'None'} of them {'was' if kept < 2 else 'were'} made here; what stands of "
            "others came of them where this version was made.",
            told["read"],
        ),
    )
    sections = [first, *(_chapter(chapter, told, folder) for chapter in told["chapters"])]
    return report("What of the thesis is reproduced", sections, Heading(version=__version__))


def _chapter(chapter: Mapping[str, Any], told: Mapping[str, Any], folder: Path) -> "Section":
    from asperity.results.report import Picture, Section

    own = [one for one in told["claims"] if one["chapter"] == chapter["number"]]
    rows = [
        (
            one["id"],
            f"{one['text']} Section {one['section']}.",
            one["theirs"],
            one["ours"] or "–",
            one["verdict"] or "not made",
            one["why"],
        )
        for one in own
    ]
    headings = ("claim", "what it says", "thesis", "here", "verdict", "why")
    pictures = tuple(
        Picture(f"Figure {one['number']}: {one['title']}", caption=one["caption"],
                png=folder / one["picture"])
        for one in told["figures"]
        if one["chapter"] == chapter["number"] and one["picture"]
    )  # fmt: skip
    tables = (Table.of(headings, rows, left=len(headings)),) if rows else ()
    title = f"{chapter['number']} {chapter['title']}"
    return Section(title, (chapter["text"],), pictures, tables)


def _claimed(shown: Shown | None, words: Any) -> dict[str, Any]:
    plain = shown.plain if shown else {}
    return {
        "text": words["claim"],
        "section": words["section"],
        "theirs": words["thesis"],
        "verdict": plain.get("verdict", ""),
        "ours": plain.get("ours", ""),
        "why": _why(plain),
        "said": [f"“{text}” (line {line})" for line, text in words["said"]],
        "how": list(plain.get("how", ())),
    }


def _why(plain: Plain) -> str:
    """What does not hold, in the thesis's words, then why."""
    if not plain:
        return ""
    failed = "; ".join(plain["failed"])
    differs = failed and plain["verdict"] == DIFFERS
    told = [f"Does not hold: {failed}." if differs else "", plain["reason"], plain["assumed"]]
    return " ".join(one for one in told if one)
