"""What of the thesis is reproduced, without making any of it: what runs have left, and what not."""

from pathlib import Path
from typing import Any

from asperity.thesis import contents
from asperity.thesis.contents import chapter_of
from asperity.thesis.exhibits import CLAIM, FIGURE
from asperity.thesis.products import DIFFERS, Plain
from asperity.thesis.reproduce.files import Collection, Shown
from asperity.thesis.said import read_by_a_machine


def ledger(folder: Path) -> dict[str, Any]:
    """Return chapters, claims and figures, with what a run left of each in a folder.

    Parameters
    ----------
    folder : path
        What ``asperity thesis --out`` was given; it need not be there.

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
            claims.append(told | {"id": exhibit.number} | _claimed(found, exhibit.maker.words))
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


def _claimed(found: Shown | None, words: Any) -> dict[str, Any]:
    plain = found.plain if found else {}
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
